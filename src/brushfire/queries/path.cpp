// Paths read off fields, and between pairs of points.
#include <brushfire/queries/path.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/queries/detail/lengths_only.h>
#include <brushfire/queries/detail/way_around.h>
#include <brushfire/queries/shorten.h>
#include <brushfire/solvers/detail/walls.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace brushfire {
namespace {

using On = PointLocation::On;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// Whether two points are one: a point of an edge or a vertex may be named in several faces. No distance is too small.
bool same_point(const Mesh& mesh, const SurfacePoint& a, const SurfacePoint& b) {
  if (a.face == b.face && a.weights == b.weights) return true;
  const PointLocation at = locate(mesh, a, 0), other = locate(mesh, b, 0);
  if (at.on != other.on || at.on == On::Interior) return false;
  if (at.on == On::Vertex) return at.vertex == other.vertex;
  const auto weights = weights_in(mesh, at, other.face);
  return weights && *weights == other.weights;
}

// Appends b's points to a, the common one once.
void join(const Mesh& mesh, SurfacePath& a, const SurfacePath& b) {
  for (const SurfacePoint& p : b.points) {
    if (a.points.empty() || !same_point(mesh, a.points.back(), p)) a.points.push_back(p);
  }
  a.length += b.length;
}

// Rays lead back to where they came from: this is a fault of ours, not of the caller's.
Error lost(double length) {
  return Error(ErrorCode::Internal, "the path was lost after a length of " + number_as_text(length) +
                                        ": please report the mesh and the points");
}

// Whether a path could be shorter on one side of a vertex that it goes through.
bool is_bent_around(const Mesh& mesh, const SurfacePoint& before, const PointLocation& at, const SurfacePoint& after) {
  const auto direction = [&](const SurfacePoint& p) {
    const PointLocation there = locate(mesh, p, 0);
    const Index f = common_face(mesh, at, there, p.face);
    return detail::direction_towards(mesh, at.vertex, f, *weights_in(mesh, there, f));
  };
  return detail::shortest_way_around(mesh, at.vertex, direction(before), direction(after)).angle <
         kPi - detail::kStraightAngle;
}

// A turn that nobody takes for straight.
constexpr double kSeenTurn = 1e-7;

// Whether a path turns where it crosses an edge, by more than the weights of its points are rounded.
bool is_bent_across(const Mesh& mesh, const SurfacePoint& before, const PointLocation& at, const SurfacePoint& after) {
  const Index end = std::max(mesh.from(at.halfedge), mesh.to(at.halfedge));
  double angles = 0, room = kSeenTurn;
  for (const SurfacePoint& p : {before, after}) {
    const PointLocation there = locate(mesh, p, 0);
    const Index f = common_face(mesh, at, there, p.face);
    const std::array<Vec2, 3> corners = flat_corners(mesh, f);
    const std::array<double, 3> here = *weights_in(mesh, at, f);
    std::array<double, 3> ahead{};
    for (std::size_t k = 0; k < 3; ++k) ahead[k] = mesh.faces()[f][k] == end ? 1 : 0;
    const Vec2 edge = flat_difference(corners, here, ahead);
    const Vec2 leg = flat_difference(corners, here, *weights_in(mesh, there, f));
    angles += std::atan2(std::abs(cross(edge, leg)), dot(edge, leg));
    const std::span<const double> lengths = mesh.lengths().subspan(3 * static_cast<std::size_t>(f), 3);
    room += 8 * kEpsilon * *std::max_element(lengths.begin(), lengths.end()) / norm(leg);
  }
  return std::abs(angles - kPi) > room;
}

// How many of the weights of a point on the path are zero: 2 at a vertex, 1 on an edge.
auto zeros(const SurfacePoint& p) { return std::count(p.weights.begin(), p.weights.end(), 0.0); }

// The edge that a point with one weight of zero lies on.
Index halfedge_of(const SurfacePoint& p) {
  const auto opposite = std::find(p.weights.begin(), p.weights.end(), 0.0) - p.weights.begin();
  return Mesh::next(3 * p.face + static_cast<Index>(opposite));
}

// Rounding turns the plane of a face by epsilons of the path's length over that of an edge that it is unfolded over,
// and moves what is a path's length away by that much more. A leg that is short beside this may turn by kSeenTurn.
double short_leg(const Mesh& mesh, const SurfacePath& path) {
  double edge = path.length;
  for (const SurfacePoint& p : path.points) {
    if (zeros(p) == 1) edge = std::min(edge, mesh.lengths()[halfedge_of(p)] * mesh.unit());
  }
  return 4 * kEpsilon / kSeenTurn * path.length * (path.length / edge);
}

// Whether the path has a corner that it would not have if it were shorter.
bool has_corner(const Mesh& mesh, const SurfacePath& path, std::span<const double> legs) {
  const double short_at_edge = short_leg(mesh, path);
  for (std::size_t i = 1; i + 1 < path.points.size(); ++i) {
    const SurfacePoint &before = path.points[i - 1], &after = path.points[i + 1];
    const auto count = zeros(path.points[i]);
    const double leg = std::min(legs[i - 1], legs[i]);
    if (count == 0 || (count == 1 && !(leg > 0 && leg < short_at_edge))) continue;
    const PointLocation at = locate(mesh, path.points[i], 0);
    if (at.on == On::Vertex && is_bent_around(mesh, before, at, after)) return true;
    if (at.on == On::Edge && is_bent_across(mesh, before, at, after)) return true;
  }
  return false;
}

// Each leg is straight, and what two of them could save where they meet is less than the field's value tells: nothing
// at the scale of the path, but next to a vertex or in faces that are tiny beside it, a visible corner.
SurfacePath straightened(const Mesh& mesh, SurfacePath path) {
  const std::vector<double> legs = leg_lengths(mesh, path.points);
  path.length = std::accumulate(legs.begin(), legs.end(), 0.0);
  if (!has_corner(mesh, path, legs)) return path;
  SurfacePath shorter = shorten(mesh, path.points);
  shorter.length = length_of(mesh, shorter.points);
  // Shorter in wider numbers; here both are sums of rounded pieces.
  constexpr double kRounding = 1e-13;
  return shorter.length <= path.length * (1 + kRounding) ? shorter : path;
}

bool is_edge_tight(const DistanceField& field, Index from, Index to, double length) {
  return field.source[from] == field.source[to] && field.distance[from] + length == field.distance[to];
}

}  // namespace

