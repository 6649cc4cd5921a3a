// Writes a few small valid files per reader into DIRECTORY/READER/, for the fuzzers to start from.
#include <brushfire/core/detail/base64.h>
#include <brushfire/core/error.h>
#include <brushfire/io/npy.h>
#include <brushfire/io/write_field.h>
#include <brushfire/io/write_lines.h>
#include <brushfire/io/write_mesh.h>

#include "../tests/support/packed_gltf.h"
#include "../tests/support/stored_zip.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

using namespace brushfire;

const std::vector<Vec3> kPositions{{0, 0, 0}, {1, 0, 0.5}, {1, 1, 0}, {0, 1, 1e-3}, {2, 2, 2}};
const std::vector<Face> kFaces{{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};

class Seeds {
 public:
  explicit Seeds(std::filesystem::path directory) : directory_(std::move(directory)) {}

  std::string path(const std::string& reader, const std::string& name) const {
    std::filesystem::create_directories(directory_ / reader);
    return (directory_ / reader / name).string();
  }
  void text(const std::string& reader, const std::string& name, const std::string& content) const {
    std::ofstream(path(reader, name), std::ios::binary) << content;
  }

 private:
  std::filesystem::path directory_;
};

template <class T>
std::string packed(std::initializer_list<T> values, bool big_endian = false) {
  std::string out;
  for (T v : values) {
    char raw[sizeof(T)];
    std::memcpy(raw, &v, sizeof(T));
    if (big_endian) std::reverse(raw, raw + sizeof(T));
    out.append(raw, sizeof(T));
  }
  return out;
}

void from_writers(const Seeds& seeds) {
  const Mesh mesh(kPositions, kFaces);
  const std::vector<double> values{0, 1, 1.5, 1e-3, kInfinity};
  const std::vector<Index> labels{0, 0, 1, 1, kNoIndex};
  const FieldView field{values, labels, "distance", "source"};
  for (const char* format : {"ply", "vtk", "vtp", "obj", "csv", "json"})
    write_field(seeds.path(format, "written"), mesh, field, format);
  write_field(seeds.path("gifti", "written"), mesh, field, "gii");
  write_field(seeds.path("curv", "written"), mesh, field, "curv");
  for (const char* format : {"off", "stl", "msh", "mesh"}) {
    const std::string reader = std::string(format) == "msh" ? "gmsh" : std::string(format) == "mesh" ? "medit" : format;
    write_mesh(seeds.path(reader, "written"), mesh, format);
  }
  write_mesh(seeds.path("gltf", "written"), mesh, "glb");
  write_mesh(seeds.path("gifti", "written-surface"), mesh, "gii", "CortexLeft");
  write_mesh(seeds.path("freesurfer", "written"), mesh, "white");
  write_mesh(seeds.path("freesurfer_text", "written"), mesh, "asc");
  write_mesh(seeds.path("medit_binary", "written"), mesh, "meshb");
  const std::vector<SurfacePath> lines{{{{0, {1, 0, 0}}, {0, {0.5, 0, 0.5}}, {1, {0.25, 0.5, 0.25}}}, 0.75, false},
                                       {{{0, {1, 0, 0}}, {0, {0, 1, 0}}, {0, {0, 0, 1}}}, 3.5, true}};
  for (const char* format : {"csv", "json", "obj", "ply", "vtp"}) {
    write_lines(seeds.path(format, "curves"), mesh, lines, "length", format);
  }
  write_npy(seeds.path("npy", "doubles"), values);
  const std::vector<std::size_t> shape{5, 1};
  write_npy(seeds.path("npy", "column"), labels, shape);
}

void texts(const Seeds& seeds) {
  seeds.text("off", "plain", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3 255 0 0\n");
  seeds.text("off", "binary",
             "CNOFF BINARY\n" + packed<std::int32_t>({1, 1, 0}, true) +
                 packed<float>({0, 0, 0, 0, 0, 1, 1, 1, 1, 1}, true) + packed<std::int32_t>({3, 0, 0, 0, 0}, true));
  seeds.text("off", "planar", "OFF3 1 0\r0 0\r1 0D0\r1 1\r3 0 1 2\r");
  seeds.text("obj", "polygon", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv .2 .3 0\nv 0 1 0\nf 1/1/1 2//2 3/3 \\\n 4 -1\nl 1 2\n");
  seeds.text("ply", "ascii",
             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty "
             "list uchar int e\n"
             "element face 1\nproperty list uchar int vertex_indices\nelement tristrips 1\nproperty list int int "
             "vertex_indices\nend_header\n"
             "0 0 0 0\n1 0 0 1 2\n1 1 0 0\n0 1 0 0\n4 0 1 2 3\n6 0 1 2 -1 2 3\n");
  seeds.text("ply", "big",
             "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty short y\nproperty double "
             "z\nelement face 1\n"
             "property list uchar uint vertex_index\nend_header\n" +
                 std::string(42, '\0') + '\3' + packed<std::uint32_t>({0, 1, 2}, true));
  seeds.text("stl", "ascii",
             "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
             "0\nendloop\nendfacet\nendsolid a\n");
  seeds.text("stl", "binary",
             std::string(80, ' ') + packed<std::uint32_t>({1}) + packed<float>({0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) +
                 std::string(2, '\0'));
  seeds.text("medit", "plain",
             "MeshVersionFormatted 2\nDimension 3\nVertices\n3\n0 0 0 1\n1 0 0 1\n0 1 0 1\nEdges\n1\n1 2 "
             "3\nTriangles\n1\n1 2 3 7\nEnd\n");
  seeds.text("text", "plain", "# c\n0 1.5 inf\n-2e-3\n");
  seeds.text("csv", "plain", "vertex;value\n3;1.5\n0;inf\n");
  seeds.text("label", "plain", "#!ascii label\n2\n0 1 2 3 0.5\n4 1 2 3 0\n");
}

// Values of faces.
void weights(const Seeds& seeds) {
  const std::string quad = "0 0 0 1 0 0 1 1 0 0 1 0";
  seeds.text("ply", "faces",
             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement "
             "face 2\nproperty list uchar int vertex_indices\nproperty float friction\nend_header\n"
             "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 1.5\n4 0 1 2 3 2\n");
  seeds.text("vtk", "faces",
             "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n" + quad +
                 "\nPOLYGONS 2 9\n3 0 1 2\n4 0 1 2 3\nCELL_DATA 2\nSCALARS friction double 1\nLOOKUP_TABLE "
                 "default\n1.5 2\nFIELD f 1\nb 1 2 int\n1 2\n");
  seeds.text("vtp", "faces",
             "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"4\" NumberOfPolys=\"2\"><CellData>"
             "<DataArray type=\"Float64\" Name=\"friction\" format=\"ascii\">1.5 2</DataArray></CellData><Points>"
             "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" +
                 quad +
                 "</DataArray></Points><Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 0 "
                 "1 2 3</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3 7</DataArray></Polys>"
                 "</Piece></PolyData></VTKFile>");
}

void grids(const Seeds& seeds) {
  seeds.text("ascii_grid", "corner", "ncols 3\nnrows 2\nxllcorner 1e3\nyllcorner 0\ncellsize 10\n0 1 2\n3 -9999 nan\n");
  seeds.text("ascii_grid", "center",
             "NCOLS 2\r\nNROWS 2\r\nXLLCENTER 0\r\nYLLCENTER 0\r\nDX 1\r\nDY 2.5\r\nNODATA_value -1.#IND\r\n0 1 1.0D-3 "
             "2\r\n");
}

void volumes(const Seeds& seeds) {
  seeds.text("gmsh", "2",
             "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n9 0 1 0\n$EndNodes\n$Elements\n2\n1 "
             "15 2 0 1 1\n2 2 2 0 1 1 2 9\n$EndElements\n");
  seeds.text("gmsh", "4",
             "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n"
             "$Elements\n1 1 1 1\n2 1 2 1\n1 1 2 3\n$EndElements\n");
  seeds.text("gmsh", "2-binary",
             "$MeshFormat\n2.2 1 8\n" + packed<std::int32_t>({1}) + "\n$EndMeshFormat\n$Nodes\n1\n" +
                 packed<std::int32_t>({1}) + packed<double>({0, 0, 0}) + "\n$EndNodes\n$Elements\n1\n" +
                 packed<std::int32_t>({2, 1, 0, 1, 1, 1, 1}) + "\n$EndElements\n");
  seeds.text("gmsh", "4-binary",
             "$MeshFormat\n4.1 1 8\n" + packed<std::int32_t>({1}) + "\n$EndMeshFormat\n$Nodes\n" +
                 packed<std::uint64_t>({1, 1, 1, 1}) + packed<std::int32_t>({2, 1, 0}) + packed<std::uint64_t>({1, 1}) +
                 packed<double>({0, 0, 0}) + "\n$EndNodes\n$Elements\n" + packed<std::uint64_t>({1, 1, 1, 1}) +
                 packed<std::int32_t>({2, 1, 2}) + packed<std::uint64_t>({1, 1, 1, 1, 1}) + "\n$EndElements\n");
  seeds.text(
      "vtk", "ascii",
      "# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 "
      "0\nMETADATA\nINFORMATION 0\n\n"
      "POLYGONS 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n0 1 2\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\n"
      "POINT_DATA 4\nSCALARS s float 1\nLOOKUP_TABLE default\n0 1 2 3\nFIELD f 1\na 1 4 int\n0 1 2 3\nNORMALS n "
      "float\n0 0 1 0 0 1 0 0 1 0 0 1\n");
  seeds.text("vtk", "grid",
             "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 0 0 0 1 0 1 1 "
             "0\nCELLS 2 9\n3 0 1 2\n4 0 1 2 3\nCELL_TYPES 2\n5 8\n");
  seeds.text("vtk", "strings",
             "# vtk DataFile Version 5.1\nt\nBINARY\nDATASET POLYDATA\nPOINTS 1 float\n" + std::string(12, '\0') +
                 "\nPOINT_DATA 1\nFIELD f 2\nb 1 1 bit\n\x80\nn 1 1 string\n\xc1z\n");
  seeds.text(
      "vtp", "grid",
      "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"3\" NumberOfCells=\"1\"><Points>"
      "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 "
      "0</DataArray></Points><Cells>"
      "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray><DataArray type=\"Int64\" "
      "Name=\"offsets\" format=\"ascii\">3</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5"
      "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>");
  const std::string packed_points[]{
      "vtkLZ4DataCompressor", "AQAAAACAAABIAAAAGQAAAA==HwABAAovCEAfAAMEGACgEEAAAAAAAAAAAA==", "vtkLZMADataCompressor",
      "AQAAAACAAABIAAAASAAAAA=="
      "/Td6WFoAAAFpIt42AsAWSCEBFgAqosJT4ABHAA5dAABuFE/KP8GCWgG7p/ogAAAA0yDHBQABJkit/1+bkEKZDQEAAAAAAVla"};
  for (const std::size_t k : {0, 2}) {
    seeds.text(
        "vtp", packed_points[k],
        "<VTKFile type=\"PolyData\" compressor=\"" + packed_points[k] +
            "\"><PolyData><Piece NumberOfPoints=\"3\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
            "format=\"binary\">" +
            packed_points[k + 1] + "</DataArray></Points></Piece></PolyData></VTKFile>");
  }
  const std::string points =
      detail::encode_base64(packed<std::uint32_t>({36}) + packed<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}));
  seeds.text("vtp", "inline",
             "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\"><PolyData><Piece "
             "NumberOfPoints=\"3\" NumberOfPolys=\"1\">"
             "<PointData><DataArray type=\"Float32\" Name=\"s\" format=\"ascii\">0 1 2</DataArray></PointData>"
             "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"binary\">" +
                 points +
                 "</DataArray></Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 "
                 "2</DataArray>"
                 "<DataArray type=\"Int32\" Name=\"offsets\" "
                 "format=\"ascii\">3</DataArray></Polys></Piece></PolyData></VTKFile>");
}

void brains(const Seeds& seeds) {
  const std::string array =
      "\" ArrayIndexingOrder=\"RowMajorOrder\" Dimensionality=\"2\" Dim0=\"3\" Dim1=\"3\" Endian=\"LittleEndian\" "
      "Encoding=\"";
  seeds.text(
      "gifti", "surface",
      "<?xml version=\"1.0\"?>\n<GIFTI Version=\"1.0\"><LabelTable><Label Key=\"1\"><![CDATA[a]]></Label></LabelTable>"
      "<DataArray Intent=\"NIFTI_INTENT_POINTSET\" DataType=\"NIFTI_TYPE_FLOAT32" +
          array + "Base64Binary\"><Data>" + detail::encode_base64(packed<float>({0, 0, 0, 1, 0, 0, 0, 1, 0})) +
          "</Data></DataArray>"
          "<DataArray Intent=\"NIFTI_INTENT_TRIANGLE\" DataType=\"NIFTI_TYPE_INT32\" Dimensionality=\"2\" Dim0=\"1\" "
          "Dim1=\"3\" Encoding=\"ASCII\"><Data>0 1 2</Data></DataArray></GIFTI>");
  const std::string triangle = packed<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, true) + packed<std::int32_t>({0, 1, 2}, true);
  seeds.text("freesurfer", "triangle",
             "\xff\xff\xfe"
             "created by\n\n" +
                 packed<std::int32_t>({3, 1}, true) + triangle);
  seeds.text("freesurfer", "quads", std::string("\xff\xff\xff\0\0\1\0\0\1", 9) + std::string(6 + 12, '\0'));
  const std::string name = packed<std::int32_t>({2}, true) + std::string("a\0", 2);
  seeds.text("annot", "new",
             packed<std::int32_t>({2, 0, 255, 1, 0, 1, -2, 8}, true) + name + packed<std::int32_t>({1, 3}, true) +
                 name + packed<std::int32_t>({255, 0, 0, 0}, true));
  seeds.text("annot", "old",
             packed<std::int32_t>({1, 0, 255, 1, 1}, true) + name + name + packed<std::int32_t>({255, 0, 0, 0}, true));
  seeds.text("curv", "old", std::string("\0\0\1\0\0\1\0\7", 8));
}

void scenes(const Seeds& seeds) {
  seeds.text(
      "3mf", "components",
      test::three_mf("<model unit=\"inch\" xmlns:p=\"http://x/production/\" requiredextensions=\"p\"><resources>" +
                     test::three_mf_objects() +
                     "</resources><build><item objectid=\"2\" p:path=\"/3D/3dmodel.model\"/></build></model>"));
  namespace meshopt = test::meshopt;
  seeds.text("gltf", "meshopt", test::packed_gltf(meshopt::plain, "NONE", meshopt::triangles, "TRIANGLES"));
  seeds.text("gltf", "meshopt-filtered",
             test::packed_gltf(meshopt::filtered, "EXPONENTIAL", meshopt::indices, "INDICES"));
  seeds.text("gltf", "draco", test::draco_gltf(test::draco::sequential, 61));
  seeds.text("gltf", "draco-edgebreaker", test::draco_gltf(test::draco::edgebreaker, 70));
  const std::string binary = packed<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) + packed<std::uint16_t>({0, 1, 2, 0});
  const std::string start =
      "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"children\":[1],"
      "\"translation\":[1,2,3]},"
      "{\"mesh\":0,\"rotation\":[0,0,0,1],\"scale\":[1,1,2]}],\"meshes\":[{\"primitives\":[{\"attributes\":{"
      "\"POSITION\":0},\"indices\":1,\"mode\":4}]}],"
      "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{\"bufferView\":1,"
      "\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"}],"
      "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":6}],"
      "\"buffers\":[{\"byteLength\":44";
  seeds.text("gltf", "embedded",
             start + ",\"uri\":\"data:application/octet-stream;base64," + detail::encode_base64(binary) + "\"}]}");
  std::string json = start + "}]}";
  while (json.size() % 4 != 0) json += ' ';
  const auto size = static_cast<std::uint32_t>(json.size()), tail = static_cast<std::uint32_t>(binary.size());
  seeds.text("gltf", "binary",
             "glTF" + packed<std::uint32_t>({2, 28 + size + tail, size, 0x4e4f534a}) + json +
                 packed<std::uint32_t>({tail, 0x004e4942}) + binary);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_seeds DIRECTORY\n");
    return 2;
  }
  try {
    const Seeds seeds(argv[1]);
    from_writers(seeds);
    texts(seeds);
    weights(seeds);
    grids(seeds);
    volumes(seeds);
    brains(seeds);
    scenes(seeds);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "make_seeds: %s\n", e.what());
    return 1;
  }
  return 0;
}
