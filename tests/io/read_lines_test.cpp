// Curves out of files: what write_lines() wrote, and what others write.
#include "io_support.h"

#include <brushfire/io/read_lines.h>
#include <brushfire/io/write_lines.h>
#include <brushfire/mesh/shapes.h>

#include <cmath>

namespace brushfire {
namespace {

using test::TemporaryDirectory;

const Mesh& square() {
  static const Mesh mesh = shapes::plane(1, 1).mesh();
  return mesh;
}

// An open curve, a closed one, one of two points that is closed, a single point.
const std::vector<SurfacePath>& curves() {
  static const std::vector<SurfacePath> lines{
      {{{0, {1, 0, 0}}, {0, {0.5, 0, 0.5}}, {1, {0.25, 0.5, 0.25}}}, 0.75, false},
      {{{0, {1, 0, 0}}, {0, {0, 1, 0}}, {0, {0, 0, 1}}}, 3.5, true},
      {{{1, {1, 0, 0}}, {1, {0, 1, 0}}}, 2, true},
      {{{0, {0.2, 0.3, 0.5}}}, 0, false}};
  return lines;
}

class LinesRoundTrip : public testing::TestWithParam<const char*> {};

TEST_P(LinesRoundTrip, KeepsEveryPointAndWhichCurvesAreClosed) {
  const TemporaryDirectory dir;
  const std::string format = GetParam(), file = dir / ("lines." + format);
  write_lines(file, square(), curves(), "length");
  const LoadedLines loaded = read_lines(file);
  ASSERT_EQ(loaded.lines.size(), curves().size());
  const bool on_mesh = format == "csv" || format == "json";
  const bool has_value = on_mesh || format == "vtp";
  EXPECT_EQ(loaded.value_name, has_value ? "length" : "");
  for (std::size_t i = 0; i < curves().size(); ++i) {
    const LoadedLine& line = loaded.lines[i];
    EXPECT_EQ(line.closed, curves()[i].closed) << i;
    ASSERT_EQ(line.positions.size(), curves()[i].points.size()) << i;
    for (std::size_t k = 0; k < line.positions.size(); ++k) {
      EXPECT_EQ(line.positions[k], position(square(), curves()[i].points[k])) << i << " " << k;
      if (on_mesh) {
        EXPECT_EQ(line.points.at(k).face, curves()[i].points[k].face);
        EXPECT_EQ(line.points.at(k).weights, curves()[i].points[k].weights);
      }
    }
    EXPECT_EQ(line.points.empty(), !on_mesh);
    if (has_value) {
      EXPECT_EQ(line.value, curves()[i].length);
    } else {
      EXPECT_TRUE(std::isnan(line.value));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, LinesRoundTrip, testing::Values("csv", "json", "obj", "ply", "vtp"));

TEST(ReadLines, ASingleCurveOfJsonStandsAtTheTop) {
  const TemporaryDirectory dir;
  write_lines(dir / "path.json", square(), std::span(curves()).first(1), "length");
  const LoadedLines loaded = read_lines(dir / "path.json");
  ASSERT_EQ(loaded.lines.size(), 1u);
  EXPECT_EQ(loaded.lines[0].value, 0.75);
  EXPECT_EQ(loaded.format, "JSON");
}

TEST(ReadLines, JsonOfAMeshWithoutPositionsHasPointsOnly) {
  const Mesh mesh = Mesh::from_lengths(3, std::vector<Face>{{0, 1, 2}}, std::vector<std::array<double, 3>>{{1, 1, 1}});
  const TemporaryDirectory dir;
  write_lines(dir / "path.json", mesh, std::span(curves()).last(1), "length");
  const LoadedLines loaded = read_lines(dir / "path.json");
  EXPECT_TRUE(loaded.lines.at(0).positions.empty());
  EXPECT_EQ(loaded.lines[0].points.size(), 1u);
}

TEST(ReadLines, NoCurvesAreReadAsNone) {
  const TemporaryDirectory dir;
  for (const char* format : {"csv", "json", "vtp", "ply"}) {
    const std::string file = dir / (std::string("none.") + format);
    write_lines(file, square(), {}, "level");
    EXPECT_TRUE(read_lines(file).lines.empty()) << format;
  }
}

LoadedLines lines_of(std::string_view text, const char* name) { return read_lines(test::bytes_of(text), name); }
std::string error_of(std::string_view text, const char* name) {
  return test::error_of([&] { lines_of(text, name); });
}

TEST(ReadLines, ObjMayCountBackwardsAndNameTextures) {
  const LoadedLines loaded = lines_of("v 0 0 0\nv 1 0 0\nl -2/1 -1/2\nv 0 1 0\np 1 3\n", "a.obj");
  ASSERT_EQ(loaded.lines.size(), 3u);
  EXPECT_EQ(loaded.lines[0].positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(loaded.lines[2].positions, (std::vector<Vec3>{{0, 1, 0}}));
}

TEST(ReadLines, CsvMayHaveItsColumnsInAnyOrder) {
  const LoadedLines loaded = lines_of("x;y;z;line;closed\n0;0;0;7;1\n1;0;0;7;1\n2;0;0;8;0\n", "a.csv");
  ASSERT_EQ(loaded.lines.size(), 2u);
  EXPECT_EQ(loaded.lines[0].positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}));
  EXPECT_TRUE(loaded.lines[0].closed);
  EXPECT_TRUE(std::isnan(loaded.lines[1].value));
}

TEST(ReadLines, DefectsHaveTheirMessages) {
  EXPECT_EQ(error_of("line,length\n", "a.csv"),
            "file_malformed: a.csv:1: the header names neither x, y, z nor face, w0, w1, w2");
  EXPECT_EQ(error_of("line,x,y,z\n0,0,0,nan\n", "a.csv"), "file_malformed: a.csv:2: coordinate 'nan' is not finite");
  EXPECT_EQ(error_of("line,face,w0,w1,w2\n0,-1,1,0,0\n", "a.csv"),
            "file_malformed: a.csv:2: the face is no whole number from 0 up");
  EXPECT_EQ(error_of("{\"points\": 3", "a.json"), "file_malformed: a.json: byte 12: not JSON");
  EXPECT_EQ(error_of("{\"schema\": 1}", "a.json").substr(0, 58),
            "file_malformed: a.json: not as curves are written: [json.e");
  EXPECT_EQ(error_of("v 0 0 0\nl 1 2\n", "a.obj"), "file_malformed: a.obj:2: there is no vertex 2 so far");
  EXPECT_NE(error_of("hello", "a.xyz").find("(known: CSV, JSON, OBJ, PLY, VTP)"), std::string::npos);
}

}  // namespace
}  // namespace brushfire
