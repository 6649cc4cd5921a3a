// What a change of one per cent of a terrain's weights takes, against a run from nothing; by where it changes.
//
//     time_replan [VERTICES]
#include <brushfire/solvers/weighted/replanner.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numeric>
#include <random>
#include <vector>

#include "support/sheets.h"

namespace {

using namespace brushfire;

double height(Index x, Index y) { return 6 * std::sin(0.05 * x) * std::cos(0.07 * y) + std::sin(0.31 * x + 0.2 * y); }

// Of one thread, on a machine that others use, too.
template <class Work>
double seconds(Work work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// A square of one per cent of the faces around the middle (x, y), shares of the side.
void scale(std::vector<double>& weights, Index n, double x, double y, double factor) {
  const Index side = n / 10, left = static_cast<Index>(x * n) - side / 2, low = static_cast<Index>(y * n) - side / 2;
  for (Index j = low; j < low + side; ++j) {
    for (Index i = left; i < left + side; ++i) {
      for (Index k = 0; k < 2; ++k) weights[2 * (j * n + i) + k] *= factor;
    }
  }
}

}  // namespace

int main(int count, char** arguments) {
  const auto n = static_cast<Index>(std::sqrt(count > 1 ? std::atof(arguments[1]) : 140000.0)) - 1;
  const Mesh mesh = test::squares(n, height);
  std::mt19937 random(1);
  Weights weights;
  for (Index f = 0; f < mesh.face_count(); ++f)
    weights.face.push_back(std::uniform_real_distribution(1.0, 4.0)(random));
  const std::vector<Source> sources{{vertex_point(mesh, 0)}};
  const double fresh = seconds([&] { Replanner(mesh, weights, sources); });
  Replanner planner(mesh, weights, sources);
  std::printf("%u vertices, a run from nothing: %.2f s\n", mesh.vertex_count(), fresh);
  std::printf("%-34s %-8s %10s %10s %12s\n", "one per cent changes", "to", "time", "of a run", "points anew");
  const auto print = [&](const char* where, const char* how, double time, double renewed) {
    std::printf("%-34s %-8s %8.3f s %8.1f %% %10.1f %%\n", where, how, time, 100 * time / fresh, 100 * renewed);
  };
  const auto row = [&](const char* where, const char* how) {
    const double time = seconds([&] { planner.change(weights); });
    print(where, how, time, planner.renewed());
  };
  const struct {
    const char* name;
    double x, y;
  } places[] = {{"far from the source", 0.9, 0.9},
                {"at the side", 0.9, 0.3},
                {"in the middle", 0.5, 0.5},
                {"a quarter of the way", 0.25, 0.25}};
  for (const auto& p : places) {
    scale(weights.face, n, p.x, p.y, 2);
    row(p.name, "x 2");
    scale(weights.face, n, p.x, p.y, 0.5);
    row(p.name, "x 1/2");
    const std::vector<double> before = weights.face;
    scale(weights.face, n, p.x, p.y, kInfinity);
    row(p.name, "a wall");
    weights.face = before;
    row(p.name, "and back");
  }
  std::uniform_real_distribution<double> share(0.06, 0.94);
  constexpr int kPlaces = 40;
  std::vector<double> times, walls;
  double renewed = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const std::vector<double> before = weights.face;
    const double x = share(random), y = share(random);
    for (const double factor : {2.0, kInfinity}) {
      scale(weights.face, n, x, y, factor);
      (factor == 2 ? times : walls).push_back(seconds([&] { planner.change(weights); }));
      renewed += planner.renewed() / (2 * kPlaces);
      weights.face = before;
      times.push_back(seconds([&] { planner.change(weights); }));
    }
  }
  const auto median = [](std::vector<double>& values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  };
  const auto mean = [](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  };
  print("forty places anywhere, mean", "weights", mean(times), renewed);
  print("forty places anywhere, mean", "walls", mean(walls), renewed);
  print("forty places anywhere, median", "weights", median(times), renewed);
  print("forty places anywhere, median", "walls", median(walls), renewed);
}
