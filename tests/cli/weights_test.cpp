// --weights and --edge-weights as a black box.
#include "in_folder.h"
#include "program.h"

#include <brushfire/io/npy.h>
#include <brushfire/io/read_grid.h>

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

TEST_F(WeightFiles, WhatIsNotMetEverywhereIsToldWithWhatItWouldTake) {
  const std::string mesh = path("m.off");
  const std::vector<std::string> run{"distance",        mesh,          "-s",  "5", "--edge-weights",
                                     path("fence.txt"), "--tolerance", "0.08"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), run.begin(), run.end());
    return run_program(more);
  };
  const auto once = nlohmann::json::parse(with({"--json"}).out);
  ASSERT_GT(once.at("max_error_bound").get<double>(), 0.08);
  const int needed = once.at("needed_refinements").get<int>();
  ASSERT_GT(needed, 0);
  EXPECT_GT(once.at("needed_points").get<int>(), once.at("points").get<int>());
  EXPECT_NE(with({}).out.find("; everywhere with --refine " + std::to_string(needed) + ": some "), std::string::npos);
  const auto met = nlohmann::json::parse(with({"--json", "--refine", std::to_string(needed + 1)}).out);
  EXPECT_LE(met.at("max_error_bound").get<double>(), 0.08);
  EXPECT_EQ(met.at("needed_refinements"), 0);
  EXPECT_GE(met.at("refinements").get<int>(), 1);
  EXPECT_EQ(run_program({"distance", mesh, "-s", "5", "--refine", "1"}).code, 2);  // without weights
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

TEST_F(WeightFiles, GrainMakesOneDirectionDear) {
  std::string rows;
  for (int f = 0; f < 16; ++f) rows += "0 1 0 3\n";
  write("grain.txt", rows);
  const std::string mesh = path("m.off");
  EXPECT_NEAR(number(run_program({"distance", mesh, "-s", "5", "-t", "9", "--grain", path("grain.txt")})), 12, 1e-9);
  EXPECT_NEAR(number(run_program({"distance", mesh, "-s", "5", "-t", "10", "--grain", path("grain.txt")})), 1, 1e-9);
  write("short.txt", "0 1 0 3\n");
  EXPECT_EQ(run_program({"distance", mesh, "-s", "5", "--grain", path("short.txt")}).code, 2);
  write("three.txt", "0 1 0\n");
  EXPECT_EQ(run_program({"distance", mesh, "-s", "5", "--grain", path("three.txt")}).code, 2);
}

TEST_F(WeightFiles, AreMarchedOverWhereAMethodSaysSo) {
  const std::vector<std::string> how{"distance", path("m.off"), "-s",          "5",        "-t",
                                     "9",        "--weights",   path("w.txt"), "--method", "kimmel-sethian"};
  EXPECT_NEAR(number(run_program(how)), 8, 0.5);
  std::vector<std::string> told = how;
  told.push_back("--json");
  const auto json = nlohmann::json::parse(run_program(told).out);
  EXPECT_EQ(json.at("method"), "kimmel-sethian");
  EXPECT_EQ(json.at("engine"), "marching");
  EXPECT_TRUE(json.at("max_error_bound").is_null());
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--bound", "lower"}, {"--edge-weights", path("fence.txt")}}) {
    std::vector<std::string> words = how;
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run_program(words).code, 2) << more[0];
  }
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

