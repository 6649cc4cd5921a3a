// Writes the record of one vertex after the other: the sides of its fans, those over unrolled faces, and what is
// offered over them.
#include <brushfire/solvers/carried_source/detail/records.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/prefault.h>
#include <brushfire/solvers/carried_source/detail/need.h>
#include <brushfire/solvers/carried_source/detail/record_draft.h>
#include <brushfire/solvers/carried_source/detail/ring_draft.h>
#include <brushfire/solvers/carried_source/detail/sides.h>
#include <brushfire/solvers/carried_source/detail/unrolled.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

namespace brushfire::carried_source {
namespace {

constexpr float kTurnRounding = 1e-6f;  // of quick angles
constexpr Index kMostSupports = Index{1} << (32 - Update::kSupportShift);

template <class T>
class RecordBuilder {
 public:
  explicit RecordBuilder(const Mesh& mesh)
      : mesh_(mesh),
        offsets_(mesh.corner_offsets()),
        corners_(mesh.all_corners()),
        vertices_(reinterpret_cast<const Index*>(mesh.faces().data())),
        of_fans_(mesh),
        unroller_(mesh, of_fans_) {}

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
    PagesAhead pages(base, static_cast<std::size_t>(out_.offset.back()));
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      poll_();
      pages.reach(base + out_.offset[v + 1]);
      write(v, base + out_.offset[v]);
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
      auto sides = offsets_[v + 1] - offsets_[v], updates = 2 * sides;
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

  void write(Index v, std::byte* at) {
    sides_.clear(), updates_.clear(), lenses_.clear();
    head_ = {};
    if (of_fans_.is_alone(v)) {
      draft_alone(v);
      if (unroller_.first_update(v) != kNoIndex) add_unrolled(v, 0);
      add_conduits(v);
      sort_updates(updates_);
      put_record(at);
    } else {
      write_ring(v, at);
    }
  }

  void write_ring(Index v, std::byte* at) {
    DraftRing<T> ring;
    look_around(v, ring);
    find_needs(ring);
    if (unroller_.first_update(v) != kNoIndex) {
      angles_.resize(ring.count);
      for (Index i = 0; i < ring.count; ++i) angles_[i] = ring.side[i]->angle;
      add_unrolled(v, ring.count);
      sort_updates(updates_);
    }
    put_ring(ring, at);
  }

  // Every corner of a ring is as it is in its face, every side between two of them.
  BRUSHFIRE_INLINE void look_around(Index v, DraftRing<T>& ring) {
    const Index begin = offsets_[v];
    ring.count = offsets_[v + 1] - begin;
    Index corner[kLanes];
    for (Index i = 0; i < ring.count; ++i) corner[of_fans_[corners_[begin + i]].number] = corners_[begin + i];
    for (Index i = ring.count; i < kLanes; ++i) ring.first[i] = ring.second[i] = ring.across[i] = 1;
    for (Index i = 0, before = ring.count - 1; i < ring.count; before = i++) {
      const Index h = corner[i], back = Mesh::previous(corner[before]), next = Mesh::next(h);
      const RingSide<T>&here = of_fans_[h], &there = of_fans_[back];
      ring.side[i] = &here;
      ring.end_vertex[i] = vertices_[back];
      ring.first[i] = ring.second[before] = here.length;
      if (there.is_alone) {
        look_from_alone(i, back, next, ring.end[i], ring.across[i]);
      } else {
        look_from_ring(there, of_fans_[next], ring.end[i], ring.across[i]);
      }
    }
    head_.bends = ring.side[0]->bends ? 1 : 0;
  }

  // The same of an end that is no ring's; its corners beside the side are `back` and `next`.
  [[gnu::noinline]] void look_from_alone(Index side, Index back, Index next, RingEnd<T>& e, T& across) {
    const Optic there = of_fans_.optic(back, true);
    e.c = static_cast<T>(there.c), e.s = static_cast<T>(there.s), across = static_cast<T>(mesh_.length(next));
    e.sets = there.sets;
    e.sector = static_cast<std::uint8_t>(there.sector), e.bends = of_fans_[back].bends ? 1 : 0;
    e.takes_ahead = !of_fans_[back].is_split, e.takes_behind = !of_fans_[next].is_split;
    const bool back_mirrored = of_fans_.is_mirrored(back), next_mirrored = of_fans_.is_mirrored(next);
    e.ahead = back_at(back, true) | (back_mirrored ? 0 : Update::kSameTurn);
    e.behind = back_at(next, false) | (next_mirrored ? Update::kSameTurn : 0);
    e.supports_ahead = next_mirrored ? 0 : Update::kThere, e.supports_behind = back_mirrored ? Update::kThere : 0;
    LensNumbers lenses;
    std::copy_n(there.lenses, 2, lenses.end);
    if (lenses.any()) keep_lenses(side, lenses);
  }

