// Lengths and areas from positions, in the room's number.
#include <brushfire/solvers/windows/algebra/face_shape.h>

#include <brushfire/core/detail/planar.h>

#include <algorithm>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

Vec3 scaled(const brushfire::Vec3& p, double scale) {
  return {Real{p.x * scale}, Real{p.y * scale}, Real{p.z * scale}};
}

// (These two: of wider numbers.)
[[maybe_unused]] FaceShape shape_from_positions(const Mesh& mesh, const Face& t) {
  const double scale = 1 / mesh.unit();  // a power of two: nothing is rounded
  const auto p = mesh.positions();
  const std::array<Vec3, 3> corner{scaled(p[t[0]], scale), scaled(p[t[1]], scale), scaled(p[t[2]], scale)};
  FaceShape shape;
  std::array<Vec3, 3> edge;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    // The same bits from both sides of an edge.
    edge[k] = t[k] < t[next] ? corner[next] - corner[k] : Real{-1} * (corner[k] - corner[next]);
    shape.length[k] = norm(edge[k]);
  }
  const auto longest =
      static_cast<std::size_t>(std::max_element(shape.length.begin(), shape.length.end()) - shape.length.begin());
  shape.double_area = norm(cross(edge[(longest + 1) % 3], edge[(longest + 2) % 3]));
  for (std::size_t k = 0; k < 3; ++k) {
    // On an edge without length: nowhere else.
    shape.set_foot(k, shape.length[k] > 0 ? -dot(edge[k], edge[(k + 2) % 3]) / shape.length[k] : Real{0});
  }
  return shape;
}

[[maybe_unused]] FaceShape shape_from_lengths(const Mesh& mesh, Index f) {
  const auto l = mesh.lengths().subspan(3 * std::size_t{f}, 3);
  FaceShape shape;
  shape.length = {l[0], l[1], l[2]};
  shape.double_area = 0;
  const Real q = heron_sorted(shape.length[0], shape.length[1], shape.length[2]);
  if (q > 0) shape.double_area = 0.5 * sqrt(q);
  for (std::size_t k = 0; k < 3; ++k) {
    const Real left = shape.length[(k + 2) % 3], right = shape.length[(k + 1) % 3];
    const Real length = shape.length[k];
    shape.set_foot(k, length > 0 ? 0.5 * (length + (left - right) * ((left + right) / length)) : Real{0});
  }
  return shape;
}

}  // namespace

FaceShape shape_of(const Mesh& mesh, Index f) {
  if constexpr (kWide) {
    return mesh.has_positions() ? shape_from_positions(mesh, mesh.faces()[f]) : shape_from_lengths(mesh, f);
  }
  const auto l = mesh.lengths().subspan(3 * std::size_t{f}, 3);
  FaceShape shape;
  shape.length = {l[0], l[1], l[2]};
  shape.double_area = mesh.double_areas()[f];
  return shape;
}

// In the frame of the longest edge: see flat_corners(), flat_difference().
Real distance_in(const FaceShape& shape, const std::array<Real, 3>& from, const std::array<Real, 3>& to) {
  const auto& l = shape.length;
  const auto base = static_cast<std::size_t>(std::max_element(l.begin(), l.end()) - l.begin());
  if (!(l[base] > 0)) return 0;
  std::array<Vec2, 3> corner;
  corner[(base + 1) % 3] = {l[base], 0};
  corner[(base + 2) % 3] = {foot_of(shape, base), shape.double_area / l[base]};
  const std::array<Real, 3> step = step_between(from, to);
  return norm(step[1] * (corner[1] - corner[0]) + step[2] * (corner[2] - corner[0]));
}

std::array<Real, 3> weights_from(const std::array<double, 3>& weights) {
  const std::array<Real, 3> w{weights[0], weights[1], weights[2]};
  if constexpr (!kWide) return w;
  const Real sum = w[0] + w[1] + w[2];
  return {w[0] / sum, w[1] / sum, w[2] / sum};
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
