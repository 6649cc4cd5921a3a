// Small files that other programs wrote and that were once refused, lost or misread: ../shared/cases.
#include "io_support.h"

#include <brushfire/mesh/nearest_point.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/weld.h>
#include <brushfire/solvers/distance.h>

#include "support/shared_meshes.h"

#include <cmath>

namespace brushfire {
namespace {

std::string case_path(const std::string& name) { return (test::shared_directory() / "cases" / name).string(); }

#define BRUSHFIRE_NEEDS_SHARED_CASES()                                    \
  if (!std::filesystem::is_directory(test::shared_directory() / "cases")) \
  GTEST_SKIP() << "no shared cases at " << BRUSHFIRE_SHARED_DIR

DistanceField exact_from(const Mesh& mesh, const SurfacePoint& from, std::vector<SurfacePoint> targets = {}) {
  DistanceOptions options;
  options.method = Method::Exact;
  options.targets = std::move(targets);
  const Source source{from};
  return distance(mesh, std::span(&source, 1), options);
}

TEST(SharedCases, FilesOfTheGridHaveNineVerticesAndEightFaces) {
  BRUSHFIRE_NEEDS_SHARED_CASES();
  for (const char* name : {"06-off-glued-modelnet.off", "07-stl-leading-space.stl", "08-stl-ind-normal.stl",
                           "10-ply-int64-list.ply", "11-gii-3byN-columnmajor.surf.gii", "12-vtu.vtu"}) {
    const Mesh mesh = read_mesh(case_path(name)).mesh;
    EXPECT_EQ(mesh.vertex_count(), 9u) << name;
    EXPECT_EQ(mesh.face_count(), 8u) << name;
    EXPECT_EQ(mesh.report().area, 4) << name;
  }
}

TEST(SharedCases, WhatVtkWritesIsReadInEveryMode) {
  BRUSHFIRE_NEEDS_SHARED_CASES();
  for (const char* name : {"02-vtp-ascii-informationkey.vtp", "03-vtp-appended-base64-last-array.vtp",
                           "04-vtp-inline-zlib-no-padding.vtp"}) {
    const Mesh mesh = read_mesh(case_path(name)).mesh;
    EXPECT_EQ(test::positions_of(mesh), (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << name;
    EXPECT_EQ(test::faces_of(mesh), (std::vector<Face>{{0, 1, 2}})) << name;
  }
}

TEST(SharedCases, FilesOfTheTriangleOf345GiveItsSides) {
  BRUSHFIRE_NEEDS_SHARED_CASES();
  for (const char* name :
       {"05-obj-bom-silent.obj", "17-ply-cr-header.ply", "18-msh-binary-elementdata.msh", "20-ply-XYZ.ply"}) {
    const Mesh mesh = read_mesh(case_path(name)).mesh;
    const DistanceField field = exact_from(mesh, vertex_point(mesh, 0));
    EXPECT_EQ(field.distance[1], 3) << name;
    EXPECT_EQ(field.distance[2], 5) << name;
  }
}

TEST(SharedCases, RowsOfMoreValuesThanTheHeaderNamesAreReadWithARemark) {
  BRUSHFIRE_NEEDS_SHARED_CASES();
  const LoadedMesh loaded = read_mesh(case_path("24b-ply-ascii-vertex-extra-column.ply"));
  EXPECT_EQ(loaded.mesh.vertex_count(), 4u);
  EXPECT_EQ(loaded.mesh.face_count(), 2u);
  EXPECT_EQ(loaded.mesh.report().area, 12);
  EXPECT_EQ(loaded.remarks, (std::vector<std::string>{"4 rows have more values than the header names: left out"}));
}

TEST(SharedCases, WhatIsNotReadIsNamed) {
  BRUSHFIRE_NEEDS_SHARED_CASES();
  const auto message = [](const char* name) { return test::error_of([&] { read_mesh(case_path(name)); }); };
  EXPECT_NE(message("15-gltf-required-extension-ignored.glb").find("'EXT_mesh_gpu_instancing'"), std::string::npos);
  EXPECT_NE(message("21-gltf1.gltf").find("glTF 1.0 is not read"), std::string::npos);
  EXPECT_NE(
      message("23-obj-index-message.obj").find(":4: face 1 names vertex 4, but there are 3 vertices, counted from 1"),
      std::string::npos);
}

TEST(SharedCases, ASeamOfACadModelIsReportedAndClosesWhenWelded) {
  BRUSHFIRE_NEEDS_SHARED_CASES();
  const Mesh mesh = read_mesh(case_path("14-stl-seam.stl")).mesh;
  const MeshReport& report = mesh.report();
  EXPECT_EQ(report.components, 2u);
  EXPECT_EQ(report.near_positions, 8u);
  EXPECT_LT(report.near_tolerance, 1e-15);
  const Welded welded = weld(mesh, report.near_tolerance);
  EXPECT_EQ(welded.joined, 4u);
  EXPECT_EQ(welded.mesh.report().components, 1u);
  // From one sheet to the other over the seam that was closed.
  const NearestPointFinder nearest(welded.mesh);
  const DistanceField field = exact_from(welded.mesh, nearest({0.01, 0, 2}).point, {nearest({0, 0.01, 2}).point});
  EXPECT_NEAR(field.target_distance[0], 0.02, 1e-15);
}

}  // namespace
}  // namespace brushfire
