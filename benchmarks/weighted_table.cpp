// How near the bounds of weighted distances are to each other, and what that costs.
//
//   weighted_table [--check] [--upper] [--tolerance T]... [--kind NAME]... MESH...
//
// One line per mesh, kind of weights and tolerance: what answered, points per edge, microseconds per vertex of the
// upper bounds alone, of both, and of fast marching; (upper - lower) / lower on average and at most, and how far fast
// marching is from the upper bounds on average. Kinds: one (1 everywhere, searched all the same, beside exact
// distances), patches (1 to 4), smooth (1 to 3), random (1 to 10 per face), steep (1 or 1e9 per patch). --check: both
// bounds are held against those of the other search, points on edges, upper ones with up to 64 to an edge; vertices at
// which they contradict each other. --upper: how far the upper bounds alone are above windows' lower ones at 1e-4, on
// average and at most (not of `one` and `steep`).
#include <brushfire/core/detail/random.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/solvers/weighted/weighted_distance.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "measure.h"

namespace brushfire::benchmark {
namespace {

Vec3 middle(const Mesh& mesh, Index f) {
  const Face& t = mesh.faces()[f];
  return (1.0 / 3) * (mesh.positions()[t[0]] + mesh.positions()[t[1]] + mesh.positions()[t[2]]);
}

// Faces by the nearest of some places.
std::vector<double> patches(const Mesh& mesh, std::span<const double> weights) {
  constexpr std::size_t kPatches = 40;
  Random random(7);
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < kPatches; ++i) {
    places.push_back(middle(mesh, static_cast<Index>(random.below(mesh.face_count()))));
  }
  std::vector<double> result(mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Vec3 m = middle(mesh, f);
    const auto nearest =
        std::min_element(places.begin(), places.end(), [&](Vec3 a, Vec3 b) { return norm(a - m) < norm(b - m); });
    result[f] = weights[static_cast<std::size_t>(nearest - places.begin()) % weights.size()];
  }
  return result;
}

Weights weights_of(const Mesh& mesh, const std::string& kind) {
  Weights weights;
  if (kind == "one") {
    const Index h = 0;  // one edge named: the search is not left to Method::Windows
    weights.edges.push_back({{mesh.from(h), mesh.to(h)}, 1, 0});
  } else if (kind == "patches") {
    weights.face = patches(mesh, std::array{1.0, 2.0, 3.0, 4.0});
  } else if (kind == "steep") {
    weights.face = patches(mesh, std::array{1.0, 1e9});
  } else {
    Random random(3);
    const Box& box = mesh.bounds();
    const Vec3 size = box.high - box.low;
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const Vec3 m = middle(mesh, f) - box.low;
      const double waves = std::sin(7 * m.x / std::max(size.x, 1e-9)) * std::cos(6 * m.y / std::max(size.y, 1e-9));
      weights.face.push_back(kind == "smooth" ? 2 + waves : random.uniform(1, 10));
    }
  }
  return weights;
}

// By another search: no lower bound above the upper ones there, and no upper one below the lower ones.
void check(const Mesh& mesh, const Weights& weights, std::span<const Source> sources, const WeightedField& field) {
  const std::vector<double> above =
      weighted_distance(mesh, weights, sources, {.tolerance = 1e-3, .lower = false}).distance;
  const WeightedField others = weighted_distance(mesh, weights, sources, {.tolerance = 0.01, .keep_paths = true});
  std::size_t wrong = 0;
  for (std::size_t v = 0; v < above.size(); ++v) {
    constexpr double kRounding = 1e-11;
    wrong += field.lower[v] > above[v] * (1 + kRounding) || field.distance[v] < others.lower[v] * (1 - kRounding);
  }
  std::printf("  %zu of %zu wrong", wrong, above.size());
}

// Of upper bounds alone: where windows say what is nearly the truth.
void tell_upper(WeightedSolver& solver, std::span<const Source> sources, const WeightedField& upper) {
  const WeightedField truth = solver.distance(sources, {.tolerance = 1e-4});
  if (truth.engine != WeightedEngine::Windows) return;
  double sum = 0, most = 0;
  for (std::size_t v = 0; v < truth.lower.size(); ++v) {
    if (!(truth.lower[v] > 0 && truth.lower[v] < kInfinity)) continue;
    const double above = upper.distance[v] / truth.lower[v] - 1;
    sum += above;
    most = std::max(most, above);
  }
  std::printf("  upper alone %.2f %% %.2f %%", 100 * sum / static_cast<double>(truth.lower.size()), 100 * most);
}

