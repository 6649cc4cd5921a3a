// The cut locus at vertices: paths of neighbours, carried on around the neighbour, that are as short as a vertex's own.
#include <brushfire/queries/distance_gradient.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/queries/detail/tangent_fan.h>
#include <brushfire/queries/detail/way_around.h>
#include <brushfire/solvers/windows/paths/field_rays.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace brushfire {
namespace {

using detail::FanCorner;
using detail::TangentFan;

// Where a vertex's last leg comes from: looking back along it.
struct Back {
  double angle = 0;   // in the vertex's fan
  double length = 0;  // of the leg, and the value where it starts; the mesh's units
  double start = 0;
};

class CutLocus {
 public:
  CutLocus(const Mesh& mesh, const WindowField& field, std::span<const double> value, double tie)
      : mesh_(mesh), field_(field), rays_(field), value_(value), tie_(tie) {
    fans_.resize(mesh.vertex_count());
    backs_.resize(mesh.vertex_count());
    Poll poll(64);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      poll();
      const Link link = mesh.links()[v];
      if (!(value[v] < kInfinity) || (link != Link::Circle && link != Link::Arc)) continue;
      fans_[v] = detail::tangent_fan(mesh, v);
      backs_[v] = back_from(v);
    }
  }

  bool has(Index v) const {
    if (!backs_[v]) return false;
    for (const FanCorner& c : fans_[v].corners) {
      for (const Index h : {c.corner, Mesh::previous(c.corner)}) {
        const Index w = h == c.corner ? mesh_.to(h) : mesh_.from(h);
        if (backs_[w] && ties_over(v, w, h)) return true;
      }
    }
    return false;
  }

 private:
  std::optional<Back> back_from(Index v) const {
    detail::Direction direction;
    double length = 0;
    if (const auto ray = rays_.arrival(v)) {
      direction = {Mesh::previous(ray->halfedge), 0};
      const Vec2 back = -1 * ray->arrow, edge = Vec2{0, 0} - ray->apex;  // along the corner's halfedge
      direction.angle =
          std::clamp(std::atan2(cross(edge, back), dot(edge, back)), 0.0, mesh_.corner_angle(direction.corner));
      length = ray->length;
    } else {
      const WindowField::Leg leg = field_.last_leg(v);
      if (leg.points.size() < 2) return std::nullopt;
      const PointLocation at = locate(mesh_, leg.points[0], 0), before = locate(mesh_, leg.points[1], 0);
      const Index f = common_face(mesh_, at, before, leg.points[0].face);
      direction = detail::direction_towards(mesh_, v, f, *weights_in(mesh_, before, f));
      length = leg.length;
    }
    if (!mesh_.is_face_usable(Mesh::face_of(direction.corner))) return std::nullopt;
    return Back{fans_[v].around(direction.corner, direction.angle), length, value_[v] - length};
  }

  // Where halfedge h of a face, at whose one end v is, lies in v's fan; and whether the fan goes through the face as
  // its corners do.
  struct EdgeInFan {
    double angle;
    bool reversed;
  };
  EdgeInFan edge_in_fan(Index v, Index h) const {
    const bool ahead = mesh_.from(h) == v;
    const Index corner = ahead ? h : Mesh::next(h);
    for (const FanCorner& c : fans_[v].corners) {
      if (c.corner == corner) return {c.start + (ahead == c.reversed ? c.angle : 0), c.reversed};
    }
    return {0, false};
  }

  // Whether the path of w, carried on to v past w on either side, is as long as v's and comes from elsewhere.
  bool ties_over(Index v, Index w, Index h) const {
    const double edge = mesh_.lengths()[h] * mesh_.unit();
    const EdgeInFan from_v = edge_in_fan(v, h), from_w = edge_in_fan(w, h);
    const Back &own = *backs_[v], &other = *backs_[w];
    for (const double side : {1.0, -1.0}) {
      const std::optional<double> turn = angle_between(fans_[w], other.angle, from_w.angle, side);
      if (!turn) continue;
      // The triangle of w, v and where w's path comes from, laid flat; past pi the path bends at w.
      const double turned = std::min(*turn, kPi);
      const double x = edge - other.length * std::cos(turned), y = other.length * std::sin(turned);
      const double way = std::hypot(x, y), length = other.start + way;
      if (!(way > kNoWay * edge)) continue;            // w's path comes from v
      if (turned < kSameDirection && x < 0) continue;  // or through it
      if (!(std::abs(length - value_[v]) <= tie_ * value_[v])) continue;
      const double aside = side * (from_v.reversed == from_w.reversed ? 1 : -1) * std::atan2(y, x);
      if (differ(fans_[v], own.angle, from_v.angle + aside)) return true;
    }
    return false;
  }

  // From one angle to another in the fan's sense (side 1) or against it.
  static std::optional<double> angle_between(const TangentFan& fan, double from, double to, double side) {
    double angle = side * (to - from);
    if (angle < 0) {
      if (!fan.closed) return std::nullopt;
      angle += fan.total;
    }
    return angle;
  }

  static constexpr double kNoWay = 1e-9;  // what rounding leaves of none
  // Two paths that part by less than this differ in length by its square only: they are told to be one.
  static constexpr double kSameDirection = 1e-4;
  static bool differ(const TangentFan& fan, double a, double b) {
    const double apart = std::abs(a - b);
    return apart > kSameDirection && (!fan.closed || std::abs(apart - fan.total) > kSameDirection);
  }

  const Mesh& mesh_;
  const WindowField& field_;
  windows::FieldRays rays_;
  std::span<const double> value_;
  double tie_;
  std::vector<TangentFan> fans_;
  std::vector<std::optional<Back>> backs_;
};

}  // namespace

std::vector<std::uint8_t> one_sided_vertices(const Domain& domain, const DistanceField& field, double tie) {
  if (!field.windows || field.windows->mesh().vertex_count() != domain.open().vertex_count()) {
    throw Error(ErrorCode::InvalidArgument, "the cut locus needs the paths of a field of this mesh: keep_paths");
  }
  if (!(tie >= 0)) throw Error(ErrorCode::InvalidArgument, "tie: a share >= 0 is needed");
  const std::span<const double> value = domain.has_walls() ? field.side_distance : field.distance;
  const CutLocus locus(domain.open(), *field.windows, value, tie);
  std::vector<std::uint8_t> result(domain.mesh().vertex_count(), 0);
  std::vector<std::uint8_t> sides(domain.mesh().vertex_count(), 0);
  for (Index v = 0; v < domain.open().vertex_count(); ++v) {
    const Index whole = domain.vertex(v);
    if (!(value[v] < kInfinity) || value[v] > field.distance[whole] * (1 + tie)) continue;
    if (locus.has(v) || sides[whole]++ > 0) result[whole] = 1;
  }
  return result;
}

}  // namespace brushfire
