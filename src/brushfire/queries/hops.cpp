// Past the vertices of a path: which edges it crosses may change there.
#include <brushfire/queries/detail/strip.h>

#include <brushfire/core/cancel.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace brushfire::weighted {
namespace {

// Stops nearer to an end of their edge than this share of it have been driven there; nearer than that, they may have
// been.
constexpr double kAtVertex = 1e-7, kNearVertex = 1e-2;
// Another path is taken where it is cheaper by more than the minimum of straighten() is off.
constexpr double kCheaper = 1e-13;
constexpr std::size_t kMostSpokes = 256;

double edge_length(const WeightedMesh& mesh, Index e) { return mesh.mesh().lengths()[mesh.edges().halfedge(e)]; }

// The vertex that a stop is at, within a share of its edge; kNoIndex: none, or a fence is crossed there.
Index vertex_near(const WeightedMesh& mesh, const Stop& stop, double share) {
  if (stop.toll > 0 || stop.on == Stop::On::Place) return kNoIndex;
  if (stop.on == Stop::On::Vertex) return stop.vertex;
  const double length = edge_length(mesh, stop.edge);
  const Index h = mesh.edges().halfedge(stop.edge);
  if (stop.at <= share * length) return mesh.mesh().from(h);
  return stop.at >= (1 - share) * length ? mesh.mesh().to(h) : kNoIndex;
}

// What has come to an end of its edge is at the vertex.
void snap(const WeightedMesh& mesh, Stop& stop) {
  const Index v = vertex_near(mesh, stop, kAtVertex);
  if (v != kNoIndex) stop = at_vertex(v);
}

bool is_same_place(const Stop& a, const Stop& b) {
  if (a.on != b.on || a.toll > 0 || b.toll > 0) return false;
  if (a.on == Stop::On::Vertex) return a.vertex == b.vertex;
  return a.on == Stop::On::Edge && a.edge == b.edge && a.at == b.at;
}

// Legs along one edge are one leg.
void join_roads(Strip& strip) {
  Strip joined;
  joined.stops.push_back(strip.stops.front());
  for (std::size_t k = 0; k < strip.legs.size(); ++k) {
    const Stop& last = joined.stops.back();
    const bool goes_on = !joined.legs.empty() && joined.legs.back().face == kNoIndex &&
                         joined.legs.back().edge == strip.legs[k].edge && last.slides() && last.toll == 0;
    if (goes_on) {
      joined.stops.back() = strip.stops[k + 1];
    } else {
      joined.legs.push_back(strip.legs[k]);
      joined.stops.push_back(strip.stops[k + 1]);
    }
  }
  strip = std::move(joined);
}

// Stops at vertices are those vertices, and no two after one another are the same.
void tidy(const WeightedMesh& mesh, Strip& strip) {
  for (Stop& stop : strip.stops) snap(mesh, stop);
  Strip tidied;
  tidied.stops.push_back(strip.stops.front());
  for (std::size_t k = 1; k < strip.stops.size(); ++k) {
    Stop& last = tidied.stops.back();
    const bool is_end = k + 1 == strip.stops.size();
    if (is_same_place(last, strip.stops[k]) && !(is_end && tidied.stops.size() == 1)) {
      last = strip.stops[k];
      continue;
    }
    tidied.legs.push_back(cheapest_leg(mesh, last, strip.stops[k]));
    if (!(tidied.legs.back().weight <= strip.legs[k - 1].weight)) tidied.legs.back() = strip.legs[k - 1];
    tidied.stops.push_back(strip.stops[k]);
  }
  strip = std::move(tidied);
  join_roads(strip);
}

// A stop on an edge that is cheaper than both faces beside it may become two, with a leg along the edge between them.
void add_roads(const WeightedMesh& mesh, Strip& strip) {
  Strip wider;
  wider.stops.push_back(strip.stops.front());
  for (std::size_t k = 1; k < strip.stops.size(); ++k) {
    wider.legs.push_back(strip.legs[k - 1]);
    const Stop& stop = strip.stops[k];
    wider.stops.push_back(stop);
    if (stop.on != Stop::On::Edge || stop.toll > 0 || k + 1 == strip.stops.size()) continue;
    const double weight = mesh.edge_weight(stop.edge);
    if (weight < std::min(strip.legs[k - 1].weight, strip.legs[k].weight)) {
      wider.legs.push_back({kNoIndex, stop.edge, weight});
      wider.stops.push_back(stop);
    }
  }
  strip = std::move(wider);
}

// The halfedge at v of a face.
std::optional<Index> corner_of(const Mesh& mesh, Index f, Index v) {
  for (Index h = 3 * f; h < 3 * f + 3; ++h) {
    if (mesh.from(h) == v) return h;
  }
  return std::nullopt;
}

// Goes around a vertex from one leg to another, one way or the other; each leg lies in a face at the vertex, or along
// an edge at it.
class Turn {
 public:
  Turn(const WeightedMesh& mesh, Index v) : mesh_(mesh), v_(v) {}

