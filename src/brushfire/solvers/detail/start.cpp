// Straight lines inside one face and across one edge.
#include <brushfire/solvers/detail/start.h>

#include <brushfire/core/planar.h>

#include <algorithm>
#include <cmath>

namespace brushfire::detail {
namespace {

// Adds what the point sees across edge h of its own face.
void add_seeds_across(const Mesh& mesh, const PointLocation& at, Index h, std::vector<Seed>& seeds) {
  const double length = mesh.lengths()[h];
  if (length == 0) return;
  const Vec2 own = apex_over(mesh, h, h);
  const double ahead = at.weights[Mesh::next(h) % 3], third = at.weights[Mesh::previous(h) % 3];
  const Vec2 below{ahead * length + third * own.x, third * own.y};  // the point lies at (x,-y)
  for (Index g = mesh.opposite()[h]; g != h; g = mesh.opposite()[g]) {
    const Vec2 apex = apex_over(mesh, h, g);
    const double height = apex.y + below.y;
    const double crossing = below.x * apex.y + apex.x * below.y;
    if (!(height > 0) || crossing < 0 || crossing > length * height) continue;
    seeds.push_back({mesh.from(Mesh::previous(g)), std::hypot(apex.x - below.x, height)});
  }
}

// The point's weights at the corners of face f; false where the point is not in that face.
bool weights_in(const Mesh& mesh, const PointLocation& at, Index f, std::array<double, 3>& weights) {
  if (f == at.face) {
    weights = at.weights;
    return true;
  }
  weights = {0, 0, 0};
  const Face& own = mesh.faces()[at.face];
  const Face& other = mesh.faces()[f];
  for (Index k = 0; k < 3; ++k) {
    if (at.weights[k] == 0) continue;
    Index j = 0;
    while (j < 3 && other[j] != own[k]) ++j;
    if (j == 3 || at.on == PointLocation::On::Interior) return false;
    weights[j] += at.weights[k];
  }
  return true;
}

double distance_in_face(const Mesh& mesh, Index f, const std::array<double, 3>& a, const std::array<double, 3>& b) {
  if (!mesh.is_face_usable(f)) {  // a segment, or a point: the one corner that differs from the others says where
    const Face& t = mesh.faces()[f];
    for (Index k = 0; k < 3; ++k) {
      if (t[k] != t[(k + 1) % 3] && t[k] != t[(k + 2) % 3]) return std::abs(a[k] - b[k]) * mesh.lengths()[3 * f + k];
    }
    return 0;
  }
  Index k = 0;  // the frame of the longest edge, which is not 0 unless all are
  for (Index i = 1; i < 3; ++i) {
    if (mesh.lengths()[3 * f + i] > mesh.lengths()[3 * f + k]) k = i;
  }
  const double length = mesh.lengths()[3 * f + k];
  if (length == 0) return 0;
  const Vec2 apex = apex_over(mesh, 3 * f + k, 3 * f + k);
  const double ahead = a[(k + 1) % 3] - b[(k + 1) % 3], third = a[(k + 2) % 3] - b[(k + 2) % 3];
  return std::hypot(ahead * length + third * apex.x, third * apex.y);
}

}  // namespace

Vec2 apex_over(const Mesh& mesh, Index h, Index g) {
  const auto lengths = mesh.lengths();
  const bool mirrored = g != h && mesh.from(g) == mesh.from(h);
  const bool same_way = g == h || mirrored;
  const double from_first = lengths[same_way ? Mesh::previous(g) : Mesh::next(g)];
  const double from_second = lengths[same_way ? Mesh::next(g) : Mesh::previous(g)];
  return apex_over_edge(lengths[h], from_first, from_second, mesh.double_areas()[Mesh::face_of(g)]);
}

std::vector<Seed> seeds_in_own_faces(const Mesh& mesh, const PointLocation& at) {
  if (at.on == PointLocation::On::Vertex) return {{at.vertex, 0.0}};
  std::vector<Seed> seeds;
  const std::array<double, 3> d = corner_distances(mesh, at);
  for (Index k = 0; k < 3; ++k) seeds.push_back({mesh.faces()[at.face][k], d[k]});
  if (at.on == PointLocation::On::Edge && mesh.lengths()[at.halfedge] > 0) {
    const Index h = at.halfedge;
    const double x = at.weights[Mesh::next(h) % 3] * mesh.lengths()[h];
    for (Index g = mesh.opposite()[h]; g != h; g = mesh.opposite()[g]) {
      const Vec2 apex = apex_over(mesh, h, g);
      seeds.push_back({mesh.from(Mesh::previous(g)), std::hypot(apex.x - x, apex.y)});
    }
  }
  return seeds;
}

std::vector<Seed> seeds_across_edges(const Mesh& mesh, const PointLocation& at) {
  std::vector<Seed> seeds = seeds_in_own_faces(mesh, at);
  if (at.on == PointLocation::On::Interior) {
    for (Index h = 3 * at.face; h < 3 * at.face + 3; ++h) add_seeds_across(mesh, at, h, seeds);
  }
  return seeds;
}

double distance_in_shared_face(const Mesh& mesh, const PointLocation& a, const PointLocation& b) {
  double shortest = kInfinity;
  std::array<double, 3> wa, wb;
  const auto try_face = [&](Index f) {
    if (weights_in(mesh, a, f, wa) && weights_in(mesh, b, f, wb)) {
      shortest = std::min(shortest, distance_in_face(mesh, f, wa, wb));
    }
  };
  try_face(a.face);
  try_face(b.face);
  if (a.on == PointLocation::On::Edge) {
    for (Index g = mesh.opposite()[a.halfedge]; g != a.halfedge; g = mesh.opposite()[g]) try_face(Mesh::face_of(g));
  }
  if (a.on == PointLocation::On::Vertex) {
    for (const Index h : mesh.corners(a.vertex)) try_face(Mesh::face_of(h));
  }
  return shortest;
}

}  // namespace brushfire::detail
