// Validation, snapping and evaluation of surface points.
#include <brushfire/mesh/surface_point.h>

#include <brushfire/core/detail/planar.h>
#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>

#include <algorithm>
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
                  "weight " + number_as_text(w) + " of a point in face " + std::to_string(p.face) + " is not >= 0");
    }
    sum += w;
  }
  if (!(std::abs(sum - 1) <= kWeightError)) {
    throw Error(ErrorCode::InvalidArgument, "the weights of a point in face " + std::to_string(p.face) + " sum to " +
                                                number_as_text(sum) + ", not to 1");
  }
}

// The lowest halfedge from v to w or back, of a face with three distinct vertices where there is one.
Index halfedge_between(const Mesh& mesh, Index v, Index w) {
  Index found = kNoIndex;
  for (const Index corner : mesh.corners(v)) {
    const bool usable = mesh.is_face_usable(Mesh::face_of(corner));
    if (found != kNoIndex && !usable) continue;
    for (const Index h : {corner, Mesh::previous(corner)}) {
      if (std::minmax(mesh.from(h), mesh.to(h)) != std::minmax(v, w)) continue;
      if (usable) return h;
      found = std::min(found, h);
    }
  }
  return found;
}

// A face that names a vertex twice has no inside, and its edges are in no ring: its points are points of an edge, named
// in the face that every name of that edge leads to, or of a vertex.
void leave_degenerate_face(const Mesh& mesh, PointLocation& at) {
  const Face& t = mesh.faces()[at.face];
  const Index heaviest =
      static_cast<Index>(std::max_element(at.weights.begin(), at.weights.end()) - at.weights.begin());
  const Index v = t[heaviest];
  Index w = v;
  double share = 0;  // of the way from v to w
  for (std::size_t k = 0; k < 3; ++k) {
    if (t[k] == v || at.weights[k] == 0) continue;
    w = t[k];
    share += at.weights[k];
  }
  if (w == v) {
    at.on = PointLocation::On::Vertex;
    at.vertex = v;
    return;
  }
  at.on = PointLocation::On::Edge;
  at.halfedge = halfedge_between(mesh, v, w);
  at.face = Mesh::face_of(at.halfedge);
  const bool ahead = mesh.from(at.halfedge) == v;
  at.weights = {0, 0, 0};
  at.weights[at.halfedge % 3] = ahead ? 1 - share : share;
  at.weights[Mesh::next(at.halfedge) % 3] = ahead ? share : 1 - share;
  at.t = ahead ? share : 1 - share;
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
  if (positive > 1 && !mesh.is_face_usable(at.face)) {
    leave_degenerate_face(mesh, at);
  } else if (positive == 1) {
    at.on = PointLocation::On::Vertex;
    at.vertex = mesh.faces()[at.face][last_positive];
  } else if (positive == 2) {
    at.on = PointLocation::On::Edge;
    at.halfedge = 3 * at.face + (zero_corner + 1) % 3;
    at.t = at.weights[(zero_corner + 2) % 3];
  }
  return at;
}

SurfacePoint target_point(const Mesh& mesh, Index v) {
  if (v >= mesh.vertex_count()) {
    throw Error(ErrorCode::IndexOutOfRange, "vertex " + std::to_string(v) + " does not exist: the mesh has " +
                                                std::to_string(mesh.vertex_count()) + " vertices");
  }
  // A usable face where there is one: points of degenerate faces know less about their surroundings.
  const Index corner = mesh.first_corner(v);
  if (corner == kNoIndex) return {};
  SurfacePoint p{Mesh::face_of(corner), {0, 0, 0}};
  p.weights[corner % 3] = 1;
  return p;
}

SurfacePoint vertex_point(const Mesh& mesh, Index v) {
  const SurfacePoint p = target_point(mesh, v);
  if (p.is_nowhere()) {
    throw Error(ErrorCode::InvalidArgument,
                "vertex " + std::to_string(v) + " is in no face: nothing can be reached from it");
  }
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

namespace {

// Corner k in the origin, corner k+1 on the x axis: the point's coordinates are sums of positive multiples of the other
// two weights, so a tiny weight keeps all its digits.
double corner_distance_by_lengths(const Mesh& mesh, const PointLocation& point, Index k) {
  const Index h = 3 * point.face + k;
  const double wa = point.weights[(k + 1) % 3], wb = point.weights[(k + 2) % 3];
  const double la = mesh.length(h), lb = mesh.length(Mesh::previous(h)), opposite = mesh.length(Mesh::next(h));
  if (la == 0 || lb == 0) return la == 0 ? wb * lb : wa * la;
  const Vec2 b = apex_over_edge(la, lb, opposite, mesh.double_area(point.face));
  return std::hypot(wa * la + wb * b.x, wb * b.y);
}

}  // namespace

std::array<double, 3> corner_distances(const Mesh& mesh, const PointLocation& point) {
  std::array<double, 3> result;
  for (Index k = 0; k < 3; ++k) {
    // Three rounded lengths do not tell the angles of a face whose edges are very unlike; its coordinates do.
    std::array<double, 3> corner{0, 0, 0};
    corner[k] = 1;
    result[k] = mesh.has_positions() ? distance_within(mesh, point.face, point.weights, corner)
                                     : corner_distance_by_lengths(mesh, point, k);
  }
  return result;
}

}  // namespace brushfire
