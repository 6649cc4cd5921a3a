// What became of a family of cases, and the row that tells it.
#pragma once

#include "corpus/check.h"
#include "corpus/laws.h"

#include <cstdint>
#include <string>

namespace brushfire::corpus {

// Of cases beside the oracle. Counts values, except for hung, crashed and refused (solves), unsure (solves on which the
// oracle changed its mind with more digits) and no_truth (starts on which it has no answer).
struct Tally {
  std::uint64_t compared = 0, beyond = 0, unbound = 0;  // of exact, at vertices, at targets and within a radius
  std::uint64_t hung = 0, crashed = 0, refused = 0;     // of all methods
  std::uint64_t paths = 0, lost = 0, path_beyond = 0;
  std::uint64_t window_violations = 0, side_violations = 0, other_beyond = 0;
  std::uint64_t no_truth = 0, unsure = 0;
  double worst = 0, path_worst = 0;

  void add(const Task& task, const Outcome& outcome);
  void add(const Tally& other);
  // What breaks a promise. What the oracle does not know is nobody's fault.
  std::uint64_t wrong() const;
};

void print_head_of_families();
void print_row(const std::string& name, std::uint64_t cases, const Tally& tally);

// Of meshes held to laws.
struct LawTally {
  std::uint64_t meshes = 0, compared = 0, beyond = 0, hung = 0, crashed = 0, refused = 0;
  double worst = 0, slowest = 0;
  std::string slowest_at;

  void add(const std::string& name, const Outcome& outcome);
  std::uint64_t wrong() const { return beyond + hung + crashed + refused; }
};

void print_head_of_laws();
void print_row(const std::string& name, const LawTally& tally);

}  // namespace brushfire::corpus
