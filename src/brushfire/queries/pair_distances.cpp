// One run per vertex where pairs start.
#include <brushfire/queries/pair_distances.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/core/parallel.h>
#include <brushfire/mesh/report.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>

namespace brushfire {
namespace {

using Pair = std::array<Index, 2>;

std::size_t distinct(std::span<const Pair> pairs, std::size_t side, Index vertex_count) {
  std::vector<bool> seen(vertex_count, false);
  std::size_t count = 0;
  for (const Pair& p : pairs) {
    if (!seen[p[side]]) ++count;
    seen[p[side]] = true;
  }
  return count;
}

void check(std::span<const Pair> pairs, Index vertex_count) {
  for (const Pair& p : pairs) {
    for (const Index v : p) {
      if (v < vertex_count) continue;
      throw Error(ErrorCode::IndexOutOfRange,
                  "pairs: vertex " + std::to_string(v) + ", but the mesh has " + std::to_string(vertex_count));
    }
  }
}

// Pairs that start at the same vertex, by position.
struct Groups {
  std::vector<std::size_t> order;   // [pairs]
  std::vector<std::size_t> begins;  // [groups + 1]

  Groups(std::span<const Pair> pairs, std::size_t from) : order(pairs.size()) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return pairs[a][from] < pairs[b][from]; });
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i == 0 || pairs[order[i]][from] != pairs[order[i - 1]][from]) begins.push_back(i);
    }
    begins.push_back(order.size());
  }
  std::size_t count() const { return begins.size() - 1; }
  std::span<const std::size_t> group(std::size_t g) const {
    return std::span(order).subspan(begins[g], begins[g + 1] - begins[g]);
  }
};

}  // namespace

std::vector<double> pair_distances(const Domain& domain, std::span<const Pair> pairs, const MatrixOptions& options) {
  const Mesh& mesh = domain.mesh();
  check(pairs, mesh.vertex_count());
  std::vector<double> result(pairs.size(), kInfinity);
  // Weights may cost more in one direction than in the other.
  const bool turned =
      !options.distance.weighting && distinct(pairs, 1, mesh.vertex_count()) < distinct(pairs, 0, mesh.vertex_count());
  const std::size_t from = turned ? 1 : 0, to = 1 - from;
  const Groups groups(pairs, from);
  DistanceOptions run = options.distance;
  run.progress = nullptr;
  run.cancel = nullptr;  // a CancelScope listens
  const CancelScope scope(options.distance.cancel);
  const auto threads = static_cast<unsigned>(std::clamp<std::size_t>(groups.count(), 1, thread_count(options.threads)));
  std::vector<std::unique_ptr<DistanceSolver>> solvers(threads);
  std::atomic<std::size_t> done{0};
  const auto body = [&](unsigned worker, std::size_t g) {
    const std::span<const std::size_t> group = groups.group(g);
    const Index start = pairs[group.front()][from];
    // From a vertex in no face, or behind a wall, nothing leads anywhere.
    if (domain.is_open(start)) {
      if (!solvers[worker]) solvers[worker] = std::make_unique<DistanceSolver>(domain);
      DistanceOptions own = run;
      for (const std::size_t i : group) own.targets.push_back(target_point(mesh, pairs[i][to]));
      const Source source{vertex_point(mesh, start)};
      const DistanceField field = solvers[worker]->distance(std::span(&source, 1), own);
      for (std::size_t k = 0; k < group.size(); ++k) result[group[k]] = field.target_distance[k];
    }
    const std::size_t finished = ++done;
    if (worker == 0 && options.distance.progress) {
      options.distance.progress(static_cast<double>(finished) / static_cast<double>(groups.count()));
    }
  };
  parallel_for(groups.count(), threads, body, current_cancel_token());
  return result;
}

double root_of_area(const Mesh& mesh) {
  const double root = std::sqrt(mesh.report().area);
  if (!(root > 0) || !std::isfinite(root)) {
    throw Error(ErrorCode::InvalidArgument, "a surface without area has no unit: distances are not normalised");
  }
  return root;
}

}  // namespace brushfire
