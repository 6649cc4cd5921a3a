// Seams by a tree of shortest ways and a tree of faces: what neither of them has goes around a handle or to a hole.
#include <brushfire/queries/flatten.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/disjoint_sets.h>

#include <algorithm>
#include <functional>
#include <queue>
#include <string>
#include <tuple>

namespace brushfire {
namespace {

class DiscCutter {
 public:
  DiscCutter(const Mesh& mesh, Index base) : mesh_(mesh), base_(base) { grow_tree(); }

  std::vector<std::array<Index, 2>> run() {
    uncross();
    prune();
    std::vector<std::array<Index, 2>> seams;
    bool has_rim = false;
    for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
      if (!is_seam_[h]) continue;
      has_rim = has_rim || is_boundary(h);
      if (!is_boundary(h)) seams.push_back(ends(h));
    }
    if (seams.empty() && !has_rim) {  // a sphere
      for (Index v = farthest_; parent_[v] != kNoIndex; v = parent_[v]) {
        seams.push_back({std::min(v, parent_[v]), std::max(v, parent_[v])});
      }
    }
    std::sort(seams.begin(), seams.end());
    return seams;
  }

 private:
  void grow_tree() {
    value_.assign(mesh_.vertex_count(), kInfinity);
    parent_.assign(mesh_.vertex_count(), kNoIndex);
    using Entry = std::tuple<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    value_[base_] = 0;
    queue.emplace(0, base_);
    farthest_ = base_;
    while (!queue.empty()) {
      const auto [d, v] = queue.top();
      queue.pop();
      if (d > value_[v]) continue;
      farthest_ = v;
      for (const Index corner : mesh_.corners(v)) {
        for (const Index h : {corner, Mesh::previous(corner)}) {
          const Index w = mesh_.from(h) == v ? mesh_.to(h) : mesh_.from(h);
          const double next = d + mesh_.lengths()[h];
          if (!(next < value_[w])) continue;
          value_[w] = next;
          parent_[w] = v;
          queue.emplace(next, w);
        }
      }
    }
  }

  // One halfedge of each edge; of those of three and more faces, none.
  bool is_first(Index h) const {
    const Index g = mesh_.opposite()[h];
    return mesh_.is_face_usable(Mesh::face_of(h)) && h <= g && mesh_.opposite()[g] == h;
  }
  bool is_boundary(Index h) const { return mesh_.opposite()[h] == h; }
  bool reaches(Index h) const { return value_[mesh_.from(h)] < kInfinity; }
  bool in_tree(Index h) const { return parent_[mesh_.from(h)] == mesh_.to(h) || parent_[mesh_.to(h)] == mesh_.from(h); }
  std::array<Index, 2> ends(Index h) const {
    return {std::min(mesh_.from(h), mesh_.to(h)), std::max(mesh_.from(h), mesh_.to(h))};
  }

  // All faces make one disc when they are joined by a tree of edges: those whose loops over the base are longest, and
  // those of the tree of shortest ways last. What is left are seams.
  void uncross() {
    is_seam_.assign(mesh_.halfedge_count(), false);
    detail::DisjointSets joined(mesh_.face_count());
    std::vector<std::tuple<bool, double, Index>> edges;
    for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
      if (!is_first(h) || !reaches(h)) continue;
      is_seam_[h] = true;
      const double loop = value_[mesh_.from(h)] + value_[mesh_.to(h)] + mesh_.lengths()[h];
      if (!is_boundary(h)) edges.emplace_back(in_tree(h), -loop, h);
    }
    std::sort(edges.begin(), edges.end());
    for (const auto& [in_tree, loop, h] : edges) {
      const Index a = Mesh::face_of(h), b = Mesh::face_of(mesh_.opposite()[h]);
      if (joined.find(a) == joined.find(b)) continue;
      joined.unite(a, b);
      is_seam_[h] = false;
    }
  }

  // Seams that end in the middle of the surface part nothing.
  void prune() {
    std::vector<Index> degree(mesh_.vertex_count(), 0);
    for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
      if (!is_seam_[h]) continue;
      ++degree[mesh_.from(h)];
      ++degree[mesh_.to(h)];
    }
    std::vector<Index> leaves;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (degree[v] == 1) leaves.push_back(v);
    }
    while (!leaves.empty()) {
      const Index v = leaves.back();
      leaves.pop_back();
      for (const Index corner : mesh_.corners(v)) {
        for (const Index around : {corner, Mesh::previous(corner)}) {
          const Index h = std::min(around, mesh_.opposite()[around]);
          if (!is_seam_[h]) continue;
          is_seam_[h] = false;
          const Index w = mesh_.from(h) == v ? mesh_.to(h) : mesh_.from(h);
          if (--degree[w] == 1) leaves.push_back(w);
        }
      }
    }
  }

  const Mesh& mesh_;
  const Index base_;
  Index farthest_ = 0;
  std::vector<double> value_;  // [vertex_count] along edges, from the base
  std::vector<Index> parent_;  // [vertex_count] in the tree
  std::vector<bool> is_seam_;  // [halfedge_count] by the lower halfedge of an edge
};

}  // namespace

std::vector<std::array<Index, 2>> cut_to_disc(const Mesh& mesh, Index base) {
  if (base >= mesh.vertex_count()) {
    throw Error(ErrorCode::IndexOutOfRange, "vertex " + std::to_string(base) + " does not exist");
  }
  if (mesh.corners(base).empty()) {
    throw Error(ErrorCode::InvalidArgument, "vertex " + std::to_string(base) + " is in no face");
  }
  return DiscCutter(mesh, base).run();
}

}  // namespace brushfire
