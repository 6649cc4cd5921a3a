// Light that begins at sources, begins anew at vertices, and runs along edges that are cheaper than a face beside them.
#include <brushfire/solvers/refraction/detail/run.h>

#include <algorithm>
#include <cmath>

namespace brushfire::refraction {

using windows::next3, windows::previous3, windows::Sector, windows::WindowFace, windows::WindowKind;

namespace {

// A source nearer to a corner of its face than this share of the face's longest edge makes the corner send light in all
// directions: limit rays through the corner are known to epsilon / share only.
constexpr double kNear = 1e-3;
// What the start of light at a vertex in place of a source next to it may make of how far the bounds of any other
// vertex are apart, as a share of what is asked for.
constexpr double kHidden = 0.1;

}  // namespace

// ---- sources

void Run::start(const detail::LocatedSource& source, Index number) {
  const Origin origin{source.offset, 0, number};
  const PointLocation& at = source.at;
  if (start_at_near_vertex(number)) return;
  if (at.on == PointLocation::On::Vertex) {
    const Index v = medium_.structure.inner_vertex(at.vertex);
    reach(v, origin.value, number);
    see(v, origin.value, nullptr, true);
    return;
  }
  windows::for_each_face_around(medium_.structure.mesh, at, [&](const windows::FaceWeights& f) {
    start_in_face({medium_.structure.inner_face(f.face), f.weights}, origin);
  });
  if (at.on == PointLocation::On::Edge) start_on_edge(at, origin);
}

// With c what it costs to get to the vertex, no path from the source is more than c cheaper than one from the vertex,
// and one by the vertex is c dearer. False where that is too much, or there is no such vertex.
bool Run::start_at_near_vertex(Index number) {
  if (limits_.near.empty()) return false;
  const steiner::NearVertex& near = limits_.near[number];
  if (!(2 * near.upper <= kHidden * limits_.share * near.beyond)) return false;
  const Index v = medium_.structure.inner_vertex(near.vertex);
  reach(v, start_of(number) + near.upper, number);
  see(v, start_of(number) - near.upper, nullptr, true);
  return true;
}

// Straight to the corners and the targets of the face, and through the edges that the source does not lie on.
void Run::start_in_face(const windows::FaceWeights& at, const Origin& origin) {
  const WindowFace& f = medium_.structure.faces[at.face];
  const double weight = medium_.weight[at.face];
  const std::array<double, 3> distance = corner_distances_of(medium_.structure, at);
  const double longest = std::max({f.length[0], f.length[1], f.length[2]});
  for (Index k = 0; k < 3; ++k) {
    const Index edge = next3(k);  // opposite of corner k
    const bool framed = f.usable && f.length[edge] > 0;
    windows::Ray ray;
    if (framed)
      ray = {windows::in_frame(frame_of(f, edge), edge, at.weights), 3 * at.face + edge, 0, WindowKind::Circular};
    const double value = origin.value + weight * distance[k];
    reach(f.vertex[k], value, origin.source);
    see(f.vertex[k], value, framed ? &ray : nullptr, !framed || distance[k] < kNear * longest);
    if (!framed) continue;
    Window w;
    w.b1 = f.length[edge];
    w.source = {w.b1 - ray.source.x, -ray.source.y};
    w.sigma = origin.value / weight;
    w.d0 = w.sigma + distance[previous3(k)];
    w.d1 = w.sigma + distance[next3(k)];
    w.pseudo_source = origin.source;
    // A source on the edge of a face with an area lights nothing through that edge: the faces beyond start it, too.
    if (is_visible(w) && (w.source.y < 0 || f.double_area == 0)) leave_face(3 * at.face + edge, w);
  }
  targets_.for_each_in(at.face, [&](const windows::TargetInFace& t) {
    const Index k = f.length[0] > 0 ? 0 : 1;
    if (!(f.length[k] > 0)) return;
    const windows::Vec2 d = windows::in_frame(frame_of(f, k), k, windows::step_between(at.weights, t.weights));
    reach_target(t.target, origin.value + weight * windows::length_of(d.x, d.y), 0, origin.source, true);
  });
}

void Run::start_on_edge(const PointLocation& at, const Origin& origin) {
  const Index h = medium_.structure.inner_halfedge(at.halfedge);
  if (!medium_.is_border[h]) return;
  const double place = at.t * face(h).length[h % 3];
  run_along(origin, h, place, true);
  run_along(origin, h, place, false);
}

// ---- vertices (L6)

Run::Origin Run::origin_at(Index v) const {
  const Vertex& at = vertices_[v];
  return {at.lower, std::max(0.0, at.upper - at.lower), at.source};
}

// Into its shadow where all is one weight around it, or everywhere.
void Run::leave_vertex(Index v) {
  const windows::WindowStructure& structure = medium_.structure;
  Vertex& at = vertices_[v];
  if (!at.waiting) return;
  at.waiting = false;
  if (at.lower > radius_) return;
  const windows::VertexType type = structure.vertex_type[v];
  if (at.all_around || medium_.is_pivot[v] || type == windows::VertexType::Full || at.from.halfedge == kNoIndex) {
    for (const Index h : structure.corners_of(v, corners_)) leave_through(v, h);
  } else if (type == windows::VertexType::Fans) {
    const std::span<const Index> corners = structure.corners_of(v, corners_);
    for (const Sector& sector : link_(structure, corners, at.from)) leave_into(v, sector);
  } else {
    for_each_shadow(structure, v, at.from, [&](const Sector& sector) { leave_into(v, sector); });
  }
}

// Through the whole of the face of a corner at v.
void Run::leave_through(Index v, Index corner) {
  const Index i = corner % 3;
  const WindowFace& f = face(corner);
  if (f.usable) return leave_into(v, whole_sector(f, corner / 3, i));
  for (const Index j : {next3(i), previous3(i)}) {
    if (f.vertex[j] == v) continue;
    const Index h = 3 * (corner / 3) + (j == next3(i) ? i : j);
    const Origin origin = origin_at(v);
    const double cost = origin.value + medium_.along[h] * f.length[h % 3];
    reach(f.vertex[j], cost + origin.slack, origin.source);
    see(f.vertex[j], cost, nullptr, false);
  }
}

// Along the sector's edges to their ends, and through its face.
void Run::leave_into(Index v, Sector sector) {
  const WindowFace& f = medium_.structure.faces[sector.face];
  const Index i = sector.corner, near = next3(i), far = previous3(i), first = 3 * sector.face;
  // Where the corner lies on the opposite edge, an interval there cannot tell directions: light goes in all of them.
  if (f.double_area <= windows::kOnEdge * f.length[near] * f.length[near]) sector = whole_sector(f, sector.face, i);
  const Origin origin = origin_at(v);
  if (sector.from_edge()) {
    reach_along(origin, v, sector.face, near);
    run_into(origin, first + i, 0, true);
  }
  if (sector.to_edge()) {
    reach_along(origin, v, sector.face, far);
    run_into(origin, first + far, f.length[far], false);
  }
  if (!(f.length[near] > 0)) return;
  const double weight = medium_.weight[sector.face];
  Window w = window_of(f, sector, origin.value / weight);
  w.slack = origin.slack / weight;
  w.pseudo_source = origin.source;
  if (is_visible(w)) leave_face(first + near, w);
}

// ---- edges

// From v along an edge to a corner of a face that holds both.
void Run::reach_along(const Origin& origin, Index v, Index face, Index corner) {
  const WindowFace& f = medium_.structure.faces[face];
  const Index opposite = next3(corner);
  const Index edge = f.vertex[opposite] == v ? corner : previous3(corner);  // v is an end of both
  const double cost = origin.value + medium_.along[3 * face + edge] * f.length[edge];
  reach(f.vertex[corner], cost + origin.slack, origin.source);
  const windows::Ray ray{
      {f.vertex[opposite] == v ? 0 : f.length[opposite], 0}, 3 * face + opposite, 0, WindowKind::Circular};
  see(f.vertex[corner], cost, f.length[opposite] > 0 ? &ray : nullptr, false);
}

// From a place of the edge of h, counted from its start, to one of its ends, and from all of that way into the faces
// that are dearer.
void Run::run_along(const Origin& origin, Index h, double place, bool forwards) {
  const WindowFace& f = face(h);
  const double length = f.length[h % 3];
  const Index start = f.vertex[h % 3], to = forwards ? f.vertex[next3(h % 3)] : start;
  const double cost = origin.value + medium_.along[h] * (forwards ? length - place : place);
  reach(to, cost + origin.slack, origin.source);
  see(to, cost, nullptr, false);
  Index g = h;
  do {
    const bool same_way = face(g).vertex[g % 3] == start;
    run_into(origin, g, same_way ? place : length - place, same_way == forwards);
    g = face(g).opposite[g % 3];
  } while (g != h);
}

// Parallel light at the critical angle, into the face of h, if that is dearer than its edge.
void Run::run_into(const Origin& origin, Index h, double place, bool forwards) {
  const double weight = medium_.weight[h / 3], ratio = medium_.along[h] / weight;
  const double steep = (1 - ratio) * (1 + ratio), length = face(h).length[h % 3];
  if (!(steep > 0)) return;
  const double slope = forwards ? ratio : -ratio;
  Window w;
  w.kind = WindowKind::Linear;
  w.b0 = forwards ? place : 0;
  w.b1 = forwards ? length : place;
  if (!(w.b0 < w.b1)) return;
  w.source = {-slope, -std::sqrt(steep)};
  w.sigma = origin.value / weight - slope * place;
  w.d0 = value_at(w, w.b0);
  w.d1 = value_at(w, w.b1);
  w.slack = origin.slack / weight;
  w.pseudo_source = origin.source;
  enter(h, w);
}

// ---- the end

// Around the corners of a target's face.
void Run::finish_targets() {
  for (const windows::TargetInFace& t : targets_.in_faces()) {
    const std::array<double, 3> d = corner_distances_of(medium_.structure, {t.face, t.weights});
    for (Index k = 0; k < 3; ++k) {
      const Index v = medium_.structure.faces[t.face].vertex[k];
      if (vertices_[v].upper == kInfinity) continue;
      const Origin origin = origin_at(v);
      reach_target(t.target, origin.value + medium_.weight[t.face] * d[k], origin.slack, origin.source, true);
    }
  }
}

// Whether every vertex that hangs together with a source has both bounds: rounding may lose light that grazes one.
bool Run::is_complete() const {
  for (const WindowFace& f : medium_.structure.faces) {
    int reached = 0;
    for (const Index v : f.vertex) {
      const Vertex& at = vertices_[v];
      if (at.upper == kInfinity) continue;
      ++reached;
      if (at.lower == kInfinity && at.upper <= radius_) return false;
    }
    if (reached > 0 && reached < 3 && radius_ == kInfinity) return false;
  }
  return true;
}

}  // namespace brushfire::refraction
