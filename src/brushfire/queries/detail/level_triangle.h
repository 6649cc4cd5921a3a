// Whether a level set of the exact distance runs through a triangle as the linear field of its corners' values says.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/solvers/windows/paths/point_values.h>

#include <array>
#include <span>

namespace brushfire::detail {

// Three points of a face, in the plane of flat_corners(), and their values; all in mesh.unit().
struct LevelTriangle {
  std::array<Vec2, 3> corners;
  std::array<double, 3> values;
};

// True only where { value < level } meets each side of the triangle as the signs at its ends say (not at all, or in an
// interval from one end), and no part of its border is a closed curve inside: then the level set in the triangle is
// none or one curve between those sides that the linear field crosses, too. `fronts`: all that cross the face. Fronts
// whose values differ by less than `room` are not told apart. O(square of the fronts), O(fronts) mostly.
//
// What decides: sub-level sets of one front are convex; along a way on which every front that matters grows, so does
// the least of them; and the value changes by at most the distance.
bool corners_tell(const LevelTriangle& triangle, double level, std::span<const windows::FaceFront> fronts, double room);

}  // namespace brushfire::detail
