// Properties of the window algebra on random windows: 10^5 of them, or as many as the
// environment variable BRUSHFIRE_RANDOM_WINDOWS says.
#include <brushfire/solvers/windows/algebra/envelope.h>
#include <brushfire/solvers/windows/algebra/merge.h>
#include <brushfire/solvers/windows/algebra/sweep.h>
#include <brushfire/solvers/windows/algebra/tie_point.h>
#include <brushfire/solvers/windows/propagation/fan.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "solvers/windows/children.h"
#include "solvers/windows/random_windows.h"

namespace brushfire::windows {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

int count() {
  const char* asked = std::getenv("BRUSHFIRE_RANDOM_WINDOWS");
  return asked ? std::atoi(asked) : 100000;
}

// Where the ray through x of the child's edge crosses the parent's edge.
double preimage(const Window& parent, const Frame& frame, bool left, double x) {
  const Vec2 from = left ? Vec2{0, 0} : frame.apex, to = left ? frame.apex : Vec2{frame.length, 0};
  const double share = x / (left ? frame.left : frame.right);
  const Crossing c = crossing(parent, {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)});
  return c.across / c.along;
}

TEST(Algebra, ChildrenTileTheParentsIntervalAndKeepItsValues) {
  Random random(1);
  for (int i = 0; i < count(); ++i) {
    const Frame frame = random.frame();
    const Window w = random.window(frame.length);
    const Children c = children_of(w, frame);
    if (!c.has_left && !c.has_right) continue;
    const Crossing at = crossing(w, frame.apex);
    const double x = at.across / at.along;
    const double lo = c.has_left ? preimage(w, frame, true, c.left.b0) : preimage(w, frame, false, c.right.b0);
    const double hi = c.has_right ? preimage(w, frame, false, c.right.b1) : preimage(w, frame, true, c.left.b1);
    // Measured across the ray, which is what displaces light; one ulp is one of the longest number that went in.
    const double scale = std::max({frame.length, frame.left, frame.right, norm(w.source)});
    const double close = 4 * kEpsilon * scale;
    const auto across = [&](double y) {
      return w.kind == WindowKind::Linear ? -w.source.y : -w.source.y / length_of(y - w.source.x, w.source.y);
    };
    ASSERT_NEAR(lo * across(w.b0), w.b0 * across(w.b0), close) << "seed 1, window " << i;
    ASSERT_NEAR(hi * across(w.b1), w.b1 * across(w.b1), close) << "seed 1, window " << i;
    if (c.has_left && c.has_right) {
      ASSERT_EQ(c.left.b1, frame.left);
      ASSERT_EQ(c.right.b0, 0);
      ASSERT_NEAR(preimage(w, frame, true, c.left.b1) * across(x), x * across(x), close);
    }
    for (const Window* child : {c.has_left ? &c.left : nullptr, c.has_right ? &c.right : nullptr}) {
      if (!child) continue;
      const bool left = child == &c.left;
      for (const double s : {0.0, 0.3, 1.0}) {
        const double y = child->b0 + s * (child->b1 - child->b0);
        const Vec2 from = left ? Vec2{0, 0} : frame.apex, to = left ? frame.apex : Vec2{frame.length, 0};
        const double share = y / (left ? frame.left : frame.right);
        const Vec2 p{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
        ASSERT_NEAR(value_at(*child, y), straight_value(w, p), 16 * kEpsilon * (scale + w.sigma)) << i;
      }
      ASSERT_NEAR(child->d0, value_at(*child, child->b0), 16 * kEpsilon * (scale + w.sigma)) << i;
      ASSERT_NEAR(child->d1, value_at(*child, child->b1), 16 * kEpsilon * (scale + w.sigma)) << i;
      ASSERT_EQ(child->pseudo_source, w.pseudo_source);
    }
  }
}

TEST(Algebra, AMirroredWindowHasTheSameValues) {
  Random random(2);
  for (int i = 0; i < count(); ++i) {
    const double length = random.log_uniform(0.1, 10);
    const Window w = random.window(length), m = mirrored(w, length);
    const double close = 16 * kEpsilon * (length + norm(w.source) + w.sigma);
    ASSERT_NEAR(value_at(m, length - w.b0), w.d0, close);
    ASSERT_NEAR(value_at(m, length - w.b1), w.d1, close);
    ASSERT_EQ(m.d0, w.d1);
    ASSERT_EQ(m.d1, w.d0);
    ASSERT_NEAR(m.b0, length - w.b1, close);
    ASSERT_NEAR(m.b1, length - w.b0, close);
  }
}

TEST(Algebra, ArrivalIsNeverShorterThanTheStraightLineAndStraightWhereSeen) {
  Random random(3);
  for (int i = 0; i < count(); ++i) {
    const double length = random.log_uniform(0.1, 10);
    const Window w = random.window(length);
    const Vec2 p{random.uniform(-1, 2) * length, random.uniform(0, 2) * length};
    const Arrival a = arrival(w, p);
    const double straight = straight_value(w, p), close = 16 * kEpsilon * (norm(p) + norm(w.source) + w.sigma);
    ASSERT_GE(a.value, straight - close) << i;
    ASSERT_GE(a.detour, -close);
    // The shortest way through the interval, sampled: nothing beats the arrival, something comes near.
    double best = kInfinity;
    for (int s = 0; s <= 64; ++s) {
      const double x = w.b0 + (w.b1 - w.b0) * s / 64;
      best = std::min(best, value_at(w, x) + length_of(p.x - x, p.y));
    }
    ASSERT_LE(a.value, best + close) << i;
    ASSERT_GE(a.value, best - (w.b1 - w.b0) / 32 - close) << i;
    ASSERT_LE(least_value(w), std::min(w.d0, w.d1) + close);
    ASSERT_LE(minimum_of(w), best);
    ASSERT_GE(minimum_of(w), least_value(w) - close);
  }
}

TEST(Algebra, TheRidgeIsWhereBothValuesAgree) {
  Random random(4);
  int found = 0;
  for (int i = 0; i < count(); ++i) {
    const double length = random.log_uniform(0.1, 10);
    const Window a = random.window(length), b = random.window(length);
    const double p = std::max(a.b0, b.b0), q = std::min(a.b1, b.b1);
    const double fp = value_at(a, p) - value_at(b, p), fq = value_at(a, q) - value_at(b, q);
    if (!(p < q) || !(fp * fq < 0)) continue;
    ++found;
    const double x = tie_point(a, b, p, q, fp, fq);
    ASSERT_GE(x, p);
    ASSERT_LE(x, q);
    // The place itself is a double: the difference of two values changes by up to twice as much as it is rounded.
    const double placing = 2 * std::numeric_limits<double>::epsilon() * x;
    ASSERT_LE(std::abs(value_at(a, x) - value_at(b, x)), tie(value_at(a, x)) + placing) << i;
  }
  EXPECT_GT(found, count() / 50);
}

TEST(Algebra, TrimmingLeavesTheLeastWindowEverywhere) {
  Random random(5);
  Envelope envelope;
  for (int i = 0; i < count() / 20; ++i) {
    const double length = random.log_uniform(0.1, 10);
    std::vector<Window> all(static_cast<std::size_t>(1 + random.below(12)));
    for (Window& w : all) w = random.window(length);
    if (random.below(3) == 0) all.push_back(all.front());
    const auto trimmed = envelope(all);
    for (std::size_t k = 1; k < trimmed.size(); ++k) ASSERT_LE(trimmed[k - 1].b1, trimmed[k].b0) << i;
    for (int s = 0; s <= 50; ++s) {
      const double x = length * random.uniform(0, 1);
      double least = kInfinity, kept = kInfinity, end = kInfinity;
      for (const Window& w : all) {
        if (x >= w.b0 && x <= w.b1) least = std::min(least, value_at(w, x));
      }
      for (const Window& w : trimmed) {
        if (x >= w.b0 && x <= w.b1) kept = std::min(kept, value_at(w, x));
        end = std::min({end, std::abs(x - w.b0), std::abs(x - w.b1)});
      }
      if (kept == kInfinity && end < 4 * kSliver * 100) continue;  // in a gap that a sliver left
      if (least == kInfinity) {
        ASSERT_EQ(kept, kInfinity);
      } else {
        ASSERT_LE(kept, least + 4 * tie(least)) << "seed 5, list " << i << ", x " << x;
        ASSERT_GE(kept, least - 4 * tie(least));
      }
    }
  }
}

TEST(Algebra, EnvelopesOfLongListsAreNotQuadratic) {
  Random random(6);
  std::vector<Window> all(20000);
  for (Window& w : all) {
    w.source = {random.uniform(-1, 2), -random.log_uniform(0.01, 10)};
    w.sigma = random.uniform(0, 1e-3);
    w.b1 = 1;
    w.d0 = value_at(w, 0);
    w.d1 = value_at(w, 1);
  }
  Envelope envelope;
  const auto trimmed = envelope(all);
  EXPECT_LE(trimmed.size(), 2 * all.size());
  for (const Window& w : trimmed) {
    const double x = 0.5 * (w.b0 + w.b1);
    for (std::size_t k = 0; k < all.size(); k += 37) ASSERT_LE(value_at(w, x), value_at(all[k], x) + tie(1.0) * 12);
  }
}

TEST(Algebra, AMergedWindowLiesBelowBothAndItsSlackReachesThem) {
  Random random(7);
  Envelope envelope;
  int merged_count = 0;
  for (int i = 0; i < count(); ++i) {
    const double length = random.log_uniform(0.1, 10);
    const std::vector<Window> pair = random.neighbours(length);
    const auto parts = envelope(pair);
    if (parts.size() != 2) continue;
    const MergeBudget budget{0.2, 1.0};
    const Window a = parts[0], b = parts[1];
    Window m = b;
    if (!merge_into(a, m, 0, budget)) continue;
    ++merged_count;
    const double close = 64 * kEpsilon * std::max(a.d0, b.d1);
    ASSERT_EQ(m.b0, a.b0);
    ASSERT_EQ(m.b1, b.b1);
    ASSERT_NEAR(value_at(m, m.b0), a.d0, close) << "seed 7, pair " << i;  // (M2)
    ASSERT_NEAR(value_at(m, m.b1), b.d1, close) << "seed 7, pair " << i;
    for (int s = 0; s <= 100; ++s) {
      const double x = m.b0 + (m.b1 - m.b0) * s / 100;
      const Window& w = x <= a.b1 ? a : b;
      ASSERT_LE(value_at(m, x), value_at(w, x) + close) << "seed 7, pair " << i;                      // (M1)
      ASSERT_GE(value_at(m, x) + m.slack, value_at(w, x) + w.slack - close) << "seed 7, pair " << i;  // (M3)
    }
    ASSERT_LE(m.slack, budget.share * minimum_of(m) * (1 + 1e-12));
  }
  EXPECT_GT(merged_count, count() / 50);
}

TEST(Algebra, WindowsThatOverlapAreMergedWithoutAskingWhereTheyCross) {
  Random random(10);
  int merged_count = 0;
  for (int i = 0; i < count(); ++i) {
    const double length = random.log_uniform(0.1, 10);
    std::vector<Window> pair = random.neighbours(length);
    if (value_at(pair[0], 0) > value_at(pair[1], 0)) std::swap(pair[0], pair[1]);
    Window &a = pair[0], &b = pair[1];
    a.b1 = random.uniform(0.5, 1) * length;
    b.b0 = random.uniform(0, 0.5) * length;
    for (Window& w : pair) {
      w.d0 = value_at(w, w.b0);
      w.d1 = value_at(w, w.b1);
    }
    if (!(value_at(a, b.b0) < b.d0 && a.d1 > value_at(b, a.b1))) continue;
    const double joint = random.uniform(b.b0, a.b1);
    const MergeBudget budget{0.2, 1.0};
    Window m = b;
    if (!merge_into(a, m, {joint, value_at(a, joint), value_at(b, joint)}, 0, budget)) continue;
    ++merged_count;
    const double close = 64 * kEpsilon * std::max(a.d0, b.d1);
    ASSERT_EQ(m.b0, a.b0);
    ASSERT_EQ(m.b1, b.b1);
    ASSERT_NEAR(value_at(m, m.b0), a.d0, close) << "seed 10, pair " << i;  // (M2)
    ASSERT_NEAR(value_at(m, m.b1), b.d1, close) << "seed 10, pair " << i;
    for (int s = 0; s <= 100; ++s) {
      const double x = m.b0 + (m.b1 - m.b0) * s / 100;
      for (const Window& w : pair) {
        if (x < w.b0 || x > w.b1) continue;
        ASSERT_LE(value_at(m, x), value_at(w, x) + close) << "seed 10, pair " << i;  // (M1)
      }
      const Window& w = x <= joint ? a : b;
      ASSERT_GE(value_at(m, x) + m.slack, value_at(w, x) + w.slack - close) << "seed 10, pair " << i;  // (M3)
    }
    ASSERT_LE(m.slack, budget.share * minimum_of(m) * (1 + 1e-12));
  }
  EXPECT_GT(merged_count, count() / 200);
}

TEST(Algebra, ASweepThatMergesNothingTrimsAsTheEnvelopeDoes) {
  Random random(11);
  int swept = 0;
  for (int i = 0; i < count() / 20; ++i) {
    const double length = random.log_uniform(0.1, 10);
    std::vector<Window> all(static_cast<std::size_t>(2 + random.below(4)));
    for (Window& w : all) {
      w = random.window(length);
      w.kind = WindowKind::Circular;
      w.d0 = value_at(w, w.b0);
      w.d1 = value_at(w, w.b1);
    }
    std::vector<Window> left = all;
    std::sort(left.begin(), left.end(), [](const Window& a, const Window& b) { return a.b0 < b.b0; });
    Sweep sweep(std::span<Window>(left), [](const Window&, const Window&, const Joint&) { return false; });
    const bool done = sweep();
    left.resize(sweep.count());
    swept += done;
    for (std::size_t k = 1; done && k < left.size(); ++k) ASSERT_LE(left[k - 1].b1, left[k].b0) << i;
    for (int s = 0; s <= 50; ++s) {
      const double x = length * random.uniform(0, 1);
      double least = kInfinity, kept = kInfinity, end = kInfinity;
      for (const Window& w : all) {
        if (x >= w.b0 && x <= w.b1) least = std::min(least, value_at(w, x));
        end = std::min({end, std::abs(x - w.b0), std::abs(x - w.b1)});
      }
      for (const Window& w : left) {
        if (x >= w.b0 && x <= w.b1) kept = std::min(kept, value_at(w, x));
      }
      if (end < 4 * kSliver * 100) continue;
      if (least == kInfinity) {
        ASSERT_EQ(kept, kInfinity);
      } else {
        ASSERT_LE(kept, least + 4 * tie(least)) << "seed 11, list " << i << ", x " << x;
        ASSERT_GE(kept, least - 4 * tie(least)) << "seed 11, list " << i << ", x " << x;
      }
    }
  }
  EXPECT_GT(swept, count() / 100);
}

TEST(Algebra, MergingTwoPartsOfOneWindowGivesItBackAndCostsRounding) {
  Random random(8);
  for (int i = 0; i < count(); ++i) {
    const double length = random.log_uniform(0.1, 10);
    Window w = random.window(length);
    if (w.kind != WindowKind::Circular || w.b1 - w.b0 < 0.05 * length) continue;
    Window a = w, m = w;
    a.b1 = m.b0 = 0.5 * (w.b0 + w.b1);
    a.d1 = m.d0 = value_at(w, a.b1);
    if (!merge_into(a, m, 0, {0.02, 0.03})) continue;
    ASSERT_LE(m.slack, 1e-12 * m.d0) << i;
    const Vec2 joint{a.b1, 0}, ahead = joint + 0.5 * (joint - w.source);  // within the cone of both
    ASSERT_NEAR(straight_value(m, ahead), straight_value(w, ahead), 2e-12 * m.d0) << i;
  }
}

TEST(Algebra, LightFromACornerFillsItsSectorWithTheDistanceToTheCorner) {
  Random random(9);
  for (int i = 0; i < count(); ++i) {
    const Frame frame = random.frame();
    WindowFace f{};
    f.length[0] = frame.length;
    f.length[1] = frame.right;
    f.length[2] = frame.left;
    f.double_area = frame.length * frame.apex.y;
    const double angle = angle_at(f, 0);
    const double from = random.below(2) ? 0 : random.uniform(0, angle),
                 to = random.below(2) ? angle : random.uniform(from, angle);
    const Vec2 opening = opening_at(f, 0);
    const auto direction_of = [&](double t) {
      return t == angle ? opening : Vec2{std::cos(t), t == 0 ? 0 : std::sin(t)};
    };
    const Window w = window_of(f, {0, 0, direction_of(from), direction_of(to), opening}, 2.5);
    // In the frame from corner 2 (the apex) to corner 1.
    for (const double s : {0.0, 0.5, 1.0}) {
      const double x = w.b0 + s * (w.b1 - w.b0), share = x / frame.right;
      const Vec2 p{frame.apex.x + share * (frame.length - frame.apex.x), frame.apex.y * (1 - share)};
      ASSERT_NEAR(value_at(w, x), 2.5 + norm(p), 64 * kEpsilon * (2.5 + frame.left + frame.length)) << i;
      const double direction = std::atan2(p.y, p.x);
      ASSERT_GE(direction, from - 2e-13) << i;
      ASSERT_LE(direction, to + 2e-13) << i;
      if (s == 0) {
        ASSERT_NEAR(direction, to, 2e-13) << i;
      }
      if (s == 1) {
        ASSERT_NEAR(direction, from, 2e-13) << i;
      }
    }
  }
}

}  // namespace
}  // namespace brushfire::windows
