// All light that crosses one face of a field: what decides how its level sets run there.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/solvers/window_field.h>
#include <brushfire/solvers/windows/paths/point_values.h>

#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// The fronts of a usable face of field.mesh(), in the plane of its flat_corners(), in mesh.unit(), with the values that
// WindowField::value() has. Light of one virtual source that comes through two windows beside each other is one front.
// Of a field whose windows were kept: throws Error(InvalidArgument) otherwise. O(square of the face's windows).
std::vector<FaceFront> face_fronts(const WindowField& field, Index face);

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
