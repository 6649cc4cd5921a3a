// Turns of vertices in buckets of their values.
#include <brushfire/solvers/carried_source/detail/march.h>

#include <brushfire/core/detail/prefault.h>
#include <brushfire/core/detail/prefetch.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/solvers/carried_source/detail/march_constants.h>
#include <brushfire/solvers/carried_source/detail/offer_frame.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace brushfire::carried_source {
namespace {

constexpr std::size_t kFrontAhead = 16, kRecordAhead = 10, kEndsAhead = 5, kRecordLines = 9, kCacheLine = 64;
constexpr Index kUsualSides = 8;

}  // namespace

template <class T>
struct March<T>::Turn {
  const Front& front;
  const Record<T>& record;
  const SideEnd<T>* ends;
  const Side<T>* sides;
  const DarkSets* dark;
  const LensNumbers* lenses;  // null: none
  Front* fronts;
  std::uint32_t bends;  // OfferBatch::kBendsHere, or 0
};

template <class T>
March<T>::March(const Records<T>& records) : records_(records), fronts_(records.vertex_count) {
  // Looked up in no order that a TLB could hold.
  PagesAhead pages(fronts_.data(), fronts_.size() * sizeof(Front));
  for (Index v = 0; v < records.vertex_count; ++v) {
    pages.reach(&fronts_[v]);
    fronts_[v] = {};
    fronts_[v].around = records.around[v];
  }
  // One more than there can be: the last one is written and not counted.
  lists_.ahead.resize(records.most_sides + 1), lists_.alongs.resize(records.most_sides + 1);
  lists_.offers.resize(records.most_updates + 1);
  per_unit_ = static_cast<T>(1 / (kBucketWidth * records.mean_edge));
  slack_ = static_cast<T>(kSlack * records.mean_edge);
  settling_ = static_cast<T>(kSettling * records.mean_edge);
  farther_ = static_cast<T>(kFarther * records.mean_edge);
}

template <class T>
void March<T>::reset() {
  for (const Index v : touched_) {
    Front& f = fronts_[v];
    const Around<T> around = f.around;
    f = {};
    f.around = around;
  }
  touched_.clear();
  queue_.reset();
  turns_ = updates_ = 0;
  settled_ = 0;
}

template <class T>
void March<T>::begin_at(const Start<T>& s) {
  accept<true>(s.vertex, {s.value, s.sigma, s.x, s.y}, s.sector, s.label);
}

template <class T>
typename March<T>::Carried March<T>::carried(Index v) const {
  const Front& f = fronts_[v];
  return {f.sigma, f.x, f.y, static_cast<Index>(std::countr_zero(f.sector))};
}

template <class T>
BucketQueue::Bucket March<T>::bucket_of(T value) const {
  constexpr T kLast = T(0x1p60);
  const T bucket = value * per_unit_;
  return static_cast<BucketQueue::Bucket>(bucket < kLast ? bucket : kLast);
}

template <class T>
template <bool kLabelled>
BRUSHFIRE_INLINE void March<T>::accept(Index v, const Offer<T>& o, Index sector, Index label) {
  Front& f = fronts_[v];
  if (f.value < settled_) return;
  const bool news = o.value < f.value * kNews<T>;
  const bool tie = (o.value < f.value * kTie<T>)&(o.sigma < f.sigma - farther_);
  bool lower_label = false;
  if constexpr (kLabelled) lower_label = (o.value <= f.value) & (label < f.label) & (o.value < kUnreached);
  if constexpr (kLabelled) {
    if (!news && !(tie && label == f.label) && !lower_label) return;
  } else {
    if (!(news | tie)) return;
  }
  const T old = f.value;
  f.value = std::min(o.value, old), f.sigma = o.sigma, f.x = o.x, f.y = o.y;
  f.sector = static_cast<SectorSet>(1u << sector);
  f.label = label;
  const BucketQueue::Bucket bucket = bucket_of(f.value);
  const bool waits = (f.state == kWaiting) & (bucket == bucket_of(old));
  touched_.push_if(f.state == kAway, v);
  wait_for_turn(f, v, waits, bucket);
}

