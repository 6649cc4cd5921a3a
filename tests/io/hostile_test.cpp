// Files that are broken or mean harm: one line that says where and why, and nothing worse.
#include "io_support.h"

#include <brushfire/io/detail/inflate.h>
#include <brushfire/io/read_field.h>
#include <brushfire/io/write_field.h>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <csignal>
#include <cstring>
#include <random>

namespace brushfire {
namespace {

using test::bytes_of;
using test::error_of;
using test::mesh_error;
using test::TemporaryDirectory;

struct Defect {
  const char* file;
  std::string content;
  const char* message;
};

const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kPlyFace = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kBinary =
    "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty double x\nproperty double y\nproperty double z\n";
const std::string kVtk = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n";
const std::string kMsh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";

std::vector<Defect> text_defects() {
  return {
      {"a.obj", "v 0 0 0\nv 1 x 0\n", "a.obj:2: 'x' where a coordinate is expected"},
      {"a.obj", "v 0\n", "a.obj:1: the line ends where a coordinate is expected"},
      {"a.obj", "v 0 0 0\nv 0 0\n", "a.obj:2: the line ends where a coordinate is expected"},
      {"a.obj", "v 0 0 nan\n", "a.obj:1: coordinate 'nan' is not finite"},
      {"a.obj", "v 0 0 -inf\n", "a.obj:1: coordinate '-inf' is not finite"},
      {"a.obj", "v 0 0 0\nf 1 2 3\n", "a.obj:2: face 1 names vertex 3, but there are 1 vertices, counted from 1"},
      {"a.obj", "v 0 0 0\nf 1 0 1\n", "a.obj:2: vertex number 0, but they count from 1"},
      {"a.obj", "v 0 0 0\n\nf 1 -2 1\n", "a.obj:3: vertex number -2 reaches back beyond the 1 vertices so far"},
      {"a.obj", "f 1 4294967299 1\n", "a.obj:1: vertex number 4294967299 is beyond 32 bits"},
      {"a.obj", "f 1 99999999999999999999 1\n", "a.obj:1: '99999999999999999999' where a vertex number is expected"},
      {"a.obj", "f 1/x 2 3\n", "a.obj:1: 'x' where an index is expected"},
      {"a.obj", std::string("\0\1\2", 3), "a.obj: has neither a vertex nor a face: no OBJ file"},
      {"a.off", "", "a.off: the file is empty"},
      {"a.off", "OFX\n", "a.off:1: 'OFX' where OFF is expected"},
      {"a.off", "OFF\n4294967296 1 0\n", "a.off:2: the number of vertices is 4294967296, but only 5 bytes follow"},
      {"a.off", "OFF\n9223372036854775808 1 0\n",
       "a.off:2: '9223372036854775808' where the number of vertices is expected"},
      {"a.off", "OFF\n-1 1 0\n", "a.off:2: the number of vertices is -1, which is negative"},
      {"a.off", "OFF\n2 0 0\n0 0 0\n", "a.off:4: the file ends where a coordinate is expected"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 -1\n", "a.off:4: a vertex number is -1, which is negative"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n3 0 0\n", "a.off:5: the file ends where a vertex number is expected"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n4000000000 0 0\n",
       "a.off:4: the number of corners is 4000000000, but only 5 bytes follow"},
      {"a.off", "OFF BINARY\n", "a.off: byte 11: the file ends early"},
      {"a.off", std::string("OFF BINARY\n\x7f\xff\xff\xff\0\0\0\0", 19),
       "a.off: byte 11: the number of vertices is 2147483647, but only 4 bytes follow"},
      {"a.off", "OFF\n2 0 0\n0 0\n0 0 1\n", "a.off:4: three coordinates, but the vertices before have two"},
      {"a.obj", "\xff\xfev\0 \0", "a.obj: is text in UTF-16, which is not read: save it as UTF-8"},
      {"a.ply", "plx\n", "a.ply:1: the file does not start with 'ply'"},
      {"a.ply", "ply\nformat ascii 1.0\n", "a.ply:3: the file ends within the header: no end_header"},
      {"a.ply", "ply\nformat middle_endian 1.0\n",
       "a.ply:2: 'middle_endian' where ascii, binary_little_endian or binary_big_endian is expected"},
      {"a.ply", "ply\nelement vertex 1\nproperty quad x\n",
       "a.ply:3: 'quad' where a type (char, uchar, short, ushort, int, uint, float, double) is expected"},
      {"a.ply", "ply\nproperty float x\n", "a.ply:2: a property before the first element"},
      {"a.ply", "ply\nelement vertex -3\n", "a.ply:2: element 'vertex' has -3 rows"},
      {"a.ply", "ply\nend_header\n", "a.ply:2: the header has no format line"},
      {"a.ply", kPly + "end_header\n0 0 0\n",
       "a.ply:3: the header promises 3 rows of element 'vertex', but only 6 bytes follow"},
      {"a.ply", kPly + kPlyFace + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
       "a.ply:13: face 0 names vertex 3, but there are 3 vertices"},
      {"a.ply", kPly + kPlyFace + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n",
       "a.ply:13: row 0 of element 'face' names vertex -1"},
      {"a.ply", kPly + kPlyFace + "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n",
       "a.ply:13: row 0 of element 'face' names vertex 1.500000"},
      {"a.ply", kPly + kPlyFace + "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n",
       "a.ply:13: a list of element 'face' has -3 entries"},
      {"a.ply", kPly + kPlyFace + "0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n",
       "a.ply:12: vertex 2 has a coordinate that is not finite"},
      {"a.ply", kPly + kPlyFace + "0 0 0\n1 0\n0 0 1 0\n3 0 1 2\n",
       "a.ply:11: the line ends within row 1 of the 3 of element 'vertex'"},
      {"a.ply", kPly + kPlyFace + "0 0 0\n1 0 0\n0 1 0\n3 0 1\n2\n",
       "a.ply:13: the line ends within row 0 of the 1 of element 'face'"},
      {"a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nendloop",
       "a.stl:5: 'endloop' where a coordinate is expected"},
      {"a.stl", "solid\nfacet normal 0 0 1\n", "a.stl:3: the file ends where outer is expected"},
      {"a.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET RECTILINEAR_GRID\n",
       "a.vtk:4: a dataset of type 'RECTILINEAR_GRID' is not read, only POLYDATA and UNSTRUCTURED_GRID"},
      {"a.vtk", kVtk + "POINTS 99999999999 float\n",
       "a.vtk:5: the number of points is 99999999999, but only 7 bytes follow"},
      {"a.vtk", kVtk + "POINTS 1 float\n0 0 0\nPOLYGONS 1 4\n4 0 0 0\n",
       "a.vtk:8: cell 0 of POLYGONS reaches beyond the 4 entries"},
      {"a.vtk", kVtk + "POINTS 1 float\n0 0 0\nPOLYGONS 1 4\n3 0 0 1\n",
       "a.vtk:7: face 0 names vertex 1, but there are 1 vertices"},
      {"a.mesh", "MeshVersionFormatted 1\nVertices\n1\n0 0 0 0\nTriangles\n1\n0 1 1 0\n",
       "a.mesh:7: a vertex number is 0, but they count from 1"},
      {"a.mesh", "MeshVersionFormatted 1\nVertices\n18446744073709551616\n",
       "a.mesh:3: '18446744073709551616' where the number of vertices is expected"},
      {"a.msh", "$MeshFormat\n3 0 8\n", "a.msh:2: version 3.00 is not read, only 2 and 4.1"},
      {"a.msh", kMsh + "$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n1 2 0 1 1 7\n$EndElements\n",
       "a.msh:10: an element names node 7, which does not exist"},
      {"a.msh", kMsh + "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n$Elements\n0\n",
       "a.msh:9: two nodes have the number 1"},
      {"a.xyz", "hello",
       "a.xyz: neither name nor content tell the format (known: PLY, OBJ, OFF, VTK, VTP, VTU, GIFTI, "
       "FreeSurfer, FreeSurfer text, glTF, Gmsh, MEDIT, MEDIT binary, STL, 3MF)"},
  };
}

std::vector<Defect> binary_and_xml_defects() {
  const std::string bomb =
      "<?xml version=\"1.0\"?><!DOCTYPE a [<!ENTITY b \"cccccccc\"><!ENTITY d \"&b;&b;&b;\">]><GIFTI>&d;</GIFTI>";
  std::string deep = "<GIFTI>";
  for (int k = 0; k < 100000; ++k) deep += "<a>";
  return {
      {"a.ply", kBinary + "end_header\n" + std::string(23, '\0'),
       "a.ply:3: the header promises 1 rows of element 'vertex' of at least 24 bytes, but only 23 bytes follow"},
      {"a.ply",
       kBinary + "element face 9223372036854775807\nproperty list uchar int vertex_indices\nend_header\n" +
           std::string(24, '\0'),
       "a.ply:7: the header promises 9223372036854775807 rows of element 'face' of at least 1 bytes, but only 0 bytes "
       "follow"},
      {"a.ply", kBinary + kPlyFace + std::string(24, '\0') + "\3\0\0\0\0",
       "a.ply: byte 197: the file ends in row 0 of the 1 of element 'face'"},
      {"a.ply", kBinary + kPlyFace + std::string(24, '\0') + "\3" + std::string(8, '\0') + "\xff\xff\xff\xff",
       "a.ply: byte 196: row 0 of element 'face' names vertex -1"},
      {"a.ply", kBinary + "end_header\n" + std::string(6, '\0') + "\xf8\x7f" + std::string(16, '\0'),
       "a.ply: byte 118: vertex 0 has a coordinate that is not finite"},
      {"a.stl", std::string(50, 'x'), "a.stl: byte 50: the file ends within the 84 bytes of a binary STL header"},
      {"a.stl", std::string(80, 'x') + "\xff\xff\xff\xff" + std::string(50, '\0'),
       "a.stl: byte 80: the header promises 4294967295 triangles, but only 1 follow"},
      {"lh.white",
       "\xff\xff\xfe"
       "no newline",
       "lh.white: byte 13: the file ends within the comment"},
      {"lh.white",
       "\xff\xff\xfe"
       "a\n\n\x7f\xff\xff\xff" +
           std::string(4, '\0'),
       "lh.white: byte 10: the number of vertices is 2147483647, but 4 bytes follow"},
      {"lh.white",
       "\xff\xff\xfe"
       "a\n\n\x80" +
           std::string(7, '\0'),
       "lh.white: byte 10: the number of vertices is -2147483648, but 4 bytes follow"},
      {"a.gii", bomb, "a.gii:1: declares an entity, which is refused"},
      {"a.gii", deep, "a.gii:1: elements are nested more than 64 deep"},
      {"a.gii", "<GIFTI>\n<a></b>", "a.gii:2: XML: mismatched tag"},
      {"a.gii", "<GIFTI></GIFTI>", "a.gii: has no array of points: no surface"},
      {"a.gii", std::string("<\0G\0", 4), "a.gii: byte 0: XML in UTF-16 is not read"},
      {"a.vtp", "<VTKFile type=\"ImageData\"></VTKFile>",
       "a.vtp:1: VTK XML of type 'ImageData' is not read, only PolyData and UnstructuredGrid"},
      {"a.vtp", "<VTKFile type=\"PolyData\">\n<Piece NumberOfPoints=\"18446744073709551616\"/></VTKFile>",
       "a.vtp:2: NumberOfPoints is '18446744073709551616', not a number"},
      {"a.glb", "glTF\2\0\0\0\0\0\0\0", "a.glb: byte 5: the file ends within the GLB header"},
  };
}

class Defects : public testing::TestWithParam<Defect> {};

TEST_P(Defects, HasItsMessage) {
  const Defect& d = GetParam();
  const std::string code = std::string(d.file) == "a.xyz" ? "unknown_format: " : "file_malformed: ";
  EXPECT_EQ(mesh_error(d.content, d.file), code + d.message);
}

INSTANTIATE_TEST_SUITE_P(Text, Defects, testing::ValuesIn(text_defects()));
INSTANTIATE_TEST_SUITE_P(BinaryAndXml, Defects, testing::ValuesIn(binary_and_xml_defects()));

std::string field_error(const std::string& content, const char* file) {
  return error_of([&] { read_field(bytes_of(content), file); });
}

TEST(FieldDefects, HaveTheirMessages) {
  EXPECT_EQ(field_error("1\ntwo\n", "a.txt"), "file_malformed: a.txt:2: 'two' where a number is expected");
  EXPECT_EQ(field_error("vertex,d\n0,1\n1,x\n", "a.csv"), "file_malformed: a.csv:3: 'x' where a number is expected");
  EXPECT_EQ(field_error("vertex,d\n0,1,2\n", "a.csv"), "file_malformed: a.csv:2: 3 cells, but the first line has 2");
  EXPECT_EQ(field_error("vertex,d\n-1,1\n", "a.csv"), "file_malformed: a.csv:2: '-1' is no vertex number");
  EXPECT_EQ(field_error("[" + std::string(200, '['), "a.json"),
            "file_malformed: a.json: the list '' holds other lists");
  EXPECT_EQ(field_error("{\"a\": 1", "a.json"), "file_malformed: a.json: byte 7: not JSON");
  const auto not_visited = [&](const std::string& list) {
    return field_error("{\"d\": [1, null], \"not_visited\": " + list + "}", "a.json");
  };
  EXPECT_EQ(not_visited("[1]"), "");
  EXPECT_EQ(not_visited("[0]"), "file_malformed: a.json: vertex 0 in 'not_visited' is not null in 'd'");
  EXPECT_EQ(not_visited("[2]"), "file_malformed: a.json: vertex 2 in 'not_visited' is not null in 'd'");
  EXPECT_EQ(not_visited("[18446744073709551615]"),
            "file_malformed: a.json: vertex 4294967295 in 'not_visited' is not null in 'd'");
  for (const char* list : {"[-1]", "[1.5]", "[null]", "[true]"}) {
    EXPECT_EQ(not_visited(list), "file_malformed: a.json: 'not_visited' holds what is no vertex number") << list;
  }
  EXPECT_EQ(field_error("\xff\xff\xff\x7f\xff\xff\xff\0\0\0\0\0\0\0\1", "lh.curv").substr(0, 24),
            "file_malformed: lh.curv:");
  EXPECT_EQ(field_error(std::string("\0\0\0\2\0\0\0\0", 8), "a.annot"),
            "file_malformed: a.annot: byte 4: the number of vertices is 2, but 4 bytes follow");
  EXPECT_EQ(field_error("# x\n9999999999\n", "a.label"),
            "file_malformed: a.label:2: the number of vertices is 9999999999, but only 1 bytes follow");
}

TEST(Hostile, AMessageIsOneLineAndQuotesAtMostFortyCharacters) {
  const std::string word(1000000, 'x');
  EXPECT_EQ(mesh_error("v 0 0 " + word + "\n", "a.obj"),
            "file_malformed: a.obj:1: '" + word.substr(0, 40) + "...' where a coordinate is expected");
  EXPECT_EQ(mesh_error("v 0 0 \x01\xff\x1b[31m\n", "a\n.obj"),
            "file_malformed: a\\x0a.obj:1: '\\x01\\xff\\x1b[31m' where a coordinate is expected");
}

TEST(Hostile, ALineMayBeOfAnyLength) {
  const std::string digits(10000000, '0');
  EXPECT_EQ(test::read_text("v 0 0 " + digits + "\nv 1 0." + digits + " 0\n#" + digits + "\nv 0 1 0\nf 1 2 3", "a.obj")
                .mesh.face_count(),
            1u);
}

// Samples of every format, to be cut and damaged.
std::vector<std::pair<std::string, std::string>> samples() {
  const TemporaryDirectory dir;
  std::mt19937 random(7);
  std::vector<Vec3> positions(12);
  for (Vec3& p : positions) p = {double(random() % 100), double(random() % 100) / 8, 1.5};
  const std::vector<Face> faces{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}, {0, 5, 11}};
  const Mesh mesh(positions, faces);
  const std::vector<double> values{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, kInfinity};
  const std::vector<Index> labels(12, 3);
  std::vector<std::pair<std::string, std::string>> all;
  for (const char* format : {"ply", "obj", "vtk", "vtp", "gii", "curv", "csv", "json", "npy"}) {
    const std::string file = std::string("a.") + format;
    write_field(dir / file, mesh, {values, labels, "distance", "source"});
    all.emplace_back(file, test::read_file(dir / file));
  }
  all.emplace_back("a.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3 255 0 0\n");
  all.emplace_back("a.stl",
                   "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
                   "0\nendloop\nendfacet\nendsolid a\n");
  all.emplace_back(
      "a.mesh",
      "MeshVersionFormatted 2\nDimension 3\nVertices\n3\n0 0 0 1\n1 0 0 1\n0 1 0 1\nTriangles\n1\n1 2 3 7\nEnd\n");
  all.emplace_back("a.msh", kMsh +
                                "$Nodes\n3\n1 0 0 0\n2 1 0 0\n9 0 1 0\n$EndNodes\n$Elements\n2\n1 15 2 0 1 1\n2 2 2 0 "
                                "1 1 2 9\n$EndElements\n");
  all.emplace_back("lh.white", std::string("\xff\xff\xfe"
                                           "c\n\n\0\0\0\3\0\0\0\1",
                                           14) +
                                   std::string(36, '\0') + std::string("\0\0\0\0\0\0\0\1\0\0\0\2", 12));
  return all;
}

// Reads `content` as mesh and as field: results and errors of one line are both fine.
void read_both(const std::string& content, const std::string& file, const std::string& where) {
  for (const bool as_mesh : {true, false}) {
    const std::string message = error_of([&] {
      if (as_mesh) {
        test::read_text(content, file);
      } else {
        read_field(bytes_of(content), file);
      }
    });
    EXPECT_EQ(message.find('\n'), std::string::npos) << where << ": " << message;
  }
}

TEST(Hostile, AFileThatIsCutAnywhereIsReadOrRefusedInOneLine) {
  for (const auto& [file, content] : samples()) {
    for (std::size_t n = 0; n <= content.size(); ++n)
      read_both(content.substr(0, n), file, file + " cut at " + std::to_string(n));
  }
}

TEST(Hostile, BinaryFilesThatAreCutAnywhereAreRefused) {
  for (const auto& [file, content] : samples()) {
    if (file != "a.ply" && file != "lh.white") continue;
    for (std::size_t n = 0; n < content.size(); ++n) {
      EXPECT_NE(mesh_error(content.substr(0, n), file), "") << file << " cut at " << n;
    }
  }
}

TEST(Hostile, DamagedBytesAreReadOrRefusedInOneLine) {
  const auto all = samples();
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    for (const auto& [file, content] : all) {
      std::string damaged = content;
      for (std::uint32_t k = 0; k < 1 + seed % 4; ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
      read_both(damaged, file, file + " with seed " + std::to_string(seed));
    }
  }
}

TEST(Hostile, AZipBombIsRefused) {
  const std::string zeros(80 << 20, '\0');
  const std::string zlib = detail::deflate(zeros);
  const std::string gzip = std::string("\x1f\x8b\x08\0\0\0\0\0\0\3", 10) + zlib.substr(2);
  EXPECT_EQ(mesh_error(gzip, "a.obj.gz"), "file_malformed: a.obj.gz: gzip: inflates to more than " +
                                              std::to_string((64u << 20) + 100 * gzip.size()) +
                                              " bytes, over 100 times its size: refused");
}

TEST(Reading, WhatIsNoFileIsRefusedAtOnce) {
  const TemporaryDirectory dir;
  const auto message = [&](const std::string& path) { return error_of([&] { read_mesh(path); }); };
  EXPECT_EQ(message(dir / "none.obj"), "file_not_readable: " + (dir / "none.obj") + ": no such file");
  EXPECT_EQ(message(dir.path().string()), "file_not_readable: " + dir.path().string() + ": is a directory");
  EXPECT_EQ(message("/dev/zero"), "file_not_readable: /dev/zero: is a device");
  ASSERT_EQ(mkfifo((dir / "pipe.obj").c_str(), 0600), 0);
  EXPECT_EQ(message(dir / "pipe.obj"),
            "file_not_readable: " + (dir / "pipe.obj") + ": is a named pipe; feed it to standard input and name it -");
  test::write_file(dir / "empty.ply", "");
  EXPECT_EQ(message(dir / "empty.ply"), "file_malformed: " + (dir / "empty.ply") + ": the file is empty");
}

TEST(Reading, WithoutPermissionIsAnErrorThatSaysSo) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const TemporaryDirectory dir;
  test::write_file(dir / "a.obj", "v 0 0 0\n");
  ASSERT_EQ(chmod((dir / "a.obj").c_str(), 0), 0);
  EXPECT_EQ(error_of([&] { read_mesh(dir / "a.obj"); }),
            "file_not_readable: " + (dir / "a.obj") + ": Permission denied");
}

