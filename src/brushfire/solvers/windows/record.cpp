// Points of faces in the frames of halfedges.
#include <brushfire/solvers/windows/detail/record.h>

#include <brushfire/solvers/windows/detail/face.h>

namespace brushfire::detail::BRUSHFIRE_NUMBERS {

Vec2 in_frame(const Frame& frame, Index k, const std::array<Real, 3>& weights) {
  const Real along = weights[next3(k)], up = weights[previous3(k)];
  return {along * frame.length + up * frame.apex.x, up * frame.apex.y};
}

void WindowFieldData::keep(std::span<const KeptWindow> windows) {
  const std::size_t halfedges = mesh.halfedge_count();
  first_kept.assign(halfedges + 1, 0);
  for (const KeptWindow& k : windows) ++first_kept[k.halfedge + 1];
  for (std::size_t h = 0; h < halfedges; ++h) first_kept[h + 1] += first_kept[h];
  std::vector<std::size_t> fill(first_kept.begin(), first_kept.end() - 1);
  kept.resize(windows.size());
  for (const KeptWindow& k : windows) kept[fill[k.halfedge]++] = k.window;
}

std::vector<FaceWeights> faces_around(const Mesh& mesh, const PointLocation& at) {
  std::vector<FaceWeights> result;
  for_each_face_around(mesh, at, [&](const FaceWeights& f) { result.push_back(f); });
  return result;
}

}  // namespace brushfire::detail::BRUSHFIRE_NUMBERS
