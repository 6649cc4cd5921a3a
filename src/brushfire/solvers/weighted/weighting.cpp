// Weights for queries: their walls join the domain's, and a run becomes a DistanceField.
#include <brushfire/solvers/weighted/weighting.h>

#include <brushfire/solvers/steiner/detail/travel.h>
#include <brushfire/solvers/steiner/detail/weighted_mesh.h>

#include <algorithm>
#include <utility>

namespace brushfire {
namespace {

bool shares_edge(const Mesh& mesh, Index h, Index g) {
  for (Index i = mesh.opposite(h); i != h; i = mesh.opposite(i)) {
    if (i == g) return true;
  }
  return false;
}

// The barriers that a domain has: blocked faces, and edges over which faces no longer meet.
Barriers barriers_of(const Domain& domain) {
  Barriers found;
  if (!domain.has_walls()) return found;
  const Mesh& mesh = domain.mesh();
  const std::vector<Index>& open_face = domain.cut()->cut_face;
  const auto on_open = [&](Index h) { return 3 * open_face[Mesh::face_of(h)] + h % 3; };
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (open_face[f] == kNoIndex) found.faces.push_back(f);
  }
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    if (open_face[Mesh::face_of(h)] == kNoIndex) continue;
    for (Index g = mesh.opposite(h); g != h; g = mesh.opposite(g)) {
      if (g < h || open_face[Mesh::face_of(g)] == kNoIndex) continue;
      if (!shares_edge(domain.open(), on_open(h), on_open(g))) found.edges.push_back({mesh.from(h), mesh.to(h)});
    }
  }
  return found;
}

}  // namespace

Barriers walls_of(const Weights& weights) {
  Barriers walls;
  for (Index f = 0; f < weights.face.size(); ++f) {
    if (weights.face[f] == kInfinity) walls.faces.push_back(f);
  }
  for (const EdgeCost& e : weights.edges) {
    if (e.crossing == kInfinity) walls.edges.push_back(e.vertices);
  }
  return walls;
}

Domain with_walls(const Domain& domain, Barriers more) {
  if (more.faces.empty() && more.edges.empty() && more.vertices.empty()) return domain;
  const Barriers old = barriers_of(domain);
  more.faces.insert(more.faces.end(), old.faces.begin(), old.faces.end());
  more.edges.insert(more.edges.end(), old.edges.begin(), old.edges.end());
  return Domain(domain.mesh(), more);
}

namespace {

Domain checked(const Domain& domain, const Weights& weights) {
  check(domain.mesh(), weights);
  return with_walls(domain, walls_of(weights));
}

}  // namespace

Weighting::Weighting(const Domain& domain, Weights weights, const WeightingOptions& options)
    : domain_(checked(domain, weights)),
      weights_(std::move(weights)),
      options_(options),
      prototype_(domain_, weights_) {
  if (!options.marching) prototype_.prepare(options.tolerance);
}

std::shared_ptr<const Weighting> Weighting::on_open() const {
  return std::make_shared<const Weighting>(domain_.open(), steiner::weights_on_open(domain_, weights_), options_);
}

double Weighting::along(Index face, Index from, Index to) const {
  const Mesh& mesh = domain_.mesh();
  const double weight = weights_.face.empty() ? 1 : weights_.face[face];
  const Index h = 3 * face + ((from + 1) % 3 == to ? from : to);
  const double length = mesh.lengths()[h] * mesh.unit();
  if (!weights_.grain.empty()) {
    return weight * length * steiner::stretch_of(mesh, face, weights_.grain[face]).along[h % 3];
  }
  if (!weights_.pace) return weight * length;
  const auto height = [&](Index k) { return mesh.positions()[mesh.faces()[face][k]].z; };
  const steiner::Travel travel{&*weights_.pace, options_.towards};
  return weight * travel.cost(length, height(to) - height(from));
}

}  // namespace brushfire
