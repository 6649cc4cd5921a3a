// Files in memory: the bytes that would have gone to disk.
#include <brushfire/core/error.h>
#include <brushfire/io/formats.h>
#include <brushfire/io/write_field.h>
#include <brushfire/io/write_lines.h>
#include <brushfire/io/write_mesh.h>
#include <brushfire/mesh/shapes.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace brushfire {
namespace {

std::vector<std::uint8_t> content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class Encode : public testing::Test {
 protected:
  // More than what an output collects before it writes.
  const Mesh mesh_ = shapes::torus(120, 60).mesh();
  const std::vector<double> values_ = std::vector<double>(mesh_.vertex_count(), 0.1);
  const std::string folder_ = testing::TempDir() + "brushfire_encode";
};

TEST_F(Encode, MeshesHaveTheBytesOfTheirFiles) {
  for (const FileFormat& format : meshes_written()) {
    const std::string path = folder_ + "." + format.extensions.front();
    write_mesh(path, mesh_);
    EXPECT_EQ(encode_mesh(mesh_, format.extensions.front()), content_of(path)) << format.name;
    std::remove(path.c_str());
  }
}

TEST_F(Encode, FieldsHaveTheBytesOfTheirFiles) {
  for (const FileFormat& format : fields_written()) {
    const std::string path = folder_ + "." + format.extensions.front();
    write_field(path, mesh_, {.values = values_});
    EXPECT_EQ(encode_field(mesh_, {.values = values_}, format.extensions.front()), content_of(path)) << format.name;
    std::remove(path.c_str());
  }
}

TEST_F(Encode, CurvesHaveTheBytesOfTheirFiles) {
  const std::vector<SurfacePath> lines{{{vertex_point(mesh_, 0), vertex_point(mesh_, 1)}, 2, false}};
  for (const FileFormat& format : lines_written()) {
    const std::string path = folder_ + "." + format.extensions.front();
    write_lines(path, mesh_, lines, "length");
    EXPECT_EQ(encode_lines(mesh_, lines, "length", format.extensions.front()), content_of(path)) << format.name;
    std::remove(path.c_str());
  }
}

TEST_F(Encode, UnknownFormatsAreRefused) {
  EXPECT_THROW(encode_mesh(mesh_, "doc"), Error);
  EXPECT_THROW(encode_field(mesh_, {.values = values_}, ""), Error);
  EXPECT_THROW(encode_lines(mesh_, {}, "length", "png"), Error);
}

}  // namespace
}  // namespace brushfire
