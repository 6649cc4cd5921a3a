// Shortest paths.
//
// Example:
//     const brushfire::Mesh mesh = brushfire::read_mesh("scan.ply").mesh;
//     brushfire::PathFinder paths(mesh);
//     const brushfire::SurfacePath path =
//         paths.between(brushfire::vertex_point(mesh, 0), brushfire::vertex_point(mesh, 2));
//     for (const brushfire::SurfacePoint& p : path.points) {
//       const brushfire::Vec3 at = brushfire::position(mesh, p);
//       std::printf("%g %g %g\n", at.x, at.y, at.z);
//     }
#pragma once

#include <brushfire/mesh/surface_path.h>
#include <brushfire/solvers/distance.h>

#include <memory>
#include <span>
#include <vector>

namespace brushfire {

// The shortest path from the nearest source to the point, read off a run that kept it (DistanceOptions::keep_paths for
// vertices and targets, keep_windows for all points; see WindowField). Straight within every strip of faces laid flat,
// bending at saddle and boundary vertices only; no two consecutive points are the same; its length is the field's value
// there minus the source's offset, to rounding. No points and length +inf where no source reaches. O(edges crossed).
// Throws Error(Internal) rather than return part of a path.
SurfacePath path_to(const WindowField& field, const SurfacePoint& target);

// The path along edges that Method::Dijkstra measures: from the nearest source's vertex to vertex `target`.
// Throws Error(InvalidArgument) for a field of another method or of another mesh. O(edges of the vertices on it).
SurfacePath edge_path_to(const Mesh& mesh, const DistanceField& field, Index target);

// The shortest path from one point to the other, to rounding; none from or to a point that is nowhere (see
// target_point()). It works in the solver's workspace, which other queries may share. The front stops as soon as it
// has reached its target: after the first call a short path costs little however large the mesh is. Throws as
// distance() does.
SurfacePath path_between(DistanceSolver& solver, const SurfacePoint& from, const SurfacePoint& to,
                         const CancelToken* cancel = nullptr);

// Shortest paths from each waypoint to the next, joined; from the last back to the first where `closed`. It may bend
// at waypoints (shorten() pulls it straight). At least one waypoint; repeating the one before adds nothing.
SurfacePath path_through(DistanceSolver& solver, std::span<const SurfacePoint> waypoints, bool closed = false,
                         const CancelToken* cancel = nullptr);

// The same within limits: of `how`, max_distance (a longer path counts as none; for path_through() that of the whole
// path), threads and cancel are used.
SurfacePath path_between(DistanceSolver& solver, const SurfacePoint& from, const SurfacePoint& to,
                         const DistanceOptions& how);
SurfacePath path_through(DistanceSolver& solver, std::span<const SurfacePoint> waypoints, bool closed,
                         const DistanceOptions& how);

// From the nearest of the sources to each target, all read off one run: [targets]. `source` of each path says which
// source that is, by its position in the caller's list. `how` as above. Throws as distance() does.
struct SourcePath : SurfacePath {
  Index source = kNoIndex;
};
std::vector<SourcePath> paths_to(DistanceSolver& solver, std::span<const Source> sources,
                                 std::span<const SurfacePoint> targets, const DistanceOptions& how = {});

// The same along edges, with the paths of edge_path_to(): sources and targets are vertices. Throws
// Error(InvalidArgument) for others.
std::vector<SourcePath> edge_paths_to(DistanceSolver& solver, std::span<const Source> sources,
                                      std::span<const SurfacePoint> targets, const DistanceOptions& how = {});
std::vector<SourcePath> edge_paths_to(const Domain& domain, std::span<const Source> sources,
                                      std::span<const SurfacePoint> targets, const DistanceOptions& how = {});

// The two with a solver of its own.
class PathFinder {
 public:
  explicit PathFinder(Domain domain);
  ~PathFinder();
  PathFinder(PathFinder&&) noexcept;
  PathFinder& operator=(PathFinder&&) noexcept;

  SurfacePath between(const SurfacePoint& from, const SurfacePoint& to, const CancelToken* cancel = nullptr);
  SurfacePath through(std::span<const SurfacePoint> waypoints, bool closed = false,
                      const CancelToken* cancel = nullptr);

 private:
  std::unique_ptr<DistanceSolver> solver_;
};

}  // namespace brushfire
