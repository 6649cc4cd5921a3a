// The verbs log-map and gradient as black boxes, on planes, where everything is known.
#include "in_folder.h"
#include "program.h"

#include <brushfire/io/npy.h>
#include <brushfire/io/read_field.h>
#include <brushfire/io/read_mesh.h>

#include <gtest/gtest.h>

#include <cmath>

namespace brushfire::test {
namespace {

class Maps : public InFolder {
 protected:
  void SetUp() override {
    ASSERT_EQ(run_program({"shape", "delaunay-square", "-n", "500", "-o", path("plane.ply"), "-q"}).code, 0);
    plane_ = read_mesh(path("plane.ply")).mesh;
    write("islands.off", "OFF\n7 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n3 0 1 2\n3 0 2 3\n3 4 5 6\n");
  }

  // The vertex nearest to a place in the plane.
  Index vertex_near(double x, double y) const {
    Index best = 0;
    for (Index v = 0; v < plane_.vertex_count(); ++v) {
      if (norm(plane_.positions()[v] - Vec3{x, y, 0}) < norm(plane_.positions()[best] - Vec3{x, y, 0})) best = v;
    }
    return best;
  }

  Mesh plane_;
};

TEST_F(Maps, TheLogMapOfAPlaneIsThePlaneTurnedToTheDirection) {
  for (const auto& [x, y] : {std::pair{0.5, 0.5}, {0.3, 0.8}, {0.0, 0.0}, {0.5, 0.0}}) {
    const Index source = vertex_near(x, y);
    const Vec3 at = plane_.positions()[source];
    const Ended ended = run_program({"log-map", path("plane.ply"), "-s", std::to_string(source), "--direction",
                                     "0.6,0.8,0", "-o", path("map.npy"), "--unit", "mm"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const NpyArray map = read_npy(path("map.npy"));
    ASSERT_EQ(map.shape, (std::vector<std::size_t>{plane_.vertex_count(), 4}));
    for (Index v = 0; v < plane_.vertex_count(); ++v) {
      const Vec3 d = plane_.positions()[v] - at;
      EXPECT_NEAR(map.values[4 * v], 0.6 * d.x + 0.8 * d.y, 1e-9) << v;
      EXPECT_NEAR(map.values[4 * v + 1], -0.8 * d.x + 0.6 * d.y, 1e-9) << v;
      EXPECT_NEAR(map.values[4 * v + 2], norm(d), 1e-12) << v;
    }
  }
}

TEST_F(Maps, EveryFormatHoldsWhatIsWithinTheRadius) {
  const std::string source = std::to_string(vertex_near(0.5, 0.5));
  for (const char* extension : {"csv", "json", "npy", "ply", "vtk", "obj"}) {
    const std::string file = path(std::string("disc.") + extension);
    const Ended ended = run_program({"log-map", path("plane.ply"), "-s", source, "-r", "0.2", "-o", file, "--json"});
    ASSERT_EQ(ended.code, 0) << ended.err;
  }
  const LoadedField radii = read_field(path("disc.csv"), "radius");
  ASSERT_GT(radii.values.size(), 10u);
  for (std::size_t i = 0; i < radii.values.size(); ++i) {
    EXPECT_LE(radii.values[i], 0.2);
    const NpyArray map = read_npy(path("disc.npy"));
    EXPECT_EQ(map.values[4 * radii.vertices[i] + 2], radii.values[i]);
  }
  for (const char* extension : {"ply", "vtk", "obj"}) {
    const Mesh disc = read_mesh(path(std::string("disc.") + extension)).mesh;
    ASSERT_EQ(disc.vertex_count(), radii.values.size()) << extension;
    EXPECT_GT(disc.face_count(), 5u) << extension;
    for (Index v = 0; v < disc.vertex_count(); ++v) {
      EXPECT_EQ(disc.positions()[v], plane_.positions()[radii.vertices[v]]) << extension;
    }
  }
  for (const char* extension : {"ply", "vtk"}) {
    const LoadedField numbers = read_field(path(std::string("disc.") + extension), "vertex");
    for (std::size_t i = 0; i < numbers.values.size(); ++i) EXPECT_EQ(numbers.values[i], radii.vertices[i]);
  }
}

TEST_F(Maps, ALogMapIsAroundOnePlace) {
  const auto refused = [&](std::vector<std::string> arguments, const std::string& why) {
    arguments.insert(arguments.begin(), {"log-map", path("plane.ply")});
    const Ended ended = run_program(arguments);
    EXPECT_EQ(ended.code, 2);
    EXPECT_NE(ended.err.find(why), std::string::npos) << ended.err;
  };
  refused({"-s", "0,1"}, "a log map is around one place: 2 were given");
  refused({"-s", "0@1"}, "a log map has no offset");
  refused({"-s", "0", "--direction", "1,0"}, "--direction takes X,Y,Z");
  refused({"-s", "0", "--direction", "0,0,1"}, "the direction is at right angles to the surface there");
  refused({"-s", "0", "-o", path("m.stl")}, "known: npy, csv, json, ply, vtk, obj");
}

TEST_F(Maps, WhatTheLogMapDoesNotReachIsCountedApart) {
  const Ended ended = run_program({"log-map", path("islands.off"), "-s", "0", "-r", "0.5", "--json"});
  EXPECT_NE(ended.out.find("\"reached\": 1,\n  \"unreachable\": 3,\n  \"not_visited\": 3,"), std::string::npos)
      << ended.out;
}

TEST_F(Maps, TheGradientOfALinearFieldIsTheSameEverywhere) {
  std::string values;
  for (const Vec3& p : plane_.positions()) values += std::to_string(3 * p.x - 2 * p.y) + "\n";
  write("linear.txt", values);
  for (const char* on : {"faces", "vertices"}) {
    const Ended ended = run_program(
        {"gradient", path("plane.ply"), "--scalar", path("linear.txt"), "--on", on, "-o", path("gradient.npy")});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const NpyArray g = read_npy(path("gradient.npy"));
    ASSERT_EQ(g.shape[0], on == std::string("faces") ? plane_.face_count() : plane_.vertex_count());
    for (std::size_t i = 0; i < g.values.size(); i += 3) {
      EXPECT_NEAR(g.values[i], 3, 1e-3);  // the text has six decimals
      EXPECT_NEAR(g.values[i + 1], -2, 1e-3);
      EXPECT_EQ(g.values[i + 2], 0);
    }
  }
}

TEST_F(Maps, GradientsOfDistancesPointAwayAndAreNoneWhereNothingLeads) {
  const Ended ended = run_program({"gradient", path("islands.off"), "-s", "0", "-o", "-", "-q"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("\n2,nan,nan,nan\n"), std::string::npos) << ended.out;
  EXPECT_EQ(ended.out.find("face,x,y,z\n0,1,0.41421356"), 0u) << ended.out;
  const Ended json = run_program({"gradient", path("islands.off"), "-s", "0", "--on", "vertices", "--json"});
  EXPECT_NE(json.out.find("\"vectors\": 7,\n  \"without_value\": 3,"), std::string::npos) << json.out;
}

TEST_F(Maps, GradientsAreWrittenWithTheMesh) {
  for (const char* extension : {"ply", "vtk"}) {
    const std::string file = path(std::string("gradient.") + extension);
    for (const char* on : {"faces", "vertices"}) {
      ASSERT_EQ(run_program({"gradient", path("plane.ply"), "-s", "0", "--on", on, "-o", file}).code, 0);
      EXPECT_EQ(read_mesh(file).mesh.face_count(), plane_.face_count()) << extension << " " << on;
    }
  }
  EXPECT_NE(content("gradient.vtk").find("VECTORS gradient double\n"), std::string::npos);
  EXPECT_EQ(run_program({"gradient", path("plane.ply"), "-s", "0", "-o", path("g.obj")}).code, 2);
}

// Two sheets of one square each, whose vertices at x = 1 meet only after a weld.
TEST_F(Maps, AWeldedMeshIsToldInTheNumbersOfTheFile) {
  write("sheets.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 1 0 0\nv 2 0 0\nv 1 1 0\nf 1 2 3\nf 4 5 6\n");
  const Ended map = run_program({"log-map", path("sheets.obj"), "-s", "0", "--weld", "0", "-o", "-", "-q"});
  EXPECT_EQ(std::count(map.out.begin(), map.out.end(), '\n'), 7) << map.out;
  run_program({"distance", path("sheets.obj"), "-s", "0", "--weld", "0", "-o", path("d.npy"), "-q"});
  EXPECT_EQ(read_npy(path("d.npy")).values[4], 2);
  const Ended again =
      run_program({"gradient", path("sheets.obj"), "--scalar", path("d.npy"), "--weld", "0", "-o", "-"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(run_program({"certify", path("sheets.obj"), path("d.npy"), "-s", "0", "--weld", "0"}).code, 0);
  EXPECT_EQ(run_program({"certify", path("sheets.obj"), path("d.npy"), "-s", "0"}).code, 5);
  write("torn.txt", "0 1 1 1.5 2 1\n");
  const Ended torn = run_program({"gradient", path("sheets.obj"), "--scalar", path("torn.txt"), "--weld", "0"});
  EXPECT_EQ(torn.code, 2);
  EXPECT_NE(torn.err.find("--weld joins vertices 1 and 3, which have different values, 1 and 1.5"), std::string::npos)
      << torn.err;
}

}  // namespace
}  // namespace brushfire::test