template <class T>
BRUSHFIRE_INLINE void March<T>::wait_for_turn(Front& f, Index v, bool is_in_bucket, BucketQueue::Bucket bucket) {
  if (f.turns >= kMostTurns) return;
  f.state = kWaiting;
  queue_.push_if(!is_in_bucket, v, bucket);
}

// A vertex's source in the frame of a side, from the vertex (or the side's end) on.
template <class T>
BRUSHFIRE_INLINE SourceAt<T> March<T>::see(const Front& f, const Side<T>& side, bool at_end, Index hand, Index lenses,
                                           SectorSet dark) const {
  if (lenses != kNoIndex) [[unlikely]] {
    const Lens& lens = records_.lenses[lenses][static_cast<std::size_t>(std::countr_zero(f.sector))];
    const T x = static_cast<T>(lens.xx) * f.x + static_cast<T>(lens.xy) * f.y;
    const T y = static_cast<T>(lens.yx) * f.x + static_cast<T>(lens.yy) * f.y;
    return source_below<T>(f.value, f.sigma, x, y, false, !lens.visible, 1, 0, 1, 0, 1, side.length);
  }
  const SideTurn<T> t =
      at_end ? side_turn(side.end_c, side.end_s, hand, f.around) : side_turn(side.c, side.s, hand, f.around);
  const SectorSet turned = at_end ? side.end_turned[hand] : side.turned[hand];
  return source_below<T>(f.value, f.sigma, f.x, f.y, (f.sector & turned) != 0, (f.sector & dark) != 0, t.c, t.s, t.tc,
                         t.ts, t.side, side.length);
}

template <class T>
template <bool kLabelled>
[[gnu::noinline]] void March<T>::offer_alone(const Turn& at, Index target, Update u, const Side<T>& to) {
  const Index support = u.support(), hand = u.hand(), there = u.hand_there();
  const Side<T>& by = at.sides[support];
  const Front& other = fronts_[at.ends[support].end];
  const SectorSet dark_here = at.dark[support].here[hand], dark_there = at.dark[support].end[there];
  const SourceAt<T> a = see(at.front, by, false, hand, at.lenses ? at.lenses[support].here[hand] : kNoIndex, dark_here);
  SourceAt<T> b = see(other, by, true, there, at.lenses ? at.lenses[support].end[there] : kNoIndex, dark_there);
  b.x = by.length - b.x;
  const OfferFrame<T> f = offer_frame(by, to, u, at.front.around, fronts_[target].around);
  const BendingEnds<T> bending{bending_by<T>(at.record.head().bends), bending_by<T>(by.end_bends)};
  const auto take = [&](const Offer<T>& o, Index label) {
    const T oy = f.sign * o.y;
    accept<kLabelled>(target, {o.value, o.sigma, o.x * f.turn_c - oy * f.turn_s, o.x * f.turn_s + oy * f.turn_c},
                      u.sector(), label);
  };
  if (kLabelled && other.label != at.front.label) {
    take(offer_beside<T>(by.length, f.x, f.y, to.length, at.front.value, other.value, a, bending), at.front.label);
    const T x = by.length - f.x, beyond = std::sqrt(x * x + f.y * f.y);
    b.x = by.length - b.x;
    Offer<T> o =
        offer_beside<T>(by.length, x, f.y, beyond, other.value, at.front.value, b, {bending.at_b, bending.at_v});
    o.x = -o.x;
    take(o, other.label);
  } else {
    take(offer_over<T>(by.length, f.x, f.y, to.length, at.front.value, other.value, a, b, bending), at.front.label);
  }
}

