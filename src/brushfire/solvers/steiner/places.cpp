// Frames of edges, and what is around a place.
#include <brushfire/solvers/steiner/detail/places.h>

#include <brushfire/core/detail/planar.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/solvers/steiner/detail/lower_costs.h>

#include <algorithm>
#include <cmath>

namespace brushfire::steiner {
namespace {

// Distances in a face are off by no more than this, for the rounding of coordinates.
double rounding_of(const FaceOver& over) { return kPlaceRounding * std::max(over.length, norm(over.apex)); }

}  // namespace

FaceOver Places::over(Index h) const {
  FaceOver over;
  over.edge = mesh_.edges().edge(h);
  over.face = Mesh::face_of(h);
  over.start = end_of(over.edge, false);
  over.end = end_of(over.edge, true);
  over.length = lengths_[h];
  const bool same_way = faces_[over.face][h % 3] == over.start;
  const Stretches& stretches = mesh_.stretches();
  over.stretch = stretches.along(h);
  const auto length = [&](Index g) { return lengths_[g] * (stretches.along(g) / over.stretch); };
  const double from_start = length(same_way ? Mesh::previous(h) : Mesh::next(h));
  const double from_end = length(same_way ? Mesh::next(h) : Mesh::previous(h));
  const double area = double_areas_[over.face] * (stretches.area(over.face) / (over.stretch * over.stretch));
  over.apex = over.length > 0 ? apex_over_edge(over.length, from_start, from_end, area) : Vec2{from_start, 0};
  if (travel_.pace != nullptr) {
    const Index apex = faces_[over.face][Mesh::previous(h) % 3];
    over.gradient.x = gradient_along(over.edge);
    const double rise = mesh_.height(apex) - mesh_.height(over.start) - over.gradient.x * over.apex.x;
    if (over.apex.y > 0) over.gradient.y = rise / over.apex.y;
  }
  return over;
}

std::vector<RowBeside> Places::beside(const PointLocation& place) const {
  const Mesh& mesh = mesh_.mesh();
  std::vector<RowBeside> rows;
  if (place.on == PointLocation::On::Interior) {
    for (Index k = 0; k < 3; ++k) add_beside(3 * place.face + k, place, rows);
    return rows;
  }
  const Index own = mesh_.edges().edge(place.halfedge);
  const double length = mesh.lengths()[place.halfedge];
  const bool same_way = mesh.from(place.halfedge) == end_of(own, false);
  const double along = (same_way ? place.t : 1 - place.t) * length;
  rows.push_back({own, mesh_.edge_weight(own), {along, 0}, {gradient_along(own), 0}, true, 0});
  for (const Index f : faces_at(mesh, place)) {
    for (Index k = 0; k < 3; ++k) {
      if (mesh_.edges().edge(3 * f + k) != own) add_beside(3 * f + k, place, rows);
    }
  }
  return rows;
}

void Places::add_beside(Index h, const PointLocation& place, std::vector<RowBeside>& rows) const {
  const Mesh& mesh = mesh_.mesh();
  const Index f = Mesh::face_of(h);
  if (!mesh.is_face_usable(f) || mesh_.face_weight(f) == kInfinity) return;
  const FaceOver o = over(h);
  const auto weights = weights_in(mesh, place, f);
  if (!weights) return;
  Vec2 at;
  for (Index k = 0; k < 3; ++k) {
    const Index v = mesh.faces()[f][k];
    if (v == o.end) at = at + (*weights)[k] * Vec2{o.length, 0};
    if (v != o.end && v != o.start) at = at + (*weights)[k] * o.apex;
  }
  rows.push_back({o.edge, mesh_.face_weight(f) * o.stretch, at, o.gradient, false, rounding_of(o)});
}

// Along the place's own edge a lowered cost is the distance from the interval that holds it.
double Places::cost_between(const RowBeside& row, Index i, double sense) const {
  const double* at = layout_.at_row(row.edge);
  if (costs_ == Costs::Real) {
    const Vec2 way = sense * (Vec2{at[i], 0} - row.place);
    return travel_.cost(norm(way), dot(way, row.gradient));
  }
  const Index count = layout_.count(row.edge);
  if (!row.under) return lower_cost(at, count, i, row.place.x, row.place.y, row.rounding);
  const auto above = static_cast<Index>(std::lower_bound(at, at + count, row.place.x) - at);
  if (i >= above) return at[i] - at[std::min(above, count - 1)];
  return above > 0 ? at[above - 1] - at[i] : 0;
}

double Places::gradient_along(Index edge) const {
  const double length = mesh_.mesh().lengths()[mesh_.edges().halfedge(edge)];
  if (travel_.pace == nullptr || length == 0) return 0;
  return (mesh_.height(end_of(edge, true)) - mesh_.height(end_of(edge, false))) / length;
}

ValueAt Places::straight_from(std::span<const detail::LocatedSource> sources, const PointLocation& place) const {
  const Mesh& mesh = mesh_.mesh();
  ValueAt best;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const PointLocation& source = sources[s].at;
    for (const Index f : faces_at(mesh, source)) {
      const auto a = weights_in(mesh, source, f), b = weights_in(mesh, place, f);
      if (!a || !b) continue;
      const double straight = distance_within(mesh, f, *a, *b);
      double weight = mesh_.face_weight(f);
      if (mesh_.stretches().any() && straight > 0) weight *= mesh_.stretches().within(mesh, f, *a, *b) / straight;
      for (Index k = 0; k < 3; ++k) {  // on one edge
        const Index across = (k + 2) % 3;
        if ((*a)[across] == 0 && (*b)[across] == 0) {
          weight = std::min(weight, mesh_.edge_weight(mesh_.edges().edge(3 * f + k)));
        }
      }
      if (weight == kInfinity) continue;
      double rise = 0;
      for (std::size_t k = 0; k < 3 && travel_.pace != nullptr; ++k) {
        rise += ((*b)[k] - (*a)[k]) * mesh_.height(mesh.faces()[f][k]);
      }
      const double value = sources[s].offset + weight * travel_.cost(straight, rise);
      if (value < best.value) best = {value, kFromSource + static_cast<Index>(s)};
    }
  }
  return best;
}

