// Tracing straightest geodesics: through faces, over edges, and over vertices with equal angles on both sides.
#include <brushfire/queries/straightest.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/queries/detail/only_side.h>
#include <brushfire/queries/detail/tangent_fan.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace brushfire {
namespace {

using On = PointLocation::On;

// Nearer than this share of an edge to its end, a trace runs over the vertex.
constexpr double kVertexReach = 1e-12;

Vec2 unit_vector(double angle) { return {std::cos(angle), std::sin(angle)}; }
Vec2 turned(Vec2 v, double angle) {
  const Vec2 u = unit_vector(angle);
  return {u.x * v.x - u.y * v.y, u.y * v.x + u.x * v.y};
}
double direction_of(Vec2 v) { return std::atan2(v.y, v.x); }

double wrapped(double angle, double turn) {
  const double a = std::fmod(angle, turn);
  return a < 0 ? a + turn : a;
}

// The walk within one face: where it is, in the plane of flat_corners, and where it goes.
struct Walker {
  Index face = kNoIndex;
  std::array<double, 3> weights{0, 0, 0};
  Vec2 direction;                 // unit
  Index entered_over = kNoIndex;  // the halfedge that the walk came in over: it does not leave there
  Index from_corner = kNoIndex;   // the corner that it started from: it leaves over the opposite edge
};

class Tracer {
 public:
  Tracer(const Mesh& mesh, double length) : mesh_(mesh), left_(length / mesh.unit()) {}

  Trace run(const PointLocation& from, double angle) {
    trace_.path.length = 0;
    add_point({from.face, from.weights});
    bool going = start(from, angle);
    while (going && left_ > 0) going = cross_face();
    trace_.path.length *= mesh_.unit();
    return std::move(trace_);
  }

 private:
  bool stop(TraceEnd end) {
    trace_.end = end;
    return false;
  }

  void add_point(const SurfacePoint& p) { trace_.path.points.push_back(p); }

  bool start(const PointLocation& from, double angle) {
    if (from.on == On::Vertex) return leave_vertex(from.vertex, angle);
    const std::array<Vec2, 3> c = flat_corners(mesh_, from.face);
    at_ = {from.face, from.weights, unit_vector(direction_of(c[1] - c[0]) + wrapped(angle, 2 * kPi)), kNoIndex,
           kNoIndex};
    if (from.on != On::Edge) return true;
    const Index k = from.halfedge % 3;
    const double side = cross(c[(k + 1) % 3] - c[k], at_.direction);
    if (side >= 0) {
      at_.entered_over = from.halfedge;
      return true;
    }
    return over_edge(from.halfedge, from.t);
  }

  // From a vertex in a direction of its fan.
  bool leave_vertex(Index vertex, double angle) {
    const detail::TangentFan fan = detail::tangent_fan(mesh_, vertex);
    if (fan.closed) {
      angle = wrapped(angle, fan.total);
    } else if (angle < 0 || angle > fan.total) {
      return stop(TraceEnd::Boundary);
    }
    const auto [corner, inside] = fan.at(angle);
    const Index f = Mesh::face_of(corner), k = corner % 3;
    const std::array<Vec2, 3> c = flat_corners(mesh_, f);
    const Vec2 edge = c[(k + 1) % 3] - c[k];
    at_ = {f, {0, 0, 0}, turned((1 / norm(edge)) * edge, inside), kNoIndex, corner};
    at_.weights[k] = 1;
    return true;
  }

