// The lemma of lower_costs.h, pair of intervals by pair: the mean of the costs over their ends is nowhere above the
// distance, and near it where intervals are short.
#include <brushfire/core/detail/random.h>
#include <brushfire/solvers/steiner/detail/lower_costs.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace brushfire::steiner {
namespace {

// Points from 0 to `length`: at random, or at equal steps.
std::vector<double> row(Random& random, Index count, double length, bool equal) {
  std::vector<double> at{0};
  for (Index i = 1; i < count; ++i) at.push_back(at.back() + (equal ? 1 : std::exp(random.uniform(-2, 2))));
  const double scale = length / at.back();
  for (double& t : at) t *= scale;
  return at;
}

struct Pair {
  std::vector<double> a, b;   // along either edge
  double angle;               // between them
  bool a_at_last, b_at_last;  // which ends meet
  Vec2 on_a(double t) const { return {t, 0}; }
  Vec2 on_b(double t) const {
    const Vec2 away{(a_at_last ? -1 : 1) * std::cos(angle), std::sin(angle)};  // from the vertex where they meet
    const Vec2 vertex{a_at_last ? a.back() : 0, 0};
    return vertex + (b_at_last ? b.back() - t : t) * away;
  }
};

// The costs from every point of a to every one of b, as the kernel has them.
std::vector<std::vector<double>> costs_of(const Pair& pair) {
  const auto count_a = static_cast<Index>(pair.a.size()), count_b = static_cast<Index>(pair.b.size());
  const Index room = (std::max(count_a, count_b) + 3) / 4 * 4;
  LowerTerms near, far;
  for (LowerTerms* terms : {&near, &far}) {
    for (std::vector<double>* v :
         {&terms->height, &terms->reach, &terms->variance, &terms->quotient, &terms->ceiling}) {
      v->assign(room, 0);
    }
  }
  lower_terms({pair.a.data(), count_a, pair.a_at_last}, {pair.b.data(), count_b, pair.b_at_last}, std::sin(pair.angle),
              std::cos(pair.angle), near, far);
  std::vector<double> at = pair.b, values(room, kInfinity), zero(count_a, 0);
  at.resize(room, at.back());
  const Vec2 start = pair.on_b(0), direction = (1 / pair.b.back()) * (pair.on_b(pair.b.back()) - start);
  Offers offers{std::vector<double>(room), std::vector<double>(room)};
  std::vector<std::vector<double>> costs;
  for (Index i = 0; i < count_a; ++i) {
    const Offering from{pair.a.data(), zero.data(), i, i, 0};
    const Receiving to{at.data(), values.data(), start, direction, room};
    BRUSHFIRE_ON_TARGET(Variant::Best, relax_rows_below(from, to, 1, near, far, 0, offers));
    costs.emplace_back(offers.value.begin(), offers.value.begin() + count_b);
  }
  return costs;
}

// The greatest of mean / distance over all pairs of intervals.
double most_of_mean(const Pair& pair) {
  const std::vector<std::vector<double>> c = costs_of(pair);
  constexpr int kSteps = 6;
  double most = 0;
  for (std::size_t i = 0; i + 1 < pair.a.size(); ++i) {
    for (std::size_t j = 0; j + 1 < pair.b.size(); ++j) {
      for (int s = 0; s <= kSteps; ++s) {
        for (int t = 0; t <= kSteps; ++t) {
          const double u = static_cast<double>(s) / kSteps, v = static_cast<double>(t) / kSteps;
          const double mean =
              (1 - u) * ((1 - v) * c[i][j] + v * c[i][j + 1]) + u * ((1 - v) * c[i + 1][j] + v * c[i + 1][j + 1]);
          const Vec2 x = pair.on_a((1 - u) * pair.a[i] + u * pair.a[i + 1]);
          const Vec2 y = pair.on_b((1 - v) * pair.b[j] + v * pair.b[j + 1]);
          const double distance = norm(x - y);
          if (distance > 0) most = std::max(most, mean / distance);
          if (distance == 0 && mean > 0) return kInfinity;
        }
      }
    }
  }
  return most;
}

TEST(LowerCosts, HaveMeansThatAreNowhereAboveTheDistance) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Pair pair{row(random, static_cast<Index>(2 + random.below(7)), random.uniform(0.5, 2), random.below(2) == 0),
              row(random, static_cast<Index>(2 + random.below(7)), random.uniform(0.5, 2), random.below(2) == 0),
              random.uniform(0.02, kPi - 0.02), random.below(2) == 0, random.below(2) == 0};
    ASSERT_LE(most_of_mean(pair), 1 + 1e-12);
  }
}

TEST(LowerCosts, AreOffBySecondOrderAwayFromTheVertex) {
  Random random(1);
  double last = 0;
  for (const Index steps : {8U, 16U, 32U}) {
    const Pair pair{row(random, steps + 1, 1, true), row(random, steps + 1, 1, true), kPi / 3, false, false};
    const std::vector<std::vector<double>> c = costs_of(pair);
    const double off = 1 - c[steps][steps / 2] / norm(pair.on_a(1) - pair.on_b(0.5));
    EXPECT_GT(off, 0);
    if (last > 0) {
      EXPECT_NEAR(last / off, 4, 1.2);
    }
    last = off;
  }
}

TEST(LowerCosts, ToAPlaceHaveMeansThatAreNowhereAboveTheDistance) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const std::vector<double> at = row(random, static_cast<Index>(2 + random.below(7)), 1, false);
    const double x = random.uniform(-1, 2), y = i % 10 == 0 ? 0 : std::exp(random.uniform(-6, 1));
    const auto count = static_cast<Index>(at.size());
    for (Index k = 0; k + 1 < count; ++k) {
      for (int s = 0; s <= 10; ++s) {
        const double u = s / 10.0, p = (1 - u) * at[k] + u * at[k + 1];
        const double mean =
            (1 - u) * lower_cost(at.data(), count, k, x, y, 0) + u * lower_cost(at.data(), count, k + 1, x, y, 0);
        ASSERT_LE(mean, std::hypot(x - p, y) * (1 + 1e-12) + 1e-15);
      }
    }
  }
}

}  // namespace
}  // namespace brushfire::steiner
