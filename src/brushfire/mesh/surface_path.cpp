// The length of a polyline on a mesh.
#include <brushfire/mesh/surface_path.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace brushfire {

namespace {

// The distance of two points in a face of theirs, mostly the one that names one of them; NaN: they share none. No
// weight of a path's point is too small to count, but points that were placed by hand may share a face only where it
// does not.
double distance_between(const Mesh& mesh, const PointLocation& a, const PointLocation& b) {
  if (const auto w = weights_in(mesh, b, a.face)) return distance_within(mesh, a.face, a.weights, *w);
  if (const auto w = weights_in(mesh, a, b.face)) return distance_within(mesh, b.face, *w, b.weights);
  const PointLocation p = locate(mesh, {a.face, a.weights}), q = locate(mesh, {b.face, b.weights});
  for (const auto& [from, to] : {std::pair(a, b), std::pair(p, q)}) {
    const Index f = common_face(mesh, from, to);
    if (f != kNoIndex) return distance_within(mesh, f, from, to);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// Calls leg(length) for each straight piece, in mesh.unit().
template <class Leg>
void measure(const Mesh& mesh, std::span<const SurfacePoint> points, bool closed, Leg&& leg) {
  if (points.empty()) return;
  const PointLocation first = locate(mesh, points.front(), 0);
  PointLocation before = first;
  for (std::size_t i = 1; i < points.size() + (closed ? 1 : 0); ++i) {
    const PointLocation here = i < points.size() ? locate(mesh, points[i], 0) : first;
    const double step = distance_between(mesh, before, here);
    if (std::isnan(step)) {
      throw Error(ErrorCode::InvalidArgument, "points " + std::to_string(i - 1) + " and " +
                                                  std::to_string(i % points.size()) + " of a path share no face");
    }
    leg(step);
    before = here;
  }
}

}  // namespace

double length_of(const Mesh& mesh, std::span<const SurfacePoint> points, bool closed) {
  double length = 0;
  measure(mesh, points, closed, [&](double leg) { length += leg; });
  return length * mesh.unit();
}

std::vector<double> leg_lengths(const Mesh& mesh, std::span<const SurfacePoint> points, bool closed) {
  std::vector<double> lengths;
  lengths.reserve(points.size());
  measure(mesh, points, closed, [&](double leg) { lengths.push_back(leg * mesh.unit()); });
  return lengths;
}

}  // namespace brushfire
