// Following a ray back to its root.
#pragma once

#include <brushfire/solvers/window_field.h>
#include <brushfire/solvers/windows/paths/record.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// The leg that ends at the point `at` of the face of ray.halfedge and came along `ray`; value: of the point. No points
// where rounding could have decided anything about it, or where it is not as long as the values at its ends say:
// find_leg() then has to look.
WindowField::Leg trace_leg(const WindowFieldData& data, const FaceWeights& at, const Ray& ray, Real value);

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
