// The loops over lists: straight-line arithmetic without branches, which compilers turn into vector instructions.
#include <brushfire/solvers/windows/detail/exact_cross.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

// Compiled for wider vectors as well, where the loader can choose at run time. The results are the same: no sum is
// reordered, no product fused.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define BRUSHFIRE_WIDE __attribute__((target_clones("default", "avx2", "arch=x86-64-v4")))
#else
#define BRUSHFIRE_WIDE
#endif

namespace brushfire::detail {
namespace {

// Windows whose ray to the apex misses them by no more than this share of the edge are looked at closely.
constexpr double kNearMiss = 1e-6;

// Takes out what is no window after all: rare, so that the loops only tell whether there is any.
Index without_slivers(const WindowColumns& w, Index count) {
  Index kept = 0;
  for (Index i = 0; i < count; ++i) {
    const double scale = length_of(w.x[i] - w.b0[i], w.y[i]);
    const bool lit = w.y[i] < 0 || (w.y[i] == 0 && w.x[i] > w.b0[i] && w.x[i] < w.b1[i]);
    if (!lit || !(w.b1[i] - w.b0[i] > kSliver * scale)) continue;
    if (kept != i) w.move(kept, i);
    ++kept;
  }
  return kept;
}

// The loops take every column as a parameter of its own: compilers believe __restrict there.

BRUSHFIRE_WIDE void look(const double* __restrict b0, const double* __restrict b1, const double* __restrict x,
                         const double* __restrict y, const double* __restrict sigma, std::ptrdiff_t count, Vec2 apex,
                         double near, double* __restrict left, double* __restrict right, double* __restrict value) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double across = x[i] * apex.y - y[i] * apex.x, along = apex.y - y[i];
    const double dx = apex.x - x[i];
    const double l = across - b0[i] * along, r = b1[i] * along - across;
    const double straight = sigma[i] + std::sqrt(dx * dx + along * along);
    left[i] = l;
    right[i] = r;
    value[i] = (l < r ? l : r) > -near * along ? straight : kInfinity;
  }
}

// Towards the edge on the left of a triangle; see propagate(): the ray through (b,0) meets that edge at the share
// b q / (cx q - cy (b - x)) of its length. Returns how many of the results may be slivers.
BRUSHFIRE_WIDE std::int64_t to_left(const double* __restrict b0, const double* __restrict b1,
                                    const double* __restrict x, const double* __restrict y,
                                    const double* __restrict passes, std::ptrdiff_t count, Vec2 apex, double length,
                                    double* __restrict to_b0, double* __restrict to_b1, double* __restrict to_x,
                                    double* __restrict to_y) {
  const double ux = apex.x / length, uy = apex.y / length;
  std::int64_t dim = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double q = -y[i], along = apex.x * q;
    const double at0 = length * (b0[i] * q / (along - apex.y * (b0[i] - x[i])));
    const double at1 = length * (b1[i] * q / (along - apex.y * (b1[i] - x[i])));
    const double begin = b0[i] > 0 ? (at0 < length ? at0 : length) : 0.0;
    const double end = passes[i] > 0 ? length : (at1 < length ? at1 : length);
    const double sx = x[i] * ux + y[i] * uy, sy = y[i] * ux - x[i] * uy;
    to_b0[i] = begin;
    to_b1[i] = end;
    to_x[i] = sx;
    to_y[i] = sy;
    dim += end - begin > kSliver * (std::abs(sx) + length - sy) && sy < 0 ? 0 : 1;
  }
  return dim;
}

// The same on the right; places are measured from the end of the edge.
BRUSHFIRE_WIDE std::int64_t to_right(const double* __restrict b0, const double* __restrict b1,
                                     const double* __restrict x, const double* __restrict y,
                                     const double* __restrict passes, std::ptrdiff_t count, Vec2 apex, double base,
                                     double length, double* __restrict to_b0, double* __restrict to_b1,
                                     double* __restrict to_x, double* __restrict to_y) {
  const double ux = (base - apex.x) / length, uy = -apex.y / length;
  std::int64_t dim = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double q = -y[i], along = (base - apex.x) * q;
    const double at0 = length * (1 - (base - b0[i]) * q / (along + apex.y * (b0[i] - x[i])));
    const double at1 = length * (1 - (base - b1[i]) * q / (along + apex.y * (b1[i] - x[i])));
    const double begin = passes[i] > 0 ? 0.0 : (at0 > 0 ? at0 : 0.0);
    const double end = b1[i] < base ? (at1 > 0 ? at1 : 0.0) : length;
    const double tx = x[i] - apex.x, ty = y[i] - apex.y;
    const double sx = tx * ux + ty * uy, sy = ty * ux - tx * uy;
    to_b0[i] = begin;
    to_b1[i] = end;
    to_x[i] = sx;
    to_y[i] = sy;
    dim += end - begin > kSliver * (std::abs(sx) + length - sy) && sy < 0 ? 0 : 1;
  }
  return dim;
}

BRUSHFIRE_WIDE void ends(const double* __restrict b0, const double* __restrict b1, const double* __restrict x,
                         const double* __restrict y, const double* __restrict sigma, std::ptrdiff_t count,
                         double* __restrict d0, double* __restrict d1) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double p = b0[i] - x[i], q = b1[i] - x[i], h = y[i] * y[i];
    d0[i] = sigma[i] + std::sqrt(p * p + h);
    d1[i] = sigma[i] + std::sqrt(q * q + h);
  }
}

BRUSHFIRE_WIDE std::int64_t positive(const double* __restrict numbers, std::ptrdiff_t count) {
  std::int64_t found = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) found += numbers[i] > 0 ? 1 : 0;
  return found;
}

