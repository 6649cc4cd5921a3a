// Options and places that were taken without a word and meant something else.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "in_folder.h"
#include "program.h"

namespace brushfire::test {
namespace {

constexpr int kUsage = 2, kBadInput = 3, kUnreachable = 4;

class Lies : public InFolder {
 protected:
  void SetUp() override {
    // A unit square, and a vertex in no face.
    write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 5\nf 1 2 3\nf 1 3 4\n");
  }
  std::string square() const { return path("square.obj"); }
};

TEST_F(Lies, AnEmptyValueIsAnErrorOfEveryOption) {
  const std::vector<std::vector<std::string>> calls{
      {"distance", square(), "--source", "0", "--tolerance", ""},
      {"distance", square(), "--source", "0", "--radius", ""},
      {"distance", square(), "--source", "0", "--radius="},
      {"distance", square(), "--source", "0", "-o", ""},
      {"distance", square(), "--source", "0", "--threads", ""},
      {"distance", square(), "--source", "0", "--method", ""},
      {"distance", square(), "--source", "0", "--sources", ""},
      {"distance", square(), "--source", ""},
      {"distance", square(), "--source", "0", "--target", ""},
      {"distance", square(), "--source", "0", "--snap-within", ""},
      {"distance", "", "--source", "0"},
      {"info", ""},
      {"path", square(), "--from", "", "--to", "1"},
      {"path", square(), "--from", "0", "--to", "1", "--via", ""},
      {"isolines", square(), "--source", "0", "--every", "", "-o", path("a.obj")},
      {"isolines", square(), "--source", "0", "--levels", "", "--count", "3", "-o", path("a.obj")},
      {"isolines", square(), "--source", "0", "--count", "3", "--chord-error", "", "-o", path("a.obj")},
      {"matrix", square(), "--rows", "", "-o", path("a.npy")},
      {"render", square(), "--source", "0", "--size", "", "-o", path("a.png")},
      {"render", square(), "--source", "0", "--range", "", "-o", path("a.png")},
      {"shape", "torus", "-n", "", "-o", path("a.ply")},
      {"shape", "torus", "-o", ""},
      {"compare", "a.npy", "b.npy", "--mesh", ""},
      {"bench", square(), "--repeat", ""},
  };
  for (const auto& call : calls) {
    const Ended ended = run_program(call);
    std::string words;
    for (const std::string& w : call) words += w + " ";
    EXPECT_EQ(ended.code, kUsage) << words << ended.out;
    EXPECT_FALSE(ended.err.empty()) << words;
  }
}

TEST_F(Lies, AStepThatIsTooSmallIsToldAsItIs) {
  const Ended ended = run_program({"isolines", square(), "--source", "0", "--every", "1e-9", "-o", path("a.obj")});
  EXPECT_EQ(ended.code, kUsage);
  EXPECT_NE(ended.err.find("--every: a step of 1e-09 between 0 and 1.41421 gives 1.41421e+09 levels"),
            std::string::npos)
      << ended.err;
}

TEST_F(Lies, APositionOffTheSurfaceIsToldInWordsAndInJson) {
  const std::vector<std::string> call{"distance", square(), "--source", "at:1000,2000,3000", "--target", "at:0,0,0.5"};
  const Ended words = run_program(call);
  EXPECT_EQ(words.code, 0);
  EXPECT_NE(words.err.find("2 positions are off the surface, the farthest, 'at:1000,2000,3000', 3740."),
            std::string::npos)
      << words.err;
  std::vector<std::string> json = call;
  json.emplace_back("--json");
  const Ended object = run_program(json);
  EXPECT_NE(object.out.find("\"max_snap_distance\": 3740."), std::string::npos) << object.out;
  EXPECT_NE(object.out.find("\"where\": \"at:0,0,0.5\",\n      \"distance\": 0.5"), std::string::npos) << object.out;
}

TEST_F(Lies, APositionOnTheSurfaceIsNotRemarkedOn) {
  EXPECT_EQ(run_program({"distance", square(), "--source", "at:0.25,0.5,0", "--target", "2"}).err, "");
}

TEST_F(Lies, SnapWithinRefusesWhatIsFarther) {
  const std::vector<std::vector<std::string>> calls{
      {"distance", square(), "--source", "at:0,0,2"},
      {"distance", square(), "--source", "0", "--target", "at:0,0,2"},
      {"path", square(), "--from", "at:0,0,2", "--to", "1"},
      {"isolines", square(), "--source", "at:0,0,2", "--count", "3", "-o", path("a.obj")},
      {"render", square(), "--source", "at:0,0,2", "-o", path("a.png")},
      {"bench", square(), "--source", "at:0,0,2", "--repeat", "1"},
  };
  for (auto call : calls) {
    call.insert(call.end(), {"--snap-within", "1.5"});
    const Ended refused = run_program(call);
    EXPECT_EQ(refused.code, kUsage) << call[0];
    EXPECT_NE(refused.err.find("'at:0,0,2' is 2 from the surface, farther than --snap-within 1.5"), std::string::npos)
        << refused.err;
    call.back() = "2";
    EXPECT_EQ(run_program(call).code, 0) << call[0];
    call.back() = "-1";
    EXPECT_EQ(run_program(call).code, kUsage) << call[0];
  }
  write("rows.txt", "at:0,0,2\n");
  EXPECT_EQ(
      run_program({"matrix", square(), "--rows", path("rows.txt"), "-o", path("a.npy"), "--snap-within", "1"}).code,
      kUsage);
}

TEST_F(Lies, ATargetInNoFaceReadsInfinityAndIsUnreachable) {
  const Ended ended = run_program({"distance", square(), "--source", "0", "--target", "4", "--target", "1"});
  EXPECT_EQ(ended.out, "inf\n1\n");
  EXPECT_EQ(ended.code, kUnreachable);
  EXPECT_EQ(run_program({"path", square(), "--from", "0", "--to", "4"}).code, kUnreachable);
  EXPECT_EQ(run_program({"path", square(), "--from", "0", "--to", "4", "--method", "dijkstra"}).code, kUnreachable);
  EXPECT_EQ(run_program({"distance", square(), "--source", "4"}).code, kUsage);
}

TEST_F(Lies, SourcesAreReadFromPipesAndNotFromDevices) {
  const Ended pipe =
      run_program({"distance", square(), "--sources", "-", "--target", "1"}, {.input = "0 # the corner\n"});
  EXPECT_EQ(pipe.out, "1\n") << pipe.err;
  const Ended device = run_program({"distance", square(), "--sources", "/dev/zero"});
  EXPECT_EQ(device.code, kBadInput);
  EXPECT_NE(device.err.find("is a device"), std::string::npos);
  const Ended line = run_program({"distance", square(), "--sources", "-"}, {.input = std::string(100000, '0')});
  EXPECT_EQ(line.code, kUsage);
  EXPECT_NE(line.err.find("standard input:1: is longer than 65536 bytes"), std::string::npos) << line.err;
}

TEST_F(Lies, AnOffsetOfAnySizeIsAdded) {
  EXPECT_EQ(run_program({"distance", square(), "--source", "0@1e308", "--target", "1"}).out, "1e+308\n");
  EXPECT_EQ(run_program({"distance", square(), "--source", "0@-1e308", "--source", "2@1.7e308", "--target", "2"}).out,
            "-1e+308\n");
}

}  // namespace
}  // namespace brushfire::test
