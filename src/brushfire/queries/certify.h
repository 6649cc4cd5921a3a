// What can be proven about a distance field, whoever made it: bounds on the truth, and the values outside of them.
#pragma once

#include <brushfire/core/progress.h>
#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/distance.h>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace brushfire {

// Of one value. All but the first are proofs.
enum class Finding : std::uint8_t {
  Possible,      // it may be right
  TooShort,      // below every distance that the bounds leave, or -inf
  TooLong,       // above every distance that the bounds leave
  NotReachable,  // a number, and no source leads there: only +inf is right
  NotReached,    // +inf, and a source leads there
  NotANumber,
};
// "possible", "too short", "too long", "not reachable", "not reached", "not a number".
std::string_view name_of(Finding finding);

struct CertifyOptions {
  // How far apart the bounds may be: upper - lower <= 2 * tolerance * distance (plus rounding). 0, the default, is one
  // exact run, and the bounds differ by rounding; 1e-3 is one run of windows: several times as fast on large meshes,
  // and it proves errors of 0.2 % and more. In [0, kMaxTolerance].
  double tolerance = 0;
  // What the field claims of itself: values may be off by this share of the distance (of the path's length, where
  // sources have offsets), and are wrong only beyond it. >= 0.
  double within = 0;
  // What is farther than this may read +inf; >= 0.
  double max_distance = kInfinity;
  unsigned threads = 1;  // 0: one per processor
  Progress progress = nullptr;
  const CancelToken* cancel = nullptr;
};

struct Certificate {
  std::vector<double> lower, upper;  // [vertex_count] lower <= distance <= upper, proven; both +inf: unreachable
  std::vector<Finding> finding;      // [vertex_count]
  // [vertex_count] how far the value is from the distance at least: < 0 too short by that, > 0 too long; -inf and +inf
  // where it is finite and should not be, or should be; NaN where it is; 0 where nothing is proven.
  std::vector<double> proven_error;
  Index possible = 0, too_short = 0, too_long = 0, not_reachable = 0, not_reached = 0, not_a_number = 0;
  // The least CertifyOptions::within for which nothing would be proven wrong; 0 where nothing is in any case, +inf
  // where no such claim can hold. And the vertex that requires it, the lowest of them; kNoIndex: none.
  double least_within = 0;
  Index worst_vertex = kNoIndex;
  double max_gap = 0;  // the largest (upper - lower) / (length of the path), over reached vertices

  Index proven_wrong() const { return too_short + too_long + not_reachable + not_reached + not_a_number; }
};

// Judges `field`, one value per vertex, as the distances from `sources`. A value is proven wrong only if it cannot be
// right: the proofs are those of `exact` and `windows` (docs/tolerance.md), with bounds rounded outwards. Where a
// vertex is possible, its value is within upper - lower of the distance, plus `within`. Throws Error(InvalidArgument)
// where the field has another size or an option is out of range, and what distance() throws. Costs one run.
Certificate certify(const Domain& domain, std::span<const double> field, std::span<const Source> sources,
                    const CertifyOptions& options = {});

}  // namespace brushfire
