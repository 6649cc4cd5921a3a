// The loops of trimming, as those in crossing_kernel.h.
namespace brushfire::windows::BRUSHFIRE_TARGET {
using namespace lanes::BRUSHFIRE_TARGET;

using Real4 = Lanes<double, 4>;

inline Real4 to_place(Real4 x, Real4 y, Real4 sigma, Real4 place) {
  const Real4 along = place - x;
  return sigma + square_root(along * along + y * y);
}

// Of each window and the next one: where they cross, and their values there.
struct TiePoints {
  double *place, *value_i, *value_j, *plain;
};

// The usual case for a whole list at once: window i reaches into the next one, j = i + 1, and is the lower one where
// their overlap begins, the next one where it ends, so that both end at the tie point. tie_point_in_closed_form() says
// how that is found. plain: 1 where all that holds.
inline void tie_points(const WindowColumns& w, const double* d0, const double* d1, Index pairs, const TiePoints& to) {
  const Real4 zero(0), one(1), two(2), four(4);
  for (Index i = 0; i < pairs; i += 4) {
    const Index j = i + 1;
    const Real4 xi = load<Real4>(w.x + i), xj = load<Real4>(w.x + j);
    const Real4 ay = load<Real4>(w.y + i), by = load<Real4>(w.y + j);
    const Real4 sigma_i = load<Real4>(w.sigma + i), sigma_j = load<Real4>(w.sigma + j);
    const Real4 p = load<Real4>(w.b0 + j), q = load<Real4>(w.b1 + i);
    const Real4 di = load<Real4>(d1 + i), ax = xi - p, bx = xj - p, bqx = xj - q;
    const Real4 ip = sigma_i + square_root(ax * ax + ay * ay), jq = sigma_j + square_root(bqx * bqx + by * by);
    const Real4 within = Real4(8 * kEpsilon) * magnitude(greater(ip, di));
    const Real4 d = sigma_j - sigma_i, slope = two * (bx - ax);
    const Real4 rest = (ax - bx) * (ax + bx) + (ay - by) * (ay + by) - d * d;
    const Real4 qa = slope * slope - four * d * d, qb = slope * rest + four * d * d * bx;
    const Real4 qc = rest * rest - four * d * d * (bx * bx + by * by);
    const Real4 root = square_root(greater(qb * qb - qa * qc, zero));
    const Real4 sum = select(zero < qb, -(qb + root), root - qb);
    const Real4 x1 = sum / qa, x2 = qc / sum, x0 = -rest / slope, length = q - p;
    const auto fits1 = (zero <= x1) & (x1 <= length) & (zero <= (slope * x1 + rest) * d);
    const Real4 z = p + select(d == zero, x0, select(fits1, x1, x2));
    const Real4 iz = to_place(xi, ay, sigma_i, z), jz = to_place(xj, by, sigma_j, z);
    const Real4 off = select(jz < iz, iz - jz, jz - iz);
    const auto is_plain = (load<Real4>(w.b0 + i) <= p) & (q <= load<Real4>(w.b1 + j)) &
                          (within < load<Real4>(d0 + j) - ip) & (within < di - jq) & (p <= z) & (z <= q) &
                          (off <= within);
    store(to.place + i, z);
    store(to.value_i + i, iz);
    store(to.value_j + i, jz);
    store(to.plain + i, select(is_plain, one, zero));
  }
}

inline bool any_nearly_on_edge(const WindowColumns& w, Index count) {
  for (Index i = 0; i < count; i += 4) {
    const Real4 width = load<Real4>(w.b1 + i) - load<Real4>(w.b0 + i);
    const std::uint32_t near = bits(-load<Real4>(w.y + i) <= Real4(kOnEdge) * width);
    if ((near & windows_from(i, count)) != 0) return true;
  }
  return false;
}

// Whether there are windows that another path makes superfluous (is_dominated()) or that lie beyond the radius.
inline bool any_useless(const WindowColumns& w, const double* d0, const double* d1, Index count, const EdgeBounds& edge,
                        double radius) {
  const Real4 start(edge.start), end(edge.end), length(edge.length), share(kDominated), half(0.5);
  std::uint32_t found = 0;
  for (Index i = 0; i < count; i += 4) {
    const Real4 b0 = load<Real4>(w.b0 + i), b1 = load<Real4>(w.b1 + i);
    const Real4 at0 = load<Real4>(d0 + i), at1 = load<Real4>(d1 + i);
    const auto by_start = start + b1 < at1 * share, by_end = end + (length - b0) < at0 * share;
    const auto beyond = Real4(radius) < half * (at0 + at1 - (b1 - b0));
    found |= bits(by_start | by_end | beyond) & windows_from(i, count);
  }
  return found != 0;
}

}  // namespace brushfire::windows::BRUSHFIRE_TARGET
