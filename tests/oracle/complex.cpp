// Connectivity by pairs of vertices, lengths and angles in long double.
#include "oracle/complex.h"

#include <algorithm>
#include <map>
#include <utility>

namespace brushfire::oracle {
namespace {

struct Vector {
  Real x, y, z;
};
Vector difference(const Vec3& a, const Vec3& b) { return {Real{a.x} - b.x, Real{a.y} - b.y, Real{a.z} - b.z}; }
Real dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Real norm(const Vector& a) { return std::sqrt(dot(a, a)); }
Real double_area(const Vector& a, const Vector& b) {
  return norm({a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x});
}

// Twice the area from three lengths; 0 where they do not close.
Real double_area(Real a, Real b, Real c) {
  if (a < b) std::swap(a, b);
  if (a < c) std::swap(a, c);
  if (b < c) std::swap(b, c);
  const Real q = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return q > 0 ? std::sqrt(q) / 2 : 0;
}

void shape_from_positions(const Mesh& mesh, Corner& c) {
  const auto p = mesh.positions();
  const Vector side = difference(p[c.to], p[c.from]), left = difference(p[c.apex_vertex], p[c.from]),
               right = difference(p[c.apex_vertex], p[c.to]);
  const Real along = dot(side, left),
             area = norm(left) < norm(right) ? double_area(side, left) : double_area(side, right);
  c.length = norm(side);
  c.angle = along == 0 && area == 0 ? kHalfTurn / 2 : std::atan2(area, along);
  c.apex = {0, norm(left)};
  if (c.length == 0) return;  // a segment, seen from the end that two corners share
  c.apex = {along / c.length, area / c.length};
  c.apex_to_end = -dot(side, right) / c.length;
}

void shape_from_lengths(Real length, Real left, Real right, Corner& c) {
  const Real area = double_area(length, left, right);
  const Real along = (length * length + (left - right) * (left + right)) / 2;
  c.length = length;
  c.angle = along == 0 && area == 0 ? kHalfTurn / 2 : std::atan2(area, along);
  c.apex = {0, left};
  if (length == 0) return;
  c.apex = {along / length, area / length};
  c.apex_to_end = (length - (left - right) * ((left + right) / length)) / 2;
}

}  // namespace

Complex::Complex(const Mesh& mesh)
    : corner(3 * static_cast<std::size_t>(mesh.face_count())),
      neighbours(mesh.vertex_count()),
      corners_at(mesh.vertex_count()),
      pinched(mesh.vertex_count(), false) {
  std::map<std::pair<Index, Index>, Index> number;
  const Real unit = mesh.unit();
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const Face& t = mesh.faces()[h / 3];
    const Index from = t[h % 3], to = t[(h + 1) % 3];
    if (from == to) continue;
    const auto [place, fresh] = number.try_emplace(std::minmax(from, to), static_cast<Index>(edge.size()));
    if (fresh) {
      const auto p = mesh.positions();
      const Real length = mesh.has_positions() ? norm(difference(p[to], p[from])) : mesh.lengths()[h] * unit;
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
    Corner& c = corner[h];
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

Index Complex::edge_between(Index a, Index b) const {
  for (const Neighbour& n : neighbours[a]) {
    if (n.vertex == b) return n.edge;
  }
  return kNoIndex;
}

}  // namespace brushfire::oracle
