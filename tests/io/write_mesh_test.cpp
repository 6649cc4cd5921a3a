// A mesh into every format and back; what GIFTI keeps of its surface; drawings in real size.
#include "io_support.h"

#include <brushfire/io/formats.h>
#include <brushfire/io/read_field.h>
#include <brushfire/io/write_field.h>
#include <brushfire/io/write_lines.h>
#include <brushfire/io/write_mesh.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>

#include <cmath>

namespace brushfire {
namespace {

using test::faces_of;
using test::positions_of;
using test::TemporaryDirectory;

// Not of the shape module alone: coordinates that need every digit, and a vertex in no face.
Mesh sample() {
  const Mesh sphere = shapes::icosphere(2).mesh();
  std::vector<Vec3> positions;
  for (const Vec3& p : sphere.positions()) positions.push_back({1.0 / 3 + p.x, 1e-3 * p.y, 1e5 * p.z});
  positions.push_back({7, 8, 9});
  return Mesh(positions, sphere.faces());
}

bool is_of_floats(const std::string& format) {
  return format == "GIFTI" || format == "FreeSurfer" || format == "glTF" || format == "STL";
}

bool are_same_floats(const Vec3& a, const Vec3& b) {
  return static_cast<float>(a.x) == static_cast<float>(b.x) && static_cast<float>(a.y) == static_cast<float>(b.y) &&
         static_cast<float>(a.z) == static_cast<float>(b.z);
}

TEST(WriteMesh, EveryFormatReadsBackWithItsVerticesAndFacesInOrder) {
  const TemporaryDirectory dir;
  const Mesh mesh = sample();
  for (const FileFormat& format : meshes_written()) {
    for (const std::string& extension : format.extensions) {
      const std::string file = dir / ("lh." + extension);
      write_mesh(file, mesh);
      const LoadedMesh loaded = read_mesh(file);
      EXPECT_EQ(loaded.format, format.name) << extension;
      ASSERT_EQ(loaded.mesh.face_count(), mesh.face_count()) << extension;
      if (format.name == "STL") continue;
      EXPECT_EQ(faces_of(loaded.mesh), faces_of(mesh)) << extension;
      ASSERT_EQ(loaded.mesh.vertex_count(), mesh.vertex_count()) << extension;
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 wrote = mesh.positions()[v], read = loaded.mesh.positions()[v];
        EXPECT_TRUE(is_of_floats(format.name) ? are_same_floats(wrote, read) : wrote == read) << extension << " " << v;
      }
    }
  }
}

TEST(WriteMesh, StlOfAClosedSurfaceIsClosedWhenItIsReadBack) {
  const TemporaryDirectory dir;
  const Mesh sphere = shapes::icosphere(2).mesh();
  write_mesh(dir / "a.stl", sphere);
  EXPECT_EQ(read_mesh(dir / "a.stl").mesh.report().boundary_edges, 0u);
  EXPECT_EQ(read_mesh(dir / "a.stl").mesh.vertex_count(), sphere.vertex_count());
}

TEST(WriteMesh, EmptyMeshesAreValidFiles) {
  const TemporaryDirectory dir;
  for (const FileFormat& format : meshes_written()) {
    const std::string file = dir / ("a." + format.extensions.front());
    write_mesh(file, Mesh());
    if (format.name == "OBJ") continue;  // no vertex and no face is what OBJ's reader cannot tell from other text
    EXPECT_EQ(test::error_of([&] { EXPECT_EQ(read_mesh(file).mesh.vertex_count(), 0u); }), "") << format.name;
  }
}

TEST(WriteMesh, WhatCannotBeWrittenIsSaid) {
  const TemporaryDirectory dir;
  const auto message = [&](const char* name, const Mesh& mesh) {
    return test::error_of([&] { write_mesh(dir / name, mesh); });
  };
  EXPECT_NE(message("a.xyz", sample()).find("no mesh is written as 'xyz' (known: ply, obj, off"), std::string::npos);
  const Mesh huge(std::vector<Vec3>{{0, 0, 0}, {1e39, 0, 0}, {0, 1, 0}}, std::vector<Face>{{0, 1, 2}});
  EXPECT_EQ(message("a.glb", huge), "invalid_argument: glTF stores floats, which end before this mesh does");
  EXPECT_EQ(message("a.off", huge), "");
  const Mesh intrinsic =
      Mesh::from_lengths(3, std::vector<Face>{{0, 1, 2}}, std::vector<std::array<double, 3>>{{1, 1, 1}});
  EXPECT_EQ(message("a.obj", intrinsic), "invalid_argument: a mesh from lengths has no positions to write as OBJ");
}

TEST(WriteGifti, TheStructureOfASurfaceGoesFromFileToFile) {
  const TemporaryDirectory dir;
  const Mesh mesh = sample();
  write_mesh(dir / "a.surf.gii", mesh, "", "CortexLeft");
  const LoadedMesh loaded = read_mesh(dir / "a.surf.gii");
  EXPECT_EQ(loaded.structure, "CortexLeft");
  const std::vector<double> values(mesh.vertex_count(), 1.5);
  write_field(dir / "a.shape.gii", mesh, {.values = values, .structure = loaded.structure});
  const std::string text = test::read_file(dir / "a.shape.gii");
  EXPECT_NE(text.find("<MetaData><MD><Name><![CDATA[AnatomicalStructurePrimary]]></Name><Value><![CDATA[CortexLeft]]>"),
            std::string::npos);
  EXPECT_NE(text.find("NumberOfDataArrays=\"1\""), std::string::npos) << "no map that was not asked for";
  write_mesh(dir / "b.surf.gii", mesh, "", "]]><x/>");
  EXPECT_EQ(read_mesh(dir / "b.surf.gii").structure, "");
}

TEST(WriteField, OutsideAMaskIsNothing) {
  const TemporaryDirectory dir;
  const Mesh mesh = shapes::plane(1, 1).mesh();
  const std::vector<double> values{1, 2, 3, kInfinity};
  const std::vector<Index> labels{0, 1, 2, 3};
  const std::vector<std::uint8_t> mask{1, 0, 1, 1};
  for (const char* name : {"a.shape.gii", "a.ply", "a.vtp", "a.csv", "a.npy"}) {
    write_field(dir / name, mesh, {.values = values, .labels = labels, .mask = mask});
    const std::vector<double> read = read_field(dir / name).values;
    EXPECT_EQ(read.at(0), 1) << name;
    EXPECT_TRUE(std::isnan(read.at(1))) << name;
    EXPECT_EQ(read.at(3), kInfinity) << name;
  }
  write_field(dir / "a.csv", mesh, {.values = values, .labels = labels, .mask = mask});
  EXPECT_NE(test::read_file(dir / "a.csv").find("\n1,nan,-1\n2,3,2\n"), std::string::npos);
  const std::vector<std::uint8_t> short_mask{1};
  EXPECT_EQ(test::error_of([&] { write_field(dir / "a.csv", mesh, {.values = values, .mask = short_mask}); }),
            "invalid_argument: 1 entries of the mask for a mesh of 4 vertices");
}

TEST(WriteField, CiftiIsNamed) {
  EXPECT_NE(test::error_of([] { check_field_format("a.dscalar.nii"); }).find("CIFTI-2 is not written here"),
            std::string::npos);
}

TEST(DrawLines, SvgHasItsSizeInMillimetres) {
  const TemporaryDirectory dir;
  const Mesh mesh = shapes::plane(1, 1).mesh();
  const std::vector<SurfacePath> line{{{vertex_point(mesh, 0), vertex_point(mesh, 3)}, 1, false}};
  const auto svg = [&](const LinesOptions& options) {
    write_lines(dir / "a.svg", mesh, line, "length", "", options);
    return test::read_file(dir / "a.svg");
  };
  // A unit square, 25.4 mm wide, with two strokes of 0.2 % around it.
  const std::string inches = svg({.millimetres = 25.4});
  const double width = std::stod(inches.substr(inches.find("width=\"") + 7));
  EXPECT_NEAR(width, 25.4 * 1.008, 1e-9);
  EXPECT_NE(inches.find("mm\" height=\""), std::string::npos);
  EXPECT_NE(inches.find("d=\"M0 0L25.4 -25.4\""), std::string::npos) << inches;
  EXPECT_NE(svg({.view = "bottom"}).find("d=\"M0 0L1 1\""), std::string::npos);
  EXPECT_NE(svg({.view = "front"}).find("d=\"M0 0L1 0\""), std::string::npos);
  const std::string outline = svg({.outline = true});
  const std::string path = outline.substr(outline.find("id=\"outline\""));
  EXPECT_EQ(std::count(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(path.find("/>")), 'M'), 4)
      << "the four sides of the square, and not its diagonal";
  EXPECT_EQ(test::error_of([&] { svg({.view = "below"}); }),
            "invalid_argument: 'below' is no view (known: front, back, left, right, top, bottom)");
}

TEST(DrawLines, TheOutlineOfAClosedSurfaceIsItsSilhouette) {
  const TemporaryDirectory dir;
  // A box has twelve edges; seen along an axis four of them are its outline, once for each of the two ends.
  const std::vector<Vec3> p{{0, 0, 0},       {1, 0, 0},       {1, 1, 0},       {0, 1, 0},
                            {0.25, 0.25, 1}, {0.75, 0.25, 1}, {0.75, 0.75, 1}, {0.25, 0.75, 1}};
  const std::vector<Face> f{{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                            {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  const Mesh frustum(p, f);
  write_lines(dir / "a.svg", frustum, {}, "level", "", {.view = "top", .outline = true});
  const std::string text = test::read_file(dir / "a.svg");
  const std::string path = text.substr(text.find("d=\""), text.find("/>") - text.find("d=\""));
  EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 4) << "the base only: " << path;
}

TEST(DrawLines, DxfHasPolylinesInMillimetres) {
  const TemporaryDirectory dir;
  const Mesh mesh = shapes::plane(1, 1).mesh();
  const std::vector<SurfacePath> lines{
      {{vertex_point(mesh, 0), vertex_point(mesh, 3)}, 1, false},
      {{vertex_point(mesh, 0), vertex_point(mesh, 1), vertex_point(mesh, 3)}, 2, true}};
  write_lines(dir / "a.dxf", mesh, lines, "level", "", {.millimetres = 1000});
  const std::string text = test::read_file(dir / "a.dxf");
  EXPECT_EQ(text.substr(0, 20), "0\nSECTION\n2\nHEADER\n9");
  EXPECT_EQ(text.substr(text.size() - 6), "0\nEOF\n");
  EXPECT_NE(text.find("POLYLINE\n8\nlevel\n66\n1\n10\n0\n20\n0\n30\n0\n70\n8\n"), std::string::npos);
  EXPECT_NE(text.find("\n70\n9\n"), std::string::npos) << "one is closed";
  EXPECT_NE(text.find("VERTEX\n8\nlevel\n10\n1000\n20\n1000\n30\n0\n70\n32\n"), std::string::npos);
}

}  // namespace
}  // namespace brushfire
