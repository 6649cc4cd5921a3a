// From where a mesh is looked at.
#pragma once

#include <brushfire/core/types.h>

#include <span>
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

namespace detail {

// A camera made for given points and a given rectangle of pixels.
class Projection {
 public:
  // The rectangle [x, x + width) x [y, y + height) of the picture, in pixels; points that are not finite do not count.
  Projection(const Camera& camera, std::span<const Vec3> points, double x, double y, double width, double height);

  struct Screen {
    double x, y;    // pixels from the picture's top left
    double depth;   // greater is nearer; linear on the screen along straight lines
    double weight;  // 1 / distance from the eye with perspective, 1 otherwise
  };
  Screen operator()(const Vec3& p) const;
  // A direction in the camera's axes: x to the right, y up, z towards the eye.
  Vec3 direction(const Vec3& d) const;
  // How much `depth` grows over one world unit towards the eye at the place that has this depth.
  double depth_per_unit(double depth) const;
  double pixels_per_unit() const { return scale_; }  // at the middle of what is shown
  double radius() const { return radius_; }          // of what is shown, world units

 private:
  Vec3 in_axes(const Vec3& p) const;
  Vec3 right_, up_, toward_, centre_;
  double radius_ = 1, eye_ = 0;  // eye_: distance of the eye from the centre; 0: orthographic
  double scale_ = 1, offset_x_ = 0, offset_y_ = 0;
};

}  // namespace detail
}  // namespace brushfire