  BRUSHFIRE_INLINE void put_ring(const DraftRing<T>& ring, std::byte* at) {
    RecordPen<T> pen = pen_at<T>(at, ring.count + static_cast<Index>(sides_.size()));
    const DraftUpdate<T>*more = updates_.data(), *const end = more + updates_.size();
    for (Index i = 0, before = ring.count - 1; i < ring.count; before = i++) {
      pen.begin_side(ring.end_vertex[i], ring.first[i]);
      const Index next = i + 1 < ring.count ? i + 1 : 0;
      const RingUpdate<T> over_before = ahead(ring, i, before), over_next = behind(ring, i, next);
      const bool takes_before = ring.end[i].takes_ahead, takes_next = ring.end[i].takes_behind;
      if (more < end && more->target() == i) {
        merged_.clear();
        if (takes_before) merged_.push_back(as_draft(over_before, i));
        if (takes_next) merged_.push_back(as_draft(over_next, i));
        for (; more < end && more->target() == i; ++more) merged_.push_back(*more);
        pen = put_merged(pen);
      } else if (before < next) {
        if (takes_before) pen.put(over_before);
        if (takes_next) pen.put(over_next);
      } else {
        if (takes_next) pen.put(over_next);
        if (takes_before) pen.put(over_before);
      }
      pen.end_side();
    }
    if (!sides_.empty()) pen = put_drafted_ends(more, end, ring.count, pen);
    Side<T>* side = put_head(at, pen, ring.count + static_cast<Index>(sides_.size()));
    for (Index i = 0; i < ring.count; ++i) {
      const RingSide<T>& here = *ring.side[i];
      const RingEnd<T>& e = ring.end[i];
      Side<T>& to = side[i];
      to.length = here.length;
      to.c = here.c, to.s = here.s, to.end_c = e.c, to.end_s = e.s;
      std::memcpy(to.turned, here.sets.turned, sizeof to.turned);
      std::memcpy(to.end_turned, e.sets.turned, sizeof to.end_turned);
      to.sector = e.sector, to.end_bends = e.bends;
    }
    auto* const dark = reinterpret_cast<DarkSets*>(side + head_.sides);
    for (Index i = 0; i < ring.count; ++i) {
      const SightSets &here = ring.side[i]->sets, &there = ring.end[i].sets;
      std::memcpy(dark[i].here, here.dark, sizeof here.dark);
      std::memcpy(dark[i].end, there.dark, sizeof there.dark);
    }
    put_drafts(side, dark, ring.count);
  }

  // A ring's updates for a side and those over unrolled faces, in order.
  RecordPen<T> put_merged(RecordPen<T> pen) {
    sort_updates(merged_);
    for (const DraftUpdate<T>& u : merged_) pen.put(u);
    return pen;
  }

  // The sides that have been drafted, from number `first` on.
  RecordPen<T> put_drafted_ends(const DraftUpdate<T>* more, const DraftUpdate<T>* end, Index first, RecordPen<T> pen) {
    for (const DraftSide<T>& d : sides_) {
      pen.begin_side(d.end, d.side.length);
      for (; more < end && more->target() == first; ++more) pen.put(*more);
      ++first;
      pen.end_side();
    }
    return pen;
  }

  // Returns where sides are to be written.
  BRUSHFIRE_INLINE Side<T>* put_head(std::byte* at, RecordPen<T> pen, Index sides) {
    const auto updates = static_cast<Index>(pen.update - pen.first);
    *pen.end = {0, std::numeric_limits<T>::max(), 0, updates};
    head_.sides = sides, head_.reach = pen.reach;
    std::memcpy(at, &head_, sizeof head_);
    out_.most_sides = std::max(out_.most_sides, sides), out_.most_updates = std::max(out_.most_updates, updates);
    const auto front = static_cast<std::size_t>(reinterpret_cast<std::byte*>(pen.update) - at);
    return reinterpret_cast<Side<T>*>(at + aligned<T>(front));
  }

  // What has been drafted of the sides from number `first` on, and the lenses of all.
  BRUSHFIRE_INLINE void put_drafts(Side<T>* side, DarkSets* dark, Index first) {
    for (const DraftSide<T>& d : sides_) side[first] = d.side, dark[first] = d.dark, ++first;
    if (head_.has_lenses == 0) return;
    lenses_.resize(head_.sides);
    std::copy(lenses_.begin(), lenses_.end(), reinterpret_cast<LensNumbers*>(dark + head_.sides));
  }

  void put_record(std::byte* at) {
    const auto sides = static_cast<Index>(sides_.size());
    const RecordPen<T> pen =
        put_drafted_ends(updates_.data(), updates_.data() + updates_.size(), 0, pen_at<T>(at, sides));
    Side<T>* const side = put_head(at, pen, sides);
    put_drafts(side, reinterpret_cast<DarkSets*>(side + sides), 0);
  }

  // Of a target's corner, and the side of it back to v.
  std::uint32_t back_at(Index corner, bool own) const {
    return of_fans_.sector(corner) << Update::kSectorShift | (of_fans_.is_seam(corner, own) ? Update::kSeam : 0);
  }

