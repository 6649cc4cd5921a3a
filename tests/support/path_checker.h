// An independent judge of paths: works on coordinates, shares no code with the library's path functions.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_path.h>
#include <brushfire/mesh/surface_point.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace brushfire::test {

// A point by the vertices that it lies between.
using Support = std::map<Index, double>;

inline Support support_of(const Mesh& mesh, const SurfacePoint& p) {
  Support s;
  for (std::size_t k = 0; k < 3; ++k) {
    if (p.weights[k] > 1e-12) s[mesh.faces()[p.face][k]] += p.weights[k];
  }
  return s;
}

inline Vec3 place(const Mesh& mesh, const SurfacePoint& p) {
  Vec3 x;
  for (std::size_t k = 0; k < 3; ++k) x = x + p.weights[k] * mesh.positions()[mesh.faces()[p.face][k]];
  return x;
}

inline bool holds(const Face& t, const Support& s) {
  return std::all_of(s.begin(), s.end(),
                     [&](const auto& e) { return std::find(t.begin(), t.end(), e.first) != t.end(); });
}

inline std::vector<Index> faces_holding(const Mesh& mesh, const Support& a, const Support& b) {
  std::vector<Index> out;
  for (const Index h : mesh.corners(a.begin()->first)) {
    const Index f = Mesh::face_of(h);
    if (holds(mesh.faces()[f], a) && holds(mesh.faces()[f], b)) out.push_back(f);
  }
  return out;
}

inline double angle_between(Vec3 a, Vec3 b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

// The least angle around vertex v between two directions, each given by a point in a face at v: all pairs over the
// vertex's edges and the two directions (Floyd and Warshall).
inline double angle_around(const Mesh& mesh, Index v, const std::vector<Index>& faces_a, Vec3 a,
                           const std::vector<Index>& faces_b, Vec3 b) {
  const Vec3 x = mesh.positions()[v];
  std::map<Index, std::size_t> node;  // by the other end of the edge
  for (const Index h : mesh.corners(v)) {
    for (const Index w : mesh.faces()[Mesh::face_of(h)]) {
      if (w != v) node.emplace(w, node.size() + 2);
    }
  }
  const std::size_t n = node.size() + 2;
  std::vector<double> d(n * n, kInfinity);
  const auto join = [&](std::size_t i, std::size_t j, double angle) {
    d[i * n + j] = std::min(d[i * n + j], angle);
    d[j * n + i] = std::min(d[j * n + i], angle);
  };
  for (const Index h : mesh.corners(v)) {
    const Face& t = mesh.faces()[Mesh::face_of(h)];
    if (!mesh.is_face_usable(Mesh::face_of(h))) continue;
    const Index u = t[(h + 1) % 3], w = t[(h + 2) % 3];
    join(node[u], node[w], angle_between(mesh.positions()[u] - x, mesh.positions()[w] - x));
  }
  const std::vector<Index>* faces[2] = {&faces_a, &faces_b};
  const Vec3 point[2] = {a, b};
  for (std::size_t i = 0; i < 2; ++i) {
    for (const Index f : *faces[i]) {
      for (const Index w : mesh.faces()[f]) {
        if (w != v) join(i, node[w], angle_between(point[i] - x, mesh.positions()[w] - x));
      }
    }
  }
  for (const Index f : faces_a) {
    if (std::find(faces_b.begin(), faces_b.end(), f) != faces_b.end()) join(0, 1, angle_between(a - x, b - x));
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) d[i * n + j] = std::min(d[i * n + j], d[i * n + k] + d[k * n + j]);
    }
  }
  return d[1];
}

inline bool has_edge_without_length(const Mesh& mesh, Index v) {
  const auto corners = mesh.corners(v);
  return std::any_of(corners.begin(), corners.end(), [&](Index h) {
    const Face& t = mesh.faces()[Mesh::face_of(h)];
    return std::any_of(t.begin(), t.end(),
                       [&](Index w) { return w != v && mesh.positions()[w] == mesh.positions()[v]; });
  });
}

// What is wrong with a path that claims to be locally shortest; empty where nothing is. `angle_tolerance` is what an
// angle may miss pi by; positions of nodes are rounded, so angles at pieces that are short against the mesh's
// coordinates get more room.
inline std::string judge(const Mesh& mesh, const SurfacePath& path, double angle_tolerance = 1e-6) {
  const std::size_t n = path.points.size();
  if (n == 0) return path.length == kInfinity ? "" : "no points, but a length";
  double length = 0, extent = 0;
  for (const Vec3& p : mesh.positions()) extent = std::max({extent, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  for (std::size_t i = 0; i + (path.closed ? 0 : 1) < n && n > 1; ++i) {
    const std::size_t j = (i + 1) % n;
    const Support a = support_of(mesh, path.points[i]), b = support_of(mesh, path.points[j]);
    if (faces_holding(mesh, a, b).empty()) return "points " + std::to_string(i) + " and the next share no face";
    if (a == b) return "point " + std::to_string(i) + " is repeated";
    length += norm(place(mesh, path.points[j]) - place(mesh, path.points[i]));
  }
  if (!(std::abs(length - path.length) <= 1e-10 * std::max(length, 1e-3 * extent))) {
    return "pieces sum to " + std::to_string(length) + ", not to " + std::to_string(path.length);
  }
  for (std::size_t i = path.closed ? 0 : 1; i + (path.closed ? 0 : 1) < n && n > 2; ++i) {
    const SurfacePoint &before = path.points[(i + n - 1) % n], &here = path.points[i],
                       &after = path.points[(i + 1) % n];
    const Vec3 x = place(mesh, here), a = place(mesh, before), b = place(mesh, after);
    const double room = angle_tolerance + 1e-13 * extent / std::min(norm(a - x), norm(b - x));
    const Support s = support_of(mesh, here);
    if (s.size() == 3) return "point " + std::to_string(i) + " lies inside a face";
    if (s.size() == 2) {
      const Vec3 e = mesh.positions()[s.rbegin()->first] - mesh.positions()[s.begin()->first];
      const double bend = angle_between(a - x, e) + angle_between(b - x, e) - kPi;
      if (std::abs(bend) > room)
        return "bends by " + std::to_string(bend) + " on an edge at point " + std::to_string(i);
      continue;
    }
    const Index v = s.begin()->first;
    if (has_edge_without_length(mesh, v)) continue;  // no directions, no angles
    const double angle = angle_around(mesh, v, faces_holding(mesh, s, support_of(mesh, before)), a,
                                      faces_holding(mesh, s, support_of(mesh, after)), b);
    if (angle < kPi - room) {
      return "angle " + std::to_string(angle) + " < pi at vertex " + std::to_string(v) + ", point " + std::to_string(i);
    }
  }
  return "";
}

}  // namespace brushfire::test
