// The loops of a march of sixteen lanes. As march.cpp has them for one source.
namespace brushfire::carried_source::BRUSHFIRE_TARGET {
using namespace lanes::BRUSHFIRE_TARGET;

using Values = Lanes<float, kGroupLanes>;
using Sectors = Lanes<std::uint32_t, kGroupLanes>;

// A vertex's front in all lanes.
struct FrontLanes {
  Values value, sigma, x, y;
  Sectors sector;
};
BRUSHFIRE_INLINE FrontLanes front_lanes(const GroupFront& f) {
  return {load<Values>(f.value), load<Values>(f.sigma), load<Values>(f.x), load<Values>(f.y),
          load_words<Sectors>(f.sector)};
}

// At odd vertices, where every lane may look through another lens.
[[gnu::noinline]] inline SourceAt<Values> see_through(const Lenses& lenses, const GroupFront& f, float length) {
  alignas(64) float x[kGroupLanes], y[kGroupLanes];
  std::uint32_t dark[kGroupLanes];
  for (int k = 0; k < kGroupLanes; ++k) {
    const Lens& lens = lenses[static_cast<std::size_t>(std::countr_zero(f.sector[k]))];
    x[k] = static_cast<float>(lens.xx) * f.x[k] + static_cast<float>(lens.xy) * f.y[k];
    y[k] = static_cast<float>(lens.yx) * f.x[k] + static_cast<float>(lens.yy) * f.y[k];
    dark[k] = lens.visible ? 0 : 1;
  }
  const MaskFor<Values> is_dark = share_bits(load<Sectors>(dark), Sectors(1u));
  return source_below<Values>(load<Values>(f.value), load<Values>(f.sigma), load<Values>(x), load<Values>(y),
                              is_dark ^ is_dark, is_dark, 1, 0, 1, 0, 1, length);
}

// The sources of a vertex in the frame of a side, from the vertex (or the side's end) on.
BRUSHFIRE_INLINE SourceAt<Values> see(const FrontLanes& f, const SideTurn<float>& t, SectorSet turned, SectorSet dark,
                                      float length) {
  return source_below<Values>(f.value, f.sigma, f.x, f.y, share_bits(f.sector, Sectors(std::uint32_t{turned})),
                              share_bits(f.sector, Sectors(std::uint32_t{dark})), t.c, t.s, t.tc, t.ts, t.side, length);
}

// Without branches: what comes of an offer is known late.
BRUSHFIRE_INLINE void accept(GroupState& s, Index v, const Offer<Values>& o, Index sector) {
  GroupFront& f = s.fronts[v];
  const Values old = load<Values>(f.value), old_sigma = load<Values>(f.sigma);
  const auto news = o.value < old * Values(kNews<float>);
  const auto tie = (o.value < old * Values(kTie<float>)) & (o.sigma < old_sigma - Values(s.farther));
  const auto set = (news | tie) & (Values(s.settled) <= old);
  store(f.value, select(set, lesser(o.value, old), old));
  store(f.sigma, select(set, o.sigma, old_sigma));
  store(f.x, select(set, o.x, load<Values>(f.x)));
  store(f.y, select(set, o.y, load<Values>(f.y)));
  store_words(f.sector, select(set, Sectors(1u << sector), load_words<Sectors>(f.sector)));
  s.fronts[v].own.fresh |= bits(set);
}

struct GroupTurn {
  Index vertex;
  FrontLanes front;
  Around<float> around;
  std::uint8_t bends;
  const SideEnd<float>* ends;
  const Side<float>* sides;
  const DarkSets* dark;
  const LensNumbers* lenses;  // null: none
};

BRUSHFIRE_INLINE void offer(GroupState& s, const Records<float>& records, const GroupTurn& at, const Index target,
                            Update u, const Side<float>& to) {
  const Index support = u.support(), hand = u.hand(), there = u.hand_there(), end = at.ends[support].end;
  const Side<float>& by = at.sides[support];
  const FrontLanes other = front_lanes(s.fronts[end]);
  const SectorSet dark_here = at.dark[support].here[hand], dark_there = at.dark[support].end[there];
  SourceAt<Values> a = see(at.front, side_turn(by.c, by.s, hand, at.around), by.turned[hand], dark_here, by.length);
  SourceAt<Values> b = see(other, side_turn(by.end_c, by.end_s, there, s.fronts[end].own.around), by.end_turned[there],
                           dark_there, by.length);
  if (at.lenses) [[unlikely]] {
    const LensNumbers& lenses = at.lenses[support];
    if (lenses.here[hand] != kNoIndex) {
      a = see_through(records.lenses[lenses.here[hand]], s.fronts[at.vertex], by.length);
    }
    if (lenses.end[there] != kNoIndex) b = see_through(records.lenses[lenses.end[there]], s.fronts[end], by.length);
  }
  b.x = Values(by.length) - b.x;
  const auto f = offer_frame(by, to, u, at.around, s.fronts[target].own.around);
  const BendingEnds<Values> bending{bending_by<float>(at.bends), bending_by<float>(by.end_bends)};
  const Offer<Values> o =
      offer_over<Values>(by.length, f.x, f.y, to.length, at.front.value, other.value, a, b, bending);
  const Values c(f.turn_c), sine(f.turn_s), oy = Values(f.sign) * o.y;
  accept(s, target, {o.value, o.sigma, o.x * c - oy * sine, o.x * sine + oy * c}, u.sector());
}

BRUSHFIRE_INLINE void offer_along(GroupState& s, const GroupTurn& at, Index k) {
  const Side<float>& side = at.sides[k];
  const float x = side.length * side.end_c, y = side.length * side.end_s;
  const Values value = at.front.value + Values(side.length);
  const bool conduit = (side.end_c == 0) & (side.end_s == 0);
  accept(s, at.ends[k].end, {value, conduit ? value : at.front.value, Values(x), Values(y)}, side.sector);
}

// Lists are made without branches: which sides lead ahead and which ends are closed cannot be foreseen.
BRUSHFIRE_INLINE void turn(GroupState& s, const Records<float>& records, Index v) {
  GroupVertex& own = s.fronts[v].own;
  // Nothing is new in the other lanes: what they offer was offered before.
  const std::uint32_t live = own.fresh >= GroupVertex::kNew ? GroupVertex::kLanes : own.fresh | own.owed;
  own.fresh = own.owed = 0;
  ++own.turns, ++s.turns;
  const Record<float> record = records[v];
  const RecordHead<float>& head = record.head();
  const GroupTurn at{v,
                     front_lanes(s.fronts[v]),
                     own.around,
                     head.bends,
                     record.ends(),
                     record.sides(),
                     record.dark(),
                     head.has_lenses ? record.lenses() : nullptr};
  const Update* const updates = record.updates();
  const Values r = at.front.value - at.front.sigma, reach(head.reach), now = at.front.value - Values(s.slack);
  const Values later = select(reach < r, Values(1.0f) / (r - reach), Values(kAnywhere<float>));
  Index ahead = 0, offers = 0, alongs = 0;
  for (Index k = 0; k < head.sides; ++k) {
    const SideEnd<float>& e = at.ends[k];
    GroupFront& end = s.fronts[e.end];
    s.ahead[ahead] = k;
    const auto later_there = now + Values(e.need) - Values(e.bulge) * later < load<Values>(end.value);
    ahead += (bits(later_there) & live) != 0 ? 1u : 0u;
    s.closed[k] = end.own.fresh == 0 ? 1 : 0;
    // It will come to them in its own turn; in its first one to all lanes.
    const bool comes_again = end.own.fresh - 1 < GroupVertex::kLanes;  // neither 0 nor new
    end.own.owed |= comes_again ? live : 0;
  }
  for (Index i = 0; i < ahead; ++i) {
    const Index k = s.ahead[i], before = offers, end = at.ends[k].end;
    for (Index u = at.ends[k].first_update; u < at.ends[k + 1].first_update; ++u) {
      s.offers[offers] = {k, updates[u]};
      offers += s.closed[updates[u].support()];
    }
    s.alongs[alongs] = k;
    alongs += offers == before ? 1u : 0u;
    s.fallen.push_if(!s.fronts[end].own.listed, end);
    s.fronts[end].own.listed = true;
  }
  for (Index i = 0; i < offers; ++i) {
    const auto [k, update] = s.offers[i];
    offer(s, records, at, at.ends[k].end, update, at.sides[k]);
  }
  for (Index i = 0; i < alongs; ++i) offer_along(s, at, s.alongs[i]);
  s.updates += offers;
}

// The mean of the lanes that have a value; those that have none yet come later.
BRUSHFIRE_INLINE float key_of(const GroupState& s, const GroupFront& f) {
  const Values value = load<Values>(f.value);
  const MaskFor<Values> there = value < Values(GroupState::kUnreached);
  const int count = std::popcount(bits(there));
  return sum(select(there, value, Values(0.0f))) / static_cast<float>(count) +
         static_cast<float>(s.lanes - count) * s.later;
}

// Those that did fall in a pass wait for their turn: in the next pass of this bucket, or in a later one.
BRUSHFIRE_INLINE void sort_in(GroupState& s) {
  s.next.clear();
  for (const Index v : s.fallen) {
    GroupVertex& own = s.fronts[v].own;
    own.listed = false;
    if ((own.fresh & GroupVertex::kLanes) == 0) continue;
    s.touched.push_if(!own.reached, v);
    own.reached = true;
    const Values value = load<Values>(s.fronts[v].value);
    if (!any(value <= Values(s.beyond))) continue;
    own.fresh &= bits(value <= Values(s.rim)) | GroupVertex::kNew;
    if (!own.waits_for_turn()) continue;
    s.exhausted |= own.turns >= s.most_turns;
    const float key = key_of(s, s.fronts[v]);
    const BucketQueue::Bucket bucket = group_bucket(key * s.per_unit);
    if (bucket <= s.queue.cursor()) {
      s.next.emplace_back(key, v);
    } else if (bucket < own.waits_in) {
      own.waits_in = bucket;
      s.queue.push(v, bucket);
    }
  }
  s.fallen.clear();
  std::sort(s.next.begin(), s.next.end());
  s.pass.clear();
  for (const auto& [key, v] : s.next) s.pass.push_back(v);
}

BRUSHFIRE_INLINE void prefetch_front(const GroupState& s, Index v) {
  const auto* const at = reinterpret_cast<const std::byte*>(&s.fronts[v]);
  for (std::size_t line = 0; line < sizeof(GroupFront); line += kCacheLine) prefetch(at + line);
}

// What begin_at() began, or the bucket at the cursor, with what falls into it meanwhile, in passes.
inline void work_group(GroupState& s, const Records<float>& records) {
  sort_in(s);
  if (s.pass.empty()) {
    s.pass.assign(s.queue.current().begin(), s.queue.current().end());
    s.queue.clear_current();
    for (const Index v : s.pass) s.fronts[v].own.waits_in = GroupVertex::kNowhere;
  }
  for (; !s.pass.empty() && !s.exhausted; sort_in(s)) {
    for (std::size_t i = 0; i < s.pass.size(); ++i) {
      // Written here: compilers take a function that only asks ahead for one that does nothing.
      if (i + kOffsetAhead < s.pass.size()) prefetch(&records.offset[s.pass[i + kOffsetAhead]]);
      if (i + kRecordAhead < s.pass.size()) {
        const Index v = s.pass[i + kRecordAhead];
        const std::byte* const at = records.base() + records.offset[v];
        for (std::size_t k = 0; k < kRecordLines; ++k) prefetch(at + k * kCacheLine);
        prefetch_front(s, v);
      }
      if (i + kEndsAhead < s.pass.size()) {
        const Record<float> record = records[s.pass[i + kEndsAhead]];
        const Index sides = std::min(kUsualSides, record.head().sides);
        for (Index k = 0; k < sides; ++k) prefetch_front(s, record.ends()[k].end);
      }
      if (s.fronts[s.pass[i]].own.waits_for_turn()) turn(s, records, s.pass[i]);
    }
  }
}

}  // namespace brushfire::carried_source::BRUSHFIRE_TARGET
