// Walls are cut by Domain; a fence is a slit whose two sides are joined again by bridges.
#include <brushfire/solvers/steiner/detail/weighted_mesh.h>

#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/solvers/steiner/detail/wall_faces.h>

#include <algorithm>
#include <map>
#include <utility>

namespace brushfire::steiner {
namespace {

// Those with a road, and those that are crossed at a price.
std::vector<EdgeCost> merged(const std::vector<EdgeCost>& edges) {
  std::map<std::pair<Index, Index>, EdgeCost> found;
  for (const EdgeCost& e : edges) {
    const auto [a, b] = std::minmax(e.vertices[0], e.vertices[1]);
    const auto [place, is_new] = found.try_emplace({a, b}, e);
    if (is_new) continue;
    place->second.along = std::min(place->second.along, e.along);
    place->second.crossing = std::max(place->second.crossing, e.crossing);
  }
  std::vector<EdgeCost> result;
  result.reserve(found.size());
  for (const auto& [ends, e] : found) result.push_back(e);
  return result;
}

// In the numbers of domain.open(); where the caller's vertices are several there, the copies that an edge joins.
std::vector<EdgeCost> on_open(const Domain& domain, const std::vector<EdgeCost>& edges) {
  if (!domain.has_walls()) return edges;
  std::vector<EdgeCost> result;
  for (const EdgeCost& e : edges) {
    for (const Index h : halfedges_between(domain.mesh(), e.vertices[0], e.vertices[1])) {
      const Index f = domain.cut()->cut_face[Mesh::face_of(h)];
      if (f == kNoIndex) continue;
      const Mesh& open = domain.open();
      const Index g = 3 * f + h % 3;
      result.push_back({{open.from(g), open.to(g)}, e.along, e.crossing});
    }
  }
  return merged(result);
}

std::vector<double> on_open(const Domain& domain, const std::vector<double>& weights) {
  std::vector<double> result(domain.open().face_count(), 1);
  if (weights.empty()) return result;
  for (Index f = 0; f < result.size(); ++f) result[f] = weights[domain.face(f)];
  return result;
}

Weights opened(const Domain& domain, const Weights& weights) {
  check(domain.mesh(), weights);
  return weights_on_open(domain, weights);
}

Barriers barriers_of(const Mesh& mesh, const Weights& weights, Walls walls) {
  Barriers barriers;
  for (const EdgeCost& e : weights.edges) {
    if (e.crossing > 0) barriers.edges.push_back(e.vertices);
  }
  if (walls == Walls::Left && !walls_part_a_vertex(mesh, weights)) return barriers;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (weights.face[f] == kInfinity) barriers.faces.push_back(f);
  }
  return barriers;
}

Domain fenced(const Mesh& mesh, const Barriers& barriers) {
  if (barriers.edges.empty() && barriers.faces.empty()) return Domain(mesh);
  return Domain(mesh, barriers);
}

}  // namespace

Weights weights_on_open(const Domain& domain, const Weights& weights) {
  Weights open{on_open(domain, weights.face), on_open(domain, merged(weights.edges)), weights.pace};
  for (Index f = 0; f < domain.open().face_count() && !weights.grain.empty(); ++f) {
    open.grain.push_back(weights.grain[domain.face(f)]);
  }
  return open;
}

WeightedMesh::WeightedMesh(const Domain& domain, const Weights& weights, Walls walls)
    : WeightedMesh(domain, Opened{opened(domain, weights)}, walls) {}

WeightedMesh::WeightedMesh(const Domain& domain, const Opened& given, Walls walls)
    : domain_(domain),
      walls_(walls),
      barriers_(barriers_of(domain.open(), given.weights, walls)),
      fenced_(fenced(domain.open(), barriers_)),
      edges_(std::make_shared<const EdgeTable>(fenced_.open())) {
  set_weights(given.weights);
}

std::shared_ptr<const WeightedMesh> WeightedMesh::reweighted(const Weights& weights) const {
  const Weights open = opened(domain_, weights);
  const Barriers barriers = barriers_of(domain_.open(), open, walls_);
  if (barriers.faces != barriers_.faces || barriers.edges != barriers_.edges) return nullptr;
  auto result = std::make_shared<WeightedMesh>(*this);
  result->set_weights(open);
  return result->stretches_ == stretches_ ? result : nullptr;  // points lie by the grain
}