  // In place of [leg a, the vertex, leg b]: [leg a, stops on edges with legs between, leg b]. Nothing where a boundary,
  // a wall, or an edge of more than two faces is in the way.
  std::optional<Strip> around(const StripLeg& a, const StripLeg& b, bool other_way) {
    strip_ = {};
    strip_.legs.push_back(a);
    Index face = a.face, way_in = kNoIndex;
    if (face == kNoIndex) {
      strip_.stops.push_back(near_vertex(a.edge));
      Index h = mesh_.edges().halfedge(a.edge);
      if (other_way && mesh_.mesh().neighbour(h) == h) return std::nullopt;
      if (other_way) h = mesh_.mesh().neighbour(h);
      face = Mesh::face_of(h);
      way_in = a.edge;
      if (!enter(face)) return std::nullopt;
    }
    for (std::size_t i = 0; i < kMostSpokes; ++i) {
      if (face == b.face) {
        strip_.legs.back() = strip_.legs.size() == 1 ? a : b;
        return strip_;
      }
      const std::optional<Index> corner = corner_of(mesh_.mesh(), face, v_);
      if (!corner) return std::nullopt;
      const Index out = way_out(*corner, way_in, other_way);
      const Index edge = mesh_.edges().edge(out);
      strip_.stops.push_back(near_vertex(edge));
      if (edge == b.edge) {
        strip_.legs.push_back(b);
        return strip_;
      }
      const Index beyond = mesh_.mesh().neighbour(out);
      if (beyond == out) return std::nullopt;
      face = Mesh::face_of(beyond);
      way_in = edge;
      if (!enter(face)) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  bool enter(Index f) {
    const double weight = mesh_.face_weight(f);
    strip_.legs.push_back({f, kNoIndex, weight});
    return weight < kInfinity && mesh_.mesh().is_face_usable(f);
  }

  // The halfedge of the face, at the vertex, that is not over the edge it was entered by.
  Index way_out(Index corner, Index way_in, bool other_way) const {
    const Index a = corner, b = Mesh::previous(corner);
    if (way_in == kNoIndex) return other_way ? b : a;
    return mesh_.edges().edge(a) == way_in ? b : a;
  }

  Stop near_vertex(Index e) const {
    constexpr double kNear = 0.05;
    const double length = edge_length(mesh_, e);
    const bool at_start = mesh_.mesh().from(mesh_.edges().halfedge(e)) == v_;
    return on_edge(e, at_start ? kNear * length : (1 - kNear) * length);
  }

  const WeightedMesh& mesh_;
  Index v_;
  Strip strip_;
};

// The part of a strip from stop `first` to stop `last`.
Strip part_of(const Strip& strip, std::size_t first, std::size_t last) {
  const auto stops = strip.stops.begin();
  Strip part;
  part.stops.assign(stops + static_cast<std::ptrdiff_t>(first), stops + static_cast<std::ptrdiff_t>(last) + 1);
  part.legs.assign(strip.legs.begin() + static_cast<std::ptrdiff_t>(first),
                   strip.legs.begin() + static_cast<std::ptrdiff_t>(last));
  return part;
}

void replace(Strip& strip, std::size_t first, std::size_t last, const Strip& by) {
  const auto stop = strip.stops.begin() + static_cast<std::ptrdiff_t>(first);
  strip.stops.erase(stop, strip.stops.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  strip.stops.insert(strip.stops.begin() + static_cast<std::ptrdiff_t>(first), by.stops.begin(), by.stops.end());
  strip.legs.erase(strip.legs.begin() + static_cast<std::ptrdiff_t>(first),
                   strip.legs.begin() + static_cast<std::ptrdiff_t>(last));
  strip.legs.insert(strip.legs.begin() + static_cast<std::ptrdiff_t>(first), by.legs.begin(), by.legs.end());
}

// The part with what goes around a vertex in place of its stops from i to j.
Strip with_turn(const Strip& part, std::size_t i, std::size_t j, const Strip& turn) {
  Strip result = part_of(part, 0, i - 1);
  const Strip rest = part_of(part, j + 1, part.stops.size() - 1);
  result.stops.insert(result.stops.end(), turn.stops.begin(), turn.stops.end());
  result.legs.insert(result.legs.end(), turn.legs.begin(), turn.legs.end());
  result.stops.insert(result.stops.end(), rest.stops.begin(), rest.stops.end());
  result.legs.insert(result.legs.end(), rest.legs.begin(), rest.legs.end());
  return result;
}

// Tries to go another way past the vertex v, which stops i to j are at or near; between the nearest stops on either
// side that do not slide nothing else changes. Returns that stop before it, where it was cheaper.
std::optional<std::size_t> hop(const WeightedMesh& mesh, Strip& strip, Index v, std::size_t i, std::size_t j) {
  std::size_t first = i - 1, last = j + 1;
  while (first > 0 && strip.stops[first].slides()) --first;
  while (last + 1 < strip.stops.size() && strip.stops[last].slides()) ++last;
  const Strip part = part_of(strip, first, last);
  const double cost = cost_of(mesh, part);
  for (const bool other_way : {false, true}) {
    const auto turn = Turn(mesh, v).around(strip.legs[i - 1], strip.legs[j], other_way);
    if (!turn) continue;
    Strip tried = with_turn(part, i - first, j - first, *turn);
    add_roads(mesh, tried);
    straighten(mesh, tried);
    tidy(mesh, tried);
    if (cost_of(mesh, tried) >= cost * (1 - kCheaper)) continue;
    replace(strip, first, last, tried);
    return first;
  }
  return std::nullopt;
}

}  // namespace

double make_locally_shortest(const WeightedMesh& mesh, Strip& strip) {
  if (strip.legs.empty()) return cost_of(mesh, strip);
  join_roads(strip);
  add_roads(mesh, strip);
  straighten(mesh, strip);
  tidy(mesh, strip);
  // Every hop lowers the cost, so that this ends; it goes back to what the hop may have changed.
  Poll poll(16);
  for (std::size_t k = 1; k + 1 < strip.stops.size();) {
    poll();
    const Index v = vertex_near(mesh, strip.stops[k], kNearVertex);
    std::size_t last = k;
    while (v != kNoIndex && last + 2 < strip.stops.size() &&
           vertex_near(mesh, strip.stops[last + 1], kNearVertex) == v) {
      ++last;
    }
    const std::optional<std::size_t> before = v != kNoIndex ? hop(mesh, strip, v, k, last) : std::nullopt;
    k = before ? std::max<std::size_t>(1, *before) : last + 1;
  }
  return cost_of(mesh, strip);
}

}  // namespace brushfire::weighted
