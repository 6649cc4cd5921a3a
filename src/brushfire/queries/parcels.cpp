// One run per parcel where that is enough; else one per vertex, summed up by label as they come.
#include <brushfire/queries/parcels.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/core/parallel.h>
#include <brushfire/queries/detail/rows.h>
#include <brushfire/queries/vertex_measures.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <utility>

namespace brushfire {
namespace {

constexpr std::array<std::pair<std::string_view, ParcelDistance>, 5> kNames{{
    {"min", ParcelDistance::Min},
    {"hausdorff", ParcelDistance::Hausdorff},
    {"centroid", ParcelDistance::Centroid},
    {"mean", ParcelDistance::Mean},
    {"max", ParcelDistance::Max},
}};

// The vertices of each parcel, and the parcel of each vertex.
struct Parcels {
  std::vector<std::int64_t> label;
  std::vector<std::vector<Index>> members;
  std::vector<Index> of_vertex;  // kNoIndex: in none

  Parcels(const Domain& domain, std::span<const std::int64_t> labels, std::int64_t least)
      : of_vertex(labels.size(), kNoIndex) {
    for (Index v = 0; v < labels.size(); ++v) {
      if (labels[v] >= least && domain.is_open(v)) label.push_back(labels[v]);
    }
    std::sort(label.begin(), label.end());
    label.erase(std::unique(label.begin(), label.end()), label.end());
    members.resize(label.size());
    for (Index v = 0; v < labels.size(); ++v) {
      if (labels[v] < least || !domain.is_open(v)) continue;
      of_vertex[v] = static_cast<Index>(std::lower_bound(label.begin(), label.end(), labels[v]) - label.begin());
      members[of_vertex[v]].push_back(v);
    }
  }
  std::size_t count() const { return label.size(); }
};

// Runs something per item on threads, each with a solver of its own.
template <class Body>
void run_all(const Domain& domain, std::size_t count, const MatrixOptions& options, const Body& body) {
  const unsigned threads = static_cast<unsigned>(std::clamp<std::size_t>(count, 1, thread_count(options.threads)));
  std::vector<std::unique_ptr<DistanceSolver>> solvers(threads);
  std::atomic<std::size_t> done{0};
  parallel_for(
      count, threads,
      [&](unsigned worker, std::size_t i) {
        if (!solvers[worker]) solvers[worker] = std::make_unique<DistanceSolver>(domain);
        body(*solvers[worker], i);
        const std::size_t finished = ++done;
        if (worker == 0 && options.distance.progress) {
          options.distance.progress(static_cast<double>(finished) / static_cast<double>(count));
        }
      },
      current_cancel_token());
}

DistanceOptions without_progress(const MatrixOptions& options) {
  DistanceOptions run = options.distance;
  run.targets.clear();
  run.progress = nullptr;
  run.cancel = nullptr;  // a CancelScope listens
  return run;
}

// directed[a * n + b]: the least, or the greatest, distance of a vertex of a from parcel b; then the two are put
// together.
void from_parcels(const Domain& domain, const Parcels& parcels, bool greatest, const MatrixOptions& options,
                  ParcelMatrix& result) {
  const std::size_t n = parcels.count();
  const DistanceOptions run = without_progress(options);
  run_all(domain, n, options, [&](DistanceSolver& solver, std::size_t b) {
    std::vector<Source> sources;
    for (const Index v : parcels.members[b]) sources.push_back({vertex_point(domain.mesh(), v)});
    const DistanceField field = solver.distance(sources, run);
    for (std::size_t a = 0; a < n; ++a) {
      double value = greatest ? 0 : kInfinity;
      for (const Index v : parcels.members[a]) {
        const double d = field.distance[v];
        value = greatest ? std::max(value, d) : std::min(value, d);
      }
      result.distance[a * n + b] = value;
    }
  });
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      double& one = result.distance[a * n + b];
      double& other = result.distance[b * n + a];
      // Two runs of a method without a promise may differ.
      one = other = greatest ? std::max(one, other) : std::min(one, other);
    }
  }
}

