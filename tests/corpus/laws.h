// Where the oracle is too slow: meshes of any size, held against what every distance field obeys.
#pragma once

#include "corpus/worker.h"

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/distance.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace brushfire::corpus {

struct Subject {
  std::string name;
  std::function<Mesh()> make;
};

// Generators: fans, strips, books and boxes of many faces, many components, doubled and sheared surfaces. `share` of
// their full size, which is a million faces where the kind is simple.
std::vector<Subject> large_subjects(std::uint64_t seed, double share);
// The meshes in a folder, of at most `bytes` each; those that are no meshes are left out.
std::vector<Subject> file_subjects(const std::string& folder, std::uint64_t bytes);

enum class Law : std::uint8_t {
  Exact,        // ends; every method after it is compared with it
  Symmetry,     // and the triangle inequality, between points of all kinds
  Scaling,      // by a power of two: the same bits
  Renumbering,  // vertices and faces in any order
  Radius,       // the same values within, infinity beyond
  Targets,      // as the field says
  Rows,         // of a matrix, as the field says
  Threads,      // the same bits
  Windows2,     // within their bound of exact, at 1e-2, 1e-3, 1e-5
  Windows3,
  Windows5,
  Lower,  // on its side of exact, at 1e-3
  Upper,
  Paths,  // as long as the field says
  CarriedSource,
  NovotniKlein,
  NovotniKlein2002,
  KimmelSethian,
  Dijkstra,  // not below exact
};
inline constexpr std::size_t kLaws = 19;
std::string name_of_law(Law law);

class Trial {
 public:
  Trial(const std::vector<Subject>& subjects, std::uint64_t seed, double seconds)
      : subjects_(subjects), seed_(seed), seconds_(seconds) {}

  Outcome run(std::size_t subject, Law law);

 private:
  void turn_to(std::size_t subject);
  const DistanceField& field();
  DistanceField solve(const Mesh& mesh, const DistanceOptions& options) const;

  Outcome symmetry();
  Outcome scaling();
  Outcome renumbering();
  Outcome radius();
  Outcome targets();
  Outcome rows();
  Outcome threads();
  Outcome windows(Law law);
  Outcome paths();
  Outcome other(Method method);

  const std::vector<Subject>& subjects_;
  std::uint64_t seed_;
  double seconds_;
  std::size_t at_ = ~std::size_t{0};
  Mesh mesh_;
  Source source_;
  std::vector<SurfacePoint> points_;
  std::optional<DistanceField> field_;
};

}  // namespace brushfire::corpus
