// The mesh: connectivity, links, intrinsic geometry, report.
#include <brushfire/core/error.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace brushfire {
namespace {

const std::vector<Vec3> kSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Face> kTwoTriangles{{0, 1, 2}, {0, 2, 3}};

TEST(Mesh, EmptyMeshHasNothingAndAReport) {
  const Mesh mesh;
  EXPECT_EQ(mesh.vertex_count(), 0u);
  EXPECT_EQ(mesh.face_count(), 0u);
  EXPECT_EQ(mesh.unit(), 1.0);
  EXPECT_EQ(mesh.report().components, 0u);
}

TEST(Mesh, FaceIndexBeyondTheVerticesIsAnErrorThatNamesTheFace) {
  const std::vector<Face> faces{{0, 1, 2}, {0, 2, 4}};
  try {
    const Mesh mesh(kSquare, faces);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::InvalidMesh);
    EXPECT_STREQ(e.what(), "face 1 names vertex 4, but there are 4 vertices");
  }
}

TEST(Mesh, CoordinateThatIsNotFiniteIsAnErrorThatNamesTheVertex) {
  std::vector<Vec3> positions = kSquare;
  positions[2].y = std::nan("");
  try {
    const Mesh mesh(positions, kTwoTriangles);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::InvalidMesh);
    EXPECT_NE(std::string(e.what()).find("vertex 2"), std::string::npos);
  }
}

TEST(Mesh, TakesOverArraysThatAreMovedIntoItAndCopiesOthers) {
  std::vector<Vec3> positions = kSquare;
  std::vector<Face> faces = kTwoTriangles;
  const Mesh copied(positions, faces);
  EXPECT_NE(copied.positions().data(), positions.data());
  EXPECT_NE(copied.faces().data(), faces.data());
  const Vec3* const at = positions.data();
  const Face* const faces_at = faces.data();
  const Mesh taken(std::move(positions), std::move(faces));
  EXPECT_EQ(taken.positions().data(), at);
  EXPECT_EQ(taken.faces().data(), faces_at);
  EXPECT_EQ(taken.vertex_count(), 4u);
  EXPECT_EQ(taken.bounds().high, (Vec3{1, 1, 0}));
  EXPECT_TRUE(std::ranges::equal(taken.lengths(), copied.lengths()));
  EXPECT_EQ(taken.with_faces(std::vector<Index>{1}).positions().back(), kSquare.back());
}

TEST(Mesh, ArraysThatItDoesNotTakeOverStayTheCallers) {
  std::vector<Vec3> positions = kSquare;
  std::vector<Face> faces{{0, 1, 4}};
  EXPECT_THROW(Mesh(std::move(positions), std::move(faces)), Error);
  EXPECT_EQ(positions, kSquare);  // NOLINT(bugprone-use-after-move): it is promised
  EXPECT_EQ(faces.size(), 1u);    // NOLINT(bugprone-use-after-move)
}

TEST(Mesh, OppositeJoinsTheTwoFacesOfAnEdgeAndLeavesTheBoundaryAlone) {
  const Mesh mesh(kSquare, kTwoTriangles);
  const auto opposite = mesh.opposite();
  EXPECT_EQ(opposite[2], 3u);  // 2->0 of face 0 and 0->2 of face 1
  EXPECT_EQ(opposite[3], 2u);
  for (const Index h : {0u, 1u, 4u, 5u}) EXPECT_EQ(opposite[h], h);
}

