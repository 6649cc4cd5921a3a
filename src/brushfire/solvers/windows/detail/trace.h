// Following a ray back to its root.
#pragma once

#include <brushfire/solvers/window_field.h>
#include <brushfire/solvers/windows/detail/record.h>

namespace brushfire::detail::BRUSHFIRE_NUMBERS {

// The leg that ends at the point `at` of the face of ray.halfedge and came along `ray`; value: of the point. Falls back
// on a straight line within the face where rounding has led the ray astray; no points where there is none either.
WindowField::Leg trace_leg(const WindowFieldData& data, const FaceWeights& at, const Ray& ray, Real value);

}  // namespace brushfire::detail::BRUSHFIRE_NUMBERS
