// By the angle between edge and grain.
#include <brushfire/solvers/steiner/detail/stretches.h>

#include <brushfire/core/detail/planar.h>
#include <brushfire/mesh/detail/flat_face.h>

#include <cmath>

namespace brushfire::steiner {
namespace {

// A direction is given to some digits: what is left of it in a face's plane is noise below this.
constexpr double kUpright = 1e-9;

}  // namespace

FaceStretch stretch_of(const Mesh& mesh, Index f, const Grain& grain) {
  FaceStretch result;
  const Face& t = mesh.faces()[f];
  const auto edge = [&](Index k) { return mesh.positions()[t[(k + 1) % 3]] - mesh.positions()[t[k]]; };
  const Vec3 up = cross(edge(0), edge(1));
  const double area = norm(up), length = norm(grain.direction);
  if (!(area > 0 && length > 0)) return result;
  const Vec3 normal = (1 / area) * up, given = (1 / length) * grain.direction;
  const Vec3 flat = given - dot(given, normal) * normal;
  if (!(norm(flat) > kUpright)) return result;
  const Vec3 with = (1 / norm(flat)) * flat, against = cross(normal, with);
  result.area = grain.across;
  for (Index k = 0; k < 3; ++k) {
    const Vec3 e = edge(k);
    if (norm(e) > 0) result.along[k] = std::hypot(dot(e, with), grain.across * dot(e, against)) / norm(e);
  }
  return result;
}

Stretches::Stretches(const Mesh& mesh, std::span<const Grain> grain) {
  if (grain.empty()) return;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const FaceStretch s = stretch_of(mesh, f, grain[f]);
    along_.insert(along_.end(), s.along.begin(), s.along.end());
    across_.push_back(s.area);
  }
}

double Stretches::within(const Mesh& mesh, Index f, const std::array<double, 3>& a,
                         const std::array<double, 3>& b) const {
  if (!any()) return distance_within(mesh, f, a, b);
  const auto length = [&](Index k) { return along_[3 * f + k] * mesh.lengths()[3 * f + k]; };
  if (!(length(0) > 0)) return length(1) * std::abs(b[2] - a[2]);
  const Vec2 apex = apex_over_edge(length(0), length(2), length(1), across_[f] * mesh.double_areas()[f]);
  return norm((b[1] - a[1]) * Vec2{length(0), 0} + (b[2] - a[2]) * apex);
}

}  // namespace brushfire::steiner
