// How distances change when vertices and sources move: first derivatives, exact, for optimisation and learning.
//
// Example:
//     const brushfire::Mesh mesh = brushfire::read_mesh("scan.ply").mesh;
//     const std::vector<brushfire::Source> sources{{brushfire::vertex_point(mesh, 0)}};
//     brushfire::DistanceOptions options;
//     options.method = brushfire::Method::Exact;
//     options.keep_paths = true;
//     const brushfire::DistanceField field = brushfire::distance(mesh, sources, options);
//     const std::vector<double> ones(mesh.vertex_count(), 1.0);  // of the sum of all distances
//     const auto gradient = brushfire::distance_gradient_wrt_vertices(mesh, sources, field, ones);
//     std::printf("moving vertex 2 along x changes the sum at a rate of %g\n", gradient.vertices[2].x);
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/solvers/distance.h>

#include <cstdint>
#include <span>
#include <vector>

namespace brushfire {

// Of a sum of weights[v] * distance[v] over vertices.
struct DistanceGradient {
  std::vector<Vec3> vertices;  // [vertex_count] change per unit of length that a vertex moves, all else held. A source
                               // moves with its face: at a vertex with the vertex
  std::vector<Vec3> places;    // [sources] change per unit of length that the source moves within its face, a vector in
                               // the face's plane. NaN for a source at a vertex, where the rate is no linear function
  std::vector<double> offsets;  // [sources] change per unit of the source's offset
};

// The gradient by one backward sweep over the paths of the field: a path is as short as it can be, so that to first
// order only the places count where its length is written down (the first variation): every edge that it crosses turns
// with the two faces there. Rays that have the same faces still to go are summed before they go on. No approximation:
// what is left is rounding.
//
// `field`: of a run of these sources in this domain with Method::Exact and keep_paths (or Windows with tolerance 0).
// `weights`: [vertex_count], finite. Vertices that no source reaches count nothing.
//
// A distance has a gradient unless the vertex has several shortest paths, i.e. lies on the cut locus: there the rate
// depends on the direction, and the gradient of one of the paths is given (see one_sided_vertices()). A piece of no
// length has no direction and counts as 0.
//
// Throws Error(InvalidArgument) for curves as sources, a field without paths or of another mesh, weights of another
// number or that are not finite, and a mesh without positions; Error(Cancelled). O(vertices log vertices + crossings of
// rays that differ); on scans some share of the time of the run (docs/applications.md).
DistanceGradient distance_gradient_wrt_vertices(const Domain& domain, std::span<const Source> sources,
                                                const DistanceField& field, std::span<const double> weights);

// Which vertices have another path, in another direction, that is as long as the shortest to a share of `tie`:
// [vertex_count], 1 where so. There a derivative is one-sided. Found by carrying the paths of all neighbours on, around
// the neighbour, to the vertex; a second path that no neighbour shares (from a source in a face of the vertex, on
// meshes of a few faces) is not seen. The field as above. O(faces).
std::vector<std::uint8_t> one_sided_vertices(const Domain& domain, const DistanceField& field, double tie = 1e-9);

}  // namespace brushfire
