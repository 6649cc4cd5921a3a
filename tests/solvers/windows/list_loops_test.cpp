// The loops over lists of exact runs: the variants for different processors.
#include <brushfire/solvers/windows/algebra/crossing.h>
#include <brushfire/solvers/windows/propagation/trimming.h>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "solvers/windows/random_lists.h"

namespace brushfire::windows {
namespace {

// What the loops make of a list on one target, as far as it means anything.
struct LoopResults {
  Sight sight;
  std::vector<Window> left, right;
  std::vector<double> d0, d1, place, value_i, value_j, plain;
  bool dim_left = false, dim_right = false, doubtful = false, on_edge = false, useless = false;

  void cut_to(Index count) {
    for (std::vector<double>* numbers : {&sight.left, &sight.right, &sight.value, &d0, &d1}) numbers->resize(count);
    for (std::vector<double>* numbers : {&place, &value_i, &value_j, &plain}) numbers->resize(count - 1);
  }
};

LoopResults results_on(Variant variant, const WindowList& list, const Frame& frame, BlockPool& pool) {
  const Index count = list.size, room = count + kRoomBehind;
  const WindowColumns w = list.columns();
  LoopResults r;
  for (std::vector<double>* numbers :
       {&r.sight.left, &r.sight.right, &r.sight.value, &r.d0, &r.d1, &r.place, &r.value_i, &r.value_j, &r.plain}) {
    numbers->resize(room);
  }
  if (list.mixed) {
    BRUSHFIRE_ON_TARGET(variant, look<true>(w, count, frame.apex, 1e-6, r.sight));
  } else {
    BRUSHFIRE_ON_TARGET(variant, look<false>(w, count, frame.apex, 1e-6, r.sight));
  }
  BRUSHFIRE_ON_TARGET(variant, ends(w, count, r.d0.data(), r.d1.data()));
  BRUSHFIRE_ON_TARGET(variant, tie_points(w, r.d0.data(), r.d1.data(), count - 1,
                                          {r.place.data(), r.value_i.data(), r.value_j.data(), r.plain.data()}));
  const Index middle = count / 2;
  r.doubtful = BRUSHFIRE_ON_TARGET(variant, is_doubtful(w, count, r.sight, middle, middle, frame.apex.x, frame.apex.x));
  r.on_edge = BRUSHFIRE_ON_TARGET(variant, any_nearly_on_edge(w, count));
  r.useless = BRUSHFIRE_ON_TARGET(
      variant, any_useless(w, r.d0.data(), r.d1.data(), count, {frame.length, 4 * frame.left, 4 * frame.right}, 5));
  const WindowBlock block = pool.allocate(count);
  const WindowColumns out = block.columns();
  const double *left = r.sight.left.data(), *right = r.sight.right.data();
  r.dim_left = BRUSHFIRE_ON_TARGET(variant, to_left(w, count, left, right, frame, out));
  r.left = windows_of(out, count);
  r.dim_right = BRUSHFIRE_ON_TARGET(variant, to_right(w, count, right, left, frame, out));
  r.right = windows_of(out, count);
  pool.release(block);
  r.cut_to(count);
  return r;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y) || (std::isnan(x) && std::isnan(y));
  });
}
std::vector<double> numbers_of(const std::vector<Window>& windows) {
  std::vector<double> numbers;
  for (const Window& w : windows) {
    numbers.insert(numbers.end(), {w.b0, w.b1, w.source.x, w.source.y, w.sigma, 1.0 * w.pseudo_source});
  }
  return numbers;
}

TEST(ListLoops, EveryProcessorGivesTheSameBits) {
  RandomLists random(8);
  BlockPool pool;
  for (int run = 0; run < kLists; ++run) {
    const Frame frame = random.frame();
    WindowList list = list_of(random.windows(frame.length), pool);
    list.mixed = run % 4 == 0;
    if (list.mixed) list.columns().y[0] *= -1;  // a linear one
    const LoopResults a = results_on(Variant::Portable, list, frame, pool);
    const LoopResults b = results_on(Variant::Best, list, frame, pool);
    EXPECT_TRUE(same_bits(a.sight.left, b.sight.left) && same_bits(a.sight.right, b.sight.right));
    EXPECT_TRUE(same_bits(a.sight.value, b.sight.value));
    EXPECT_EQ(a.sight.least, b.sight.least);
    EXPECT_EQ(a.sight.passes_left, b.sight.passes_left);
    EXPECT_EQ(a.sight.passes_right, b.sight.passes_right);
    EXPECT_TRUE(same_bits(a.d0, b.d0) && same_bits(a.d1, b.d1));
    EXPECT_TRUE(same_bits(a.place, b.place) && same_bits(a.plain, b.plain));
    EXPECT_TRUE(same_bits(a.value_i, b.value_i) && same_bits(a.value_j, b.value_j));
    EXPECT_TRUE(same_bits(numbers_of(a.left), numbers_of(b.left)));
    EXPECT_TRUE(same_bits(numbers_of(a.right), numbers_of(b.right)));
    EXPECT_EQ(a.dim_left, b.dim_left);
    EXPECT_EQ(a.dim_right, b.dim_right);
    EXPECT_EQ(a.doubtful, b.doubtful);
    EXPECT_EQ(a.on_edge, b.on_edge);
    EXPECT_EQ(a.useless, b.useless);
    pool.release(list.block);
  }
}

}  // namespace
}  // namespace brushfire::windows