  // Walks to where the ray leaves the face, or ends inside it.
  bool cross_face() {
    const std::array<Vec2, 3> c = flat_corners(mesh_, at_.face);
    const Vec2 p = at_.weights[0] * c[0] + at_.weights[1] * c[1] + at_.weights[2] * c[2];
    Index exit = kNoIndex;
    double exit_share = 0, exit_distance = kInfinity, exit_miss = kInfinity;
    for (Index k = 0; k < 3; ++k) {
      const Index h = 3 * at_.face + k;
      if (h == at_.entered_over) continue;
      if (at_.from_corner != kNoIndex && h != Mesh::next(at_.from_corner)) continue;
      const Vec2 a = c[k] - p, b = c[(k + 1) % 3] - p;
      // The ray leaves over this edge where it has the edge's start on its right and its end on its left.
      const double right = cross(at_.direction, a), left = cross(at_.direction, b);
      const double across = left - right;
      if (!(across > 0)) continue;
      const double share = std::clamp(-right / across, 0.0, 1.0);
      const double distance = (1 - share) * dot(at_.direction, a) + share * dot(at_.direction, b);
      // Of two edges that rounding lets through, the one whose inside the ray hits; else the nearer one.
      const double miss = std::max({0.0, right, -left}) / across;
      if (miss < exit_miss || (miss == exit_miss && distance < exit_distance)) {
        exit = h;
        exit_share = share;
        exit_distance = distance;
        exit_miss = miss;
      }
    }
    if (exit == kNoIndex) return stop(TraceEnd::NonManifold);  // a face without an inside
    exit_distance = std::max(0.0, exit_distance);
    if (exit_distance >= left_) return end_inside(c, p);
    left_ -= exit_distance;
    trace_.path.length += exit_distance;
    const Index k = exit % 3;
    if (exit_share <= kVertexReach) return over_vertex(exit, c, p);
    if (exit_share >= 1 - kVertexReach) return over_vertex(Mesh::next(exit), c, p);
    SurfacePoint here{at_.face, {0, 0, 0}};
    here.weights[k] = 1 - exit_share;
    here.weights[(k + 1) % 3] = exit_share;
    add_point(here);
    return over_edge(exit, exit_share);
  }

  bool end_inside(const std::array<Vec2, 3>& c, Vec2 p) {
    const Vec2 q = p + left_ * at_.direction;
    const double area = cross(c[1] - c[0], c[2] - c[0]);
    SurfacePoint here{at_.face, {0, 0, 0}};
    for (std::size_t k = 0; k < 3; ++k) {
      here.weights[k] = std::max(0.0, cross(c[(k + 1) % 3] - q, c[(k + 2) % 3] - q) / area);
    }
    const double sum = here.weights[0] + here.weights[1] + here.weights[2];
    for (double& w : here.weights) w /= sum;
    trace_.path.length += left_;
    left_ = 0;
    add_point(here);
    return false;
  }

  // Into the face on the other side of the edge, at share t of the halfedge.
  bool over_edge(Index out, double t) {
    const auto opposite = mesh_.opposite();
    const Index in = opposite[out];
    if (in == out) return stop(TraceEnd::Boundary);
    if (opposite[in] != out) return stop(TraceEnd::NonManifold);
    const std::array<Vec2, 3> here = flat_corners(mesh_, Mesh::face_of(out)),
                              there = flat_corners(mesh_, Mesh::face_of(in));
    const Vec2 out_edge = here[Mesh::next(out) % 3] - here[out % 3];
    const Vec2 in_edge = there[Mesh::next(in) % 3] - there[in % 3];
    const bool same_start = mesh_.from(in) == mesh_.from(out);
    // Components along the edge and away from the face that is left; `in` has its own face on its left.
    const double length = norm(out_edge);
    const double along = dot(at_.direction, out_edge) / length, away = -cross(out_edge, at_.direction) / length;
    const Vec2 e = (1 / norm(in_edge)) * in_edge;
    const Vec2 inward{-e.y, e.x};
    at_.direction = (same_start ? along : -along) * e + away * inward;
    at_.direction = (1 / norm(at_.direction)) * at_.direction;
    at_.face = Mesh::face_of(in);
    at_.weights = {0, 0, 0};
    at_.weights[in % 3] = same_start ? 1 - t : t;
    at_.weights[Mesh::next(in) % 3] = same_start ? t : 1 - t;
    at_.entered_over = in;
    at_.from_corner = kNoIndex;
    return true;
  }

  // The walk has come to the vertex that `corner` starts from: it goes on with the same angle on either side.
  bool over_vertex(Index corner, const std::array<Vec2, 3>& c, Vec2 p) {
    const Index vertex = mesh_.from(corner), k = corner % 3;
    SurfacePoint here{Mesh::face_of(corner), {0, 0, 0}};
    here.weights[k] = 1;
    add_point(here);
    if (!(left_ > 0)) return false;
    if (mesh_.links()[vertex] == Link::Arc) return stop(TraceEnd::Boundary);
    if (mesh_.links()[vertex] != Link::Circle) return stop(TraceEnd::NonManifold);
    const detail::TangentFan fan = detail::tangent_fan(mesh_, vertex);
    const Vec2 edge = c[(k + 1) % 3] - c[k], back = p - c[k];
    const double inside = std::clamp(std::atan2(cross(edge, back), dot(edge, back)), 0.0, mesh_.corner_angle(corner));
    return leave_vertex(vertex, fan.around(corner, inside) + 0.5 * fan.total);
  }

