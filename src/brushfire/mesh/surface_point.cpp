// Validation, snapping and evaluation of surface points.
#include <brushfire/mesh/surface_point.h>

#include <brushfire/core/error.h>
#include <brushfire/core/planar.h>

#include <cmath>
#include <string>

namespace brushfire {
namespace {

void check(const Mesh& mesh, const SurfacePoint& p) {
  if (p.face >= mesh.face_count()) {
    throw Error(ErrorCode::IndexOutOfRange, "face " + std::to_string(p.face) + " does not exist: the mesh has " +
                                                std::to_string(mesh.face_count()) + " faces");
  }
  double sum = 0;
  for (const double w : p.weights) {
    if (!(w >= -kWeightError) || !std::isfinite(w)) {
      throw Error(ErrorCode::InvalidArgument,
                  "weight " + std::to_string(w) + " of a point in face " + std::to_string(p.face) + " is not >= 0");
    }
    sum += w;
  }
  if (!(std::abs(sum - 1) <= kWeightError)) {
    throw Error(ErrorCode::InvalidArgument, "the weights of a point in face " + std::to_string(p.face) + " sum to " +
                                                std::to_string(sum) + ", not to 1");
  }
}

}  // namespace

PointLocation locate(const Mesh& mesh, const SurfacePoint& point, double snap) {
  check(mesh, point);
  PointLocation at;
  at.face = point.face;
  double sum = 0;
  Index positive = 0, zero_corner = 0, last_positive = 0;
  for (Index k = 0; k < 3; ++k) {
    at.weights[k] = point.weights[k] <= snap ? 0.0 : point.weights[k];
    sum += at.weights[k];
    if (at.weights[k] > 0) {
      ++positive;
      last_positive = k;
    } else {
      zero_corner = k;
    }
  }
  for (double& w : at.weights) w /= sum;
  const Face& t = mesh.faces()[at.face];
  // A face that names a vertex twice has no inside: two corners are one vertex.
  if (positive == 2 && t[(zero_corner + 1) % 3] == t[(zero_corner + 2) % 3]) {
    positive = 1;
  }
  if (positive == 1) {
    at.on = PointLocation::On::Vertex;
    at.vertex = t[last_positive];
  } else if (positive == 2) {
    at.on = PointLocation::On::Edge;
    at.halfedge = 3 * at.face + (zero_corner + 1) % 3;
    at.t = at.weights[(zero_corner + 2) % 3];
  }
  return at;
}

SurfacePoint vertex_point(const Mesh& mesh, Index v) {
  if (v >= mesh.vertex_count()) {
    throw Error(ErrorCode::IndexOutOfRange, "vertex " + std::to_string(v) + " does not exist: the mesh has " +
                                                std::to_string(mesh.vertex_count()) + " vertices");
  }
  // A usable face where there is one: points of degenerate faces know less about their surroundings.
  const Index corner = mesh.first_corner(v);
  if (corner == kNoIndex) {
    throw Error(ErrorCode::InvalidArgument,
                "vertex " + std::to_string(v) + " is in no face: nothing can be reached from it");
  }
  SurfacePoint p{Mesh::face_of(corner), {0, 0, 0}};
  p.weights[corner % 3] = 1;
  return p;
}

Vec3 position(const Mesh& mesh, const SurfacePoint& point) {
  if (!mesh.has_positions()) throw Error(ErrorCode::InvalidArgument, "a mesh from lengths has no positions");
  const PointLocation at = locate(mesh, point);
  const Face& t = mesh.faces()[at.face];
  Vec3 p;
  for (std::size_t k = 0; k < 3; ++k) p = p + at.weights[k] * mesh.positions()[t[k]];
  return p;
}

std::array<double, 3> corner_distances(const Mesh& mesh, const PointLocation& point) {
  // Corner k in the origin, corner k+1 on the x axis: the point's coordinates are sums of positive multiples of the
  // other two weights, so a tiny weight keeps all its digits.
  std::array<double, 3> result;
  for (Index k = 0; k < 3; ++k) {
    const Index h = 3 * point.face + k;
    const double wa = point.weights[(k + 1) % 3], wb = point.weights[(k + 2) % 3];
    const double la = mesh.length(h), lb = mesh.length(Mesh::previous(h)), opposite = mesh.length(Mesh::next(h));
    if (la == 0 || lb == 0) {
      result[k] = la == 0 ? wb * lb : wa * la;
      continue;
    }
    const Vec2 b = apex_over_edge(la, lb, opposite, mesh.double_area(point.face));
    result[k] = std::hypot(wa * la + wb * b.x, wb * b.y);
  }
  return result;
}

}  // namespace brushfire