// Lowered costs are linear between the points.
ValueAt Places::between_points(const Front& front, const RowBeside& row) const {
  const double* at = layout_.at_row(row.edge);
  const Index count = layout_.count(row.edge);
  const auto above =
      std::clamp<Index>(static_cast<Index>(std::lower_bound(at, at + count, row.place.x) - at), 1, count - 1);
  const double length = at[above] - at[above - 1], t = length > 0 ? (row.place.x - at[above - 1]) / length : 0;
  const double a = front.value[layout_.row(row.edge) + above - 1], b = front.value[layout_.row(row.edge) + above];
  return {a == b ? a : (1 - t) * a + t * b, layout_.row(row.edge) + above};
}

ValueAt Places::value(const Front& front, std::span<const detail::LocatedSource> sources,
                      const PointLocation& place) const {
  if (place.on == PointLocation::On::Vertex) {
    return {front.vertex_value[place.vertex], front.vertex_parent[place.vertex]};
  }
  ValueAt best = straight_from(sources, place);
  for (const RowBeside& row : beside(place)) {
    if (row.weight == kInfinity) continue;
    if (row.under && costs_ == Costs::Below) {
      const ValueAt between = between_points(front, row);
      if (between.value < best.value) best = between;
      continue;
    }
    for (Index i = 0; i < layout_.count(row.edge); ++i) {
      const double value = front.value[layout_.row(row.edge) + i] + row.weight * cost_to(row, i);
      if (value < best.value) best = {value, layout_.row(row.edge) + i};
    }
  }
  return best;
}

}  // namespace brushfire::steiner
