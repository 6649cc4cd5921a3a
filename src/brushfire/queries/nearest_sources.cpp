// One run per source, limited to the greatest of the vertices' k-th distances so far.
#include <brushfire/queries/nearest_sources.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/core/error.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace brushfire {
namespace {

// The sources in an order that visits all parts of the list early, so that the limit falls soon: by their numbers' bits
// turned round.
std::vector<Index> spread_order(std::size_t count) {
  std::vector<std::pair<Index, Index>> keyed;
  for (Index i = 0; i < count; ++i) {
    Index reversed = 0;
    for (int bit = 0; bit < 32; ++bit) reversed |= ((i >> bit) & 1u) << (31 - bit);
    keyed.emplace_back(reversed, i);
  }
  detail::sort(keyed.begin(), keyed.end());
  std::vector<Index> order;
  for (const auto& [key, i] : keyed) order.push_back(i);
  return order;
}

// Puts (distance, source) into its place among the first k of a vertex.
void insert(std::span<double> distances, std::span<Index> sources, double distance, Index source) {
  std::pair entry{distance, source};
  for (std::size_t j = 0; j < distances.size(); ++j) {
    std::pair here{distances[j], sources[j]};
    if (here <= entry) continue;
    distances[j] = entry.first;
    sources[j] = entry.second;
    entry = here;
  }
}

}  // namespace

NearestSources nearest_sources(const Domain& domain, std::span<const Source> sources, Index count,
                               const DistanceOptions& options) {
  if (count == 0) throw Error(ErrorCode::InvalidArgument, "at least one nearest source is needed, not 0");
  if (sources.empty()) throw Error(ErrorCode::InvalidArgument, "no source given: a distance needs at least one");
  const Index vertices = domain.mesh().vertex_count();
  const std::size_t k = std::min<std::size_t>(count, sources.size());
  NearestSources result{static_cast<Index>(k), std::vector<double>(vertices * k, kInfinity),
                        std::vector<Index>(vertices * k, kNoIndex)};
  const CancelScope listen(options.cancel);
  DistanceSolver solver(domain);
  DistanceOptions run = options;
  run.targets.clear();
  run.progress = nullptr;
  SparseField field;
  std::size_t done = 0;
  for (const Index s : spread_order(sources.size())) {
    // From k runs on there is a limit; +inf where a vertex has fewer, in a component of its own.
    if (done >= k) {
      double limit = -kInfinity;
      for (Index v = 0; v < vertices; ++v) {
        if (domain.is_open(v)) limit = std::max(limit, result.distance[v * k + k - 1]);
      }
      // A front that starts behind the limit changes nothing; equal distances may still bring a lower source.
      run.max_distance = std::min(options.max_distance, std::max(limit, 0.0));
      if (sources[s].offset > limit) continue;
    }
    solver.distance_sparse(sources.subspan(s, 1), run, field);
    for (std::size_t i = 0; i < field.vertex.size(); ++i) {
      const std::size_t at = field.vertex[i] * k;
      insert(std::span(result.distance).subspan(at, k), std::span(result.source).subspan(at, k), field.distance[i], s);
    }
    ++done;
    if (options.progress) options.progress(static_cast<double>(done) / static_cast<double>(sources.size()));
  }
  return result;
}

}  // namespace brushfire
