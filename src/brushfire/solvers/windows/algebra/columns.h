// A list of windows on one edge as columns of numbers, for loops over all of them.
#pragma once

#include <brushfire/solvers/windows/algebra/window.h>

#include <cstdint>
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

// Loops over columns go on to the end of four windows; from a place within a column that is up to three numbers beyond
// its end. As many may be read behind every column, and as many written to others than columns.
inline constexpr Index kRoomBehind = 4;

// Of the four windows from `first` on, those that there are, as bits.
inline std::uint32_t windows_from(Index first, Index count) {
  return count - first >= 4 ? 15u : (1u << (count - first)) - 1;
}

// `to` needs room for three more.
inline void copy_windows(const WindowColumns& from, const WindowColumns& to, Index count) {
  for (Index i = 0; i < count; i += 4) {
    std::memcpy(to.b0 + i, from.b0 + i, 4 * sizeof(Real));
    std::memcpy(to.b1 + i, from.b1 + i, 4 * sizeof(Real));
    std::memcpy(to.x + i, from.x + i, 4 * sizeof(Real));
    std::memcpy(to.y + i, from.y + i, 4 * sizeof(Real));
    std::memcpy(to.sigma + i, from.sigma + i, 4 * sizeof(Real));
    std::memcpy(to.pseudo_source + i, from.pseudo_source + i, 4 * sizeof(Index));
  }
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
