// The frame of a halfedge: a triangle over one of its edges, in the plane.
#pragma once

#include <brushfire/core/detail/planar.h>
#include <brushfire/core/types.h>
#include <brushfire/solvers/windows/algebra/real.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// From tables of two bits an entry: these are asked at random all the time, and a branch would be guessed wrong.
constexpr Index next3(Index k) { return 0b00'10'01u >> 2 * k & 3; }
constexpr Index previous3(Index k) { return 0b01'00'10u >> 2 * k & 3; }

// A triangle over one of its edges a-b: a = (0,0), b = (length,0), apex above.
struct Frame {
  Real length;  // a to b
  Real left;    // a to apex
  Real right;   // apex to b
  Vec2 apex;
  Real rest = length - apex.x;  // from the foot of the apex to b
};

// The frame of halfedge k of a face (a WindowFace or a FaceShape); its length is > 0.
template <class F>
[[gnu::always_inline]] inline Frame frame_of(const F& f, Index k) {
  const Real length = f.length[k], left = f.length[previous3(k)], right = f.length[next3(k)];
  if constexpr (kWide) {
    return {length, left, right, {f.foot[k], f.double_area / length}, right * (f.foot[next3(k)] / length)};
  } else {
    const Vec2 apex = apex_over_edge(length, left, right, f.double_area);
    return {length, left, right, apex};
  }
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
