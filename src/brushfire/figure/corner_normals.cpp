// Area-weighted normals over the faces that meet flatly enough.
#include <brushfire/figure/detail/corner_normals.h>

#include <algorithm>
#include <cmath>

namespace brushfire::detail {
namespace {

// Faces that meet more flatly than by 30 degrees share a normal, at more than 60 they do not: an edge of a machine part
// stays an edge. In between they share in part; a sharp limit would draw a saw along the folds of a scan.
constexpr double kSmoothCosine = 0.86602540378443865, kCreaseCosine = 0.5;

double share_of_normal(double cosine) {
  return std::clamp((cosine - kCreaseCosine) / (kSmoothCosine - kCreaseCosine), 0.0, 1.0);
}

// Whether faces that share an edge lie the same way round: then two that face away from each other are a sharp edge.
bool oriented(const Mesh& mesh) {
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const Index other = mesh.opposite()[h];
    if (other != h && mesh.from(h) == mesh.from(other)) return false;
  }
  return true;
}

std::vector<Vec3> unit_face_normals(const Mesh& mesh) {
  std::vector<Vec3> normals(mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Face& t = mesh.faces()[f];
    const Vec3 a = mesh.positions()[t[0]];
    const double scale = 1 / mesh.unit();
    const Vec3 n = cross(scale * (mesh.positions()[t[1]] - a), scale * (mesh.positions()[t[2]] - a));
    const double length = norm(n);
    normals[f] = length > 0 ? (1 / length) * n : Vec3{};
  }
  return normals;
}

}  // namespace

// The mean over the faces at the vertex that are no crease apart.
std::vector<std::array<float, 3>> corner_normals(const Mesh& mesh) {
  const std::vector<Vec3> face = unit_face_normals(mesh);
  const bool flip = !oriented(mesh);
  std::vector<std::array<float, 3>> normals(mesh.halfedge_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const std::span<const Index> corners = mesh.corners(v);
    constexpr std::size_t kManyFaces = 64;  // the pairwise test is quadratic in the valence
    for (const Index h : corners) {
      const Vec3 own = face[Mesh::face_of(h)];
      Vec3 sum = own;
      if (corners.size() <= kManyFaces) {
        sum = {};
        for (const Index g : corners) {
          const Vec3 other = face[Mesh::face_of(g)];
          const double cosine = dot(own, other);
          const double weight =
              share_of_normal(flip ? std::abs(cosine) : cosine) * mesh.double_areas()[Mesh::face_of(g)];
          sum = sum + (cosine < 0 ? -weight : weight) * other;
        }
      }
      const double length = norm(sum);
      const Vec3 n = length > 0 ? (1 / length) * sum : Vec3{};
      normals[h] = {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
    }
  }
  return normals;
}

}  // namespace brushfire::detail
