// A list of windows on one edge as columns of numbers, for loops over all of them.
#pragma once

#include <brushfire/solvers/windows/algebra/window.h>

#include <cstring>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// The columns of a list of circular windows without slack. The values at the ends are not kept: they are needed when a
// list is trimmed, and a list crosses several faces between two trimmings.
struct WindowColumns {
  Real *b0, *b1;         // the visible interval
  Real *x, *y;           // the virtual source
  Real* sigma;           // value there
  Index* pseudo_source;  // see Window

  Window window(Index i) const {
    Window w;
    w.b0 = b0[i];
    w.b1 = b1[i];
    w.source = {x[i], y[i]};
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
    y[i] = w.source.y;
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
  WindowColumns from(Index i) const { return {b0 + i, b1 + i, x + i, y + i, sigma + i, pseudo_source + i}; }
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
