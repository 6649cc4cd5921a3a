// A list of windows on one edge as columns of numbers, for loops over all of them.
#pragma once

#include <brushfire/solvers/windows/algebra/window.h>

#include <cstring>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// The columns of a list of windows without slack. The values at the ends are not kept: they are needed when a list is
// trimmed, and a list crosses several faces between two trimmings.
//
// Sources lie below the edge; of linear windows the direction to the light is kept with its y turned around, so that
// y > 0 tells them. Where a list has none (nearly always), its loops need not ask: see `mixed`.
struct WindowColumns {
  Real *b0, *b1;         // the visible interval
  Real *x, *y;           // the virtual source
  Real* sigma;           // value there
  Index* pseudo_source;  // see Window
  bool mixed = false;    // some of the windows may be linear

  bool is_linear(Index i) const { return mixed && y[i] > 0; }
  WindowKind kind(Index i) const { return is_linear(i) ? WindowKind::Linear : WindowKind::Circular; }
  Vec2 source(Index i) const { return {x[i], is_linear(i) ? -y[i] : y[i]}; }
  Real value(Index i, Real at) const { return sigma[i] + (is_linear(i) ? -(at * x[i]) : length_of(at - x[i], y[i])); }
  Window window(Index i) const {
    Window w;
    w.b0 = b0[i];
    w.b1 = b1[i];
    w.kind = kind(i);
    w.source = source(i);
    w.sigma = sigma[i];
    w.d0 = value_at(w, w.b0);
    w.d1 = value_at(w, w.b1);
    w.pseudo_source = pseudo_source[i];
    return w;
  }
  void set(Index i, const Window& w) const {
    b0[i] = w.b0;
    b1[i] = w.b1;
    x[i] = w.source.x;
    y[i] = w.kind == WindowKind::Linear ? -w.source.y : w.source.y;
    sigma[i] = w.sigma;
    pseudo_source[i] = w.pseudo_source;
  }
  void move(Index to, Index from) const { copy_from(to, *this, from); }
  void copy_from(Index to, const WindowColumns& other, Index from) const {
    b0[to] = other.b0[from];
    b1[to] = other.b1[from];
    x[to] = other.x[from];
    y[to] = other.y[from];
    sigma[to] = other.sigma[from];
    pseudo_source[to] = other.pseudo_source[from];
  }
  WindowColumns from(Index i) const { return {b0 + i, b1 + i, x + i, y + i, sigma + i, pseudo_source + i, mixed}; }
};
inline void copy_windows(const WindowColumns& from, const WindowColumns& to, Index count) {
  std::memcpy(to.b0, from.b0, count * sizeof(Real));
  std::memcpy(to.b1, from.b1, count * sizeof(Real));
  std::memcpy(to.x, from.x, count * sizeof(Real));
  std::memcpy(to.y, from.y, count * sizeof(Real));
  std::memcpy(to.sigma, from.sigma, count * sizeof(Real));
  std::memcpy(to.pseudo_source, from.pseudo_source, count * sizeof(Index));
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