template <class T>
template <bool kLabelled>
BRUSHFIRE_INLINE void March<T>::add_offer(const Turn& at, Index target, Update u, const Side<T>& to) {
  const Index support = u.support(), hand = u.hand(), there = u.hand_there();
  const Side<T>& by = at.sides[support];
  const Front& other = at.fronts[at.ends[support].end];
  Front& end = at.fronts[target];
  using Batch = OfferBatch<T>;
  Batch& batch = batch_;
  const int i = batch.count;
  batch.facts[i] = (u.bits & (2 * Update::kAcross - 1)) | at.bends | by.end_bends * std::uint32_t{Batch::kBendsThere};
  batch.sectors[i] = at.front.sector | std::uint32_t{other.sector} << 16;
  batch.turned[i] = by.turned[hand] | std::uint32_t{by.end_turned[there]} << 16;
  batch.dark[i] = at.dark[support].here[hand] | std::uint32_t{at.dark[support].end[there]} << 16;
  batch.target[i] = target;
  batch.label[i] = at.front.label;
  batch.sector[i] = static_cast<std::uint8_t>(u.sector());
  batch.here[i] = {at.front.value, at.front.sigma, at.front.x, at.front.y};
  batch.there[i] = {other.value, other.sigma, other.x, other.y};
  batch.by[i] = {by.length, by.c, by.s, by.end_c};
  batch.to[i] = {to.length, to.c, to.s, to.end_c};
  batch.ends[i] = {by.end_s, to.end_s, end.around.c, end.around.s};
  batch.around[i] = {at.front.around.c, at.front.around.s, other.around.c, other.around.s};
  end.has_offer = 1;
  batch.count = i + 1;
  if (batch.count == Batch::kLanes) take_offers<kLabelled>();
}

template <class T>
template <bool kLabelled>
[[gnu::noinline]] void March<T>::take_offers() {
  OfferBatch<T>& b = batch_;
  if (b.count == 0) return;
  BRUSHFIRE_ON_TARGET(Variant::Best, work_out(b));
  for (int i = 0; i < b.count; ++i) {
    fronts_[b.target[i]].has_offer = 0;
    accept<kLabelled>(b.target[i], {b.value[i], b.sigma[i], b.x[i], b.y[i]}, b.sector[i], b.label[i]);
  }
  b.count = 0;
}

template <class T>
template <bool kLabelled>
BRUSHFIRE_INLINE void March<T>::offer_along(const Turn& at, Index k) {
  const Side<T>& side = at.sides[k];
  const Index end = at.ends[k].end;
  Front& f = at.fronts[end];
  const T x = side.length * side.end_c, y = side.length * side.end_s, value = at.front.value + side.length;
  const bool conduit = (side.end_c == 0) & (side.end_s == 0);
  const T sigma = conduit ? value : at.front.value;
  if (f.state != kAway) {
    accept<kLabelled>(end, {value, sigma, x, y}, side.sector, at.front.label);
    return;
  }
  // The first one that comes there, as most of these are.
  f.value = value, f.sigma = sigma, f.x = x, f.y = y;
  f.sector = static_cast<SectorSet>(1u << side.sector);
  f.label = at.front.label;
  touched_.push(end);
  wait_for_turn(f, end, false, bucket_of(value));
}

