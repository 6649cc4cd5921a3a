// Farthest-point sampling with radius-limited runs and a lazy queue.
#include <brushfire/queries/sampling.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>

#include <algorithm>
#include <queue>
#include <string>
#include <utility>

namespace brushfire {
namespace {

// The vertex farthest from the samples. Distances only fall, so an entry that is out of date is too high: it is put
// right when it comes up.
class FarthestQueue {
 public:
  FarthestQueue(const Domain& domain, std::span<const double> distance) : distance_(distance) {
    std::vector<Entry> entries;
    for (Index v = 0; v < domain.mesh().vertex_count(); ++v) {
      if (domain.is_open(v)) entries.push_back({kInfinity, v});
    }
    queue_ = Queue(Nearer(), std::move(entries));
  }

  bool empty() const { return queue_.empty(); }

  Index top() {
    while (queue_.top().distance != distance_[queue_.top().vertex]) {
      const Index v = queue_.top().vertex;
      queue_.pop();
      queue_.push({distance_[v], v});
    }
    return queue_.top().vertex;
  }

 private:
  struct Entry {
    double distance;
    Index vertex;
  };
  struct Nearer {
    bool operator()(const Entry& a, const Entry& b) const {
      return a.distance < b.distance || (a.distance == b.distance && a.vertex > b.vertex);
    }
  };
  using Queue = std::priority_queue<Entry, std::vector<Entry>, Nearer>;

  std::span<const double> distance_;
  Queue queue_;
};

}  // namespace

Samples farthest_points(const Domain& domain, Index count, std::span<const Index> first,
                        const DistanceOptions& options) {
  const Mesh& mesh = domain.mesh();
  if (first.size() > count) {
    throw Error(ErrorCode::InvalidArgument,
                std::to_string(first.size()) + " first samples, but only " + std::to_string(count) + " are wanted");
  }
  Samples samples;
  samples.distance.assign(mesh.vertex_count(), kInfinity);
  samples.nearest.assign(mesh.vertex_count(), kNoIndex);
  const CancelScope listen(options.cancel);
  DistanceSolver solver(domain);
  FarthestQueue farthest(domain, samples.distance);
  DistanceOptions run = options;
  run.targets.clear();
  while (samples.vertices.size() < count && !farthest.empty()) {
    const Index sample = static_cast<Index>(samples.vertices.size());
    const Index far_vertex = farthest.top();
    const Index v = sample < first.size() ? first[sample] : far_vertex;
    const Source source{vertex_point(mesh, v), 0};
    if (sample < first.size()) {
      if (std::find(samples.vertices.begin(), samples.vertices.end(), v) != samples.vertices.end()) {
        throw Error(ErrorCode::InvalidArgument, "vertex " + std::to_string(v) + " is among the first samples twice");
      }
    } else if (samples.distance[v] == 0) {
      break;
    }
    samples.vertices.push_back(v);
    samples.separation.push_back(samples.distance[v]);
    // Beyond the greatest distance that a vertex has so far nothing can change.
    run.max_distance = std::min(options.max_distance, samples.distance[far_vertex]);
    const SparseField field = solver.distance_sparse(std::span(&source, 1), run);
    for (std::size_t i = 0; i < field.vertex.size(); ++i) {
      const Index w = field.vertex[i];
      if (field.distance[i] < samples.distance[w]) {
        samples.distance[w] = field.distance[i];
        samples.nearest[w] = sample;
      }
    }
  }
  if (!farthest.empty()) samples.covering_radius = samples.distance[farthest.top()];
  return samples;
}

}  // namespace brushfire
