// Nearest points, shortest and shortened paths, straightest geodesics, logarithmic map.
#include "bind.h"
#include "interrupt.h"
#include "solver.h"

#include <brushfire/core/error.h>
#include <brushfire/mesh/nearest_point.h>
#include <brushfire/queries/log_coordinates.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/shorten.h>
#include <brushfire/queries/straightest.h>

#include <span>

namespace brushfire::python {
namespace {

nb::tuple nearest(const NearestPointFinder& finder, const Triples<double>& xyz) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  constexpr std::size_t kBrief = 1000;
  const std::vector<NearestPoint> found = listening(xyz.shape(0) < kBrief, [&] {
    return finder(std::span(reinterpret_cast<const Vec3*>(xyz.data()), xyz.shape(0)));
  });
  std::vector<SurfacePoint> points;
  std::vector<double> distances;
  for (const NearestPoint& n : found) {
    points.push_back(n.point);
    distances.push_back(n.distance);
  }
  const nb::tuple arrays = points_to_numpy(points);
  return nb::make_tuple(arrays[0], arrays[1], to_numpy(std::move(distances)));
}

using OptionalWeights = std::optional<Triples<double>>;

// No points and +inf where there is no path. `tighten`: pulled straight where it bends at waypoints.
nb::tuple path(Solver& solver, const Vector<std::int64_t>& index, const OptionalWeights& weights, bool closed,
               bool tighten, double max_distance) {
  const Mesh& mesh = solver.mesh();
  Computation computation{nb::none()};
  return path_to_numpy(computation.run(false, [&] {
    const std::vector<SurfacePoint> places = targets_from(mesh, {index, weights});
    DistanceOptions how;
    how.max_distance = max_distance;
    how.cancel = computation.cancel();
    SurfacePath found = solver.with([&](DistanceSolver& s) { return path_through(s, places, closed, how); });
    if (tighten && !found.points.empty()) found = shorten(solver.domain(), found.points, closed);
    return found;
  }));
}

nb::tuple shortened(const Domain& domain, const Vector<std::int64_t>& index, const OptionalWeights& weights,
                    bool closed) {
  const std::vector<SurfacePoint> points = points_from(domain.mesh(), {index, weights});
  return path_to_numpy(listening(false, [&] { return shorten(domain, points, closed); }));
}

double length(const Mesh& mesh, const Vector<std::int64_t>& index, const OptionalWeights& weights, bool closed) {
  return length_of(mesh, points_from(mesh, {index, weights}), closed);
}

// From the nearest source to every target, off one field: (source, paths).
nb::tuple paths(Solver& solver, const Sources& sources, const Vector<std::int64_t>& target_index,
                const OptionalWeights& target_weights, double max_distance) {
  const Mesh& mesh = solver.mesh();
  Computation computation{nb::none()};
  const std::vector<SourcePath> found = computation.run(false, [&] {
    DistanceOptions how;
    how.max_distance = max_distance;
    how.cancel = computation.cancel();
    const std::vector<SurfacePoint> targets = targets_from(mesh, {target_index, target_weights});
    return solver.with([&](DistanceSolver& s) { return paths_to(s, sources.list, targets, how); });
  });
  return paths_to_numpy(found, [](const SourcePath& path) { return path_to_numpy(path); });
}

// Along edges, from the nearest source's vertex.
nb::tuple edge_path(Solver& solver, const Sources& sources, std::int64_t target) {
  const Mesh& mesh = solver.mesh();
  if (target < 0 || target >= std::int64_t{mesh.vertex_count()}) {
    throw Error(ErrorCode::IndexOutOfRange, "vertex " + std::to_string(target) + " does not exist: the mesh has " +
                                                std::to_string(mesh.vertex_count()) + " vertices");
  }
  Computation computation{nb::none()};
  return path_to_numpy(computation.run(false, [&] {
    DistanceOptions options;
    options.cancel = computation.cancel();
    const SurfacePoint end = target_point(mesh, static_cast<Index>(target));
    return solver.with(
        [&](DistanceSolver& s) { return edge_paths_to(s, sources.list, std::span(&end, 1), options).front(); });
  }));
}

// (path, end); the direction is an angle, or a vector where it is given.
nb::tuple trace(const Domain& domain, const Vector<std::int64_t>& index, const OptionalWeights& weights, double angle,
                const std::optional<Vector<double>>& direction, double length) {
  const SurfacePoint from = single_point_from(domain.mesh(), {index, weights});
  if (direction) {
    if (direction->shape(0) != 3) throw Error(ErrorCode::InvalidArgument, "a direction has three components");
    const double* d = direction->data();
    // On a wall there is no one angle, which straightest() says.
    const std::vector<SurfacePoint> sides = domain.on_open(from);
    if (!sides.empty()) angle = angle_of(domain.open(), sides.front(), {d[0], d[1], d[2]});
  }
  Trace walked;
  {
    const nb::gil_scoped_release release;
    walked = straightest(domain, from, angle, length);
  }
  const char* end = walked.end == TraceEnd::Length     ? "length"
                    : walked.end == TraceEnd::Boundary ? "boundary"
                                                       : "non-manifold";
  return nb::make_tuple(path_to_numpy(walked.path), end);
}

// (angle, full turn) of a direction at a point.
nb::tuple angle_at(const Domain& domain, const Vector<std::int64_t>& index, const OptionalWeights& weights,
                   const Triples<double>& direction) {
  const Mesh& mesh = domain.open();
  SurfacePoint at = single_point_from(domain.mesh(), {index, weights});
  if (const std::vector<SurfacePoint> sides = domain.on_open(at); sides.size() == 1) {
    at = sides.front();
  } else {
    throw Error(ErrorCode::InvalidArgument, "the place lies on a wall, or behind one: it has no angles");
  }
  if (direction.shape(0) != 1) throw Error(ErrorCode::InvalidArgument, "a direction has three components");
  const double* d = direction.data();
  return nb::make_tuple(angle_of(mesh, at, {d[0], d[1], d[2]}), total_angle(mesh, at));
}

// Of the vertices that are reached: (vertex, radius, angle, total angle, uv). With a direction angles count from there.
nb::tuple logarithmic(Solver& solver, const Vector<std::int64_t>& index, const OptionalWeights& weights,
                      double max_radius, const std::optional<Triples<double>>& direction) {
  const SurfacePoint source = single_point_from(solver.mesh(), {index, weights});
  std::optional<Vec3> first;
  if (direction) {
    if (direction->shape(0) != 1) throw Error(ErrorCode::InvalidArgument, "a direction has three components");
    first = {direction->data()[0], direction->data()[1], direction->data()[2]};
  }
  Computation computation{nb::none()};
  std::vector<double> flat;
  SparseLogMap map = computation.run(false, [&] {
    SparseLogMap found =
        solver.with([&](DistanceSolver& s) { return log_map(s, source, max_radius, computation.cancel()); });
    // Directions are those in what is open; a source that has several sides was refused.
    const Mesh& open = solver.domain().open();
    const SurfacePoint side = solver.domain().on_open(source).front();
    SparseLogMap turned = found;
    turn(open, side, first, turned);
    for (const auto& [u, v] : flat_coordinates(open, side, turned)) flat.insert(flat.end(), {u, v});
    return first ? turned : found;
  });
  const std::size_t count = map.vertex.size();
  return nb::make_tuple(to_numpy_signed(std::move(map.vertex)), to_numpy(std::move(map.radius)),
                        to_numpy(std::move(map.angle)), map.total_angle, to_numpy(std::move(flat), {count, 2}));
}

}  // namespace

