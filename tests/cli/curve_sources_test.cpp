// --source boundary, path:A,B, chain:..., region:FILE:LABEL and files of curves.
#include "in_folder.h"
#include "program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace brushfire::test {
namespace {

// A plane of 4 x 3 unit squares; vertex y * 5 + x.
class CurveSources : public InFolder {
 protected:
  void SetUp() override { write_squares("plane.off", 4, 3); }

  Ended run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin() + 1, path("plane.off"));
    return run_program(arguments);
  }

  struct Row {
    double distance;
    int source;
  };
  // What --source says, for every vertex.
  std::vector<Row> field(std::vector<std::string> sources) const {
    std::vector<std::string> words{"distance", "-m", "exact", "-q", "-o", "-"};
    for (const std::string& s : sources) words.insert(words.end(), {"--source", s});
    const Ended ended = run(words);
    EXPECT_EQ(ended.code, 0) << ended.err;
    std::istringstream lines(ended.out);
    std::string line;
    std::getline(lines, line);
    std::vector<Row> rows;
    while (std::getline(lines, line)) {
      const std::size_t first = line.find(','), second = line.find(',', first + 1);
      rows.push_back({std::stod(line.substr(first + 1)), std::stoi(line.substr(second + 1))});
    }
    EXPECT_EQ(rows.size(), 20u);
    return rows;
  }

  template <class Expected>
  void expect(const std::vector<std::string>& sources, Expected&& expected) const {
    const std::vector<Row> rows = field(sources);
    for (int v = 0; v < static_cast<int>(rows.size()); ++v) {
      EXPECT_NEAR(rows[static_cast<std::size_t>(v)].distance, expected(v % 5, v / 5), 1e-12)
          << sources.front() << " vertex " << v;
    }
  }

  void expect_refused(const std::vector<std::string>& words, int code, const std::string& says) const {
    const Ended ended = run(words);
    EXPECT_EQ(ended.code, code) << ended.err;
    EXPECT_NE(ended.err.find(says), std::string::npos) << ended.err;
  }
};

double to_boundary(int x, int y) { return std::min({x, y, 4 - x, 3 - y}); }
double to_bottom(int, int y) { return y; }

TEST_F(CurveSources, BoundariesByTheNamesThatInfoLists) {
  EXPECT_NE(run({"info"}).out.find("boundary:0"), std::string::npos);
  expect({"boundary"}, to_boundary);
  expect({"boundary:0"}, to_boundary);
  expect({"boundary@0.5"}, [](int x, int y) { return to_boundary(x, y) + 0.5; });
  expect_refused({"distance", "--source", "boundary:1"}, 2, "the mesh has 1 boundary curve");
}

TEST_F(CurveSources, PathsAndChains) {
  expect({"path:0,4"}, to_bottom);
  expect({"path:0,at:2,0,0,4"}, to_bottom);
  expect({"path:f:0:1,0,0,at:4,0,0"}, to_bottom);
  expect({"chain:0,1,2,3,4"}, to_bottom);
  expect({"chain:0,1,2,3,4,9,14,19,18,17,16,15,10,5,0"}, to_boundary);
  expect_refused({"distance", "--source", "chain:0,2"}, 2, "'chain:0,2': no edge joins vertices 0 and 2");
  expect_refused({"distance", "--source", "chain:0,99"}, 2, "there is no vertex 99");
  expect_refused({"distance", "--source", "path:0"}, 2, "a path has two ends");
}

TEST_F(CurveSources, RegionsByLabelsOfVerticesAndOfFaces) {
  std::string vertices, faces;
  for (int v = 0; v < 20; ++v) vertices += v < 10 ? "7\n" : "3\n";
  for (int f = 0; f < 24; ++f) faces += f < 8 ? "7\n" : "3\n";
  write("vertices.txt", vertices);
  write("faces.txt", faces);
  const auto above_one = [](int, int y) { return std::max(0, y - 1); };
  expect({"region:" + path("vertices.txt") + ":7"}, above_one);
  expect({"region:" + path("faces.txt") + ":7"}, above_one);
  expect({"region:" + path("faces.txt") + ":3,7"}, [](int, int) { return 0; });
  expect_refused({"distance", "--source", "region:" + path("faces.txt") + ":4"}, 2, "an empty region");
  write("few.txt", "1\n2\n");
  expect_refused({"distance", "--source", "region:" + path("few.txt") + ":1"}, 2, "2 values, but the mesh has 20");
}

