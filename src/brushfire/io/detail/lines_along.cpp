// Edges, chained to lines.
#include <brushfire/io/detail/lines_along.h>

#include <brushfire/core/detail/sort.h>

#include <algorithm>
#include <cmath>

namespace brushfire::detail {

LoadedLines lines_along(std::span<const Vec3> positions, std::span<const std::array<Index, 2>> edges) {
  struct Chain {
    Index first;  // vertex: lines come in the order of their first vertices
    LoadedLine line;
  };
  std::vector<Chain> chains;
  std::vector<bool> is_used(positions.size(), false);
  Index last = kNoIndex;
  for (const auto& [a, b] : edges) {
    is_used[a] = is_used[b] = true;
    if (a != last) chains.push_back({a, {{positions[a]}, {}, false, std::nan("")}});
    Chain& chain = chains.back();
    if (b == chain.first && chain.line.positions.size() > 1) {
      chain.line.closed = true;
      last = kNoIndex;
    } else {
      chain.line.positions.push_back(positions[b]);
      last = b;
    }
  }
  for (Index v = 0; v < is_used.size(); ++v) {
    if (!is_used[v]) chains.push_back({v, {{positions[v]}, {}, false, std::nan("")}});
  }
  detail::stable_sort(chains.begin(), chains.end(), [](const Chain& a, const Chain& b) { return a.first < b.first; });
  LoadedLines loaded;
  for (Chain& chain : chains) loaded.lines.push_back(std::move(chain.line));
  return loaded;
}

}  // namespace brushfire::detail
