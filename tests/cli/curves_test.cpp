// The verbs path, isolines and render as black boxes.
#include "in_folder.h"
#include "program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace brushfire::test {
namespace {

class Curves : public InFolder {
 protected:
  void SetUp() override {
    write("islands.off", "OFF\n7 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n3 0 1 2\n3 0 2 3\n3 4 5 6\n");
  }
  Ended run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin() + 1, path("islands.off"));
    return run_program(arguments);
  }
};

TEST_F(Curves, PathPrintsItsLength) {
  const Ended ended = run({"path", "--from", "1", "--to", "3"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_NEAR(std::stod(ended.out), std::sqrt(2.0), 1e-15);
  EXPECT_EQ(ended.err, "");
}

TEST_F(Curves, PathBetweenPositionsIsWritten) {
  const Ended ended = run({"path", "--from", "at:0.25,0.1,3", "--to", "at:0.25,0.9,0", "-o", path("p.obj")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(content("p.obj").find("v 0.25 0.1 0\n"), std::string::npos);
  EXPECT_NE(content("p.obj").find("\nl 1 2"), std::string::npos);
}

TEST_F(Curves, PathToAnotherIslandIsUnreachable) {
  const Ended ended = run({"path", "--from", "0", "--to", "5"});
  EXPECT_EQ(ended.code, 4);
  EXPECT_NE(ended.err.find("'5'"), std::string::npos);
}

TEST_F(Curves, TightenedPathForgetsItsWaypoint) {
  EXPECT_EQ(run({"path", "--from", "1", "--via", "0", "--to", "3"}).out, "2\n");
  const Ended tight = run({"path", "--from", "1", "--via", "0", "--to", "3", "--tighten"});
  EXPECT_NEAR(std::stod(tight.out), std::sqrt(2.0), 1e-15);
}

TEST_F(Curves, PathAlongEdgesGoesRoundTheSquare) {
  EXPECT_EQ(run({"path", "--from", "1", "--to", "3", "--method", "dijkstra"}).out, "2\n");
}

TEST_F(Curves, MethodWithoutPathsIsAUsageError) {
  const Ended ended = run({"path", "--from", "1", "--to", "3", "--method", "kimmel-sethian"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("exact and dijkstra have"), std::string::npos);
}

TEST_F(Curves, PathNeedsBothEnds) {
  EXPECT_EQ(run({"path", "--from", "1"}).code, 2);
  EXPECT_EQ(run({"path", "--to", "1"}).code, 2);
  EXPECT_EQ(run({"path", "--from", "1", "--to", "3", "-o", path("p.xyz")}).code, 2);
  EXPECT_EQ(run({"path", "--from", "1", "--to", "3", "--view", "below", "-o", path("p.svg")}).code, 2);
  EXPECT_EQ(run({"path", "--from", "1", "--to", "99"}).code, 2);
}

TEST_F(Curves, IsolinesAreWrittenWithTheirLevels) {
  const Ended ended = run({"isolines", "--source", "0", "--levels", "0.5,0.25", "-o", path("l.csv")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const std::string csv = content("l.csv");
  EXPECT_NE(csv.find("line,level,point,x,y,z,face,w0,w1,w2,closed\n0,0.25,"), std::string::npos);
  EXPECT_NE(csv.find("\n1,0.5,"), std::string::npos);
}

TEST_F(Curves, CurvedIsolinesHaveMoreNodesThanStraightOnes) {
  EXPECT_EQ(run({"isolines", "--source", "0", "--levels", "0.5", "-o", path("a.csv"), "-q"}).err, "");
  EXPECT_EQ(run({"isolines", "--source", "0", "--levels", "0.5", "--chord-error", "1e-5", "-o", path("b.csv")}).code,
            0);
  EXPECT_GT(content("b.csv").size(), 5 * content("a.csv").size());
}

TEST_F(Curves, IsolinesAskForExactlyOneWayToChooseLevels) {
  EXPECT_EQ(run({"isolines", "--source", "0", "-o", path("l.obj")}).code, 2);
  EXPECT_EQ(run({"isolines", "--source", "0", "--count", "3", "--every", "1", "-o", path("l.obj")}).code, 2);
  EXPECT_EQ(run({"isolines", "--source", "0", "--levels", "1,,2", "-o", path("l.obj")}).code, 2);
  EXPECT_EQ(run({"isolines", "--source", "0", "--every", "0", "-o", path("l.obj")}).code, 2);
  EXPECT_EQ(run({"isolines", "--count", "3", "-o", path("l.obj")}).code, 2);
}

TEST_F(Curves, OfSeveralSourcesThePathComesFromTheNearest) {
  write("exits.txt", "0\n4\n");
  const Ended ended =
      run({"path", "--sources", path("exits.txt"), "--to", "1", "--to", "5", "-o", path("p.csv"), "--json"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("\"to\": \"1\",\n      \"source\": 0,\n      \"length\": 1.0"), std::string::npos)
      << ended.out;
  EXPECT_NE(ended.out.find("\"to\": \"5\",\n      \"source\": 1,\n      \"length\": 1.0"), std::string::npos)
      << ended.out;
  EXPECT_NE(content("p.csv").find("\n1,1,0,5,0,0,"), std::string::npos) << content("p.csv");
  EXPECT_EQ(run({"path", "-s", "0", "-t", "2", "-t", "5"}).out, "1.4142135623730951\ninf\n");
}

TEST_F(Curves, APathThatIsLongerThanTheRadiusIsNone) {
  EXPECT_EQ(run({"path", "--from", "1", "--to", "3", "--radius", "1.5"}).code, 0);
  for (const std::vector<std::string>& way :
       std::vector<std::vector<std::string>>{{"--to", "3", "--radius", "1.4"},
                                             {"--to", "3", "--via", "0", "--radius", "1.9"},
                                             {"--to", "3", "--method", "dijkstra", "--radius", "1.9"}}) {
    std::vector<std::string> arguments{"path", "--from", "1"};
    arguments.insert(arguments.end(), way.begin(), way.end());
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.code, 4);
    EXPECT_EQ(ended.err, "brushfire: no source reaches '3' within the radius\n");
  }
}

TEST_F(Curves, LevelsOutsideOfTheRangeAreToldWithIt) {
  const Ended ended =
      run({"isolines", "--source", "0", "--levels", "-1,0.5,7", "-o", path("l.csv"), "--unit", "mm", "--json"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.err, "2 levels lie outside of the range: the values run from 0 mm to 1.41421 mm\n");
  EXPECT_NE(ended.out.find("\"greatest\": 1.4142135623730951"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("\"levels_outside\": 2"), std::string::npos) << ended.out;
  EXPECT_EQ(run({"isolines", "--source", "0", "--every", "5", "-o", path("l.csv")}).err,
            "no level: the values run from 0 to 1.41421\n0 curves at 0 levels, 0 long in all\n");
}

TEST_F(Curves, ScalarLeavesNothingToCompute) {
  write("s.txt", "0 1 2 3 4 5 6\n");
  const Ended ended =
      run({"isolines", "--scalar", path("s.txt"), "--radius", "3", "--count", "3", "-o", path("l.csv")});
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.err, "brushfire: --scalar has the values: there is nothing for --radius to compute\n");
}

TEST_F(Curves, RenderTakesWhatOtherVerbsTake) {
  write("exits.txt", "0\n4\n");
  const Ended ended =
      run({"render",       "--sources", path("exits.txt"), "-r",      "0.5",    "--tolerance", "1e-2",   "-m",
           "windows:1e-4", "-m",        "exact",           "--error", "--unit", "mm",          "--weld", "0",
           "--size",       "64x48",     "--samples",       "1",       "-o",     path("p.svg")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(content("p.svg").find(", mm<"), std::string::npos);
  EXPECT_EQ(run({"render", "--tolerance", "1e-2", "-o", path("p.png")}).err,
            "brushfire: --tolerance needs a --source\n");
}

TEST_F(Curves, RenderWritesPngSvgAndAnimation) {
  const std::vector<std::string> small{"--size", "64x48", "--samples", "1"};
  const auto with = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), small.begin(), small.end());
    return run(arguments);
  };
  EXPECT_EQ(with({"render", "--source", "0", "--isolines", "5", "--path", "2", "-o", path("p.png")}).code, 0);
  EXPECT_EQ(content("p.png").substr(1, 3), "PNG");
  EXPECT_EQ(with({"render", "--source", "0", "--isolines", "5", "-o", path("p.svg")}).code, 0);
  EXPECT_EQ(content("p.svg").substr(0, 4), "<svg");
  const Ended wave = with({"render", "--source", "0", "--wave", "3", "-o", path("w.webp")});
  if (wave.err.find("no WebP") != std::string::npos) GTEST_SKIP() << "built without WebP";
  EXPECT_EQ(wave.code, 0) << wave.err;
  EXPECT_EQ(content("w.webp").substr(8, 4), "WEBP");
}

TEST_F(Curves, RenderShowsTheErrorBesideTheFields) {
  const Ended ended = run({"render", "--source", "0", "-m", "dijkstra", "-m", "exact", "--error", "--error-range",
                           "0,50", "--size", "64x48", "--samples", "1", "--json", "-o", path("e.svg")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("\"panels\": 3"), std::string::npos) << ended.out;
  const std::string svg = content("e.svg");
  EXPECT_NE(svg.find(">distance<"), std::string::npos);
  EXPECT_NE(svg.find(">error, %<"), std::string::npos);
}

TEST_F(Curves, AmbientOcclusionDarkensOrSaysWhatItNeeds) {
  const std::vector<std::string> picture{"render", "--source", "0", "--size", "64x48", "-o", path("a.png")};
  std::vector<std::string> shaded = picture;
  shaded.push_back("--ambient-occlusion");
  const Ended ended = run(shaded);
  if (ended.code == 0) return;
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("libembree-dev"), std::string::npos) << ended.err;
}

TEST_F(Curves, RenderRefusesMalformedOptionsBeforeReading) {
  const std::vector<std::vector<std::string>> bad{{"-o", "p.gif"},
                                                  {"-o", "p.png", "--size", "100"},
                                                  {"-o", "p.png", "--size", "0x10"},
                                                  {"-o", "p.png", "--size", "64.5x48"},
                                                  {"-o", "p.png", "--range", "1"},
                                                  {"-o", "p.png", "--view", "above"},
                                                  {"-o", "p.png", "--samples", "2.5"},
                                                  {"-o", "p.png", "--wave", "10"},
                                                  {"-o", "p.webp"},
                                                  {"-o", "p.png", "--path", "3"},
                                                  {"-o", "p.png", "--source", "0", "-m", "exact", "--error"},
                                                  {"-o", "p.png", "--error-range", "0,1"},
                                                  {"-o", "p.png", "--source", "0", "-m", "fast"},
                                                  {"-o", "p.png", "--isolines", "-1", "--source", "0"},
                                                  {"-o", "p.png", "--range", "2,1"},
                                                  {"-o", "p.png", "--zoom", "0"},
                                                  {"-o", "p.png", "--azimuth", "north"},
                                                  {"-o", "p.png", "--elevation", "nan"},
                                                  {"-o", "p.png", "--up", "w"},
                                                  {"-o", "p.png", "--colormap", "jet"},
                                                  {"-o", "p.png", "--size", "20000x100"},
                                                  {"-o", "p.webp", "--turntable", "1"},
                                                  {"-o", "p.webp", "--turntable", "10", "--frame-ms", "0"},
                                                  {"-o", "p.webp", "--turntable", "4", "--wave", "4", "--source", "0"},
                                                  {"-o", "p.png", "--turntable", "4"},
                                                  {"-o", "p.png", "--source", "0", "--path", "nowhere"},
                                                  {"-o", "p.png", "--labels"},
                                                  {"-o", "p.png", "--scalar", "a.npy", "--source", "0"},
                                                  {}};
  for (const std::vector<std::string>& options : bad) {
    std::vector<std::string> arguments{"render"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.code, 2) << testing::PrintToString(options) << ended.err;
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  }
}

}  // namespace
}  // namespace brushfire::test
