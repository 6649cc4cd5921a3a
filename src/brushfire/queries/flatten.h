// Flattening: coordinates in the plane whose straight distances come as near to the geodesic ones as they can, for
// textures.
//
// Example:
//     const brushfire::Mesh mesh = brushfire::read_mesh("scan.ply").mesh;
//     const brushfire::Flattening flat = brushfire::flatten(mesh);
//     std::printf("vertex 0 lies at %g %g; stress %g\n", flat.uv[0][0], flat.uv[0][1], flat.distortion.stress);
//
// Based on: Zigelman, Kimmel, Kiryati, "Texture Mapping Using Surface Flattening via Multidimensional Scaling", 2002;
// de Silva, Tenenbaum, "Sparse multidimensional scaling using landmark points", 2004.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/distance.h>

#include <array>
#include <span>
#include <vector>

namespace brushfire {

// Edges, by their two vertices, along which a connected surface has to be cut so that it can be laid flat: shortest
// ways along edges, over `base`, around every handle and between holes; on a sphere from there to the farthest vertex;
// nothing on a disc. Edges of three and more faces are neither cut nor looked past. Ascending.
// O(edges log edges). Throws Error(IndexOutOfRange), Error(InvalidArgument) for a base in no face.
// Based on: Erickson, Whittlesey, "Greedy optimal homotopy and homology generators", 2005.
std::vector<std::array<Index, 2>> cut_to_disc(const Mesh& mesh, Index base);

struct FlattenOptions {
  Index landmarks = 100;          // at least 3; farthest points. Each costs one field
  bool cut = true;                // along cut_to_disc() from the first landmark; else as it is
  DistanceOptions distance = {};  // method, tolerance, threads (of one field), cancel, progress
};

// How far the plane is from the surface. All 1 and stress 0: isometric.
struct Distortion {
  double stress = 0;       // of distances from the landmarks: sqrt(sum (flat - geodesic)^2 / sum geodesic^2)
  double stretch = 1;      // lengths: root of the mean of the square, over the area and all directions
  double max_stretch = 1;  // the greatest, at the worst point in the worst direction
  double min_stretch = 1;  // the least
  double angle = 1;        // mean over the area of (s1 / s2 + s2 / s1) / 2, s1 and s2 a face's two stretches
  Index flipped = 0;       // faces that lie the other way round than most (by area)
};

struct Flattening {
  Mesh mesh;                              // the mesh, cut open
  std::vector<Index> original_vertex;     // [mesh.vertex_count()] in the whole
  std::vector<Index> original_face;       // [mesh.face_count()]
  std::vector<Index> landmarks;           // vertices of `mesh`
  std::vector<std::array<double, 2>> uv;  // [mesh.vertex_count()] in the mesh's units; NaN for vertices in no face
  Distortion distortion;
};

// Coordinates by landmark multidimensional scaling: distances from the landmarks, squared and centred, place them in
// the plane by the two greatest eigenvectors, and every other vertex by its distances from them. A surface that unrolls
// to a convex piece of the plane (a cylinder, a cone of less than half a turn, cut open) is laid flat exactly, with
// exact distances to rounding. The first axis is the longest; no scale is changed.
//
// Throws Error(InvalidArgument) for a mesh in several pieces, without faces or positions, and for fewer than 3
// landmarks; what distance() throws. O(landmarks fields + landmarks^3).
Flattening flatten(const Mesh& mesh, const FlattenOptions& options = {});

// The same with the walls of a domain as seams, none added.
Flattening flatten(const Domain& domain, const FlattenOptions& options = {});

// Of any coordinates of the vertices of a mesh: all but the stress, which is 0. O(faces).
Distortion distortion_of(const Mesh& mesh, std::span<const std::array<double, 2>> uv);

// Moved and scaled so that they just fit into [0, 1]^2, their proportions kept: what 3D programs take.
std::vector<std::array<double, 2>> in_unit_square(std::span<const std::array<double, 2>> uv);

}  // namespace brushfire