  const Mesh& mesh_;
  double left_;  // mesh.unit()
  Walker at_;
  Trace trace_;
};

}  // namespace

double total_angle(const Mesh& mesh, const SurfacePoint& point) {
  const PointLocation at = locate(mesh, point);
  return at.on == On::Vertex ? detail::tangent_fan(mesh, at.vertex).total : 2 * kPi;
}

namespace {

// The angle of a direction in face f's plane, from its edge along corner k.
double angle_in_face(const Mesh& mesh, Index f, Index k, const Vec3& direction, double* length = nullptr) {
  const Face& t = mesh.faces()[f];
  const double scale = 1 / mesh.unit();
  const Vec3 x = scale * (mesh.positions()[t[(k + 1) % 3]] - mesh.positions()[t[k]]);
  const Vec3 other = scale * (mesh.positions()[t[(k + 2) % 3]] - mesh.positions()[t[k]]);
  const Vec3 normal = cross(x, other);
  const Vec3 y = cross(normal, x);
  const double along = dot(direction, x) / norm(x), up = norm(y) > 0 ? dot(direction, y) / norm(y) : 0;
  if (length) *length = std::hypot(along, up);
  return std::atan2(up, along);
}

}  // namespace

double angle_of(const Mesh& mesh, const SurfacePoint& point, const Vec3& direction) {
  if (!mesh.has_positions()) throw Error(ErrorCode::InvalidArgument, "a mesh from lengths has no directions in space");
  // Divided by its largest component, so that no square is out of range.
  const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  if (!(largest > 0) || !std::isfinite(largest)) {
    throw Error(ErrorCode::InvalidArgument, "a direction must have a finite length > 0");
  }
  const Vec3 scaled{direction.x / largest, direction.y / largest, direction.z / largest};
  const PointLocation at = locate(mesh, point);
  // A shadow on the surface that is shorter than this share of the direction is made of rounding.
  constexpr double kShortest = 1e-12;
  const auto check_shadow = [&](double length) {
    if (length <= kShortest) {
      throw Error(ErrorCode::InvalidArgument, "the direction is at right angles to the surface there");
    }
  };
  if (at.on != On::Vertex) {
    double length = 0;
    const double angle = angle_in_face(mesh, at.face, 0, scaled, &length);
    check_shadow(length);
    return wrapped(angle, 2 * kPi);
  }
  const detail::TangentFan fan = detail::tangent_fan(mesh, at.vertex);
  double best = 0, best_score = -kInfinity, longest = 0;
  for (const detail::FanCorner& c : fan.corners) {
    double length = 0;
    const double angle = angle_in_face(mesh, Mesh::face_of(c.corner), c.corner % 3, scaled, &length);
    const double inside = std::clamp(angle, 0.0, c.angle);
    longest = std::max(longest, length);
    // How far the direction reaches along the nearest direction of this face.
    const double score = length * std::cos(angle - inside);
    if (score > best_score) {
      best_score = score;
      best = fan.around(c.corner, inside);
    }
  }
  check_shadow(longest);
  return best;
}

bool is_counter_clockwise(const Mesh& mesh, const SurfacePoint& point) {
  const PointLocation at = locate(mesh, point);
  if (at.on != On::Vertex) return true;
  return detail::tangent_fan(mesh, at.vertex).grows_counter_clockwise();
}

Trace straightest(const Mesh& mesh, const SurfacePoint& from, double angle, double length) {
  if (!std::isfinite(angle)) throw Error(ErrorCode::InvalidArgument, "the angle of a direction must be finite");
  if (!(length >= 0) || !std::isfinite(length)) {
    throw Error(ErrorCode::InvalidArgument, "length " + std::to_string(length) + " is not finite and >= 0");
  }
  return Tracer(mesh, length).run(locate(mesh, from), angle);
}

SurfacePoint detail::only_side(const Domain& domain, const SurfacePoint& point) {
  const std::vector<SurfacePoint> sides = domain.on_open(point);
  if (sides.size() == 1) return sides.front();
  throw Error(ErrorCode::InvalidArgument, sides.empty() ? "the point lies behind a wall"
                                                        : "the point lies on a wall that parts the surface there: its "
                                                          "directions have no common angles");
}

Trace straightest(const Domain& domain, const SurfacePoint& from, double angle, double length) {
  Trace trace = straightest(domain.open(), detail::only_side(domain, from), angle, length);
  domain.to_mesh(trace.path.points);
  return trace;
}

}  // namespace brushfire
