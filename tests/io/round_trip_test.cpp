// What is written reads back: every writer with its reader, doubles to the bit where the format has doubles.
#include "io_support.h"

#include <brushfire/io/read_field.h>
#include <brushfire/io/write_field.h>
#include <brushfire/mesh/shapes.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace brushfire {
namespace {

using test::faces_of;
using test::positions_of;
using test::TemporaryDirectory;

// Random bits as doubles of this size at most: every exponent, denormals, both zeros.
double random_double(std::mt19937_64& random, double most = std::numeric_limits<double>::max()) {
  while (true) {
    const std::uint64_t bits = random();
    double v;
    std::memcpy(&v, &bits, sizeof v);
    if (std::abs(v) <= most) return v;
  }
}

struct Case {
  Mesh mesh;
  std::vector<double> values;
  std::vector<Index> labels;
};

Case random_case(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto vertices = static_cast<Index>(3 + random() % 40);
  std::vector<Vec3> positions(vertices);
  constexpr double kMostCoordinate = 0x1p990;
  const auto coordinate = [&] { return random_double(random, kMostCoordinate); };
  for (Vec3& p : positions) p = {coordinate(), coordinate(), coordinate()};
  std::vector<Face> faces(random() % 60);
  for (Face& f : faces) {
    for (Index& v : f) v = static_cast<Index>(random() % vertices);
  }
  Case c{Mesh(positions, faces), {}, {}};
  for (Index v = 0; v < vertices; ++v) {
    c.values.push_back(random() % 8 == 0 ? kInfinity : random_double(random));
    c.labels.push_back(random() % 8 == 0 ? kNoIndex : static_cast<Index>(random() % 5));
  }
  return c;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0);
}

std::vector<double> as_values(const std::vector<Index>& labels) {
  std::vector<double> values;
  for (const Index l : labels) values.push_back(static_cast<std::int32_t>(l));
  return values;
}

constexpr std::uint64_t kSeeds = 50;

class MeshRoundTrip : public testing::TestWithParam<const char*> {};

TEST_P(MeshRoundTrip, KeepsOrderIndicesAndEveryBitOfTheCoordinates) {
  const TemporaryDirectory dir;
  const std::string path = dir / (std::string("a.") + GetParam());
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Case c = random_case(seed);
    write_field(path, c.mesh, {c.values, c.labels, "distance", "source"});
    const LoadedMesh loaded = read_mesh(path);
    ASSERT_TRUE(same_bits(positions_of(loaded.mesh), positions_of(c.mesh))) << "seed " << seed;
    ASSERT_EQ(faces_of(loaded.mesh), faces_of(c.mesh)) << "seed " << seed;
    ASSERT_TRUE(loaded.face_origin.empty());
    write_field(path, c.mesh, {});
    ASSERT_EQ(faces_of(read_mesh(path).mesh), faces_of(c.mesh)) << "seed " << seed << ", without a field";
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, MeshRoundTrip, testing::Values("ply", "obj", "vtk", "vtp"));

class FieldRoundTrip : public testing::TestWithParam<const char*> {};

TEST_P(FieldRoundTrip, KeepsEveryBitOfTheValuesAndTheLabels) {
  const TemporaryDirectory dir;
  const std::string format = GetParam(), path = dir / ("a." + format);
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Case c = random_case(seed);
    write_field(path, c.mesh, {c.values, c.labels, "distance", "source"});
    const std::vector<double> values = values_on_vertices(read_field(path), c.mesh.vertex_count());
    ASSERT_TRUE(same_bits(values, c.values)) << "seed " << seed;
    if (format == "npy") continue;  // holds one array
    const std::vector<double> labels = values_on_vertices(read_field(path, "source"), c.mesh.vertex_count());
    ASSERT_TRUE(same_bits(labels, as_values(c.labels))) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, FieldRoundTrip, testing::Values("ply", "vtk", "vtp", "csv", "json", "npy"));

class NarrowFieldRoundTrip : public testing::TestWithParam<const char*> {};

TEST_P(NarrowFieldRoundTrip, KeepsTheNearestFloatOfEveryValue) {
  const TemporaryDirectory dir;
  const std::string path = dir / (std::string("a.") + GetParam());
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Case c = random_case(seed);
    write_field(path, c.mesh, {c.values, {}, "distance", "source"});
    std::vector<double> narrow;
    for (const double v : c.values) narrow.push_back(static_cast<float>(v));
    ASSERT_TRUE(same_bits(read_field(path).values, narrow)) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, NarrowFieldRoundTrip, testing::Values("gii", "curv"));

