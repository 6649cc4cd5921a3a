// All offers of a batch: as offers of one source are worked out by themselves (march.cpp), to the bit.
namespace brushfire::carried_source::BRUSHFIRE_TARGET {
using namespace lanes::BRUSHFIRE_TARGET;

template <class T>
inline void work_out(OfferBatch<T>& batch) {
  using Batch = OfferBatch<T>;
  using V = Lanes<T, Batch::kLanes>;
  using Facts = Lanes<std::uint32_t, Batch::kLanes>;
  const Facts facts = load<Facts>(batch.facts), sectors = load<Facts>(batch.sectors);
  const Facts turned = load<Facts>(batch.turned) & sectors, dark = load<Facts>(batch.dark) & sectors;
  const Facts here(std::uint32_t{Batch::kHere}), there(std::uint32_t{Batch::kThere});
  const V one(T(1)), minus(T(-1)), never(BendingEnds<V>::kNever), grazing(kGrazing<T>);
  V at_v, sigma_v, px_v, py_v, at_b, sigma_b, px_b, py_b;
  load_fours(&batch.here[0].a, at_v, sigma_v, px_v, py_v);
  load_fours(&batch.there[0].a, at_b, sigma_b, px_b, py_b);
  V length, by_c, by_s, by_end_c, to_length, to_c, to_s, to_end_c, by_end_s, to_end_s, end_c, end_s;
  load_fours(&batch.by[0].a, length, by_c, by_s, by_end_c);
  load_fours(&batch.to[0].a, to_length, to_c, to_s, to_end_c);
  load_fours(&batch.ends[0].a, by_end_s, to_end_s, end_c, end_s);
  V around_c, around_s, around_bc, around_bs, tc, ts;
  load_fours(&batch.around[0].a, around_c, around_s, around_bc, around_bs);

  const V side = select(mask_cast<T>(share_bits(facts, Facts(Update::kHere))), minus, one);
  turn_round(by_c, by_s, side, around_c, around_s, tc, ts);
  const SourceAt<V> a = source_below<V>(at_v, sigma_v, px_v, py_v, mask_cast<T>(share_bits(turned, here)),
                                        mask_cast<T>(share_bits(dark, here)), by_c, by_s, tc, ts, side, length);
  const V side_b = select(mask_cast<T>(share_bits(facts, Facts(Update::kThere))), minus, one);
  turn_round(by_end_c, by_end_s, side_b, around_bc, around_bs, tc, ts);
  SourceAt<V> b = source_below<V>(at_b, sigma_b, px_b, py_b, mask_cast<T>(share_bits(turned, there)),
                                  mask_cast<T>(share_bits(dark, there)), by_end_c, by_end_s, tc, ts, side_b, length);
  b.x = length - b.x;

  turn_round(to_c, to_s, side, around_c, around_s, tc, ts);
  const auto across = mask_cast<T>(share_bits(facts, Facts(Update::kAcross)));
  const auto seam = mask_cast<T>(share_bits(facts, Facts(Update::kSeam)));
  const V sign = select(mask_cast<T>(share_bits(facts, Facts(Update::kSameTurn))), one, minus);
  const OfferFrame<V> f = frame_over(by_c, by_s, select(across, tc, to_c), select(across, ts, to_s), to_length,
                                     select(seam, end_c, to_end_c), select(seam, end_s, to_end_s), sign);
  const BendingEnds<V> bending{
      select(mask_cast<T>(share_bits(facts, Facts(std::uint32_t{Batch::kBendsHere}))), grazing, never),
      select(mask_cast<T>(share_bits(facts, Facts(std::uint32_t{Batch::kBendsThere}))), grazing, never)};
  const Offer<V> o = offer_over<V>(length, f.x, f.y, to_length, at_v, at_b, a, b, bending);
  const V oy = f.sign * o.y;
  store(batch.value, o.value);
  store(batch.sigma, o.sigma);
  store(batch.x, o.x * f.turn_c - oy * f.turn_s);
  store(batch.y, o.x * f.turn_s + oy * f.turn_c);
}

}  // namespace brushfire::carried_source::BRUSHFIRE_TARGET
