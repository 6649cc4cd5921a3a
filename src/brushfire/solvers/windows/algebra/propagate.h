// From one edge of a triangle to the other two: a window's children.
#pragma once

#include <brushfire/solvers/windows/algebra/frame.h>
#include <brushfire/solvers/windows/algebra/window.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// How a window's rays divide between the sides of the triangle that it enters. A ray through (b,0) passes the apex at a
// distance that is proportional to  aside = across - b * along  (positive: to its left), and meets the left (right)
// side where that is divided as  b * depth : aside  (as -aside : (length - b) * depth), depth being that of the source.
// The sums cancel for rays that graze the side; the error then runs along the ray and moves it sideways by rounding
// only.
struct Division {
  Real aside0 = 0, aside1 = 0;  // of the rays through b0 and b1
  Real depth = 0;

  bool sees_left() const { return aside0 > 0; }
  bool sees_right() const { return aside1 < 0; }
  bool sees_apex() const { return aside0 >= 0 && aside1 <= 0; }
};
inline Division divide(const Window& w, Vec2 apex) {
  const Crossing at = crossing(w, apex);
  return {at.across - w.b0 * at.along, at.across - w.b1 * at.along, -w.source.y};
}

// Propagation (L3, L4): the children's pre-images tile the visible interval; slack, lift and pseudo-source are
// inherited (the slack stays valid because the value grows along a ray as fast as the path does). `apex_value`:
// straight_value at the apex. Needs is_visible(w) and, where the source lies on the edge, an apex off it. What rounding
// decides about a ray through the apex is worth nothing: both children meet there.
//
// On a-apex, in the frame with a at the origin; needs sees_left() and a side longer than 0.
[[gnu::always_inline]] inline Window left_child(const Window& w, const Frame& frame, const Division& d,
                                                Real apex_value) {
  const Real inverse = 1 / frame.left;
  const Vec2 u{frame.apex.x * inverse, frame.apex.y * inverse};
  Window l = w;
  l.source = {dot(w.source, u), w.source.y * u.x - w.source.x * u.y};
  const auto place = [&](Real b, Real aside) {
    return std::min(frame.left, frame.left * (b * d.depth / (aside + b * d.depth)));
  };
  if (w.b0 <= 0) {
    l.b0 = 0;
  } else {
    l.b0 = place(w.b0, d.aside0);
    l.d0 = value_at(l, l.b0);
  }
  if (d.sees_right()) {
    l.b1 = frame.left;
    l.d1 = apex_value;
  } else {
    l.b1 = place(w.b1, d.aside1);
    l.d1 = value_at(l, l.b1);
  }
  return l;
}
// On apex-b, with the apex at the origin; needs sees_right() and a side longer than 0.
[[gnu::always_inline]] inline Window right_child(const Window& w, const Frame& frame, const Division& d,
                                                 Real apex_value) {
  const Real inverse = 1 / frame.right;
  const Vec2 u{frame.rest * inverse, -frame.apex.y * inverse};  // from the apex to b
  const Vec2 s = w.source - origin_weight(w.kind) * frame.apex;
  Window r = w;
  r.source = {dot(s, u), s.y * u.x - s.x * u.y};
  if (w.kind == WindowKind::Linear) r.sigma = apex_value;
  const auto place = [&](Real b, Real aside) {
    return std::max(Real{0}, frame.right * (-aside / ((frame.length - b) * d.depth - aside)));
  };
  if (d.sees_left()) {
    r.b0 = 0;
    r.d0 = apex_value;
  } else {
    r.b0 = place(w.b0, d.aside0);
    r.d0 = value_at(r, r.b0);
  }
  if (w.b1 >= frame.length) {
    r.b1 = frame.right;
  } else {
    r.b1 = place(w.b1, d.aside1);
    r.d1 = value_at(r, r.b1);
  }
  return r;
}

// Calls left(child) and right(child) for those that are visible; they have the triangle below and their source in it or
// beyond. They may be slivers.
template <class Left, class Right>
[[gnu::always_inline]] inline void propagate(const Window& w, const Frame& frame, Left&& left, Right&& right) {
  const Division d = divide(w, frame.apex);
  const Real apex_value = straight_value(w, frame.apex);
  if (d.sees_left() && frame.left > 0) {
    const Window child = left_child(w, frame, d, apex_value);
    if (is_visible(child)) left(child);
  }
  if (d.sees_right() && frame.right > 0) {
    const Window child = right_child(w, frame, d, apex_value);
    if (is_visible(child)) right(child);
  }
}

// Whether all light of the window that is worth less than `radius` ends in the triangle: the lines through its other
// edges, as far as any light goes there, are farther. A false "no" costs time only.
inline bool ends_in_face(const Window& w, const Frame& frame, Real radius) {
  if (w.kind != WindowKind::Circular || !(w.source.y < 0)) return false;  // on the edge of a face without area
  const Vec2 c = frame.apex, b{frame.length, 0};
  const Crossing at = crossing(w, c);
  const Real room = radius - w.sigma;
  const bool leaves_left = at.across > w.b0 * at.along && cross(w.source, c) <= room * frame.left;
  const bool leaves_right = at.across < w.b1 * at.along && cross(c - b, w.source - b) <= room * frame.right;
  return !leaves_left && !leaves_right;
}

// Light from a point on the edge of a face without area: the point lies on another edge as well. Calls left and right
// as propagate() does.
template <class Left, class Right>
inline void propagate_along(const Window& w, const Frame& frame, Left&& left, Right&& right) {
  const Real apex = frame.apex.x, x = w.source.x;
  Window out = w;
  out.b0 = 0;
  const auto leave = [&](Real length, Real from_start, auto& to) {
    out.source = {from_start, 0};
    out.b1 = length;
    out.d0 = value_at(out, 0);
    out.d1 = value_at(out, length);
    if (is_visible(out)) to(out);
  };
  leave(frame.left, apex > 0 ? x : -x, left);
  leave(frame.right, apex < frame.length ? x - apex : apex - x, right);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
