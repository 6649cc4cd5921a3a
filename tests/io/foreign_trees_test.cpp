// What other programs write in JSON, XML and ZIP: glTF, VTK, GIFTI and 3MF with what they pack and may leave out.
#include "io_support.h"
#include "one_triangle.h"

#include <brushfire/core/detail/base64.h>
#include <brushfire/io/read_field.h>
#include <brushfire/mesh/report.h>

#include "support/packed_gltf.h"
#include "support/stored_zip.h"

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
  using test::draco::edgebreaker, test::draco::sequential;
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
