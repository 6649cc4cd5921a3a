// Lists from edge to edge: what the loops do not do.
#include <brushfire/solvers/windows/algebra/exact_cross.h>

#include <brushfire/solvers/windows/algebra/crossing.h>
#include <brushfire/solvers/windows/algebra/propagate.h>

#include <algorithm>
#include <bit>
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

}  // namespace

void look_at_apex(const WindowColumns& w, Index count, const Frame& frame, Sight& sight) {
  if (sight.value.size() < count + kRoomBehind) {
    sight.left.resize(2 * count + kRoomBehind);
    sight.right.resize(2 * count + kRoomBehind);
    sight.value.resize(2 * count + kRoomBehind);
  }
  const Real near = kNearMiss * frame.length;
  if (w.mixed) {
    BRUSHFIRE_ON_TARGET(Variant::Best, look<true>(w, count, frame.apex, near, sight));
  } else {
    BRUSHFIRE_ON_TARGET(Variant::Best, look<false>(w, count, frame.apex, near, sight));
  }
}

Index least_of(const Real* numbers, Index count) {
  const Real* const least = std::min_element(numbers, numbers + count);
  return *least < kInfinity ? static_cast<Index>(least - numbers) : kNoIndex;
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
  if (routes.some_left.size() < count + kRoomBehind) {
    routes.some_left.resize(2 * count + kRoomBehind);
    routes.some_right.resize(2 * count + kRoomBehind);
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
  // Those that pass the apex on the left come first; the best one is where both meet, and goes both ways.
  const bool any = best != kNoIndex, few = count < 64;
  const Index middle = any   ? best
                       : few ? static_cast<Index>(std::popcount(sight.passes_left))
                             : static_cast<Index>(std::count_if(sight.left.data(), sight.left.data() + count,
                                                                [](Real left) { return left > 0; }));
  const Index right_begin = any ? middle + 1 : middle;
  routes.left_end = right_begin;
  routes.right_begin = middle;
  routes.goes_left = sight.left.data();
  routes.goes_right = sight.right.data();
  if (few) {
    const auto first = [](Index number) { return (std::uint64_t{1} << number) - 1; };
    const std::uint64_t lefts = first(middle), rights = first(count) & ~first(right_begin);
    const std::uint64_t only_left = sight.passes_left & ~sight.passes_right;
    const std::uint64_t only_right = sight.passes_right & ~sight.passes_left;
    if (((lefts & ~only_left) | (rights & ~only_right)) == 0) return;
  }
  const Real place = any ? place_of_apex(w, frame, best) : 0;
  const Real left_place = any ? place : -kInfinity, right_place = any ? place : kInfinity;
  if (BRUSHFIRE_ON_TARGET(Variant::Best, is_doubtful(w, count, sight, middle, right_begin, left_place, right_place))) {
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
  const bool dim =
      BRUSHFIRE_ON_TARGET(Variant::Best, to_left(w, count, routes.goes_left, sight.right.data(), frame, out));
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
  const bool dim = BRUSHFIRE_ON_TARGET(
      Variant::Best, to_right(w, count, routes.goes_right + begin, sight.left.data() + begin, frame, out));
  return dim ? without_slivers(out, count) : count;
}

void end_values(const WindowColumns& w, Index count, Real* d0, Real* d1) {
  BRUSHFIRE_ON_TARGET(Variant::Best, ends(w, count, d0, d1));
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
