// The loops over lists: straight-line arithmetic without branches, which compilers turn into vector instructions.
#include <brushfire/solvers/windows/algebra/exact_cross.h>

#include <brushfire/solvers/windows/algebra/propagate.h>
#include <brushfire/solvers/windows/algebra/wide.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// Windows whose ray to the apex misses them by no more than this share of the edge are looked at closely.
constexpr Real kNearMiss = 1e-6;

// Takes out what is no window after all: rare, so that the loops only tell whether there is any.
Index without_slivers(const WindowColumns& w, Index count) {
  Index kept = 0;
  for (Index i = 0; i < count; ++i) {
    const Real width = w.b1[i] - w.b0[i];
    const bool linear = w.is_linear(i);
    const bool visible = linear || w.y[i] < 0 || (w.y[i] == 0 && w.x[i] > w.b0[i] && w.x[i] < w.b1[i]);
    const Real scale = linear ? w.b1[i] : length_of(w.x[i] - w.b0[i], w.y[i]);
    if (!visible || !(width > 0) || !(width > kSliver * scale)) continue;
    if (kept != i) w.move(kept, i);
    ++kept;
  }
  return kept;
}

// The loops take every column as a parameter of its own: compilers believe __restrict there.

BRUSHFIRE_WIDE void look(const Real* __restrict b0, const Real* __restrict b1, const Real* __restrict x,
                         const Real* __restrict y, const Real* __restrict sigma, std::ptrdiff_t count, Vec2 apex,
                         Real near, Real* __restrict left, Real* __restrict right, Real* __restrict value) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const Real across = x[i] * apex.y - y[i] * apex.x, along = apex.y - y[i];
    const Real dx = apex.x - x[i];
    const Real l = across - b0[i] * along, r = b1[i] * along - across;
    const Real straight = sigma[i] + sqrt(dx * dx + along * along);
    left[i] = l;
    right[i] = r;
    value[i] = (l < r ? l : r) > -near * along ? straight : kInfinity;
  }
}

// The same loops for lists with linear windows, which are told by y > 0 (WindowColumns): the weight of the origin is 1
// or 0, as in window.h.
BRUSHFIRE_WIDE void look_mixed(const Real* __restrict b0, const Real* __restrict b1, const Real* __restrict x,
                               const Real* __restrict y, const Real* __restrict sigma, std::ptrdiff_t count, Vec2 apex,
                               Real near, Real* __restrict left, Real* __restrict right, Real* __restrict value) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const Real circular = y[i] > 0 ? 0.0 : 1.0, below = y[i] > 0 ? -y[i] : y[i];
    const Real across = x[i] * apex.y - below * apex.x, along = circular * apex.y - below;
    const Real dx = apex.x - x[i];
    const Real l = across - b0[i] * along, r = b1[i] * along - across;
    const Real way = sqrt(dx * dx + along * along), rise = -(apex.x * x[i] + apex.y * below);
    left[i] = l;
    right[i] = r;
    value[i] = (l < r ? l : r) > -near * along ? sigma[i] + (y[i] > 0 ? rise : way) : kInfinity;
  }
}

BRUSHFIRE_WIDE void ends_mixed(const Real* __restrict b0, const Real* __restrict b1, const Real* __restrict x,
                               const Real* __restrict y, const Real* __restrict sigma, std::ptrdiff_t count,
                               Real* __restrict d0, Real* __restrict d1) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const Real p = b0[i] - x[i], q = b1[i] - x[i], h = y[i] * y[i];
    d0[i] = sigma[i] + (y[i] > 0 ? -(b0[i] * x[i]) : sqrt(p * p + h));
    d1[i] = sigma[i] + (y[i] > 0 ? -(b1[i] * x[i]) : sqrt(q * q + h));
  }
}

