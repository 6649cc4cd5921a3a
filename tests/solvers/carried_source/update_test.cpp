// The update over one edge, against closed forms.
#include <brushfire/solvers/carried_source/detail/update.h>

#include <brushfire/core/detail/random.h>
#include <brushfire/solvers/carried_source/detail/offer_batch.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace brushfire::carried_source {
namespace {

using Source2 = SourceAt<double>;

struct Triangle {
  double length, x, y;
  double along() const { return std::hypot(x, y); }
};

double value_at(const Source2& s, double x, double y) { return s.sigma + std::hypot(x - s.x, y - s.y); }

Offer<double> offer(const Triangle& t, const Source2& a, const Source2& b) {
  return offer_over<double>(t.length, t.x, t.y, t.along(), value_at(a, 0, 0), value_at(b, t.length, 0), a, b);
}

TEST(CarriedUpdate, OfOneSourceThatLightsBothEndsIsItsDistance) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 10'000; ++i) {
    const Triangle t{0.2 + unit(random), 2 * unit(random) - 0.5, 0.05 + unit(random)};
    const double crossing = t.length * unit(random), far = 0.01 + 100 * unit(random) * unit(random);
    const double norm = std::hypot(t.x - crossing, t.y);
    const Source2 s{crossing - far * (t.x - crossing) / norm, -far * t.y / norm, unit(random)};
    const Offer<double> o = offer(t, s, s);
    const double expected = value_at(s, t.x, t.y);
    ASSERT_NEAR(o.value, expected, 1e-13 * expected);
    ASSERT_NEAR(o.sigma, s.sigma, 1e-12 * expected);
    ASSERT_NEAR(t.x + o.x, s.x, 1e-12 * (1 + far));
    ASSERT_NEAR(t.y + o.y, s.y, 1e-12 * (1 + far));
  }
}

TEST(CarriedUpdate, OfASourceThatDoesNotSeeTheTargetIsTheWayAlongTheEdge) {
  const Triangle t{1, 0.5, 0.8};
  for (const Source2& s : {Source2{-3, -0.1, 0}, Source2{5, -0.2, 0}}) {
    const Offer<double> o = offer(t, s, s);
    EXPECT_EQ(o.value, value_at(s, 0, 0) + t.along());
    EXPECT_EQ(o.sigma, o.value - std::hypot(t.x, t.y));
    EXPECT_EQ(o.x, -t.x);
    EXPECT_EQ(o.y, -t.y);
  }
}

// Two fronts that come towards each other meet: the target reads the first.
TEST(CarriedUpdate, TakesTheLesserOfTwoFrontsThatMeetConcavely) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  int seen = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Triangle t{1, 0.2 + 0.6 * unit(random), 0.4 + 0.5 * unit(random)};
    // Each is nearer to its own end.
    const Source2 a{0.3 * unit(random), -1 - unit(random), 0}, b{1 - 0.3 * unit(random), -1 - unit(random), 0};
    const double at_v = value_at(a, 0, 0), at_b = value_at(b, 1, 0);
    if (value_at(b, 0, 0) < at_v || value_at(a, 1, 0) < at_b) continue;
    const Offer<double> o = offer(t, a, b);
    EXPECT_NEAR(o.value, std::min(value_at(a, t.x, t.y), value_at(b, t.x, t.y)), 1e-13);
    ++seen;
  }
  EXPECT_GT(seen, 1000);
}

// Between two sources that both come too early for the other's end a front opens. By symmetry it comes from between
// them; the interpolant is a parabola over the edge, a quarter of the miss above both in the middle.
TEST(CarriedUpdate, OpensAFanBetweenSourcesThatPart) {
  const Triangle t{1, 0.5, 0.9};
  const Source2 a{0.6, -2, 0.3}, b{0.4, -2, 0.3};
  const double miss = value_at(b, 1, 0) - value_at(a, 1, 0);
  ASSERT_GT(miss, 0);
  const Offer<double> o = offer(t, a, b);
  EXPECT_NEAR(o.value, value_at(a, 0.5, 0.9) + miss / 4, 1e-13);
  EXPECT_NEAR(o.x, 0, 1e-13);  // the way back is in the middle
  // Rounder than the sources are far.
  EXPECT_LT(o.value - o.sigma, 2.9);
  EXPECT_GT(o.value - o.sigma, 2.9 / 3 - 1e-12);
}

// From where one of the two is the only one that is seen, through the fan, to where the other one is.
TEST(CarriedUpdate, TheFanIsContinuousWithBothSources) {
  const Source2 a{0.6, -2, 0.3}, b{0.4, -2, 0.3};
  double last = 0;
  for (int i = 0; i <= 2000; ++i) {
    const double x = -0.12 + 1.24 * i / 2000;
    const Offer<double> o = offer({1, x, 0.5}, a, b);
    if (i > 0) {
      EXPECT_LT(std::abs(o.value - last), 2e-3) << x;
    }
    last = o.value;
  }
}

// A triangle without height, an end without a value, a source at an end: no NaN.
TEST(CarriedUpdate, KnowsWhatIsNotThere) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Source2 at_a{0, 0, 1}, at_b{1, 0, 1.5};
  const Offer<double> flat = offer_over<double>(1, 0.5, 0, 0.5, 1, 1.5, at_a, at_b);
  EXPECT_EQ(flat.value, 1.5);
  EXPECT_EQ(flat.sigma, 1);
  const Offer<double> alone = offer_over<double>(1, 0.5, 0.5, 0.75, 1, kNever, at_a, {0, 0, kNever});
  EXPECT_EQ(alone.value, 1.75);
}

