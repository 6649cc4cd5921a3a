// One small file per format, written out by hand, and what must come of it.
#include "io_support.h"

#include <brushfire/core/detail/base64.h>
#include <brushfire/io/detail/inflate.h>
#include <brushfire/io/read_field.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace brushfire {
namespace {

using detail::encode_base64;
using test::bytes_of;
using test::faces_of;
using test::mesh_error;
using test::packed;
using test::positions_of;
using test::read_text;
using test::TemporaryDirectory;

const std::vector<Vec3> kTriangle{{0, 0, 0}, {1, 0, 0}, {0, 0.5, 0}};
const std::vector<Face> kFace{{0, 1, 2}};

void expect_triangle(const LoadedMesh& loaded, const char* format) {
  EXPECT_EQ(positions_of(loaded.mesh), kTriangle);
  EXPECT_EQ(faces_of(loaded.mesh), kFace);
  EXPECT_EQ(loaded.format, format);
}

LoadedField field_of(std::string_view content, const std::string& file, const std::string& name = "") {
  return read_field(bytes_of(content), file, name);
}

TEST(Stl, AsciiIsWeldedExactlyAndKeepsTheMapBack) {
  const LoadedMesh loaded = read_text(
      "solid two words\n facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 .5 0\n endloop\n "
      "endfacet\n"
      "FACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 1 0 0\nVERTEX 1 1 0\nVERTEX -0 5e-1 0\nENDLOOP\nENDFACET\nendsolid\n",
      "a.stl");
  EXPECT_EQ(positions_of(loaded.mesh), (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 0.5, 0}, {1, 1, 0}}));
  EXPECT_EQ(faces_of(loaded.mesh), (std::vector<Face>{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(loaded.vertex_map, (std::vector<Index>{0, 1, 2, 1, 3, 2}));
}

std::string binary_stl(const std::vector<std::array<float, 9>>& triangles, const std::string& header = "") {
  std::string out = header + std::string(80 - header.size(), ' ') +
                    packed<std::uint32_t>({static_cast<std::uint32_t>(triangles.size())});
  for (const auto& t : triangles) {
    out += packed<float>({0, 0, 1});
    for (const float c : t) out += packed<float>({c});
    out += std::string(2, '\0');
  }
  return out;
}

TEST(Stl, BinaryIsReadAlsoWhereItsHeaderStartsWithSolid) {
  const std::string bytes =
      binary_stl({{0, 0, 0, 1, 0, 0, 0, 0.5f, 0}, {1, 0, 0, 0, 0, 0, 0, 0.5f, 1e-30f}}, "solid lies");
  const LoadedMesh loaded = read_text(bytes, "a.bin");
  EXPECT_EQ(loaded.format, "STL");
  EXPECT_EQ(loaded.mesh.vertex_count(), 4u) << "what differs by 1e-30 is not the same point";
  EXPECT_EQ(loaded.vertex_map, (std::vector<Index>{0, 1, 2, 1, 0, 3}));
}

TEST(Stl, WeldingManyPointsGivesEachItsOwnNumber) {
  std::vector<std::array<float, 9>> triangles;
  for (int k = 0; k < 3000; ++k) {
    const auto x = static_cast<float>(k);
    triangles.push_back({x, 0, 0, x + 1, 0, 0, x, 1, 0});
  }
  const LoadedMesh loaded = read_text(binary_stl(triangles), "a.stl");
  EXPECT_EQ(loaded.mesh.vertex_count(), 6001u);
  for (std::size_t k = 0; k < 3000; ++k) {
    const Face f = loaded.mesh.faces()[k];
    EXPECT_EQ(loaded.mesh.positions()[f[1]].x, static_cast<double>(k + 1));
  }
}

TEST(Vtk, AsciiPolyDataWithStripsAttributesAndMetadata) {
  const std::string text =
      "# vtk DataFile Version 4.2\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 0 0.5 0\n1 1 0\n\n"
      "METADATA\nINFORMATION 0\n\nVERTICES 1 2\n1 0\nPOLYGONS 1 4\n3 0 1 2\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\n"
      "CELL_DATA 2\nSCALARS c int\nLOOKUP_TABLE default\n1 2\n"
      "POINT_DATA 4\nNORMALS n float\n0 0 1 0 0 1 0 0 1 0 0 1\nSCALARS s double 1\nLOOKUP_TABLE default\n0 1 2.5 "
      "inf\nFIELD f 2\nv 3 4 float\n"
      "1 2 3 4 5 6 7 8 9 10 11 12\nt 1 4 int\n7 8 9 10\n";
  const LoadedMesh loaded = read_text(text, "a.vtk");
  EXPECT_EQ(faces_of(loaded.mesh), (std::vector<Face>{{0, 1, 2}, {0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(loaded.remarks, (std::vector<std::string>{"1 cell that is no face left out (vertices: 1)"}));
  EXPECT_EQ(field_of(text, "a.vtk").values, (std::vector<double>{0, 1, 2.5, kInfinity}));
  EXPECT_EQ(field_of(text, "a.vtk", "t").values, (std::vector<double>{7, 8, 9, 10}));
}

TEST(Vtk, BinaryVersion5WithOffsetsAndConnectivity) {
  const LoadedMesh loaded =
      read_text("# vtk DataFile Version 5.1\nt\nBINARY\nDATASET POLYDATA\nPOINTS 3 double\n" +
                    packed<double>({0, 0, 0, 1, 0, 0, 0, 0.5, 0}, true) + "\nPOLYGONS 2 3\nOFFSETS vtktypeint64\n" +
                    packed<std::int64_t>({0, 3}, true) + "\nCONNECTIVITY vtktypeint64\n" +
                    packed<std::int64_t>({0, 1, 2}, true) + "\n",
                "a.vtk");
  expect_triangle(loaded, "VTK");
}

TEST(Vtk, UnstructuredGridGivesItsFacesAndLeavesOutTheRest) {
  const LoadedMesh loaded = read_text(
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 1 1 0\n"
      "CELLS 3 14\n3 0 1 2\n4 0 1 2 3\n4 0 1 2 3\nCELL_TYPES 3\n5 8 10\n",
      "a.vtk");
  EXPECT_EQ(loaded.mesh.face_count(), 3u);
  EXPECT_EQ(loaded.face_origin, (std::vector<Index>{0, 1, 1}));
  EXPECT_EQ(loaded.remarks, (std::vector<std::string>{"1 cell that is no face left out (tetrahedron: 1)"}));
}

std::string vtp(const std::string& attributes, const std::string& points, const std::string& cells,
                const std::string& tail = "") {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\" " + attributes +
         ">\n<PolyData><Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\">\n<Points><DataArray type=\"Float64\" "
         "NumberOfComponents=\"3\" " +
         points + "</DataArray></Points>\n<Polys><DataArray type=\"Int64\" Name=\"connectivity\" " + cells +
         "</DataArray><DataArray type=\"UInt8\" Name=\"offsets\" "
         "format=\"ascii\">3</DataArray></Polys></Piece></PolyData>" +
         tail + "</VTKFile>\n";
}

const std::string kXyz = packed<double>({0, 0, 0, 1, 0, 0, 0, 0.5, 0});
const std::string kCorners = packed<std::int64_t>({0, 1, 2});

TEST(Vtp, AsciiBase64AppendedAndCompressedAreTheSame) {
  expect_triangle(read_text(vtp("", "format=\"ascii\">0 0 0 1 0 0 0 .5 0", "format=\"ascii\">0 1 2"), "a.vtp"), "VTP");
  const auto inline32 = [](const std::string& raw) {
    return "format=\"binary\">\n  " +
           encode_base64(packed<std::uint32_t>({static_cast<std::uint32_t>(raw.size())}) + raw) + "\n";
  };
  expect_triangle(read_text(vtp("", inline32(kXyz), inline32(kCorners)), "a.vtp"), "VTP");
  const auto compressed = [](const std::string& raw) {
    const std::string packed_raw = detail::deflate(raw), half = detail::deflate(raw.substr(0, 8)),
                      rest = detail::deflate(raw.substr(8, 8));
    const std::uint64_t blocks = raw.size() / 8;
    std::string header = packed<std::uint64_t>({blocks, 8, 0}), data;
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::string block = detail::deflate(raw.substr(8 * b, 8));
      header += packed<std::uint64_t>({block.size()});
      data += block;
    }
    return "format=\"binary\">" + encode_base64(header) + encode_base64(data);
  };
  const std::string zlib = "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\"";
  expect_triangle(read_text(vtp(zlib, compressed(kXyz), compressed(kCorners)), "a.vtp"), "VTP");
  const std::string raw = packed<std::uint32_t>({72}) + kXyz + packed<std::uint32_t>({24}) + kCorners;
  expect_triangle(read_text(vtp("", "format=\"appended\" offset=\"0\">", "format=\"appended\" offset=\"76\">",
                                "<AppendedData encoding=\"raw\">\n  _" + raw + "</AppendedData>"),
                            "a.vtp"),
                  "VTP");
  const std::string first = encode_base64(raw.substr(0, 76)), second = encode_base64(raw.substr(76));
  expect_triangle(read_text(vtp("", "format=\"appended\" offset=\"0\">",
                                "format=\"appended\" offset=\"" + std::to_string(first.size()) + "\">",
                                "<AppendedData encoding=\"base64\">\n  _" + first + second + "</AppendedData>"),
                            "a.vtp"),
                  "VTP");
}

std::string gifti(const std::string& points, const std::string& triangles) {
  const auto array = [](const char* intent, const char* type, const std::string& rows, const std::string& rest) {
    return std::string("<DataArray Intent=\"NIFTI_INTENT_") + intent + "\" DataType=\"NIFTI_TYPE_" + type +
           "\" ArrayIndexingOrder=\"RowMajorOrder\" Dimensionality=\"2\" Dim0=\"" + rows + "\" Dim1=\"3\" " + rest +
           "</DataArray>\n";
  };
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!DOCTYPE GIFTI SYSTEM "
         "\"http://www.nitrc.org/frs/download.php/115/gifti.dtd\">\n"
         "<GIFTI Version=\"1.0\" NumberOfDataArrays=\"2\">\n<MetaData/><LabelTable/>\n" +
         array("POINTSET", "FLOAT32", "3", points) + array("TRIANGLE", "INT32", "1", triangles) + "</GIFTI>\n";
}

TEST(Gifti, AsciiBase64ZlibAndExternalAreTheSame) {
  const std::string xyz = packed<float>({0, 0, 0, 1, 0, 0, 0, 0.5, 0}), corners = packed<std::int32_t>({0, 1, 2});
  const std::string ascii = "Encoding=\"ASCII\"><Data>0 1 2</Data>";
  expect_triangle(read_text(gifti("Encoding=\"ASCII\"><Data>\n0 0 0 1 0 0 0 0.5 0\n</Data>", ascii), "a.surf.gii"),
                  "GIFTI");
  const std::string base64 =
      "Encoding=\"Base64Binary\" Endian=\"LittleEndian\"><Data>" + encode_base64(xyz) + "</Data>";
  expect_triangle(read_text(gifti(base64, ascii), "a.surf.gii"), "GIFTI");
  const std::string big = "Encoding=\"Base64Binary\" Endian=\"BigEndian\"><Data>" +
                          encode_base64(packed<std::int32_t>({0, 1, 2}, true)) + "</Data>";
  expect_triangle(read_text(gifti(base64, big), "a.surf.gii"), "GIFTI");
  const std::string zlib =
      "Encoding=\"GZipBase64Binary\" Endian=\"LittleEndian\"><Data>" + encode_base64(detail::deflate(xyz)) + "</Data>";
  expect_triangle(read_text(gifti(zlib, ascii), "a.surf.gii"), "GIFTI");
  const TemporaryDirectory dir;
  test::write_file(dir / "a.dat", "1234" + corners);
  const std::string external =
      "Encoding=\"ExternalFileBinary\" Endian=\"LittleEndian\" ExternalFileName=\"a.dat\" "
      "ExternalFileOffset=\"4\"><Data/>";
  test::write_file(dir / "a.gii", gifti(base64, external));
  expect_triangle(read_mesh(dir / "a.gii"), "GIFTI");
  EXPECT_EQ(mesh_error(gifti(base64, external), "a.gii"),
            "file_malformed: a.gii:6: refers to the file 'a.dat', which is out of reach from here");
}

TEST(Gifti, LabelsComeWithTheirNames) {
  const LoadedField field = field_of(
      "<GIFTI><LabelTable><Label Key=\"0\"><![CDATA[???]]></Label><Label Key=\"7\">wall</Label></LabelTable>"
      "<DataArray Intent=\"NIFTI_INTENT_LABEL\" DataType=\"NIFTI_TYPE_INT32\" Dimensionality=\"1\" Dim0=\"3\" "
      "Encoding=\"ASCII\">"
      "<MetaData><MD><Name>Name</Name><Value>parcels</Value></MD></MetaData><Data>7 0 7</Data></DataArray></GIFTI>",
      "a.label.gii");
  EXPECT_EQ(field.values, (std::vector<double>{7, 0, 7}));
  EXPECT_EQ(field.name, "parcels");
  ASSERT_EQ(field.label_names.size(), 2u);
  EXPECT_EQ(field.label_names[1].key, 7);
  EXPECT_EQ(field.label_names[1].name, "wall");
  EXPECT_EQ(field.label_names[0].name, "???");
}

TEST(FreeSurfer, SurfaceCurvatureAnnotationAndLabel) {
  const std::string surface =
      "\xff\xff\xfe"
      "created by nobody\n\n" +
      packed<std::int32_t>({3, 1}, true) + packed<float>({0, 0, 0, 1, 0, 0, 0, 0.5, 0}, true) +
      packed<std::int32_t>({0, 1, 2}, true);
  expect_triangle(read_text(surface + "trailing geometry", "lh.white"), "FreeSurfer");
  expect_triangle(read_text(surface, "whatever"), "FreeSurfer");

  const std::string curv = "\xff\xff\xff" + packed<std::int32_t>({2, 1, 1}, true) + packed<float>({0.5, -1.5}, true);
  EXPECT_EQ(field_of(curv, "lh.thickness").values, (std::vector<double>{0.5, -1.5}));
  EXPECT_EQ(field_of(std::string("\0\0\2\0\0\1\0\x96\xff\x38", 10), "lh.curv").values, (std::vector<double>{1.5, -2}));

  const auto name = [](const std::string& n) {
    return packed<std::int32_t>({static_cast<std::int32_t>(n.size() + 1)}, true) + n + '\0';
  };
  const std::string annot = packed<std::int32_t>({3, 0, 255, 2, 256, 1, 999, 1, -2, 8}, true) + name("table") +
                            packed<std::int32_t>({2, 3}, true) + name("red") +
                            packed<std::int32_t>({255, 0, 0, 0, 5}, true) + name("green") +
                            packed<std::int32_t>({0, 1, 0, 0}, true);
  const LoadedField parcels = field_of(annot, "lh.aparc.annot");
  EXPECT_EQ(parcels.values, (std::vector<double>{3, -1, 5}));
  ASSERT_EQ(parcels.label_names.size(), 2u);
  EXPECT_EQ(parcels.label_names[1].name, "green");

  const LoadedField label = field_of("#!ascii label\n2\n4  1 2 3 0.5\n0  1 2 3 0\n", "lh.cortex.label");
  EXPECT_EQ(label.vertices, (std::vector<Index>{4, 0}));
  EXPECT_EQ(values_on_vertices(label, 5, -1), (std::vector<double>{0, -1, -1, -1, 0.5}));
}

std::string gltf(const std::string& nodes, const std::string& buffer, const std::string& mode = "4") {
  return "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":" + nodes +
         ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"mode\":" + mode +
         "}]}],"
         "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
         "{\"bufferView\":1,\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"}],"
         "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":6}],"
         "\"buffers\":[{\"byteLength\":42" +
         buffer + "}]}";
}

const std::string kBuffer = packed<float>({0, 0, 0, 1, 0, 0, 0, 0.5, 0}) + packed<std::uint16_t>({0, 1, 2});
const std::string kEmbedded = ",\"uri\":\"data:application/octet-stream;base64," + encode_base64(kBuffer) + "\"";

TEST(Gltf, EmbeddedExternalAndBinaryAreTheSame) {
  expect_triangle(read_text(gltf("[{\"mesh\":0}]", kEmbedded), "a.gltf"), "glTF");
  const TemporaryDirectory dir;
  test::write_file(dir / "a b.bin", kBuffer);
  test::write_file(dir / "a.gltf", gltf("[{\"mesh\":0}]", ",\"uri\":\"a%20b.bin\""));
  expect_triangle(read_mesh(dir / "a.gltf"), "glTF");
  std::string json = gltf("[{\"mesh\":0}]", "");
  while (json.size() % 4 != 0) json += ' ';
  const auto size = static_cast<std::uint32_t>(json.size()), binary = static_cast<std::uint32_t>(kBuffer.size());
  expect_triangle(read_text("glTF" + packed<std::uint32_t>({2, 28 + size + binary, size, 0x4e4f534a}) + json +
                                packed<std::uint32_t>({binary, 0x004e4942}) + kBuffer,
                            "a.glb"),
                  "glTF");
}

TEST(Gltf, NodeTransformsMultiplyFromTheRootAndPrimitivesAreMerged) {
  const LoadedMesh loaded =
      read_text(gltf("[{\"children\":[1,2],\"translation\":[10,0,0]},{\"mesh\":0,\"scale\":[2,2,2]},"
                     "{\"mesh\":0,\"rotation\":[0,0,0.7071067811865476,0.7071067811865476]}]",
                     kEmbedded),
                "a.gltf");
  const std::vector<Vec3> p = positions_of(loaded.mesh);
  ASSERT_EQ(p.size(), 6u);
  EXPECT_EQ(p[1], (Vec3{12, 0, 0}));
  EXPECT_NEAR(p[4].x, 10, 1e-15);
  EXPECT_NEAR(p[4].y, 1, 1e-15);
  EXPECT_EQ(faces_of(loaded.mesh), (std::vector<Face>{{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(loaded.remarks[0], "2 primitives merged, their vertices one after the other");
}

TEST(Gltf, WhatCouldHurtIsRefused) {
  EXPECT_EQ(mesh_error(gltf("[{\"children\":[0]}]", kEmbedded), "a.gltf"),
            "file_malformed: a.gltf: node 0 is reached twice: the nodes are no tree");
  EXPECT_EQ(mesh_error(std::string(100000, '['), "a.gltf"),
            "file_malformed: a.gltf: byte 0: JSON is nested more than 64 deep");
  EXPECT_EQ(mesh_error("{\"a\":}", "a.gltf"), "file_malformed: a.gltf: byte 5: not JSON");
  EXPECT_EQ(mesh_error("[1e999]", "a.gltf"), "file_malformed: a.gltf: byte 0: JSON with a number that no double holds");
  EXPECT_EQ(mesh_error("[]", "a.gltf"), "file_malformed: a.gltf: not as glTF says: no object at the top");
  const TemporaryDirectory dir;
  for (const char* outside : {"../a.bin", "/etc/passwd", "%2e%2e/a.bin"}) {
    test::write_file(dir / "a.gltf", gltf("[{\"mesh\":0}]", std::string(",\"uri\":\"") + outside + "\""));
    EXPECT_NE(test::error_of([&] { read_mesh(dir / "a.gltf"); }).find("which is not in its own folder or below"),
              std::string::npos)
        << outside;
  }
}

TEST(Gmsh, Versions2And4AsciiAndBinaryAreTheSame) {
  const std::string end = "\n$EndMeshFormat\n";
  expect_triangle(
      read_text(
          "$MeshFormat\n2.2 0 8" + end +
              "$PhysicalNames\n1\n2 1 \"a b\"\n$EndPhysicalNames\n$Nodes\n3\n7 0 0 0\n3 1 0 0\n9 0 .5 0\n$EndNodes\n"
              "$Elements\n2\n1 15 2 0 1 7\n2 2 2 0 1 7 3 9\n$EndElements\n",
          "a.msh"),
      "Gmsh");
  expect_triangle(read_text("$MeshFormat\n4.1 0 8" + end +
                                "$Entities\n0 0 1 0\n$EndEntities\n$Nodes\n2 3 1 3\n0 1 0 1\n1\n0 0 0\n2 1 0 "
                                "2\n2\n3\n1 0 0\n0 .5 0\n$EndNodes\n"
                                "$Elements\n1 1 1 1\n2 1 2 1\n1 1 2 3\n$EndElements\n",
                            "a.msh"),
                  "Gmsh");
  const std::string one = packed<std::int32_t>({1});
  std::string nodes;
  const double xyz[3][3]{{0, 0, 0}, {1, 0, 0}, {0, 0.5, 0}};
  for (std::int32_t k = 0; k < 3; ++k)
    nodes += packed<std::int32_t>({k + 1}) + packed<double>({xyz[k][0], xyz[k][1], xyz[k][2]});
  expect_triangle(
      read_text("$MeshFormat\n2.2 1 8\n" + one + end + "$Nodes\n3\n" + nodes + "\n$EndNodes\n$Elements\n1\n" +
                    packed<std::int32_t>({2, 1, 2, 1, 0, 1, 1, 2, 3}) + "\n$EndElements\n",
                "a.msh"),
      "Gmsh");
  expect_triangle(
      read_text("$MeshFormat\n4.1 1 8\n" + one + end + "$Nodes\n" + packed<std::uint64_t>({1, 3, 1, 3}) +
                    packed<std::int32_t>({2, 1, 0}) + packed<std::uint64_t>({3, 1, 2, 3}) + kXyz +
                    "\n$EndNodes\n$Elements\n" + packed<std::uint64_t>({1, 1, 1, 1}) + packed<std::int32_t>({2, 1, 2}) +
                    packed<std::uint64_t>({1, 1, 1, 2, 3}) + "\n$EndElements\n",
                "a.msh"),
      "Gmsh");
}

TEST(Medit, SkipsWhatIsNoFace) {
  expect_triangle(
      read_text("MeshVersionFormatted 2\n\nDimension\n3\nVertices 3\n0 0 0 1\n1 0 0 1\n0 .5 0 1\nEdges\n1\n1 2 0\n"
                "Triangles\n1\n1 2 3 5\nTetrahedra 0\nEnd\n",
                "a.mesh"),
      "MEDIT");
}

TEST(Field, CsvTextAndJson) {
  EXPECT_EQ(field_of("vertex,distance,source\r\n0,1.5,2\r\n1,inf,-1\r\n", "a.csv").values,
            (std::vector<double>{1.5, kInfinity}));
  EXPECT_EQ(field_of("vertex,distance,source\n0,1.5,2\n1,inf,-1\n", "a.csv", "source").values,
            (std::vector<double>{2, -1}));
  const LoadedField sparse = field_of("\"value\"; vertex\n 1 ; 4\n", "a.csv");
  EXPECT_EQ(sparse.vertices, (std::vector<Index>{4}));
  EXPECT_EQ(sparse.name, "value");
  EXPECT_EQ(field_of("1\n2\n", "a.csv").values, (std::vector<double>{1, 2}));
  EXPECT_EQ(field_of("# mask\n1 0\n+1 nan", "a.txt").values.size(), 4u);
  EXPECT_EQ(field_of("{\"schema\": 1, \"distance\": [1, null, 2e0], \"source\": [0, -1, 1]}", "a.json").values,
            (std::vector<double>{1, kInfinity, 2}));
  EXPECT_EQ(field_of("{\"distance\": [1], \"source\": [0, -1]}", "a.json", "source").values,
            (std::vector<double>{0, -1}));
}

TEST(Gzip, IsInflatedWhateverTheFormat) {
  // gzip -n of "OFF 3 1 0\n0 0 0\n1 0 0\n0 .5 0\n3 0 1 2\n"
  const TemporaryDirectory dir;
  const std::string gz = std::string("\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03", 10);
  const std::string text = "OFF 3 1 0\n0 0 0\n1 0 0\n0 .5 0\n3 0 1 2\n";
  const std::string zlib = detail::deflate(text);
  std::uint32_t crc = 0xffffffffu;
  for (const char c : text) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0u);
  }
  const std::string gzip =
      gz + zlib.substr(2, zlib.size() - 6) + packed<std::uint32_t>({~crc, static_cast<std::uint32_t>(text.size())});
  test::write_file(dir / "a.off.gz", gzip);
  expect_triangle(read_mesh(dir / "a.off.gz"), "OFF");
  EXPECT_EQ(mesh_error(gzip.substr(0, gzip.size() - 9), "a.off.gz"),
            "file_malformed: a.off.gz: gzip: compressed data ends early");
  std::string damaged = gzip;
  damaged[gzip.size() - 6] = static_cast<char>(damaged[gzip.size() - 6] ^ 1);
  EXPECT_EQ(mesh_error(damaged, "a.off.gz"),
            "file_malformed: a.off.gz: gzip: compressed data is damaged: incorrect data check");
}

}  // namespace
}  // namespace brushfire
