// The march itself: the variants for different processors.
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/fast_marching/march.h>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "support/shared_meshes.h"

namespace brushfire::detail {
namespace {

// Values from two places, the second one later than the first, under labels of their own or mixed.
template <class T>
MarchState<T> marched(const Rings<T>& rings, Index vertices, FrontModel model, bool labelled, Variant variant) {
  MarchState<T> state;
  state.resize(vertices);
  state.buckets_per_unit = static_cast<T>(2 / rings.layout.mean_edge);
  state.labelled = labelled;
  if (labelled) {
    state.label.assign(state.front_at.size(), kNoIndex);
    state.start = {0, 1};
  }
  state.offer(0, 0, 0);
  state.offer(vertices / 2, 1, 1);
  const MarchSlice<T> slice = march_slice<T>(model, labelled, variant);
  for (; state.queue.advance(); state.queue.clear_current()) {
    for (std::size_t i = 0; i < state.queue.current().size();) i = slice(rings, state, i);
  }
  return state;
}

template <class T>
void expect_same_bits(const Mesh& mesh, FrontModel model) {
  const Rings<T> rings = build_rings<T>(mesh);
  for (const bool labelled : {false, true}) {
    const auto best = marched<T>(rings, mesh.vertex_count(), model, labelled, Variant::Best);
    const auto portable = marched<T>(rings, mesh.vertex_count(), model, labelled, Variant::Portable);
    ASSERT_EQ(best.pops, portable.pops);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      ASSERT_EQ(best.front_at[v].value, portable.front_at[v].value) << "vertex " << v << ", labelled " << labelled;
      ASSERT_EQ(best.front_at[v].root, portable.front_at[v].root) << "vertex " << v << ", labelled " << labelled;
    }
    EXPECT_EQ(best.label, portable.label);
  }
}

TEST(March, EveryProcessorGivesTheSameBits) {
  std::vector<Mesh> meshes{shapes::torus(37, 23).mesh(), shapes::book(5, 3, 6).mesh()};
  if (test::has_shared_data()) meshes.push_back(test::shared_mesh("camelhead"));
  for (const Mesh& mesh : meshes) {
    for (const FrontModel model : {FrontModel::Circular, FrontModel::Planar}) {
      expect_same_bits<float>(mesh, model);
      expect_same_bits<double>(mesh, model);
    }
  }
}

}  // namespace
}  // namespace brushfire::detail
