// The generators: counts, topology, and that every vertex lies on the surface that the name says.
#include <brushfire/core/error.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/mesh/subdivide.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace brushfire {
namespace {

struct Expected {
  std::string name;
  Shape shape;
  Index vertices, faces, boundary_edges;
  long long euler;
};

std::vector<Expected> manifold_shapes() {
  return {{"plane", shapes::plane(7, 4), 40, 56, 22, 1},
          {"saddle", shapes::saddle(6), 49, 72, 24, 1},
          {"terrain", shapes::noise_terrain(9, 5), 60, 90, 28, 1},
          {"cube of one cell", shapes::cube(1), 8, 12, 0, 2},
          {"cube", shapes::cube(5), 152, 300, 0, 2},
          {"icosphere", shapes::icosphere(3), 642, 1280, 0, 2},
          {"latlong sphere", shapes::latlong_sphere(6, 9), 47, 90, 0, 2},
          {"cone", shapes::cone(4, 7), 29, 49, 7, 1},
          {"cylinder", shapes::cylinder(4, 7), 35, 56, 14, 0},
          {"torus", shapes::torus(8, 5), 40, 80, 0, 0},
          {"folded sphere", shapes::folded_sphere(4), 2562, 5120, 0, 2}};
}

double signed_volume(const Shape& s) {
  double volume = 0;
  for (const Face& t : s.faces) {
    volume += dot(s.positions[t[0]], cross(s.positions[t[1]], s.positions[t[2]])) / 6;
  }
  return volume;
}

TEST(Shapes, ManifoldSurfacesHaveTheirCountsAndTopologyAndOneOrientation) {
  for (const Expected& e : manifold_shapes()) {
    SCOPED_TRACE(e.name);
    const Mesh mesh = e.shape.mesh();
    const MeshReport& r = mesh.report();
    EXPECT_EQ(r.vertices, e.vertices);
    EXPECT_EQ(r.faces, e.faces);
    EXPECT_EQ(r.boundary_edges, e.boundary_edges);
    EXPECT_EQ(r.euler_characteristic, e.euler);
    EXPECT_EQ(r.components, 1u);
    EXPECT_EQ(r.nonmanifold_edges + r.nonmanifold_vertices + r.misoriented_edges + r.isolated_vertices, 0u);
    EXPECT_EQ(r.zero_area_faces + r.duplicate_faces + r.duplicate_positions, 0u);
    EXPECT_TRUE(e.boundary_edges > 0 || signed_volume(e.shape) > 0);
  }
}

TEST(Shapes, OpenSurfacesFaceUpwardsOrOutwards) {
  for (const Shape& s :
       {shapes::plane(3, 2), shapes::saddle(4, 0.3), shapes::noise_terrain(4, 4), shapes::cone(3, 5)}) {
    for (const Face& t : s.faces) {
      EXPECT_GT(cross(s.positions[t[1]] - s.positions[t[0]], s.positions[t[2]] - s.positions[t[0]]).z, 0);
    }
  }
  const Shape cylinder = shapes::cylinder(2, 6);
  for (const Face& t : cylinder.faces) {
    const Vec3 a = cylinder.positions[t[0]], b = cylinder.positions[t[1]], c = cylinder.positions[t[2]];
    const Vec3 n = cross(b - a, c - a);
    EXPECT_GT(n.x * (a.x + b.x + c.x) + n.y * (a.y + b.y + c.y), 0);
  }
}

TEST(Shapes, VerticesLieOnTheirSurface) {
  const auto off = [](const Shape& s, auto&& deviation) {
    double worst = 0;
    for (const Vec3& p : s.positions) worst = std::max(worst, std::abs(deviation(p)));
    return worst;
  };
  const double eps = 4e-16;
  EXPECT_LE(off(shapes::icosphere(3, 2), [](Vec3 p) { return norm(p) - 2; }), 2 * eps);
  EXPECT_LE(off(shapes::latlong_sphere(9, 11), [](Vec3 p) { return norm(p) - 1; }), eps);
  EXPECT_LE(off(shapes::cylinder(3, 17), [](Vec3 p) { return std::hypot(p.x, p.y) - 1; }), eps);
  EXPECT_LE(off(shapes::cone(5, 13, 1, 3), [](Vec3 p) { return std::hypot(p.x, p.y) - (1 - p.z / 3); }), eps);
  EXPECT_LE(off(shapes::saddle(9), [](Vec3 p) { return p.z - (p.x * p.x - p.y * p.y); }), eps);
  EXPECT_LE(off(shapes::torus(13, 9), [](Vec3 p) { return std::hypot(std::hypot(p.x, p.y) - 1, p.z) - 0.4; }), eps);
}

TEST(Shapes, AnglesAgreeWithTheLibrarysSineAndAreMirrorSymmetricToTheBit) {
  const Index n = 360;
  const Shape ring = shapes::cylinder(1, n);
  for (Index i = 0; i < n; ++i) {
    const double argument_rounding = 1e-15;  // of the angle that the library's functions are given
    EXPECT_NEAR(ring.positions[i].x, std::cos(2 * kPi * i / n), argument_rounding);
    EXPECT_NEAR(ring.positions[i].y, std::sin(2 * kPi * i / n), argument_rounding);
  }
  const Shape eight = shapes::cylinder(1, 64);
  for (Index i = 1; i < 64; ++i) {
    EXPECT_EQ(eight.positions[i].x, eight.positions[64 - i].x);
    EXPECT_EQ(eight.positions[i].y, -eight.positions[64 - i].y);
  }
  EXPECT_EQ(eight.positions[16], (Vec3{0, 1, 0}));
}

TEST(Shapes, BookHasASpineOfAsManyFacesAsPages) {
  const Mesh mesh = shapes::book(5, 2, 3).mesh();
  EXPECT_EQ(mesh.vertex_count(), 4u + 5 * 2 * 4);
  EXPECT_EQ(mesh.report().nonmanifold_edges, 3u);
  EXPECT_EQ(mesh.report().components, 1u);
}

TEST(Shapes, BowTieHasOneVertexThatJoinsAllFans) {
  const Mesh mesh = shapes::bow_tie(4, 6).mesh();
  EXPECT_EQ(mesh.report().nonmanifold_vertices, 1u);
  EXPECT_EQ(mesh.links()[0], Link::Other);
  EXPECT_EQ(mesh.report().nonmanifold_edges, 0u);
  EXPECT_EQ(mesh.corners(0).size(), 24u);
}

TEST(Shapes, SizeZeroAndSizesBeyondTheIndicesAreErrors) {
  EXPECT_THROW(shapes::plane(0, 3), Error);
  EXPECT_THROW(shapes::cone(1, 2), Error);
  EXPECT_THROW(shapes::torus(3, 0), Error);
  EXPECT_THROW(shapes::plane(100000, 100000), Error);
  EXPECT_THROW(shapes::folded_sphere(1, 5, 1.0), Error);
}

TEST(Subdivision, MidpointsKeepTheSurfaceAndTheOldVertices) {
  const Shape coarse = shapes::folded_sphere(2);
  const Mesh mesh = coarse.mesh();
  const Shape fine = subdivided(mesh, {.rule = SubdivisionRule::Midpoint});
  EXPECT_EQ(fine.faces.size(), 4 * coarse.faces.size());
  EXPECT_EQ(fine.positions.size(), coarse.positions.size() + mesh.report().edges);
  for (std::size_t v = 0; v < coarse.positions.size(); ++v) EXPECT_EQ(fine.positions[v], coarse.positions[v]);
  const Mesh split = fine.mesh();
  EXPECT_NEAR(split.report().area, mesh.report().area, 1e-13 * mesh.report().area);
  EXPECT_EQ(split.report().euler_characteristic, 2);
  EXPECT_EQ(split.report().misoriented_edges, 0u);
}

TEST(Subdivision, LoopsRuleRoundsAnIcosahedron) {
  const Shape coarse = shapes::icosphere(0);
  const auto nearest_to_centre = [](const Shape& s) {
    double r = kInfinity;
    for (const Vec3& p : s.positions) r = std::min(r, norm(p));
    return r;
  };
  const double straight = nearest_to_centre(subdivided(coarse.mesh(), {.rule = SubdivisionRule::Midpoint}));
  const double loop = nearest_to_centre(subdivided(coarse.mesh()));
  EXPECT_LT(loop, straight);  // the opposite corners of an edge lie below its middle
  EXPECT_GT(loop, 0.5);
}

TEST(Subdivision, NonManifoldEdgesGetOneMidpointAndFacesWithARepeatedVertexStay) {
  Shape s = shapes::book(3, 1, 1);
  s.faces.push_back({0, 0, 1});
  const Shape fine = subdivided(s.mesh());
  EXPECT_EQ(fine.faces.size(), 4 * 6 + 1u);
  EXPECT_EQ(fine.faces.back(), (Face{0, 0, 1}));
  EXPECT_EQ(fine.mesh().report().nonmanifold_edges, 2u);
}

TEST(Subdivision, NoiseIsBoundedByTheEdgeAndTheSameForTheSameSeed) {
  const Mesh mesh = shapes::plane(3, 3).mesh();
  const SubdivisionOptions options{.rule = SubdivisionRule::Midpoint, .noise = 0.1, .seed = 7};
  const Shape a = subdivided(mesh, options), b = subdivided(mesh, options);
  EXPECT_EQ(a.positions, b.positions);
  double highest = 0;
  for (const Vec3& p : a.positions) highest = std::max(highest, std::abs(p.z));
  EXPECT_GT(highest, 0);
  EXPECT_LE(highest, 0.1 * std::sqrt(2.0) / 3);
}

}  // namespace
}  // namespace brushfire
