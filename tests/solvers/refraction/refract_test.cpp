// What takes the place of a window behind an edge between two weights: random windows, one claim of docs/weights.md a
// test.
#include <brushfire/core/detail/random.h>
#include <brushfire/solvers/refraction/detail/refract.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace brushfire::refraction {
namespace {

using windows::WindowKind;

constexpr double kRounding = 2e-10;  // eight epsilons of the farthest source
constexpr int kPlaces = 64;          // of an interval that are looked at

double log_uniform(Random& random, double a, double b) { return std::exp(random.uniform(std::log(a), std::log(b))); }

Window random_window(Random& random) {
  Window w;
  w.sigma = random.below(2) == 0 ? 0 : random.uniform(0, 5);
  if (random.below(5) == 0) {
    w.kind = WindowKind::Linear;
    const double angle = random.uniform(0.05, 3.09);
    w.source = {std::cos(angle), -std::sin(angle)};
    w.sigma += 1;
  } else {
    w.source = {random.uniform(-3, 4), -log_uniform(random, 1e-3, 10)};
  }
  w.b0 = random.below(3) == 0 ? 0 : random.uniform(0, 0.8);
  w.b1 = random.below(3) == 0 ? 1 : random.uniform(w.b0 + 0.01, 1);
  w.d0 = value_at(w, w.b0);
  w.d1 = value_at(w, w.b1);
  w.slack = random.below(2) == 0 ? 0 : 0.005 * windows::minimum_of(w);
  w.pseudo_source = 7;
  return w;
}

struct Case {
  Window w;
  double n = 1;
  RefractionBudget budget;
  std::vector<Window> behind;
};

Case random_case(Random& random) {
  Case c;
  c.w = random_window(random);
  c.n = random.below(2) == 0 ? log_uniform(random, 1.01, 50) : 1 / log_uniform(random, 1.01, 50);
  c.budget.share = log_uniform(random, 1e-5, 0.05);
  refract(c.w, c.n, c.budget, c.behind);
  return c;
}

template <class Check>
void for_random_cases(const Check& check) {
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    Random random(seed);
    const Case c = random_case(random);
    SCOPED_TRACE("seed " + std::to_string(seed));
    check(c);
    if (testing::Test::HasFailure()) return;
  }
}

template <class Check>
void for_places(const Window& w, const Check& check) {
  for (int i = 0; i <= kPlaces; ++i) {
    const double x = i == kPlaces ? w.b1 : w.b0 + (w.b1 - w.b0) * i / kPlaces;
    check(x);
  }
}

// By how much values grow along the edge.
double slope_at(const Window& w, double x) {
  if (w.kind == WindowKind::Linear) return -w.source.x;
  const double r = windows::length_of(x - w.source.x, w.source.y);
  return r > 0 ? (x - w.source.x) / r : 0;
}

TEST(Refract, IsNowhereAboveTheFrontThatItReplaces) {
  for_random_cases([](const Case& c) {
    for (const Window& r : c.behind) {
      for_places(r, [&](double x) { ASSERT_LE(value_at(r, x), c.n * value_at(c.w, x) * (1 + kRounding)) << x; });
    }
  });
}

TEST(Refract, CarriesASlackThatLeadsBackAboveTheRealPath) {
  for_random_cases([](const Case& c) {
    for (const Window& r : c.behind) {
      for_places(r, [&](double x) {
        const double real = c.n * (value_at(c.w, x) + c.w.slack);
        ASSERT_GE(value_at(r, x) + r.slack, real * (1 - kRounding)) << x;
      });
    }
  });
}

// What is spent beyond the converted slack is a loss that some place of the piece has, up to the arches between four
// chords.
TEST(Refract, SpendsNoMoreThanItLoses) {
  for_random_cases([](const Case& c) {
    for (const Window& r : c.behind) {
      double loss = 0;
      for_places(r, [&](double x) { loss = std::max(loss, c.n * value_at(c.w, x) - value_at(r, x)); });
      const double spent = r.slack - c.n * c.w.slack;
      ASSERT_GE(spent, loss - kRounding * r.d0);
      ASSERT_LE(spent, 8 * loss + kRounding * (r.d0 + r.d1) + 1e-3 * c.budget.share * windows::minimum_of(r));
    }
  });
}