TEST(Mesh, OppositeIsARingOverANonManifoldEdge) {
  std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  const std::vector<Face> book{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const Mesh mesh(positions, book);
  const auto opposite = mesh.opposite();
  EXPECT_EQ(opposite[0], 3u);
  EXPECT_EQ(opposite[3], 6u);
  EXPECT_EQ(opposite[6], 0u);
  EXPECT_EQ(mesh.links()[0], Link::Other);
  EXPECT_EQ(mesh.links()[2], Link::Arc);
  EXPECT_EQ(mesh.report().nonmanifold_edges, 1u);
}

TEST(Mesh, LinksTellInteriorBoundaryBowTieAndIsolatedVertices) {
  std::vector<Vec3> positions;
  for (int k = 0; k < 6; ++k) positions.push_back({std::cos(k * kPi / 3), std::sin(k * kPi / 3), 0});
  positions.push_back({0, 0, 0});
  positions.push_back({9, 9, 9});
  std::vector<Face> disc;
  for (Index k = 0; k < 6; ++k) disc.push_back({k, (k + 1) % 6, 6});
  const Mesh closed(positions, disc);
  EXPECT_EQ(closed.links()[6], Link::Circle);
  EXPECT_EQ(closed.links()[0], Link::Arc);
  EXPECT_EQ(closed.links()[7], Link::Empty);
  const std::vector<Face> bow_tie{disc[0], disc[3]};
  EXPECT_EQ(Mesh(positions, bow_tie).links()[6], Link::Other);
}

TEST(Mesh, LinkOfAVertexDoesNotDependOnTheOrientationOfItsFaces) {
  std::vector<Vec3> positions;
  for (int k = 0; k < 6; ++k) positions.push_back({std::cos(k * kPi / 3), std::sin(k * kPi / 3), 0});
  positions.push_back({0, 0, 0});
  std::vector<Face> disc;
  for (Index k = 0; k < 6; ++k) disc.push_back(k % 2 == 0 ? Face{k, (k + 1) % 6, 6} : Face{(k + 1) % 6, k, 6});
  const Mesh mesh(positions, disc);
  EXPECT_EQ(mesh.links()[6], Link::Circle);
  EXPECT_EQ(mesh.report().misoriented_edges, 6u);
}

TEST(Mesh, LengthsAndAreasScaleExactlyWithPowersOfTwo) {
  for (const double scale : {0x1p-100, 0x1p-500, 1.0, 0x1p100, 0x1p500}) {
    std::vector<Vec3> positions{{0.1, 0.2, 0.3}, {1.7, -0.4, 0.9}, {0.3, 1.1, -0.2}, {2, 2, 2}};
    const Mesh mesh(positions, kTwoTriangles);
    for (Vec3& p : positions) p = scale * p;
    const Mesh scaled(positions, kTwoTriangles);
    EXPECT_EQ(scaled.unit(), scale * mesh.unit());
    for (Index h = 0; h < 6; ++h) EXPECT_EQ(scaled.lengths()[h], mesh.lengths()[h]);
    for (Index f = 0; f < 2; ++f) EXPECT_EQ(scaled.double_areas()[f], mesh.double_areas()[f]);
  }
}

TEST(Mesh, FromLengthsAgreesWithCoordinates) {
  const Mesh with(kSquare, kTwoTriangles);
  const double d = std::sqrt(2.0);
  const std::vector<std::array<double, 3>> lengths{{1, 1, d}, {d, 1, 1}};
  const Mesh without = Mesh::from_lengths(4, kTwoTriangles, lengths);
  EXPECT_FALSE(without.has_positions());
  EXPECT_EQ(with.unit(), without.unit());
  for (Index h = 0; h < 6; ++h) EXPECT_DOUBLE_EQ(with.lengths()[h], without.lengths()[h]);
  for (Index f = 0; f < 2; ++f) EXPECT_NEAR(with.double_areas()[f], without.double_areas()[f], 1e-15);
}

TEST(Mesh, FromLengthsRefusesFacesThatDisagreeOnAnEdge) {
  const std::vector<std::array<double, 3>> lengths{{1, 1, 1.5}, {1.5001, 1, 1}};
  EXPECT_THROW(Mesh::from_lengths(4, kTwoTriangles, lengths), Error);
}

TEST(Mesh, FromLengthsRefusesABrokenTriangleInequality) {
  const std::vector<std::array<double, 3>> lengths{{1, 1, 2.5}, {2.5, 2, 2}};
  EXPECT_THROW(Mesh::from_lengths(4, kTwoTriangles, lengths), Error);
}

TEST(Mesh, CornerAnglesSumToPi) {
  const Mesh mesh(kSquare, kTwoTriangles);
  EXPECT_DOUBLE_EQ(mesh.corner_angle(0), kPi / 4);
  EXPECT_DOUBLE_EQ(mesh.corner_angle(1), kPi / 2);
  EXPECT_DOUBLE_EQ(mesh.corner_angle(0) + mesh.corner_angle(1) + mesh.corner_angle(2), kPi);
}

TEST(Mesh, ReportCountsDegenerateDuplicateAndIsolatedParts) {
  std::vector<Vec3> positions = kSquare;
  positions.push_back({2, 0, 0});
  positions.push_back({5, 5, 5});
  const std::vector<Face> faces{{0, 1, 2}, {0, 2, 3}, {2, 0, 1}, {0, 1, 1}, {0, 1, 4}};
  const Mesh mesh(positions, faces);
  const MeshReport& r = mesh.report();
  EXPECT_EQ(r.duplicate_faces, 1u);
  EXPECT_EQ(r.repeated_index_faces, 1u);
  EXPECT_EQ(r.zero_area_faces, 1u);
  EXPECT_EQ(r.isolated_vertices, 1u);
  EXPECT_EQ(r.components, 1u);
  EXPECT_FALSE(r.remarks().empty());
}

TEST(Mesh, ReportSaysSoupWhereTrianglesShareNoVertex) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (const Face& t : kTwoTriangles) {
    const Index n = static_cast<Index>(positions.size());
    for (const Index v : t) positions.push_back(kSquare[v]);
    faces.push_back({n, n + 1, n + 2});
  }
  // Two triangles repeat two of six positions; four squares on top of each other repeat most.
  EXPECT_FALSE(Mesh(positions, faces).report().looks_like_soup);
  const std::vector<Vec3> once = positions;
  for (int copy = 0; copy < 3; ++copy) {
    const Index n = static_cast<Index>(positions.size());
    positions.insert(positions.end(), once.begin(), once.end());
    faces.push_back({n, n + 1, n + 2});
    faces.push_back({n + 3, n + 4, n + 5});
  }
  const Mesh soup(positions, faces);
  EXPECT_TRUE(soup.report().looks_like_soup);
  EXPECT_NE(soup.report().remarks().front().find("soup"), std::string::npos);
}

