// The vertices of a mesh cut into parts that work by themselves, and who sends messages to whom.
//
// A part is a run of consecutive places of a local order. Where its blocks name a vertex of another part they name a
// ghost of it: a place of the part's own, beyond the vertices. So a part reads and writes its own places only, and
// parts can work side by side; what other parts need is sent through channels and received when all are done.
#pragma once

#include <brushfire/core/detail/inline.h>
#include <brushfire/core/detail/prefetch.h>
#include <brushfire/core/types.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace brushfire::partition {

inline constexpr int kWholeMesh = 31;  // the shift of a part that has all vertices

// Of places: the vertices first, then one that stands for "no vertex", then the ghosts, part by part.
struct VertexPartition {
  // Where the value of a place is to be sent: to a place of the receiver, through a channel.
  struct Link {
    Index place, channel;
  };
  struct Channel {
    Index sender, receiver;
  };
  // Which of 64 vertices have ghosts, and how many of the vertices before these have any.
  struct Shared {
    std::uint64_t bits = 0;
    Index before = 0;
  };

  Index vertex_count = 0;
  int shift = kWholeMesh;              // part = place >> shift
  std::vector<Index> ghost_offset{0};  // [parts + 1]
  std::vector<Index> owner;            // [ghosts] the vertex that it stands for
  std::vector<Index> near_offset{0};   // [ghosts + 1]
  std::vector<Index> near;             // of each ghost: the part's vertices whose blocks name it
  std::vector<Shared> shared;          // [vertex_count / 64 + 1]
  std::vector<Index> link_offset{0};   // [shared vertices + 1]
  std::vector<Link> links;             // of each shared vertex to its ghosts
  std::vector<Link> to_owner;          // [ghosts]
  std::vector<Channel> channels;       // by receiver, then by sender

  Index count() const { return static_cast<Index>(ghost_offset.size()) - 1; }
  Index of(Index vertex) const { return vertex >> shift; }
  Index first_ghost() const { return vertex_count + 1; }
  std::size_t places() const { return first_ghost() + owner.size(); }
  bool is_ghost(Index place) const { return place > vertex_count; }

  // Where messages about a place go, which is a ghost or has ghosts.
  std::span<const Link> links_of(Index place) const {
    if (is_ghost(place)) return {&to_owner[place - first_ghost()], 1};
    const Index i = rank(place);
    return {links.data() + link_offset[i], links.data() + link_offset[i + 1]};
  }
  Index rank(Index shared_vertex) const {
    const Shared& around = shared[shared_vertex / 64];
    const std::uint64_t before = around.bits & ((std::uint64_t{1} << shared_vertex % 64) - 1);
    return around.before + static_cast<Index>(std::popcount(before));
  }
  // What links_of() will need first.
  BRUSHFIRE_INLINE void prefetch_links(Index place) const {
    if (is_ghost(place)) {
      prefetch(&to_owner[place - first_ghost()]);
    } else {
      prefetch(&shared[place / 64]);
    }
  }
  // The part's own vertices around a ghost.
  std::span<const Index> around(Index ghost) const {
    const Index g = ghost - first_ghost();
    return {near.data() + near_offset[g], near.data() + near_offset[g + 1]};
  }
  template <class Act>
  void for_each_shared_vertex(const Act& act) const {
    for (std::size_t word = 0; word < shared.size(); ++word) {
      for (std::uint64_t bits = shared[word].bits; bits != 0; bits &= bits - 1) {
        act(static_cast<Index>(64 * word) + static_cast<Index>(std::countr_zero(bits)));
      }
    }
  }
};

// Parts of 2^shift vertices or the whole mesh (shift kWholeMesh).
int part_shift(Index part_size);

// Collects which vertices of a part name which vertices of other parts, part by part, in ascending order of the
// vertices.
class VertexPartitionBuilder {
 public:
  VertexPartitionBuilder(Index vertex_count, int shift);

  // A vertex of the part at hand, and an end of one of its sides that lies in another part.
  void add(Index vertex, Index end) { names_.push_back({vertex, end}); }
  // Completes part `part`; those before it that were not completed name no vertex of others. The ghosts of the ends
  // that were added, in the same order, until the next call.
  std::span<const Index> finish_part(Index part);
  VertexPartition take();

 private:
  struct Name {
    Index vertex, end;
  };

  void find_ghosts(Index first);
  void surround_ghosts(Index first);
  void share();
  void open_channels();

  VertexPartition parts_;
  std::vector<Name> names_;
  std::vector<Index> ghosts_, next_;
  std::vector<std::uint64_t> seen_;  // a bit for every vertex
};

}  // namespace brushfire::partition