TEST(Refract, AgreesWithTheFrontAtTheEndsOfEveryPiece) {
  for_random_cases([](const Case& c) {
    for (const Window& r : c.behind) {
      ASSERT_NEAR(value_at(r, r.b0), c.n * value_at(c.w, r.b0), kRounding * (1 + std::abs(r.d0)));
      ASSERT_NEAR(value_at(r, r.b1), c.n * value_at(c.w, r.b1), kRounding * (1 + std::abs(r.d1)));
      ASSERT_NEAR(value_at(r, r.b0), r.d0, kRounding * (1 + std::abs(r.d0)));
      ASSERT_NEAR(value_at(r, r.b1), r.d1, kRounding * (1 + std::abs(r.d1)));
      ASSERT_EQ(r.pseudo_source, c.w.pseudo_source);
    }
  });
}

// So that what refracts lies in the cone of light behind the edge, and no gap opens between two pieces.
TEST(Refract, OpensAtLeastAsWideAsTheLightThatRefracts) {
  constexpr double kSlopes = 1e-6;  // roots of rounding, where light grazes
  for_random_cases([](const Case& c) {
    for (const Window& r : c.behind) {
      ASSERT_LE(slope_at(r, r.b0), c.n * slope_at(c.w, r.b0) + kSlopes);
      ASSERT_GE(slope_at(r, r.b1), c.n * slope_at(c.w, r.b1) - kSlopes);
    }
  });
}

TEST(Refract, TilesWhatLiesBeforeTheCriticalAngle) {
  constexpr double kPlace = 1e-7;  // a piece that grazes may be left out: its light runs along the edge
  for_random_cases([](const Case& c) {
    double from = c.w.b0, to = c.w.b1;
    if (c.n > 1 && c.w.kind == WindowKind::Circular) {  // sin = |x - source.x| / r = 1 / n
      const double reach = -c.w.source.y * std::tan(std::asin(1 / c.n));
      from = std::max(from, c.w.source.x - reach);
      to = std::min(to, c.w.source.x + reach);
    }
    const bool reflected = c.w.kind == WindowKind::Linear && c.n * std::abs(c.w.source.x) >= 1;
    if (from >= to - kPlace || reflected) {
      ASSERT_LE(c.behind.size(), 1U);
      return;
    }
    ASSERT_FALSE(c.behind.empty());
    ASSERT_NEAR(c.behind.front().b0, from, kPlace);
    ASSERT_NEAR(c.behind.back().b1, to, kPlace);
    for (std::size_t i = 1; i < c.behind.size(); ++i) ASSERT_EQ(c.behind[i].b0, c.behind[i - 1].b1);
    if (c.n < 1) {
      ASSERT_EQ(c.behind.front().b0, c.w.b0);
      ASSERT_EQ(c.behind.back().b1, c.w.b1);
    }
  });
}

TEST(Refract, TurnsParallelLightAsSnellSaysAndLosesNothing) {
  for_random_cases([](const Case& c) {
    if (c.w.kind != WindowKind::Linear) return;
    for (const Window& r : c.behind) {
      ASSERT_EQ(r.kind, WindowKind::Linear);
      ASSERT_NEAR(r.source.x, c.n * c.w.source.x, kRounding);
      ASSERT_NEAR(norm(r.source), 1, kRounding);
      ASSERT_EQ(r.slack, c.n * c.w.slack);
    }
  });
}

// As behind a face without area.
TEST(Refract, StartsAnewFromAPointOfTheEdge) {
  Window w;
  w.source = {0.4, 0};
  w.sigma = 2, w.slack = 0.01;
  w.b0 = 0.1, w.b1 = 1;
  w.d0 = value_at(w, w.b0), w.d1 = value_at(w, w.b1);
  for (const double n : {3.0, 0.25}) {
    std::vector<Window> behind;
    refract(w, n, {.share = 0.01}, behind);
    ASSERT_EQ(behind.size(), 1U);
    EXPECT_EQ(behind[0].sigma, n * w.sigma);
    EXPECT_EQ(behind[0].slack, n * w.slack);
    EXPECT_EQ(behind[0].d1, n * w.sigma + 0.6);
  }
}

// All is spent by no refraction: a pace of what is left, and where nothing is left, what a way as long as the piece
// earns.
TEST(Refract, KeepsToItsBudgetWhereHalvesAreSmallEnough) {
  std::size_t within = 0, all = 0;
  for_random_cases([&](const Case& c) {
    if (c.w.kind == WindowKind::Linear) return;
    for (const Window& r : c.behind) {
      const double room = c.budget.share * windows::minimum_of(r), left = room - c.n * c.w.slack;
      const double spent = r.slack - c.n * c.w.slack;
      ++all;
      within += spent <= std::max(c.budget.pace * left, 0.5 * c.budget.share * (r.b1 - r.b0)) * (1 + 1e-9) + kRounding;
    }
  });
  EXPECT_GT(all, 20000U);
  EXPECT_GT(static_cast<double>(within), 0.98 * static_cast<double>(all));
}

}  // namespace
}  // namespace brushfire::refraction
