// Edge flips on lengths, up to the intrinsic Delaunay triangulation.
#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/planar.h>
#include <brushfire/solvers/heat/triangulation.h>

#include <cmath>
#include <deque>

namespace brushfire::heat {
namespace {

// The corner opposite of h, in the frame in which h runs from the origin along the x axis; above it.
Vec2 apex_over(const Triangulation& t, Index h) {
  const double a = t.length[h], b = t.length[Mesh::next(h)], c = t.length[Mesh::previous(h)];
  return apex_over_edge(a, c, b, lay_flat(t, h / 3).double_area());
}

// The edge between the two apexes of h's edge. 0 where numbers fail.
double flipped_length(const Triangulation& t, Index h) {
  const Vec2 above = apex_over(t, h), below = apex_over(t, t.twin[h]);
  const double length = std::hypot(t.length[h] - below.x - above.x, above.y + below.y);
  return std::isfinite(length) ? length : 0;
}

double corner_angle(const Triangulation& t, Index h) {  // between h and the edge before it
  const Vec2 apex = apex_over(t, h);
  return std::atan2(apex.y, apex.x);
}

void join(Triangulation& t, Index a, Index b) {
  t.twin[a] = b;
  if (b != kNoIndex) t.twin[b] = a;
}

// What a halfedge is, apart from its number.
struct Side {
  Index tail, twin;
  double length, bearing;
};

Side side_of(const Triangulation& t, Index h) {
  return {t.tail[h], t.twin[h], t.length[h], t.bearing.empty() ? 0 : t.bearing[h]};
}

void place(Triangulation& t, Index at, const Side& side) {
  t.tail[at] = side.tail;
  t.length[at] = side.length;
  if (!t.bearing.empty()) t.bearing[at] = side.bearing;
}

// Triangles (a b c) and (b a d) become (c d b) and (d c a). Halfedges h and twin(h) become the new edge.
void flip(Triangulation& t, Index h, double length) {
  const Index o = t.twin[h];
  const Index h1 = Mesh::next(h), h2 = Mesh::previous(h), o1 = Mesh::next(o), o2 = Mesh::previous(o);
  const Side bc = side_of(t, h1), ca = side_of(t, h2), ad = side_of(t, o1), db = side_of(t, o2);
  const Side cd{ca.tail, o, length, 0}, dc{db.tail, h, length, 0};
  // An outer edge may be glued to another one of the four: their new numbers, for twins that are among them.
  const auto moved = [&](Index x) { return x == h1 ? h2 : x == h2 ? o1 : x == o1 ? o2 : x == o2 ? h1 : x; };
  place(t, h, cd);   // c -> d
  place(t, h1, db);  // d -> b
  place(t, h2, bc);  // b -> c
  place(t, o, dc);   // d -> c
  place(t, o1, ca);  // c -> a
  place(t, o2, ad);  // a -> d
  join(t, h1, moved(db.twin));
  join(t, h2, moved(bc.twin));
  join(t, o1, moved(ca.twin));
  join(t, o2, moved(ad.twin));
  join(t, h, o);
  if (t.bearing.empty()) return;
  t.bearing[h] = t.bearing[o1] + corner_angle(t, o1);  // counter-clockwise of c -> a
  t.bearing[o] = t.bearing[h1] + corner_angle(t, h1);  // counter-clockwise of d -> b
}

// Whether the edge of h is to be flipped, and can be.
bool is_bad(const Triangulation& t, Index h) {
  const Index o = t.twin[h];
  if (o == kNoIndex || h / 3 == o / 3) return false;
  return half_cotangent(t, h) + half_cotangent(t, o) < -kFlipTolerance;
}

}  // namespace

std::size_t flip_to_delaunay(Triangulation& t) {
  const auto edge_of = [&](Index h) { return t.twin[h] < h ? t.twin[h] : h; };
  std::deque<Index> waiting;
  std::vector<bool> waits(t.tail.size(), false);  // by the lower halfedge of the edge
  const auto add = [&](Index h) {
    const Index e = edge_of(h);
    if (waits[e]) return;
    waits[e] = true;
    waiting.push_back(e);
  };
  for (Index h = 0; h < t.tail.size(); ++h) {
    if (edge_of(h) == h && is_bad(t, h)) add(h);
  }
  std::size_t flips = 0;
  Poll poll;
  while (!waiting.empty()) {
    poll();
    const Index h = waiting.front();
    waiting.pop_front();
    waits[h] = false;
    if (!is_bad(t, h)) continue;
    const double length = flipped_length(t, h);
    if (!(length > 0)) continue;
    // Both numbers of the edge stay its own; those of the four around may have gone to others of them.
    const Index o = t.twin[h];
    flip(t, h, length);
    ++flips;
    for (const Index side : {Mesh::next(h), Mesh::previous(h), Mesh::next(o), Mesh::previous(o)}) add(side);
  }
  return flips;
}

}  // namespace brushfire::heat
