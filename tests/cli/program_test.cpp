// The program as a black box: exit codes, the two streams, the one line of every error, the keys of the JSON.
#include "program.h"
#include "in_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>

namespace brushfire::test {
namespace {

namespace fs = std::filesystem;

// A unit square, and the same with a second component and a lone vertex.
class Program : public InFolder {
 protected:
  void SetUp() override {
    write("square.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
    write("islands.off",
          "OFF\n8 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n9 9 9\n3 0 1 2\n3 0 2 3\n3 4 5 6\n");
  }

  // What the program said, with the test's folder taken out.
  std::string said(const std::string& text) const {
    std::string out = text;
    const std::string folder = path("");
    for (std::size_t at; (at = out.find(folder)) != std::string::npos;) out.erase(at, folder.size());
    return out;
  }

  void expect_error(const std::vector<std::string>& arguments, int code, const std::string& line) const {
    const Ended ended = run_program(arguments);
    EXPECT_EQ(ended.code, code);
    EXPECT_FALSE(ended.killed);
    EXPECT_EQ(said(ended.err), line + "\n");
    EXPECT_EQ(ended.out, "");
  }
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    lines.push_back(text.substr(begin, end - begin));
  }
  return lines;
}

// The keys of the outermost object, in order, of JSON that is indented by two.
std::vector<std::string> keys_of(const std::string& json) {
  std::vector<std::string> keys;
  const std::regex key("^  \"([a-z_0-9]+)\":.*");
  for (const std::string& line : lines_of(json)) {
    std::smatch match;
    if (std::regex_match(line, match, key)) keys.push_back(match[1]);
  }
  return keys;
}

TEST_F(Program, WithoutArgumentsPrintsHelpAndSucceeds) {
  const Ended ended = run_program({});
  EXPECT_EQ(ended.code, 0);
  EXPECT_NE(ended.out.find("Usage: brushfire"), std::string::npos);
  EXPECT_NE(ended.out.find("Exit codes: 0 done"), std::string::npos);
  EXPECT_EQ(ended.err, "");
  EXPECT_EQ(run_program({"--help"}).out, ended.out);
}

TEST_F(Program, VersionIsOneLine) {
  const Ended ended = run_program({"--version"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_TRUE(std::regex_match(ended.out, std::regex("brushfire [0-9]+\\.[0-9]+\\.[0-9]+\n"))) << ended.out;
}

TEST_F(Program, HelpOfEveryVerbHasExamplesAndFitsTheTerminal) {
  for (const char* verb : {"info", "distance", "path", "isolines", "matrix", "compare", "certify", "render", "bench",
                           "convert", "shape", "completion", "manual"}) {
    const Ended ended = run_program({verb, "--help"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_NE(ended.out.find("Examples:\n"), std::string::npos) << verb;
    for (const std::string& line : lines_of(ended.out)) EXPECT_LE(line.size(), 120u) << line;
  }
}

TEST_F(Program, InfoTellsTheCounts) {
  const Ended ended = run_program({"info", path("islands.off")});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(said(ended.out),
            "islands.off (OFF)\n"
            "  vertices              8\n"
            "  faces                 3\n"
            "  edges                 8\n"
            "  components            2\n"
            "  Euler characteristic  2\n"
            "  edge length           1 .. 1.41421, mean 1.10355\n"
            "  area                  1.5\n"
            "  boundary:0            closed, 4 long, from vertex 0\n"
            "  boundary:1            closed, 3.41421 long, from vertex 4\n"
            "  - 2 components: distances between them are infinite\n"
            "  - 1 vertex is in no face and cannot be reached\n"
            "  - 7 boundary edges\n");
}

TEST_F(Program, InfoJsonHasStableKeys) {
  const Ended ended = run_program({"info", path("square.off"), "--json"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(keys_of(ended.out), (std::vector<std::string>{"schema",
                                                          "brushfire",
                                                          "file",
                                                          "format",
                                                          "unit",
                                                          "vertices",
                                                          "faces",
                                                          "edges",
                                                          "components",
                                                          "euler_characteristic",
                                                          "boundary_edges",
                                                          "nonmanifold_edges",
                                                          "nonmanifold_vertices",
                                                          "misoriented_edges",
                                                          "isolated_vertices",
                                                          "zero_area_faces",
                                                          "zero_length_edges",
                                                          "repeated_index_faces",
                                                          "duplicate_faces",
                                                          "duplicate_positions",
                                                          "near_positions",
                                                          "near_tolerance",
                                                          "looks_like_soup",
                                                          "min_edge_length",
                                                          "mean_edge_length",
                                                          "max_edge_length",
                                                          "area",
                                                          "boundaries",
                                                          "remarks"}));
}

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

TEST_F(Program, TheExtensionDecidesWhatIsWrittenAndTheTalkGoesToStderr) {
  for (const char* extension : {"ply", "vtk", "vtp", "obj", "npy", "csv", "json"}) {
    const std::string file = path(std::string("field.") + extension);
    const Ended ended = run_program({"distance", path("square.off"), "-s", "0", "-o", file});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(lines_of(ended.err).size(), 5u) << ended.err;
    EXPECT_GT(fs::file_size(file), 0u);
    EXPECT_EQ(run_program({"distance", path("square.off"), "-s", "0", "-o", file, "--quiet"}).err, "");
  }
  const Ended csv = run_program({"distance", path("square.off"), "-s", "0", "-o", "-", "-q", "-m", "dijkstra"});
  EXPECT_EQ(csv.out, "vertex,distance,source\n0,0,0\n1,1,0\n2,1.4142135623730951,0\n3,1,0\n");
}

TEST_F(Program, UnreachableVerticesReadInfInFiles) {
  const Ended ended = run_program({"distance", path("islands.off"), "-s", "0", "-o", "-", "-q"});
  EXPECT_NE(ended.out.find("\n4,inf,-1\n"), std::string::npos) << ended.out;
}

TEST_F(Program, OutputThatCannotBeWrittenEndsWithOne) {
  expect_error({"distance", path("square.off"), "-s", "0", "-q", "-o", path("no/such/folder/field.npy")}, 1,
               "brushfire: no/such/folder/field.npy: cannot be created: No such file or directory");
  expect_error({"shape", "cube", "-o", "/dev/full.ply/x.ply"}, 1,
               "brushfire: /dev/full.ply/x.ply: cannot be created: No such file or directory");
}

TEST_F(Program, OutputOfUnknownKindIsAUsageErrorBeforeAnythingIsRead) {
  expect_error({"distance", path("missing.off"), "-s", "0", "-o", path("field.foo")}, 2,
               "brushfire: field.foo: nothing is written as 'foo' (known: npy, ply, vtk, vtp, obj, gii, curv, csv, "
               "json)");
  expect_error({"distance", path("square.off"), "-s", "0", "-o", "-", "--json"}, 2,
               "brushfire: only one of -o -, --json and --target can have the standard output");
}

TEST_F(Program, CompareTellsTheErrorsAgainstTheReference) {
  write("a.txt", "0 1.5 3 inf\n");
  write("b.txt", "0 1 4 inf\n");
  const Ended ended = run_program({"compare", path("a.txt"), path("b.txt")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(said(ended.out),
            "a.txt against b.txt: 2 vertices compared\n"
            "                                     mean          rms          max\n"
            "  relative error                    0.375     0.395285          0.5 at vertex 1\n"
            "  absolute error                     0.75     0.790569            1 at vertex 2\n"
            "  mean signed relative error 0.125\n"
            "  1 vertex left out: the reference is 0 there\n"
            "  1 vertex reached by neither\n");
  const Ended json = run_program({"compare", path("a.txt"), path("b.txt"), "--mesh", path("square.off"), "--json"});
  EXPECT_EQ(json.code, 0) << json.err;
  EXPECT_EQ(keys_of(json.out), (std::vector<std::string>{"schema",
                                                         "brushfire",
                                                         "field",
                                                         "reference",
                                                         "mesh",
                                                         "unit",
                                                         "compared",
                                                         "zero_reference",
                                                         "missing",
                                                         "surplus",
                                                         "unreached_in_both",
                                                         "mean_relative",
                                                         "rms_relative",
                                                         "max_relative",
                                                         "max_relative_vertex",
                                                         "mean_signed_relative",
                                                         "mean_absolute",
                                                         "rms_absolute",
                                                         "max_absolute",
                                                         "max_absolute_vertex",
                                                         "max_at_zero_reference",
                                                         "area_weighted_mean_relative",
                                                         "area_weighted_rms_relative",
                                                         "area_weighted_mean_absolute",
                                                         "area_weighted_rms_absolute"}));
  write("short.txt", "0 1 2\n");
  expect_error({"compare", path("short.txt"), path("b.txt")}, 2, "brushfire: short.txt: 3 values, but b.txt has 4");
}

TEST_F(Program, ComparedMethodsAgreeOnAConvexPlane) {
  run_program({"shape", "paper-square", "-o", path("plane.ply")});
  run_program({"distance", path("plane.ply"), "-s", "0", "-m", "exact", "-o", path("exact.npy")});
  run_program({"distance", path("plane.ply"), "-s", "0", "-m", "novotni-klein", "--precision", "float64", "-o",
               path("fast.ply")});
  const Ended ended = run_program({"compare", path("fast.ply"), path("exact.npy"), "--json"});
  std::smatch match;
  ASSERT_TRUE(std::regex_search(ended.out, match, std::regex("\"max_relative\": ([0-9.e-]+)"))) << ended.err;
  EXPECT_LE(std::stod(match[1]), 1e-12);
}

TEST_F(Program, ShapesOfEveryKindAndSizeAreMeshes) {
  for (const char* shape : {"plane", "delaunay-square", "paper-square", "saddle", "terrain", "cube", "sphere",
                            "folded-sphere", "cone", "cylinder", "torus"}) {
    for (const char* vertices : {"1", "100", "5000"}) {
      const Ended ended = run_program({"shape", shape, "-n", vertices, "-o", path("shape.ply")});
      EXPECT_EQ(ended.code, 0) << shape << " " << vertices << ": " << ended.err;
      const Ended distance = run_program({"distance", path("shape.ply"), "-s", "0", "--json"});
      EXPECT_EQ(distance.code, 0) << shape << " " << vertices << ": " << distance.err;
      EXPECT_NE(distance.out.find("\"unreachable\": 0,"), std::string::npos) << shape << " " << vertices;
    }
  }
  expect_error({"shape", "plane", "-n", "0", "-o", path("x.ply")}, 2,
               "brushfire: --vertices takes a number >= 1, not '0'");
  expect_error({"shape", "plane"}, 2, "brushfire: --output is required (see brushfire shape --help)");
}

TEST_F(Program, UsageErrorsEndWithTwoAndOneLine) {
  const std::string mesh = path("square.off");
  expect_error({"frobnicate"}, 2, "brushfire: there is no verb 'frobnicate' (see brushfire --help)");
  expect_error({"info"}, 2, "brushfire: FILE is required (see brushfire info --help)");
  expect_error({"info", mesh, "--colour"}, 2,
               "brushfire: The following argument was not expected: --colour (see brushfire info --help)");
  expect_error({"distance", mesh}, 2, "brushfire: where from? give --source or --sources");
  expect_error({"distance", mesh, "--source"}, 2,
               "brushfire: --source: 1 required PLACE missing (see brushfire distance --help)");
  expect_error({"distance", mesh, "--source", "nose"}, 2,
               "brushfire: 'nose' is no place on a mesh: a vertex is a whole number from 0 up; write a vertex (17), a "
               "face and weights (f:120:.2,.3,.5) or a position (at:1.5,0,-2)");
  expect_error(
      {"distance", mesh, "--source", "-1"}, 2,
      "brushfire: '-1' is no place on a mesh: a vertex is a whole number from 0 up; write a vertex (17), a face "
      "and weights (f:120:.2,.3,.5) or a position (at:1.5,0,-2)");
  expect_error({"distance", mesh, "--source", "4"}, 2, "brushfire: '4': there is no such vertex, the mesh has 4");
  expect_error({"distance", mesh, "--source", "99999999999999999999"}, 2,
               "brushfire: '99999999999999999999': there is no such vertex, the mesh has 4");
  expect_error({"distance", mesh, "--source", "f:2:1,0,0"}, 2,
               "brushfire: 'f:2:1,0,0': there is no such face, the mesh has 2");
  expect_error({"distance", mesh, "--source", "0", "--target", "1@2"}, 2, "brushfire: '1@2': a target has no offset");
  expect_error({"distance", mesh, "--source", "0", "--radius", "-1"}, 2,
               "brushfire: --radius takes a number >= 0 or inf, not '-1'");
  expect_error({"distance", mesh, "--source", "0", "--precision", "half"}, 2,
               "brushfire: --precision: 'half' is none of float32, float64 (see brushfire distance --help)");
  expect_error({"completion", "csh"}, 2,
               "brushfire: shell: 'csh' is none of bash, zsh, fish (see brushfire completion --help)");
  expect_error({"manual", "--verb", "fly"}, 2, "brushfire: --verb: there is no verb 'fly'");
  write("empty.txt", "# nothing\n");
  expect_error({"distance", mesh, "--sources", path("empty.txt")}, 2, "brushfire: empty.txt: no source in this file");
}

TEST_F(Program, UnusableInputEndsWithThree) {
  expect_error({"info", path("missing.off")}, 3, "brushfire: missing.off: no such file");
  expect_error({"info", path("")}, 3, "brushfire: : is a directory");
  write("broken.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 nine 0\n3 0 1 2\n");
  expect_error({"info", path("broken.off")}, 3, "brushfire: broken.off:5: 'nine' where a coordinate is expected");
  write("wrong.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n");
  expect_error({"info", path("wrong.off")}, 3,
               "brushfire: wrong.off:6: face 0 names vertex 3, but there are 3 vertices");
  write("notes.txt", "no mesh at all\n");
  const Ended unknown = run_program({"info", path("notes.txt")});
  EXPECT_EQ(unknown.code, 3);
  EXPECT_EQ(said(unknown.err).rfind("brushfire: notes.txt: neither name nor content tell the format", 0), 0u);
  EXPECT_EQ(lines_of(unknown.err).size(), 1u);
  expect_error({"distance", path("square.off"), "--sources", path("missing.txt")}, 3,
               "brushfire: missing.txt: no such file");
}

TEST_F(Program, ClosedOrFullStandardOutputIsAnError) {
  const Ended closed = run_program({"info", path("square.off")}, {.close_stdout = true});
  EXPECT_EQ(closed.code, 1);
  EXPECT_EQ(closed.err, "brushfire: standard output: Bad file descriptor\n");
  const Ended broken = run_program({"info", path("square.off")}, {.broken_pipe = true});
  EXPECT_EQ(broken.code, 1);
  EXPECT_EQ(broken.err, "brushfire: standard output: Broken pipe\n");
  const Ended full = run_program({"info", path("square.off")}, {.stdout_path = "/dev/full"});
  EXPECT_EQ(full.code, 1);
  EXPECT_EQ(full.err, "brushfire: standard output: No space left on device\n");
}

TEST_F(Program, CtrlCEndsWithOneHundredThirty) {
  std::string mesh = "OFF\n90000 30000 0\n";
  for (int i = 0; i < 90000; ++i) mesh += std::to_string(i) + " " + std::to_string(i % 3) + " 0\n";
  for (int i = 0; i < 90000; i += 3) {
    mesh += "3 " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 2) + "\n";
  }
  const Ended ended = run_program({"distance", "-", "--source", "0"}, {.input = mesh, .interrupt = true});
  EXPECT_EQ(ended.code, 130);
  EXPECT_FALSE(ended.killed);
  EXPECT_EQ(ended.out, "");
  EXPECT_EQ(ended.err, "brushfire: interrupted\n");
}

TEST_F(Program, TheReadmeKnowsTheDefaultMethod) {
  run_program({"shape", "cube", "-o", path("cube.ply"), "-q"});
  const std::string told = run_program({"distance", path("cube.ply"), "-s", "0", "--json"}).out;
  std::smatch method;
  ASSERT_TRUE(std::regex_search(told, method, std::regex("\"method\": \"([a-z0-9-]+)\"")));
  const std::string readme = read_file(BRUSHFIRE_SOURCE_DIR "/README.md");
  EXPECT_NE(readme.find("| `" + method[1].str() + "` (default) |"), std::string::npos) << method[1];
}

// A shell that has sourced the script, with the cursor at the end of "brushfire distance --method dij".
TEST_F(Program, BashCompletesAMethod) {
  write("script", run_program({"completion", "bash"}).out);
  const std::string command = "bash -c 'source \"" + path("script") +
                              "\"; COMP_WORDS=(brushfire distance --method dij); COMP_CWORD=3; _brushfire; "
                              "echo \"${COMPREPLY[*]}\"' > \"" +
                              path("completed") + "\"";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::ifstream file(path("completed"));
  std::string completed;
  std::getline(file, completed);
  EXPECT_EQ(completed, "dijkstra");
}

TEST_F(Program, CompletionKnowsVerbsOptionsAndMethods) {
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const Ended ended = run_program({"completion", shell});
    EXPECT_EQ(ended.code, 0);
    const bool fish = std::string(shell) == "fish";
    for (const char* word : {"info", "distance", "completion", fish ? "-l source" : "--source",
                             fish ? "-l json" : "--json", "dijkstra", "float32 float64"}) {
      EXPECT_NE(ended.out.find(word), std::string::npos) << shell << " " << word;
    }
  }
}

TEST_F(Program, ManualPagesTellWhatHelpTells) {
  const std::string all = run_program({"manual"}).out;
  EXPECT_EQ(all.rfind(".\\\" made by: brushfire manual\n.TH brushfire 1 ", 0), 0u) << all;
  const std::string page = run_program({"manual", "--verb", "distance"}).out;
  for (const char* text : {".SH NAME\nbrushfire\\-distance \\- ", "\\fB\\-\\-source\\fR", ".SH SYNOPSIS\n",
                           "brushfire distance bunny.ply \\-\\-source 0"}) {
    EXPECT_NE(page.find(text), std::string::npos) << text << "\n" << page;
  }
  // Every line is text or one of the requests that the pages use: nothing of the help is read as a command.
  for (const std::string& line : lines_of(page)) {
    if (line.empty() || line[0] != '.') continue;
    EXPECT_TRUE(line.rfind(".\\\"", 0) == 0 || line.rfind(".TH ", 0) == 0 || line.rfind(".SH ", 0) == 0 ||
                line == ".TP" || line == ".nf" || line == ".fi" || line.rfind(".BR ", 0) == 0)
        << line;
  }
}

TEST_F(Program, ManualWritesOnePageForEachVerb) {
  const std::string folder = path("man1");
  std::filesystem::create_directory(folder);
  EXPECT_EQ(run_program({"manual", "--folder", folder}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder + "/brushfire.1"));
  EXPECT_TRUE(std::filesystem::exists(folder + "/brushfire-isolines.1"));
  EXPECT_TRUE(std::filesystem::exists(folder + "/brushfire-manual.1"));
  expect_error({"manual", "--folder", path("missing")}, 1, "brushfire: missing/brushfire.1: cannot be written");
}

}  // namespace
}  // namespace brushfire::test
