// brushfire flatten: what it writes and says.
#include "in_folder.h"
#include "program.h"

#include <brushfire/io/npy.h>
#include <brushfire/io/read_mesh.h>

#include <gtest/gtest.h>

#include <cmath>

namespace brushfire::test {
namespace {

class FlattenVerb : public InFolder {};

TEST_F(FlattenVerb, WritesACylinderCutOpenWithItsTexture) {
  run_program({"shape", "cylinder", "--vertices", "300", "-o", path("c.ply"), "-q"});
  const Ended ended = run_program({"flatten", path("c.ply"), "--method", "exact", "-o", path("uv.obj")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.err.find("0 faces turned over"), std::string::npos) << ended.err;
  EXPECT_GT(read_mesh(path("uv.obj")).mesh.vertex_count(), read_mesh(path("c.ply")).mesh.vertex_count());

  EXPECT_EQ(run_program({"flatten", path("c.ply"), "--method", "exact", "-o", path("uv.npy"), "-q"}).code, 0);
  const NpyArray uv = read_npy(path("uv.npy"));
  ASSERT_EQ(uv.shape[1], 3u);  // u, v and the vertex in the file
  const Mesh cylinder = read_mesh(path("c.ply")).mesh, cut = read_mesh(path("uv.obj")).mesh;
  ASSERT_EQ(uv.shape[0], cut.vertex_count());
  for (const Face& f : cut.faces()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double *a = &uv.values[3 * f[k]], *b = &uv.values[3 * f[(k + 1) % 3]];
      const Vec3 p = cylinder.positions()[static_cast<Index>(a[2])], q = cylinder.positions()[static_cast<Index>(b[2])];
      EXPECT_NEAR(std::hypot(a[0] - b[0], a[1] - b[1]), norm(p - q), 1e-6);
    }
  }
}

TEST_F(FlattenVerb, RefusesPiecesAndTooFewLandmarks) {
  write("two.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n3 0 1 2\n3 3 4 5\n");
  const Ended pieces = run_program({"flatten", path("two.off")});
  EXPECT_NE(pieces.code, 0);
  EXPECT_NE(pieces.err.find("several pieces"), std::string::npos) << pieces.err;
  EXPECT_EQ(run_program({"flatten", path("two.off"), "--landmarks", "2"}).code, 2);
}

}  // namespace
}  // namespace brushfire::test
