// From one edge of a triangle to the other two: a window's children.
#pragma once

#include <brushfire/solvers/windows/detail/face.h>
#include <brushfire/solvers/windows/detail/window.h>

namespace brushfire::detail {

// The children of a window in the triangle that it enters. left lies on a-apex, in the frame with a at the origin;
// right on apex-b, with the apex at the origin; both have the triangle below and their source in it or beyond.
struct Children {
  Window left, right;
  bool has_left = false, has_right = false;
};

// The ray from the source through (b,0) meets the edge from a to the apex at this share of its length. The denominator
// cancels for rays that graze the edge; the error then runs along the ray and moves it sideways by rounding only.
inline double share_on_left(const Window& w, Vec2 apex, double b) {
  const double q = -w.source.y;
  return b * q / (apex.x * q - apex.y * (origin_weight(w.kind) * b - w.source.x));
}

// Propagation (L3, L4): the children's pre-images tile the lit interval; slack, lift and root are inherited (the slack
// stays valid because the value grows along a ray as fast as the path does). `apex_value`: straight_value at the apex.
// Needs is_lit(w) and, where the source lies on the edge, an apex off it. What rounding decides about a ray through the
// apex is worth nothing: both children meet there.
inline Children propagate(const Window& w, const Frame& frame, double apex_value) {
  Children children;
  const Vec2 c = frame.apex;
  const Crossing at = crossing(w, c);
  const bool lit_left = at.across > w.b0 * at.along;
  const bool lit_right = at.across < w.b1 * at.along;
  const double origin = origin_weight(w.kind);

  if (lit_left && frame.left > 0) {
    Window& l = children.left;
    l = w;
    const Vec2 u{c.x / frame.left, c.y / frame.left};
    l.source = {dot(w.source, u), w.source.y * u.x - w.source.x * u.y};
    if (w.b0 <= 0) {
      l.b0 = 0;
      l.d0 = w.d0;
    } else {
      l.b0 = std::min(frame.left, frame.left * share_on_left(w, c, w.b0));
      l.d0 = value_at(l, l.b0);
    }
    if (lit_right) {
      l.b1 = frame.left;
      l.d1 = apex_value;
    } else {
      l.b1 = std::min(frame.left, frame.left * share_on_left(w, c, w.b1));
      l.d1 = value_at(l, l.b1);
    }
    children.has_left = is_lit(l) && !is_sliver(l);
  }
  if (lit_right && frame.right > 0) {
    Window& r = children.right;
    r = w;
    const Vec2 u{(frame.length - c.x) / frame.right, -c.y / frame.right};  // from the apex to b
    const Vec2 s = w.source - origin * c;
    r.source = {dot(s, u), s.y * u.x - s.x * u.y};
    if (w.kind == WindowKind::Linear) r.sigma = apex_value;
    // Seen from b, with the frame turned round, the right edge is a left one.
    const Vec2 turned{frame.length - c.x, c.y};
    Window m;
    m.kind = w.kind;
    m.source = {origin * frame.length - w.source.x, w.source.y};
    if (lit_left) {
      r.b0 = 0;
      r.d0 = apex_value;
    } else {
      r.b0 = std::max(0.0, frame.right * (1 - share_on_left(m, turned, frame.length - w.b0)));
      r.d0 = value_at(r, r.b0);
    }
    if (w.b1 >= frame.length) {
      r.b1 = frame.right;
      r.d1 = w.d1;
    } else {
      r.b1 = std::max(0.0, frame.right * (1 - share_on_left(m, turned, frame.length - w.b1)));
      r.d1 = value_at(r, r.b1);
    }
    children.has_right = is_lit(r) && !is_sliver(r);
  }
  return children;
}

}  // namespace brushfire::detail
