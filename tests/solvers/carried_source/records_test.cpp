// What a march knows of a mesh: measured eight corners at a time, and vertex by vertex where faces are not so plain.
#include <brushfire/core/detail/random.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/carried_source/detail/records.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

namespace brushfire::carried_source {
namespace {

// No direction of it is opposite to another one.
Shape uneven() {
  Shape shape = shapes::folded_sphere(3);
  Random random(7);
  for (Vec3& p : shape.positions) {
    p = p + Vec3{random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03)};
  }
  return shape;
}

// The same surface by its lengths alone: every vertex is laid out by itself.
Mesh by_lengths(const Mesh& mesh) {
  std::vector<std::array<double, 3>> lengths;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    lengths.push_back({mesh.length(3 * f), mesh.length(3 * f + 1), mesh.length(3 * f + 2)});
    for (double& l : lengths.back()) l *= mesh.unit();
  }
  return Mesh::from_lengths(mesh.vertex_count(), mesh.faces(), lengths);
}

// Of all sides, those over unrolled faces too, in one order.
using SideFacts = std::tuple<Index, double, double, double, double, double, std::vector<int>>;
template <class T>
std::vector<SideFacts> sides_of(const Record<T>& record) {
  std::vector<SideFacts> all;
  for (Index k = 0; k < record.head().sides; ++k) {
    const Side<T>& s = record.sides()[k];
    const DarkSets& d = record.dark()[k];
    std::vector<int> facts{s.sector, s.end_bends};
    for (int hand = 0; hand < 2; ++hand) {
      for (const SectorSet set : {s.turned[hand], s.end_turned[hand], d.here[hand], d.end[hand]}) facts.push_back(set);
    }
    all.emplace_back(record.ends()[k].end, s.length, s.c, s.s, s.end_c, s.end_s, facts);
  }
  std::sort(all.begin(), all.end());
  return all;
}

// By the ends of support and target, with everything else that an update says.
using UpdateFacts = std::tuple<Index, Index, std::uint32_t>;
template <class T>
std::vector<UpdateFacts> updates_of(const Record<T>& record) {
  constexpr std::uint32_t kOthers = (1u << Update::kSupportShift) - 1;
  std::vector<UpdateFacts> all;
  for (Index k = 0; k < record.head().sides; ++k) {
    for (Index u = record.ends()[k].first_update; u < record.ends()[k + 1].first_update; ++u) {
      const Update update = record.updates()[u];
      all.emplace_back(record.ends()[update.support()].end, record.ends()[k].end, update.bits & kOthers);
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

template <class T>
void expect_the_same(const Mesh& mesh, double tolerance) {
  const Records<T> rings = build_records<T>(mesh), alone = build_records<T>(by_lengths(mesh));
  ASSERT_EQ(rings.vertex_count, alone.vertex_count);
  EXPECT_EQ(rings.most_unrolled, alone.most_unrolled);
  EXPECT_GT(rings.most_unrolled, 0);
  EXPECT_NEAR(rings.mean_edge, alone.mean_edge, 1e-9);
  for (Index v = 0; v < rings.vertex_count; ++v) {
    EXPECT_NEAR(rings.around[v].c, alone.around[v].c, tolerance);
    EXPECT_NEAR(rings.around[v].s, alone.around[v].s, tolerance);
    EXPECT_EQ(rings[v].head().bends, alone[v].head().bends);
    EXPECT_EQ(updates_of(rings[v]), updates_of(alone[v])) << v;
    const auto a = sides_of(rings[v]), b = sides_of(alone[v]);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(std::get<0>(a[k]), std::get<0>(b[k])) << v;
      EXPECT_NEAR(std::get<1>(a[k]), std::get<1>(b[k]), tolerance);
      EXPECT_NEAR(std::get<2>(a[k]), std::get<2>(b[k]), tolerance);
      EXPECT_NEAR(std::get<3>(a[k]), std::get<3>(b[k]), tolerance);
      EXPECT_NEAR(std::get<4>(a[k]), std::get<4>(b[k]), tolerance);
      EXPECT_NEAR(std::get<5>(a[k]), std::get<5>(b[k]), tolerance);
      EXPECT_EQ(std::get<6>(a[k]), std::get<6>(b[k])) << "the side from " << v << " to " << std::get<0>(a[k]);
    }
  }
}

TEST(Records, OfRingsAreThoseOfVerticesLaidOutOneByOne) {
  const Mesh mesh = uneven().mesh();
  expect_the_same<double>(mesh, 1e-10);
  expect_the_same<float>(mesh, 2e-6);
}

// Flaps turned over, whose edges neighbours see from the other side; and holes.
TEST(Records, AreTheSameBesideMirroredFacesAndBoundaries) {
  Shape shape = uneven();
  for (std::size_t f = 0; f < shape.faces.size(); f += 9) std::swap(shape.faces[f][1], shape.faces[f][2]);
  for (std::size_t f = 4; f < shape.faces.size(); f += 50) shape.faces[f] = shape.faces.back(), shape.faces.pop_back();
  const Mesh mesh = shape.mesh();
  expect_the_same<double>(mesh, 1e-10);
}

}  // namespace
}  // namespace brushfire::carried_source
