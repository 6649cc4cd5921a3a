// The march itself: the variants for different processors.
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/fast_marching/detail/march.h>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "support/shared_meshes.h"

namespace brushfire::fast_marching {
namespace {

// Values from two places, the second one later than the first, under labels of their own or mixed.
template <class T>
MarchState<T> marched(const Rings<T>& rings, Index vertices, FrontModel model, bool labelled, Variant variant) {
  MarchState<T> state(rings.layout.parts);
  state.buckets_per_unit = static_cast<T>(2 / rings.layout.mean_edge);
  state.labelled = labelled;
  if (labelled) {
    state.label.assign(state.front_at.size(), kNoIndex);
    state.start = {0, 1};
  }
  state.seed(0, 0, 0);
  state.seed(vertices / 2, 1, 1);
  const MarchPart<T> march = march_part<T>(model, labelled, variant);
  state.begin_run();
  while (state.next_round()) {
    for (const partition::Due& d : state.due) march(rings, state, d.part);
  }
  return state;
}

template <class T>
void expect_same_bits(const Mesh& mesh, FrontModel model, Index part_size) {
  const Rings<T> rings = build_rings<T>(mesh, part_size);
  for (const bool labelled : {false, true}) {
    const auto best = marched<T>(rings, mesh.vertex_count(), model, labelled, Variant::Best);
    const auto portable = marched<T>(rings, mesh.vertex_count(), model, labelled, Variant::Portable);
    ASSERT_EQ(best.pops(), portable.pops());
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      ASSERT_EQ(best.front_at[v].value, portable.front_at[v].value) << "vertex " << v << ", labelled " << labelled;
      ASSERT_EQ(best.front_at[v].sigma, portable.front_at[v].sigma) << "vertex " << v << ", labelled " << labelled;
    }
    EXPECT_EQ(best.label, portable.label);
  }
}

// Closed, with edges of many faces, with boundaries and valences beyond a block, scanned, stretched.
std::vector<Mesh> samples() {
  std::vector<Mesh> meshes{shapes::torus(37, 23).mesh(), shapes::book(5, 3, 6).mesh(), shapes::folded_sphere(3).mesh()};
  if (test::has_shared_data()) {
    for (const char* const name : {"camelhead", "fertility-x10", "degen-sliver"}) {
      meshes.push_back(test::shared_mesh(name));
    }
  }
  return meshes;
}

TEST(March, EveryProcessorGivesTheSameBits) {
  for (const Mesh& mesh : samples()) {
    for (const FrontModel model : {FrontModel::Circular, FrontModel::Planar}) {
      for (const Index part_size : {kNoIndex, Index{64}}) {
        expect_same_bits<float>(mesh, model, part_size);
        expect_same_bits<double>(mesh, model, part_size);
      }
    }
  }
}

// Not by value: NaN is a value here.
template <class T>
bool same_bits(const T (&a)[kLanes], const T (&b)[kLanes]) {
  return std::memcmp(a, b, sizeof a) == 0;
}

template <class T>
void expect_same_rings(const Mesh& mesh) {
  const auto best = build_rings<T>(mesh, 64), portable = build_rings<T>(mesh, 64, Variant::Portable);
  ASSERT_EQ(best.blocks.size(), portable.blocks.size());
  for (std::size_t i = 0; i < best.blocks.size(); ++i) {
    const RingBlock<T>&a = best.blocks[i], &b = portable.blocks[i];
    ASSERT_TRUE(same_bits(a.end, b.end) && same_bits(a.length, b.length)) << "block " << i;
    ASSERT_TRUE(same_bits(a.dot, b.dot) && same_bits(a.cross, b.cross)) << "block " << i;
    ASSERT_TRUE(same_bits(best.layout.links[i].links, portable.layout.links[i].links)) << "block " << i;
  }
  EXPECT_EQ(best.layout.next, portable.layout.next);
  ASSERT_EQ(best.heads.size(), portable.heads.size());
  for (std::size_t v = 0; v < best.heads.size(); ++v) {
    ASSERT_EQ(best.heads[v].correction, portable.heads[v].correction) << "vertex " << v;
    ASSERT_EQ(best.heads[v].more, portable.heads[v].more) << "vertex " << v;
  }
  EXPECT_EQ(best.layout.mean_edge, portable.layout.mean_edge);
  EXPECT_EQ(best.layout.longest_unfolding, portable.layout.longest_unfolding);
}

TEST(March, EveryProcessorBuildsTheSameRings) {
  for (const Mesh& mesh : samples()) {
    expect_same_rings<float>(mesh);
    expect_same_rings<double>(mesh);
  }
}

}  // namespace
}  // namespace brushfire::fast_marching
