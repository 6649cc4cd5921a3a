// The frame of a halfedge in numbers of 106 bits.
#pragma once

#include <brushfire/core/detail/double_double.h>
#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>

#include <array>

namespace brushfire::detail {

// A point or an arrow of the plane.
using WideVec2 = BasicVec2<DoubleDouble>;

struct WideFrame {
  DoubleDouble length;
  WideVec2 apex;
};

// From the coordinates where the mesh has them: rounded lengths of a needle's long sides do not tell its angles. In
// mesh.unit(). The halfedge's length must not be 0.
WideFrame wide_frame(const Mesh& mesh, Index h);

// The corners of face f laid flat counter-clockwise, with halfedge k of the face on the x axis.
std::array<WideVec2, 3> wide_corners(const Mesh& mesh, Index f, Index k);

// A point of a face whose corners lie there. Relative to the heaviest corner, so that what is near to it keeps its
// digits; exactly a corner where one weight is 1.
WideVec2 wide_point(const std::array<WideVec2, 3>& corners, const std::array<double, 3>& weights);

}  // namespace brushfire::detail