TEST(WriteField, JsonTellsNotVisitedFromOutOfReachAndReadsItBack) {
  const TemporaryDirectory dir;
  const Mesh mesh = shapes::plane(1, 1).mesh();
  const std::vector<double> values{1, kInfinity, kInfinity, kInfinity};
  const std::vector<std::uint8_t> not_visited{0, 1, 0, 1};
  write_field(dir / "a.json", mesh, {.values = values, .not_visited = not_visited});
  EXPECT_NE(test::read_file(dir / "a.json").find("\"distance\": [1, null, null, null],\n \"not_visited\": [1, 3]}"),
            std::string::npos)
      << test::read_file(dir / "a.json");
  const LoadedField read = read_field(dir / "a.json");
  EXPECT_TRUE(same_bits(read.values, values));
  EXPECT_EQ(read.not_visited, (std::vector<Index>{1, 3}));
  write_field(dir / "b.json", mesh, {.values = values});
  EXPECT_EQ(read_field(dir / "b.json").not_visited, std::vector<Index>{}) << "where nobody said";
  const std::vector<std::uint8_t> too_few{1};
  EXPECT_EQ(test::error_of([&] { write_field(dir / "a.json", mesh, {.values = values, .not_visited = too_few}); }),
            "invalid_argument: 1 entries of not_visited for a mesh of 4 vertices");
}

TEST(WriteField, LabelsAloneGoIntoNpyAsInt32) {
  const TemporaryDirectory dir;
  const Case c = random_case(1);
  write_field(dir / "a.npy", c.mesh, {{}, c.labels, "distance", "source"});
  EXPECT_TRUE(same_bits(read_field(dir / "a.npy").values, as_values(c.labels)));
}

TEST(WriteField, PlyHasQualityAndColoursForMeshLab) {
  const TemporaryDirectory dir;
  const Case c = random_case(1);
  write_field(dir / "a.ply", c.mesh, {c.values, {}, "distance", "source"});
  const std::string head = test::read_file(dir / "a.ply").substr(0, 600);
  for (const char* line :
       {"property double x\n", "property double quality\n", "property uchar red\n", "comment quality is distance\n"}) {
    EXPECT_NE(head.find(line), std::string::npos) << line;
  }
}

TEST(WriteField, ColoursRunFromDarkToYellowAndAreGreyWhereUnreachable) {
  const TemporaryDirectory dir;
  const Mesh mesh(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, std::vector<Face>{{0, 1, 2}});
  const std::vector<double> values{0, 2, kInfinity};
  write_field(dir / "a.obj", mesh, {values, {}, "distance", "source"});
  const std::string text = test::read_file(dir / "a.obj");
  EXPECT_NE(text.find("v 0 0 0 0.26666668 0.003921569 0.32941177\n"), std::string::npos) << text;
  EXPECT_NE(text.find("v 1 0 0 0.99215686 0.90588236 0.14509805\n"), std::string::npos) << text;
  EXPECT_NE(text.find("v 0 1 0 0.5019608 0.5019608 0.5019608\n"), std::string::npos) << text;
}

TEST(WriteField, WrongSizesNamesAndFormatsAreErrors) {
  const TemporaryDirectory dir;
  const Mesh mesh(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, std::vector<Face>{{0, 1, 2}});
  const std::vector<double> two{0, 1}, three{0, 1, 2};
  const auto message = [&](const std::string& name, const FieldView& field, const Mesh& m) {
    return test::error_of([&] { write_field(dir / name, m, field); });
  };
  EXPECT_EQ(message("a.ply", {two, {}, "d", "s"}, mesh), "invalid_argument: 2 values for a mesh of 3 vertices");
  EXPECT_EQ(message("a.ply", {three, {}, "two words", "s"}, mesh),
            "invalid_argument: 'two words' is no name for an array: letters, digits, _ - . only");
  EXPECT_NE(message("a.xyz", {three, {}, "d", "s"}, mesh).find("nothing is written as 'xyz' (known: npy, ply"),
            std::string::npos);
  EXPECT_EQ(message("a.curv", {}, mesh), "invalid_argument: a FreeSurfer curvature file needs values");
  const Mesh intrinsic =
      Mesh::from_lengths(3, std::vector<Face>{{0, 1, 2}}, std::vector<std::array<double, 3>>{{1, 1, 1}});
  EXPECT_EQ(message("a.vtp", {three, {}, "d", "s"}, intrinsic),
            "invalid_argument: a mesh from lengths has no positions to write as vtp");
  EXPECT_EQ(message("a.csv", {three, {}, "d", "s"}, intrinsic), "");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir.path()), {}), 1) << "only a.csv was left behind";
}

}  // namespace
}  // namespace brushfire
