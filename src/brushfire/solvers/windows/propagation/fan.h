// Vertex expansion: the sectors of faces around a vertex that light from it may fill, and the windows they send out.
#pragma once

#include <brushfire/solvers/windows/algebra/rays.h>
#include <brushfire/solvers/windows/propagation/structure.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// The part of a face at its corner `corner` between two directions. Directions at a corner have x along the edge that
// leaves it (halfedge 3 * face + corner) and y into the face; their length does not matter.
struct Sector {
  Index face;
  Index corner;
  Vec2 from, to;
  Vec2 opening;  // the direction of the edge that enters the corner

  bool from_edge() const { return from.y <= 0; }            // begins at the edge that leaves the corner
  bool to_edge() const { return cross(to, opening) <= 0; }  // ends at the edge that enters it
};

// The cosine and the sine of the angle at corner i, times the lengths of both edges.
template <class F>
inline Vec2 opening_at(const F& f, Index i) {
  const Real a = f.length[i], b = f.length[previous3(i)], c = f.length[next3(i)];
  if constexpr (kWide) {
    return {a * f.foot[i], f.double_area};
  } else {
    return {0.5 * (a * a + (b - c) * (b + c)), f.double_area};
  }
}

inline Sector whole_sector(const WindowFace& f, Index face, Index corner) {
  const Vec2 opening = opening_at(f, corner);
  return {face, corner, {1, 0}, opening, opening};
}

// z turned back by the angle of `by`, as complex numbers: z times the conjugate.
constexpr Vec2 turned_back(Vec2 z, Vec2 by) { return {dot(z, by), cross(by, z)}; }

// A shadow is taken to be wider by this on both sides: rounding of products of turns and of the arrival's direction.
// Whatever it adds are real paths.
inline constexpr double kShadowMargin = 1e-12 * kFiner;

// Where light came from: over a halfedge, at this place of its line (in the halfedge's frame).
struct CrossedAt {
  Real place = 0;
  Index halfedge = kNoIndex;
};
// Of a ray that reaches the vertex above its halfedge.
inline CrossedAt crossed_at(const WindowStructure& mesh, const Ray& ray) {
  if (ray.halfedge == kNoIndex) return {};
  const Vec2 apex = frame_of(mesh.faces[ray.halfedge / 3], ray.halfedge % 3).apex;
  const Real along = origin_weight(ray.kind) * apex.y - ray.source.y;
  return {(ray.source.x * apex.y - ray.source.y * apex.x) / along, ray.halfedge};
}

// A face around a vertex, come upon from a neighbour: over the edge that leaves the face's corner there (forwards:
// angles from the edge that was crossed grow as a Sector's do), or over the one that enters it.
struct FanFace {
  Index face, corner;
  bool forwards;

  Index exit() const { return 3 * face + (forwards ? previous3(corner) : corner); }
};

// The face beyond halfedge `exit` at a vertex. False on the boundary, and back at the face `start`.
inline bool next_in_fan(const WindowStructure& mesh, Index vertex, Index start, Index exit, FanFace& at) {
  const Index entry = mesh.faces[exit / 3].opposite[exit % 3];
  if (entry == exit || entry / 3 == start) return false;
  at.face = entry / 3;
  at.forwards = mesh.is_same(mesh.faces[at.face].vertex[entry % 3], vertex);
  at.corner = at.forwards ? entry % 3 : next3(entry % 3);
  return true;
}

// Where the angle from an arrival reaches pi on one side of it: in which face, and in which direction from the edge
// over which that face was entered.
struct StraightOn {
  FanFace at;
  Vec2 direction;
  bool found = false;
};

// `rest`: the angle from the arrival to the edge of `exit`, as a direction. Angles are never computed: the direction
// straight on is turned back by face after face until it lies within one.
inline StraightOn straight_on(const WindowStructure& mesh, Index vertex, Index start, Index exit, Vec2 rest) {
  StraightOn s;
  Vec2 z{-rest.x, std::max(Real{0}, rest.y)};  // pi - rest
  z = {z.x + kShadowMargin * z.y, std::max(Real{0}, z.y - kShadowMargin * z.x)};
  while (next_in_fan(mesh, vertex, start, exit, s.at)) {
    const WindowFace& f = mesh.faces[s.at.face];
    const Vec2 opening = opening_at(f, s.at.corner);
    if (cross(z, opening) >= 0) {
      s.direction = z;
      s.found = true;
      return s;
    }
    const Real scale = 1 / (f.length[s.at.corner] * f.length[previous3(s.at.corner)]);
    z = scale * turned_back(z, opening);
    z.y = std::max(Real{0}, z.y);
    exit = s.at.exit();
  }
  return s;
}