// How many windows left of the best one do not go on to the left alone, for a reason that the numbers show at once.
BRUSHFIRE_WIDE std::int64_t doubtful(const double* __restrict own, const double* __restrict other,
                                     const double* __restrict limit, double sign, double at, std::ptrdiff_t count) {
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
  look(w.b0, w.b1, w.x, w.y, w.sigma, count, frame.apex, kNearMiss * frame.length, sight.left.data(),
       sight.right.data(), sight.value.data());
}

Index least_of(const double* numbers, Index count) {
  double least[4] = {numbers[0], numbers[0], numbers[0], numbers[0]};  // four: minima need not wait for each other
  Index i = 0;
  for (; i + 4 <= count; i += 4) {
    for (Index k = 0; k < 4; ++k) least[k] = numbers[i + k] < least[k] ? numbers[i + k] : least[k];
  }
  for (; i < count; ++i) least[0] = std::min(least[0], numbers[i]);
  const double of_all = std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
  return static_cast<Index>(std::find(numbers, numbers + count, of_all) - numbers);
}

namespace {

// Where the ray to the apex crosses the edge.
double place_of_apex(const WindowColumns& w, const Frame& frame, Index i) {
  return (w.x[i] * frame.apex.y - w.y[i] * frame.apex.x) / (frame.apex.y - w.y[i]);
}

}  // namespace

bool sides_in_order(const WindowColumns& w, Index count, const Frame& frame, const Sight& sight, Index best,
                    Sides& sides) {
  const double *left = sight.left.data(), *right = sight.right.data(), *b0 = w.b0, *b1 = w.b1;
  if (best == kNoIndex) {
    // Nobody sees the apex: those that pass it on the left come first.
    const auto n = static_cast<Index>(positive(left, count));
    sides = {n, n};
    return doubtful(left, right, b1, 1, -kInfinity, n) +
               doubtful(right + n, left + n, b0 + n, -1, kInfinity, static_cast<std::ptrdiff_t>(count) - n) ==
           0;
  }
  const double at = place_of_apex(w, frame, best);
  sides = {best + 1, best};
  if (doubtful(left, right, b1, 1, at, best) + doubtful(right + best + 1, left + best + 1, b0 + best + 1, -1, at,
                                                        static_cast<std::ptrdiff_t>(count) - best - 1) ==
      0) {
    return true;
  }
  // Neighbours of the best one that may have something to give on its other side go to both sides, and what lies
  // between with them, as long as that is geometrically possible.
  for (Index i = best; i-- > 0;) {
    if (left[i] <= 0) return false;
    if (right[i] > 0 && b1[i] > at && choose_sides(w, frame, sight, best, i).right) sides.right_begin = i;
  }
  for (Index i = best + 1; i < count; ++i) {
    if (right[i] <= 0) return false;
    if (left[i] > 0 && b0[i] < at && choose_sides(w, frame, sight, best, i).left) sides.left_end = i + 1;
  }
  for (Index i = sides.right_begin; i < best; ++i) {
    if (right[i] <= 0) return false;
  }
  for (Index i = best + 1; i < sides.left_end; ++i) {
    if (left[i] <= 0) return false;
  }
  return true;
}

Way choose_sides(const WindowColumns& w, const Frame& frame, const Sight& sight, Index best, Index i) {
  Way way{sight.left[i] > 0, sight.right[i] > 0};
  if (!way.left || !way.right || best == kNoIndex || i == best) return way;
  const Vec2 s{w.x[i], w.y[i]}, b{w.x[best], w.y[best]};
  const double at = place_of_apex(w, frame, best);
  const double side = cross(frame.apex - b, s - b);  // > 0: the source lies left of the best one's ray to the apex
  if (place_of_apex(w, frame, i) <= at) {
    const auto limit_ray_crosses_behind = [&] {
      return w.b1[i] <= w.b1[best] && side >= 0 && cross(Vec2{w.b1[i], 0} - s, b - s) <= 0;
    };
    if (w.b1[i] <= at || limit_ray_crosses_behind()) way.right = false;
  } else {
    const auto limit_ray_crosses_behind = [&] {
      return w.b0[i] >= w.b0[best] && side <= 0 && cross(Vec2{w.b0[i], 0} - s, b - s) >= 0;
    };
    if (w.b0[i] >= at || limit_ray_crosses_behind()) way.left = false;
  }
  return way;
}

Index cross_to_left(const WindowColumns& w, Index count, const Frame& frame, const double* sight_right,
                    const WindowColumns& out) {
  if (!(frame.left > 0)) return 0;
  const bool dim =
      to_left(w.b0, w.b1, w.x, w.y, sight_right, count, frame.apex, frame.left, out.b0, out.b1, out.x, out.y) > 0;
  std::copy_n(w.sigma, count, out.sigma);
  std::copy_n(w.root, count, out.root);
  return dim ? without_slivers(out, count) : count;
}

Index cross_to_right(const WindowColumns& w, Index count, const Frame& frame, const double* sight_left,
                     const WindowColumns& out) {
  if (!(frame.right > 0)) return 0;
  const bool dim = to_right(w.b0, w.b1, w.x, w.y, sight_left, count, frame.apex, frame.length, frame.right, out.b0,
                            out.b1, out.x, out.y) > 0;
  std::copy_n(w.sigma, count, out.sigma);
  std::copy_n(w.root, count, out.root);
  return dim ? without_slivers(out, count) : count;
}

void end_values(const WindowColumns& w, Index count, double* d0, double* d1) {
  ends(w.b0, w.b1, w.x, w.y, w.sigma, count, d0, d1);
}

}  // namespace brushfire::detail
