// Points of faces in the frames of halfedges.
#include <brushfire/solvers/windows/algebra/rays.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

Vec2 in_frame(const Frame& frame, Index k, const std::array<Real, 3>& weights) {
  const Real along = weights[next3(k)], up = weights[previous3(k)];
  return {along * frame.length + up * frame.apex.x, up * frame.apex.y};
}

Vec2 from_beyond(const Frame& frame, Index k, const std::array<Real, 3>& weights) {
  const Real along = weights[k], up = weights[previous3(k)];
  return {along * frame.length + up * frame.rest, -(up * frame.apex.y)};
}

SurfacePoint surface_point(const FaceWeights& at) {
  return {at.face,
          {static_cast<double>(at.weights[0]), static_cast<double>(at.weights[1]), static_cast<double>(at.weights[2])}};
}

std::vector<FaceWeights> faces_around(const Mesh& mesh, const PointLocation& at) {
  std::vector<FaceWeights> result;
  for_each_face_around(mesh, at, [&](const FaceWeights& f) { result.push_back(f); });
  return result;
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
