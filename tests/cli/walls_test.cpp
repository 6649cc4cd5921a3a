// Walls, cells, centres, parcels and smoothing as black boxes.
#include "in_folder.h"
#include "program.h"

#include <brushfire/io/npy.h>
#include <brushfire/io/read_field.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace brushfire::test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// [0, 4] x [0, 2] in unit squares: vertex y * 5 + x.
class Walls : public InFolder {
 protected:
  void SetUp() override {
    write_squares("m.off", 4, 2);
    write("edges.txt", "2 7\n");                             // up from (2, 0) to (2, 1)
    write("mask.txt", "1 1 1 0 1\n1 1 1 0 1\n1 1 1 0 1\n");  // column x = 3 is closed
  }
  std::vector<double> distances(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"distance", path("m.off"), "--method", "exact", "-o", path("d.npy")});
    const Ended ended = run_program(arguments);
    EXPECT_EQ(ended.code, 0) << ended.err;
    return read_npy(path("d.npy")).values;
  }
};

TEST_F(Walls, BlockedEdgesAreWalkedAround) {
  const std::vector<double> open = distances({"-s", "1"});
  const std::vector<double> walled = distances({"-s", "1", "--block-edges", path("edges.txt")});
  EXPECT_NEAR(open[3], 2, 1e-12);
  EXPECT_NEAR(walled[3], 2 * std::sqrt(2), 1e-12);
  EXPECT_NEAR(walled[2], 1, 1e-12);  // the near side
  // The same as an array, and as a table.
  write_npy(path("edges.npy"), std::vector<double>{2, 7}, std::vector<std::size_t>{1, 2});
  write("edges.csv", "2,7\n");
  EXPECT_EQ(distances({"-s", "1", "--block-edges", path("edges.npy")}), walled);
  EXPECT_EQ(distances({"-s", "1", "--block-edges", path("edges.csv")}), walled);
  EXPECT_EQ(run_program({"distance", path("m.off"), "-s", "1", "-t", "3", "--method", "exact", "--block-edges",
                         path("edges.txt")})
                .out.substr(0, 8),
            "2.828427");
  const Ended path_ended =
      run_program({"path", path("m.off"), "--from", "1", "--to", "3", "--block-edges", path("edges.txt")});
  EXPECT_EQ(path_ended.out.substr(0, 8), "2.828427");
  const Ended along = run_program(
      {"path", path("m.off"), "--from", "1", "--to", "3", "-m", "dijkstra", "--block-edges", path("edges.txt")});
  EXPECT_EQ(along.code, 0) << along.err;
  const Ended certified =
      run_program({"certify", path("m.off"), path("d.npy"), "-s", "1", "--block-edges", path("edges.txt"), "--quiet"});
  EXPECT_EQ(certified.code, 0) << certified.out;
  EXPECT_EQ(run_program({"certify", path("m.off"), path("d.npy"), "-s", "1", "--quiet"}).code, 5);
}

TEST_F(Walls, AMaskIsKeptToAndReadsNaNInGiftiAndInfElsewhere) {
  const std::vector<double> masked = distances({"-s", "0", "--mask", path("mask.txt")});
  for (int v : {3, 4, 8, 9, 13, 14}) EXPECT_EQ(masked[v], kInf) << v;
  EXPECT_NEAR(masked[12], std::sqrt(8), 1e-12);
  const std::vector<double> region = distances({"-s", "0", "--region", path("mask.txt") + ":1"});
  EXPECT_EQ(region, masked);
  std::string faces;
  for (int f : {4, 5, 6, 7, 12, 13, 14, 15}) faces += std::to_string(f) + "\n";
  write("faces.txt", faces);
  EXPECT_EQ(distances({"-s", "0", "--block-faces", path("faces.txt")}), masked);
  std::string bits;
  for (int f = 0; f < 16; ++f) bits += (f % 8) >= 4 ? "1\n" : "0\n";
  write("bits.txt", bits);
  EXPECT_EQ(distances({"-s", "0", "--block-faces", path("bits.txt")}), masked);
  write("some.label",
        "#!ascii label\n9\n0 0 0 0 0\n1 0 0 0 0\n2 0 0 0 0\n5 0 0 0 0\n6 0 0 0 0\n7 0 0 0 0\n10 0 0 0 0\n"
        "11 0 0 0 0\n12 0 0 0 0\n");
  EXPECT_EQ(distances({"-s", "0", "--mask", path("some.label")}), masked);
  ASSERT_EQ(
      run_program({"distance", path("m.off"), "-s", "0", "--mask", path("mask.txt"), "-o", path("d.func.gii")}).code,
      0);
  const LoadedField gifti = read_field(path("d.func.gii"));
  EXPECT_TRUE(std::isnan(gifti.values[3]));
  EXPECT_NEAR(gifti.values[12], std::sqrt(8), 1e-3);
  EXPECT_EQ(run_program({"certify", path("m.off"), path("d.func.gii"), "-s", "0", "--mask", path("mask.txt"),
                         "--within", "0.01", "--quiet"})
                .code,
            0);
  // What is behind the wall starts nothing, and is reached by nothing.
  const Ended behind = run_program({"distance", path("m.off"), "-s", "3", "--mask", path("mask.txt")});
  EXPECT_EQ(behind.code, 2);
  EXPECT_NE(behind.err.find("behind a wall"), std::string::npos) << behind.err;
  EXPECT_EQ(run_program({"distance", path("m.off"), "-s", "0", "-t", "4", "--mask", path("mask.txt")}).code, 4);
}