SurfacePath path_to(const WindowField& field, const SurfacePoint& target) {
  const Mesh& mesh = field.mesh();
  SurfacePath path;
  if (target.is_nowhere()) return path;
  WindowField::Leg leg = field.last_leg(target);
  if (leg.points.empty()) {
    if (field.value(target).distance < kInfinity) throw lost(0);
    return path;
  }
  path.length = 0;
  path.points.push_back(leg.points.front());
  Index legs = 0;
  Poll poll(64);
  while (true) {
    poll();
    path.length += leg.length;
    for (std::size_t i = 1; i < leg.points.size(); ++i) {
      // A leg names a point on an edge once for either face, where it starts or ends there.
      if (!same_point(mesh, path.points.back(), leg.points[i])) path.points.push_back(leg.points[i]);
    }
    if (leg.vertex == kNoIndex) break;
    leg = field.last_leg(leg.vertex);
    if (leg.points.empty() || ++legs > mesh.vertex_count()) throw lost(path.length);
  }
  std::reverse(path.points.begin(), path.points.end());
  return straightened(mesh, std::move(path));
}

SurfacePath edge_path_to(const Mesh& mesh, const DistanceField& field, Index target) {
  if (field.method != Method::Dijkstra || field.distance.size() != mesh.vertex_count()) {
    throw Error(ErrorCode::InvalidArgument, "an edge path needs a dijkstra field of the same mesh, not one of " +
                                                std::string(name_of(field.method)));
  }
  SurfacePath path;
  if (target_point(mesh, target).is_nowhere() || field.distance[target] == kInfinity) return path;
  const std::span<const double> lengths = mesh.lengths();
  path.points.push_back(vertex_point(mesh, target));
  path.length = 0;
  // The field holds sums of lengths, so the edge over which a value came is found by adding up again; values fall
  // along it, or stay on edges without length, which a walk must not follow in a circle.
  std::vector<Index> visited_at_value{target};
  for (Index here = target;;) {
    Index before = kNoIndex;
    double step = 0;
    for (const Index corner : mesh.corners(here)) {
      for (const Index h : {corner, Mesh::previous(corner)}) {
        const Index other = mesh.from(h) == here ? mesh.to(h) : mesh.from(h);
        const double length = lengths[h] * mesh.unit();
        const bool seen = std::find(visited_at_value.begin(), visited_at_value.end(), other) != visited_at_value.end();
        if (before == kNoIndex && !seen && is_edge_tight(field, other, here, length)) {
          before = other;
          step = length;
        }
      }
    }
    if (before == kNoIndex) break;
    if (step > 0) visited_at_value.clear();
    visited_at_value.push_back(before);
    path.points.push_back(vertex_point(mesh, before));
    path.length += step;
    here = before;
  }
  std::reverse(path.points.begin(), path.points.end());
  return path;
}

