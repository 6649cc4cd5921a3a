// Dijkstra's algorithm on the edge graph.
#include <brushfire/solvers/detail/dijkstra.h>

#include <brushfire/core/error.h>
#include <brushfire/solvers/detail/start.h>

#include <algorithm>
#include <functional>
#include <unordered_set>
#include <utility>
#include <vector>

namespace brushfire::detail {
namespace {

class Dijkstra final : public Engine {
 public:
  explicit Dijkstra(Mesh mesh) : mesh_(std::move(mesh)) {}

  bool lists_touched() const override { return true; }

  void solve(const Problem& problem, DistanceField& field) override {
    heap_.clear();
    touched_ = problem.touched;
    for (const LocatedSource& s : problem.sources) start(s, field);
    wait_for(problem.targets);
    march(problem, field);
    for (std::size_t i = 0; i < problem.targets.size(); ++i) evaluate(problem, i, field);
  }

 private:
  struct Entry {
    double value;
    Index label, vertex;  // the source's; equal values go to the lowest
    bool operator>(const Entry& other) const {
      return value > other.value || (value == other.value && label > other.label);
    }
  };

  void offer(Index v, double value, Index label, DistanceField& field) {
    const double before = field.distance[v];
    if (value < before || (value == before && label < field.source[v])) {
      if (touched_ && field.source[v] == kNoIndex) touched_->push_back(v);
      field.distance[v] = value;
      field.source[v] = label;
      heap_.push_back({value, label, v});
      std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    }
  }

  // The corners of every face that holds the source; on an edge that is all faces of the edge.
  void start(const LocatedSource& s, DistanceField& field) {
    for (const Seed& seed : seeds_.in_own_faces(mesh_, s.at)) {
      offer(seed.vertex, s.offset + seed.distance, s.label, field);
    }
  }

  // The vertices that all targets are read off.
  void wait_for(std::span<const PointLocation> targets) {
    awaited_.clear();
    for (const PointLocation& at : targets) {
      for (const Seed& seed : seeds_.in_own_faces(mesh_, at)) awaited_.insert(seed.vertex);
    }
  }

  void march(const Problem& problem, DistanceField& field) {
    constexpr std::uint64_t kPollInterval = 4096;
    const std::span<const double> lengths = mesh_.lengths();
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
      const auto [value, label, v] = heap_.back();
      heap_.pop_back();
      if (value != field.distance[v] || label != field.source[v]) continue;
      if (value > problem.max_distance) break;
      if (!awaited_.empty() && awaited_.erase(v) != 0 && awaited_.empty()) {
        drop_front(field);
        break;
      }
      if (++field.updates % kPollInterval == 0 && problem.cancel && problem.cancel->cancelled()) {
        throw Error(ErrorCode::Cancelled, "cancelled");
      }
      for (const Index h : mesh_.corners(v)) {
        offer(mesh_.to(h), value + lengths[h], label, field);
        const Index back = Mesh::previous(h);
        offer(mesh_.from(back), value + lengths[back], label, field);
      }
    }
  }

  // What was still to become less reads +inf.
  void drop_front(DistanceField& field) const {
    for (const auto& [value, label, v] : heap_) {
      if (value != field.distance[v] || label != field.source[v]) continue;
      field.distance[v] = kInfinity;
      field.source[v] = kNoIndex;
    }
  }

  // Along the edges to a corner of a face that holds the target, then straight; or straight from a source in that face.
  void evaluate(const Problem& problem, std::size_t i, DistanceField& field) {
    const PointLocation& at = problem.targets[i];
    const auto offer_target = [&](double value, Index label) {
      if (std::pair(value, label) < std::pair(field.target_distance[i], field.target_source[i])) {
        field.target_distance[i] = value;
        field.target_source[i] = label;
      }
    };
    for (const Seed& seed : seeds_.in_own_faces(mesh_, at)) {
      offer_target(field.distance[seed.vertex] + seed.distance, field.source[seed.vertex]);
    }
    for (const LocatedSource& s : problem.sources) {
      const double d = straight_distance(mesh_, s.at, at);
      if (d < kInfinity) offer_target(s.offset + d, s.label);
    }
  }

  Mesh mesh_;
  std::vector<Index>* touched_ = nullptr;
  SeedSearch seeds_;
  std::unordered_set<Index> awaited_;  // not final yet
  std::vector<Entry> heap_;            // its memory stays from run to run
};

}  // namespace

std::unique_ptr<Engine> make_dijkstra(const Mesh& mesh) { return std::make_unique<Dijkstra>(mesh); }

}  // namespace brushfire::detail
