// The rings of rings.h, eight corners at a time.
namespace brushfire::carried_source::BRUSHFIRE_TARGET {
using namespace lanes::BRUSHFIRE_TARGET;
using fast_marching::BRUSHFIRE_TARGET::RegularRing;

// Unit vectors of the corners, and their angles; lanes that are not used are void.
BRUSHFIRE_INLINE void measure_corners(const RegularRing<double>& lanes, Ring& ring, double* c, double* s,
                                      float* angle) {
  using Wide = Lanes<double, kLanes>;
  const auto m = lanes.measures();
  ring.count = m.count;
  const Wide inverse = Wide(1) / square_root(m.dot * m.dot + m.cross * m.cross);
  const Wide cosine = m.dot * inverse, sine = m.cross * inverse;
  const Wide here = m.length * m.length, there = m.next_length * m.next_length;
  ring.obtuse = bits(2 * (there - m.dot) < Wide(-kRightAngle) * here) & bits(first_lanes<kLanes>(m.count));
  store(ring.corner, m.corners);
  store(ring.length, m.length);
  store(c, cosine);
  store(s, sine);
  store(angle, fast_marching::BRUSHFIRE_TARGET::quick_angle(converted<float>(cosine), converted<float>(sine)));
}

// From corners to directions.
BRUSHFIRE_INLINE void add_up(Ring& ring, const double* c, const double* s, const float* angle) {
  double at_c = 1, at_s = 0;
  float sum = 0;
  for (Index i = 0; i < ring.count; ++i) {
    ring.c[i] = at_c, ring.s[i] = at_s, ring.angle[i] = sum;
    const double next_c = at_c * c[i] - at_s * s[i], next_s = at_c * s[i] + at_s * c[i];
    const double shorter = 1.5 - 0.5 * (next_c * next_c + next_s * next_s);  // of unit length again
    at_c = shorter * next_c, at_s = shorter * next_s;
    sum += angle[i];
  }
  ring.c[ring.count] = at_c, ring.s[ring.count] = at_s, ring.angle[ring.count] = sum;
  for (Index i = ring.count + 1; i < 2 * kLanes; ++i) ring.angle[i] = std::numeric_limits<float>::infinity();
}

// As sight_of() has it, of all sectors at once: sector k reaches from angle k to angle k + 1; `before` and `behind` the
// direction. kSaddle: all of them together are more than a full turn.
template <bool kSaddle>
BRUSHFIRE_INLINE SightSets sets_at(float at, const float* angle, Index count, std::uint32_t before,
                                   std::uint32_t behind) {
  using V = Lanes<float, kLanes>;
  constexpr float kHalf = static_cast<float>(kPi), kTurn = static_cast<float>(2 * kPi);
  const V low = load<V>(angle), high = load<V>(angle + 1);
  const float rest = angle[count] - kHalf;
  const std::uint32_t left = behind & bits(V(at + rest) < high), right = before & bits(low < V(at - rest));
  // What begins more than half a turn before, and what ends more than that behind.
  const std::uint32_t far_before = bits(low < V(at - kHalf)), far_behind = bits(V(at + kHalf) < high);
  std::uint32_t left_dark = before & far_before >> 1, right_dark = behind & far_behind << 1;
  if constexpr (kSaddle) {
    left_dark |= before & bits(low < V(at - kTurn));
    right_dark |= behind & bits(V(at + kTurn) < high);
  }
  left_dark |= behind & ~left & far_behind, right_dark |= before & ~right & far_before;
  return {{static_cast<SectorSet>(left), static_cast<SectorSet>(right)},
          {static_cast<SectorSet>(left_dark), static_cast<SectorSet>(right_dark)}};
}

template <bool kSaddle>
BRUSHFIRE_INLINE void find_sets(Ring& ring) {
  const std::uint32_t all = (1u << ring.count) - 1;
  for (Index i = 0; i < ring.count; ++i) {
    const std::uint32_t before = (1u << i) - 1;
    ring.sets[i] = sets_at<kSaddle>(ring.angle[i], ring.angle, ring.count, before, all & ~before);
  }
}

// The same of a direction inside of a sector.
inline SightSets sets_inside(Index sector, float at, const float* angle, Index count) {
  const std::uint32_t all = (1u << count) - 1, before = (1u << sector) - 1;
  return sets_at<true>(at, angle, count, before, all & ~(2 * before + 1));
}

// The sector that holds an angle.
inline Index sector_at(float at, const float* angle, Index count) {
  using V = Lanes<float, kLanes>;
  const std::uint32_t begun = bits(load<V>(angle) <= V(at)) & ((1u << count) - 1);
  return begun == 0 ? 0 : static_cast<Index>(std::bit_width(begun)) - 1;
}

// Of vertices first .. first + count - 1; count <= kRingsAtOnce. Stage by stage, for all vertices each.
inline void measure_rings(const RingMesh& mesh, Index first, Index count, Ring* rings) {
  RegularRing<double> lanes[kRingsAtOnce];
  alignas(64) double c[kRingsAtOnce][kLanes], s[kRingsAtOnce][kLanes];
  alignas(32) float angle[kRingsAtOnce][kLanes];
  fast_marching::BRUSHFIRE_TARGET::prefetch_rings_after(mesh, first + count);
  for (Index i = 0; i < count; ++i) rings[i].is_regular = lanes[i].find_corners(mesh, first + i);
  for (Index i = 0; i < count; ++i) {
    if (rings[i].is_regular) lanes[i].find_ends(mesh, first + i);
  }
  for (Index i = 0; i < count; ++i) {
    if (rings[i].is_regular) rings[i].is_regular = lanes[i].find_links(first + i) && lanes[i].put_in_order();
  }
  for (Index i = 0; i < count; ++i) {
    if (rings[i].is_regular) lanes[i].measure_sides(mesh, first + i);
  }
  for (Index i = 0; i < count; ++i) {
    if (rings[i].is_regular) rings[i].is_regular = lanes[i].measure();
  }
  for (Index i = 0; i < count; ++i) {
    if (rings[i].is_regular) measure_corners(lanes[i], rings[i], c[i], s[i], angle[i]);
  }
  for (Index i = 0; i < count; ++i) {
    if (rings[i].is_regular) add_up(rings[i], c[i], s[i], angle[i]);
  }
  for (Index i = 0; i < count; ++i) {
    if (!rings[i].is_regular) continue;
    if (rings[i].angle[rings[i].count] > static_cast<float>(2 * kPi)) {
      find_sets<true>(rings[i]);
    } else {
      find_sets<false>(rings[i]);
    }
  }
}

}  // namespace brushfire::carried_source::BRUSHFIRE_TARGET