TEST(Mesh, LengthsAndAreasAreFiniteAndRightAtTheEndsOfTheRangeOfDoubles) {
  const double largest = 0x1p990, tiny = 4e-320;
  for (const double size : {1e-300, 1e297, largest, tiny}) {
    SCOPED_TRACE(size);
    // From -size to size: the differences alone would overflow.
    const std::vector<Vec3> positions{{-size, -size, 0}, {size, -size, 0}, {size, size, 0}, {-size, size, 0}};
    const Mesh mesh(positions, kTwoTriangles);
    const double side = size / mesh.unit() * 2;
    ASSERT_TRUE(std::isfinite(side));
    EXPECT_NEAR(mesh.lengths()[0], side, 1e-3 * side);  // 4e-320 has four digits
    EXPECT_NEAR(mesh.lengths()[2], std::sqrt(2.0) * side, 1e-3 * side);
    EXPECT_NEAR(mesh.double_areas()[1], side * side, 2e-3 * side * side);
    EXPECT_NEAR(mesh.corner_angle(0), kPi / 4, 1e-3);
    EXPECT_EQ(mesh.report().zero_area_faces + mesh.report().zero_length_edges, 0u);
  }
}

TEST(Mesh, NamesAVertexBeyondWhichDistancesHaveNoNumbers) {
  std::vector<Vec3> positions = kSquare;
  positions[2].y = -0x1.1p990;
  try {
    const Mesh mesh(positions, kTwoTriangles);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::InvalidMesh);
    EXPECT_NE(std::string(e.what()).find("vertex 2 lies at"), std::string::npos) << e.what();
  }
  const std::vector<std::array<double, 3>> lengths{{{1e299, 1e299, 1e299}}};
  EXPECT_THROW(Mesh::from_lengths(3, std::vector<Face>{{0, 1, 2}}, lengths), Error);
}

TEST(Mesh, ReportsSayThatAreasAreBeyondNumbers) {
  for (const double size : {1e-200, 1.0, 1e200}) {
    std::vector<Vec3> positions = kSquare;
    for (Vec3& p : positions) p = size * p;
    const std::vector<std::string> remarks = Mesh(positions, kTwoTriangles).report().remarks();
    const bool told = std::any_of(remarks.begin(), remarks.end(),
                                  [](const std::string& s) { return s.find("beyond the range") != std::string::npos; });
    EXPECT_EQ(told, size != 1) << size;
  }
}

