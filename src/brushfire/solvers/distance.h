// distance(): from a mesh and sources to a distance field. The front door of all solvers.
//
// Example:
//     const brushfire::Mesh mesh = brushfire::read_mesh("scan.ply").mesh;
//     const std::vector<brushfire::Source> sources{{brushfire::vertex_point(mesh, 0)}};
//     const brushfire::DistanceField field = brushfire::distance(mesh, sources, {.tolerance = 1e-4});
//     std::printf("vertex 2 is %g away, to within %g\n", field.distance[2], field.error_bound[2]);
#pragma once

#include <brushfire/core/progress.h>  // IWYU pragma: export
#include <brushfire/core/types.h>
#include <brushfire/mesh/curve_source.h>
#include <brushfire/mesh/domain.h>  // IWYU pragma: export
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/heat_options.h>
#include <brushfire/solvers/window_field.h>  // IWYU pragma: export

#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace brushfire {

class Weighting;

enum class Method : std::uint8_t {
  Windows,           // window propagation with merging: relative error <= DistanceOptions::tolerance, proven
  Exact,             // window propagation: the polyhedral distance, to rounding
  CarriedSource,     // fast marching in which every vertex carries the pseudo-source it is seen from; measured error
                     // stated. On one thread so far, whatever DistanceOptions::threads says
  NovotniKlein,      // fast marching, circular update with the visibility test; measured error stated
  NovotniKlein2002,  // the update literally as printed in the paper, to show what it does
  KimmelSethian,     // fast marching, planar update: the paper's baseline
  Dijkstra,          // edge graph: an upper bound
  Heat,              // two linear systems (heat_options.h): smooth, no bound; see docs/heat.md. In builds with Eigen
};

// "windows", "exact", "carried-source", "novotni-klein", "novotni-klein-2002", "kimmel-sethian", "dijkstra",
// "heat": as on the command line.
std::string_view name_of(Method method);
// Throws Error(InvalidArgument) that lists the names, or says what a build lacks for the method.
Method method_named(std::string_view name);
// All that this build has, in the order of the enumeration.
std::span<const Method> all_methods();

// Arithmetic of the marching itself; lengths and results are double either way. Float loses digits beyond the sixth,
// where values are not accurate anyway unless the surface is flat; where a mesh does not fit into its range (edges
// 2^24 times the mean), and for novotni-klein-2002, whose formula cancels, Double is used.
enum class Precision : std::uint8_t { Float, Double };

// Which value a method with proven bounds gives out. For Windows, Upper (never shorter than a real path) and Lower
// (never longer than the distance) keep the same tolerance and cost some more windows.
enum class Bound : std::uint8_t { Estimate, Upper, Lower };

struct Source {
  SurfacePoint point;
  double offset = 0;  // the value the front starts with; finite, may be negative; in the mesh's units
  // Where set, the source is all of this curve, `point` is not looked at, and `offset` is added to the curve's own.
  // Lengths of paths are then counted from the curve's least offset where that matters (DistanceOptions::tolerance).
  std::shared_ptr<const CurveSource> curve = nullptr;
};
Source source_along(CurveSource curve, double offset = 0);
// The least value that the front starts with anywhere on the source.
double least_offset(const Source& source);

inline constexpr double kMaxTolerance = 0.1;

struct DistanceOptions {
  Method method = Method::Windows;
  // Method::Windows: |value - distance| <= tolerance * distance at every vertex (of the path's length, where sources
  // have offsets); in [0, kMaxTolerance]. 0 is exact. A tolerance so small that an exact run is quicker gets the exact
  // run (on scans: 1e-3 at some thousand vertices, 1e-4 at some hundred thousand).
  double tolerance = 1e-3;
  Bound bound = Bound::Estimate;           // Method::Windows only
  HeatOptions heat = {};                   // Method::Heat only
  Precision precision = Precision::Float;  // methods that have only one ignore it
  double max_distance = kInfinity;         // vertices farther than this read +inf; >= 0, may be +inf
  // If there are targets, the solver may stop once all of them are final; those that are nowhere read +inf.
  std::vector<SurfacePoint> targets = {};
  bool keep_paths = false;    // fill DistanceField::windows, for paths to vertices and targets (exact)
  bool keep_windows = false;  // the same for every surface point: all windows are kept, some kB a vertex
  unsigned threads = 1;       // for this one field; 0: one per processor. The result does not depend on it
  // Costs in place of distances: see solvers/weighted/weighting.h.
  std::shared_ptr<const Weighting> weighting = nullptr;
  Progress progress = {};               // called now and then; may be empty
  const CancelToken* cancel = nullptr;  // polled now and then; null: what the thread listens to (see cancel.h)
};

