// --weights and --edge-weights as a black box.
#include "in_folder.h"
#include "program.h"

#include <brushfire/io/npy.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace brushfire::test {
namespace {

// [0, 4] x [0, 2] in unit squares: vertex y * 5 + x; faces 8 y + 2 x and the next one. x > 2 costs three times as much.
class WeightFiles : public InFolder {
 protected:
  void SetUp() override {
    std::string weights = "# one per face\n";
    for (int square = 0; square < 8; ++square) weights += square % 4 < 2 ? "1 1\n" : "3 3\n";
    write_squares("m.off", 4, 2);
    write("w.txt", weights);
    write("fence.txt", "# from, to, along, across\n2 7 inf 5\n7 12 inf 5\n");
    write("road.txt", "5 6 0.5\n6 7 0.5\n7 8 0.5\n8 9 0.5\n");
  }
  static double number(const Ended& ended) {
    EXPECT_EQ(ended.code, 0) << ended.err;
    return std::strtod(ended.out.c_str(), nullptr);
  }
};

TEST_F(WeightFiles, DistancesAndPathsPayForFacesFencesAndRoads) {
  const std::string mesh = path("m.off"), w = path("w.txt");
  const double bound = number(run_program({"distance", mesh, "-s", "5", "-t", "9", "--weights", w}));
  EXPECT_GE(bound, 8);
  EXPECT_LE(bound, 8 * 1.01);  // the tolerance
  EXPECT_NEAR(number(run_program({"path", mesh, "--from", "5", "--to", "9", "--weights", w})), 8, 1e-12);
  EXPECT_NEAR(number(run_program(
                  {"path", mesh, "--from", "5", "--to", "9", "--weights", w, "--edge-weights", path("fence.txt")})),
              13, 1e-12);
  EXPECT_NEAR(number(run_program({"path", mesh, "--from", "5", "--to", "9", "--edge-weights", path("road.txt")})), 2,
              1e-12);
  const double low = number(run_program({"distance", mesh, "-s", "5", "-t", "9", "--weights", w, "--bound", "lower"}));
  EXPECT_LE(low, 8 + 1e-12);
  EXPECT_GT(low, 7.8);
}

TEST_F(WeightFiles, AreArraysToo) {
  std::vector<double> weights(16, 1);
  weights[15] = 2;
  write_npy(path("w.npy"), weights);
  write_npy(path("e.npy"), std::vector<double>{5, 6, 0.5, 0, 6, 7, 0.5, 0}, std::vector<std::size_t>{2, 4});
  const Ended ended = run_program({"distance", path("m.off"), "-s", "5", "--weights", path("w.npy"), "--edge-weights",
                                   path("e.npy"), "-o", path("d.npy")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NEAR(read_npy(path("d.npy")).values[7], 1, 2e-9);  // rounding of windows
}

TEST_F(WeightFiles, JsonTellsEveryLeg) {
  const Ended ended = run_program({"path", path("m.off"), "--from", "5", "--to", "9", "--weights", path("w.txt"),
                                   "--edge-weights", path("fence.txt"), "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto json = nlohmann::json::parse(ended.out);
  const auto& found = json.at("paths").at(0);
  double cost = 0, length = 0, tolls = 0;
  for (const auto& leg : found.at("legs")) {
    EXPECT_NEAR(leg.at("cost").get<double>(),
                leg.at("length").get<double>() * leg.at("weight").get<double>() + leg.at("toll").get<double>(), 1e-12);
    cost += leg.at("cost").get<double>();
    length += leg.at("length").get<double>();
    tolls += leg.at("toll").get<double>();
    EXPECT_LT(leg.at("face").get<int>(), 16);
  }
  EXPECT_NEAR(cost, 13, 1e-12);
  EXPECT_NEAR(length, 4, 1e-12);
  EXPECT_NEAR(tolls, 5, 1e-12);
  EXPECT_NEAR(json.at("cost").get<double>(), 13, 1e-12);
  EXPECT_LE(found.at("lower").get<double>(), 13 + 1e-12);
  EXPECT_EQ(json.at("method"), "steiner");
}

TEST_F(WeightFiles, ThatDoNotFitAreRefusedWithTheReason) {
  const auto refused = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"path", path("m.off"), "--from", "5", "--to", "9"});
    const Ended ended = run_program(more);
    EXPECT_EQ(ended.code, 2);
    return ended.err;
  };
  write("few.txt", "1 2 3\n");
  EXPECT_NE(refused({"--weights", path("few.txt")}).find("3 values, but the mesh has 16 faces"), std::string::npos);
  write("pairs.txt", "5 6\n");
  EXPECT_NE(refused({"--edge-weights", path("pairs.txt")}).find("not 2 numbers"), std::string::npos);
  write("none.txt", "0 14 1\n");
  EXPECT_NE(refused({"--edge-weights", path("none.txt")}).find("no edge of the mesh joins"), std::string::npos);
  write("far.txt", "0 99 1\n");
  EXPECT_NE(refused({"--edge-weights", path("far.txt")}).find("there is no vertex 99"), std::string::npos);
  EXPECT_NE(refused({"--weights", path("w.txt"), "--via", "3"}).find("without weights"), std::string::npos);
  EXPECT_NE(refused({"--weights", path("w.txt"), "--method", "exact"}).find("there is one method"), std::string::npos);
}

TEST_F(WeightFiles, WallsOfWeightsAreNotPassed) {
  std::string walls;
  for (int f = 0; f < 16; ++f) walls += f % 8 / 2 == 2 ? "inf\n" : "1\n";
  write("walls.txt", walls);
  const Ended ended = run_program({"path", path("m.off"), "--from", "5", "--to", "9", "--weights", path("walls.txt")});
  EXPECT_EQ(ended.code, 4);
  EXPECT_EQ(ended.out, "inf\n");
}

TEST_F(WeightFiles, GridsBecomeTerrainThatIsWalkedInSecondsAndDrawnAsIsochrones) {
  std::string grid = "ncols 21\nnrows 11\nxllcorner 995\nyllcorner 1995\ncellsize 10\nNODATA_value -1\n";
  for (int y = 0; y < 11; ++y) {
    for (int x = 0; x < 21; ++x) grid += x == 20 && y == 10 ? "-1 " : std::to_string(2 * x) + " ";
    grid += "\n";
  }
  write("dem.asc", grid);
  const Ended made = run_program({"terrain", path("dem.asc"), "-o", path("t.ply"), "--json"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(nlohmann::json::parse(made.out).at("faces"), 2 * 20 * 10 - 1);
  // Slope 0.2: up at 6 exp(-3.5 * 0.25) km/h, down at 6 exp(-3.5 * 0.15).
  const auto seconds = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"distance", path("t.ply"), "-s", "105", "-t", "125", "--slope", "tobler"});
    return number(run_program(more));
  };
  const double up = seconds({}), down = seconds({"--towards"});
  EXPECT_NEAR(up, 200 * 0.6 * std::exp(3.5 * 0.25), 0.03 * up);
  EXPECT_NEAR(down, 200 * 0.6 * std::exp(3.5 * 0.15), 0.03 * down);
  write("slopes.txt", "-1 2\n1 2\n");
  EXPECT_NEAR(
      number(run_program({"path", path("t.ply"), "--from", "105", "--to", "125", "--slope", path("slopes.txt")})), 400,
      1e-6);
  ASSERT_EQ(run_program({"distance", path("t.ply"), "-s", "105", "--slope", "tobler", "-o", path("s.npy")}).code, 0);
  const Ended drawn = run_program({"isochrones", path("t.ply"), path("s.npy"), "--levels", "60,120"});
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  const auto json = nlohmann::json::parse(drawn.out);
  EXPECT_EQ(json.at("features").size(), 2);
  EXPECT_EQ(json.at("features").at(0).at("geometry").at("coordinates").size(), 1);
  EXPECT_EQ(run_program({"distance", path("t.ply"), "-s", "5", "--steepest", "1", "--weights", path("w.txt")}).code, 2);
  EXPECT_EQ(run_program({"terrain", path("m.off"), "-o", path("x.ply")}).code, 3);
}

}  // namespace
}  // namespace brushfire::test
