// By the faces of the caller's mesh, which every cut names.
#include <brushfire/solvers/steiner/detail/match.h>

#include <algorithm>
#include <numeric>

namespace brushfire::steiner {
namespace {

std::vector<Index> all(Index count) {
  std::vector<Index> numbers(count);
  std::iota(numbers.begin(), numbers.end(), Index{0});
  return numbers;
}

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
  if (is_identity) {
    match_all(after);
    return;
  }
  match_faces(before, after);
  match_rows(before, after);
  match_vertices(before, after);
}

void Match::match_all(const Run& run) {
  face = face_after = all(run.mesh->mesh().face_count());
  row = row_after = all(run.mesh->edges().count());
  vertex = all(run.mesh->mesh().vertex_count());
}

void Match::match_faces(const Run& before, const Run& after) {
  std::vector<Index> of_caller(before.mesh->domain().mesh().face_count(), kNoIndex);
  for (Index f = 0; f < before.mesh->mesh().face_count(); ++f) of_caller[before.mesh->face(f)] = f;
  face.assign(after.mesh->mesh().face_count(), kNoIndex);
  face_after.assign(before.mesh->mesh().face_count(), kNoIndex);
  for (Index f = 0; f < face.size(); ++f) {
    face[f] = of_caller[after.mesh->face(f)];
    if (face[f] != kNoIndex) face_after[face[f]] = f;
  }
}

void Match::match_rows(const Run& before, const Run& after) {
  const EdgeTable &old_edges = before.mesh->edges(), &edges = after.mesh->edges();
  row.assign(edges.count(), kNoIndex);
  row_after.assign(old_edges.count(), kNoIndex);
  for (Index e = 0; e < edges.count(); ++e) {
    const Index begin = edges.halfedge(e);
    Index old_edge = kNoIndex, old_size = 0, same = 0, size = 0, h = begin;
    do {
      ++size;
      const Index f = face[Mesh::face_of(h)], g = f == kNoIndex ? kNoIndex : 3 * f + h % 3;
      if (g != kNoIndex && old_edge == kNoIndex && runs_same_way(before, g) == runs_same_way(after, h)) {
        old_edge = old_edges.edge(g);
        old_size = ring_size(before.mesh->mesh(), g);
      }
      same += g != kNoIndex && old_edges.edge(g) == old_edge;
      h = after.mesh->mesh().opposite(h);
    } while (h != begin);
    if (same != size || old_size != size) continue;
    if (!has_same_points(*before.layout, old_edge, *after.layout, e)) continue;
    row[e] = old_edge;
    row_after[old_edge] = e;
  }
}

void Match::match_vertices(const Run& before, const Run& after) {
  vertex.assign(after.mesh->mesh().vertex_count(), kNoIndex);
  for (Index v = 0; v < vertex.size(); ++v) {
    const std::span<const Index> rows = after.mesh->edges().at(v);
    Index old_vertex = kNoIndex;
    bool same = !rows.empty();
    for (const Index e : rows) {
      if (row[e] == kNoIndex) {
        same = false;
        break;
      }
      const bool is_first = after.mesh->mesh().from(after.mesh->edges().halfedge(e)) == v;
      const Index g = before.mesh->edges().halfedge(row[e]);
      const Index end = is_first ? before.mesh->mesh().from(g) : before.mesh->mesh().to(g);
      same = same && (old_vertex == kNoIndex || old_vertex == end);
      old_vertex = end;
    }
    if (same && before.mesh->edges().at(old_vertex).size() == rows.size()) vertex[v] = old_vertex;
  }
}

}  // namespace brushfire::steiner
