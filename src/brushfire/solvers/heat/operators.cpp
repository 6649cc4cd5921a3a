#include <brushfire/solvers/heat/operators.h>

#include <brushfire/core/cancel.h>

#include <algorithm>
#include <cstddef>

namespace brushfire::heat {
namespace {

// Off the diagonal an entry stands in the column of the lower vertex.
Pattern pattern_of(const Triangulation& t) {
  const auto ends = [&](Index h) { return std::minmax(t.tail[h], t.tail[Mesh::next(h)]); };
  std::vector<std::size_t> first(t.vertex_count + std::size_t{2}, 0);
  for (Index h = 0; h < t.tail.size(); ++h) ++first[ends(h).first + 2];
  for (std::size_t v = 2; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<int> other(t.tail.size());
  for (Index h = 0; h < t.tail.size(); ++h) other[first[ends(h).first + 1]++] = static_cast<int>(ends(h).second);
  Pattern p;
  p.start.reserve(t.vertex_count + std::size_t{1});
  p.start.push_back(0);
  Poll poll;
  for (Index v = 0; v < t.vertex_count; ++v) {
    poll();
    p.row.push_back(static_cast<int>(v));
    const auto begin = other.begin() + static_cast<std::ptrdiff_t>(first[v]);
    const auto end = other.begin() + static_cast<std::ptrdiff_t>(first[v + 1]);
    std::sort(begin, end);
    for (auto i = begin; i != end; ++i) {
      if (*i != p.row.back()) p.row.push_back(*i);
    }
    p.start.push_back(static_cast<int>(p.row.size()));
  }
  return p;
}

int entry_of(const Pattern& p, Index a, Index b) {
  const auto [column, row] = std::minmax(a, b);
  const auto begin = p.row.begin() + p.start[column], end = p.row.begin() + p.start[column + 1];
  return static_cast<int>(std::lower_bound(begin, end, static_cast<int>(row)) - p.row.begin());
}

}  // namespace

Operators operators_of(const Triangulation& t) {
  Operators o;
  o.pattern = pattern_of(t);
  o.laplacian.assign(o.pattern.row.size(), 0);
  o.mass.assign(t.vertex_count, 0);
  o.edge_entry.resize(t.tail.size());
  Poll poll;
  for (Index h = 0; h < t.tail.size(); ++h) {
    poll();
    const Index a = t.tail[h], b = t.tail[Mesh::next(h)];
    o.edge_entry[h] = entry_of(o.pattern, a, b);
    o.mass[a] += lay_flat(t, h / 3).double_area() / (6.0 * t.sheets);
    if (a == b) continue;  // takes from its diagonal what it gives
    const double weight = half_cotangent(t, h) / t.sheets;
    o.laplacian[o.edge_entry[h]] -= weight;
    o.laplacian[o.pattern.start[a]] += weight;
    o.laplacian[o.pattern.start[b]] += weight;
  }
  return o;
}

}  // namespace brushfire::heat
