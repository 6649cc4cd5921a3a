// Finding the last leg of a path by looking, where the ray that was kept does not lead anywhere for sure.
#pragma once

#include <brushfire/solvers/window_field.h>
#include <brushfire/solvers/windows/detail/record.h>

namespace brushfire::detail {

// The leg that ends at the point `at`, whose value is `value`: straight to a vertex or a source from which it explains
// the value. `hint` is looked along first, and no more than that: the leg is proven by its length, in numbers of 106
// bits. Where nothing explains the value to kAgreement, the shortest that there is. No points where there is none.
WindowField::Leg find_leg(const WindowFieldData& data, const PointLocation& at, double value, const Ray& hint);

// What a leg and the value where it starts may miss the value at its end by, as a share of it.
inline constexpr double kAgreement = 1e-12;

// A leg that passes a vertex at this share of the way to the nearer of its ends goes through it: the bend that this
// makes cannot be told from straight.
inline constexpr double kThrough = 1e-9;

}  // namespace brushfire::detail