TEST(Mesh, ShortEdgesBesideLongOnesKeepTheirLength) {
  const std::vector<Vec3> positions{{0, 0, 0}, {1e-200, 0, 0}, {0, 1e-200, 0}, {1, 1, 1}, {2, 1, 1}, {1, 2, 1}};
  const std::vector<Face> faces{{0, 1, 2}, {3, 4, 5}};
  const Mesh mesh(positions, faces);
  EXPECT_DOUBLE_EQ(mesh.lengths()[0] * mesh.unit(), 1e-200);
  EXPECT_EQ(mesh.report().zero_length_edges, 0u);
}

TEST(Mesh, UnitIsOneWhereAllVerticesCoincide) {
  const std::vector<Vec3> positions(3, Vec3{1e5, 0, 7});
  const std::vector<Face> faces{{0, 1, 2}};
  const Mesh mesh(positions, faces);
  EXPECT_EQ(mesh.unit(), 1);
  EXPECT_EQ(mesh.lengths()[0], 0);
  EXPECT_DOUBLE_EQ(mesh.corner_angle(0), kPi / 3);
}

TEST(Mesh, FacesThatNameAVertexTwiceKeepTheirNumberAndJoinNothing) {
  const std::vector<Face> faces{{0, 1, 1}, {0, 1, 2}, {2, 2, 2}, {0, 2, 3}, {3, 0, 3}};
  const Mesh mesh(kSquare, faces);
  EXPECT_EQ(mesh.face_count(), 5u);
  for (const Index f : {0u, 2u, 4u}) {
    EXPECT_FALSE(mesh.is_face_usable(f));
    for (Index h = 3 * f; h < 3 * f + 3; ++h) EXPECT_EQ(mesh.opposite()[h], h);
    EXPECT_EQ(mesh.double_areas()[f], 0);
  }
  EXPECT_EQ(mesh.opposite()[5], 9u);  // 2->0 of face 1, 0->2 of face 3
  EXPECT_EQ(mesh.links()[0], Link::Arc);
  EXPECT_EQ(mesh.corners(3).size(), 3u);
  EXPECT_EQ(mesh.report().repeated_index_faces, 3u);
  EXPECT_EQ(mesh.report().euler_characteristic, 1);
}

TEST(Mesh, FansAndBooksOfManyFacesTakeNoQuadraticTime) {
  // 50000 faces at one vertex, then at one edge: linear is 0.1 s, quadratic half a minute. Of the process, so that a
  // busy machine does not count.
  const std::clock_t started = std::clock();
  const Index n = 50000;
  const Mesh fan = shapes::cone(1, n).mesh();
  EXPECT_EQ(fan.links()[0], Link::Circle);
  EXPECT_EQ(fan.report().boundary_edges, n);
  std::vector<Vec3> positions{{0, 0, 0}, {0, 0, 1}};
  std::vector<Face> faces;
  std::vector<std::array<double, 3>> lengths;
  for (Index i = 0; i < n; ++i) {
    positions.push_back({1.0 + i, 0, 0});
    faces.push_back({0, 1, i + 2});
    lengths.push_back({1, std::hypot(1.0 + i, 1.0), 1.0 + i});
  }
  const Mesh book(positions, faces);
  EXPECT_EQ(book.report().nonmanifold_edges, 1u);
  EXPECT_EQ(book.report().edges, 2 * n + 1);
  EXPECT_EQ(book.links()[0], Link::Other);
  const Mesh intrinsic = Mesh::from_lengths(n + 2, faces, lengths);
  EXPECT_EQ(intrinsic.lengths()[3] * intrinsic.unit(), 1);
  EXPECT_LT(std::clock() - started, 10 * CLOCKS_PER_SEC);
}

