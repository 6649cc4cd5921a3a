// Writes the record of one vertex after the other: the sides of its fans, those over unrolled faces, and what is
// offered over them.
#include <brushfire/solvers/carried_source/detail/records.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/prefault.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/solvers/carried_source/detail/need.h>
#include <brushfire/solvers/carried_source/detail/sides.h>
#include <brushfire/solvers/carried_source/detail/unrolled.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>

namespace brushfire::carried_source {
namespace {

constexpr float kTurnRounding = 1e-6f;  // of quick angles
constexpr Index kMostSupports = Index{1} << (32 - Update::kSupportShift);

template <class T>
struct DraftSide {
  Index end = kNoIndex;
  float angle = 0;
  Side<T> side;
  DarkSets dark;
};

template <class T>
struct DraftUpdate {
  Index support = 0, target = 0;
  std::uint32_t bits = 0;  // of an Update, but for the support
  T length = 0;            // of the edge
  Need<T> need;
};

template <class T>
bool comes_before(const DraftUpdate<T>& a, const DraftUpdate<T>& b) {
  constexpr std::uint32_t kSector = 15u << Update::kSectorShift;
  const auto order = [](const DraftUpdate<T>& u) {
    return std::tuple(u.target, u.support, u.bits & kSector, u.length);
  };
  return order(a) < order(b);
}

// How much memory a record takes at most, and where its parts lie.
template <class T>
std::size_t aligned(std::size_t bytes) {
  return (bytes + alignof(Side<T>) - 1) / alignof(Side<T>) * alignof(Side<T>);
}
template <class T>
std::size_t most_bytes(Index sides, Index updates, bool has_lenses) {
  const std::size_t front = sizeof(RecordHead<T>) + (sides + 1) * sizeof(SideEnd<T>) + updates * sizeof(Update);
  const std::size_t back = sizeof(Side<T>) + sizeof(DarkSets) + (has_lenses ? sizeof(LensNumbers) : 0);
  return aligned<T>(aligned<T>(front) + sides * back);
}

template <class T>
class RecordBuilder {
 public:
  explicit RecordBuilder(const Mesh& mesh)
      : mesh_(mesh), vertices_(reinterpret_cast<const Index*>(mesh.faces().data())), of_fans_(mesh), unroller_(mesh, of_fans_) {}

  Records<T> build() {
    out_.vertex_count = mesh_.vertex_count();
    unroller_.unroll_all();
    out_.most_unrolled = unroller_.most_crossed();
    if (of_fans_.sum_of_lengths() > 0) {
      out_.mean_edge = of_fans_.sum_of_lengths() / static_cast<double>(mesh_.halfedge_count());
    }
    find_places();
    std::byte* const base = out_.data.data() + (out_.base() - out_.data.data());
    // A march reads records in no order that a TLB could hold.
    PagesAhead pages(base, out_.offset.back());
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      poll_();
      pages.reach(base + out_.offset[v + 1]);
      draft(v);
      put_record(base + out_.offset[v]);
    }
    out_.around = of_fans_.take_around();
    out_.lenses = of_fans_.take_lenses();
    return std::move(out_);
  }

 private:
  // As many sides and updates as there can be: an update is left out where its corner is split.
  void find_places() {
    mark_lenses();
    out_.offset.resize(mesh_.vertex_count() + std::size_t{1});
    std::size_t at = 0;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      out_.offset[v] = at;
      auto sides = static_cast<Index>(mesh_.corners(v).size()), updates = 2 * sides;
      if (of_fans_.is_alone(v)) {
        sides = of_fans_.alone(v).fans().side_count();
        for (const Index h : mesh_.corners(v)) sides += mesh_.is_face_usable(Mesh::face_of(h)) ? 0 : 2;
      }
      bool has_lenses = !may_have_lenses_.empty() && may_have_lenses_[v];
      for (Index i = unroller_.first_side(v); i != kNoIndex; i = unroller_.side(i).next) {
        ++sides;
        has_lenses |= unroller_.side(i).lenses != kNoIndex;
      }
      for (Index i = unroller_.first_update(v); i != kNoIndex; i = unroller_.update(i).next) ++updates;
      at += most_bytes<T>(sides, updates, has_lenses);
    }
    out_.offset.back() = at;
    // With room for aligning it, and behind for what is asked for ahead of time.
    out_.data.resize(at + 2 * Records<T>::kAlignment);
  }

