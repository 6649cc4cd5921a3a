// Straight lines inside one face and across one edge.
#include <brushfire/solvers/detail/start.h>

#include <brushfire/mesh/detail/flat_face.h>

#include <algorithm>
#include <cmath>

namespace brushfire::detail {
namespace {

// What is asked of the mesh here, of few faces: looked up, not from arrays of all.
struct Net {
  explicit Net(const Mesh& m) : mesh(m), faces(m.faces()) {}

  Index from(Index h) const { return faces[h / 3][h % 3]; }
  Index opposite(Index h) const { return mesh.opposite(h); }
  double length(Index h) const { return mesh.length(h); }

  const Mesh& mesh;
  std::span<const Face> faces;
};

Sight whole_edge(const Net& net, Index h, Vec2 start) {
  return {h, net.from(h), start, Vec2{0, 0} - start, Vec2{net.length(h), 0} - start, 0};
}

// Into the frame of the edge from `origin` towards `end`.
Vec2 turned(Vec2 along, Vec2 a) { return {dot(along, a), cross(along, a)}; }

// The far sides of the face of halfedge g, where the point sees them through s, whose edge has `apex` above it.
void look_through(const Net& net, const Sight& s, Index g, Vec2 apex, std::vector<Sight>& sights) {
  const Vec2 to_apex = apex - s.start;
  const bool apex_is_left = cross(s.left, to_apex) > 0, apex_is_right = cross(to_apex, s.right) > 0;
  const bool same_way = net.from(g) == s.first;
  const Index left_edge = same_way ? Mesh::previous(g) : Mesh::next(g);
  const Index right_edge = same_way ? Mesh::next(g) : Mesh::previous(g);
  if (!apex_is_left && net.length(left_edge) > 0) {
    const Vec2 along = (1 / net.length(left_edge)) * apex;
    sights.push_back({left_edge, s.first, turned(along, s.start), turned(along, s.left),
                      turned(along, apex_is_right ? s.right : to_apex), s.crossed + 1});
  }
  if (!apex_is_right && net.length(right_edge) > 0) {
    const Vec2 along = (1 / net.length(right_edge)) * (Vec2{net.length(s.edge), 0} - apex);
    sights.push_back({right_edge, net.from(Mesh::previous(g)), turned(along, s.start - apex),
                      turned(along, apex_is_left ? s.left : to_apex), turned(along, s.right), s.crossed + 1});
  }
}

// The edges that a point sees first: all of its face, the others of the faces of its edge, or those opposite to it.
void first_sights(const Mesh& mesh, const Net& net, const PointLocation& at, std::vector<Sight>& sights) {
  sights.clear();
  if (at.on == PointLocation::On::Vertex) {
    for (const Index corner : mesh.corners(at.vertex)) {
      const Index h = Mesh::next(corner);
      if (!mesh.is_face_usable(Mesh::face_of(h)) || net.length(h) == 0) continue;
      const Vec2 own = apex_over(mesh, h, h);
      sights.push_back(whole_edge(net, h, {own.x, -own.y}));
    }
    return;
  }
  for_edges_around(mesh, at, [&](Index h, Vec2 p) { sights.push_back(whole_edge(net, h, {p.x, -p.y})); });
}

// From inside a face, across one of its edges; +inf where b is not to be seen there.
double distance_across_edge(const Mesh& mesh, const PointLocation& a, const PointLocation& b) {
  double shortest = kInfinity;
  for (Index h = 3 * a.face; h < 3 * a.face + 3; ++h) {
    const double length = mesh.length(h);
    if (length == 0 || !mesh.is_face_usable(a.face)) continue;
    const Vec2 below = point_over(mesh, h, a.weights);  // a lies at (x,-y)
    for (Index g = mesh.opposite(h); g != h; g = mesh.opposite(g)) {
      const auto wb = weights_in(mesh, b, Mesh::face_of(g));
      if (!wb) continue;
      const Index to = mesh.from(g) == mesh.from(h) ? Mesh::next(g) : g;  // the corner of g's face at to(h)
      const Vec2 apex = apex_over(mesh, h, g);
      const double w_to = (*wb)[to % 3], w_apex = (*wb)[Mesh::previous(g) % 3];
      const Vec2 above{w_to * length + w_apex * apex.x, w_apex * apex.y};
      const double height = above.y + below.y, crossing = below.x * above.y + above.x * below.y;
      if (crossing < 0 || crossing > length * height) continue;
      shortest = std::min(shortest, std::hypot(above.x - below.x, height));
    }
  }
  return shortest;
}

}  // namespace

std::span<const Seed> SeedSearch::in_own_faces(const Mesh& mesh, const PointLocation& at) {
  seeds_.clear();
  if (at.on == PointLocation::On::Vertex) {
    seeds_.push_back({at.vertex, 0.0});
    return seeds_;
  }
  const std::array<double, 3> d = corner_distances(mesh, at);
  for (Index k = 0; k < 3; ++k) seeds_.push_back({mesh.faces()[at.face][k], d[k]});
  if (at.on == PointLocation::On::Edge && mesh.length(at.halfedge) > 0) {
    const Index h = at.halfedge;
    const double x = at.weights[Mesh::next(h) % 3] * mesh.length(h);
    for (Index g = mesh.opposite(h); g != h; g = mesh.opposite(g)) {
      const Vec2 apex = apex_over(mesh, h, g);
      seeds_.push_back({mesh.from(Mesh::previous(g)), std::hypot(apex.x - x, apex.y)});
    }
  }
  return seeds_;
}

std::span<const Seed> SeedSearch::in_sight(const Mesh& mesh, const PointLocation& at, int crossings, double limit) {
  in_own_faces(mesh, at);
  if (!mesh.is_face_usable(at.face) && at.on != PointLocation::On::Vertex) return seeds_;
  const Net net(mesh);
  first_sights(mesh, net, at, sights_);
  for (std::size_t i = 0; i < sights_.size() && i < kMaxSights; ++i) {
    const Sight s = sights_[i];
    if (s.crossed >= crossings) break;
    const double length = net.length(s.edge);
    for (Index g = net.opposite(s.edge); g != s.edge; g = net.opposite(g)) {
      Vec2 apex = apex_over(mesh, s.edge, g);
      if (net.from(s.edge) != s.first) apex.x = length - apex.x;
      const Vec2 to_apex = apex - s.start;
      const double distance = norm(to_apex);  // in mesh.unit(): squares neither vanish nor overflow
      if (!(to_apex.y > 0) || distance > limit) continue;
      if (cross(s.left, to_apex) <= 0 && cross(to_apex, s.right) <= 0) {
        // The corner's halfedge leads to from(g), which is one end of the edge.
        const Vec2 side = (net.from(g) == s.first ? Vec2{0, 0} : Vec2{length, 0}) - apex;
        const double turn = std::atan2(std::abs(cross(side, to_apex)), -dot(side, to_apex));
        seeds_.push_back({net.from(Mesh::previous(g)), distance, Mesh::previous(g), turn});
      }
      look_through(net, s, g, apex, sights_);
    }
  }
  return seeds_;
}

double straight_distance(const Mesh& mesh, const PointLocation& a, const PointLocation& b) {
  double shortest = kInfinity;
  const auto try_face = [&](Index f) {
    const auto wa = weights_in(mesh, a, f), wb = weights_in(mesh, b, f);
    if (wa && wb) shortest = std::min(shortest, distance_within(mesh, f, *wa, *wb));
  };
  try_face(a.face);
  try_face(b.face);
  if (a.on == PointLocation::On::Edge) {
    for (Index g = mesh.opposite(a.halfedge); g != a.halfedge; g = mesh.opposite(g)) try_face(Mesh::face_of(g));
  }
  if (a.on == PointLocation::On::Vertex) {
    for (const Index h : mesh.corners(a.vertex)) try_face(Mesh::face_of(h));
  }
  if (a.on == PointLocation::On::Interior) shortest = std::min(shortest, distance_across_edge(mesh, a, b));
  return shortest;
}

}  // namespace brushfire::detail