TEST(Mesh, LengthPrecisionBoundsWhatLengthsAloneLose) {
  // A cap over a unit edge: from its rounded lengths its altitude comes back with the promised precision.
  for (const double altitude : {1.0, 1e-2, 1e-4, 1e-6}) {
    SCOPED_TRACE(altitude);
    const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0.37, altitude, 0}};
    const std::vector<Face> faces{{0, 1, 2}};
    const Mesh with(positions, faces);
    std::array<double, 3> l;
    for (Index k = 0; k < 3; ++k) l[k] = with.lengths()[k] * with.unit();
    const Mesh without = Mesh::from_lengths(3, faces, std::vector<std::array<double, 3>>{l});
    const double promised = without.report().length_precision;
    EXPECT_EQ(with.report().length_precision, 1e-12);
    EXPECT_NEAR(promised, 64 * 2.2e-16 / altitude, 0.5 * promised);
    // What counts for distances is the altitude beside the longest edge.
    EXPECT_NEAR(without.double_areas()[0] * without.unit() * without.unit(), altitude, promised);
  }
}

TEST(Mesh, WithFacesKeepsVerticesUnitLengthsAndSlits) {
  const Mesh plane = shapes::plane(4, 4).mesh();
  std::vector<std::array<double, 3>> lengths;
  for (Index f = 0; f < plane.face_count(); ++f) {
    lengths.push_back({plane.unit() * plane.lengths()[3 * f], plane.unit() * plane.lengths()[3 * f + 1],
                       plane.unit() * plane.lengths()[3 * f + 2]});
  }
  const Mesh from_lengths = Mesh::from_lengths(plane.vertex_count(), plane.faces(), lengths);
  const std::vector<Index> kept{0, 1, 4, 5, 6, 7, 20};
  Index inner = 0;  // an edge between two faces that stay
  while (plane.opposite()[inner] == inner || plane.opposite()[inner] / 3 != 1) ++inner;
  for (const Mesh& mesh : {plane, from_lengths, plane.with_slits(std::array<Index, 1>{inner})}) {
    const Mesh some = mesh.with_faces(kept);
    EXPECT_EQ(some.vertex_count(), mesh.vertex_count());
    EXPECT_EQ(some.unit(), mesh.unit());
    EXPECT_EQ(some.has_positions(), mesh.has_positions());
    EXPECT_EQ(some.has_slits(), mesh.has_slits());
    ASSERT_EQ(some.face_count(), kept.size());
    for (Index f = 0; f < some.face_count(); ++f) {
      EXPECT_EQ(some.faces()[f], mesh.faces()[kept[f]]);
      EXPECT_EQ(some.double_areas()[f], mesh.double_areas()[kept[f]]);
      for (Index k = 0; k < 3; ++k) EXPECT_EQ(some.lengths()[3 * f + k], mesh.lengths()[3 * kept[f] + k]);
    }
    EXPECT_EQ(some.opposite()[0] == 0, mesh.opposite()[0] == 0);
  }
}

// A slit may be named by a face that goes; the others at its edge stay parted.
TEST(Mesh, WithFacesKeepsSlitsThatAreNamedByOtherFaces) {
  const Mesh book(std::vector<Vec3>{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}},
                  std::vector<Face>{{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  const std::vector<Index> kept{1, 2};
  EXPECT_EQ(book.with_faces(kept).opposite()[0], 3u);
  EXPECT_EQ(book.with_slits(std::array<Index, 1>{0}).with_faces(kept).opposite()[0], 0u);
}

TEST(Mesh, OppositeIsFoundAtCrowdedVerticesAsInTheArray) {
  std::vector<Vec3> positions{{0, 0, 0}, {0, 0, 1}};
  std::vector<Face> faces;
  for (Index k = 0; k < 200; ++k) {
    positions.push_back({std::cos(0.03 * k), std::sin(0.03 * k), 0.5});
    faces.push_back(k % 2 == 0 ? Face{0, 1, k + 2} : Face{k + 2, 0, k + 1});
  }
  const Mesh looked_up(positions, faces), built(positions, faces);
  const auto opposite = built.opposite();
  for (Index h = 0; h < built.halfedge_count(); ++h) {
    const Mesh fresh(positions, faces);
    ASSERT_EQ(h % 7 == 0 ? fresh.opposite(h) : looked_up.opposite(h), opposite[h]);
    ASSERT_EQ(fresh.neighbour(h), built.neighbour(h));
  }
}

}  // namespace
}  // namespace brushfire
