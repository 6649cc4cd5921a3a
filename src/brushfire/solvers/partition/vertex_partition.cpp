// Finds ghosts, and who is to be told about whom.
#include <brushfire/solvers/partition/vertex_partition.h>

#include <brushfire/core/detail/sort.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace brushfire::partition {

int part_shift(Index part_size) {
  return std::min(kWholeMesh, static_cast<int>(std::bit_width(std::max<Index>(1, part_size) - 1)));
}

VertexPartitionBuilder::VertexPartitionBuilder(Index vertex_count, int shift) : seen_(vertex_count / 64 + 1) {
  parts_.vertex_count = vertex_count;
  parts_.shift = shift;
}

std::span<const Index> VertexPartitionBuilder::finish_part(Index part) {
  parts_.ghost_offset.resize(part + 1, parts_.ghost_offset.back());
  const Index first = parts_.ghost_offset.back();
  find_ghosts(first);
  surround_ghosts(first);
  parts_.ghost_offset.push_back(static_cast<Index>(parts_.owner.size()));
  names_.clear();
  return ghosts_;
}

// One for each vertex that is named, in ascending order.
void VertexPartitionBuilder::find_ghosts(Index first) {
  std::vector<Index>& owner = parts_.owner;
  for (const Name& n : names_) {
    std::uint64_t& bits = seen_[n.end / 64];
    const std::uint64_t bit = std::uint64_t{1} << n.end % 64;
    if ((bits & bit) == 0) owner.push_back(n.end);
    bits |= bit;
  }
  const auto begin = owner.begin() + static_cast<std::ptrdiff_t>(first);
  detail::sort(begin, owner.end());
  for (auto w = begin; w != owner.end(); ++w) seen_[*w / 64] = 0;
  ghosts_.clear();
  for (const Name& n : names_) {
    ghosts_.push_back(parts_.first_ghost() +
                      static_cast<Index>(std::lower_bound(begin, owner.end(), n.end) - owner.begin()));
  }
}

void VertexPartitionBuilder::surround_ghosts(Index first) {
  std::vector<Index>& offset = parts_.near_offset;
  const Index none = parts_.first_ghost();
  offset.resize(parts_.owner.size() + 1, 0);
  for (const Index g : ghosts_) ++offset[g - none + 1];
  for (std::size_t g = first; g + 1 < offset.size(); ++g) offset[g + 1] += offset[g];
  parts_.near.resize(offset.back());
  next_.assign(offset.begin() + static_cast<std::ptrdiff_t>(first), offset.end());
  for (std::size_t i = 0; i < names_.size(); ++i) parts_.near[next_[ghosts_[i] - none - first]++] = names_[i].vertex;
}

VertexPartition VertexPartitionBuilder::take() {
  const Index count = parts_.vertex_count == 0 ? 1 : parts_.of(parts_.vertex_count - 1) + 1;
  parts_.ghost_offset.resize(count + 1, parts_.ghost_offset.back());
  share();
  open_channels();
  return std::move(parts_);
}

// The vertices that have ghosts, and their ghosts in the order of the parts.
void VertexPartitionBuilder::share() {
  VertexPartition& p = parts_;
  p.shared.resize(p.vertex_count / 64 + 1);
  for (const Index w : p.owner) p.shared[w / 64].bits |= std::uint64_t{1} << w % 64;
  Index count = 0;
  for (VertexPartition::Shared& around : p.shared) {
    around.before = count;
    count += static_cast<Index>(std::popcount(around.bits));
  }
}

void VertexPartitionBuilder::open_channels() {
  VertexPartition& p = parts_;
  const auto by_receiver = [](const VertexPartition::Channel& a, const VertexPartition::Channel& b) {
    return std::pair(a.receiver, a.sender) < std::pair(b.receiver, b.sender);
  };
  // Calls act(ghost, part of the ghost, part of its vertex), in ascending order.
  const auto for_each_ghost = [&](const auto& act) {
    for (Index part = 0; part < p.count(); ++part) {
      for (Index g = p.ghost_offset[part]; g < p.ghost_offset[part + 1]; ++g) act(g, part, p.of(p.owner[g]));
    }
  };
  VertexPartition::Channel last{kNoIndex, kNoIndex};
  for_each_ghost([&](Index, Index part, Index home) {
    if (part == last.sender && home == last.receiver) return;
    last = {part, home};
    p.channels.push_back(last);
    p.channels.push_back({home, part});
  });
  detail::sort(p.channels.begin(), p.channels.end(), by_receiver);
  const auto same = [](const VertexPartition::Channel& a, const VertexPartition::Channel& b) {
    return a.receiver == b.receiver && a.sender == b.sender;
  };
  p.channels.erase(std::unique(p.channels.begin(), p.channels.end(), same), p.channels.end());
  const auto channel = [&](Index sender, Index receiver) {
    const auto at =
        std::lower_bound(p.channels.begin(), p.channels.end(), VertexPartition::Channel{sender, receiver}, by_receiver);
    return static_cast<Index>(at - p.channels.begin());
  };

  const Index shared = p.shared.back().before + static_cast<Index>(std::popcount(p.shared.back().bits));
  p.link_offset.assign(shared + 1, 0);
  for (const Index w : p.owner) ++p.link_offset[p.rank(w) + 1];
  for (Index i = 0; i < shared; ++i) p.link_offset[i + 1] += p.link_offset[i];
  p.links.resize(p.owner.size());
  p.to_owner.resize(p.owner.size());
  std::vector<Index> next(p.link_offset.begin(), p.link_offset.end() - 1);
  Index to = 0, from = 0;
  last = {kNoIndex, kNoIndex};
  for_each_ghost([&](Index g, Index part, Index home) {
    if (part != last.sender || home != last.receiver) {
      last = {part, home};
      to = channel(part, home);
      from = channel(home, part);
    }
    p.to_owner[g] = {p.owner[g], to};
    p.links[next[p.rank(p.owner[g])]++] = {p.first_ghost() + g, from};
  });
}

}  // namespace brushfire::partition
