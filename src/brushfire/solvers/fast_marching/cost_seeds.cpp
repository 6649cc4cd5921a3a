// Straight lines within a face, times its weight.
#include <brushfire/solvers/fast_marching/detail/cost_seeds.h>

#include <brushfire/mesh/detail/flat_face.h>

#include <algorithm>

namespace brushfire::fast_marching {

std::span<const detail::Seed> CostSeeds::around(const Mesh& mesh, const FaceCosts& costs, const PointLocation& at) {
  const std::span<const detail::Seed> seeds = search_.in_own_faces(mesh, at);
  seeds_.assign(seeds.begin(), seeds.end());
  if (at.on == PointLocation::On::Vertex) return seeds_;
  weight_.assign(3, costs.of(at.face));  // as seeds come: the corners of the own face, then those behind the edge
  if (at.on == PointLocation::On::Edge && seeds.size() > 3) {
    for (Index g = mesh.opposite(at.halfedge); g != at.halfedge; g = mesh.opposite(g)) {
      weight_.push_back(costs.of(Mesh::face_of(g)));
    }
    const double along = *std::min_element(weight_.begin(), weight_.end());
    for (Index k = 0; k < 3; ++k) {
      if (k != Mesh::previous(at.halfedge) % 3) weight_[k] = along;
    }
  }
  for (std::size_t i = 0; i < seeds_.size(); ++i) seeds_[i].distance *= weight_[i];
  return seeds_;
}

double straight_cost(const Mesh& mesh, const FaceCosts& costs, const PointLocation& a, const PointLocation& b) {
  double least = kInfinity;
  const auto try_face = [&](Index f) {
    const auto wa = weights_in(mesh, a, f), wb = weights_in(mesh, b, f);
    if (wa && wb) least = std::min(least, costs.of(f) * distance_within(mesh, f, *wa, *wb));
  };
  try_face(b.face);
  if (b.on != PointLocation::On::Edge) return least;
  for (Index g = mesh.opposite(b.halfedge); g != b.halfedge; g = mesh.opposite(g)) try_face(Mesh::face_of(g));
  return least;
}

}  // namespace brushfire::fast_marching
