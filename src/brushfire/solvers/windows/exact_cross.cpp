// The loops over lists: straight-line arithmetic without branches, which compilers turn into vector instructions.
#include <brushfire/solvers/windows/detail/exact_cross.h>

#include <algorithm>

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

}  // namespace

void look_at_apex(const WindowColumns& windows, Index count, const Frame& frame, Sight& sight) {
  if (sight.value.size() < count) {
    sight.left.resize(2 * count);
    sight.right.resize(2 * count);
    sight.value.resize(2 * count);
  }
  const double cx = frame.apex.x, cy = frame.apex.y, near = kNearMiss * frame.length;
  const double *__restrict b0 = windows.b0, *__restrict b1 = windows.b1, *__restrict x = windows.x,
                       *__restrict y = windows.y, *__restrict sigma = windows.sigma;
  double* __restrict left = sight.left.data(), * __restrict right = sight.right.data(), * __restrict value = sight.value.data();
  for (Index i = 0; i < count; ++i) {
    const double across = x[i] * cy - y[i] * cx, along = cy - y[i];
    const double dx = cx - x[i];
    const double l = across - b0[i] * along, r = b1[i] * along - across;
    const double straight = sigma[i] + std::sqrt(dx * dx + along * along);
    left[i] = l;
    right[i] = r;
    value[i] = std::min(l, r) > -near * along ? straight : kInfinity;
  }
}

Index least_of(const double* numbers, Index count) {
  double least = numbers[0];
  for (Index i = 1; i < count; ++i) least = std::min(least, numbers[i]);
  Index at = 0;
  while (numbers[at] != least) ++at;
  return at;
}

namespace {

// Where the ray to the apex crosses the edge.
double place_of_apex(const WindowColumns& w, const Frame& frame, Index i) {
  return (w.x[i] * frame.apex.y - w.y[i] * frame.apex.x) / (frame.apex.y - w.y[i]);
}

}  // namespace

bool sides_in_order(const WindowColumns& w, Index count, const Frame& frame, const Sight& sight, Index best,
                    Sides& sides) {
  const double* __restrict left = sight.left.data(), * __restrict right = sight.right.data();
  const double* __restrict b0 = w.b0, * __restrict b1 = w.b1;
  if (best == kNoIndex) {
    // Nobody sees the apex: those that pass it on the left come first.
    Index n = 0;
    while (n < count && left[n] > 0) ++n;
    sides = {n, n};
    bool wrong = false;
    for (Index i = 0; i < n; ++i) wrong |= right[i] > 0;
    for (Index i = n; i < count; ++i) wrong |= (left[i] > 0) | (right[i] <= 0);
    return !wrong;
  }
  const double at = place_of_apex(w, frame, best);
  sides = {best + 1, best};
  bool wrong = false;
  for (Index i = 0; i < best; ++i) wrong |= (left[i] <= 0) | ((right[i] > 0) & (b1[i] > at));
  for (Index i = best + 1; i < count; ++i) wrong |= (right[i] <= 0) | ((left[i] > 0) & (b0[i] < at));
  return !wrong;
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

Index cross_to_left(const WindowColumns& windows, Index count, const Frame& frame, const double* sight_right,
                    const WindowColumns& out) {
  const double cx = frame.apex.x, cy = frame.apex.y, length = frame.left;
  if (!(length > 0)) return 0;
  const double ux = cx / length, uy = cy / length;
  const double *__restrict b0 = windows.b0, *__restrict b1 = windows.b1, *__restrict x = windows.x,
                       *__restrict y = windows.y, *__restrict right = sight_right;
  double* __restrict to_b0 = out.b0, * __restrict to_b1 = out.b1, * __restrict to_x = out.x, * __restrict to_y = out.y;
  int dim = 0;
  for (Index i = 0; i < count; ++i) {
    // As in propagate(): the ray through (b,0) meets the edge at the share b q / (cx q - cy (b - x)) of its length.
    const double q = -y[i], cxq = cx * q;
    const double share0 = b0[i] * q / (cxq - cy * (b0[i] - x[i])), share1 = b1[i] * q / (cxq - cy * (b1[i] - x[i]));
    const double begin = b0[i] > 0 ? std::min(length, length * share0) : 0;
    const double end = right[i] > 0 ? length : std::min(length, length * share1);
    const double sx = x[i] * ux + y[i] * uy, sy = y[i] * ux - x[i] * uy;
    to_b0[i] = begin;
    to_b1[i] = end;
    to_x[i] = sx;
    to_y[i] = sy;
    dim |= static_cast<int>(!(end - begin > kSliver * (std::abs(sx) + length - sy)) || !(sy < 0));
  }
  std::copy_n(windows.sigma, count, out.sigma);
  std::copy_n(windows.root, count, out.root);
  return dim != 0 ? without_slivers(out, count) : count;
}

Index cross_to_right(const WindowColumns& windows, Index count, const Frame& frame, const double* sight_left,
                     const WindowColumns& out) {
  const double base = frame.length, cx = frame.apex.x, cy = frame.apex.y, length = frame.right;
  if (!(length > 0)) return 0;
  const double ux = (base - cx) / length, uy = -cy / length;
  const double *__restrict b0 = windows.b0, *__restrict b1 = windows.b1, *__restrict x = windows.x,
                       *__restrict y = windows.y, *__restrict left = sight_left;
  double* __restrict to_b0 = out.b0, * __restrict to_b1 = out.b1, * __restrict to_x = out.x, * __restrict to_y = out.y;
  int dim = 0;
  for (Index i = 0; i < count; ++i) {
    // The same as on the left, seen from the end of the edge.
    const double q = -y[i], cxq = (base - cx) * q;
    const double share0 = (base - b0[i]) * q / (cxq + cy * (b0[i] - x[i]));
    const double share1 = (base - b1[i]) * q / (cxq + cy * (b1[i] - x[i]));
    const double begin = left[i] > 0 ? 0 : std::max(0.0, length * (1 - share0));
    const double end = b1[i] < base ? std::max(0.0, length * (1 - share1)) : length;
    const double tx = x[i] - cx, ty = y[i] - cy;
    const double sx = tx * ux + ty * uy, sy = ty * ux - tx * uy;
    to_b0[i] = begin;
    to_b1[i] = end;
    to_x[i] = sx;
    to_y[i] = sy;
    dim |= static_cast<int>(!(end - begin > kSliver * (std::abs(sx) + length - sy)) || !(sy < 0));
  }
  std::copy_n(windows.sigma, count, out.sigma);
  std::copy_n(windows.root, count, out.root);
  return dim != 0 ? without_slivers(out, count) : count;
}

void end_values(const WindowColumns& windows, Index count, double* d0, double* d1) {
  const double *__restrict b0 = windows.b0, *__restrict b1 = windows.b1, *__restrict x = windows.x,
                       *__restrict y = windows.y, *__restrict sigma = windows.sigma;
  double* __restrict v0 = d0, * __restrict v1 = d1;
  for (Index i = 0; i < count; ++i) {
    const double p = b0[i] - x[i], q = b1[i] - x[i], h = y[i] * y[i];
    v0[i] = sigma[i] + std::sqrt(p * p + h);
    v1[i] = sigma[i] + std::sqrt(q * q + h);
  }
}

}  // namespace brushfire::detail