TEST_F(CurveSources, WhatWasWrittenIsReadBack) {
  for (const char* name : {"way.csv", "way.json", "way.obj", "way.ply", "way.vtp"}) {
    EXPECT_EQ(run({"path", "--from", "0", "--to", "4", "-o", path(name), "-q"}).code, 0);
    expect({path(name)}, to_bottom);
  }
}

TEST_F(CurveSources, IsolinesAreSourcesOneEach) {
  EXPECT_EQ(run({"isolines", "--source", "path:0,4", "--levels", "1,2", "-o", path("lines.json"), "-q"}).code, 0);
  const std::vector<Row> rows = field({path("lines.json"), "0"});
  EXPECT_NEAR(rows[9].distance, 0, 1e-12);
  EXPECT_NEAR(rows[19].distance, 1, 1e-12);
  EXPECT_EQ(rows[9].source, 0);
  EXPECT_EQ(rows[19].source, 1);
  EXPECT_EQ(rows[0].source, 2);
}

TEST_F(CurveSources, CurvesOffTheSurfaceArePutOntoItAndTheGapIsTold) {
  write("air.obj", "v 0 0 0.25\nv 4 0 0.75\nl 1 2\n");
  expect({path("air.obj")}, to_bottom);
  const Ended told = run({"distance", "--source", path("air.obj"), "-o", path("d.npy")});
  EXPECT_NE(told.err.find("is up to 0.75 from the surface (the mesh is 5 across): its nearest points were taken"),
            std::string::npos)
      << told.err;
  expect_refused({"distance", "--source", path("air.obj"), "--snap-within", "0.5"}, 2,
                 "farther than --snap-within 0.5");
  EXPECT_NE(run({"distance", "--source", path("air.obj"), "--json"}).out.find("\"max_snap_distance\": 0.75"),
            std::string::npos);
}

TEST_F(CurveSources, WhereOnePlaceIsNeededCurvesAreRefusedByName) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"distance", "--source", "0", "--target", "boundary"},
                                             {"matrix", "--source", "boundary", "-o", path("m.npy")},
                                             {"log-map", "--source", "boundary", "-o", path("u.csv")},
                                             {"sample", "--source", "boundary", "--count", "2"},
                                             {"path", "--from", "0", "--to", "boundary"},
                                             {"path", "--from", "boundary", "--to", "7", "--method", "dijkstra"}}) {
    expect_refused(words, 2, "curve");
  }
}

TEST_F(CurveSources, PathsLeadToCurvesAndPicturesShowThem) {
  const Ended way = run({"path", "--from", "boundary", "--to", "at:2,1.5,0"});
  EXPECT_EQ(way.code, 0) << way.err;
  EXPECT_NEAR(std::stod(way.out), 1.5, 1e-12);
  EXPECT_EQ(run({"render", "--source", "boundary", "--size", "64x48", "-o", path("p.png"), "-q"}).code, 0);
}

TEST_F(CurveSources, AFileOfCurvesIsNoListOfSourcesAndIsToldSo) {
  write("way.obj", "v 0 0 0\nv 4 0 0\nl 1 2\n");
  expect_refused({"distance", "--sources", path("way.obj")}, 2,
                 "a file of curves is a source by its name: --source " + path("way.obj"));
  write("places.csv", "7\nnose\n");
  const Ended ended = run({"distance", "--sources", path("places.csv")});
  EXPECT_EQ(ended.err.find("a file of curves"), std::string::npos) << ended.err;
}

TEST_F(CurveSources, StandInFilesOfSourcesBesidePlaces) {
  write("list.txt", "boundary:0@1  # the rim\n7\n");
  const Ended ended = run({"distance", "--sources", path("list.txt"), "-m", "exact", "--target", "7", "--target", "0"});
  EXPECT_EQ(ended.out, "0\n1\n") << ended.err;
}

TEST_F(CurveSources, HaveALeftThatIsNegative) {
  const Ended ended = run({"distance", "--source", "chain:2,7,12,17", "--signed", "-q", "-o", path("s.csv")});
  ASSERT_EQ(ended.code, 0) << ended.err;
  std::istringstream lines(content("s.csv"));
  std::string line;
  std::getline(lines, line);
  for (int v = 0; v < 20; ++v) {
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_NEAR(std::stod(line.substr(line.find(',') + 1)), v % 5 - 2, 1e-12) << line;
  }
  expect_refused({"distance", "--source", "chain:2,7", "--signed", "--method", "windows"}, 2, "--signed is exact");
  expect_refused({"distance", "--source", "chain:2,7", "--signed", "--target", "0"}, 2, "--signed: not with --target");
  expect_refused({"distance", "--source", "3", "--signed"}, 2, "is a point");
}

}  // namespace
}  // namespace brushfire::test
