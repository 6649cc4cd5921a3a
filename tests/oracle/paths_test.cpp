// Shortest paths on awkward meshes: as long as the field says, and judged good by coordinates where there are any.
#include "oracle/zoo.h"
#include "support/good_paths.h"

#include <brushfire/queries/path.h>

#include <gtest/gtest.h>

#include <random>

namespace brushfire::oracle {
namespace {

bool has_usable_face(const Mesh& mesh) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (mesh.is_face_usable(f)) return true;
  }
  return false;
}

TEST(AwkwardPaths, InTheZooAreGoodAndAsLongAsTheFieldSays) {
  for (const Specimen& s : awkward_meshes()) {
    if (has_usable_face(s.mesh)) test::expect_good_paths(s.mesh, 60, 1, s.name);
  }
}

// Faces without area, edges without length and over many faces, vertices in several fans, all in one small space.
TEST(AwkwardPaths, InSoupsAreGoodAndAsLongAsTheFieldSays) {
  for (std::uint32_t seed = 1; seed <= 240; ++seed) {
    test::expect_good_paths(random_soup(seed, 12 + seed % 20, 30 + seed % 40), 8, seed, "soup");
  }
}

// Light came round to two vertices at one place, to each by way of the other, while the source lay in a face of theirs
// (seeds of 48,000 paths of which four were lost).
TEST(AwkwardPaths, FromVerticesAtOnePlaceGoStraightToASourceInAFaceOfTheirs) {
  for (const std::uint32_t seed : {124u, 281u, 346u, 381u}) {
    test::expect_good_paths(random_soup(seed, 12 + seed % 20, 30 + seed % 40), 33, seed, "soup");
  }
}

// One pair needed 256 steps in 57 faces.
TEST(AwkwardPaths, OverEdgesOfManyFacesManySheetsAreTried) {
  test::expect_good_paths(random_soup(1062, 12 + 1062 % 20, 30 + 1062 % 40), 37, 1062, "soup");
}

TEST(AwkwardPaths, ThroughRowsWithoutAltitudeAreGoodAndAsLongAsTheFieldSays) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed)
    test::expect_good_paths(needle_grid(seed, 8, 0), 40, seed, "flat rows");
}

}  // namespace
}  // namespace brushfire::oracle
