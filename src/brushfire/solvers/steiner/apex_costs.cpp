// Costs around a vertex, spoke by spoke.
#include <brushfire/solvers/steiner/detail/apex_costs.h>

#include <brushfire/core/detail/planar.h>
#include <brushfire/mesh/detail/flat_face.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace brushfire::steiner {
namespace {

// A side of a face is known to some ten epsilons of the ratio of its edges (docs/tolerance.md), and so is its angle.
constexpr double kEachAngle = 32 * std::numeric_limits<double>::epsilon();

// The face of a corner, laid out from there: the edge that leaves it on the x axis.
struct Corner {
  Corner(const Mesh& mesh, Index h)
      : first(mesh.lengths()[h]),
        last(mesh.lengths()[Mesh::previous(h)]),
        across(mesh.lengths()[Mesh::next(h)]),
        area(mesh.double_areas()[Mesh::face_of(h)]) {
    if (first > 0) apex = apex_over_edge(first, last, across, area);
  }
  double ratio() const { return std::max({first, last, across}) / std::min({first, last, across}); }
  // To the edge across: to its line, or beyond a right angle to one of its ends.
  double reach() const {
    const bool is_acute =
        first * first <= last * last + across * across && last * last <= first * first + across * across;
    return is_acute && across > 0 ? area / across : std::min(first, last);
  }

  double first, last, across, area;
  Vec2 apex;
};

// Beside a spoke of cost g, at an angle of this cosine and sine from it.
double beside(double spoke, double weight, double cosine, double sine) {
  if (!(cosine * weight > spoke)) return weight;
  return std::min(weight, spoke * cosine + std::sqrt((weight - spoke) * (weight + spoke)) * sine);
}

}  // namespace

ApexCosts::ApexCosts(const WeightedMesh& weighted, Index v) : weighted_(weighted), vertex_(v) {
  const Mesh& mesh = weighted.mesh();
  for (const Index e : weighted.edges().at(v)) spokes_.push_back({e, weighted.edge_weight(e)});
  std::sort(spokes_.begin(), spokes_.end(), [](const Spoke& a, const Spoke& b) { return a.edge < b.edge; });
  double least = kInfinity, most = 0, ratio = 1;
  for (const Spoke& s : spokes_) {
    if (s.cost < kInfinity) least = std::min(least, s.cost), most = std::max(most, s.cost);
  }
  std::size_t faces = 0;
  for (const Index h : mesh.corners(v)) {
    const double weight = weighted.face_weight(Mesh::face_of(h));
    if (weight == kInfinity) continue;
    const Corner corner(mesh, h);
    if (!mesh.is_face_usable(Mesh::face_of(h)) || !(corner.area > 0)) return;
    most = std::max(most, weight);
    reach_ = std::min(reach_, corner.reach());
    ratio = std::max(ratio, corner.ratio());
    ++faces;
  }
  if (faces == 0 || !(least > 0)) return;
  beyond_ = least * reach_;
  for (const Spoke& s : spokes_) {
    for (const Bridge& b : weighted.bridges(s.edge)) beyond_ = std::min(beyond_, b.cost);
  }
  // An angle that is off turns a spoke's cost by no more than the dearest weight times that.
  rounding_ = kEachAngle * ratio * static_cast<double>(faces) * (most / least);
  spread();
}

std::size_t ApexCosts::place_of(Index edge) const {
  const auto found =
      std::lower_bound(spokes_.begin(), spokes_.end(), edge, [](const Spoke& s, Index e) { return s.edge < e; });
  return static_cast<std::size_t>(found - spokes_.begin());
}

// Spokes tell those beside them, the cheapest first.
void ApexCosts::spread() {
  const Mesh& mesh = weighted_.mesh();
  struct Sector {
    std::size_t from, to;  // spokes
    double weight, cosine, sine;
  };
  std::vector<Sector> sectors;
  for (const Index h : mesh.corners(vertex_)) {
    const double weight = weighted_.face_weight(Mesh::face_of(h));
    if (weight == kInfinity) continue;
    const Corner corner(mesh, h);
    const double cosine = corner.apex.x / corner.last, sine = corner.apex.y / corner.last;
    const std::size_t a = place_of(weighted_.edges().edge(h)), b = place_of(weighted_.edges().edge(Mesh::previous(h)));
    sectors.push_back({a, b, weight, cosine, sine});
    sectors.push_back({b, a, weight, cosine, sine});
  }
  const auto by_spoke = [](const Sector& a, const Sector& b) { return a.from < b.from; };
  std::sort(sectors.begin(), sectors.end(), by_spoke);
  std::priority_queue<std::pair<double, std::size_t>, std::vector<std::pair<double, std::size_t>>, std::greater<>>
      queue;
  for (std::size_t s = 0; s < spokes_.size(); ++s) queue.emplace(spokes_[s].cost, s);
  while (!queue.empty()) {
    const auto [told, spoke] = queue.top();
    queue.pop();
    if (told > spokes_[spoke].cost) continue;
    const auto [first, last] = std::equal_range(sectors.begin(), sectors.end(), Sector{spoke, 0, 0, 0, 0}, by_spoke);
    for (auto s = first; s != last; ++s) {
      const double cost = beside(told, s->weight, s->cosine, s->sine);
      if (!(cost < spokes_[s->to].cost)) continue;
      spokes_[s->to].cost = cost;
      queue.emplace(cost, s->to);
    }
  }
}

