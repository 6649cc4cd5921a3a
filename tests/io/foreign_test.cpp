// What other programs and other systems write: line ends, marks, numbers, headers and sections of their own.
#include "io_support.h"

#include <brushfire/core/detail/base64.h>
#include <brushfire/io/read_field.h>
#include <brushfire/mesh/report.h>

#include "support/packed_gltf.h"
#include "support/stored_zip.h"

#include <algorithm>
#include <clocale>
#include <cmath>
#include <cstring>

namespace brushfire {
namespace {

using test::bytes_of;
using test::faces_of;
using test::mesh_error;
using test::packed;
using test::positions_of;
using test::read_text;

struct Text {
  const char* name;
  std::string content;
};

// One triangle (0 0 0, 3 0 0, 3 4 0) in every text format, lines ended by LF.
std::vector<Text> triangle_texts() {
  return {
      {"a.obj", "# made by hand\n\nv 0 0 0\nv 3 0 0\nv 3 4 0\nf 1 2 3\n"},
      {"a.off", "OFF\n3 1 0\n\n0 0 0\n3 0 0\n3 4 0\n3 0 1 2\n"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
       "property list uchar int vertex_indices\nend_header\n0 0 0\n3 0 0\n\n3 4 0\n3 0 1 2\n"},
      {"a.stl",
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 3 0 0\nvertex 3 4 "
       "0\nendloop\nendfacet\nendsolid\n"},
      {"a.vtk",
       "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0\n3 0 0\n3 4 0\nPOLYGONS 1 4\n3 0 "
       "1 2\n"},
      {"a.mesh",
       "MeshVersionFormatted 2\nDimension 3\nVertices\n3\n0 0 0 0\n3 0 0 0\n3 4 0 0\nTriangles\n1\n1 2 3 0\nEnd\n"},
      {"a.msh",
       "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\nnone\n$EndComments\n$Nodes\n3\n1 0 0 0\n2 3 0 0\n3 3 4 "
       "0\n$EndNodes\n"
       "$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n"},
      {"lh.asc", "#!ascii version of lh.white\n3 1\n0 0 0 0\n3 0 0 0\n3 4 0 0\n0 1 2 0\n"},
      {"a.vtp",
       "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\" "
       "NumberOfPolys=\"1\">\n"
       "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0\n3 0 0\n3 4 0\n</DataArray>"
       "</Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray><DataArray "
       "type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys></Piece></PolyData></VTKFile>\n"},
  };
}

void expect_triangle(const std::string& content, const std::string& name, const std::string& what) {
  try {
    const LoadedMesh loaded = read_text(content, name);
    EXPECT_EQ(positions_of(loaded.mesh), (std::vector<Vec3>{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}})) << name << ", " << what;
    EXPECT_EQ(faces_of(loaded.mesh), (std::vector<Face>{{0, 1, 2}})) << name << ", " << what;
  } catch (const Error& e) {
    ADD_FAILURE() << what << ": " << e.what();
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

TEST(Foreign, LinesEndInAnyWay) {
  for (const Text& t : triangle_texts()) {
    expect_triangle(t.content, t.name, "LF");
    expect_triangle(replaced(t.content, "\n", "\r\n"), t.name, "CR LF");
    expect_triangle(replaced(t.content, "\n", "\r"), t.name, "CR");
    expect_triangle(t.content.substr(0, t.content.size() - 1), t.name, "no end of the last line");
  }
}

TEST(Foreign, ByteOrderMarkBlankLinesAndTabsInFrontAreNothing) {
  for (const Text& t : triangle_texts()) {
    expect_triangle("\xef\xbb\xbf" + t.content, t.name, "byte order mark");
    expect_triangle("\n \t\r\n" + t.content, t.name, "blank lines");
    // The first line of a VTK file is a mark of one spelling.
    if (std::string(t.name) != "a.vtp" && std::string(t.name) != "a.vtk")
      expect_triangle(replaced(t.content, " ", "\t "), t.name, "tabs");
  }
}

TEST(Foreign, Utf16IsRefusedByName) {
  for (const Text& t : triangle_texts()) {
    std::string wide = "\xff\xfe";
    for (const char c : t.content) wide += {c, '\0'};
    EXPECT_NE(mesh_error(wide, t.name).find("text in UTF-16"), std::string::npos) << t.name;
  }
}

TEST(Foreign, FortranAndMicrosoftSpellNumbersTheirWay) {
  for (const Text& t : triangle_texts()) {
    if (std::string(t.name) == "a.vtp") continue;
    const std::string four = std::string(t.name) == "a.msh" ? "3 3 4 0\n" : "3 4 0";
    ASSERT_NE(t.content.find(four), std::string::npos) << t.name;
    expect_triangle(replaced(t.content, four, replaced(four, "4 0", "0.4D+01 0.0d0")), t.name, "Fortran");
    EXPECT_NE(mesh_error(replaced(t.content, four, replaced(four, "4 0", "-1.#IND 0")), t.name).find("not finite"),
              std::string::npos)
        << t.name;
  }
  const auto values = [](std::string_view text, const char* name) { return read_field(bytes_of(text), name).values; };
  EXPECT_EQ(values("1.5D+01\n-1d-1\n1.#INF\n-1.#INF000\n", "a.txt"),
            (std::vector<double>{15, -0.1, kInfinity, -kInfinity}));
  EXPECT_TRUE(std::isnan(values("-1.#IND\n", "a.txt").at(0)));
  EXPECT_TRUE(std::isnan(values("v\n1.#QNAN0\n", "a.csv").at(0)));
  for (const char* word : {"1.5D", "D5", "1.#", "1.#IN", "1.5D+0x", "1.5DD3", "--1.#IND"}) {
    EXPECT_NE(test::error_of([&] { values(word, "a.txt"); }).find("where a number is expected"), std::string::npos)
        << word;
  }
}

TEST(Foreign, NumbersThatAreNotUsedMayBeNone) {
  for (const char* nothing : {"nan nan nan", "-1.#IND 1.#QNAN 0", "-nan(ind) inf 0", "", "x y z"}) {
    expect_triangle("solid\nfacet normal " + std::string(nothing) +
                        "\nouter loop\nvertex 0 0 0\nvertex 3 0 0\nvertex 3 4 0\nendloop\nendfacet\nendsolid\n",
                    "a.stl", nothing);
  }
  expect_triangle(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float "
      "nx\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 -1.#IND\n3 0 0 nan\n3 4 0 inf\n3 0 1 "
      "2\n",
      "a.ply", "normals");
}

TEST(Foreign, ALocaleWithCommasChangesNothing) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  const char* set = nullptr;
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "nl_NL.UTF-8"}) {
    if (set == nullptr) set = std::setlocale(LC_ALL, name);
  }
  if (set == nullptr) GTEST_SKIP() << "no locale here writes a comma";
  for (const Text& t : triangle_texts()) expect_triangle(replaced(t.content, "4 0", "4.0 0"), t.name, set);
  std::setlocale(LC_ALL, before.c_str());
}