// Towards the edge on the left of a triangle; see propagate(): the ray through (b,0) meets that edge at the share
// b q / (cx q - cy (b - x)) of its length. Returns how many of the results may be slivers.
BRUSHFIRE_WIDE std::int64_t to_left(const Real* __restrict b0, const Real* __restrict b1, const Real* __restrict x,
                                    const Real* __restrict y, const Real* __restrict goes,
                                    const Real* __restrict passes, std::ptrdiff_t count, Vec2 apex, Real length,
                                    Real* __restrict to_b0, Real* __restrict to_b1, Real* __restrict to_x,
                                    Real* __restrict to_y) {
  const Real ux = apex.x / length, uy = apex.y / length;
  std::int64_t dim = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const Real q = -y[i], along = apex.x * q;
    const Real at0 = length * (b0[i] * q / (along - apex.y * (b0[i] - x[i])));
    const Real at1 = length * (b1[i] * q / (along - apex.y * (b1[i] - x[i])));
    const Real begin = b0[i] > 0 ? (at0 < length ? at0 : length) : 0.0;
    const Real end = passes[i] > 0 ? length : (at1 < length ? at1 : length);
    const Real sx = x[i] * ux + y[i] * uy, sy = y[i] * ux - x[i] * uy;
    to_b0[i] = begin;
    to_b1[i] = goes[i] > 0 ? end : begin;
    to_x[i] = sx;
    to_y[i] = sy;
    const std::int64_t wide = end - begin > kSliver * (abs(sx) + length - sy), visible = sy < 0, asked = goes[i] > 0;
    dim += 1 - (wide & visible & asked);
  }
  return dim;
}

// The same on the right; places are measured from the end of the edge.
BRUSHFIRE_WIDE std::int64_t to_right(const Real* __restrict b0, const Real* __restrict b1, const Real* __restrict x,
                                     const Real* __restrict y, const Real* __restrict goes,
                                     const Real* __restrict passes, std::ptrdiff_t count, Vec2 apex, Real base,
                                     Real length, Real* __restrict to_b0, Real* __restrict to_b1, Real* __restrict to_x,
                                     Real* __restrict to_y) {
  const Real ux = (base - apex.x) / length, uy = -apex.y / length;
  std::int64_t dim = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const Real q = -y[i], along = (base - apex.x) * q;
    const Real at0 = length * (1 - (base - b0[i]) * q / (along + apex.y * (b0[i] - x[i])));
    const Real at1 = length * (1 - (base - b1[i]) * q / (along + apex.y * (b1[i] - x[i])));
    const Real begin = passes[i] > 0 ? 0.0 : (at0 > 0 ? at0 : 0.0);
    const Real end = b1[i] < base ? (at1 > 0 ? at1 : 0.0) : length;
    const Real tx = x[i] - apex.x, ty = y[i] - apex.y;
    const Real sx = tx * ux + ty * uy, sy = ty * ux - tx * uy;
    to_b0[i] = begin;
    to_b1[i] = goes[i] > 0 ? end : begin;
    to_x[i] = sx;
    to_y[i] = sy;
    const std::int64_t wide = end - begin > kSliver * (abs(sx) + length - sy), visible = sy < 0, asked = goes[i] > 0;
    dim += 1 - (wide & visible & asked);
  }
  return dim;
}

BRUSHFIRE_WIDE void ends(const Real* __restrict b0, const Real* __restrict b1, const Real* __restrict x,
                         const Real* __restrict y, const Real* __restrict sigma, std::ptrdiff_t count,
                         Real* __restrict d0, Real* __restrict d1) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const Real p = b0[i] - x[i], q = b1[i] - x[i], h = y[i] * y[i];
    d0[i] = sigma[i] + sqrt(p * p + h);
    d1[i] = sigma[i] + sqrt(q * q + h);
  }
}

BRUSHFIRE_WIDE std::int64_t positive(const Real* __restrict numbers, std::ptrdiff_t count) {
  std::int64_t found = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) found += numbers[i] > 0 ? 1 : 0;
  return found;
}

