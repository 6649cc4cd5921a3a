// The update: what two vertices, each of which carries the (pseudo-)source that it is seen from, offer to a third one
// over the edge between them. Of one source (V: float or double), or of several at once, one to a lane.
//
// The frame of the edge: the vertex v that has its turn at (0,0), the other end b at (length,0), the target c above.
// Sources lie on or below the edge. Derivation, and what of it is proven: docs/decisions/marching.md.
namespace brushfire::carried_source::BRUSHFIRE_TARGET {
using namespace lanes::BRUSHFIRE_TARGET;

// A direction turned by the sum of a vertex's angles, the way round that `side` says.
template <class V>
BRUSHFIRE_INLINE void turn_round(V c, V s, V side, V around_c, V around_s, V& tc, V& ts) {
  const V turn = side * around_s;
  tc = c * around_c - s * turn, ts = s * around_c + c * turn;
}

// The target in the frame of the edge, and how vectors turn from there into the target's own frame.
template <class V>
struct OfferFrame {
  V x, y, sign, turn_c, turn_s;
};
// From directions in the vertex's frame, of the edge (bc, bs) and of the way to the target (tc, ts); c, s: of the way
// back in the target's; sign: -1 where angles at the target run the other way round, else 1.
template <class V>
BRUSHFIRE_INLINE OfferFrame<V> frame_over(V bc, V bs, V tc, V ts, V length, V c, V s, V sign) {
  const V x = length * (tc * bc + ts * bs), y = length * magnitude(ts * bc - tc * bs);
  const V inverse = V(NumberIn<V>(-1)) / length, sy = sign * y;
  return {x, y, sign, (c * x + s * sy) * inverse, (s * x - c * sy) * inverse};
}

// A source in the frame of an edge, and the value of the front there.
template <class V>
struct SourceAt {
  V x, y, sigma;
};

// A value, and the way from the target to its source, in the frame of the edge.
template <class V>
struct Offer {
  V value, sigma, x, y;
};

// A vector that is turned by the edge's direction at a vertex; above the edge, or in the dark, it is not what lights
// the edge: then the vertex is its own source.
//
// `turned`: the lanes that are turned by the whole angle around the vertex first; c, s: the edge's direction in the
// vertex's frame; tc, ts: the same less (or plus) that angle; side: 1 where the target lies to the left of the edge as
// it leaves the vertex, -1 where to the right.
template <class V>
BRUSHFIRE_INLINE SourceAt<V> source_below(V value, V sigma, V px, V py, MaskFor<V> turned, MaskFor<V> dark, V c, V s,
                                          V tc, V ts, V side, V length) {
  using T = NumberIn<V>;
  const V cc = select(turned, tc, c), ss = select(turned, ts, s), zero = V(T(0));
  const V x = px * cc + py * ss, y = side * (py * cc - px * ss);
  const MaskFor<V> own = dark | (V(kGrazing<T>) * (magnitude(x) + length) < y);
  return {select(own, zero, x), select(own, zero, y), select(own, value, sigma)};
}

// Ends of the edge that bend light: behind a saddle or a boundary there is a shadow. A ray that passes such an end by
// this share of its own length goes on from there, as from a source: it may be visible on one side of the ray only, and
// the nearer source is right on both. (Where it is visible, neighbours that see the farther one say so.)
template <class V>
struct BendingEnds {
  static constexpr NumberIn<V> kNever = -1;
  V at_v = kNever, at_b = kNever;  // kGrazing, or kNever
};

// The offer of v (value `at_v`, source a) and b (value `at_b`, source b, x from v as well) to c = (x, y). `along` is
// the distance from v to c; lanes of v or b that have no value must hold +inf.
//
// - e_a = T_b - (what a foretells at b), e_b likewise: 0 where one source lights both.
// - Each source sees c where its ray crosses the edge. Where both do, at the share s of the edge between them (s: the
//   mediant of both crossings), u = e_a s and w = e_b (1 - s) say who is first at the crossing: u + w <= 0: the fronts
//   meet there (concave), c sees the lesser value. Otherwise they part (convex): behind a saddle the greater value is
//   nearer, and where each comes before the other's end (u, w > 0) a fan opens between the two, with the rational
//   interpolant that keeps values and slopes at both ends and convexity between.
template <class V>
BRUSHFIRE_INLINE Offer<V> offer_over(V l, V x, V y, V along, V at_v, V at_b, const SourceAt<V>& a, const SourceAt<V>& b,
                                     const BendingEnds<V>& bending = {}) {
  using T = NumberIn<V>;
  const V zero = V(T(0)), one = V(T(1));
  // Whether they see c: crossing / wide is where, from v (0) to b (1).
  const V deep_a = y - a.y, deep_b = y - b.y, wide_a = l * deep_a, wide_b = l * deep_b;
  const V cross_a = a.x * y - x * a.y, cross_b = b.x * y - x * b.y;
  const V beside_a = V(kGrazing<T>) * wide_a, beside_b = V(kGrazing<T>) * wide_b;
  const auto seen_a = (zero <= cross_a + beside_a) & (cross_a <= wide_a + beside_a);
  const auto seen_b = (zero <= cross_b + beside_b) & (cross_b <= wide_b + beside_b);
  // What each foretells at the other end, and at c.
  const V over_a = l - a.x;
  const V miss_a = at_b - (a.sigma + square_root(over_a * over_a + a.y * a.y));
  const V miss_b = at_v - (b.sigma + square_root(b.x * b.x + b.y * b.y));
  const V ax = x - a.x, bx = x - b.x;
  const V far_a = square_root(ax * ax + deep_a * deep_a), far_b = square_root(bx * bx + deep_b * deep_b);
  const V value_a = a.sigma + far_a, value_b = b.sigma + far_b;
  const V share = (cross_a + cross_b) / (wide_a + wide_b);  // not a number where the triangle has no height
  const V u = miss_a * share, w = miss_b * (one - share), sum = u + w;
  // Less than rounding is no fan, and is not divided by.
  const V noise = V(8 * kEpsilon<T>) * at_v;
  const auto both = seen_a & seen_b;
  const auto fan = both & (noise < miss_a) & (noise < miss_b) & (zero < u) & (zero < w);
  // The one that c is seen by: the only one; of both, the lesser value or the greater.
  const auto first_seen = without(seen_b, seen_a) | (both & ((value_a < value_b) ^ (zero < sum)));
  V through = select(first_seen, value_a, value_b), part = select(first_seen, zero, one);
  V radius = select(first_seen, far_a, far_b), shorter = one;
  if (any(fan)) {
    const V inverse = one / select(fan, sum, one), m = select(first_seen, u, w);
    through = through + select(fan, m * m * inverse, zero);
    part = select(fan, u * inverse, part);
    // A front that opens is rounder than its sources are far.
    const V bend = (miss_a + miss_b) * (V(T(0.5)) / (l * l));
    shorter = one / select(fan, lesser(radius * bend + one, V(T(3))), one);
    const V fx = part * (b.x - a.x) - ax, fy = part * (b.y - a.y) - deep_a;
    radius = select(fan, square_root(fx * fx + fy * fy), radius);
  }
  const V edge = at_v + along;
  constexpr T kNever = std::numeric_limits<T>::infinity();
  const V cross = select(first_seen, cross_a, cross_b), wide = select(first_seen, wide_a, wide_b);
  const auto round_v = without(fan, cross < bending.at_v * wide);
  const auto round_b = without(fan, (one - bending.at_b) * wide < cross);
  // The way through v, whose source is nearer, does not win by rounding.
  const auto over =
      without(round_v, (seen_a | seen_b) & (through < V(kTie<T>) * edge) & (at_v < V(kNever)) & (at_b < V(kNever)));
  const auto straight = without(round_b, over);
  const V dx = select(straight, (part * (b.x - a.x) - ax) * shorter, select(over, l, zero) - x);
  const V dy = select(straight, (part * (b.y - a.y) - deep_a) * shorter, zero - y);
  const V value = select(over, through, edge);
  return {value, select(straight, through - radius * shorter, select(over, at_b, at_v)), dx, dy};
}

// Where v and b belong to different sources their fronts meet on the edge, and each one offers by itself: this one v's,
// past the edge where its light is not stopped before b, else along the side.
template <class V>
BRUSHFIRE_INLINE Offer<V> offer_beside(V length, V to_x, V to_y, V along, V at_v, V at_b, const SourceAt<V>& a,
                                       const BendingEnds<V>& bending = {}) {
  using T = NumberIn<V>;
  const V x = length - a.x, foretold = a.sigma + square_root(x * x + a.y * a.y);
  const V reached = select(V(kTie<T>) * foretold < at_b, V(std::numeric_limits<T>::infinity()), foretold);
  return offer_over<V>(length, to_x, to_y, along, at_v, reached, a, a, bending);
}

}  // namespace brushfire::carried_source::BRUSHFIRE_TARGET