TEST(Foreign, OffMayHaveItsCountsGluedOnOrBeBinary) {
  expect_triangle("OFF3 1 0\n0 0 0\n3 0 0\n3 4 0\n3 0 1 2\n", "a.off", "glued");
  const std::string counts = packed<std::int32_t>({3, 1, 0}, true);
  const std::string face = packed<std::int32_t>({3, 0, 1, 2, 0}, true);
  expect_triangle("OFF BINARY\n" + counts + packed<float>({0, 0, 0, 3, 0, 0, 3, 4, 0}, true) + face, "a.off", "binary");
  std::string coloured;
  for (const auto& p : {std::array<float, 3>{0, 0, 0}, {3, 0, 0}, {3, 4, 0}}) {
    coloured += packed<float>({p[0], p[1], p[2], 0, 0, 1, 0.5F, 0.5F, 0.5F, 1}, true);
  }
  const std::string coloured_face = packed<std::int32_t>({3, 0, 1, 2, 4}, true) + packed<float>({1, 1, 1, 1}, true);
  expect_triangle("CNOFF BINARY\n" + counts + coloured + coloured_face, "a.off", "binary with colours and normals");
}

TEST(Foreign, VerticesOfTwoCoordinatesLieInThePlane) {
  const char* const remark = "the vertices have two coordinates: z is 0";
  for (const Text& t :
       {Text{"a.obj", "v 0 0\nv 3 0\nv 3 4\nf 1 2 3\n"}, Text{"a.off", "OFF\n3 1 0\n0 0\n3 0\n3 4\n3 0 1 2\n"}}) {
    expect_triangle(t.content, t.name, "two coordinates");
    EXPECT_EQ(read_text(t.content, t.name).remarks, (std::vector<std::string>{remark})) << t.name;
  }
  EXPECT_EQ(mesh_error("v 0 0\nv 1 0 0\n", "a.obj"),
            "file_malformed: a.obj:2: three coordinates, but the vertices before have two");
}