TEST_F(Walls, InfoTellsWhatTheMaskLeaves) {
  write("holed.txt", "1 1 0 1 1\n1 1 0 1 1\n1 0 0 1 1\n");
  const Ended ended = run_program({"info", path("m.off"), "--mask", path("holed.txt")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("in 2 components"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("open by the mask"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("boundary:0"), std::string::npos) << ended.out;
  const std::string json = run_program({"info", path("m.off"), "--mask", path("holed.txt"), "--json"}).out;
  for (const char* key :
       {"\"open_components\": 2", "\"open_in_no_face\": 1", "\"outside_largest\": ", "\"boundaries\": "}) {
    EXPECT_NE(json.find(key), std::string::npos) << key << json;
  }
}

TEST_F(Walls, FilesThatDoNotFitAreRefusedWithOneLine) {
  write("short.txt", "1 1 1\n");
  write("odd.txt", "1 2 3\n");
  write("far.txt", "0 99\n");
  write("apart.txt", "0 14\n");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"--mask", path("short.txt")},
                                             {"--region", path("mask.txt")},
                                             {"--region", path("mask.txt") + ":7"},
                                             {"--region", path("mask.txt") + ":cuneus"},
                                             {"--block-edges", path("odd.txt")},
                                             {"--block-edges", path("far.txt")},
                                             {"--block-edges", path("apart.txt")},
                                             {"--block-faces", path("far.txt")}}) {
    std::vector<std::string> all{"distance", path("m.off"), "-s", "0"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Ended ended = run_program(all);
    EXPECT_EQ(ended.code, 2) << arguments[0] << " " << arguments[1] << ended.err;
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  }
}

TEST_F(Walls, EveryVerbOfDistancesTakesThem) {
  const std::string edges = path("edges.txt");
  EXPECT_EQ(run_program(
                {"isolines", path("m.off"), "-s", "1", "--levels", "1.5", "-o", path("l.json"), "--block-edges", edges})
                .code,
            0);
  EXPECT_EQ(run_program({"isolines", path("m.off"), "-s", "1", "--levels", "1.5", "--chord-error", "1e-3", "-o",
                         path("c.json"), "--block-edges", edges})
                .code,
            0);
  ASSERT_EQ(run_program({"matrix", path("m.off"), "--rows", "1", "--dtype", "float64", "-m", "exact", "-o",
                         path("matrix.npy"), "--block-edges", edges})
                .code,
            0);
  EXPECT_EQ(read_npy(path("matrix.npy")).values, distances({"-s", "1", "--block-edges", edges}));
  EXPECT_EQ(run_program({"render", path("m.off"), "-s", "1", "--mask", path("mask.txt"), "-o", path("p.png")}).code, 0);
  const Ended refused = run_program({"compare", path("d.npy"), path("d.npy"), "--mask", path("mask.txt")});
  EXPECT_EQ(refused.code, 2);
}

TEST_F(Walls, VoronoiTellsCellsAndWritesBorders) {
  const Ended ended =
      run_program({"voronoi", path("m.off"), "-s", "5,9", "--borders", path("b.json"), "-o", path("c.npy")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out.substr(0, 5), "5: 4,") << ended.out;
  EXPECT_NE(content("b.json").find("\"length\""), std::string::npos);
  const Ended weighted = run_program({"voronoi", path("m.off"), "-s", "5@1", "-s", "9", "--json"});
  EXPECT_EQ(weighted.code, 0) << weighted.err;
  EXPECT_NE(weighted.out.find("\"dual\""), std::string::npos);
  EXPECT_NE(weighted.out.find("\"borders\""), std::string::npos);
}

TEST_F(Walls, SamplesCanBeReadBackAsSources) {
  const Ended ended = run_program({"sample", path("m.off"), "--count", "3", "--method", "exact"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out.substr(0, 5), "0\n14\n") << ended.out;
  const Ended lloyd = run_program({"sample", path("m.off"), "--count", "2", "--lloyd", "--quiet"});
  EXPECT_EQ(lloyd.code, 0) << lloyd.err;
  EXPECT_EQ(lloyd.out.substr(0, 2), "f:");
  write("sites.txt", lloyd.out);
  EXPECT_EQ(run_program({"voronoi", path("m.off"), "--sources", path("sites.txt")}).code, 0);
  EXPECT_EQ(run_program({"sample", path("m.off")}).code, 2);
  EXPECT_EQ(run_program({"sample", path("m.off"), "--count", "2", "--rounds", "3"}).code, 2);
}

TEST_F(Walls, MeasureProvesDiameterAndCentre) {
  const Ended ended = run_program({"measure", path("m.off"), "--json"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("\"diameter_lower\": 4.4721359"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("\"centre\": 7"), std::string::npos) << ended.out;
  EXPECT_NE(run_program({"measure", path("m.off")}).out.find("diameter: 4.47214 .. 4.47214"), std::string::npos);
  ASSERT_EQ(run_program({"measure", path("m.off"), "--of", "eccentricity", "-m", "exact", "-o", path("e.npy")}).code,
            0);
  EXPECT_NEAR(read_npy(path("e.npy")).values[7], std::sqrt(5), 1e-12);
  ASSERT_EQ(run_program({"measure", path("m.off"), "--of", "disc-area", "--share", "0.5", "-o", path("a.npy")}).code,
            0);
  EXPECT_NEAR(read_npy(path("a.npy")).values[7], 4, 1e-9);
  EXPECT_EQ(run_program({"measure", path("m.off"), "--of", "disc-area", "-o", path("a.npy")}).code, 2);
  EXPECT_EQ(run_program({"measure", path("m.off"), "-o", path("a.npy")}).code, 2);
}

TEST_F(Walls, ParcelsHaveTheDistancesOfTheirVertices) {
  write("labels.txt", "1 1 0 2 2\n1 1 0 2 2\n1 1 0 2 2\n");
  const Ended ended = run_program({"parcels", path("m.off"), path("labels.txt"), "-m", "dijkstra", "--ignore", "0"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out, "parcel,1,2\n1,0,2\n2,2,0\n");
  ASSERT_EQ(run_program(
                {"parcels", path("m.off"), path("labels.txt"), "-m", "exact", "--distance", "max", "-o", path("p.npy")})
                .code,
            0);
  const NpyArray p = read_npy(path("p.npy"));
  EXPECT_EQ(p.shape, (std::vector<std::size_t>{3, 3}));
  EXPECT_NEAR(p.values[1 * 3 + 2], std::sqrt(20), 1e-12);
  EXPECT_EQ(run_program({"parcels", path("m.off"), path("labels.txt"), "--ignore", "cuneus"}).code, 2);
}

TEST_F(Walls, SmoothKeepsToTheMask) {
  write("f.txt", "1 1 1 9 9\n1 1 1 9 9\n1 1 1 9 9\n");
  ASSERT_EQ(run_program({"smooth", path("m.off"), path("f.txt"), "--sigma", "2", "--mask", path("mask.txt"), "-o",
                         path("s.npy")})
                .code,
            0);
  const std::vector<double> smooth = read_npy(path("s.npy")).values;
  EXPECT_NEAR(smooth[0], 1, 1e-12);
  EXPECT_NEAR(smooth[2], 1, 1e-12);
  EXPECT_EQ(smooth[3], kInf);
  EXPECT_EQ(run_program({"smooth", path("m.off"), path("f.txt"), "-o", path("s.npy")}).code, 2);
  ASSERT_EQ(run_program({"smooth", path("m.off"), path("f.txt"), "--fwhm", "2", "-o", path("w.npy")}).code, 0);
  const std::vector<double> whole = read_npy(path("w.npy")).values;
  EXPECT_GT(whole[2], 1.5);
}

}  // namespace
}  // namespace brushfire::test
