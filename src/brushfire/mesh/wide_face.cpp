// Faces laid flat, from coordinates or from lengths.
#include <brushfire/mesh/detail/wide_face.h>

#include <algorithm>

namespace brushfire::detail {
namespace {

using Arrow = std::array<DoubleDouble, 3>;

// Differences of doubles are exact; the unit is a power of two.
Arrow arrow(const Mesh& mesh, Index from, Index to, double scale) {
  const Vec3 &a = mesh.positions()[from], &b = mesh.positions()[to];
  return {DoubleDouble::sum(scale * b.x, -scale * a.x), DoubleDouble::sum(scale * b.y, -scale * a.y),
          DoubleDouble::sum(scale * b.z, -scale * a.z)};
}

DoubleDouble dot(const Arrow& a, const Arrow& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
DoubleDouble norm(const Arrow& a) { return sqrt(dot(a, a)); }
Arrow cross(const Arrow& a, const Arrow& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

WideFrame from_positions(const Mesh& mesh, Index h) {
  const double scale = 1 / mesh.unit();
  const Index a = mesh.from(h), b = mesh.to(h), c = mesh.from(Mesh::previous(h));
  const Arrow side = arrow(mesh, a, b, scale), left = arrow(mesh, a, c, scale), right = arrow(mesh, b, c, scale);
  const DoubleDouble length = norm(side);
  const DoubleDouble area = norm(cross(side, dot(left, left) < dot(right, right) ? left : right));
  return {length, {dot(side, left) / length, area / length}};
}

WideFrame from_lengths(const Mesh& mesh, Index h) {
  const DoubleDouble length = mesh.length(h), left = mesh.length(Mesh::previous(h)), right = mesh.length(Mesh::next(h));
  DoubleDouble a = left, b = right, c = length;
  if (a < b) std::swap(a, b);
  if (a < c) std::swap(a, c);
  if (b < c) std::swap(b, c);
  const DoubleDouble area = 0.5 * sqrt((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c)));
  return {length, {0.5 * (length + (left - right) * (left + right) / length), area / length}};
}

}  // namespace

WideFrame wide_frame(const Mesh& mesh, Index h) {
  return mesh.has_positions() ? from_positions(mesh, h) : from_lengths(mesh, h);
}

std::array<WideVec2, 3> wide_corners(const Mesh& mesh, Index f, Index k) {
  std::array<WideVec2, 3> corners;
  const Index h = 3 * f + k;
  if (!(mesh.length(h) > 0)) return corners;
  const WideFrame frame = wide_frame(mesh, h);
  corners[Mesh::next(h) % 3] = {frame.length, 0.0};
  corners[Mesh::previous(h) % 3] = frame.apex;
  return corners;
}

WideVec2 wide_point(const std::array<WideVec2, 3>& corners, const std::array<double, 3>& weights) {
  const auto k = static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  if (weights[i] == 0 && weights[j] == 0) return corners[k];
  const DoubleDouble sum = DoubleDouble(weights[k]) + weights[i] + weights[j];
  return corners[k] + (weights[i] / sum) * (corners[i] - corners[k]) + (weights[j] / sum) * (corners[j] - corners[k]);
}

}  // namespace brushfire::detail
