// What the propagation knows of a face, in one cache line, and the frame of a halfedge.
#pragma once

#include <brushfire/core/detail/planar.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/windows/detail/face_shape.h>
#include <brushfire/solvers/windows/detail/real.h>

#include <vector>

namespace brushfire::detail::BRUSHFIRE_NUMBERS {

// A face is thin whose lowest altitude is less than this share of its longest edge.
inline constexpr double kThin = 1e-3;

// What lies beyond an edge.
enum class Beyond : std::uint8_t {
  Nothing,  // boundary
  Face,     // one face that runs the other way: the common case
  Several,  // a mirrored face, or a ring of three and more
};

struct alignas(64) WindowFace : Feet<kWide> {
  Real length[3];     // of halfedge k, mesh.unit()
  Real double_area;   // mesh.unit()^2
  Index vertex[3];    // corner k, where halfedge k starts
  Index opposite[3];  // of halfedge k
  Index waiting;      // the first of the windows that wait on the face's halfedges: see WindowLists
  Beyond beyond[3];   // of halfedge k
  bool usable : 1;    // three distinct vertices
  bool has_target : 1;
  bool thin : 1;  // so low that light may go round through its neighbours for next to nothing: see WindowMemory
};
static_assert(sizeof(WindowFace) == 64 || kWide);

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

}  // namespace brushfire::detail::BRUSHFIRE_NUMBERS