void WeightedMesh::set_weights(const Weights& opened) {
  pace_ = opened.pace;
  const Mesh& open = mesh();
  std::vector<Grain> grain;
  for (Index f = 0; f < open.face_count() && !opened.grain.empty(); ++f) {
    grain.push_back(opened.grain[fenced_.face(f)]);
  }
  stretches_ = Stretches(open, grain);
  face_weight_.resize(open.face_count());
  double sum = 0, count = 0;
  for (Index f = 0; f < open.face_count(); ++f) {
    face_weight_[f] = opened.face[fenced_.face(f)];
    sum += 1 / face_weight_[f];
    count += face_weight_[f] < kInfinity;
  }
  mean_weight_ = 1;
  if (sum > 0) mean_weight_ = count / sum * (pace_ ? pace_->least() : 1);
  edge_weight_.assign(edges_->count(), kInfinity);
  for (Index h = 0; h < open.halfedge_count(); ++h) {
    double& w = edge_weight_[edges_->edge(h)];
    w = std::min(w, face_weight_[Mesh::face_of(h)] * stretches_.along(h));
  }
  for (const EdgeCost& e : opened.edges) {
    for (const Index h : open_halfedges(e.vertices[0], e.vertices[1])) {
      double& w = edge_weight_[edges_->edge(h)];
      w = std::min(w, e.along);
    }
  }
  bridges_.clear();
  find_bridges(opened.edges);
}

// Of an edge of domain().open().
std::vector<Index> WeightedMesh::open_halfedges(Index a, Index b) const {
  std::vector<Index> result;
  for (const Index h : halfedges_between(fenced_.mesh(), a, b)) {
    const Index f = fenced_.cut() ? fenced_.cut()->cut_face[Mesh::face_of(h)] : Mesh::face_of(h);
    if (f != kNoIndex) result.push_back(3 * f + h % 3);
  }
  return result;
}

void WeightedMesh::find_bridges(const std::vector<EdgeCost>& fences) {
  const Mesh& open = mesh();
  for (const EdgeCost& e : fences) {
    if (e.crossing == 0 || e.crossing == kInfinity) continue;
    const std::vector<Index> sides = open_halfedges(e.vertices[0], e.vertices[1]);
    for (const Index h : sides) {
      for (const Index g : sides) {
        const Index from = edges_->edge(h), to = edges_->edge(g);
        if (from == to) continue;
        const bool mirrored =
            fenced_.vertex(open.from(edges_->halfedge(from))) != fenced_.vertex(open.from(edges_->halfedge(to)));
        bridges_.push_back({from, to, mirrored, e.crossing / open.unit()});
      }
    }
  }
  std::sort(bridges_.begin(), bridges_.end(),
            [](const Bridge& a, const Bridge& b) { return std::pair(a.from, a.to) < std::pair(b.from, b.to); });
}

std::span<const Bridge> WeightedMesh::bridges(Index edge) const {
  if (bridges_.empty()) return {};
  const auto before = [](const Bridge& b, Index e) { return b.from < e; };
  const auto first = std::lower_bound(bridges_.begin(), bridges_.end(), edge, before);
  const auto last = std::lower_bound(first, bridges_.end(), edge + 1, before);
  return {first, last};
}

std::vector<SurfacePoint> WeightedMesh::on_open(const SurfacePoint& point) const {
  std::vector<SurfacePoint> result;
  for (const SurfacePoint& p : domain_.on_open(point)) {
    for (const SurfacePoint& side : fenced_.on_open(p)) {
      if (is_entered(side)) result.push_back(side);
    }
  }
  return result;
}

// Whether a face that the point lies in is no wall.
bool WeightedMesh::is_entered(const SurfacePoint& point) const {
  if (walls_ == Walls::CutOut) return true;
  const std::vector<Index> faces = faces_at(mesh(), locate(mesh(), point));
  return std::any_of(faces.begin(), faces.end(), [&](Index f) { return face_weight_[f] < kInfinity; });
}

void WeightedMesh::to_caller(std::span<SurfacePoint> points) const {
  fenced_.to_mesh(points);
  domain_.to_mesh(points);
}

}  // namespace brushfire::steiner
