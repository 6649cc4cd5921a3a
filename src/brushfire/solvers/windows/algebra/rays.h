// Rays to points of faces, and the names of a point by all faces that hold it.
#pragma once

#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/windows/algebra/face_shape.h>
#include <brushfire/solvers/windows/algebra/frame.h>
#include <brushfire/solvers/windows/algebra/window.h>

#include <array>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// The ray comes over `halfedge` from `source` (in the halfedge's frame; y >= 0: from inside of the halfedge's face or
// its edge). kNoIndex: along an edge of a face with a repeated vertex, or the point is the source itself.
struct Ray {
  Vec2 source;
  Index halfedge = kNoIndex;
  Index pseudo_source = kNoIndex;  // vertex, or vertex count + position of the source
  WindowKind kind = WindowKind::Circular;
};

struct KeptWindow {
  Index halfedge;
  Window window;
};

// A point of a face in the frame of the face's halfedge k; weights by corner.
Vec2 in_frame(const Frame& frame, Index k, const std::array<Real, 3>& weights);
// The same as the neighbour across the halfedge has it, which counts from the halfedge's end: a point near to that end
// keeps its digits.
Vec2 from_beyond(const Frame& frame, Index k, const std::array<Real, 3>& weights);

// All descriptions of a point by faces that contain it: itself, and for a point on an edge, the edge's other faces.
struct FaceWeights {
  Index face;
  std::array<Real, 3> weights;
};
SurfacePoint surface_point(const FaceWeights& at);

template <class Visit>
void for_each_face_around(const Mesh& mesh, const PointLocation& at, Visit&& visit) {
  const std::array<Real, 3> weights = weights_from(at.weights);
  visit(FaceWeights{at.face, weights});
  if (at.on != PointLocation::On::Edge) return;
  const Index h = at.halfedge, from = mesh.from(h);
  const auto opposite = mesh.opposite();
  for (Index g = opposite[h]; g != h; g = opposite[g]) {
    FaceWeights other{Mesh::face_of(g), {0, 0, 0}};
    const bool same_way = mesh.from(g) == from;
    other.weights[g % 3] = weights[same_way ? h % 3 : next3(h % 3)];
    other.weights[next3(g % 3)] = weights[same_way ? next3(h % 3) : h % 3];
    visit(other);
  }
}
std::vector<FaceWeights> faces_around(const Mesh& mesh, const PointLocation& at);

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
