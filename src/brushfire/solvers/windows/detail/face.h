// What the propagation knows of a face, in one cache line, and the frame of a halfedge.
#pragma once

#include <brushfire/core/planar.h>
#include <brushfire/mesh/mesh.h>

#include <vector>

namespace brushfire::detail {

// A face is thin whose lowest altitude is less than this share of its longest edge.
inline constexpr double kThin = 1e-3;

// What lies beyond an edge.
enum class Beyond : std::uint8_t {
  Nothing,  // boundary
  Face,     // one face that runs the other way: the common case
  Several,  // a mirrored face, or a ring of three and more
};

struct alignas(64) WindowFace {
  double length[3];        // of halfedge k, mesh.unit()
  double double_area;      // mesh.unit()^2
  Index vertex[3];         // corner k, where halfedge k starts
  Index opposite[3];       // of halfedge k
  Beyond beyond[3];        // of halfedge k
  std::uint8_t bends = 0;  // bit k: paths may bend at vertex[k]
  bool usable = true;      // three distinct vertices
  bool has_target = false;
  bool thin = false;  // so low that light may go round through its neighbours for next to nothing: see WindowMemory
};
static_assert(sizeof(WindowFace) == 64);

constexpr Index next3(Index k) { return k == 2 ? 0 : k + 1; }
constexpr Index previous3(Index k) { return k == 0 ? 2 : k - 1; }

// A triangle over one of its edges a-b: a = (0,0), b = (length,0), apex above.
struct Frame {
  double length;  // a to b
  double left;    // a to apex
  double right;   // apex to b
  Vec2 apex;
};

// The frame of halfedge k of a face; its length is > 0.
inline Frame frame_of(const WindowFace& f, Index k) {
  const double length = f.length[k], left = f.length[previous3(k)], right = f.length[next3(k)];
  return {length, left, right, apex_over_edge(length, left, right, f.double_area)};
}

}  // namespace brushfire::detail
