// brushfire distance as a black box: what it says and writes, tolerances, targets, radii, sources.
#include "small_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

namespace brushfire::test {
namespace {

TEST_F(Program, DistanceTellsTheResultInWords) {
  const Ended ended = run_program({"distance", path("islands.off"), "--source", "1", "--method", "dijkstra"});
  EXPECT_EQ(ended.code, 0);
  const std::vector<std::string> lines = lines_of(said(ended.out));
  ASSERT_EQ(lines.size(), 4u) << ended.out;
  EXPECT_EQ(lines[0], "islands.off: 8 vertices, 3 faces");
  EXPECT_EQ(lines[1], "dijkstra from 1 source reached 4 vertices, 4 cannot be reached");
  EXPECT_EQ(lines[2], "farthest: vertex 3 at 2");
}

TEST_F(Program, DistanceJsonHasStableKeys) {
  const Ended ended =
      run_program({"distance", path("square.off"), "--source", "0", "--target", "2", "--json", "-m", "dijkstra"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(
      keys_of(ended.out),
      (std::vector<std::string>{
          "schema",          "brushfire",         "file",          "method",      "precision",       "tolerance",
          "bound",           "vertices",          "faces",         "sources",     "radius",          "unit",
          "reached",         "unreachable",       "beyond_radius", "not_visited", "max_error_bound", "max_distance",
          "farthest_vertex", "updates",           "read_s",        "set_up_s",    "solve_s",         "targets",
          "snapped",         "max_snap_distance", "output"}));
}

// The number of a key of the outermost object; NaN where it is none.
double number_of(const std::string& json, const std::string& key) {
  std::smatch match;
  const std::regex pattern("\n  \"" + key + "\": ([-+0-9.e]+)");
  return std::regex_search(json, match, pattern) ? std::stod(match[1]) : std::nan("");
}

TEST_F(Program, AToleranceIsKeptAndItsProofIsReported) {
  run_program({"shape", "folded-sphere", "-n", "2000", "-o", path("mesh.ply"), "-q"});
  run_program({"distance", path("mesh.ply"), "-s", "0", "-m", "exact", "-o", path("exact.npy"), "-q"});
  for (const auto& [level, tolerance] : {std::pair{"draft", 1e-2}, {"standard", 1e-3}, {"fine", 1e-5}, {"exact", 0.}}) {
    const Ended ended =
        run_program({"distance", path("mesh.ply"), "-s", "0", "--tolerance", level, "-o", path("field.npy"), "--json"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_NE(ended.out.find("\"method\": \"windows\""), std::string::npos) << ended.out;
    EXPECT_EQ(number_of(ended.out, "tolerance"), tolerance) << ended.out;
    EXPECT_LE(number_of(ended.out, "max_error_bound"), tolerance + 1e-11) << level;
    const Ended compared = run_program({"compare", path("field.npy"), path("exact.npy"), "--json"});
    EXPECT_LE(number_of(compared.out, "max_relative"), tolerance + 1e-11) << level;
  }
}

TEST_F(Program, BoundsAreOnTheirSideOfTheTruth) {
  run_program({"shape", "folded-sphere", "-n", "2000", "-o", path("mesh.ply"), "-q"});
  const auto target = [&](const std::vector<std::string>& how) {
    std::vector<std::string> arguments{"distance", path("mesh.ply"), "-s", "0", "-t", "1234"};
    arguments.insert(arguments.end(), how.begin(), how.end());
    return std::stod(run_program(arguments).out);
  };
  const double truth = target({"-m", "exact"}), rounding = 1e-12 * truth;
  EXPECT_LE(target({"--bound", "lower", "--tolerance", "0.01"}), truth + rounding);
  EXPECT_GE(target({"--bound", "upper", "--tolerance", "0.01"}), truth - rounding);
}

TEST_F(Program, AToleranceThatNobodyKeepsIsAUsageError) {
  const auto expect = [&](std::vector<std::string> options, const std::string& line) {
    options.insert(options.begin(), {"distance", path("missing.off"), "-s", "0"});
    expect_error(options, 2, line);
  };
  expect({"--tolerance", "1e-3", "-m", "dijkstra"},
         "brushfire: --tolerance: dijkstra has no tolerance to set; --method windows has");
  expect({"--bound", "upper", "-m", "exact"},
         "brushfire: --bound: exact has no tolerance to set; --method windows has");
  const std::string takes = "brushfire: --tolerance takes a number from 0 to 0.1, draft, standard, fine or exact, not ";
  expect({"--tolerance", "0.2"}, takes + "'0.2'");
  expect({"--tolerance", "nan"}, takes + "'nan'");
  expect({"--tolerance", "coarse"}, takes + "'coarse'");
  expect({"--method", "windows:coarse"}, "brushfire: 'windows:coarse': a tolerance" + takes.substr(22) + "'coarse'");
}

TEST_F(Program, WordsForTolerancesHaveASecondName) {
  const auto field = [&](const std::vector<std::string>& how) {
    std::vector<std::string> words{"distance", path("square.off"), "--source", "0", "-o", "-"};
    words.insert(words.end(), how.begin(), how.end());
    const Ended ended = run_program(words);
    EXPECT_EQ(ended.code, 0) << ended.err;
    return ended.err.substr(0, ended.err.find("read in"));
  };
  const std::string fine = field({"--tolerance", "fine"});
  EXPECT_NE(fine.find("asked for: 0.001 %"), std::string::npos) << fine;
  EXPECT_EQ(field({"--accuracy", "fine"}), fine);
  EXPECT_EQ(field({"--tolerance", "1e-5"}), fine);
  EXPECT_EQ(field({"--method", "windows:fine"}), fine);
}

TEST_F(Program, DistanceIsTheSameToTheBitForAnyNumberOfThreads) {
  const auto field = [&](const std::string& threads) {
    const Ended ended = run_program({"distance", path("square.off"), "--source", "0", "-o", "-", "--threads", threads});
    EXPECT_EQ(ended.code, 0) << ended.err;
    return ended.out;
  };
  const std::string one = field("1");
  EXPECT_FALSE(one.empty());
  for (const char* threads : {"0", "2", "7"}) EXPECT_EQ(field(threads), one) << threads << " threads";
  for (const char* threads : {"-1", "1.5", "many", "5000"}) {
    const Ended ended = run_program({"distance", "missing.ply", "--source", "0", "--threads", threads});
    EXPECT_EQ(ended.code, 2) << "said before the file is read: " << ended.err;
    EXPECT_NE(ended.err.find("--threads"), std::string::npos);
  }
}

TEST_F(Program, TargetsPrintOneDistancePerLine) {
  const Ended ended =
      run_program({"distance", path("square.off"), "--source", "0", "-t", "1", "-t", "2", "-m", "dijkstra"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.out, "1\n1.4142135623730951\n");
}

TEST_F(Program, UnreachableTargetPrintsInfAndEndsWithFour) {
  const Ended ended = run_program(
      {"distance", path("islands.off"), "--source", "0", "--target", "1", "--target", "5", "-m", "dijkstra"});
  EXPECT_EQ(ended.code, 4);
  EXPECT_EQ(ended.out, "1\ninf\n");
  EXPECT_EQ(ended.err, "brushfire: no source reaches '5'\n");
}

TEST_F(Program, OffsetsAndTheSourcesFileAreUsed) {
  write("sources.txt", "# two corners\n0@0.25\n\n2  # the far one\n");
  const Ended ended = run_program({"distance", path("square.off"), "--sources", path("sources.txt"), "-t", "0", "-t",
                                   "1", "-t", "2", "-m", "dijkstra"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out, "0.25\n1\n0\n");
}

TEST_F(Program, RadiusCutsOff) {
  const Ended ended =
      run_program({"distance", path("square.off"), "--source", "0", "--radius", "1.2", "--json", "-m", "dijkstra"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_NE(ended.out.find("\"reached\": 3,"), std::string::npos) << ended.out;
}

// On the islands: 4 vertices hang together with vertex 0, 3 with one another, 1 is in no face.
TEST_F(Program, JsonTellsWhatNobodyWentToFromWhatNobodyCanReach) {
  run_program({"shape", "plane", "-n", "10000", "-o", path("plane.ply"), "-q"});
  for (const char* method : {"windows", "exact", "novotni-klein", "kimmel-sethian", "dijkstra"}) {
    const Ended whole = run_program({"distance", path("islands.off"), "-s", "0", "-m", method, "--json"});
    EXPECT_EQ(number_of(whole.out, "unreachable"), 4) << method;
    EXPECT_EQ(number_of(whole.out, "not_visited"), 0) << method;
    const Ended disc = run_program({"distance", path("islands.off"), "-s", "0", "-m", method, "--json", "-r", "0.5"});
    EXPECT_EQ(number_of(disc.out, "reached"), 1) << method;
    EXPECT_EQ(number_of(disc.out, "unreachable"), 4) << method;
    EXPECT_EQ(number_of(disc.out, "beyond_radius") + number_of(disc.out, "not_visited"), 3) << method;
    const Ended small = run_program({"distance", path("plane.ply"), "-s", "0", "-m", method, "--json", "-t", "1"});
    EXPECT_EQ(number_of(small.out, "unreachable"), 0) << method;
    EXPECT_GT(number_of(small.out, "not_visited"), method == std::string("dijkstra") ? -1 : 9000) << method;
    EXPECT_EQ(
        number_of(small.out, "reached") + number_of(small.out, "not_visited") + number_of(small.out, "beyond_radius"),
        number_of(small.out, "vertices"))
        << method;
  }
}

TEST_F(Program, AFieldInJsonSaysWhereNobodyWentAndConvertKeepsIt) {
  run_program({"distance", path("islands.off"), "-s", "0", "-r", "0.5", "-o", path("disc.json"), "-q"});
  const std::string expected = "\"not_visited\": [1, 2, 3]}";
  EXPECT_NE(content("disc.json").find(expected), std::string::npos) << content("disc.json");
  EXPECT_EQ(run_program({"convert", path("disc.json"), path("copy.json"), "-q"}).code, 0);
  EXPECT_NE(content("copy.json").find(expected), std::string::npos) << content("copy.json");
  run_program({"distance", path("islands.off"), "-s", "0", "-o", path("whole.json"), "-q"});
  EXPECT_EQ(content("whole.json").find("not_visited"), std::string::npos) << content("whole.json");
}

TEST_F(Program, ATargetBeyondTheRadiusIsToldFromOneThatCannotBeReached) {
  const Ended ended = run_program(
      {"distance", path("islands.off"), "-s", "0", "-t", "2", "-t", "5", "-t", "7", "--radius", "0.5", "--json"});
  EXPECT_EQ(ended.code, 4);
  EXPECT_EQ(ended.err, "brushfire: no source reaches '2' within the radius\n");
  const auto target = [&](const std::string& where) {
    return ended.out.substr(ended.out.find("\"where\": \"" + where + "\""), 80);
  };
  EXPECT_NE(target("2").find("\"unreachable\": false"), std::string::npos) << ended.out;
  EXPECT_NE(target("5").find("\"unreachable\": true"), std::string::npos) << ended.out;
  EXPECT_NE(target("7").find("\"unreachable\": true"), std::string::npos) << ended.out;
}

TEST_F(Program, TheUnitIsToldWithEveryLength) {
  const Ended words = run_program({"distance", path("square.off"), "-s", "0", "--unit", "cm"});
  EXPECT_NE(words.out.find("farthest: vertex 2 at 1.41421 cm\n"), std::string::npos) << words.out;
  EXPECT_NE(
      run_program({"distance", path("square.off"), "-s", "0", "--json", "--unit", "in"}).out.find("\"unit\": \"in\""),
      std::string::npos);
  const Ended info = run_program({"info", path("square.off"), "--unit", "mm"});
  EXPECT_NE(info.out.find("mean 1.08284 mm\n"), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("1 mm^2\n"), std::string::npos) << info.out;
}

TEST_F(Program, ReadsStandardInput) {
  const Ended ended = run_program({"distance", "-", "--source", "0", "--target", "1", "-m", "dijkstra"},
                                  {.input = "OFF\n3 1 0\n0 0 0\n2 0 0\n0 1 0\n3 0 1 2\n"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out, "2\n");
}

TEST_F(Program, PositionsAreSnappedToTheSurface) {
  const Ended ended =
      run_program({"distance", path("square.off"), "-s", "at:-1,-1,5", "-t", "at:3,0,0", "-m", "dijkstra"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out, "1\n");
}

}  // namespace
}  // namespace brushfire::test
