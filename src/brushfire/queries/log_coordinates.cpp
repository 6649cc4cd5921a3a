// Turning and flattening of log maps.
#include <brushfire/queries/log_coordinates.h>

#include <cmath>
#include <numbers>

namespace brushfire {
namespace {

bool is_on_border(const Mesh& mesh, const SurfacePoint& point) {
  const PointLocation at = locate(mesh, point);
  return at.on == PointLocation::On::Vertex && mesh.links()[at.vertex] != Link::Circle;
}

}  // namespace

void turn(const Mesh& mesh, const SurfacePoint& source, const std::optional<Vec3>& direction, SparseLogMap& map) {
  const bool mirrored = !is_counter_clockwise(mesh, source), on_border = is_on_border(mesh, source);
  const double first = direction ? angle_of(mesh, source, *direction) : mirrored ? map.total_angle : 0;
  for (std::size_t i = 0; i < map.angle.size(); ++i) {
    double& angle = map.angle[i];
    if (map.radius[i] == 0) continue;
    angle = mirrored ? first - angle : angle - first;
    if (!on_border && angle < 0) angle += map.total_angle;
  }
}

std::vector<std::array<double, 2>> flat_coordinates(const Mesh& mesh, const SurfacePoint& source,
                                                    const SparseLogMap& map) {
  const double stretch = is_on_border(mesh, source) ? 1 : 2 * std::numbers::pi / map.total_angle;
  std::vector<std::array<double, 2>> flat(map.vertex.size());
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const double r = map.radius[i], angle = stretch * map.angle[i];
    if (r > 0) flat[i] = {r * std::cos(angle), r * std::sin(angle)};
  }
  return flat;
}

}  // namespace brushfire