  // Any vertex that is no ring's.
  void draft_alone(Index v) {
    const Fans& fans = of_fans_.alone(v).fans();
    head_.bends = fans.bends_light() ? 1 : 0;
    sides_.resize(fans.side_count());
    angles_.resize(fans.side_count());
    for (DraftSide<T>& d : sides_) d = {kNoIndex, {}, {}};
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
      add_update(own, other,
                 back_at(previous, true) | (mirrored ? Update::kHere : 0) | (p_mirrored ? 0 : Update::kThere) |
                     (q_mirrored ? 0 : Update::kSameTurn),
                 l, need_of(k, across, l));
    }
    if (!of_fans_[next].is_split) {
      add_update(other, own,
                 back_at(next, false) | (mirrored ? 0 : Update::kHere) | (q_mirrored ? Update::kThere : 0) |
                     (p_mirrored ? Update::kSameTurn : 0),
                 k, need_of(l, across, k));
    }
  }

  // The target is less than half a turn away: if it seems to lie on the other hand, the angles began anew.
  void add_update(Index support, Index target, std::uint32_t bits, T length, Need<T> need) {
    if (support >= kMostSupports) return;
    const float turn = angles_[target] - angles_[support];
    const bool right = (bits & Update::kHere) != 0;
    bits |= (right ? turn > kTurnRounding : turn < -kTurnRounding) ? Update::kAcross : 0;
    updates_.push_back(update_of(support, target, bits, length, need));
  }

  void set_draft(Index side, T length, const Optic& here, const Optic& there) {
    DraftSide<T>& d = sides_[side];
    LensNumbers lenses;
    set_side(length, here, there, of_fans_.bends_light(d.end), d.side, d.dark, lenses);
    angles_[side] = static_cast<float>(here.angle);
    if (lenses.any()) keep_lenses(side, lenses);
  }
  void keep_lenses(Index side, const LensNumbers& lenses) {
    if (lenses_.size() <= side) lenses_.resize(side + std::size_t{1});
    lenses_[side] = lenses;
    head_.has_lenses = 1;
  }

  // Behind those that have been drafted, and `written` others.
  void add_unrolled(Index v, Index written) {
    const auto before = written + static_cast<Index>(sides_.size());
    numbers_.clear();
    for (Index i = unroller_.first_side(v); i != kNoIndex; i = unroller_.side(i).next) numbers_.push_back(i);
    std::reverse(numbers_.begin(), numbers_.end());
    for (const Index i : numbers_) {
      const UnrolledSide<T>& u = unroller_.side(i);
      if (u.lenses != kNoIndex) keep_lenses(written + static_cast<Index>(sides_.size()), unroller_.lenses(u));
      sides_.push_back({u.end, u.dark, u.side});
      angles_.push_back(u.angle);
    }
    const auto number = [&](SideName name) {
      if (!name.is_unrolled()) return name.number();
      const auto at = std::lower_bound(numbers_.begin(), numbers_.end(), name.number());
      return before + static_cast<Index>(at - numbers_.begin());
    };
    for (Index i = unroller_.first_update(v); i != kNoIndex; i = unroller_.update(i).next) {
      const UnrolledUpdate<T>& u = unroller_.update(i);
      add_update(number(u.support), number(u.target), u.update.bits, u.length, u.need);
    }
  }

  // Along the edges of faces that name a vertex twice: they have no direction.
  void add_conduits(Index v) {
    for (const Index h : mesh_.corners(v)) {
      if (mesh_.is_face_usable(Mesh::face_of(h))) continue;
      for (const Index g : {h, Mesh::previous(h)}) {
        const Index end = mesh_.from(g) == v ? mesh_.to(g) : mesh_.from(g);
        if (end == v) continue;
        Side<T> side{};
        side.length = static_cast<T>(mesh_.length(g));
        side.c = side.end_c = 0;
        side.end_bends = of_fans_.bends_light(end) ? 1 : 0;
        sides_.push_back({end, {}, side});
      }
    }
  }

  const Mesh& mesh_;
  std::span<const Index> offsets_, corners_;
  const Index* vertices_;  // of the faces: the beginning of each halfedge
  Sides<T> of_fans_;
  Unroller<T> unroller_;
  Poll poll_;
  Records<T> out_;
  std::vector<bool> may_have_lenses_;  // [vertex_count]; empty: none has
  // Of the vertex at hand.
  RecordHead<T> head_;
  UninitializedArray<DraftSide<T>> sides_;
  UninitializedArray<DraftUpdate<T>> updates_, merged_;
  UninitializedArray<float> angles_;  // of sides
  std::vector<LensNumbers> lenses_;   // of the first sides; the others have none
  std::vector<Index> numbers_;        // of its unrolled sides
};

}  // namespace

template <class T>
Records<T> build_records(const Mesh& mesh) {
  return RecordBuilder<T>(mesh).build();
}

template Records<float> build_records<float>(const Mesh& mesh);
template Records<double> build_records<double>(const Mesh& mesh);

}  // namespace brushfire::carried_source
