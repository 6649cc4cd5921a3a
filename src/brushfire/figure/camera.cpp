// Views by angle and by name, and fitting them into a rectangle.
#include <brushfire/figure/camera.h>

#include <brushfire/core/error.h>
#include <brushfire/figure/detail/projection.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace brushfire {

Camera named_view(std::string_view name, Camera camera) {
  struct View {
    std::string_view name;
    double azimuth, elevation;
  };
  constexpr double kIsometricElevation = 35.264389682754654;  // atan(1/sqrt 2): the three axes look equally long
  constexpr std::array<View, 7> kViews{{{"front", 0, 0},
                                        {"back", 180, 0},
                                        {"left", -90, 0},
                                        {"right", 90, 0},
                                        {"top", 0, 90},
                                        {"bottom", 0, -90},
                                        {"iso", 45, kIsometricElevation}}};
  for (const View& v : kViews) {
    if (v.name == name) {
      camera.azimuth = v.azimuth;
      camera.elevation = v.elevation;
      return camera;
    }
  }
  throw Error(ErrorCode::InvalidArgument,
              "unknown view '" + std::string(name) + "': it is one of front, back, left, right, top, bottom, iso");
}

Camera turned_to(const Vec3& outward, Camera camera) {
  Vec3 d = outward;  // in axes in which y is up
  if (camera.up == Axis::X) d = {outward.z, outward.x, outward.y};
  if (camera.up == Axis::Z) d = {outward.x, outward.z, -outward.y};
  const double level = std::hypot(d.x, d.z), length = std::hypot(level, d.y);
  if (!(length > 0) || !std::isfinite(length)) return camera;
  constexpr double kDegrees = 180 / kPi, kLowest = -10, kHighest = 40, kUpright = 1e-3;
  if (level > kUpright * length) camera.azimuth = kDegrees * std::atan2(d.x, d.z);
  camera.elevation = std::clamp(kDegrees * std::atan2(d.y, level), kLowest, kHighest);
  return camera;
}

namespace detail {
namespace {

// From axes in which y is up to those of the mesh.
Vec3 with_up(Axis up, const Vec3& d) {
  switch (up) {
    case Axis::X:
      return {d.y, d.z, d.x};
    case Axis::Z:
      return {d.x, -d.z, d.y};
    case Axis::Y:
      break;
  }
  return d;
}

bool finite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

struct Range {
  double low = kInfinity, high = -kInfinity;
  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  double middle() const { return low <= high ? 0.5 * (low + high) : 0; }
  double extent() const { return low <= high ? high - low : 0; }
};

}  // namespace

Projection::Projection(const Camera& camera, std::span<const Vec3> points, double x, double y, double width,
                       double height) {
  const double a = camera.azimuth * kPi / 180, e = camera.elevation * kPi / 180;
  toward_ = with_up(camera.up, {std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)});
  right_ = with_up(camera.up, {std::cos(a), 0, -std::sin(a)});
  up_ = cross(toward_, right_);

  std::array<Range, 3> box;
  for (const Vec3& p : points) {
    if (!finite(p)) continue;
    box[0].add(p.x);
    box[1].add(p.y);
    box[2].add(p.z);
  }
  centre_ = {box[0].middle(), box[1].middle(), box[2].middle()};
  radius_ = 0.5 * norm(Vec3{box[0].extent(), box[1].extent(), box[2].extent()});
  if (!(radius_ > 0)) radius_ = 1;
  constexpr double kEyeDistance = 4;  // radii: a mild perspective, as of a portrait lens
  eye_ = camera.perspective ? kEyeDistance * radius_ : 0;

  Range horizontal, vertical;
  for (const Vec3& p : points) {
    if (!finite(p)) continue;
    const Screen s = (*this)(p);
    horizontal.add(s.x);
    vertical.add(s.y);
  }
  constexpr double kMargin = 0.94;         // of the rectangle is used
  const double smallest = 1e-9 * radius_;  // a line seen from its end still gets a scale
  scale_ = kMargin * camera.zoom *
           std::min(width / std::max(horizontal.extent(), smallest), height / std::max(vertical.extent(), smallest));
  offset_x_ = x + 0.5 * width - scale_ * horizontal.middle();
  offset_y_ = y + 0.5 * height - scale_ * vertical.middle();
}

Vec3 Projection::in_axes(const Vec3& p) const { return direction(p - centre_); }

Vec3 Projection::direction(const Vec3& d) const { return {dot(right_, d), dot(up_, d), dot(toward_, d)}; }

Projection::Screen Projection::operator()(const Vec3& p) const {
  const Vec3 q = in_axes(p);
  if (eye_ == 0) return {offset_x_ + scale_ * q.x, offset_y_ - scale_ * q.y, q.z, 1};
  const double weight = 1 / (eye_ - q.z);
  const double shrink = eye_ * weight;
  return {offset_x_ + scale_ * q.x * shrink, offset_y_ - scale_ * q.y * shrink, weight, weight};
}

double Projection::depth_per_unit(double depth) const { return eye_ == 0 ? 1 : depth * depth; }

}  // namespace detail
}  // namespace brushfire