// How many windows left of the apex (sign 1, limit: their right ends) or right of it (-1, left ends) do not obviously
// go on to their own side alone: they do if they pass the apex there and not on the other side, or if they end before
// the place where the best one's ray to the apex crosses the edge.
BRUSHFIRE_WIDE std::int64_t doubtful(const Real* __restrict own, const Real* __restrict other,
                                     const Real* __restrict limit, Real sign, Real at, std::ptrdiff_t count) {
  std::int64_t found = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const std::int64_t passes = own[i] > 0, only = other[i] <= 0, behind = sign * (limit[i] - at) <= 0;
    found += 1 - (passes & (only | behind));
  }
  return found;
}

}  // namespace

void look_at_apex(const WindowColumns& w, Index count, const Frame& frame, Sight& sight) {
  if (sight.value.size() < count) {
    sight.left.resize(2 * count);
    sight.right.resize(2 * count);
    sight.value.resize(2 * count);
  }
  const auto loop = w.mixed ? look_mixed : look;
  loop(w.b0, w.b1, w.x, w.y, w.sigma, count, frame.apex, kNearMiss * frame.length, sight.left.data(),
       sight.right.data(), sight.value.data());
}

Index least_of(const Real* numbers, Index count) {
  Real least[4] = {numbers[0], numbers[0], numbers[0], numbers[0]};  // four: minima need not wait for each other
  Index i = 0;
  for (; i + 4 <= count; i += 4) {
    for (Index k = 0; k < 4; ++k) least[k] = numbers[i + k] < least[k] ? numbers[i + k] : least[k];
  }
  for (; i < count; ++i) least[0] = std::min(least[0], numbers[i]);
  const Real of_all = std::min({least[0], least[1], least[2], least[3]});
  return static_cast<Index>(std::find(numbers, numbers + count, of_all) - numbers);
}

namespace {

// Where the ray to the apex crosses the edge.
Real place_of_apex(const WindowColumns& w, const Frame& frame, Index i) {
  const Vec2 s = w.source(i);
  return (s.x * frame.apex.y - s.y * frame.apex.x) / (origin_weight(w.kind(i)) * frame.apex.y - s.y);
}

// Whether a window that sees the apex, and loses to the best one there, has to go on to the left, to the right.
struct Way {
  bool left = true, right = true;
};
Way way_of_loser(const WindowColumns& w, const Frame& frame, Index best, Real best_place, Index i) {
  // Limit rays that cross behind the edge are told by where sources lie: of circular ones.
  if (w.is_linear(i) || w.is_linear(best)) {
    const bool is_left = place_of_apex(w, frame, i) <= best_place;
    return {is_left || w.b0[i] < best_place, !is_left || w.b1[i] > best_place};
  }
  const Vec2 s{w.x[i], w.y[i]}, b{w.x[best], w.y[best]};
  const Real side = cross(frame.apex - b, s - b);  // > 0: the source lies left of the best one's ray to the apex
  Way way;
  if (place_of_apex(w, frame, i) <= best_place) {
    const auto limit_ray_crosses_behind = [&] {
      return w.b1[i] <= w.b1[best] && side >= 0 && cross(Vec2{w.b1[i], 0} - s, b - s) <= 0;
    };
    way.right = !(w.b1[i] <= best_place || limit_ray_crosses_behind());
  } else {
    const auto limit_ray_crosses_behind = [&] {
      return w.b0[i] >= w.b0[best] && side <= 0 && cross(Vec2{w.b0[i], 0} - s, b - s) >= 0;
    };
    way.left = !(w.b0[i] >= best_place || limit_ray_crosses_behind());
  }
  return way;
}

// Lists out of order: every window for itself.
void find_routes_one_by_one(const WindowColumns& w, Index count, const Frame& frame, const Sight& sight, Index best,
                            Routes& routes) {
  if (routes.some_left.size() < count) {
    routes.some_left.resize(2 * count);
    routes.some_right.resize(2 * count);
  }
  routes.goes_left = routes.some_left.data();
  routes.goes_right = routes.some_right.data();
  routes.left_end = 0;
  routes.right_begin = count;
  const Real best_place = best == kNoIndex ? 0 : place_of_apex(w, frame, best);
  for (Index i = 0; i < count; ++i) {
    Way way{sight.left[i] > 0, sight.right[i] > 0};
    if (way.left && way.right && best != kNoIndex && i != best) way = way_of_loser(w, frame, best, best_place, i);
    routes.some_left[i] = way.left ? 1 : 0;
    routes.some_right[i] = way.right ? 1 : 0;
    if (way.left) routes.left_end = i + 1;
    if (way.right) routes.right_begin = std::min(routes.right_begin, i);
  }
}

// One by one, from lists with linear windows: child(window, division, value at the apex).
template <class Child>
Index cross_one_by_one(const WindowColumns& w, Index count, const Real* goes, const Frame& frame,
                       const WindowColumns& out, Child&& child) {
  Index kept = 0;
  for (Index i = 0; i < count; ++i) {
    if (!(goes[i] > 0)) continue;
    const Window window = w.window(i);
    const Window next = child(window, divide(window, frame.apex), straight_value(window, frame.apex));
    if (next.b0 < next.b1 && is_visible(next) && !is_sliver(next)) out.set(kept++, next);
  }
  return kept;
}

}  // namespace

