// Nearest points joined by shortest paths; edges joined at vertices.
#include <brushfire/queries/surface_curves.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/nearest_point.h>
#include <brushfire/queries/path.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace brushfire {
namespace {

bool has_edge(const Mesh& mesh, Index a, Index b) {
  const auto corners = mesh.corners(a);
  return std::any_of(corners.begin(), corners.end(),
                     [&](Index h) { return mesh.to(h) == b || mesh.from(Mesh::previous(h)) == b; });
}

double mean_edge(const Mesh& mesh) {
  double sum = 0;
  for (const double l : mesh.lengths()) sum += l;
  return mesh.face_count() > 0 ? sum * mesh.unit() / static_cast<double>(mesh.halfedge_count()) : 0;
}

// The polyline with points so often that no piece is longer than `step`; of a closed one the first again at the end.
std::vector<Vec3> densely(std::span<const Vec3> positions, bool closed, double step) {
  constexpr double kMost = 1e6;  // per piece: far beyond what a mesh can tell apart
  std::vector<Vec3> points{positions[0]};
  for (std::size_t i = 1; i < positions.size() + (closed ? 1 : 0); ++i) {
    const Vec3 from = points.back(), to = positions[i % positions.size()];
    const double pieces = step > 0 ? std::clamp(std::ceil(norm(to - from) / step), 1.0, kMost) : 1;
    for (double k = 1; k < pieces; ++k) points.push_back(from + (k / pieces) * (to - from));
    points.push_back(to);
  }
  return points;
}

}  // namespace

SurfacePath curve_along(const Mesh& mesh, std::span<const Index> vertices, bool closed) {
  if (vertices.empty()) throw Error(ErrorCode::InvalidArgument, "no vertices: a curve needs at least one");
  SurfacePath path;
  path.closed = closed;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    path.points.push_back(vertex_point(mesh, vertices[i]));
    if (i == 0 || has_edge(mesh, vertices[i - 1], vertices[i])) continue;
    throw Error(ErrorCode::InvalidArgument, "no edge joins vertices " + std::to_string(vertices[i - 1]) + " and " +
                                                std::to_string(vertices[i]) + ", " + std::to_string(i - 1) + " and " +
                                                std::to_string(i) + " of the chain");
  }
  if (closed && vertices.size() > 1 && !has_edge(mesh, vertices.back(), vertices.front())) {
    throw Error(ErrorCode::InvalidArgument, "no edge joins the last vertex of the chain, " +
                                                std::to_string(vertices.back()) + ", and the first, " +
                                                std::to_string(vertices.front()));
  }
  path.length = length_of(mesh, path.points, closed);
  return path;
}

ProjectedCurve project_curve(const Domain& domain, std::span<const Vec3> positions, bool closed,
                             const CancelToken* cancel) {
  if (positions.empty()) throw Error(ErrorCode::InvalidArgument, "no points: a curve needs at least one");
  const CancelScope listen(cancel);
  const NearestPointFinder finder(domain.mesh());
  const std::vector<Vec3> points = densely(positions, closed, mean_edge(domain.mesh()));
  const std::vector<NearestPoint> nearest = finder(points);
  ProjectedCurve curve;
  std::vector<SurfacePoint> waypoints;
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    if (nearest[i].distance > curve.largest_gap || i == 0) {
      curve.largest_gap = nearest[i].distance;
      curve.gap_position = points[i];
    }
    waypoints.push_back(nearest[i].point);
  }
  if (closed && waypoints.size() > 1) waypoints.pop_back();  // the first again
  DistanceSolver solver(domain);
  curve.path = path_through(solver, waypoints, closed, cancel);
  if (curve.path.points.empty()) {
    throw Error(ErrorCode::InvalidArgument, "the curve cannot be put onto the surface: no way leads along it");
  }
  return curve;
}

}  // namespace brushfire
