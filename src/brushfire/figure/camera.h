// From where a mesh is looked at.
#pragma once

#include <brushfire/core/types.h>

#include <string_view>

namespace brushfire {

enum class Axis : std::uint8_t { X, Y, Z };

// The camera looks at the middle of what it shows and is moved back until everything fits.
struct Camera {
  double azimuth = 30;       // degrees around the up axis; 0 looks from the front
  double elevation = 20;     // degrees above the horizon; 90 looks from the top
  Axis up = Axis::Y;         // with y up the front shows the x-y plane as on paper
  bool perspective = false;  // otherwise orthographic: equal lengths look equal
  double zoom = 1;           // > 1: closer than what fits
};

// "front", "back", "left", "right", "top", "bottom", "iso": sets azimuth and elevation, keeps the rest.
// Throws Error(InvalidArgument) that lists them.
Camera named_view(std::string_view name, Camera camera = {});

// Looks along `outward` at the surface, from no more than 40 degrees above and 10 below, so that up stays up: what lies
// on the side that a direction points to is seen. The null vector changes nothing.
Camera turned_to(const Vec3& outward, Camera camera = {});

}  // namespace brushfire
