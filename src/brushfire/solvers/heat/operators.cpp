// Cotangents of halfedges, summed edge by edge into a symmetric matrix.
#include <brushfire/solvers/heat/operators.h>

#include <brushfire/core/cancel.h>

#include <algorithm>
#include <cstddef>

namespace brushfire::heat {
namespace {

// An edge, at the lower of its ends.
struct EdgeAt {
  Index other = kNoIndex;
  Index halfedge = kNoIndex;
};

// Every edge once, those of one lower end together: [first[v], first[v + 1]).
struct EdgesByEnd {
  std::vector<std::size_t> first;
  std::vector<EdgeAt> edges;
};

EdgesByEnd edges_by_end(const Triangulation& t) {
  const auto is_first = [&](Index h) { return t.twin[h] > h; };  // of its edge; a border's has none
  const auto ends = [&](Index h) { return std::minmax(t.tail[h], t.tail[Mesh::next(h)]); };
  EdgesByEnd by_end{std::vector<std::size_t>(t.vertex_count + std::size_t{2}, 0), {}};
  std::vector<std::size_t>& first = by_end.first;
  for (Index h = 0; h < t.tail.size(); ++h) {
    if (is_first(h)) ++first[ends(h).first + 2];
  }
  for (std::size_t v = 2; v < first.size(); ++v) first[v] += first[v - 1];
  by_end.edges.resize(first.back());
  for (Index h = 0; h < t.tail.size(); ++h) {
    if (is_first(h)) by_end.edges[first[ends(h).first + 1]++] = {ends(h).second, h};
  }
  return by_end;
}

}  // namespace

Operators operators_of(const Triangulation& t) {
  Operators o;
  o.mass.assign(t.vertex_count, 0);
  std::vector<double> weight(t.tail.size());  // of each halfedge its own triangle's
  for (std::size_t f = 0; f < t.face_count(); ++f) {
    const double area = lay_flat(t, f).double_area();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t h = 3 * f + k;
      o.mass[t.tail[h]] += area / (6.0 * t.sheets);
      weight[h] = half_cotangent(t, static_cast<Index>(h), area) / t.sheets;
    }
  }

  EdgesByEnd by_end = edges_by_end(t);
  o.edge_entry.resize(t.tail.size());
  o.pattern.start.reserve(t.vertex_count + std::size_t{1});
  o.pattern.start.push_back(0);
  o.pattern.row.reserve(by_end.edges.size() + t.vertex_count);
  o.laplacian.reserve(by_end.edges.size() + t.vertex_count);
  std::vector<double> diagonal(t.vertex_count, 0.0);
  Poll poll;
  for (Index v = 0; v < t.vertex_count; ++v) {
    poll();
    o.pattern.row.push_back(static_cast<int>(v));
    o.laplacian.push_back(0);
    const auto begin = by_end.edges.begin() + static_cast<std::ptrdiff_t>(by_end.first[v]);
    const auto end = by_end.edges.begin() + static_cast<std::ptrdiff_t>(by_end.first[v + 1]);
    std::sort(begin, end, [](const EdgeAt& a, const EdgeAt& b) {
      return a.other != b.other ? a.other < b.other : a.halfedge < b.halfedge;
    });
    for (auto edge = begin; edge != end; ++edge) {
      const Index h = edge->halfedge, twin = t.twin[h];
      if (static_cast<int>(edge->other) != o.pattern.row.back()) {
        o.pattern.row.push_back(static_cast<int>(edge->other));
        o.laplacian.push_back(0);
      }
      o.edge_entry[h] = static_cast<int>(o.pattern.row.size()) - 1;
      if (twin != kNoIndex) o.edge_entry[twin] = o.edge_entry[h];
      if (edge->other == v) continue;  // takes from its diagonal what it gives
      const double w = weight[h] + (twin == kNoIndex ? 0 : weight[twin]);
      o.laplacian.back() -= w;
      diagonal[v] += w;
      diagonal[edge->other] += w;
    }
    o.pattern.start.push_back(static_cast<int>(o.pattern.row.size()));
  }
  for (Index v = 0; v < t.vertex_count; ++v) o.laplacian[o.pattern.start[v]] = diagonal[v];
  return o;
}

}  // namespace brushfire::heat
