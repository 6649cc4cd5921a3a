// By the faces of the caller's mesh, which every cut names.
#include <brushfire/solvers/steiner/detail/match.h>

#include <algorithm>

namespace brushfire::steiner {
namespace {

bool runs_same_way(const Run& run, Index h) {
  return run.mesh->mesh().from(h) == run.mesh->mesh().from(run.mesh->edges().halfedge(run.mesh->edges().edge(h)));
}

Index ring_size(const Mesh& mesh, Index h) {
  Index size = 1;
  for (Index g = mesh.opposite(h); g != h; g = mesh.opposite(g)) ++size;
  return size;
}

bool has_same_points(const PointLayout& a, Index row_a, const PointLayout& b, Index row_b) {
  return a.count(row_a) == b.count(row_b) &&
         std::equal(a.at_row(row_a), a.at_row(row_a) + a.count(row_a), b.at_row(row_b));
}

}  // namespace

Match::Match(const Run& before, const Run& after) : is_identity(before.layout == after.layout) {
  if (is_identity) return;
  match_faces(before, after);
  match_rows(before, after);
  match_vertices(before, after);
}

void Match::match_faces(const Run& before, const Run& after) {
  std::vector<Index> of_caller(before.mesh->domain().mesh().face_count(), kNoIndex);
  for (Index f = 0; f < before.mesh->mesh().face_count(); ++f) of_caller[before.mesh->face(f)] = f;
  face_.assign(after.mesh->mesh().face_count(), kNoIndex);
  face_after_.assign(before.mesh->mesh().face_count(), kNoIndex);
  for (Index f = 0; f < face_.size(); ++f) {
    face_[f] = of_caller[after.mesh->face(f)];
    if (face_[f] != kNoIndex) face_after_[face_[f]] = f;
  }
}

void Match::match_rows(const Run& before, const Run& after) {
  const EdgeTable &old_edges = before.mesh->edges(), &edges = after.mesh->edges();
  row_.assign(edges.count(), kNoIndex);
  row_after_.assign(old_edges.count(), kNoIndex);
  for (Index e = 0; e < edges.count(); ++e) {
    const Index begin = edges.halfedge(e);
    Index old_edge = kNoIndex, old_size = 0, same = 0, size = 0, h = begin;
    do {
      ++size;
      const Index f = face_[Mesh::face_of(h)], g = f == kNoIndex ? kNoIndex : 3 * f + h % 3;
      if (g != kNoIndex && old_edge == kNoIndex && runs_same_way(before, g) == runs_same_way(after, h)) {
        old_edge = old_edges.edge(g);
        old_size = ring_size(before.mesh->mesh(), g);
      }
      same += g != kNoIndex && old_edges.edge(g) == old_edge;
      h = after.mesh->mesh().opposite(h);
    } while (h != begin);
    if (same != size || old_size != size) continue;
    if (!has_same_points(*before.layout, old_edge, *after.layout, e)) continue;
    row_[e] = old_edge;
    row_after_[old_edge] = e;
  }
}

void Match::match_vertices(const Run& before, const Run& after) {
  vertex_.assign(after.mesh->mesh().vertex_count(), kNoIndex);
  vertex_after_.assign(before.mesh->mesh().vertex_count(), kNoIndex);
  for (Index v = 0; v < vertex_.size(); ++v) {
    const std::span<const Index> rows = after.mesh->edges().at(v);
    Index old_vertex = kNoIndex;
    bool same = !rows.empty();
    for (const Index e : rows) {
      if (row_[e] == kNoIndex) {
        same = false;
        break;
      }
      const bool is_first = after.mesh->mesh().from(after.mesh->edges().halfedge(e)) == v;
      const Index g = before.mesh->edges().halfedge(row_[e]);
      const Index end = is_first ? before.mesh->mesh().from(g) : before.mesh->mesh().to(g);
      same = same && (old_vertex == kNoIndex || old_vertex == end);
      old_vertex = end;
    }
    if (!same || before.mesh->edges().at(old_vertex).size() != rows.size()) continue;
    vertex_[v] = old_vertex;
    vertex_after_[old_vertex] = v;
  }
}

}  // namespace brushfire::steiner