ApexCosts::Way ApexCosts::to_apex(Index h, const std::array<double, 3>& weights) const {
  const Mesh& mesh = weighted_.mesh();
  const double weight = weighted_.face_weight(Mesh::face_of(h));
  if (weight == kInfinity) return {kInfinity, false};
  const double to_first = weights[Mesh::next(h) % 3], to_last = weights[Mesh::previous(h) % 3];
  const Corner corner(mesh, h);
  const Vec2 at{to_first * corner.first + to_last * corner.apex.x, to_last * corner.apex.y};
  const double distance = norm(at);
  if (!(distance > 0)) return {0, true};
  const EdgeTable& edges = weighted_.edges();
  const double from_first = spokes_[place_of(edges.edge(h))].cost;
  const double from_last = spokes_[place_of(edges.edge(Mesh::previous(h)))].cost;
  const double cosine = dot(at, corner.apex) / (distance * corner.last);
  const double sine = to_first * corner.first * corner.apex.y / (distance * corner.last);
  const double share =
      std::min(beside(from_first, weight, at.x / distance, at.y / distance), beside(from_last, weight, cosine, sine));
  return {distance * share, distance <= reach_};
}

void NearVertex::add(double offset, const ApexCosts::Way& way, double rounding) {
  lower = std::min(lower, offset + way.cost * (1 - rounding));
  if (way.is_real) upper = std::min(upper, offset + way.cost * (1 + rounding));
}

namespace {

// By costs straight on, of the place's own face.
Index nearest_corner(const Mesh& mesh, const PointLocation& at) {
  const std::array<double, 3> d = corner_distances(mesh, at);
  return mesh.faces()[at.face][static_cast<std::size_t>(std::min_element(d.begin(), d.end()) - d.begin())];
}

// Where a source lies: in a face, or at a vertex.
struct Lies {
  Index at;
  std::size_t source;
  std::array<double, 3> weights;
};

std::span<const Lies> those_at(const std::vector<Lies>& all, Index at) {
  const auto before = [](const Lies& a, const Lies& b) { return a.at < b.at; };
  const auto [first, last] = std::equal_range(all.begin(), all.end(), Lies{at, 0, {}}, before);
  return {first, last};
}

}  // namespace

NearVertices::NearVertices(const WeightedMesh& weighted, std::span<const detail::LocatedSource> sources)
    : of_source(sources.size()) {
  if (detail::any_curve(sources)) return;
  const Mesh& mesh = weighted.mesh();
  std::vector<Lies> in_faces, at_vertices;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const PointLocation& at = sources[s].at;
    if (at.on == PointLocation::On::Vertex) {
      at_vertices.push_back({at.vertex, s, {}});
      continue;
    }
    for (const Index f : faces_at(mesh, at)) {
      if (const auto weights = weights_in(mesh, at, f)) in_faces.push_back({f, s, *weights});
    }
    of_source[s].vertex = nearest_corner(mesh, at);
    bounds.push_back({of_source[s].vertex, kInfinity, kInfinity, 0});
  }
  const auto by_place = [](const Lies& a, const Lies& b) { return a.at < b.at; };
  std::sort(in_faces.begin(), in_faces.end(), by_place);
  std::sort(at_vertices.begin(), at_vertices.end(), by_place);
  const auto by_vertex = [](const NearVertex& a, const NearVertex& b) { return a.vertex < b.vertex; };
  std::sort(bounds.begin(), bounds.end(), by_vertex);
  bounds.erase(std::unique(bounds.begin(), bounds.end(),
                           [](const NearVertex& a, const NearVertex& b) { return a.vertex == b.vertex; }),
               bounds.end());
  for (NearVertex& near : bounds) {
    const ApexCosts costs(weighted, near.vertex);
    if (!costs.is_known()) {
      near.lower = 0;
      continue;
    }
    near.lower = near.beyond = costs.beyond();
    for (const Lies& l : those_at(at_vertices, near.vertex)) near.add(sources[l.source].offset, {0, true}, 0);
    for (const Index h : mesh.corners(near.vertex)) {
      for (const Lies& l : those_at(in_faces, Mesh::face_of(h))) {
        const ApexCosts::Way way = costs.to_apex(h, l.weights);
        near.add(sources[l.source].offset, way, costs.rounding());
        NearVertex& own = of_source[l.source];
        if (own.vertex == near.vertex) own.beyond = near.beyond, own.add(0, way, costs.rounding());
      }
    }
  }
}

const NearVertex* NearVertices::at(Index v) const {
  const auto found =
      std::lower_bound(bounds.begin(), bounds.end(), v, [](const NearVertex& n, Index w) { return n.vertex < w; });
  return found != bounds.end() && found->vertex == v ? &*found : nullptr;
}

}  // namespace brushfire::steiner
