// Meshes from OBJ, OFF and PLY; which format a file has.
#include "io_support.h"

#include <brushfire/io/npy.h>
#include <brushfire/io/read_field.h>

#include "support/shared_meshes.h"

namespace brushfire {
namespace {

using test::faces_of;
using test::mesh_error;
using test::positions_of;
using test::read_text;
using test::TemporaryDirectory;

const std::vector<Vec3> kPositions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0.1, -2.5e-3}};
const std::vector<Face> kFaces{{0, 1, 2}, {0, 2, 3}};

TEST(Obj, KeepsOrderIndexAndEveryDigit) {
  const LoadedMesh loaded = read_text(
      "# a comment\nmtllib x.mtl\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\r\nvt 0 0\nv +1 1 0\nv 0 .1 -2.5e-3\nvn 0 0 1\n"
      "g part\nf 1 2/1 3/1/1\nf -4 \\\n-2//1 -1",
      "a.obj");
  EXPECT_EQ(positions_of(loaded.mesh), kPositions);
  EXPECT_EQ(faces_of(loaded.mesh), kFaces);
  EXPECT_EQ(loaded.format, "OBJ");
  EXPECT_TRUE(loaded.face_origin.empty());
  EXPECT_TRUE(loaded.remarks.empty());
}

TEST(Obj, PolygonsRememberTheirFaceAndWhatIsNoFaceIsLeftOutWithARemark) {
  const LoadedMesh loaded =
      read_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2\nf 1 2 3 4\nl 1 2\nf 1 2 3\n", "a.obj");
  EXPECT_EQ(loaded.mesh.face_count(), 3u);
  EXPECT_EQ(loaded.face_origin, (std::vector<Index>{1, 1, 2}));
  EXPECT_EQ(loaded.remarks, (std::vector<std::string>{"1 line or point element left out",
                                                      "1 face of fewer than three corners left out"}));
}

TEST(Obj, UnreferencedVerticesKeepTheirIndex) {
  const LoadedMesh loaded = read_text("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 2 3 4\n", "a.obj");
  EXPECT_EQ(loaded.mesh.vertex_count(), 4u);
  EXPECT_EQ(faces_of(loaded.mesh), (std::vector<Face>{{1, 2, 3}}));
}

TEST(Off, ReadsCountsOnAnyLineAndColours) {
  const LoadedMesh loaded =
      read_text("OFF 4 2 0\n# c\n0 0 0\n1 0 0 255 0 0\n\n1 1 0\n0 0.1 -0.0025\n3 0 1 2 0 0 1\n3 0 2 3", "a.off");
  EXPECT_EQ(positions_of(loaded.mesh), kPositions);
  EXPECT_EQ(faces_of(loaded.mesh), kFaces);
  EXPECT_EQ(read_text("COFF\n3 1\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2\n", "a.txt").format, "OFF");
}

const std::string kPlyHeader =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty double x\nproperty float y\n"
    "property uchar tag\nproperty double z\nelement face 2\nproperty uchar flag\nproperty list uchar int "
    "vertex_indices\nend_header\n";

TEST(Ply, AsciiWithPropertiesBetweenIsRead) {
  const LoadedMesh loaded =
      read_text(kPlyHeader + "0 0 9 0\n1 0 9 0\n1 1 9 0\n0 0.5 9 -0.0025\n7 3 0 1 2\n7 3 0 2 3\n", "a.ply");
  EXPECT_EQ(positions_of(loaded.mesh)[3], (Vec3{0, 0.5, -2.5e-3}));
  EXPECT_EQ(faces_of(loaded.mesh), kFaces);
}

TEST(Ply, TriangleStripsAlternateAndRestartAtMinusOne) {
  const LoadedMesh loaded = read_text(
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 2 0\n10 0 1 2 3 3 4 -1 1 3 4\n",
      "a.ply");
  EXPECT_EQ(faces_of(loaded.mesh), (std::vector<Face>{{0, 1, 2}, {2, 1, 3}, {1, 3, 4}}));
}

TEST(Format, ContentWinsOverNameAndSaysSo) {
  const LoadedMesh loaded = read_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.obj");
  EXPECT_EQ(loaded.format, "OFF");
  EXPECT_EQ(loaded.remarks, (std::vector<std::string>{"the name says OBJ, but the content is OFF"}));
}

TEST(Format, WithoutATellingNameTheContentIsLookedAt) {
  EXPECT_EQ(read_text("# made by hand\n\nv 0 0 0\n", "standard input").format, "OBJ");
  EXPECT_EQ(read_text("mtllib a.mtl\nv 0 0 0\n", "standard input").format, "OBJ");
  const auto field_format = [](std::string_view text) {
    return read_field(test::bytes_of(text), "standard input").format;
  };
  EXPECT_EQ(field_format("vertex,distance\n0,1\n"), "CSV");
  EXPECT_EQ(field_format("0.5\n-inf\n"), "text");
  EXPECT_EQ(field_format("{\"a\": [1]}"), "JSON");
  EXPECT_EQ(field_format("#!ascii label\n0\n"), "FreeSurfer label");
}

TEST(Format, NeitherNameNorContentIsAnErrorThatListsWhatIsKnown) {
  EXPECT_EQ(mesh_error("hello", "a.xyz").substr(0, 76),
            "unknown_format: a.xyz: neither name nor content tell the format (known: PLY,");
}

TEST(SharedMeshes, AllAreReadWithTheCountsOfTheirHeaders) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  for (const std::string& name : test::shared_mesh_names()) {
    const Mesh mesh = test::shared_mesh(name);
    EXPECT_GT(mesh.face_count(), 0u) << name;
    const std::string head =
        test::read_file((test::shared_directory() / "meshes" / (name + ".ply")).string()).substr(0, 500);
    EXPECT_NE(head.find("element vertex " + std::to_string(mesh.vertex_count()) + "\n"), std::string::npos) << name;
  }
  for (const test::SharedTruth& t : test::shared_truths()) {
    const std::vector<double> truth = test::shared_truth(t.name, t.source);
    EXPECT_EQ(truth.size(), test::shared_mesh(t.name).vertex_count()) << t.name;
    EXPECT_EQ(truth[t.source], 0.0) << t.name;
  }
}

}  // namespace
}  // namespace brushfire