std::string binary_stl(const std::string& header) {
  return header + std::string(80 - header.size(), ' ') + packed<std::uint32_t>({1}) +
         packed<float>({0, 0, 1, 0, 0, 0, 3, 0, 0, 3, 4, 0}) + std::string(2, '\0');
}

TEST(Foreign, TheSizeTellsBinaryStlWithinAFewTrailingBytes) {
  for (const char* header : {"made by hand", "solid of binary", " solid", "SOLID x"}) {
    for (const std::size_t trailing : {0, 1, 2, 14, 49, 80}) {
      expect_triangle(binary_stl(header) + std::string(trailing, '\0'), "a.stl", header);
    }
  }
  EXPECT_EQ(read_text(binary_stl("solid x") + "\n", "a.stl").remarks,
            (std::vector<std::string>{"1 byte behind the last triangle left out"}));
}

TEST(Foreign, PlyMayHaveCapitalNamesAndListsOf64Bits) {
  expect_triangle(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double X\nproperty double Y\nproperty double Z\n"
      "element face 1\nproperty list uint uint Vertex_Indices\nend_header\n0 0 0\n3 0 0\n3 4 0\n3 0 1 2\n",
      "a.ply", "capitals");
  for (const char* type : {"int64", "uint64"}) {
    expect_triangle(
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list " +
            std::string(type) + " " + type + " vertex_indices\nend_header\n" +
            packed<float>({0, 0, 0, 3, 0, 0, 3, 4, 0}) + packed<std::int64_t>({3, 0, 1, 2}),
        "a.ply", type);
  }
}

TEST(Foreign, PlyHeadersThatEndInCrLeaveALineFeedBehindThemToTheData) {
  const std::string header =
      "ply\rformat binary_little_endian 1.0\relement vertex 3\rproperty uchar tag\rproperty float x\rproperty float y\r"
      "property float z\relement face 1\rproperty list uchar int vertex_indices\rend_header\r";
  std::string rows;
  for (const auto& p : {std::array<float, 3>{0, 0, 0}, {3, 0, 0}, {3, 4, 0}}) {
    rows += "\n" + packed<float>({p[0], p[1], p[2]});  // the first byte of the data looks like a line feed
  }
  expect_triangle(header + rows + "\3" + packed<std::int32_t>({0, 1, 2}), "a.ply", "CR");
}

TEST(Foreign, WhatFollowsTheRowsOfAPlyIsARemark) {
  const std::string text = triangle_texts()[2].content;
  EXPECT_EQ(read_text(text + "3 0 1 2\n", "a.ply").remarks,
            (std::vector<std::string>{"more follows the last row than the header names: left out"}));
  EXPECT_EQ(read_text(replaced(text, "3 0 1 2\n", "3 0 1 2 255 0 0\n"), "a.ply").remarks,
            (std::vector<std::string>{"1 row has more values than the header names: left out"}));
}

