// What other programs and other systems write: line ends, marks, numbers, headers and sections of their own. (Formats
// made of others, JSON, XML and ZIP: foreign_trees_test.cpp.)
#include "io_support.h"
#include "one_triangle.h"

#include <brushfire/io/read_field.h>
#include <brushfire/mesh/report.h>

#include <clocale>
#include <cmath>
#include <cstring>

namespace brushfire {
namespace {

using test::bytes_of;
using test::expect_triangle;
using test::faces_of;
using test::mesh_error;
using test::packed;
using test::positions_of;
using test::read_text;
using test::replaced;
using test::Text;
using test::triangle_texts;

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

}  // namespace
}  // namespace brushfire
