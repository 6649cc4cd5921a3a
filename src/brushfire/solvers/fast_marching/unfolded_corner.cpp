// The face behind one corner, by asking the unfolder.
#include <brushfire/solvers/fast_marching/detail/unfolded_corner.h>

namespace brushfire::fast_marching {

FacePair face_pair(const Mesh& mesh, const Unfolder& unfolder, Index h) {
  const Index edge = Mesh::next(h), corner = mesh.from(h), end0 = mesh.from(edge), end1 = mesh.to(edge);
  const Index other = unfolder.face_over(h / 3, end0, end1);
  if (other == kNoIndex) return {{end0, end1}, corner, end0};
  const Face& t = mesh.faces()[other];
  const Index behind = t[0] + t[1] + t[2] - end0 - end1;
  return {{end0, end1}, corner, behind != corner ? behind : end0};
}

}  // namespace brushfire::fast_marching
