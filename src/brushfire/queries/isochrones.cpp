// Every face's share of a region is a polygon; what no two of them have in common is the region's rim.
#include <brushfire/queries/isochrones.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/decimal.h>
#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

namespace brushfire {
namespace {

// A vertex, or where the level crosses an edge (numbered by the lowest of its halfedges, behind the vertices).
using Node = std::uint64_t;

class Rim {
 public:
  Rim(const Mesh& mesh, std::span<const double> values, double level) : mesh_(mesh), values_(values), level_(level) {
    Poll poll;
    for (Index f = 0; f < mesh.face_count(); ++f) {
      poll();
      if (counts(f)) add(f);
    }
  }

  std::vector<MapRing> rings() {
    std::vector<MapRing> rings;
    while (!next_.empty()) {
      MapRing ring;
      const Node begin = next_.begin()->first;
      Node node = begin;
      do {
        ring.push_back(place(node));
        node = take(node);
      } while (node != begin);
      rings.push_back(std::move(ring));
    }
    return rings;
  }

 private:
  bool counts(Index f) const {
    const Face& t = mesh_.faces()[f];
    return mesh_.is_face_usable(f) && std::all_of(t.begin(), t.end(), [&](Index v) { return values_[v] < kInfinity; });
  }
  bool is_below(Index v) const { return values_[v] < level_; }

  Node crossing(Index h) const { return Node{mesh_.vertex_count()} + std::min(h, mesh_.neighbour(h)); }

  std::array<double, 2> place(Node node) const {
    if (node < mesh_.vertex_count()) {
      const Vec3 p = mesh_.positions()[static_cast<Index>(node)];
      return {p.x, p.y};
    }
    const auto h = static_cast<Index>(node - mesh_.vertex_count());
    const Index a = mesh_.from(h), b = mesh_.to(h);
    const double t = (level_ - values_[a]) / (values_[b] - values_[a]);
    const Vec3 p = (1 - t) * mesh_.positions()[a] + t * mesh_.positions()[b];
    return {p.x, p.y};
  }

  // Along its edges where no other face goes on, and straight from where the level leaves the face to where it enters.
  void add(Index f) {
    std::optional<Node> out, in;
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      const Index a = mesh_.from(h), b = mesh_.to(h), other = mesh_.neighbour(h);
      const bool is_rim = other == h || !counts(Mesh::face_of(other));
      if (is_below(a) && !is_below(b)) out = crossing(h);
      if (!is_below(a) && is_below(b)) in = crossing(h);
      if (!is_rim || (!is_below(a) && !is_below(b))) continue;
      join(is_below(a) ? Node{a} : crossing(h), is_below(b) ? Node{b} : crossing(h));
    }
    if (out && in) join(*out, *in);
  }

  void join(Node a, Node b) { next_[a].push_back(b); }

  Node take(Node node) {
    const auto found = next_.find(node);
    const Node next = found->second.back();
    found->second.pop_back();
    if (found->second.empty()) next_.erase(found);
    return next;
  }

  const Mesh& mesh_;
  std::span<const double> values_;
  double level_;
  std::map<Node, std::vector<Node>> next_;
};

double area(const MapRing& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto& [x, y] = ring[i];
    const auto& [u, v] = ring[(i + 1) % ring.size()];
    sum += (x - ring[0][0]) * (v - ring[0][1]) - (u - ring[0][0]) * (y - ring[0][1]);
  }
  return 0.5 * sum;
}

bool holds(const MapRing& ring, const std::array<double, 2>& point) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto& [x, y] = ring[i];
    const auto& [u, v] = ring[(i + 1) % ring.size()];
    if ((y > point[1]) != (v > point[1]) && point[0] < x + (point[1] - y) / (v - y) * (u - x)) inside = !inside;
  }
  return inside;
}

// As few digits as it takes to read the same number back.
std::string exactly(double value) {
  std::array<char, detail::kLongestDecimal> text;
  return {text.data(), detail::write_shortest(text.data(), value)};
}

std::string json_of(const MapRing& ring) {
  std::string text = "[";
  for (std::size_t i = 0; i <= ring.size(); ++i) {
    const auto& [x, y] = ring[i % ring.size()];
    text += (i > 0 ? ",[" : "[") + exactly(x) + "," + exactly(y) + "]";
  }
  return text + "]";
}

}  // namespace

std::vector<MapPolygon> isochrone(const Domain& domain, std::span<const double> values, double level) {
  const Mesh& mesh = domain.open();
  const std::vector<double> on_open = domain.spread(values);
  if (!mesh.has_positions()) throw Error(ErrorCode::InvalidArgument, "a mesh from lengths is no map");
  if (!std::isfinite(level))
    throw Error(ErrorCode::InvalidArgument, "level " + number_as_text(level) + " is not finite");
  std::vector<MapPolygon> polygons;
  std::vector<MapRing> holes;
  for (MapRing& ring : Rim(mesh, on_open, level).rings()) {
    if (area(ring) > 0)
      polygons.push_back({std::move(ring), {}});
    else if (area(ring) < 0)
      holes.push_back(std::move(ring));
  }
  for (MapRing& hole : holes) {  // goes into the smallest ring around it
    MapPolygon* around = nullptr;
    for (MapPolygon& p : polygons) {
      const bool smaller = around == nullptr || area(p.outer) < area(around->outer);
      if (smaller && holds(p.outer, hole.front())) around = &p;
    }
    if (around != nullptr) around->holes.push_back(std::move(hole));
  }
  return polygons;
}

std::string isochrones_as_geojson(const Domain& domain, std::span<const double> values,
                                  std::span<const double> levels) {
  std::string text = "{\"type\":\"FeatureCollection\",\"features\":[";
  for (std::size_t k = 0; k < levels.size(); ++k) {
    text += std::string(k > 0 ? "," : "") + "\n{\"type\":\"Feature\",\"properties\":{\"level\":" + exactly(levels[k]) +
            "},\"geometry\":{\"type\":\"MultiPolygon\",\"coordinates\":[";
    bool first = true;
    for (const MapPolygon& polygon : isochrone(domain, values, levels[k])) {
      text += std::string(first ? "" : ",") + "[" + json_of(polygon.outer);
      for (const MapRing& hole : polygon.holes) text += "," + json_of(hole);
      text += "]";
      first = false;
    }
    text += "]}}";
  }
  return text + "\n]}\n";
}

}  // namespace brushfire
