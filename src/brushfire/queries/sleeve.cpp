// Unfolding of sleeves, shortest paths in them, ways around vertices.
//
// Based on: Lee, Preparata, "Euclidean shortest paths in the presence of rectilinear barriers", 1984 (the funnel).
#include <brushfire/queries/detail/sleeve.h>

#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/mesh/detail/wide_face.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace brushfire::detail {
namespace {

using On = PointLocation::On;

PointLocation at_vertex(const Mesh& mesh, Index vertex, Index face) {
  PointLocation at;
  at.on = On::Vertex;
  at.vertex = vertex;
  at.face = face;
  const Face& t = mesh.faces()[face];
  at.weights[static_cast<std::size_t>(std::find(t.begin(), t.end(), vertex) - t.begin())] = 1;
  return at;
}

bool lies_in(const Mesh& mesh, const PointLocation& point, Index face) {
  return weights_in(mesh, point, face).has_value();
}

Index longest_halfedge(const Mesh& mesh, Index f) {
  Index longest = 3 * f;
  for (const Index h : {3 * f + 1, 3 * f + 2}) {
    if (mesh.length(h) > mesh.length(longest)) longest = h;
  }
  return longest;
}

// A sleeve laid out in the plane, its beginning in the origin: the edge of every step, seen by someone who walks along,
// and the end. In 106 bits: faces of a sleeve may be of very different sizes.
struct Unfolded {
  struct Portal {
    WideVec2 left, right;
    bool left_is_from = false;  // whether the left end is the vertex that `out` starts from
  };
  std::vector<Portal> portals;
  WideVec2 end;
};

Unfolded unfold(const Mesh& mesh, const Sleeve& sleeve) {
  Unfolded flat;
  flat.portals.reserve(sleeve.steps.size());
  std::array<WideVec2, 3> corners =
      wide_corners(mesh, sleeve.first_face, longest_halfedge(mesh, sleeve.first_face) % 3);
  bool mirrored = false;  // whether the present face lies clockwise
  const WideVec2 begin = wide_point(corners, *weights_in(mesh, sleeve.begin, sleeve.first_face));
  for (WideVec2& corner : corners) corner = corner - begin;
  for (const Step& step : sleeve.steps) {
    const WideVec2 from = corners[step.out % 3], to = corners[Mesh::next(step.out) % 3];
    // Leaving a counter-clockwise face, the edge's far end lies to the left.
    flat.portals.push_back(mirrored ? Unfolded::Portal{from, to, true} : Unfolded::Portal{to, from, false});
    const bool same_start = mesh.from(step.in) == mesh.from(step.out);
    mirrored = mirrored != same_start;
    const WideVec2 u = same_start ? from : to, v = same_start ? to : from;
    const WideVec2 apex = wide_frame(mesh, step.in).apex;
    // Not by the edge's own length: keeps rounding from turning into a change of scale.
    const WideVec2 along = (DoubleDouble(1) / norm(v - u)) * (v - u);
    const WideVec2 inward = mirrored ? WideVec2{along.y, -along.x} : WideVec2{-along.y, along.x};
    corners[step.in % 3] = u;
    corners[Mesh::next(step.in) % 3] = v;
    corners[Mesh::previous(step.in) % 3] = u + apex.x * along + apex.y * inward;
  }
  flat.end = wide_point(corners, *weights_in(mesh, sleeve.end, sleeve.last_face()));
  return flat;
}

double turn(WideVec2 a, WideVec2 b) { return cross(a, b).high; }

// Where the shortest path from the beginning has to bend first: the step whose edge ends in that vertex.
struct Bend {
  std::size_t step;
  bool left;
};

std::optional<Bend> first_bend(const Unfolded& flat) {
  WideVec2 left, right;  // the funnel's sides
  std::size_t left_step = 0, right_step = 0;
  bool open = false;
  for (std::size_t i = 0; i <= flat.portals.size(); ++i) {
    const bool last = i == flat.portals.size();
    const WideVec2 l = last ? flat.end : flat.portals[i].left;
    const WideVec2 r = last ? flat.end : flat.portals[i].right;
    if (!open) {
      left = l;
      right = r;
      left_step = right_step = i;
      open = true;
      continue;
    }
    if (turn(right, r) >= 0) {  // the right side moves in
      if (turn(left, r) > 0) return Bend{left_step, true};
      right = r;
      right_step = i;
    }
    if (turn(left, l) <= 0) {
      if (turn(right, l) < 0) return Bend{right_step, false};
      left = l;
      left_step = i;
    }
  }
  return std::nullopt;
}

Index vertex_of(const Mesh& mesh, const Sleeve& sleeve, const Unfolded& flat, const Bend& bend) {
  const Index out = sleeve.steps[bend.step].out;
  return flat.portals[bend.step].left_is_from == bend.left ? mesh.from(out) : mesh.to(out);
}

// Where the line from begin to end crosses a step's edge.
Crossing crossing_of(const Unfolded& flat, std::size_t step) {
  const Unfolded::Portal& portal = flat.portals[step];
  const DoubleDouble l = cross(flat.end, portal.left), r = cross(flat.end, portal.right);
  double at_left = 1, at_right = 0;
  if (l.high > 0 && r.high < 0) {
    at_left = (r / (r - l)).high;
    at_right = (l / (l - r)).high;
  } else if (std::abs(l.high) > std::abs(r.high)) {
    std::swap(at_left, at_right);  // the line runs over the right end, or by rounding beyond it
  }
  return portal.left_is_from ? Crossing{at_left, at_right} : Crossing{at_right, at_left};
}

// Splits the sleeve at a vertex of the edge of step `i`: the part before (returned) and the part after (left in
// `sleeve`).
Sleeve split_off(const Mesh& mesh, Sleeve& sleeve, std::size_t i, Index vertex) {
  Sleeve before;
  before.begin = sleeve.begin;
  before.first_face = sleeve.first_face;
  before.steps.assign(sleeve.steps.begin(), sleeve.steps.begin() + static_cast<std::ptrdiff_t>(i));
  before.end = at_vertex(mesh, vertex, Mesh::face_of(sleeve.steps[i].out));
  sleeve.first_face = Mesh::face_of(sleeve.steps[i].in);
  sleeve.begin = at_vertex(mesh, vertex, sleeve.first_face);
  sleeve.steps.erase(sleeve.steps.begin(), sleeve.steps.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  tidy(mesh, before);
  tidy(mesh, sleeve);
  return before;
}

// The first step whose edge the line crosses at a vertex: so near to it, for someone at either end, that going through
// it makes no bend that can be told from straight.
std::optional<Bend> first_touch(const Unfolded& flat) {
  const double length = norm(flat.end).high;
  const auto touches = [&](WideVec2 p) {
    const double along = dot(flat.end, p).high / length, aside = std::abs(cross(flat.end, p).high) / length;
    return aside <= kTouch * std::min(along, length - along);
  };
  for (std::size_t i = 0; length > 0 && i < flat.portals.size(); ++i) {
    if (touches(flat.portals[i].left)) return Bend{i, true};
    if (touches(flat.portals[i].right)) return Bend{i, false};
  }
  return std::nullopt;
}

// Over an edge without length there is no "straight": the path goes through one of its vertices.
std::optional<std::size_t> zero_length_step(const Mesh& mesh, const Sleeve& sleeve) {
  for (std::size_t i = 0; i < sleeve.steps.size(); ++i) {
    if (mesh.lengths()[sleeve.steps[i].out] == 0) return i;
  }
  return std::nullopt;
}

}  // namespace

void tidy(const Mesh& mesh, Sleeve& sleeve) {
  std::vector<Step> kept;
  for (const Step& step : sleeve.steps) {
    if (kept.empty() || kept.back().in != step.out) {
      kept.push_back(step);
    } else if (kept.back().out == step.in) {
      kept.pop_back();  // over the edge and back
    } else {
      kept.back().in = step.in;  // over an edge of several faces and at once on to the third
    }
  }
  std::size_t first = 0, last = kept.size();
  while (first < last && lies_in(mesh, sleeve.begin, Mesh::face_of(kept[first].in))) {
    sleeve.first_face = Mesh::face_of(kept[first++].in);
  }
  while (last > first && lies_in(mesh, sleeve.end, Mesh::face_of(kept[last - 1].out))) --last;
  sleeve.steps.assign(kept.begin() + static_cast<std::ptrdiff_t>(first),
                      kept.begin() + static_cast<std::ptrdiff_t>(last));
}

std::vector<StraightPiece> shortest_in_sleeve(const Mesh& mesh, Sleeve sleeve) {
  std::vector<StraightPiece> pieces;
  std::vector<Sleeve> waiting;  // the last one comes first
  tidy(mesh, sleeve);
  waiting.push_back(std::move(sleeve));
  while (!waiting.empty()) {
    Sleeve now = std::move(waiting.back());
    waiting.pop_back();
    std::optional<std::pair<std::size_t, Index>> split;
    StraightPiece straight;
    if (const auto step = zero_length_step(mesh, now)) {
      split = {*step, mesh.from(now.steps[*step].out)};
    } else {
      const Unfolded flat = unfold(mesh, now);
      std::optional<Bend> bend = first_bend(flat);
      if (!bend) bend = first_touch(flat);
      if (bend) {
        split = {bend->step, vertex_of(mesh, now, flat, *bend)};
      } else {
        straight.sleeve = now;
        straight.length = norm(flat.end);
        for (std::size_t i = 0; i < now.steps.size(); ++i) straight.crossing.push_back(crossing_of(flat, i));
      }
    }
    if (split) {
      Sleeve before = split_off(mesh, now, split->first, split->second);
      waiting.push_back(std::move(now));
      waiting.push_back(std::move(before));
    } else {
      pieces.push_back(std::move(straight));
    }
  }
  return pieces;
}

void append_points(const Mesh& mesh, const StraightPiece& straight, std::vector<SurfacePoint>& points) {
  const auto append = [&](SurfacePoint p) {
    if (!points.empty()) {
      const PointLocation a = locate(mesh, points.back(), 0), b = locate(mesh, p, 0);
      if (const auto w = weights_in(mesh, a, b.face); w && *w == b.weights) return;
    }
    points.push_back(p);
  };
  append({straight.sleeve.begin.face, straight.sleeve.begin.weights});
  for (std::size_t i = 0; i < straight.crossing.size(); ++i) {
    const Index h = straight.sleeve.steps[i].out;
    SurfacePoint p{Mesh::face_of(h), {0, 0, 0}};
    p.weights[h % 3] = straight.crossing[i].from;
    p.weights[Mesh::next(h) % 3] = straight.crossing[i].to;
    append(p);
  }
  append({straight.sleeve.end.face, straight.sleeve.end.weights});
}

namespace {

// From coordinates: sides of one vertex keep all digits, however thin the face, which lengths do not.
Vec3 side_of(const Mesh& mesh, Index from, Index to) {
  return (1 / mesh.unit()) * (mesh.positions()[to] - mesh.positions()[from]);
}
double angle_between(Vec3 a, Vec3 b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }
double corner_angle(const Mesh& mesh, Index corner) {
  if (!mesh.has_positions()) return mesh.corner_angle(corner);
  const Index v = mesh.from(corner);
  return angle_between(side_of(mesh, v, mesh.to(corner)), side_of(mesh, v, mesh.from(Mesh::previous(corner))));
}

}  // namespace

Direction direction_towards(const Mesh& mesh, Index vertex, Index f, const std::array<double, 3>& point) {
  const Face& t = mesh.faces()[f];
  const auto k = static_cast<std::size_t>(std::find(t.begin(), t.end(), vertex) - t.begin());
  std::array<double, 3> own{0, 0, 0};
  own[k] = 1;
  const Index corner = 3 * f + static_cast<Index>(k);
  const double full = corner_angle(mesh, corner);
  if (mesh.has_positions()) {
    const Vec3 ahead = side_of(mesh, vertex, t[(k + 1) % 3]), behind = side_of(mesh, vertex, t[(k + 2) % 3]);
    const Vec3 d = point[(k + 1) % 3] * ahead + point[(k + 2) % 3] * behind;
    return {corner, std::min(angle_between(ahead, d), full)};
  }
  const std::array<Vec2, 3> corners = flat_corners(mesh, f);
  const Vec2 d = flat_difference(corners, own, point), side = corners[(k + 1) % 3] - corners[k];
  return {corner, std::clamp(std::atan2(cross(side, d), dot(side, d)), 0.0, full)};
}

namespace {

std::array<double, 3> weights_on(Index h, const Crossing& at) {
  std::array<double, 3> w{0, 0, 0};
  w[h % 3] = at.from;
  w[Mesh::next(h) % 3] = at.to;
  return w;
}

}  // namespace

std::array<double, 3> point_after_begin(const Mesh& mesh, const StraightPiece& straight) {
  if (straight.sleeve.steps.empty()) return *weights_in(mesh, straight.sleeve.end, straight.sleeve.first_face);
  return weights_on(straight.sleeve.steps.front().out, straight.crossing.front());
}

std::array<double, 3> point_before_end(const Mesh& mesh, const StraightPiece& straight) {
  if (straight.sleeve.steps.empty()) return *weights_in(mesh, straight.sleeve.begin, straight.sleeve.first_face);
  const Step& last = straight.sleeve.steps.back();
  const Crossing& at = straight.crossing.back();
  return weights_on(last.in, mesh.from(last.in) == mesh.from(last.out) ? at : Crossing{at.to, at.from});
}

Direction direction_at_begin(const Mesh& mesh, const StraightPiece& straight) {
  return direction_towards(mesh, straight.sleeve.begin.vertex, straight.sleeve.first_face,
                           point_after_begin(mesh, straight));
}

Direction direction_at_end(const Mesh& mesh, const StraightPiece& straight) {
  return direction_towards(mesh, straight.sleeve.end.vertex, straight.sleeve.last_face(),
                           point_before_end(mesh, straight));
}

// Dijkstra on the link: its nodes are the edges at the vertex (by their other end), its arcs the corners.
WayAround shortest_way_around(const Mesh& mesh, Index vertex, const Direction& from, const Direction& to) {
  struct Node {
    double angle = kInfinity;
    Index through = kNoIndex;  // the corner through which it was reached
    Index before = kNoIndex;   // the edge before, kNoIndex: the beginning
    bool done = false;
  };
  std::map<Index, Node> nodes;
  using Entry = std::tuple<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto offer = [&](Index edge, double angle, Index through, Index before) {
    Node& n = nodes[edge];
    if (angle < n.angle) {
      n.angle = angle;
      n.through = through;
      n.before = before;
      queue.emplace(angle, edge);
    }
  };
  const auto ahead = [&](Index corner) { return mesh.to(corner); };  // the edge that `corner` runs along
  const auto behind = [&](Index corner) { return mesh.from(Mesh::previous(corner)); };  // the corner's other edge
  offer(ahead(from.corner), from.angle, from.corner, kNoIndex);
  offer(behind(from.corner), corner_angle(mesh, from.corner) - from.angle, from.corner, kNoIndex);

  // At a vertex of a million faces every edge asks for its own faces, and no others.
  std::vector<std::pair<Index, Index>> corner_at;  // an edge and a corner that has it
  for (const Index corner : mesh.corners(vertex)) {
    if (!mesh.is_face_usable(Mesh::face_of(corner))) continue;
    corner_at.emplace_back(ahead(corner), corner);
    if (behind(corner) != ahead(corner)) corner_at.emplace_back(behind(corner), corner);
  }
  std::sort(corner_at.begin(), corner_at.end());

  WayAround best;
  Index best_edge = kNoIndex;
  if (from.corner == to.corner) best.angle = std::abs(from.angle - to.angle);
  while (!queue.empty()) {
    const auto [angle, edge] = queue.top();
    queue.pop();
    Node& node = nodes[edge];
    if (node.done || angle >= best.angle) continue;
    node.done = true;
    const auto first = std::lower_bound(corner_at.begin(), corner_at.end(), std::pair{edge, Index{0}});
    for (auto it = first; it != corner_at.end() && it->first == edge; ++it) {
      const Index corner = it->second;
      if (corner == node.through) continue;
      const bool is_ahead = ahead(corner) == edge;
      const double full = corner_angle(mesh, corner);
      if (corner == to.corner) {
        const double total = angle + (is_ahead ? to.angle : full - to.angle);
        if (total < best.angle) {
          best.angle = total;
          best_edge = edge;
        }
      }
      offer(is_ahead ? behind(corner) : ahead(corner), angle + full, corner, edge);
    }
  }
  // Back along the edges: each is crossed from the corner that reached it into the one beyond.
  Index into = to.corner;
  for (Index edge = best_edge; edge != kNoIndex; edge = nodes[edge].before) {
    const Index out = nodes[edge].through;
    const auto halfedge = [&](Index corner) { return ahead(corner) == edge ? corner : Mesh::previous(corner); };
    best.steps.push_back({halfedge(out), halfedge(into)});
    into = out;
  }
  std::reverse(best.steps.begin(), best.steps.end());
  return best;
}

}  // namespace brushfire::detail