TEST(CarriedUpdate, ASourceAboveTheEdgeOrInTheDarkIsTheVertexItself) {
  const auto below = [](double x, double y, bool dark) {
    return source_below<double>(5, 2, x, y, false, dark, 1, 0, 1, 0, 1, 1);
  };
  EXPECT_EQ(below(1, -2, false).sigma, 2);
  EXPECT_EQ(below(1, -2, false).y, -2);
  EXPECT_EQ(below(1, 2, false).sigma, 5);
  EXPECT_EQ(below(1, 2, false).y, 0);
  EXPECT_EQ(below(1, -2, true).sigma, 5);
}

// Any numbers and facts, those of no triangle included.
template <class T>
OfferBatch<T> any_batch(Random& random) {
  using Batch = OfferBatch<T>;
  Batch batch;
  batch.count = Batch::kLanes;
  const auto four = [&](T low, T high) {
    const auto any = [&] { return static_cast<T>(random.uniform(low, high)); };
    return Four<T>{any(), any(), any(), any()};
  };
  for (int i = 0; i < Batch::kLanes; ++i) {
    batch.facts[i] = static_cast<std::uint32_t>(random.below(2 * Batch::kBendsThere));
    for (auto* sets : {batch.sectors, batch.turned, batch.dark}) {
      sets[i] = static_cast<std::uint32_t>(random.below(std::uint64_t{1} << 32));
    }
    batch.here[i] = four(-2, 4), batch.there[i] = four(-2, 4);
    batch.by[i] = four(T(0.1), 1), batch.to[i] = four(T(0.1), 1);
    batch.ends[i] = four(-1, 1), batch.around[i] = four(-1, 1);
  }
  return batch;
}

// As a march works it out where the offer stands alone.
template <class T>
Offer<T> offer_of(const OfferBatch<T>& batch, int i) {
  using Batch = OfferBatch<T>;
  const Update u{batch.facts[i]};
  const auto is = [&](std::uint32_t fact) { return (batch.facts[i] & fact) != 0; };
  const auto sees = [&](const std::uint32_t* sets, std::uint32_t end) {
    return (batch.sectors[i] & sets[i] & end) != 0;
  };
  const Four<T>&here = batch.here[i], &there = batch.there[i], &around = batch.around[i];
  Side<T> by, to;
  by.length = batch.by[i].a, by.c = batch.by[i].b, by.s = batch.by[i].c, by.end_c = batch.by[i].d;
  to.length = batch.to[i].a, to.c = batch.to[i].b, to.s = batch.to[i].c, to.end_c = batch.to[i].d;
  by.end_s = batch.ends[i].a, to.end_s = batch.ends[i].b;
  const auto see = [&](const Four<T>& from, const SideTurn<T>& t, bool turned, bool dark) {
    return source_below<T>(from.a, from.b, from.c, from.d, turned, dark, t.c, t.s, t.tc, t.ts, t.side, by.length);
  };
  const SourceAt<T> a = see(here, side_turn(by.c, by.s, u.hand(), {around.a, around.b}),
                            sees(batch.turned, Batch::kHere), sees(batch.dark, Batch::kHere));
  SourceAt<T> b = see(there, side_turn(by.end_c, by.end_s, u.hand_there(), {around.c, around.d}),
                      sees(batch.turned, Batch::kThere), sees(batch.dark, Batch::kThere));
  b.x = by.length - b.x;
  const OfferFrame<T> f = offer_frame(by, to, u, {around.a, around.b}, {batch.ends[i].c, batch.ends[i].d});
  const Offer<T> o = offer_over<T>(by.length, f.x, f.y, to.length, here.a, there.a, a, b,
                                   {bending_by<T>(is(Batch::kBendsHere)), bending_by<T>(is(Batch::kBendsThere))});
  const T oy = f.sign * o.y;
  return {o.value, o.sigma, o.x * f.turn_c - oy * f.turn_s, o.x * f.turn_s + oy * f.turn_c};
}

template <class T>
void expect_offers_alone() {
  Random random(5);
  for (int round = 0; round < 500; ++round) {
    for (const Variant variant : {Variant::Portable, Variant::Best}) {
      OfferBatch<T> batch = any_batch<T>(random);
      BRUSHFIRE_ON_TARGET(variant, work_out(batch));
      for (int i = 0; i < OfferBatch<T>::kLanes; ++i) {
        const Offer<T> alone = offer_of(batch, i);
        ASSERT_EQ(batch.value[i], alone.value) << round << ' ' << i;
        ASSERT_EQ(batch.sigma[i], alone.sigma) << round << ' ' << i;
        ASSERT_EQ(batch.x[i], alone.x) << round << ' ' << i;
        ASSERT_EQ(batch.y[i], alone.y) << round << ' ' << i;
      }
    }
  }
}

TEST(CarriedUpdate, IsTheSameBitsAloneAndInABatchOnEveryProcessor) {
  expect_offers_alone<float>();
  expect_offers_alone<double>();
}

}  // namespace
}  // namespace brushfire::carried_source