// The least way up is as long as the mesh is wide, through ground of 1 and of 3.
TEST_F(WeightFiles, CountInWhateverReadsAField) {
  const std::string mesh = path("m.off"), w = path("w.txt");
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--weights", w});
    const Ended ended = run_program(words);
    EXPECT_EQ(ended.code, 0) << ended.err;
    return ended.out;
  };
  run({"matrix", mesh, "--rows", "5", "--columns", "9,7", "--dtype", "float64", "-o", path("d.npy")});
  EXPECT_NEAR(read_npy(path("d.npy")).values[0], 8, 1e-9);
  EXPECT_NEAR(read_npy(path("d.npy")).values[1], 2, 1e-9);
  for (const char* bound : {"upper", "lower"}) {  // rows on threads, the same bits
    run({"matrix", mesh, "--bound", bound, "--threads", "1", "--dtype", "float64", "-o", path("one.npy")});
    run({"matrix", mesh, "--bound", bound, "--threads", "3", "--dtype", "float64", "-o", path("three.npy")});
    EXPECT_EQ(read_npy(path("one.npy")).values, read_npy(path("three.npy")).values);
  }
  const auto lines =
      nlohmann::json::parse(run({"isolines", mesh, "-s", "5", "--levels", "7", "-o", path("l.obj"), "--json"}));
  EXPECT_GT(lines.at("greatest").get<double>(), 8);
  EXPECT_EQ(lines.at("levels_outside"), 0);
  const auto cells = nlohmann::json::parse(run({"voronoi", mesh, "-s", "5", "-s", "9", "--json"}));
  EXPECT_GT(cells.at("cells").at(0).at("area").get<double>(), 4.5);
  EXPECT_EQ(run({"sample", mesh, "--count", "2", "--source", "5", "--quiet"}), "5\n4\n");
  EXPECT_NE(run({"gradient", mesh, "-s", "5"}).find("mean 2"), std::string::npos);
  run({"render", mesh, "-s", "5", "--path", "9", "--size", "64x48", "-o", path("p.png")});
  write("labels.txt", "0 0 -1 -1 1 0 0 -1 -1 1 0 0 -1 -1 1\n");
  run({"parcels", mesh, path("labels.txt"), "-o", path("q.npy")});
  EXPECT_NEAR(read_npy(path("q.npy")).values[1], 7, 1e-9);
}

TEST_F(WeightFiles, NameAPropertyOfFacesOrCostsOfLabels) {
  write("kinds.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 2\nproperty list uchar int vertex_indices\nproperty float cost\nproperty int kind\nend_header\n"
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 2.5 7\n3 0 2 3 9 4\n");
  const std::string mesh = path("kinds.ply");
  const auto cost = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"distance", mesh, "-s", "0", "-t", "1"});
    return number(run_program(more));
  };
  EXPECT_NEAR(cost({"--weights", mesh + ":cost"}), 2.5, 1e-8);
  EXPECT_NEAR(cost({"--weights", mesh + ":kind", "--cost", "7=4", "--cost", "4=9"}), 4, 1e-8);
  EXPECT_NEAR(cost({"--weights", mesh + ":kind", "--cost", "4=9"}), 1, 1e-8);
  write("cells.vtk",
        "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\n"
        "POLYGONS 2 8\n3 0 1 2 3 0 2 3\nCELL_DATA 2\nSCALARS other float 1\nLOOKUP_TABLE default\n9 9\n"
        "SCALARS cost float 1\nLOOKUP_TABLE default\n3 9\nPOINT_DATA 4\nSCALARS cost float 1\n"
        "LOOKUP_TABLE default\n5 5 5 5\n");
  EXPECT_NEAR(cost({"--weights", path("cells.vtk") + ":cost"}), 3, 1e-8);
  write("cells.vtp",
        "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"0\" NumberOfPolys=\"2\"><CellData>"
        "<DataArray type=\"Float64\" Name=\"cost\" format=\"ascii\">6 9</DataArray></CellData></Piece></PolyData>"
        "</VTKFile>");
  EXPECT_NEAR(cost({"--weights", path("cells.vtp") + ":cost"}), 6, 1e-8);
  const auto said = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"distance", mesh, "-s", "0", "-t", "1"});
    const Ended ended = run_program(more);
    EXPECT_NE(ended.code, 0);
    return ended.err;
  };
  EXPECT_NE(said({"--weights", mesh + ":price"}).find("the faces have no scalar 'price'"), std::string::npos);
  EXPECT_NE(said({"--weights", mesh + ":kind", "--cost", "7"}).find("LABEL=COST"), std::string::npos);
  EXPECT_NE(said({"--cost", "7=1"}).find("of which labels"), std::string::npos);
  write("corners.txt", "1\n1\n7\n1\n");  // of vertices: a face costs the mean of its corners
  EXPECT_NEAR(cost({"--weights", path("corners.txt"), "--cost", "7=4"}), 2, 1e-9);
}

