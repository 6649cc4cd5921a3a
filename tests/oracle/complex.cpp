// Connectivity by pairs of vertices, lengths and angles.
#include "oracle/complex.h"

#include "oracle/arithmetic.h"

#include <algorithm>
#include <map>
#include <utility>

namespace brushfire::oracle {
namespace {

template <class R>
struct Vector {
  R x, y, z;
};
template <class R>
Vector<R> difference(const Vec3& a, const Vec3& b) {
  return {R{a.x} - b.x, R{a.y} - b.y, R{a.z} - b.z};
}
template <class R>
R dot(const Vector<R>& a, const Vector<R>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class R>
R norm(const Vector<R>& a) {
  return sqrt(dot(a, a));
}
template <class R>
R double_area(const Vector<R>& a, const Vector<R>& b) {
  return norm(Vector<R>{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x});
}

// Twice the area from three lengths; 0 where they do not close.
template <class R>
R double_area(R a, R b, R c) {
  if (a < b) std::swap(a, b);
  if (a < c) std::swap(a, c);
  if (b < c) std::swap(b, c);
  const R q = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return q > 0 ? R(sqrt(q) / 2) : R(0);
}

template <class R>
void shape_from_positions(const Mesh& mesh, Corner<R>& c) {
  const auto p = mesh.positions();
  const Vector<R> side = difference<R>(p[c.to], p[c.from]), left = difference<R>(p[c.apex_vertex], p[c.from]),
                  right = difference<R>(p[c.apex_vertex], p[c.to]);
  const R along = dot(side, left), area = norm(left) < norm(right) ? double_area(side, left) : double_area(side, right);
  c.length = norm(side);
  c.angle = along == 0 && area == 0 ? R(half_turn<R>() / 2) : R(atan2(area, along));
  c.apex = {0, norm(left)};
  if (c.length == 0) return;  // a segment, seen from the end that two corners share
  c.apex = {along / c.length, area / c.length};
  c.apex_to_end = -dot(side, right) / c.length;
}

template <class R>
void shape_from_lengths(R length, R left, R right, Corner<R>& c) {
  const R area = double_area(length, left, right);
  const R along = (length * length + (left - right) * (left + right)) / 2;
  c.length = length;
  c.angle = along == 0 && area == 0 ? R(half_turn<R>() / 2) : R(atan2(area, along));
  c.apex = {0, left};
  if (length == 0) return;
  c.apex = {along / length, area / length};
  c.apex_to_end = (length - (left - right) * ((left + right) / length)) / 2;
}

}  // namespace

template <class R>
Complex<R>::Complex(const Mesh& mesh)
    : corner(3 * static_cast<std::size_t>(mesh.face_count())),
      neighbours(mesh.vertex_count()),
      corners_at(mesh.vertex_count()),
      pinched(mesh.vertex_count(), false) {
  std::map<std::pair<Index, Index>, Index> number;
  const R unit = mesh.unit();
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const Face& t = mesh.faces()[h / 3];
    const Index from = t[h % 3], to = t[(h + 1) % 3];
    if (from == to) continue;
    const auto [place, fresh] = number.try_emplace(std::minmax(from, to), static_cast<Index>(edge.size()));
    if (fresh) {
      const auto p = mesh.positions();
      const R length = mesh.has_positions() ? norm(difference<R>(p[to], p[from])) : R(mesh.lengths()[h] * unit);
      edge.push_back({std::min(from, to), std::max(from, to), length, {}});
      neighbours[from].push_back({to, place->second});
      neighbours[to].push_back({from, place->second});
      if (length == 0) pinched[from] = pinched[to] = true;
    }
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    corner[h] = {from, to, t[(h + 2) % 3], place->second, 0, {}, 0, 0, 0, 0};
    edge[place->second].halfedges.push_back(h);
    corners_at[from].push_back(h);
  }
  for (Index h = 0; h < corner.size(); ++h) {
    Corner<R>& c = corner[h];
    if (c.from == kNoIndex) continue;
    if (mesh.has_positions()) {
      shape_from_positions(mesh, c);
    } else {
      shape_from_lengths(edge[c.edge].length, edge[corner[Mesh::previous(h)].edge].length,
                         edge[corner[Mesh::next(h)].edge].length, c);
    }
    const auto node = [&](Index v) {
      const auto& list = neighbours[c.from];
      return static_cast<Index>(
          std::find_if(list.begin(), list.end(), [&](const Neighbour& n) { return n.vertex == v; }) - list.begin());
    };
    c.ahead = node(c.to);
    c.behind = node(c.apex_vertex);
  }
}

template <class R>
Index Complex<R>::edge_between(Index a, Index b) const {
  for (const Neighbour& n : neighbours[a]) {
    if (n.vertex == b) return n.edge;
  }
  return kNoIndex;
}

template struct Complex<Real>;
template struct Complex<Quad>;
template struct Complex<Octuple>;

}  // namespace brushfire::oracle
