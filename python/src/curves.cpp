// Nearest points, shortest paths, straightest geodesics, logarithmic map.
#include "bind.h"
#include "interrupt.h"

#include <brushfire/core/error.h>
#include <brushfire/mesh/nearest_point.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/straightest.h>

#include <span>

namespace brushfire::python {
namespace {

// (face, weights): int32 [points], float64 [points, 3].
nb::tuple points_to_numpy(std::span<const SurfacePoint> points) {
  std::vector<Index> faces;
  std::vector<double> weights;
  for (const SurfacePoint& p : points) {
    faces.push_back(p.face);
    weights.insert(weights.end(), p.weights.begin(), p.weights.end());
  }
  return nb::make_tuple(to_numpy_signed(std::move(faces)), to_numpy(std::move(weights), {points.size(), 3}));
}

nb::tuple nearest(const NearestPointFinder& finder, const Triples<double>& xyz) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  std::vector<NearestPoint> found;
  {
    const nb::gil_scoped_release release;
    found = finder(std::span(reinterpret_cast<const Vec3*>(xyz.data()), xyz.shape(0)));
  }
  std::vector<SurfacePoint> points;
  std::vector<double> distances;
  for (const NearestPoint& n : found) {
    points.push_back(n.point);
    distances.push_back(n.distance);
  }
  const nb::tuple arrays = points_to_numpy(points);
  return nb::make_tuple(arrays[0], arrays[1], to_numpy(std::move(distances)));
}

SurfacePoint single(const Mesh& mesh, const PlaceArrays& place) {
  const std::vector<SurfacePoint> points = points_from(mesh, place);
  if (points.size() != 1) throw Error(ErrorCode::InvalidArgument, "a single point is needed");
  return points.front();
}

// (face, weights, length); no points and +inf where there is no path.
nb::tuple path(const Mesh& mesh, const Vector<std::int64_t>& index, const std::optional<Triples<double>>& weights,
               bool closed) {
  Computation computation{nb::none()};
  const SurfacePath found = computation.run(false, [&] {
    return PathFinder(mesh).through(points_from(mesh, {index, weights}), closed, computation.cancel());
  });
  const nb::tuple arrays = points_to_numpy(found.points);
  return nb::make_tuple(arrays[0], arrays[1], found.length);
}

// (face, weights, length, end); the direction is an angle, or a vector where it is given.
nb::tuple trace(const Mesh& mesh, const Vector<std::int64_t>& index, const std::optional<Triples<double>>& weights,
                double angle, const std::optional<Vector<double>>& direction, double length) {
  const SurfacePoint from = single(mesh, {index, weights});
  if (direction) {
    if (direction->shape(0) != 3) throw Error(ErrorCode::InvalidArgument, "a direction has three components");
    const double* d = direction->data();
    angle = angle_of(mesh, from, {d[0], d[1], d[2]});
  }
  Trace walked;
  {
    const nb::gil_scoped_release release;
    walked = straightest(mesh, from, angle, length);
  }
  const nb::tuple arrays = points_to_numpy(walked.path.points);
  const char* end = walked.end == TraceEnd::Length     ? "length"
                    : walked.end == TraceEnd::Boundary ? "boundary"
                                                       : "non-manifold";
  return nb::make_tuple(arrays[0], arrays[1], walked.path.length, end);
}

// (radius, angle, total angle).
nb::tuple logarithmic(const Mesh& mesh, const Vector<std::int64_t>& index,
                      const std::optional<Triples<double>>& weights, double max_radius) {
  const SurfacePoint source = single(mesh, {index, weights});
  Computation computation{nb::none()};
  LogMap map = computation.run(false, [&] { return log_map(mesh, source, max_radius, computation.cancel()); });
  return nb::make_tuple(to_numpy(std::move(map.radius)), to_numpy(std::move(map.angle)), map.total_angle);
}

}  // namespace

void bind_curves(nb::module_& m) {
  nb::class_<NearestPointFinder>(m, "NearestPointFinder")
      .def(nb::init<const Mesh&>(), nb::arg("mesh"), nb::call_guard<nb::gil_scoped_release>())
      .def("nearest", nearest, nb::arg("xyz").noconvert());
  m.def("path", path, nb::arg("mesh"), nb::arg("index").noconvert(), nb::arg("weights").noconvert().none(),
        nb::arg("closed"));
  m.def("trace", trace, nb::arg("mesh"), nb::arg("index").noconvert(), nb::arg("weights").noconvert().none(),
        nb::arg("angle"), nb::arg("direction").noconvert().none(), nb::arg("length"));
  m.def("log_map", logarithmic, nb::arg("mesh"), nb::arg("index").noconvert(), nb::arg("weights").noconvert().none(),
        nb::arg("max_radius"));
}

}  // namespace brushfire::python