template <class T>
template <bool kLabelled>
BRUSHFIRE_INLINE void March<T>::turn(Index v) {
  Front* const fronts = fronts_.data();
  Front& f = fronts[v];
  if (f.has_offer) take_offers<kLabelled>();
  f.state = kClosed;
  ++f.turns, ++turns_;
  const Record<T> record = records_[v];
  const RecordHead<T>& head = record.head();
  const Front front = f;
  const Turn at{front,         record,
                record.ends(), record.sides(),
                record.dark(), head.has_lenses ? record.lenses() : nullptr,
                fronts,        head.bends * std::uint32_t{OfferBatch<T>::kBendsHere}};
  const Update* const updates = record.updates();
  const T r = front.value - front.sigma, later = r > head.reach ? 1 / (r - head.reach) : kAnywhere<T>;
  const T now = front.value - slack_;
  // Lists are made without branches: which sides lead ahead and which ends are closed cannot be foreseen.
  Index ahead = 0, offers = 0, alongs = 0;
  const Index sides = head.sides;
  Index* const ahead_of = lists_.ahead.data();
  Index* const alongs_of = lists_.alongs.data();
  PlannedOffer* const planned = lists_.offers.data();
  for (Index k = 0; k < sides; ++k) {
    const SideEnd<T>& e = at.ends[k];
    ahead_of[ahead] = k;
    ahead += fronts[e.end].value > now + e.need - e.bulge * later ? 1u : 0u;
  }
  for (Index i = 0; i < ahead; ++i) {
    const Index k = ahead_of[i], before = offers, end = at.ends[k + 1].first_update;
    for (Index u = at.ends[k].first_update; u < end; ++u) {
      planned[offers] = {k, updates[u]};
      offers += fronts[at.ends[updates[u].support()].end].state == kClosed ? 1u : 0u;
    }
    alongs_of[alongs] = k;
    alongs += offers == before ? 1u : 0u;
  }
  updates_ += offers;
  for (Index i = 0; i < offers; ++i) {
    const auto [k, update] = planned[i];
    const Front& support = fronts[at.ends[update.support()].end];
    if (support.has_offer) [[unlikely]] {
      take_offers<kLabelled>();
      if (support.state != kClosed) {  // it fell: the offer is for its own turn
        offer_along<kLabelled>(at, k);
        continue;
      }
    }
    bool alone = at.lenses != nullptr;
    if constexpr (kLabelled) alone |= support.label != front.label;
    if (alone) [[unlikely]] {
      offer_alone<kLabelled>(at, at.ends[k].end, update, at.sides[k]);
    } else {
      add_offer<kLabelled>(at, at.ends[k].end, update, at.sides[k]);
    }
  }
  for (Index i = 0; i < alongs; ++i) offer_along<kLabelled>(at, alongs_of[i]);
}

// In passes: what falls into the bucket while it is worked on has its turn afterwards, by its value. Where edges are
// much shorter than the bucket is wide, corrections run through it in order then, instead of chasing each other.
template <class T>
template <bool kLabelled>
void March<T>::work_labelled() {
  for (std::size_t begin = 0, end = 0; (end = queue_.current().size()) > begin; begin = end) {
    pass_.assign(queue_.current().begin() + begin, queue_.current().end());
    if (begin > 0) {
      detail::sort(pass_.begin(), pass_.end(), [&](Index v, Index w) {
        return fronts_[v].value != fronts_[w].value ? fronts_[v].value < fronts_[w].value : v < w;
      });
    }
    for (std::size_t i = 0; i < pass_.size(); ++i) {
      // Written here: compilers take a function that only asks ahead for one that does nothing.
      if (i + kFrontAhead < pass_.size()) {
        prefetch(&fronts_[pass_[i + kFrontAhead]]);
        prefetch(&records_.offset[pass_[i + kFrontAhead]]);
      }
      if (i + kRecordAhead < pass_.size()) {
        const std::byte* const at = records_.base() + records_.offset[pass_[i + kRecordAhead]];
        for (std::size_t k = 0; k < kRecordLines; ++k) prefetch(at + k * kCacheLine);
      }
      if (i + kEndsAhead < pass_.size()) {
        // Where there are fewer, the end behind them again and again: how many there are cannot be foreseen.
        const Record<T> record = records_[pass_[i + kEndsAhead]];
        const Index sides = record.head().sides;
        for (Index k = 0; k < kUsualSides; ++k) prefetch(&fronts_[record.ends()[std::min(k, sides)].end]);
      }
      if (fronts_[pass_[i]].state == kWaiting) turn<kLabelled>(pass_[i]);
    }
    take_offers<kLabelled>();
  }
  queue_.clear_current();
}

template <class T>
void March<T>::work() {
  settled_ = settled();
  if (labelled_) {
    work_labelled<true>();
  } else {
    work_labelled<false>();
  }
}

template class March<float>;
template class March<double>;

}  // namespace brushfire::carried_source
