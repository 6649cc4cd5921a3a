// The rings of rings.h, eight corners at a time.
namespace brushfire::carried_source::BRUSHFIRE_TARGET {
using namespace lanes::BRUSHFIRE_TARGET;
using fast_marching::BRUSHFIRE_TARGET::RegularRing;

// Unit vectors of the corners, and their angles; lanes that are not used are void.
BRUSHFIRE_INLINE void measure_corners(const RegularRing<double>& lanes, Ring& ring, double* c, double* s, float* angle) {
  using Wide = Lanes<double, kLanes>;
  const auto m = lanes.measures();
  ring.count = m.count;
  const Wide inverse = Wide(1) / (m.length * m.next_length), cosine = m.dot * inverse, sine = m.cross * inverse;
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
    const double next_c = at_c * c[i] - at_s * s[i];
    at_s = at_c * s[i] + at_s * c[i], at_c = next_c;
    sum += angle[i];
  }
  ring.c[ring.count] = at_c, ring.s[ring.count] = at_s, ring.angle[ring.count] = sum;
  for (Index i = ring.count + 1; i < 2 * kLanes; ++i) ring.angle[i] = std::numeric_limits<float>::infinity();
}

// As sight_of() has it, of all sectors at once: sector k reaches from side k to side k + 1.
BRUSHFIRE_INLINE void find_sets(Ring& ring) {
  using V = Lanes<float, kLanes>;
  constexpr float kHalf = static_cast<float>(kPi), kTurn = static_cast<float>(2 * kPi);
  const V low = load<V>(ring.angle), high = load<V>(ring.angle + 1);
  const float rest = ring.angle[ring.count] - kHalf;
  const std::uint32_t all = (1u << ring.count) - 1;
  for (Index i = 0; i < ring.count; ++i) {
    const float at = ring.angle[i];
    const std::uint32_t before = (1u << i) - 1, behind = all & ~before;
    const std::uint32_t left = behind & bits(V(at + rest) < high), right = before & bits(low < V(at - rest));
    const std::uint32_t left_dark = (before & (bits(high < V(at - kHalf)) | bits(low < V(at - kTurn)))) |
                                    (behind & ~left & bits(V(at + kHalf) < high));
    const std::uint32_t right_dark = (behind & (bits(V(at + kHalf) < low) | bits(V(at + kTurn) < high))) |
                                     (before & ~right & bits(low < V(at - kHalf)));
    ring.turned[0][i] = static_cast<SectorSet>(left), ring.turned[1][i] = static_cast<SectorSet>(right);
    ring.dark[0][i] = static_cast<SectorSet>(left_dark), ring.dark[1][i] = static_cast<SectorSet>(right_dark);
  }
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
    if (rings[i].is_regular) find_sets(rings[i]);
  }
}

}  // namespace brushfire::carried_source::BRUSHFIRE_TARGET
