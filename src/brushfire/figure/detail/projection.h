// A camera fitted to what it shows: from the mesh's coordinates to pixels.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/figure/camera.h>

#include <span>

namespace brushfire::detail {

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

}  // namespace brushfire::detail
