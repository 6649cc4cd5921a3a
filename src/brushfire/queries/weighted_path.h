// Cheapest paths over weighted surfaces.
//
// Example:
//     const brushfire::Mesh mesh = brushfire::read_mesh("scan.ply").mesh;
//     brushfire::Weights weights{.face = std::vector<double>(mesh.face_count(), 1.0)};
//     weights.face[0] = 5;
//     brushfire::WeightedSolver solver(mesh, weights);
//     const brushfire::WeightedPath path =
//         brushfire::weighted_path(solver, brushfire::vertex_point(mesh, 0), brushfire::vertex_point(mesh, 2));
//     std::printf("%g for %g of way\n", path.cost, path.length);
#pragma once

#include <brushfire/mesh/surface_path.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/weighted/weighted_distance.h>

#include <array>
#include <span>
#include <vector>

namespace brushfire {

// From one point of a path to the next: straight in a face, or along an edge.
struct WeightedLeg {
  Index face = kNoIndex;                           // a face that holds both points
  std::array<Index, 2> along{kNoIndex, kNoIndex};  // the vertices of the edge, where it is along one
  double length = 0;                               // in the mesh's units
  double weight = 0;                               // of the face, or of the edge
  double toll = 0;                                 // of the fences crossed where it begins
  double cost() const { return length * weight + toll; }
};

struct WeightedPath : SurfacePath {
  std::vector<WeightedLeg> legs;  // [points - 1]
  double cost = kInfinity;        // of the legs together; +inf: there is no path
  double lower = 0;               // no path costs less: proven; 0 where no lower bound was asked for
  Index source = kNoIndex;        // position in the caller's list
};

// Paths from the nearest of the sources to each target, off one run ([targets]). They are locally shortest: no change
// of where they cross edges, and none of the side on which they pass a vertex, makes them cheaper; where they cross an
// edge they obey Snell's law to rounding. Costs are without the sources' offsets. A cheaper path elsewhere is possible;
// `lower` says how much cheaper at most. With one weight everywhere they are the shortest paths, exactly.
//
// Where slopes count, paths are those of the search, whose cost is within its tolerance, and are not straightened;
// with WeightedOptions::towards they lead from the target to the source. Throws as WeightedSolver::distance() does. A
// millisecond or so for each path of some hundred legs.
std::vector<WeightedPath> weighted_paths(WeightedSolver& solver, std::span<const Source> sources,
                                         std::span<const SurfacePoint> targets, WeightedOptions options = {});

// Off a field that kept its run (WeightedOptions::keep_paths, or Replanner::field()), without another search. Throws
// Error(InvalidArgument) where there is none.
std::vector<WeightedPath> weighted_paths(const WeightedField& field, std::span<const SurfacePoint> targets);

// From one point to another.
WeightedPath weighted_path(WeightedSolver& solver, const SurfacePoint& from, const SurfacePoint& to,
                           const WeightedOptions& options = {});

}  // namespace brushfire
