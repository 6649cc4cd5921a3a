// Regions below a level as polygons.
#include <brushfire/mesh/shapes.h>
#include <brushfire/mesh/terrain.h>
#include <brushfire/queries/isochrones.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace brushfire {
namespace {

double area(const MapRing& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto& [x, y] = ring[i];
    const auto& [u, v] = ring[(i + 1) % ring.size()];
    sum += 0.5 * (x * v - u * y);
  }
  return sum;
}

std::vector<double> values_of(const Mesh& mesh, double (*value)(Vec3)) {
  std::vector<double> values;
  for (const Vec3 p : mesh.positions()) values.push_back(value(p));
  return values;
}

TEST(Isochrones, OfDistancesOnAPlaneAreDiscsCutOffAtTheBorder) {
  const Mesh mesh = shapes::plane(80, 80).mesh();
  const auto from_middle = values_of(mesh, [](Vec3 p) { return std::hypot(p.x - 0.5, p.y - 0.5); });
  const std::vector<MapPolygon> disc = isochrone(mesh, from_middle, 0.3);
  ASSERT_EQ(disc.size(), 1);
  EXPECT_TRUE(disc[0].holes.empty());
  EXPECT_NEAR(area(disc[0].outer), kPi * 0.09, 1e-3);
  const auto from_corner = values_of(mesh, [](Vec3 p) { return std::hypot(p.x, p.y); });
  const std::vector<MapPolygon> quarter = isochrone(mesh, from_corner, 0.7);
  ASSERT_EQ(quarter.size(), 1);
  EXPECT_NEAR(area(quarter[0].outer), kPi * 0.49 / 4, 1e-3);
  ASSERT_EQ(isochrone(mesh, from_corner, 2).size(), 1);
  EXPECT_NEAR(area(isochrone(mesh, from_corner, 2)[0].outer), 1, 1e-12);  // all of it
  EXPECT_TRUE(isochrone(mesh, from_corner, 0).empty());
}

TEST(Isochrones, HaveHolesAndIslandsInThem) {
  const Mesh mesh = shapes::plane(90, 90).mesh();
  // Below 0 within 0.1 and between 0.2 and 0.4 of the middle.
  const auto rings = values_of(mesh, [](Vec3 p) {
    const double r = std::hypot(p.x - 0.5, p.y - 0.5);
    return (r - 0.1) * (r - 0.2) * (r - 0.4);
  });
  const std::vector<MapPolygon> polygons = isochrone(mesh, rings, 0);
  ASSERT_EQ(polygons.size(), 2);
  double whole = 0;
  std::size_t holes = 0;
  for (const MapPolygon& p : polygons) {
    EXPECT_GT(area(p.outer), 0);
    whole += area(p.outer);
    for (const MapRing& hole : p.holes) {
      EXPECT_LT(area(hole), 0);
      whole += area(hole);
      ++holes;
    }
  }
  EXPECT_EQ(holes, 1);
  EXPECT_NEAR(whole, kPi * (0.16 - 0.04 + 0.01), 2e-3);
}

TEST(Isochrones, EndAtHolesOfTheGroundAndWhereNothingIsReached) {
  std::vector<double> heights(25, 0);
  heights[12] = kInfinity;  // the middle
  const Terrain terrain(heights, 5, 5);
  std::vector<double> values(25, 1);
  values[12] = kInfinity;
  const std::vector<MapPolygon> polygons = isochrone(terrain.mesh(), values, 2);
  ASSERT_EQ(polygons.size(), 1);
  ASSERT_EQ(polygons[0].holes.size(), 1);
  EXPECT_NEAR(area(polygons[0].outer), 16, 1e-12);
  EXPECT_NEAR(area(polygons[0].holes[0]), -2, 1e-12);  // four cells, of each of which one triangle is left
}

TEST(Isochrones, AreGeoJson) {
  const Mesh mesh = shapes::plane(1, 1).mesh();
  const std::vector<double> levels{0.5, 5};
  EXPECT_EQ(
      isochrones_as_geojson(mesh, std::vector<double>{0, 1, 0, 1}, levels),
      "{\"type\":\"FeatureCollection\",\"features\":[\n"
      "{\"type\":\"Feature\",\"properties\":{\"level\":0.5},\"geometry\":{\"type\":\"MultiPolygon\",\"coordinates\":"
      "[[[[0,0],[0.5,0],[0.5,0.5],[0.5,1],[0,1],[0,0]]]]}},\n"
      "{\"type\":\"Feature\",\"properties\":{\"level\":5},\"geometry\":{\"type\":\"MultiPolygon\",\"coordinates\":"
      "[[[[0,0],[1,0],[1,1],[0,1],[0,0]]]]}}\n]}\n");
}

TEST(Isochrones, KeepEveryDigitOfMapCoordinates) {
  const Terrain terrain(std::vector<double>{0, 0, 0, 0}, 2, 2, {{4512345.678, 5432109.876}, {10, 0}, {0, -10}});
  const std::vector<double> levels{1};
  const std::string text = isochrones_as_geojson(terrain.mesh(), std::vector<double>(4, 0), levels);
  EXPECT_NE(text.find("[4512345.678,5432109.876]"), std::string::npos) << text;
}

}  // namespace
}  // namespace brushfire