TEST(Foreign, SectionsOfBinaryGmshThatAreNotNeededArePassedOver) {
  const std::string junk = packed<double>({1, 2}) + "\n$Nodes\n\r\n";
  const std::string other =
      "$PhysicalNames\n1\n2 1 \"$skin\"\n$EndPhysicalNames\n$NodeData\n1\n\"d\"\n" + junk + "$EndNodeData\n";
  expect_triangle("$MeshFormat\n2.2 1 8\n" + packed<std::int32_t>({1}) + "\n$EndMeshFormat\n" + other + "$Nodes\n3\n" +
                      packed<std::int32_t>({1}) + packed<double>({0, 0, 0}) + packed<std::int32_t>({2}) +
                      packed<double>({3, 0, 0}) + packed<std::int32_t>({3}) + packed<double>({3, 4, 0}) +
                      "\n$EndNodes\n" + other + "$Elements\n1\n" + packed<std::int32_t>({2, 1, 0, 1, 1, 2, 3}) +
                      "\n$EndElements\n" + other,
                  "a.msh", "2.2");
  expect_triangle("$MeshFormat\n4.1 1 8\n" + packed<std::int32_t>({1}) + "\n$EndMeshFormat\n$Entities\n" + junk +
                      "$EndEntities\n" + other + "$Nodes\n" + packed<std::uint64_t>({1, 3, 1, 3}) +
                      packed<std::int32_t>({2, 1, 0}) + packed<std::uint64_t>({3, 1, 2, 3}) +
                      packed<double>({0, 0, 0, 3, 0, 0, 3, 4, 0}) + "\n$EndNodes\n$Elements\n" +
                      packed<std::uint64_t>({1, 1, 1, 1}) + packed<std::int32_t>({2, 1, 2}) +
                      packed<std::uint64_t>({1, 1, 1, 2, 3}) + "\n$EndElements\n" + other,
                  "a.msh", "4.1");
}

std::string meshb(std::int32_t version, bool big_endian) {
  const auto i32 = [&](std::initializer_list<std::int32_t> v) { return packed<std::int32_t>(v, big_endian); };
  const auto whole = [&](std::int64_t v) {
    return version >= 4 ? packed<std::int64_t>({v}, big_endian) : i32({static_cast<std::int32_t>(v)});
  };
  const auto real = [&](double v) {
    return version == 1 ? packed<float>({static_cast<float>(v)}, big_endian) : packed<double>({v}, big_endian);
  };
  std::string out = i32({1, version});
  const auto section = [&](std::int32_t keyword, const std::string& body) {
    const std::size_t next = out.size() + (version >= 3 ? 12 : 8) + body.size();
    const auto place = static_cast<std::int64_t>(keyword == 54 ? 0 : next);
    out += i32({keyword});
    out += version >= 3 ? packed<std::int64_t>({place}, big_endian) : i32({static_cast<std::int32_t>(place)});
    out += body;
  };
  section(3, i32({3}));
  section(1000, "what nobody knows");
  std::string vertices = whole(3);
  for (const Vec3& p : {Vec3{0, 0, 0}, {3, 0, 0}, {3, 4, 0}}) vertices += real(p.x) + real(p.y) + real(p.z) + whole(0);
  section(4, vertices);
  section(6, whole(1) + whole(1) + whole(2) + whole(3) + whole(9));
  section(54, "");
  return out;
}

TEST(Foreign, MeditBinaryIsReadInEveryVersionAndByteOrder) {
  for (const std::int32_t version : {1, 2, 3, 4}) {
    for (const bool big_endian : {false, true}) {
      expect_triangle(meshb(version, big_endian), "a.meshb", "version " + std::to_string(version));
      EXPECT_EQ(read_text(meshb(version, big_endian), "standard input").format, "MEDIT binary");
    }
  }
  EXPECT_EQ(mesh_error(packed<std::int32_t>({1, 2, 3, 4, 3}), "a.meshb"),
            "file_malformed: a.meshb: byte 16: the place of the next section is 4");
  EXPECT_EQ(mesh_error(packed<std::int32_t>({1, 2, 4, 0, 1000000}), "a.meshb"),
            "file_malformed: a.meshb: byte 20: 1000000 rows are promised, but only 0 bytes follow");
}

