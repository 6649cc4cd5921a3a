// Stops, legs and where they are; from a search to a strip.
#include <brushfire/queries/detail/strip.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace brushfire::weighted {
namespace {

using steiner::kFromSource;
using steiner::Run;
using steiner::ValueAt;

std::vector<Index> faces_of(const WeightedMesh& mesh, const Stop& stop) {
  std::vector<Index> faces;
  switch (stop.on) {
    case Stop::On::Place:
      return faces_at(mesh.mesh(), stop.place);
    case Stop::On::Vertex:
      for (const Index h : mesh.mesh().corners(stop.vertex_after)) faces.push_back(Mesh::face_of(h));
      break;
    case Stop::On::Edge: {
      const Index begin = mesh.edges().halfedge(stop.edge_after);
      Index h = begin;
      do {
        faces.push_back(Mesh::face_of(h));
        h = mesh.mesh().opposite()[h];
      } while (h != begin);
    }
  }
  return faces;
}

std::vector<Index> edges_of(const WeightedMesh& mesh, const Stop& stop, bool after) {
  switch (stop.on) {
    case Stop::On::Place:
      return stop.place.on == PointLocation::On::Edge ? std::vector{mesh.edges().edge(stop.place.halfedge)}
                                                      : std::vector<Index>{};
    case Stop::On::Vertex: {
      const auto at = mesh.edges().at(after ? stop.vertex_after : stop.vertex);
      return {at.begin(), at.end()};
    }
    case Stop::On::Edge:
      break;
  }
  return {after ? stop.edge_after : stop.edge};
}

// Whether the stop, as it is arrived at, lies on the face.
bool is_on(const WeightedMesh& mesh, const Stop& stop, Index f) {
  switch (stop.on) {
    case Stop::On::Place:
      return weights_in(mesh.mesh(), stop.place, f).has_value();
    case Stop::On::Vertex: {
      const Face& t = mesh.mesh().faces()[f];
      return std::find(t.begin(), t.end(), stop.vertex) != t.end();
    }
    case Stop::On::Edge:
      break;
  }
  for (Index h = 3 * f; h < 3 * f + 3; ++h) {
    if (mesh.edges().edge(h) == stop.edge) return true;
  }
  return false;
}

// A point of the layout on the way back.
struct Step {
  Stop stop;
  Index edge = kNoIndex, number = 0;  // in its row
};

Step step_at(const Run& run, Index point) {
  const Index edge = run.layout->edge_of(point), i = point - run.layout->row(edge);
  const Index h = run.mesh->edges().halfedge(edge);
  if (i == 0) return {at_vertex(run.mesh->mesh().from(h)), edge, i};
  if (i + 1 == run.layout->count(edge)) return {at_vertex(run.mesh->mesh().to(h)), edge, i};
  return {on_edge(edge, run.layout->at(point)), edge, i};
}

Index parent_of(const Run& run, const Step& step) {
  return step.stop.on == Stop::On::Vertex ? run.front.vertex_parent[step.stop.vertex]
                                          : run.front.parent[run.layout->row(step.edge) + step.number];
}

// The bridge that leads from one step to the next; null: a leg does.
const steiner::Bridge* bridge_between(const Run& run, const Step& from, const Stop& to) {
  if (from.edge == kNoIndex) return nullptr;
  for (const steiner::Bridge& bridge : run.mesh->bridges(from.edge)) {
    const Index count = run.layout->count(from.edge), j = bridge.mirrored ? count - 1 - from.number : from.number;
    const Index point = run.layout->row(bridge.to) + j;
    const Step beyond = step_at(run, point);
    if (beyond.stop.on != to.on) continue;
    if (to.on == Stop::On::Vertex ? beyond.stop.vertex == to.vertex && from.stop.vertex != to.vertex
                                  : beyond.stop.edge == to.edge && beyond.stop.at == to.at) {
      return &bridge;
    }
  }
  return nullptr;
}

void cross(Stop& stop, const steiner::Bridge& bridge, const Stop& beyond) {
  stop.toll += bridge.cost;
  stop.vertex_after = beyond.vertex;
  stop.edge_after = beyond.edge;
  stop.mirrored = stop.mirrored != bridge.mirrored;
}

}  // namespace

Stop at_vertex(Index v) {
  Stop stop;
  stop.on = Stop::On::Vertex;
  stop.vertex = stop.vertex_after = v;
  return stop;
}

Stop on_edge(Index e, double at) {
  Stop stop;
  stop.on = Stop::On::Edge;
  stop.edge = stop.edge_after = e;
  stop.at = at;
  return stop;
}

Stop at_place(const PointLocation& place) {
  if (place.on == PointLocation::On::Vertex) return at_vertex(place.vertex);
  Stop stop;
  stop.place = place;
  return stop;
}