// L6. The sectors in the shadow of a Saddle or Boundary vertex that a ray has reached: at an angle of pi or more from
// the arrival on both sides (on a boundary, the side that there is). Any one of several shortest arrivals will do: a
// path that goes on shortest from one of them goes on shortest from all.
template <class Visit>
void for_each_shadow(const WindowStructure& mesh, Index vertex, const CrossedAt& arrival, Visit&& visit) {
  const Index start = arrival.halfedge / 3;
  const Index corner = previous3(arrival.halfedge % 3);  // the vertex' own, opposite of the halfedge
  const Frame frame = frame_of(mesh.faces[start], arrival.halfedge % 3);
  // From the vertex: where the light came from, and the halfedge's two ends.
  const Vec2 back = Vec2{arrival.place, 0} - frame.apex;
  const Vec2 first = Vec2{} - frame.apex, second = Vec2{frame.length, 0} - frame.apex;
  const Vec2 to_first{dot(back, first), cross(first, back)}, to_second{dot(back, second), cross(back, second)};
  const StraightOn one = straight_on(mesh, vertex, start, 3 * start + previous3(corner), to_second);
  const StraightOn other = straight_on(mesh, vertex, start, 3 * start + corner, to_first);

  // From straight on to the face in which the other side is straight on, or to the boundary.
  const auto spread = [&](const StraightOn& begin, const StraightOn& end) {
    FanFace at = begin.at;
    Vec2 low = begin.direction;  // from the edge over which the walk has entered
    do {
      const Vec2 opening = opening_at(mesh.faces[at.face], at.corner);
      const bool last = end.found && at.face == end.at.face;
      const Vec2 high = last ? turned_back(opening, end.direction) : opening;
      if (at.forwards) {
        visit(Sector{at.face, at.corner, low, high, opening});
      } else {
        const Vec2 from = last ? end.direction : Vec2{1, 0};
        visit(Sector{at.face, at.corner, from, low.y <= 0 ? opening : turned_back(opening, low), opening});
      }
      if (last) return;
      low = {1, 0};
    } while (next_in_fan(mesh, vertex, start, at.exit(), at));
  };
  if (mesh.vertex_type[vertex] == VertexType::Boundary) {
    if (one.found) spread(one, {});
    if (other.found) spread(other, {});
  } else if (one.found && other.found) {
    spread(one, other);
  }
}

// Corner i over the halfedge opposite of it, in the frame that begins at the halfedge's end.
template <class F>
inline Vec2 corner_over_opposite(const F& f, Index i) {
  const Index k = next3(i);
  const Real near = f.length[i], far = f.length[previous3(i)], length = f.length[k];
  if constexpr (kWide) {
    return {far * (f.foot[next3(k)] / length), f.double_area / length};
  } else {
    return apex_over_edge(length, far, near, f.double_area);
  }
}

// The window that light from a sector's corner makes on the edge opposite of the corner, seen from beyond that edge: in
// the frame from the end of halfedge 3 * face + next3(corner) to its start.
inline Window window_of(const WindowFace& f, const Sector& sector, Real sigma) {
  const Index i = sector.corner;
  const Real near = f.length[i], far = f.length[previous3(i)], length = f.length[next3(i)];
  // A ray in direction z divides the opposite edge as  near sin(from near edge to z) : far sin(from z to far edge).
  const auto place = [&](Vec2 z) {
    const Real a = near * near * z.y, b = cross(z, sector.opening);
    return a + b > 0 ? length * (b / (a + b)) : length;
  };
  Window w;
  // The corner is the apex of halfedge next3(i), here from that one's end.
  const Vec2 corner = corner_over_opposite(f, i);
  w.source = {corner.x, -corner.y};
  w.sigma = sigma;
  w.b0 = sector.to_edge() ? 0 : place(sector.to);
  w.b1 = sector.from_edge() ? length : place(sector.from);
  w.d0 = w.b0 <= 0 ? sigma + far : value_at(w, w.b0);
  w.d1 = w.b1 >= length ? sigma + near : value_at(w, w.b1);
  return w;
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