std::string gltf(const std::string& extra, const std::string& points) {
  const std::string binary = packed<float>({0, 0, 0, 3, 0, 0, 9, 9, 9, 3, 4, 0}) + packed<std::uint16_t>({2, 0});
  return "{\"asset\":{\"version\":\"2.0\"}" + extra +
         ",\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":["
         "{" +
         points +
         "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},"
         "{\"buffer\":0,\"byteOffset\":36,\"byteLength\":12},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":2}],"
         "\"buffers\":[{\"byteLength\":52,\"uri\":\"data:;base64," +
         detail::encode_base64(binary) + "\"}]}";
}

TEST(Foreign, SparseAccessorsOfGltfReplaceTheirElements) {
  const std::string sparse =
      "\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":2,\"componentType\":5123},\"values\":{\"bufferView\":1}},";
  expect_triangle(gltf("", "\"bufferView\":0," + sparse), "a.gltf", "sparse");
  EXPECT_EQ(positions_of(read_text(gltf("", sparse), "a.gltf").mesh),
            (std::vector<Vec3>{{0, 0, 0}, {0, 0, 0}, {3, 4, 0}}))
      << "without a buffer view the others are zeros";
  EXPECT_NE(mesh_error(gltf("", "\"bufferView\":0," + replaced(sparse, "\"count\":1", "\"count\":4")), "a.gltf")
                .find("more sparse elements than elements"),
            std::string::npos);
}

TEST(Foreign, GltfThatRequiresWhatIsNotKnownIsRefusedByName) {
  const std::string points = "\"bufferView\":0,";
  EXPECT_NE(mesh_error(gltf(",\"extensionsRequired\":[\"VENDOR_folding\"]", points), "a.gltf").find("'VENDOR_folding'"),
            std::string::npos);
  for (const char* harmless : {"KHR_materials_unlit", "KHR_mesh_quantization", "KHR_texture_transform"}) {
    EXPECT_EQ(mesh_error(gltf(",\"extensionsRequired\":[\"" + std::string(harmless) + "\"]", points), "a.gltf"), "");
  }
  EXPECT_NE(mesh_error("{\"asset\":{\"version\":\"1.0\"}}", "a.gltf").find("glTF 1.0 is not read"), std::string::npos);
}

TEST(Foreign, WhatMeshoptimizerPacksIsUnpackedWhereItIsBuiltIn) {
  const char* const plain = "oAAAATAAAACAATAAAACAAAABDAAAAP8BDAAAAIAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA=";
  const char* const filtered =
      "oAABPAAAAGAvAAE4AAAABAABDAAAAEAAATgAAAAEAAAAATgAAAAEAAAAAAAAAAAAAAAAAAAAAAAAAAAAAADyAAAA8gAAAPI=";
  const char *const triangles = "4PAAdodWZ3iphmWJaJgBaQAA", *const indices = "0AAEBAAAAAA=";
  const std::string text = test::packed_gltf(plain, "NONE", triangles, "TRIANGLES");
  if (mesh_error(text, "a.gltf").find("requires the extension 'EXT_meshopt_compression'") != std::string::npos) {
    GTEST_SKIP() << "no meshoptimizer";
  }
  expect_triangle(text, "a.gltf", "triangles");
  expect_triangle(test::packed_gltf(plain, "NONE", indices, "INDICES"), "a.gltf", "indices");
  expect_triangle(test::packed_gltf(filtered, "EXPONENTIAL", triangles, "TRIANGLES"), "a.gltf", "filtered");
  EXPECT_NE(mesh_error(test::packed_gltf(plain, "QUATERNION", triangles, "TRIANGLES"), "a.gltf")
                .find("has a filter that does not"),
            std::string::npos);
  EXPECT_NE(
      mesh_error(test::packed_gltf(plain, "NONE", triangles, "STRIPS"), "a.gltf").find("packed in a way that does not"),
      std::string::npos);
  EXPECT_NE(mesh_error(test::packed_gltf(indices, "NONE", triangles, "TRIANGLES"), "a.gltf").find("cannot be unpacked"),
            std::string::npos);
  EXPECT_NE(
      mesh_error(replaced(text, "\"byteStride\":12,\"count\":3", "\"byteStride\":12,\"count\":300000000"), "a.gltf")
          .find("far more than the file's size: refused"),
      std::string::npos);
}

