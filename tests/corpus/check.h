// What is asked of a solver on a case, and how far the answers are from the oracle's.
#pragma once

#include "corpus/families.h"
#include "corpus/worker.h"
#include "oracle/polyhedral.h"

#include <string>
#include <vector>

namespace brushfire::corpus {

struct Task {
  enum class Kind : std::uint8_t {
    Truth,    // the oracle has an answer at all
    Exact,    // every vertex within the promise, and within the bound
    Paths,    // to vertices and targets: there, whole, as long as the field says and the truth
    Targets,  // the values at targets
    Radius,   // half the vertices, the same values, infinity beyond
    Windows,  // every vertex within the bound, the bound within the tolerance
    Lower,    // no vertex above the truth, to the last bit
    Upper,    // no vertex below the truth, to the last bit
    Other,    // marching: reached what can be reached; Dijkstra: not below the truth either
  };
  Kind kind = Kind::Truth;
  double tolerance = 0;
  Method method = Method::Exact;

  std::string name() const;
  bool of_windows() const { return kind == Kind::Windows || kind == Kind::Lower || kind == Kind::Upper; }
};

// Truth first, then those of these methods (as on the command line, and "paths", "targets", "radius", "lower", "upper";
// none: all) at these tolerances. Throws Error(InvalidArgument) for a name that is none of them.
std::vector<Task> tasks_of(const std::vector<std::string>& methods, const std::vector<double>& tolerances);

// The limit of processor time.
double seconds_for(const Task& task);

// The last case that was asked about, with its truths.
class Examination {
 public:
  explicit Examination(const Family& family, std::uint64_t seed) : family_(family), seed_(seed) {}

  Outcome run(std::uint64_t index, std::size_t start, const Task& task);

 private:
  void turn_to(std::uint64_t index, std::size_t start);
  const oracle::Truth& truth();
  bool takes_sources(const Task& task) const;
  bool more_digits_differ(std::uint64_t most_windows);

  Outcome exact(const DistanceOptions& options);
  Outcome paths();
  void hold_path(const WindowField& field, const SurfacePoint& to, oracle::Real truth, double bound, Outcome& out);
  Outcome targets();
  Outcome radius();
  Outcome windows(const Task& task);
  Outcome other(const Task& task);

  const Family& family_;
  std::uint64_t seed_;
  std::uint64_t index_ = ~std::uint64_t{0};
  std::size_t start_ = 0;
  Case case_;
  std::vector<double> offsets_;           // [sources of the start], what lengths count from
  bool curves_ = false, sloped_ = false;  // among the sources; with offsets that change along them
  oracle::Truth truth_;
  bool has_truth_ = false;
  oracle::Arithmetic arithmetic_ = oracle::Arithmetic::Quad;
};

}  // namespace brushfire::corpus