void bind_curves(nb::module_& m) {
  nb::class_<NearestPointFinder>(m, "NearestPointFinder")
      .def(nb::init<const Mesh&>(), nb::arg("mesh"), nb::call_guard<nb::gil_scoped_release>())
      .def("nearest", nearest, nb::arg("xyz").noconvert());
  m.def("path", path, nb::arg("solver"), nb::arg("index").noconvert(), nb::arg("weights").noconvert().none(),
        nb::arg("closed"), nb::arg("tighten"), nb::arg("max_distance"));
  m.def("shorten", shortened, nb::arg("domain"), nb::arg("index").noconvert(), nb::arg("weights").noconvert().none(),
        nb::arg("closed"));
  m.def("length_of", length, nb::arg("mesh"), nb::arg("index").noconvert(), nb::arg("weights").noconvert().none(),
        nb::arg("closed"));
  m.def("paths", paths, nb::arg("solver"), nb::arg("sources"), nb::arg("target_index").noconvert(),
        nb::arg("target_weights").noconvert().none(), nb::arg("max_distance"));
  m.def("edge_path", edge_path, nb::arg("solver"), nb::arg("sources"), nb::arg("target"));
  m.def("angle_of", angle_at, nb::arg("domain"), nb::arg("index").noconvert(), nb::arg("weights").noconvert().none(),
        nb::arg("direction").noconvert());
  m.def("trace", trace, nb::arg("domain"), nb::arg("index").noconvert(), nb::arg("weights").noconvert().none(),
        nb::arg("angle"), nb::arg("direction").noconvert().none(), nb::arg("length"));
  m.def("log_map", logarithmic, nb::arg("solver"), nb::arg("index").noconvert(), nb::arg("weights").noconvert().none(),
        nb::arg("max_radius"), nb::arg("direction").noconvert().none());
}

}  // namespace brushfire::python