TEST(Foreign, WhatDracoPacksIsUnpackedWhereItIsBuiltIn) {
  const char* const sequential = "RFJBQ08CAgEAAAABAwEAAQIBAQAJAwAAAAAAAAAAAAAAAAAAAAAAQEAAAAAAAAAAAAAAQEAAAIBAAAAAAA==";
  const std::string text = test::draco_gltf(sequential, 61);
  if (mesh_error(text, "a.gltf").find("requires the extension 'KHR_draco_mesh_compression'") != std::string::npos) {
    GTEST_SKIP() << "no Draco";
  }
  expect_triangle(text, "a.gltf", "sequential");
  const LoadedMesh walked = read_text(test::draco_gltf(edgebreaker, 70), "a.gltf");
  EXPECT_EQ(walked.mesh.face_count(), 1u);
  EXPECT_EQ(walked.mesh.report().area, 6) << "Draco's edgebreaker renumbers the points";
  EXPECT_NE(mesh_error(test::draco_gltf(sequential, 40), "a.gltf").find("packed by Draco cannot be unpacked"),
            std::string::npos);
  EXPECT_NE(mesh_error(replaced(text, "RFJBQ08C", "RFJBQ08D"), "a.gltf").find("is no mesh of Draco 2.2"),
            std::string::npos);
  const std::string many = std::string("DRACO\2\2\1\0\0\0", 11) + "\xff\xff\xff\xff\x0f\3" + std::string(40, '\0');
  EXPECT_NE(
      mesh_error(test::draco_gltf(detail::encode_base64(many).c_str(), many.size()), "a.gltf").find("far more than"),
      std::string::npos);
}

std::string vtu(const std::string& cells, const std::string& offsets, const std::string& types, int count) {
  const auto array = [](const char* name, const std::string& values) {
    return "<DataArray type=\"Int64\" Name=\"" + std::string(name) + "\" format=\"ascii\">" + values + "</DataArray>";
  };
  return "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"4\" NumberOfCells=\"" +
         std::to_string(count) +
         "\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 1 1 0"
         "</DataArray></Points><Cells>" +
         array("connectivity", cells) + array("offsets", offsets) + array("types", types) +
         "</Cells></Piece></UnstructuredGrid></VTKFile>";
}

TEST(Foreign, FacesOfAVtuAreReadAndOtherCellsAreNamed) {
  const LoadedMesh loaded =
      read_text(vtu("0 1 2 0 1 2 3 0 1 0 1 2 3 0 1 2 3", "3 7 9 13 17", "5 8 3 10 10", 5), "a.vtu");
  EXPECT_EQ(loaded.format, "VTU");
  EXPECT_EQ(faces_of(loaded.mesh).front(), (Face{0, 1, 2}));
  EXPECT_EQ(loaded.face_origin, (std::vector<Index>{0, 1, 1}));
  EXPECT_EQ(loaded.remarks, (std::vector<std::string>{"3 cells that are no faces left out (line: 1, tetrahedron: 2)"}));
  EXPECT_NE(mesh_error(vtu("0 1 2", "3", "5 5", 1), "a.vtu").find("1 cells, but 2 types"), std::string::npos);
  EXPECT_NE(mesh_error(vtu("0 1 4", "3", "5", 1), "a.vtu").find("names point 4"), std::string::npos);
}

