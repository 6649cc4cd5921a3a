// Several numbers per vertex and per face in files.
#include <brushfire/core/error.h>
#include <brushfire/io/npy.h>
#include <brushfire/io/read_field.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/io/write_columns.h>

#include "io_support.h"

#include <gtest/gtest.h>

#include <cmath>

namespace brushfire {
namespace {

Mesh square() {
  return Mesh(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, std::vector<Face>{{0, 1, 2}, {0, 2, 3}});
}

class WriteColumns : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_ / name; }
  test::TemporaryDirectory folder_;
};

TEST_F(WriteColumns, VectorsOnFacesAreInEveryFormatThatHasThem) {
  const std::vector<double> values{1, 2, 3, -0.1, 1e-300, kInfinity};
  const Columns columns{.names = {"x", "y", "z"},
                        .values = values,
                        .on = Columns::On::Faces,
                        .kind = Columns::Kind::Vectors,
                        .name = "gradient"};
  for (const FileFormat& format : columns_written(Columns::Kind::Vectors)) {
    write_columns(path("v." + format.extensions.front()), square(), columns);
  }
  EXPECT_EQ(test::read_file(path("v.csv")), "face,x,y,z\n0,1,2,3\n1,-0.1,1e-300,inf\n");
  EXPECT_EQ(test::read_file(path("v.json")),
            "{\"schema\": 1, \"faces\": 2,\n \"face\": [0, 1],\n \"x\": [1, -0.1],\n \"y\": [2, 1e-300],\n \"z\": [3, "
            "null]}\n");
  const NpyArray npy = read_npy(path("v.npy"));
  EXPECT_EQ(npy.shape, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(npy.values, values);
  EXPECT_EQ(read_mesh(path("v.ply")).mesh.face_count(), 2u);
  EXPECT_NE(test::read_file(path("v.vtk")).find("CELL_DATA 2\nVECTORS gradient double\n"), std::string::npos);
  EXPECT_THROW(write_columns(path("v.obj"), square(), columns), Error);
}

TEST_F(WriteColumns, SomeVerticesAreWrittenWithThePartOfTheMeshBetweenThem) {
  const std::vector<double> values{0, 0, 5, 1, 0, 6, 0, 1, 7};
  const std::vector<Index> rows{0, 2, 3};
  const Columns columns{.names = {"u", "v", "radius"}, .values = values, .rows = rows, .kind = Columns::Kind::Texture};
  for (const char* extension : {"ply", "vtk", "obj"}) {
    const std::string file = path(std::string("part.") + extension);
    write_columns(file, square(), columns);
    const Mesh part = read_mesh(file).mesh;
    EXPECT_EQ(part.vertex_count(), 3u) << extension;
    ASSERT_EQ(part.face_count(), 1u) << extension;
    EXPECT_EQ(part.faces()[0], (Face{0, 1, 2})) << extension;
    EXPECT_EQ(part.positions()[1], (Vec3{1, 1, 0})) << extension;
  }
  EXPECT_EQ(read_field(path("part.ply"), "radius").values, (std::vector<double>{5, 6, 7}));
  EXPECT_EQ(read_field(path("part.ply"), "vertex").values, (std::vector<double>{0, 2, 3}));
  EXPECT_EQ(read_field(path("part.ply"), "texture_v").values, (std::vector<double>{0, 0, 1}));
  EXPECT_EQ(read_field(path("part.vtk"), "radius").values, (std::vector<double>{5, 6, 7}));
  EXPECT_NE(test::read_file(path("part.obj")).find("v 1 1 0\nvt 1 0\n"), std::string::npos);
  write_columns(path("all.npy"), square(), columns);
  EXPECT_TRUE(std::isnan(read_npy(path("all.npy")).values[3]));
  EXPECT_EQ(read_npy(path("all.npy")).values[6], 1);
}

TEST_F(WriteColumns, WhatDoesNotFitIsRefused) {
  const std::vector<double> values{1, 2, 3};
  const std::vector<Index> falling{2, 1, 0}, beyond{0, 1, 4};
  Columns columns{.names = {"a"}, .values = values};
  EXPECT_THROW(write_columns(path("a.csv"), square(), columns), Error);  // four vertices
  columns.rows = falling;
  EXPECT_THROW(write_columns(path("a.csv"), square(), columns), Error);
  columns.rows = beyond;
  EXPECT_THROW(write_columns(path("a.csv"), square(), columns), Error);
  EXPECT_THROW(check_columns_format("a.stl", Columns::Kind::Texture), Error);
  EXPECT_THROW(check_columns_format("a.obj", Columns::Kind::Vectors), Error);
  EXPECT_NO_THROW(check_columns_format("a.obj", Columns::Kind::Texture));
}

}  // namespace
}  // namespace brushfire
