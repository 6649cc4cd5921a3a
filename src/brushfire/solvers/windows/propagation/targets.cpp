// Which faces hold which targets.
#include <brushfire/solvers/windows/propagation/targets.h>

#include <brushfire/core/detail/sort.h>

#include <tuple>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

std::array<Real, 3> corner_distances_of(const WindowStructure& structure, const FaceWeights& at) {
  return corner_distances_in(structure.faces[at.face], at.weights);
}

void Targets::place(std::span<const PointLocation> targets, WindowStructure& structure) {
  clear(structure);
  states_.assign(targets.size(), {});
  for (Index i = 0; i < size(); ++i) {
    if (targets[i].on == PointLocation::On::Vertex) continue;
    for_each_face_around(structure.mesh, targets[i], [&](const FaceWeights& f) {
      const Index face = structure.inner_face(f.face);
      in_faces_.push_back({face, i, f.weights});
      structure.faces[face].has_target = true;
    });
  }
  detail::sort(in_faces_.begin(), in_faces_.end(), [](const TargetInFace& a, const TargetInFace& b) {
    return std::tie(a.face, a.target) < std::tie(b.face, b.target);
  });
  if (structure.wheels.empty()) return;
  std::vector<Index> faces(in_faces_.size());
  std::transform(in_faces_.begin(), in_faces_.end(), faces.begin(), [](const TargetInFace& t) { return t.face; });
  structure.wheels.stop_at(faces);
}

void Targets::clear(WindowStructure& structure) {
  for (const TargetInFace& t : in_faces_) structure.faces[t.face].has_target = false;
  in_faces_.clear();
  states_.clear();
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
