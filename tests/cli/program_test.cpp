// The program as a black box: exit codes, the two streams, the one line of every error, the keys of the JSON.
#include "small_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

namespace brushfire::test {
namespace {

namespace fs = std::filesystem;

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

}  // namespace
}  // namespace brushfire::test
