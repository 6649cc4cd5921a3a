// Windows by halfedge.
#include <brushfire/solvers/windows/detail/record.h>

namespace brushfire::detail::BRUSHFIRE_NUMBERS {

void WindowFieldData::keep(std::span<const KeptWindow> windows) {
  const std::size_t halfedges = mesh.halfedge_count();
  first_kept.assign(halfedges + 1, 0);
  for (const KeptWindow& k : windows) ++first_kept[k.halfedge + 1];
  for (std::size_t h = 0; h < halfedges; ++h) first_kept[h + 1] += first_kept[h];
  std::vector<std::size_t> fill(first_kept.begin(), first_kept.end() - 1);
  kept.resize(windows.size());
  for (const KeptWindow& k : windows) kept[fill[k.halfedge]++] = k.window;
}

}  // namespace brushfire::detail::BRUSHFIRE_NUMBERS
