// Ghost vertices, as rings.
#include <brushfire/solvers/partition/face_partition.h>

#include <brushfire/core/detail/sort.h>

namespace brushfire::partition {

FacePartition::FacePartition(Index vertex_count, Index face_count, unsigned bits)
    : bits_(bits), face_count_(face_count), first_vertex_{0, vertex_count} {}

Index FacePartition::part_of_vertex(Index v) const {
  return static_cast<Index>(std::upper_bound(first_vertex_.begin(), first_vertex_.end(), v) - first_vertex_.begin()) -
         1;
}

Index FacePartition::next_ghost(Index v) const {
  const auto at = std::lower_bound(ghosts_.begin(), ghosts_.end(), std::pair{v, Index{0}});
  return at != ghosts_.end() && at->first == v ? at->second : kNoIndex;
}

Index FacePartition::ghost_in(Index part, Index v) const {
  for (Index g = v; g != kNoIndex;) {
    if (is_in(part, g)) return g;
    g = next_ghost(g);
    if (g == v) break;
  }
  return kNoIndex;
}

// `links`: from part to part, ascending in their second numbers. The last of a chain is led back to its first.
void FacePartition::close_rings(std::vector<std::pair<Index, Index>> links) {
  std::vector<std::pair<Index, Index>> first_of;  // of everyone but the first: the first of its chain
  first_of.reserve(links.size());
  const auto first = [&](Index v) {
    const auto at = std::lower_bound(first_of.begin(), first_of.end(), std::pair{v, Index{0}});
    return at != first_of.end() && at->first == v ? at->second : v;
  };
  for (const auto& [from, to] : links) first_of.emplace_back(to, first(from));
  ghosts_ = std::move(links);
  for (const auto& [to, its_first] : first_of) ghosts_.emplace_back(to, its_first);
  // Where a vertex has two entries, the one that leads on is the larger; the one that leads back goes.
  detail::sort(ghosts_.begin(), ghosts_.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  });
  const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
  ghosts_.erase(std::unique(ghosts_.begin(), ghosts_.end(), same), ghosts_.end());
}

}  // namespace brushfire::partition