TEST(Foreign, CompressorsOfVtkAreReadWhereTheyAreBuiltIn) {
  // "points" of one triangle, as VTK's writer packs 72 bytes with LZ4 and with LZMA.
  const auto file = [](const char* compressor, const char* points) {
    return "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\" header_type=\"UInt32\" compressor=\"" +
           std::string(compressor) +
           "\"><PolyData><Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points><DataArray type=\"Float64\" "
           "NumberOfComponents=\"3\" format=\"binary\">" +
           points +
           "</DataArray></Points><Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2"
           "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys></Piece>"
           "</PolyData></VTKFile>";
  };
  const std::string lz4 = file("vtkLZ4DataCompressor", "AQAAAACAAABIAAAAGQAAAA==HwABAAovCEAfAAMEGACgEEAAAAAAAAAAAA==");
  const std::string xz = file("vtkLZMADataCompressor",
                              "AQAAAACAAABIAAAASAAAAA==/Td6WFoAAAFpIt42AsAWSCEBFgAqosJT4ABHAA5dAABuFE/KP8GCWgG7p/"
                              "ogAAAA0yDHBQABJkit/1+bkEKZDQEAAAAAAVla");
  for (const std::string& text : {lz4, xz}) {
    const std::string error = mesh_error(text, "a.vtp");
    if (error.find("built without it") != std::string::npos) continue;
    expect_triangle(text, "a.vtp", "compressed");
  }
  EXPECT_NE(mesh_error(file("vtkFutureCompressor", ""), "a.vtp").find("'vtkFutureCompressor' is not read"),
            std::string::npos);
}

TEST(Foreign, VtkFilesMayCarryBitsAndStrings) {
  const std::string text =
      triangle_texts()[4].content +
      "POINT_DATA 3\nSCALARS b bit 1\nLOOKUP_TABLE default\n1 0 1\nFIELD f 2\nnames 1 3 string\nan%20apple\npear\n\n"
      "s 1 3 float\n1 2 3\n";
  expect_triangle(text, "a.vtk", "strings");
  EXPECT_EQ(read_field(bytes_of(text), "a.vtk", "s").values, (std::vector<double>{1, 2, 3}));
  const std::string binary = "# vtk DataFile Version 5.1\nt\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\n" +
                             packed<float>({0, 0, 0, 3, 0, 0, 3, 4, 0}, true) + "\nPOLYGONS 1 4\n" +
                             packed<std::int32_t>({3, 0, 1, 2}, true) +
                             "\nPOINT_DATA 3\nFIELD f 3\nbits 1 3 bit\n\xa0\nnames 1 3 string\n\xc5"
                             "apple\xc4pear\xc0\n"
                             "s 1 3 float\n" +
                             packed<float>({1, 2, 3}, true) + "\n";
  expect_triangle(binary, "a.vtk", "binary strings");
  EXPECT_EQ(read_field(bytes_of(binary), "a.vtk", "s").values, (std::vector<double>{1, 2, 3}));
}