class Writing : public testing::Test {
 protected:
  Mesh mesh_{std::vector<Vec3>(50000), std::vector<Face>(100000, Face{0, 1, 2})};
  std::vector<double> values_ = std::vector<double>(50000, 1.5);
  std::string error(const std::string& path, const std::string& format = "ply") {
    return error_of([&] { write_field(path, mesh_, {values_, {}, "distance", "source"}, format); });
  }
};

TEST_F(Writing, FullDiskIsAnErrorThatSaysSo) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  EXPECT_EQ(error("/dev/full"), "file_not_writable: /dev/full: cannot be written: No space left on device");
}

TEST_F(Writing, AFailureLeavesTheOldFileAndNothingElse) {
  const TemporaryDirectory dir;
  test::write_file(dir / "a.ply", "old");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{100000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = error(dir / "a.ply");
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(message, "file_not_writable: " + (dir / "a.ply") + ": cannot be written: File too large");
  EXPECT_EQ(test::read_file(dir / "a.ply"), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir.path()), {}), 1) << "a temporary was left behind";
}

TEST_F(Writing, AClosedPipeIsAnErrorThatSaysSo) {
  std::signal(SIGPIPE, SIG_IGN);
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  const std::string path = "/proc/self/fd/" + std::to_string(ends[1]);
  const std::string message = error(path);
  close(ends[1]);
  EXPECT_EQ(message, "file_not_writable: " + path + ": cannot be written: Broken pipe");
}

TEST_F(Writing, ADirectoryOrAMissingFolderIsAnError) {
  const TemporaryDirectory dir;
  EXPECT_EQ(error(dir.path().string()), "file_not_writable: " + dir.path().string() + ": is a directory");
  EXPECT_EQ(error(dir / "none/a.ply"),
            "file_not_writable: " + (dir / "none/a.ply") + ": cannot be created: No such file or directory");
}

TEST_F(Writing, ALinkKeepsPointingToWhatIsWritten) {
  const TemporaryDirectory dir;
  test::write_file(dir / "real.ply", "old");
  std::filesystem::create_symlink(dir / "real.ply", dir / "link.ply");
  EXPECT_EQ(error(dir / "link.ply"), "");
  EXPECT_TRUE(std::filesystem::is_symlink(dir / "link.ply"));
  EXPECT_EQ(read_mesh(dir / "real.ply").mesh.vertex_count(), 50000u);
}

}  // namespace
}  // namespace brushfire