void find_routes(const WindowColumns& w, Index count, const Frame& frame, const Sight& sight, Index best,
                 Routes& routes) {
  const Real *left = sight.left.data(), *right = sight.right.data();
  // Those that pass the apex on the left come first; the best one is where both meet.
  const Index first = best == kNoIndex ? static_cast<Index>(positive(left, count)) : best;
  const Index second = best == kNoIndex ? first : best + 1;
  const Real place = best == kNoIndex ? 0 : place_of_apex(w, frame, best);
  const Real left_place = best == kNoIndex ? -kInfinity : place, right_place = best == kNoIndex ? kInfinity : place;
  routes.left_end = second;
  routes.right_begin = first;
  routes.goes_left = left;
  routes.goes_right = right;
  if (doubtful(left, right, w.b1, 1, left_place, first) + doubtful(right + second, left + second, w.b0 + second, -1,
                                                                   right_place,
                                                                   static_cast<std::ptrdiff_t>(count) - second) >
      0) {
    find_routes_one_by_one(w, count, frame, sight, best, routes);
  }
}

Index cross_to_left(const WindowColumns& w, const Routes& routes, const Sight& sight, const Frame& frame,
                    const WindowColumns& out) {
  const Index count = routes.left_end;
  if (!(frame.left > 0)) return 0;
  if (w.mixed) {
    return cross_one_by_one(
        w, count, routes.goes_left, frame, out,
        [&](const Window& from, const Division& d, Real apex) { return left_child(from, frame, d, apex); });
  }
  const bool dim = to_left(w.b0, w.b1, w.x, w.y, routes.goes_left, sight.right.data(), count, frame.apex, frame.left,
                           out.b0, out.b1, out.x, out.y) > 0;
  std::copy_n(w.sigma, count, out.sigma);
  std::copy_n(w.pseudo_source, count, out.pseudo_source);
  return dim ? without_slivers(out, count) : count;
}

Index cross_to_right(const WindowColumns& windows, Index count, const Routes& routes, const Sight& sight,
                     const Frame& frame, const WindowColumns& out) {
  const Index begin = routes.right_begin;
  const WindowColumns w = windows.from(begin);
  count -= begin;
  if (!(frame.right > 0)) return 0;
  if (w.mixed) {
    return cross_one_by_one(
        w, count, routes.goes_right + begin, frame, out,
        [&](const Window& from, const Division& d, Real apex) { return right_child(from, frame, d, apex); });
  }
  const bool dim = to_right(w.b0, w.b1, w.x, w.y, routes.goes_right + begin, sight.left.data() + begin, count,
                            frame.apex, frame.length, frame.right, out.b0, out.b1, out.x, out.y) > 0;
  std::copy_n(w.sigma, count, out.sigma);
  std::copy_n(w.pseudo_source, count, out.pseudo_source);
  return dim ? without_slivers(out, count) : count;
}

void end_values(const WindowColumns& w, Index count, Real* d0, Real* d1) {
  (w.mixed ? ends_mixed : ends)(w.b0, w.b1, w.x, w.y, w.sigma, count, d0, d1);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