TEST(Foreign, GiftiMayHoldItsTriplesAsColumns) {
  const auto array = [](const char* intent, const char* type, const char* order, int rows, int columns,
                        const std::string& values) {
    return "<DataArray Intent=\"NIFTI_INTENT_" + std::string(intent) + "\" DataType=\"NIFTI_TYPE_" + type +
           "\" ArrayIndexingOrder=\"" + order + "\" Dimensionality=\"2\" Dim0=\"" + std::to_string(rows) +
           "\" Dim1=\"" + std::to_string(columns) + "\" Encoding=\"ASCII\"><Data>" + values + "</Data></DataArray>";
  };
  const auto file = [](const std::string& arrays) { return "<GIFTI>" + arrays + "</GIFTI>"; };
  // In column-major order of three rows the numbers stand point by point; in row-major order x of all comes first.
  expect_triangle(file(array("POINTSET", "FLOAT32", "ColumnMajorOrder", 3, 3, "0 0 0 3 0 0 3 4 0") +
                       array("TRIANGLE", "INT32", "ColumnMajorOrder", 3, 1, "0 1 2")),
                  "a.surf.gii", "columns");
  expect_triangle(file(array("POINTSET", "FLOAT32", "RowMajorOrder", 3, 3, "0 3 3 0 0 4 0 0 0") +
                       array("TRIANGLE", "INT32", "RowMajorOrder", 3, 1, "0 1 2")),
                  "a.surf.gii", "rows");
  expect_triangle(file(array("POINTSET", "FLOAT32", "ColumnMajorOrder", 3, 3, "0 3 3 0 0 4 0 0 0") +
                       array("TRIANGLE", "INT32", "RowMajorOrder", 1, 3, "0 1 2")),
                  "a.surf.gii", "the ordinary way");
}

std::string model_3mf(const std::string& build, const std::string& attributes = "") {
  return test::three_mf("<?xml version=\"1.0\"?>\n<model " + attributes + "><resources>\n" + test::three_mf_objects() +
                        "</resources><build>" + build + "</build></model>");
}

TEST(Foreign, ObjectsOf3mfStandWhereTheirTransformsPutThem) {
  const std::string once = model_3mf("<item objectid=\"1\"/>");
  if (mesh_error(once, "a.3mf").find("built without libzip") != std::string::npos) GTEST_SKIP() << "no libzip";
  expect_triangle(once, "a.3mf", "one object");
  EXPECT_EQ(read_text(once, "standard input").format, "3MF");
  const LoadedMesh twice =
      read_text(model_3mf("<item objectid=\"2\" transform=\"2 0 0 0 2 0 0 0 2 0 0 0\"/>", "unit=\"inch\""), "a.3mf");
  // The second is turned by a quarter, moved, and then all is doubled.
  EXPECT_EQ(positions_of(twice.mesh),
            (std::vector<Vec3>{{0, 0, 0}, {6, 0, 0}, {6, 8, 0}, {20, 0, 10}, {20, 6, 10}, {12, 6, 10}}));
  EXPECT_EQ(faces_of(twice.mesh), (std::vector<Face>{{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(twice.remarks,
            (std::vector<std::string>{"the unit is the inch", "2 objects merged, their vertices one after the other"}));
}

TEST(Foreign, DefectsOf3mfHaveTheirMessages) {
  if (mesh_error(model_3mf("<item objectid=\"1\"/>"), "a.3mf").find("built without libzip") != std::string::npos) {
    GTEST_SKIP() << "no libzip";
  }
  EXPECT_EQ(mesh_error(model_3mf("<item objectid=\"7\"/>"), "a.3mf"),
            "file_malformed: a.3mf/3D/3dmodel.model:5: there is no object 7");
  EXPECT_NE(
      mesh_error(model_3mf("<item objectid=\"1\"/>", "xmlns:b=\"http://x/beamlattice/2017\" requiredextensions=\"b\""),
                 "a.3mf")
          .find("requires the extension 'http://x/beamlattice/2017', which is not read"),
      std::string::npos);
  EXPECT_EQ(mesh_error("PK\3\4 3D/", "a.3mf").substr(0, 27), "file_malformed: a.3mf: zip:");
  // An object that is made of itself ends somewhere.
  const std::string loop = test::three_mf(
      "<model><resources><object id=\"1\"><components><component objectid=\"1\"/><component "
      "objectid=\"1\"/></components>"
      "</object></resources><build><item objectid=\"1\"/></build></model>");
  EXPECT_NE(mesh_error(loop, "a.3mf").find("components are nested more than 32 deep"), std::string::npos);
  for (std::size_t size = 0; size < 600; size += 7)
    mesh_error(model_3mf("<item objectid=\"2\"/>").substr(0, size), "a.3mf");
}

}  // namespace
}  // namespace brushfire
