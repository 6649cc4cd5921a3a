// Lists of exact runs on random windows: crossing a face, choosing sides, trimming, waiting.
#include <brushfire/solvers/windows/algebra/exact_cross.h>
#include <brushfire/solvers/windows/algebra/tie_point.h>
#include <brushfire/solvers/windows/propagation/exact_trim.h>
#include <brushfire/solvers/windows/store/exact_lists.h>

#include <gtest/gtest.h>

#include <algorithm>

#include "solvers/windows/children.h"
#include "solvers/windows/random_lists.h"

namespace brushfire::windows {
namespace {

constexpr double kClose = 1e-11;  // relative; windows of grazing rays lose that much

// The least value at x among the windows that light it.
double least_at(const std::vector<Window>& windows, double x) {
  double least = kInfinity;
  for (const Window& w : windows) {
    if (x >= w.b0 && x <= w.b1) least = std::min(least, value_at(w, x));
  }
  return least;
}

// A list that has crossed a face: light from afar, nearly disjoint, neighbours overlap a little.
std::vector<Window> crossed_envelope(RandomLists& random, double& length) {
  const Frame frame = random.frame();
  Envelope envelope;
  std::vector<Window> far = random.windows(frame.length), result;
  for (Window& w : far) {
    w.source = {random.uniform(-2, 3), random.uniform(-6, -3)};
    w.sigma = 6 - norm(w.source) + random.uniform(0, 0.2);
    w.b0 = 0;
    w.b1 = frame.length;
    w.d0 = value_at(w, w.b0);
    w.d1 = value_at(w, w.b1);
  }
  for (const Window& w : envelope(far)) {
    const Children c = children_of(w, frame);
    if (c.has_left) result.push_back(c.left);
  }
  length = frame.left;
  return result;
}

TEST(ExactLists, CrossingAFaceEqualsPropagatingEachWindow) {
  RandomLists random(1);
  BlockPool pool;
  Sight sight;
  Routes routes;
  for (int run = 0; run < kLists; ++run) {
    const Frame frame = random.frame();
    const std::vector<Window> windows = random.windows(frame.length);
    const WindowList list = list_of(windows, pool);
    const WindowColumns w = list.block.columns();
    look_at_apex(w, list.size, frame, sight);
    find_routes(w, list.size, frame, sight, kNoIndex, routes);  // no best one: each goes where it can
    const WindowBlock block = pool.allocate(list.size);
    for (const bool left : {true, false}) {
      const Index count = left ? cross_to_left(w, routes, sight, frame, block.columns())
                               : cross_to_right(w, list.size, routes, sight, frame, block.columns());
      std::vector<Window> expected;
      for (const Window& parent : windows) {
        const Children c = children_of(parent, frame);
        if (left ? c.has_left : c.has_right) expected.push_back(left ? c.left : c.right);
      }
      const std::vector<Window> got = windows_of(block.columns(), count);
      ASSERT_EQ(got.size(), expected.size()) << "run " << run;
      for (std::size_t i = 0; i < got.size(); ++i) {
        const double scale = kClose * (1 + norm(expected[i].source));
        ASSERT_NEAR(got[i].b0, expected[i].b0, scale) << "run " << run;
        ASSERT_NEAR(got[i].b1, expected[i].b1, scale) << "run " << run;
        ASSERT_NEAR(got[i].d0, expected[i].d0, scale) << "run " << run;
        ASSERT_NEAR(got[i].d1, expected[i].d1, scale) << "run " << run;
        ASSERT_EQ(got[i].pseudo_source, expected[i].pseudo_source) << "run " << run;
      }
    }
    pool.release(block);
    pool.release(list.block);
  }
}

TEST(ExactLists, WhatIsNotSentToOneSideIsReachedAsSoonAlongTheBestWindow) {
  RandomLists random(2);
  BlockPool pool;
  Sight sight;
  Routes routes;
  std::size_t left_out = 0;
  for (int run = 0; run < kLists; ++run) {
    const Frame frame = random.frame();
    const std::vector<Window> windows = random.windows(frame.length);
    const WindowList list = list_of(windows, pool);
    const WindowColumns w = list.block.columns();
    look_at_apex(w, list.size, frame, sight);
    Index best = kNoIndex;
    for (Index i = 0; i < list.size; ++i) {
      const bool sees = sight.left[i] > 0 && sight.right[i] > 0;
      if (sees && (best == kNoIndex || sight.value[i] < sight.value[best])) best = i;
    }
    find_routes(w, list.size, frame, sight, best, routes);
    for (Index i = 0; i < list.size; ++i) {
      const Children c = children_of(windows[i], frame);
      for (const bool left : {true, false}) {
        const bool sent =
            left ? i < routes.left_end && routes.goes_left[i] > 0 : i >= routes.right_begin && routes.goes_right[i] > 0;
        if (!(left ? c.has_left : c.has_right) || sent) continue;
        ++left_out;
        ASSERT_NE(best, kNoIndex) << "run " << run;
        const Window& child = left ? c.left : c.right;
        for (int sample = 0; sample <= 8; ++sample) {
          const double x = child.b0 + sample / 8.0 * (child.b1 - child.b0);
          const Vec2 from = left ? Vec2{0, 0} : frame.apex, to = left ? frame.apex : Vec2{frame.length, 0};
          const double share = x / (left ? frame.left : frame.right);
          const Vec2 y{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
          // Along the best window's rays, with a bend at the end of its interval or at the apex where need be.
          const double along = std::min(arrival(windows[best], y).value,
                                        sight.value[best] + length_of(y.x - frame.apex.x, y.y - frame.apex.y));
          ASSERT_LE(along, value_at(child, x) * (1 + kClose)) << "run " << run << ", window " << i;
        }
      }
    }
    pool.release(list.block);
  }
  EXPECT_GT(left_out, kLists);
}

TEST(ExactLists, TrimmingChangesNoLeastValue) {
  RandomLists random(3);
  BlockPool pool;
  ListTrimmer trim;
  std::size_t before = 0, after = 0;
  for (int run = 0; run < kLists; ++run) {
    double length = random.uniform(0.5, 2);
    const std::vector<Window> windows = run % 2 ? random.windows(length) : crossed_envelope(random, length);
    if (windows.empty()) continue;
    WindowList list = list_of(windows, pool);
    list.ordered = run % 5 != 0;
    trim(list, {length}, kInfinity, pool);
    const std::vector<Window> left = windows_of(list.block.columns(), list.size);
    for (int sample = 0; sample <= 40; ++sample) {
      const double x = sample / 40.0 * length, value = least_at(windows, x);
      if (value == kInfinity) {
        ASSERT_EQ(least_at(left, x), kInfinity) << "run " << run;
      } else {
        ASSERT_NEAR(least_at(left, x), value, kClose) << "run " << run << ", x " << x;
      }
    }
    before += windows.size();
    after += left.size();
    pool.release(list.block);
  }
  EXPECT_LT(after, before);
}

TEST(ExactLists, ListsNearlyInOrderAreLeftNearlyDisjoint) {
  RandomLists random(4);
  BlockPool pool;
  ListTrimmer trim;
  double overlap_before = 0, overlap_after = 0;
  for (int run = 0; run < kLists; ++run) {
    double length = 1;
    const std::vector<Window> windows = crossed_envelope(random, length);
    if (windows.empty()) continue;
    const auto overlap = [](const std::vector<Window>& w) {
      double sum = 0;
      for (std::size_t i = 1; i < w.size(); ++i) sum += std::max(0.0, w[i - 1].b1 - w[i].b0);
      return sum;
    };
    WindowList list = list_of(windows, pool);
    trim(list, {length}, kInfinity, pool);
    overlap_before += overlap(windows);
    overlap_after += overlap(windows_of(list.block.columns(), list.size));
    pool.release(list.block);
  }
  EXPECT_GT(overlap_before, 0);
  EXPECT_LT(overlap_after, 0.1 * overlap_before);
}

TEST(ExactLists, OnlyWindowsThatAnEndOfTheEdgeBeatsEverywhereAreDropped) {
  RandomLists random(5);
  BlockPool pool;
  ListTrimmer trim;
  for (int run = 0; run < kLists; ++run) {
    const double length = random.uniform(0.5, 2);
    const Window w = random.window(length);
    const EdgeBounds edge{length, random.uniform(0, 6), random.uniform(0, 6)};
    WindowList list = list_of({w}, pool);
    trim(list, edge, kInfinity, pool);
    if (list.size == 0) {
      for (int sample = 0; sample <= 8; ++sample) {
        const double x = w.b0 + sample / 8.0 * (w.b1 - w.b0);
        ASSERT_LT(std::min(edge.start + x, edge.end + length - x), value_at(w, x)) << "run " << run;
      }
    }
    pool.release(list.block);
  }
}

TEST(ExactLists, SourcesOnTheEdgeKeepTheirWholeInterval) {
  BlockPool pool;
  ListTrimmer trim;
  for (const bool ordered : {true, false}) {
    Window on;
    on.b1 = 1;
    on.source = {0.5, 0};
    on.d0 = on.d1 = 0.5;
    Window other = on;  // ties with it everywhere on the right
    other.source = {0.5, -1e-3};
    other.b0 = 0.5;
    other.d0 = value_at(other, 0.5);
    other.d1 = value_at(other, 1);
    WindowList list = list_of({on, other}, pool);
    list.ordered = ordered;
    trim(list, {1}, kInfinity, pool);
    const std::vector<Window> left = windows_of(list.block.columns(), list.size);
    ASSERT_TRUE(std::any_of(left.begin(), left.end(),
                            [](const Window& w) { return w.source.y == 0 && w.b0 == 0 && w.b1 == 1; }));
    pool.release(list.block);
  }
}

TEST(ExactLists, WhatWaitsIsTakenByHalfedgeInTheOrderOfItsOrigins) {
  RandomLists random(6);
  ExactLists lists;
  BlockPool blocks;
  Index face = kNoIndex;
  const auto one = [&](Index pseudo_source) {
    Window w = random.window(1);
    w.pseudo_source = pseudo_source;
    return list_of({w}, blocks);
  };
  lists.put(face, 7, Origin::End, one(3));
  lists.put(face, 6, Origin::Start, one(9));
  lists.key(face, 7) = 0.25;
  lists.put(face, 7, Origin::Start, one(1));
  Window apex = random.window(1);
  apex.pseudo_source = 2;
  lists.put(face, 7, Origin::Apex, apex, blocks);
  EXPECT_EQ(lists.key(face, 7), 0.25) << "the key stays with the halfedge";
  EXPECT_TRUE(lists.empty(face, 8));
  const WindowList list = lists.take(face, 7, blocks);
  ASSERT_EQ(list.size, 3u);
  EXPECT_TRUE(list.ordered);
  for (Index i = 0; i < 3; ++i) EXPECT_EQ(list.block.columns().pseudo_source[i], i + 1);
  EXPECT_TRUE(lists.empty(face, 7));
  EXPECT_FALSE(lists.empty(face, 6));
  lists.put(face, 6, Origin::Start, one(10));
  const WindowList twice = lists.take(face, 6, blocks);
  EXPECT_EQ(twice.size, 2u);
  EXPECT_FALSE(twice.ordered) << "two lists of one origin may lie anyhow";
  EXPECT_EQ(face, kNoIndex);
}

// Threads hand lists on to each other: a pool that had room enough in what others gave it has no memory of its own.
// When a run was stopped, its blocks went to two lists at a time in the next one, and windows named sources that nobody
// knew.
TEST(ExactLists, APoolForgetsBlocksOfAnotherPoolsToo) {
  BlockPool one, other;
  const WindowBlock block = one.allocate(3);
  other.release(block);
  one.clear();
  other.clear();
  const WindowBlock first = one.allocate(3), second = other.allocate(3);
  EXPECT_EQ(first.data, block.data) << "its memory stays";
  EXPECT_NE(second.data, first.data);
}

// Of more than 64 windows there are no sets of bits.
TEST(ExactLists, LongListsCrossAFaceAsShortOnesDo) {
  RandomLists random(9);
  BlockPool pool;
  Sight sight;
  Routes routes;
  for (const Index count : {Index{63}, Index{64}, Index{65}, Index{300}}) {
    const Frame frame = random.frame();
    std::vector<Window> windows(count);
    for (Window& w : windows) w = random.window(frame.length);
    const WindowList list = list_of(windows, pool);
    const WindowColumns w = list.columns();
    look_at_apex(w, count, frame, sight);
    EXPECT_EQ(sight.least, least_of(sight.value.data(), count));
    find_routes(w, count, frame, sight, kNoIndex, routes);
    for (Index i = 0; i < count; ++i) {
      EXPECT_EQ(i < routes.left_end && routes.goes_left[i] > 0, sight.left[i] > 0) << count << ", window " << i;
      EXPECT_EQ(i >= routes.right_begin && routes.goes_right[i] > 0, sight.right[i] > 0) << count << ", window " << i;
    }
    pool.release(list.block);
  }
}

}  // namespace
}  // namespace brushfire::windows
