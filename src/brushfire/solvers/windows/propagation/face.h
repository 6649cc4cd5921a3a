// What the propagation knows of a face, in one cache line.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/solvers/windows/algebra/face_shape.h>
#include <brushfire/solvers/windows/algebra/frame.h>

#include <cstdint>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

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

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