struct DistanceField {
  std::vector<double>
      distance;               // [vertex_count]; +inf: unreachable, beyond max_distance, or not final at an early stop
  std::vector<Index> source;  // [vertex_count] position of the nearest source in the caller's list; kNoIndex: none
  std::vector<double> target_distance;  // [targets]
  std::vector<Index> target_source;     // [targets]
  // In a domain with walls only: [domain.open().vertex_count()] the distance on every side of them, for isolines.
  std::vector<double> side_distance;
  std::vector<double> error_bound;     // [vertex_count] absolute and proven; empty for methods without a bound
  double max_error_bound = kInfinity;  // relative, over all reached vertices; +inf for methods without a bound
  // Where keep_paths or keep_windows was set and the method has windows; of domain.open(), in its numbers.
  std::shared_ptr<const WindowField> windows;
  Method method = Method::Windows;
  Index reached = 0;          // vertices with a finite distance
  Index beyond_radius = 0;    // vertices that the front saw but that are farther than max_distance or not final
  Index unreachable = 0;      // the rest (exact where neither radius nor targets stopped the front)
  std::uint64_t updates = 0;  // vertices (marching) or window lists (windows) taken from the queue, with repetitions
};

// A field of the reached vertices only, in ascending order.
struct SparseField {
  std::vector<Index> vertex;                   // [reached]
  std::vector<double> distance;                // [reached], finite
  std::vector<Index> source;                   // [reached]
  std::vector<double> target_distance;         // [targets]
  std::vector<Index> target_source;            // [targets]
  std::shared_ptr<const WindowField> windows;  // as that of DistanceField; it, too, costs what was reached
};

// Distances from the nearest of the sources (least distance plus offset; equal: the lowest position) to every vertex.
// A source that another one dominates reads less than its own offset. Throws Error(InvalidArgument) for an empty source
// list, an offset that is not finite or a negative max_distance; Error(IndexOutOfRange) and Error(InvalidArgument) for
// points that are not on the mesh; Error(InvalidArgument) for a source behind a wall; Error(Cancelled).
DistanceField distance(const Domain& domain, std::span<const Source> sources, const DistanceOptions& options = {});

// The same with its workspace kept between calls, for many sources on one mesh. Not for use from several threads at
// once; solvers on the same mesh are independent of each other.
class DistanceSolver {
 public:
  explicit DistanceSolver(Domain domain);
  ~DistanceSolver();
  DistanceSolver(DistanceSolver&&) noexcept;
  DistanceSolver& operator=(DistanceSolver&&) noexcept;

  const Domain& domain() const noexcept;
  const Mesh& mesh() const noexcept;  // the whole: domain().mesh()
  // Builds what the first call with this method and precision would build otherwise, so that it can be timed apart.
  // O(faces).
  void set_up(const DistanceOptions& options = {});
  DistanceField distance(std::span<const Source> sources, const DistanceOptions& options = {});
  // Overwrites `field` and uses its memory again: after a few calls the marching methods allocate nothing.
  void distance(std::span<const Source> sources, const DistanceOptions& options, DistanceField& field);

  // The same numbers, of the reached vertices only: costs what it reaches, whatever the size of the mesh (after the
  // first call; for methods that keep no list of what they touched, and with keep_windows, one look at every vertex
  // more).
  SparseField distance_sparse(std::span<const Source> sources, const DistanceOptions& options = {});
  // Overwrites `field` and uses its memory again: for very many short runs.
  void distance_sparse(std::span<const Source> sources, const DistanceOptions& options, SparseField& field);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace brushfire