namespace {

// To the nearest side of a target on a wall; the path has the numbers of the whole mesh.
SurfacePath path_in(const Domain& domain, const WindowField& field, const SurfacePoint& target) {
  const std::vector<SurfacePoint> sides = domain.on_open(target);
  if (sides.empty()) return {};
  const auto nearest = std::min_element(sides.begin(), sides.end(), [&](const SurfacePoint& a, const SurfacePoint& b) {
    return field.value(a).distance < field.value(b).distance;
  });
  SurfacePath path = path_to(field, *nearest);
  domain.to_mesh(path.points);
  return path;
}

}  // namespace

std::vector<SourcePath> paths_to(DistanceSolver& solver, std::span<const Source> sources,
                                 std::span<const SurfacePoint> targets, const DistanceOptions& how) {
  detail::check_lengths_only(how, "these paths");
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_paths = true;
  options.targets.assign(targets.begin(), targets.end());
  options.max_distance = how.max_distance;
  options.threads = how.threads;
  options.cancel = how.cancel;
  const SparseField field = solver.distance_sparse(sources, options);
  std::vector<SourcePath> paths;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    SourcePath& path = paths.emplace_back();
    if (field.target_distance[i] == kInfinity) continue;
    static_cast<SurfacePath&>(path) = path_in(solver.domain(), *field.windows, targets[i]);
    path.source = field.target_source[i];
  }
  return paths;
}

std::vector<SourcePath> edge_paths_to(const Domain& domain, std::span<const Source> sources,
                                      std::span<const SurfacePoint> targets, const DistanceOptions& how) {
  DistanceSolver solver(domain);
  return edge_paths_to(solver, sources, targets, how);
}

