// weighted_distance(): what it costs to get from sources to every vertex where not all places are equally easy to
// cross.
//
// Example:
//     const brushfire::Mesh mesh = brushfire::read_mesh("scan.ply").mesh;
//     const brushfire::Weights weights{.face = std::vector<double>(mesh.face_count(), 2.0)};
//     const std::vector<brushfire::Source> sources{{brushfire::vertex_point(mesh, 0)}};
//     const brushfire::WeightedField field = brushfire::weighted_distance(mesh, weights, sources);
//     std::printf("vertex 2: between %g and %g\n", field.lower[2], field.distance[2]);
#pragma once

#include <brushfire/core/progress.h>
#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/steiner/weights.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace brushfire {

namespace steiner {
struct Run;
}

inline constexpr double kLeastWeightedTolerance = 1e-5;
inline constexpr double kMostWeightedTolerance = 1;

struct WeightedOptions {
  // How far apart the bounds may be: (upper - lower) / lower; in [kLeastWeightedTolerance, kMostWeightedTolerance]. A
  // goal, not a promise: windows are cut as small as it takes, points on edges, where windows cannot be followed, made
  // so dense that most vertices meet it; max_error_bound says what was reached.
  double tolerance = 0.01;
  // Where the goal is not met at every vertex, run again, this many times at most, each with windows a quarter as far
  // apart or points twice as dense, until it is; not where so many would not do: WeightedField::needed says what would.
  unsigned refinements = 0;
  // Where slopes count: sources are where one goes to, and not where one comes from.
  bool towards = false;
  // false: upper bounds only, those of a search over points on edges.
  bool lower = true;
  // Method::KimmelSethian: fast marching in place of bounds, which promises nothing, in a fraction of the time. Weights
  // of faces only; from points. Tolerance, lower, towards and keep_paths do not count.
  std::optional<Method> marching = std::nullopt;
  bool keep_paths = false;                 // WeightedField::run, for weighted_path(): by points on edges
  double max_distance = kInfinity;         // vertices that cost more read +inf; >= 0, may be +inf
  std::vector<SurfacePoint> targets = {};  // where there are any, it stops once all of them are final
  Progress progress = {};
  const CancelToken* cancel = nullptr;  // null: what the thread listens to
};

// What answered: Method::Windows, since the weight is one and the same everywhere; windows that refract; a search over
// points on edges, for fences, slopes and paths, and where windows would take longer; or WeightedOptions::marching.
enum class WeightedEngine { Uniform, Windows, Points, Marching };
const char* name_of(WeightedEngine engine) noexcept;  // uniform, windows, points, marching

// What it would take until max_error_bound is within the tolerance: estimated by what the last refinement has brought,
// or, before the first, by what the theory says, bounds four times as near.
struct WeightedNeeds {
  unsigned refinements = 0;  // more of them; 0: it is met, or there are no bounds
  std::uint64_t points = 0;  // on edges, in the last of them; 0: by windows
  double time = 0;           // of the last of them, in times of the run that is done
  bool is_reachable = true;  // false: more of them bring the bounds no nearer
};

// Costs are those of the cheapest paths, plus the sources' offsets. [vertex_count] unless said otherwise. From curves
// there are upper bounds only, from points along them that lie as dense as those on edges.
struct WeightedField {
  std::vector<double> distance;  // an upper bound, which a real path has; +inf: unreachable or beyond max_distance
  // A lower bound, proven (docs/weights.md); empty where none was asked for, where slopes count, and from curves.
  std::vector<double> lower;
  // In a domain with walls only: [domain.open().vertex_count()] the upper bound on every side of them.
  std::vector<double> side_distance;
  std::vector<Index> source;                          // whose path it is: position in the caller's list; kNoIndex: none
  std::vector<double> target_distance, target_lower;  // [targets]
  std::vector<Index> target_source;                   // [targets]
  // The greatest (distance - lower) / lower, without offsets, over all vertices (or targets, where there are any) that
  // were reached; +inf without lower bounds.
  double max_error_bound = kInfinity;
  double mean_error_bound = kInfinity;
  Index reached = 0;
  WeightedEngine engine = WeightedEngine::Points;
  std::uint64_t points = 0;                 // on edges, the vertices' copies among them; 0 where none were searched
  unsigned refinements = 0;                 // done
  WeightedNeeds needed;                     // to meet the tolerance
  std::shared_ptr<const steiner::Run> run;  // for weighted_path(); null where no points on edges were searched
};

// One mesh and its weights, for many sources. Weights that are one and the same everywhere give what Method::Windows
// gives, times the weight. Not for use from several threads at once.
class WeightedSolver {
 public:
  // Throws as check() does. O(vertices + faces).
  WeightedSolver(Domain domain, Weights weights);
  ~WeightedSolver();
  WeightedSolver(WeightedSolver&&) noexcept;
  WeightedSolver& operator=(WeightedSolver&&) noexcept;

  const Domain& domain() const noexcept;
  const Weights& weights() const noexcept;

  // Lays out the points for runs of this tolerance ahead of them. Throws Error(InvalidArgument) where it is out of
  // range, and Error(TooLarge). O(points on edges).
  void prepare(double tolerance);
  // Another one, for another thread: what both only read is shared. O(1) after prepare().
  WeightedSolver twin() const;

  // Throws Error(InvalidArgument) for no sources, an offset that is not finite, a tolerance that is out of range, a
  // negative max_distance, a source behind a wall, and marching by another method, over roads, fences or slopes or from
  // curves; Error(TooLarge) where the points need more memory than there is; Error(Cancelled). About 0.5 to 2
  // microseconds for every point on an edge.
  WeightedField distance(std::span<const Source> sources, const WeightedOptions& options = {});

 private:
  struct Workspace;
  explicit WeightedSolver(std::unique_ptr<Workspace> workspace);
  std::unique_ptr<Workspace> workspace_;
};

WeightedField weighted_distance(const Domain& domain, const Weights& weights, std::span<const Source> sources,
                                const WeightedOptions& options = {});

}  // namespace brushfire
