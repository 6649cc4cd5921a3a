// A mesh with walls, cut apart by a few plain lines that share nothing with Domain.
#pragma once

#include <brushfire/mesh/domain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace brushfire::test {

// A manifold mesh cut apart, in the plainest way: corners at one vertex are one vertex still where a chain of open
// faces over open edges joins them.
struct ByHand {
  Mesh mesh;
  std::vector<Index> vertex;   // original of each
  std::vector<Index> slits;    // halfedges of blocked edges
  std::vector<Index> face_of;  // of each original face; kNoIndex: blocked

  ByHand(const Mesh& whole, const Barriers& barriers) : face_of(whole.face_count(), kNoIndex) {
    std::set<Index> blocked(barriers.faces.begin(), barriers.faces.end());
    for (const Index v : barriers.vertices) {
      for (const Index h : whole.corners(v)) blocked.insert(Mesh::face_of(h));
    }
    std::set<std::array<Index, 2>> closed;
    for (const auto& [a, b] : barriers.edges) closed.insert({std::min(a, b), std::max(a, b)});
    const auto is_closed = [&](Index h) {
      return closed.contains({std::min(whole.from(h), whole.to(h)), std::max(whole.from(h), whole.to(h))});
    };
    std::vector<Index> parent(whole.halfedge_count());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](Index c) {
      while (parent[c] != c) c = parent[c];
      return c;
    };
    for (Index h = 0; h < whole.halfedge_count(); ++h) {
      const Index g = whole.opposite()[h];
      if (g == h || is_closed(h) || blocked.contains(h / 3) || blocked.contains(g / 3)) continue;
      for (const Index mine : {h, Mesh::next(h)}) {
        const Index other = whole.from(g) == whole.from(mine) ? g : Mesh::next(g);
        parent[root(mine)] = root(other);
      }
    }
    std::map<Index, Index> number;
    std::vector<Vec3> positions;
    std::vector<Face> faces;
    for (Index f = 0; f < whole.face_count(); ++f) {
      if (blocked.contains(f)) continue;
      face_of[f] = static_cast<Index>(faces.size());
      Face& face = faces.emplace_back();
      for (Index k = 0; k < 3; ++k) {
        const auto [at, is_new] = number.emplace(root(3 * f + k), static_cast<Index>(positions.size()));
        if (is_new) {
          positions.push_back(whole.positions()[whole.from(3 * f + k)]);
          vertex.push_back(whole.from(3 * f + k));
        }
        face[k] = at->second;
        if (is_closed(3 * f + k)) slits.push_back(3 * face_of[f] + k);
      }
    }
    mesh = Mesh(positions, faces);
    if (!slits.empty()) mesh = mesh.with_slits(slits);
  }

  // The same under the vertex numbers of another mesh with the same faces, on which what marches depends where values
  // are equal. Fails where the two are not the same up to numbers.
  ByHand numbered_as(const Mesh& other) const {
    ByHand result = *this;
    std::vector<Index> there(mesh.vertex_count(), kNoIndex), back(other.vertex_count(), kNoIndex);
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
      Index& a = there[mesh.from(h)];
      Index& b = back[other.from(h)];
      if (a == kNoIndex) a = other.from(h);
      if (b == kNoIndex) b = mesh.from(h);
      EXPECT_TRUE(a == other.from(h) && b == mesh.from(h)) << "corner " << h;
    }
    for (Index h = 0; h < mesh.halfedge_count(); ++h) EXPECT_EQ(mesh.opposite()[h], other.opposite()[h]) << h;
    result.mesh = Mesh(other.positions(), other.faces());
    if (!slits.empty()) result.mesh = result.mesh.with_slits(slits);
    result.vertex.assign(other.vertex_count(), kNoIndex);
    for (Index v = 0; v < mesh.vertex_count(); ++v) result.vertex[there[v]] = vertex[v];
    return result;
  }

  // All sides of a point of the original, by the positions in its faces.
  std::vector<SurfacePoint> sides(const Mesh& whole, const SurfacePoint& p) const {
    const PointLocation at = locate(whole, p);
    std::vector<SurfacePoint> result;
    std::set<std::pair<Index, Index>> known;  // once for every vertex and every edge here
    const auto add = [&](Index f, const std::array<double, 3>& weights) {
      if (face_of[f] == kNoIndex) return;
      const SurfacePoint side{face_of[f], weights};
      const PointLocation there = locate(mesh, side);
      const Index h = there.halfedge;
      const Index edge = h == kNoIndex ? h : std::min(h, mesh.opposite()[h]);
      if (known.emplace(there.vertex, edge).second) result.push_back(side);
    };
    if (at.on == PointLocation::On::Interior) add(at.face, at.weights);
    if (at.on == PointLocation::On::Vertex) {
      for (const Index h : whole.corners(at.vertex)) {
        std::array<double, 3> w{};
        w[h % 3] = 1;
        add(h / 3, w);
      }
    }
    if (at.on == PointLocation::On::Edge) {
      for (const Index h : std::set<Index>{at.halfedge, whole.opposite()[at.halfedge]}) {
        const bool same = whole.from(h) == whole.from(at.halfedge);
        std::array<double, 3> w{};
        w[h % 3] = same ? 1 - at.t : at.t;
        w[Mesh::next(h) % 3] = same ? at.t : 1 - at.t;
        add(h / 3, w);
      }
    }
    return result;
  }
};

}  // namespace brushfire::test