std::vector<SourcePath> edge_paths_to(DistanceSolver& solver, std::span<const Source> sources,
                                      std::span<const SurfacePoint> targets, const DistanceOptions& how) {
  const Domain& domain = solver.domain();
  detail::check_lengths_only(how, "paths along edges");
  const Mesh& open = domain.open();
  const auto check_vertex = [&](const SurfacePoint& p) {
    if (p.is_nowhere() || locate(domain.mesh(), p).on == On::Vertex) return;
    throw Error(ErrorCode::InvalidArgument, "paths along edges run between vertices");
  };
  for (const Source& s : sources) {
    if (s.curve) throw Error(ErrorCode::InvalidArgument, "paths along edges begin at vertices, not on curves");
    check_vertex(s.point);
  }
  for (const SurfacePoint& t : targets) check_vertex(t);
  DistanceOptions options = how;
  options.method = Method::Dijkstra;
  options.targets.assign(targets.begin(), targets.end());
  const detail::WalledRun walled(domain, sources, options);
  const DistanceField field = domain.has_walls() ? distance(open, walled.sources(), walled.options())
                                                 : solver.distance(walled.sources(), walled.options());
  std::vector<SourcePath> paths;
  for (const SurfacePoint& t : targets) {
    SourcePath& path = paths.emplace_back();
    Index nearest = kNoIndex;
    for (const SurfacePoint& side : domain.on_open(t)) {
      const Index v = locate(open, side).vertex;
      if (nearest == kNoIndex || field.distance[v] < field.distance[nearest]) nearest = v;
    }
    if (nearest == kNoIndex || field.distance[nearest] == kInfinity) continue;
    static_cast<SurfacePath&>(path) = edge_path_to(open, field, nearest);
    domain.to_mesh(path.points);
    path.source = walled.origin(field.source[nearest]);
  }
  return paths;
}

SurfacePath path_between(DistanceSolver& solver, const SurfacePoint& from, const SurfacePoint& to,
                         const DistanceOptions& how) {
  if (to.is_nowhere() || solver.domain().on_open(from).empty()) return {};
  const Source source{from};
  return paths_to(solver, std::span(&source, 1), std::span(&to, 1), how).front();
}

SurfacePath path_between(DistanceSolver& solver, const SurfacePoint& from, const SurfacePoint& to,
                         const CancelToken* cancel) {
  DistanceOptions how;
  how.cancel = cancel;
  return path_between(solver, from, to, how);
}

SurfacePath path_through(DistanceSolver& solver, std::span<const SurfacePoint> waypoints, bool closed,
                         const DistanceOptions& how) {
  if (waypoints.empty()) throw Error(ErrorCode::InvalidArgument, "a path needs at least one waypoint");
  const Mesh& mesh = solver.mesh();
  for (const SurfacePoint& p : waypoints) {
    if (p.is_nowhere()) return {{}, kInfinity, closed};
    locate(mesh, p);  // also where there is nothing to trace
  }
  SurfacePath path;
  path.closed = closed;
  path.length = 0;
  path.points.push_back(waypoints.front());
  DistanceOptions rest = how;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < waypoints.size(); ++i) {
    const SurfacePath piece = path_between(solver, waypoints[i], waypoints[(i + 1) % waypoints.size()], rest);
    if (piece.points.empty()) return {{}, kInfinity, closed};
    join(mesh, path, piece);
    if (path.length > how.max_distance) return {{}, kInfinity, closed};
    rest.max_distance = how.max_distance - path.length;
  }
  if (closed && path.points.size() > 1) path.points.pop_back();  // the first point again
  return path;
}

SurfacePath path_through(DistanceSolver& solver, std::span<const SurfacePoint> waypoints, bool closed,
                         const CancelToken* cancel) {
  DistanceOptions how;
  how.cancel = cancel;
  return path_through(solver, waypoints, closed, how);
}

PathFinder::PathFinder(Domain domain) : solver_(std::make_unique<DistanceSolver>(std::move(domain))) {}
PathFinder::~PathFinder() = default;
PathFinder::PathFinder(PathFinder&&) noexcept = default;
PathFinder& PathFinder::operator=(PathFinder&&) noexcept = default;

SurfacePath PathFinder::between(const SurfacePoint& from, const SurfacePoint& to, const CancelToken* cancel) {
  return path_between(*solver_, from, to, cancel);
}

SurfacePath PathFinder::through(std::span<const SurfacePoint> waypoints, bool closed, const CancelToken* cancel) {
  return path_through(*solver_, waypoints, closed, cancel);
}

}  // namespace brushfire