StripLeg cheapest_leg(const WeightedMesh& mesh, const Stop& from, const Stop& to) {
  StripLeg best{kNoIndex, kNoIndex, kInfinity};
  const std::vector<Index> theirs = edges_of(mesh, to, false);
  for (const Index e : edges_of(mesh, from, true)) {
    if (mesh.edge_weight(e) < best.weight && std::find(theirs.begin(), theirs.end(), e) != theirs.end()) {
      best = {kNoIndex, e, mesh.edge_weight(e)};
    }
  }
  for (const Index f : faces_of(mesh, from)) {
    if (mesh.face_weight(f) < best.weight && mesh.mesh().is_face_usable(f) && is_on(mesh, to, f)) {
      best = {f, kNoIndex, mesh.face_weight(f)};
    }
  }
  return best;
}

Rail rail(const WeightedMesh& weighted, const StripLeg& leg, const Stop& stop, bool stop_is_first) {
  const Mesh& mesh = weighted.mesh();
  if (leg.face == kNoIndex) {
    const Index h = weighted.edges().halfedge(leg.edge);
    const double length = mesh.lengths()[h];
    if (stop.on == Stop::On::Vertex) {
      return {{(stop_is_first ? stop.vertex_after : stop.vertex) == mesh.from(h) ? 0 : length, 0}, {}};
    }
    if (stop.on == Stop::On::Place) {
      const bool same_way = mesh.from(stop.place.halfedge) == mesh.from(h);
      return {{(same_way ? stop.place.t : 1 - stop.place.t) * length, 0}, {}};
    }
    return stop_is_first && stop.mirrored ? Rail{{length, 0}, {-1, 0}} : Rail{{0, 0}, {1, 0}};
  }
  const std::array<Vec2, 3> corners = flat_corners(mesh, leg.face);
  const Face& t = mesh.faces()[leg.face];
  const auto corner = [&](Index v) {
    return corners[static_cast<std::size_t>(std::find(t.begin(), t.end(), v) - t.begin()) % 3];
  };
  if (stop.on == Stop::On::Vertex) return {corner(stop_is_first ? stop.vertex_after : stop.vertex), {}};
  if (stop.on == Stop::On::Place) {
    const auto weights = weights_in(mesh, stop.place, leg.face);
    Vec2 at;
    for (std::size_t k = 0; weights && k < 3; ++k) at = at + (*weights)[k] * corners[k];
    return {at, {}};
  }
  const Index edge = stop_is_first ? stop.edge_after : stop.edge, h = weighted.edges().halfedge(edge);
  const double length = mesh.lengths()[h];
  const Vec2 start = corner(mesh.from(h)), end = corner(mesh.to(h));
  const Vec2 direction = length > 0 ? (1 / length) * (end - start) : Vec2{};
  return stop_is_first && stop.mirrored ? Rail{end, -1.0 * direction} : Rail{start, direction};
}

double length_of(const WeightedMesh& mesh, const Strip& strip, std::size_t leg) {
  const Rail a = rail(mesh, strip.legs[leg], strip.stops[leg], true);
  const Rail b = rail(mesh, strip.legs[leg], strip.stops[leg + 1], false);
  const double at_a = strip.stops[leg].at, at_b = strip.stops[leg + 1].at;
  return norm(b.origin + at_b * b.direction - (a.origin + at_a * a.direction));
}

double cost_of(const WeightedMesh& mesh, const Strip& strip) {
  double cost = 0;
  for (std::size_t k = 0; k < strip.legs.size(); ++k) cost += strip.legs[k].weight * length_of(mesh, strip, k);
  for (const Stop& stop : strip.stops) cost += stop.toll;
  return cost;
}

Strip trace(const Run& run, const PointLocation& target, const ValueAt& value) {
  if (value.parent == kNoIndex) return {};
  std::vector<Step> back{{at_place(target), kNoIndex, 0}};
  Index parent = value.parent;
  Poll poll;
  while (parent < kFromSource) {
    poll();
    back.push_back(step_at(run, parent));
    parent = parent_of(run, back.back());
  }
  const Stop source = at_place(run.sources[parent - kFromSource].at);
  if (source.on == Stop::On::Place) back.push_back({source, kNoIndex, 0});
  Strip strip;
  for (std::size_t i = back.size(); i-- > 0;) {
    if (!strip.stops.empty()) {
      if (const steiner::Bridge* bridge = bridge_between(run, back[i + 1], back[i].stop)) {
        cross(strip.stops.back(), *bridge, back[i].stop);
        continue;
      }
      strip.legs.push_back(cheapest_leg(*run.mesh, strip.stops.back(), back[i].stop));
      if (strip.legs.back().weight == kInfinity) {
        throw Error(ErrorCode::Internal, "a weighted path has lost its way: please report it");
      }
    }
    strip.stops.push_back(back[i].stop);
  }
  return strip;
}

}  // namespace brushfire::weighted
