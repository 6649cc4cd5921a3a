// The memory that reading takes is a small multiple of the file's size, whatever its headers promise.
//
// A program of its own: it counts every allocation of the process.
#include "io_support.h"

#include <brushfire/io/read_field.h>
#include <brushfire/io/write_field.h>

#include <algorithm>
#include <cmath>

#include "counting_allocator.h"

namespace brushfire {
namespace {

// What `run` takes at most beyond what was in use before.
template <class Run>
std::size_t peak_of(Run&& run) {
  const std::size_t before = test::memory_in_use();
  test::reset_memory_peak();
  run();
  return test::memory_peak() - before;
}

constexpr std::size_t kConstant = std::size_t{1} << 20;  // stream buffers, parser states

struct Sample {
  const char* name;
  const char* format;  // of the writer
  double multiple;     // of the file's size
};

class MemoryOfFormat : public testing::TestWithParam<Sample> {};

TEST_P(MemoryOfFormat, IsASmallMultipleOfTheFile) {
  const test::TemporaryDirectory dir;
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  constexpr Index kSide = 150;
  for (Index y = 0; y < kSide; ++y) {
    for (Index x = 0; x < kSide; ++x) positions.push_back({x / 7.0, y / 7.0, std::sin(x * 0.1)});
  }
  for (Index y = 0; y + 1 < kSide; ++y) {
    for (Index x = 0; x + 1 < kSide; ++x) {
      const Index v = y * kSide + x;
      faces.push_back({v, v + 1, v + kSide});
      faces.push_back({v + 1, v + kSide + 1, v + kSide});
    }
  }
  const Mesh mesh(positions, faces);
  const std::string path = dir / (std::string("a.") + GetParam().format);
  write_field(path, mesh, {}, GetParam().format);
  const double size = static_cast<double>(std::filesystem::file_size(path));
  const std::size_t taken = peak_of([&] { read_mesh(path); });
  EXPECT_LE(static_cast<double>(taken), GetParam().multiple * size + kConstant) << size << " bytes of file";
}

INSTANTIATE_TEST_SUITE_P(Formats, MemoryOfFormat,
                         testing::Values(Sample{"PLY", "ply", 4}, Sample{"OBJ", "obj", 4}, Sample{"VTK", "vtk", 8},
                                         Sample{"VTP", "vtp", 8}),
                         [](const auto& sample) { return std::string(sample.param.name); });

TEST(MemoryOfPromises, NothingIsTakenForCountsThatCannotBeTrue) {
  const std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4294967296\nproperty double x\nproperty double y\n"
      "property double z\nend_header\n";
  const std::string list =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uint int vertex_indices\nend_header\n0 0 0\n4294967295 0 0\n";
  const std::string vtp =
      "<VTKFile type=\"PolyData\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\"><PolyData><Piece "
      "NumberOfPoints=\"9999999\">"
      "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
      "format=\"binary\">AQAAAAAAAAD////////////////AAA==</DataArray></Points></Piece></PolyData></VTKFile>";
  const std::string gii =
      "<GIFTI><DataArray Intent=\"NIFTI_INTENT_POINTSET\" DataType=\"NIFTI_TYPE_FLOAT32\" Dimensionality=\"2\" "
      "Dim0=\"5000000\" Dim1=\"3\" "
      "Encoding=\"GZipBase64Binary\"><Data>eJwDAAAAAAE=</Data></DataArray><DataArray Intent=\"NIFTI_INTENT_TRIANGLE\" "
      "DataType=\"NIFTI_TYPE_INT32\" "
      "Dimensionality=\"2\" Dim0=\"1\" Dim1=\"3\" Encoding=\"ASCII\"><Data>0 0 0</Data></DataArray></GIFTI>";
  const std::pair<const char*, std::string> files[]{
      {"a.ply", ply},
      {"b.ply", list},
      {"a.vtp", vtp},
      {"a.gii", gii},
      {"a.off", "OFF 4294967295 9223372036854775807 0\n"},
      {"a.stl", std::string(80, 'x') + "\xff\xff\xff\xff"},
      {"a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n9223372036854775807\n"},
      {"a.mesh", "MeshVersionFormatted 2\nVertices 2147483647\n"},
      {"lh.white", "\xff\xff\xfe\n\n\x7f\xff\xff\xff\x7f\xff\xff\xff"},
      {"a.vtk", "# vtk DataFile Version 3.0\n\nBINARY\nDATASET POLYDATA\nPOINTS 4611686018427387904 double\n"}};
  for (const auto& [name, content] : files) {
    std::string message;
    const std::size_t taken = peak_of([&, &file = name, &text = content] { message = test::mesh_error(text, file); });
    EXPECT_NE(message, "") << name;
    EXPECT_LE(taken, kConstant) << name << ": " << message;
  }
}

}  // namespace
}  // namespace brushfire