// Microseconds a vertex; the field of the second run.
double timed(WeightedSolver& solver, std::span<const Source> sources, const WeightedOptions& options,
             WeightedField& field) {
  static_cast<void>(solver.distance(sources, options));
  const double start = cpu_seconds();
  field = solver.distance(sources, options);
  return 1e6 * (cpu_seconds() - start) / solver.domain().mesh().vertex_count();
}

struct Extras {
  bool checks = false, upper = false;
};

void measure(const std::string& name, const Mesh& mesh, const std::string& kind, double tolerance,
             const Extras& extras) {
  const std::vector<Source> sources{{vertex_point(mesh, 0)}};
  const Weights weights = weights_of(mesh, kind);
  WeightedSolver solver(mesh, weights);
  WeightedField field, marched, alone;
  const double upper = timed(solver, sources, {.tolerance = tolerance, .lower = false}, alone);
  const double both = timed(solver, sources, {.tolerance = tolerance}, field);
  double march = 0, off = 0;
  if (kind != "one") {
    march = timed(solver, sources, {.marching = Method::KimmelSethian}, marched);
    double count = 0;
    for (std::size_t v = 0; v < field.distance.size(); ++v) {
      if (!(field.distance[v] > 0 && field.distance[v] < kInfinity)) continue;
      off += std::abs(marched.distance[v] / field.distance[v] - 1);
      ++count;
    }
    off /= count;
  }
  std::printf("%-18s %-8s %8g %-8s %6.1f %7.2f %7.2f %7.3f  %8.4f %% %8.3f %% %7.2f %%", name.c_str(), kind.c_str(),
              tolerance, name_of(field.engine), static_cast<double>(field.points) / (1.5 * mesh.face_count()), upper,
              both, march, 100 * field.mean_error_bound, 100 * field.max_error_bound, 100 * off);
  if (extras.upper && kind != "one" && kind != "steep") tell_upper(solver, sources, alone);
  if (extras.checks) check(mesh, weights, sources, field);
  if (kind == "one") {
    const std::vector<double> exact = distance(mesh, sources, {.method = Method::Exact}).distance;
    const RelativeError high = relative_error(field.distance, exact), low = relative_error(field.lower, exact);
    std::printf("  upper %.4f %% %.3f %%, lower %.4f %% %.3f %%", 100 * high.mean, 100 * high.maximum, 100 * low.mean,
                100 * low.maximum);
    if (high.shortest < -1e-12) std::printf("  UPPER IS BELOW by %g", -high.shortest);
    for (std::size_t v = 0; v < exact.size(); ++v) {
      if (field.lower[v] > exact[v] * (1 + 1e-12)) std::printf("  LOWER IS ABOVE at %zu", v);
    }
  }
  std::printf("\n");
}

int run(int count, char** arguments) {
  std::vector<double> tolerances;
  std::vector<std::string> kinds, meshes;
  Extras extras;
  for (int i = 1; i < count; ++i) {
    const std::string word = arguments[i];
    if (word == "--tolerance" && i + 1 < count) {
      tolerances.push_back(std::strtod(arguments[++i], nullptr));
    } else if (word == "--kind" && i + 1 < count) {
      kinds.emplace_back(arguments[++i]);
    } else if (word == "--check") {
      extras.checks = true;
    } else if (word == "--upper") {
      extras.upper = true;
    } else {
      meshes.push_back(word);
    }
  }
  if (tolerances.empty()) tolerances = {0.1, 0.03, 0.01, 0.003};
  if (kinds.empty()) kinds = {"one", "patches", "smooth", "random", "steep"};
  std::printf("%-18s %-8s %8s %-8s %6s %7s %7s %7s  %10s %10s %9s\n", "mesh", "weights", "wish", "engine", "points",
              "upper", "both", "march", "mean", "max", "march off");
  for (const std::string& path : meshes) {
    const Mesh mesh = read_mesh(path).mesh;
    for (const std::string& kind : kinds) {
      for (const double tolerance : tolerances) {
        measure(path.substr(path.rfind('/') + 1), mesh, kind, tolerance, extras);
      }
    }
  }
  return 0;
}

}  // namespace
}  // namespace brushfire::benchmark

int main(int count, char** arguments) {
  return brushfire::benchmark::guarded("weighted_table", brushfire::benchmark::run, count, arguments);
}
