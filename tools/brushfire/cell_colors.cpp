// Colours of cells: greedily, those with the fewest neighbours last.
#include "cell_colors.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace brushfire::tool {
namespace {

std::vector<std::set<Index>> neighbours_of(const VoronoiDiagram& cells, std::size_t count) {
  std::vector<std::set<Index>> neighbours(count);
  for (const SharedFace& face : cells.shared_faces) {
    for (const Index a : face.label) {
      for (const Index b : face.label) {
        if (a != b) neighbours[a].insert(b);
      }
    }
  }
  return neighbours;
}

// Cells from the last to be coloured to the first: each has the fewest neighbours among those after it. On a sphere
// that is never more than five, so that six colours do (smallest-last order, Matula and Beck 1983).
std::vector<Index> smallest_last(const std::vector<std::set<Index>>& neighbours) {
  std::vector<std::size_t> degree;
  std::set<std::pair<std::size_t, Index>> waiting;
  for (Index i = 0; i < neighbours.size(); ++i) {
    degree.push_back(neighbours[i].size());
    waiting.emplace(degree[i], i);
  }
  std::vector<Index> order;
  while (!waiting.empty()) {
    const Index cell = waiting.begin()->second;
    waiting.erase(waiting.begin());
    order.push_back(cell);
    for (const Index other : neighbours[cell]) {
      if (waiting.erase({degree[other], other}) > 0) waiting.emplace(--degree[other], other);
    }
  }
  return order;
}

}  // namespace

std::vector<Index> colors_of(const VoronoiDiagram& cells, std::size_t count) {
  constexpr Index kColors = 7;  // and grey, which is left to what has no cell
  std::vector<Index> color(count);
  std::iota(color.begin(), color.end(), 0);
  if (count <= kColors + 1) return color;
  const std::vector<std::set<Index>> neighbours = neighbours_of(cells, count);
  const std::vector<Index> order = smallest_last(neighbours);
  std::fill(color.begin(), color.end(), kNoIndex);
  std::vector<std::size_t> used(kColors, 0);
  for (auto cell = order.rbegin(); cell != order.rend(); ++cell) {
    std::set<Index> taken;
    for (const Index other : neighbours[*cell]) taken.insert(color[other]);
    // Of those that are left the one with the fewest cells so far: all colours are seen about equally often.
    Index best = kNoIndex;
    for (Index i = 0; i < kColors; ++i) {
      if (taken.count(i) == 0 && (best == kNoIndex || used[i] < used[best])) best = i;
    }
    // A surface with handles may need more: those that are left have hues of their own.
    for (Index i = kColors + 1; best == kNoIndex; ++i) best = taken.count(i) == 0 ? i : kNoIndex;
    if (best < kColors) ++used[best];
    color[*cell] = best;
  }
  return color;
}

}  // namespace brushfire::tool