// The vertex of each parcel that is nearest to all of it.
std::vector<Index> centroids(const Domain& domain, const Parcels& parcels, const MatrixOptions& options) {
  const std::vector<double> area = vertex_areas(domain);
  const DistanceOptions run = without_progress(options);
  std::vector<std::pair<Index, Index>> tasks;  // parcel, vertex: many small tasks keep all threads at work
  for (Index p = 0; p < parcels.count(); ++p) {
    for (const Index v : parcels.members[p]) tasks.emplace_back(p, v);
  }
  std::vector<double> sum(tasks.size());
  run_all(domain, tasks.size(), options, [&](DistanceSolver& solver, std::size_t t) {
    const auto& members = parcels.members[tasks[t].first];
    DistanceOptions own = run;
    for (const Index v : members) own.targets.push_back(vertex_point(domain.mesh(), v));
    const Source source{vertex_point(domain.mesh(), tasks[t].second)};
    const SparseField field = solver.distance_sparse(std::span(&source, 1), own);
    for (std::size_t i = 0; i < members.size(); ++i) sum[t] += area[members[i]] * field.target_distance[i];
  });
  std::vector<Index> best(parcels.count(), kNoIndex);
  std::vector<double> least(parcels.count(), kInfinity);
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    const auto [p, v] = tasks[t];
    if (best[p] != kNoIndex && !(sum[t] < least[p])) continue;
    best[p] = v;
    least[p] = sum[t];
  }
  return best;
}

void between_centroids(const Domain& domain, const Parcels& parcels, const MatrixOptions& options,
                       ParcelMatrix& result) {
  result.centroid = centroids(domain, parcels, options);
  std::vector<Place> places(result.centroid.begin(), result.centroid.end());
  distance_matrix<double>(domain, std::span<const Place>(places), std::span<const Place>(places),
                          std::span(result.distance), options);
  const std::size_t n = places.size();
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      result.distance[a * n + b] = result.distance[b * n + a] =
          0.5 * (result.distance[a * n + b] + result.distance[b * n + a]);
    }
  }
}

// Rows of all members, gathered by label: sums or greatest ones.
void over_pairs(const Domain& domain, const Parcels& parcels, bool mean, const MatrixOptions& options,
                ParcelMatrix& result) {
  const std::size_t n = parcels.count();
  std::vector<Place> places;
  std::vector<Index> parcel;
  for (Index p = 0; p < n; ++p) {
    for (const Index v : parcels.members[p]) {
      places.emplace_back(v);
      parcel.push_back(p);
    }
  }
  detail::Rows rows(domain, std::span<const Place>(places), std::nullopt, options);
  // One line of n numbers per vertex, so that what is added up does not depend on who came first.
  std::vector<double> line(places.size() * n);
  rows.run_dense<double>(detail::numbers_below(rows.count()), options.distance.progress,
                         [&](unsigned, std::size_t i, std::span<const double> values) {
                           double* of_row = line.data() + i * n;
                           for (Index v = 0; v < values.size(); ++v) {
                             const Index p = parcels.of_vertex[v];
                             if (p == kNoIndex) continue;
                             of_row[p] = mean ? of_row[p] + values[v] : std::max(of_row[p], values[v]);
                           }
                         });
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t b = 0; b < n; ++b) {
      double& to = result.distance[parcel[i] * n + b];
      to = mean ? to + line[i * n + b] : std::max(to, line[i * n + b]);
    }
  }
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      double& one = result.distance[a * n + b];
      double& other = result.distance[b * n + a];
      const double pairs =
          static_cast<double>(parcels.members[a].size()) * static_cast<double>(parcels.members[b].size());
      one = other = mean ? 0.5 * (one + other) / pairs : std::max(one, other);
    }
  }
}

}  // namespace

ParcelDistance parcel_distance_named(std::string_view name) {
  std::string known;
  for (const auto& [text, kind] : kNames) {
    if (text == name) return kind;
    known += (known.empty() ? "" : ", ") + std::string(text);
  }
  throw Error(ErrorCode::InvalidArgument,
              "unknown distance of parcels '" + std::string(name) + "': it is one of " + known);
}

ParcelMatrix parcel_distances(const Domain& domain, std::span<const std::int64_t> label, ParcelDistance kind,
                              std::int64_t least_label, const MatrixOptions& options) {
  if (label.size() != domain.mesh().vertex_count()) {
    throw Error(ErrorCode::InvalidArgument, std::to_string(label.size()) + " labels for " +
                                                std::to_string(domain.mesh().vertex_count()) + " vertices");
  }
  const Parcels parcels(domain, label, least_label);
  ParcelMatrix result;
  result.label = parcels.label;
  for (const auto& members : parcels.members) result.vertices.push_back(static_cast<Index>(members.size()));
  result.distance.assign(parcels.count() * parcels.count(), 0);
  if (parcels.count() == 0) return result;
  const CancelScope listen(options.distance.cancel);
  switch (kind) {
    case ParcelDistance::Min:
    case ParcelDistance::Hausdorff:
      from_parcels(domain, parcels, kind == ParcelDistance::Hausdorff, options, result);
      break;
    case ParcelDistance::Centroid:
      between_centroids(domain, parcels, options, result);
      break;
    case ParcelDistance::Mean:
    case ParcelDistance::Max:
      over_pairs(domain, parcels, kind == ParcelDistance::Mean, options, result);
      break;
  }
  return result;
}

}  // namespace brushfire