TEST_F(WeightFiles, CurvesAreSourcesOfUpperBounds) {
  const std::string mesh = path("m.off"), w = path("w.txt");
  EXPECT_NEAR(number(run_program({"distance", mesh, "-s", "chain:0,5,10", "-t", "9", "--weights", w})), 8, 1e-12);
  EXPECT_NEAR(number(run_program({"path", mesh, "--from", "chain:0,5,10", "--to", "9", "--weights", w})), 8, 1e-12);
  const Ended ended =
      run_program({"distance", mesh, "-s", "chain:0,5,10", "-t", "9", "--weights", w, "--bound", "lower"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("from curves there are upper bounds only"), std::string::npos);
}

TEST_F(WeightFiles, AreRefusedWhereLengthsCount) {
  const Ended arcs = run_program({"isolines", path("m.off"), "-s", "5", "--count", "3", "--chord-error", "0.1", "-o",
                                  path("l.obj"), "--weights", path("w.txt")});
  EXPECT_EQ(arcs.code, 2);
  EXPECT_NE(arcs.err.find("arcs are those of distances"), std::string::npos);
  const Ended lloyd = run_program({"sample", path("m.off"), "--count", "3", "--lloyd", "--weights", path("w.txt")});
  EXPECT_NE(lloyd.err.find("middles of cells are those of distances"), std::string::npos);
  const Ended parcels = run_program({"parcels", path("m.off"), path("w.txt"), "--slope", "tobler"});
  EXPECT_NE(parcels.err.find("the same both ways, and slopes are not"), std::string::npos);
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
  EXPECT_NE(refused({"--weights", path("w.txt"), "--method", "exact"}).find("bounds on both sides"), std::string::npos);
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
  EXPECT_EQ(seconds({"--tacking"}), up);  // not steep enough
  EXPECT_GT(seconds({"--tacking", "--steepest", "0.1"}), 1.2 * up);
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
  // Seconds as a grid that lies where the heights do; the hole stays one.
  const Ended placed = run_program({"terrain", path("dem.asc"), "--values", path("s.npy"), "-o", path("s.asc")});
  ASSERT_EQ(placed.code, 0) << placed.err;
  const Grid heights = read_grid(path("dem.asc")), costs = read_grid(path("s.asc"));
  EXPECT_EQ(costs.placement.origin, heights.placement.origin);
  EXPECT_EQ(costs.placement.down, heights.placement.down);
  EXPECT_EQ(costs.heights[105], 0);
  EXPECT_EQ(costs.heights.back(), kInfinity);
  EXPECT_EQ(run_program({"terrain", path("dem.asc"), "--values", path("w.txt"), "-o", path("s.asc")}).code, 2);
  // As a GeoTIFF, which is a terrain again, in builds with GDAL; others say how to make one.
  const Ended tiff = run_program({"terrain", path("dem.asc"), "--values", path("s.npy"), "-o", path("s.tif")});
  if (tiff.code != 0) {
    EXPECT_NE(tiff.err.find("gdal_translate"), std::string::npos) << tiff.err;
    return;
  }
  const Grid there = read_grid(path("s.tif"));
  EXPECT_EQ(there.heights, costs.heights);
  EXPECT_EQ(there.placement.origin, heights.placement.origin);
  EXPECT_EQ(run_program({"terrain", path("s.tif"), "-o", path("s.ply"), "--quiet"}).code, 0);
}

}  // namespace
}  // namespace brushfire::test