  // Of odd vertices, and of those whose sides end there.
  void mark_lenses() {
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (!of_fans_.is_odd(v)) continue;
      may_have_lenses_.resize(mesh_.vertex_count());
      for (const Index h : mesh_.corners(v)) {
        for (Index k = 0; k < 3; ++k) may_have_lenses_[mesh_.faces()[Mesh::face_of(h)][k]] = true;
      }
    }
  }

  void draft(Index v) {
    sides_.clear(), updates_.clear(), lenses_.clear();
    head_ = {};
    if (of_fans_.is_alone(v)) {
      draft_alone(v);
    } else {
      draft_ring(v);
    }
    const bool any_unrolled = unroller_.first_update(v) != kNoIndex;
    if (any_unrolled) add_unrolled(v);
    if (of_fans_.is_alone(v)) add_conduits(v);
    if (any_unrolled || of_fans_.is_alone(v)) detail::sort(updates_.begin(), updates_.end(), comes_before<T>);
  }

  // All that is not alone is plain: every corner as it is in its face, every side between two of them.
  void draft_ring(Index v) {
    const std::span<const Index> corners = mesh_.corners(v);
    const auto count = static_cast<Index>(corners.size());
    Index ring[kLanes];
    for (const Index h : corners) ring[of_fans_[h].number] = h;
    sides_.resize(count);
    for (Index i = 0, before = count - 1; i < count; before = i++) {
      DraftSide<T>& d = sides_[i];
      const Index h = ring[i], back = Mesh::previous(ring[before]);
      const RingSide<T>&here = of_fans_[h], &there = of_fans_[back];
      d.end = vertices_[back];
      d.angle = here.angle;
      if (there.is_alone) {
        set_draft(i, here.length, of_fans_.optic(h, true), of_fans_.optic(back, true));
        continue;
      }
      Side<T>& s = d.side;
      s.length = here.length;
      s.c = here.c, s.s = here.s, s.end_c = there.c, s.end_s = there.s;
      s.sector = there.number, s.end_bends = there.bends ? 1 : 0;
      for (int hand = 0; hand < 2; ++hand) {
        s.turned[hand] = here.turned[hand], s.end_turned[hand] = there.turned[hand];
        d.dark.here[hand] = here.dark[hand], d.dark.end[hand] = there.dark[hand];
      }
    }
    head_.bends = of_fans_[ring[0]].bends ? 1 : 0;
    draft_ring_updates(ring, count);
  }

  // In their order: by target, then by support.
  void draft_ring_updates(const Index* ring, Index count) {
    DraftUpdate<T> ahead[kLanes], behind[kLanes];  // of each corner: to the end of its second side, of its first one
    for (Index i = 0; i < count; ++i) add_corner(ring[i], i, i + 1 < count ? i + 1 : 0, ahead[i], behind[i]);
    const auto add = [&](const DraftUpdate<T>& u) {
      if (u.length > 0) updates_.push_back(u);
    };
    for (Index i = 0, before = count - 1; i < count; before = i++) {
      const bool is_end = i == 0 || i + 1 == count;
      add(is_end ? behind[i] : ahead[before]);
      add(is_end ? ahead[before] : behind[i]);
    }
  }

  // Of the corner between two sides of a regular ring. No length: there is no update.
  void add_corner(Index h, Index first, Index second, DraftUpdate<T>& ahead, DraftUpdate<T>& behind) {
    const Index next = Mesh::next(h), previous = Mesh::previous(h);
    const RingSide<T>&at_p = of_fans_[next], &at_q = of_fans_[previous];
    const T l = sides_[first].side.length, k = sides_[second].side.length;
    const T across = at_p.is_alone ? static_cast<T>(mesh_.length(next)) : at_p.length;
    const bool p_mirrored = of_fans_.is_mirrored(next), q_mirrored = of_fans_.is_mirrored(previous);
    const std::uint32_t around = second == 0 ? Update::kAcross : 0;
    if (!at_q.is_split) {
      ahead = {first, second, around, l, need_of(k, across, l)};
      ahead.bits |= back_at(previous, true) | (p_mirrored ? 0 : Update::kThere) | (q_mirrored ? 0 : Update::kSameTurn);
    }
    if (!at_p.is_split) {
      behind = {second, first, around | Update::kHere, k, need_of(l, across, k)};
      behind.bits |= back_at(next, false) | (q_mirrored ? Update::kThere : 0) | (p_mirrored ? Update::kSameTurn : 0);
    }
  }

  // Of a target's corner, and the side of it back to v.
  std::uint32_t back_at(Index corner, bool own) const {
    return of_fans_.sector(corner) << Update::kSectorShift | (of_fans_.is_seam(corner, own) ? Update::kSeam : 0);
  }

  // Any vertex that is no ring's.
  void draft_alone(Index v) {
    const Fans& fans = of_fans_.alone(v).fans();
    head_.bends = fans.bends_light() ? 1 : 0;
    sides_.assign(fans.side_count(), {});
    for (const Index h : mesh_.corners(v)) {
      if (mesh_.is_face_usable(Mesh::face_of(h))) add_face(h);
    }
  }

  void add_face(Index h) {
    const Index next = Mesh::next(h), previous = Mesh::previous(h);
    const Index own = of_fans_.number(h, true), other = of_fans_.number(h, false);
    const auto set = [&](Index side, Index end, Index along, Index there, bool there_own) {
      if (sides_[side].end != kNoIndex) return;
      sides_[side].end = end;
      const T length = static_cast<T>(mesh_.length(along));
      set_draft(side, length, of_fans_.optic(h, along == h), of_fans_.optic(there, there_own));
    };
    set(own, vertices_[next], h, next, false);
    set(other, vertices_[previous], previous, previous, true);
    const T l = sides_[own].side.length, k = sides_[other].side.length, across = static_cast<T>(mesh_.length(next));
    if (!(l > 0) || !(k > 0)) return;
    const bool mirrored = of_fans_.is_mirrored(h);
    const bool p_mirrored = of_fans_.is_mirrored(next), q_mirrored = of_fans_.is_mirrored(previous);
    if (!of_fans_[previous].is_split) {
      DraftUpdate<T> u{own, other, back_at(previous, true), l, need_of(k, across, l)};
      u.bits |= (mirrored ? Update::kHere : 0) | (p_mirrored ? 0 : Update::kThere) | (q_mirrored ? 0 : Update::kSameTurn);
      add_update(u);
    }
    if (!of_fans_[next].is_split) {
      DraftUpdate<T> u{other, own, back_at(next, false), k, need_of(l, across, k)};
      u.bits |= (mirrored ? 0 : Update::kHere) | (q_mirrored ? Update::kThere : 0) | (p_mirrored ? Update::kSameTurn : 0);
      add_update(u);
    }
  }

  // The target is less than half a turn away: if it seems to lie on the other hand, the angles began anew.
  void add_update(DraftUpdate<T> u) {
    if (u.support >= kMostSupports) return;
    const float turn = sides_[u.target].angle - sides_[u.support].angle;
    const bool right = (u.bits & Update::kHere) != 0;
    u.bits |= (right ? turn > kTurnRounding : turn < -kTurnRounding) ? Update::kAcross : 0;
    updates_.push_back(u);
  }

  void set_draft(Index side, T length, const Optic& here, const Optic& there) {
    DraftSide<T>& d = sides_[side];
    LensNumbers lenses;
    set_side(length, here, there, of_fans_.bends_light(d.end), d.side, d.dark, lenses);
    d.angle = static_cast<float>(here.angle);
    if (lenses.any()) keep_lenses(side, lenses);
  }
  void keep_lenses(Index side, const LensNumbers& lenses) {
    if (lenses_.size() <= side) lenses_.resize(side + std::size_t{1});
    lenses_[side] = lenses;
    head_.has_lenses = 1;
  }

  // The last ones first.
  void add_unrolled(Index v) {
    const auto before = static_cast<Index>(sides_.size());
    numbers_.clear();
    for (Index i = unroller_.first_side(v); i != kNoIndex; i = unroller_.side(i).next) {
      const UnrolledSide<T>& u = unroller_.side(i);
      if (u.lenses != kNoIndex) keep_lenses(static_cast<Index>(sides_.size()), unroller_.lenses(u));
      sides_.push_back({u.end, u.angle, u.side, u.dark});
      numbers_.push_back(i);
    }
    const auto number = [&](SideName name) {
      if (!name.is_unrolled()) return name.number();
      const auto at = std::lower_bound(numbers_.begin(), numbers_.end(), name.number(), std::greater<>());
      return before + static_cast<Index>(at - numbers_.begin());
    };
    for (Index i = unroller_.first_update(v); i != kNoIndex; i = unroller_.update(i).next) {
      const UnrolledUpdate<T>& u = unroller_.update(i);
      add_update({number(u.support), number(u.target), u.update.bits, u.length, u.need});
    }
  }

  // Along the edges of faces that name a vertex twice: they have no direction.
  void add_conduits(Index v) {
    for (const Index h : mesh_.corners(v)) {
      if (mesh_.is_face_usable(Mesh::face_of(h))) continue;
      for (const Index g : {h, Mesh::previous(h)}) {
        const Index end = mesh_.from(g) == v ? mesh_.to(g) : mesh_.from(g);
        if (end == v) continue;
        DraftSide<T>& d = sides_.emplace_back();
        d.end = end;
        d.side.length = static_cast<T>(mesh_.length(g));
        d.side.c = d.side.end_c = 0;
        d.side.end_bends = of_fans_.bends_light(end) ? 1 : 0;
      }
    }
  }

  void put_record(std::byte* at) {
    const auto sides = static_cast<Index>(sides_.size()), updates = static_cast<Index>(updates_.size());
    head_.sides = sides;
    for (const DraftUpdate<T>& u : updates_) head_.reach = std::max(head_.reach, u.length);
    out_.most_sides = std::max(out_.most_sides, sides);
    out_.most_updates = std::max(out_.most_updates, updates);
    std::byte* const begin = at;
    put(head_, at);
    Index u = 0;
    for (const DraftSide<T>& d : sides_) {
      SideEnd<T> e{d.end, d.side.length, 0, u};
      const auto target = static_cast<Index>(&d - sides_.data());
      for (; u < updates && updates_[u].target == target; ++u) {
        e.need = std::min(e.need, updates_[u].need.need), e.bulge = std::max(e.bulge, updates_[u].need.bulge);
      }
      put(e, at);
    }
    put(SideEnd<T>{0, std::numeric_limits<T>::max(), 0, u}, at);
    for (const DraftUpdate<T>& d : updates_) put(Update{d.bits | d.support << Update::kSupportShift}, at);
    at = begin + aligned<T>(static_cast<std::size_t>(at - begin));
    for (const DraftSide<T>& d : sides_) put(d.side, at);
    for (const DraftSide<T>& d : sides_) put(d.dark, at);
    if (head_.has_lenses == 0) return;
    lenses_.resize(sides);
    for (const LensNumbers& l : lenses_) put(l, at);
  }
  template <class U>
  static void put(const U& what, std::byte*& at) {
    static_assert(std::is_trivially_copyable_v<U>);
    std::memcpy(at, &what, sizeof(U));
    at += sizeof(U);
  }

  const Mesh& mesh_;
  const Index* vertices_;  // of the faces: the beginning of each halfedge
  Sides<T> of_fans_;
  Unroller<T> unroller_;
  Poll poll_;
  Records<T> out_;
  std::vector<bool> may_have_lenses_;  // [vertex_count]; empty: none has
  // Of the vertex at hand.
  RecordHead<T> head_;
  std::vector<DraftSide<T>> sides_;
  std::vector<DraftUpdate<T>> updates_;
  std::vector<LensNumbers> lenses_;  // of the first sides; the others have none
  std::vector<Index> numbers_;       // of its unrolled sides, descending
};

}  // namespace

template <class T>
Records<T> build_records(const Mesh& mesh) {
  return RecordBuilder<T>(mesh).build();
}

template Records<float> build_records<float>(const Mesh& mesh);
template Records<double> build_records<double>(const Mesh& mesh);

}  // namespace brushfire::carried_source
