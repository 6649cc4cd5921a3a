// Dijkstra's algorithm on the edge graph.
#include <brushfire/solvers/detail/dijkstra.h>

#include <brushfire/core/error.h>
#include <brushfire/solvers/detail/start.h>

#include <algorithm>
#include <functional>
#include <tuple>
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
    march(problem, field);
    for (std::size_t i = 0; i < problem.targets.size(); ++i) evaluate(problem, i, field);
  }

 private:
  using Entry = std::tuple<double, Index, Index>;  // value, source, vertex: equal values go to the lowest source

  void offer(Index v, double value, Index label, DistanceField& field) {
    if (std::tie(value, label) < std::tie(field.distance[v], field.source[v])) {
      if (touched_ && field.source[v] == kNoIndex) touched_->push_back(v);
      field.distance[v] = value;
      field.source[v] = label;
      heap_.emplace_back(value, label, v);
      std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    }
  }

  // The corners of every face that holds the source; on an edge that is all faces of the edge.
  void start(const LocatedSource& s, DistanceField& field) {
    for (const Seed& seed : seeds_.in_own_faces(mesh_, s.at)) {
      offer(seed.vertex, s.offset + seed.distance, s.label, field);
    }
  }

  void march(const Problem& problem, DistanceField& field) {
    constexpr std::uint64_t kPollInterval = 4096;
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
      const auto [value, label, v] = heap_.back();
      heap_.pop_back();
      if (value != field.distance[v] || label != field.source[v]) continue;
      if (value > problem.max_distance) break;
      if (++field.updates % kPollInterval == 0 && problem.cancel && problem.cancel->cancelled()) {
        throw Error(ErrorCode::Cancelled, "cancelled");
      }
      for (const Index h : mesh_.corners(v)) {
        offer(mesh_.to(h), value + mesh_.lengths()[h], label, field);
        const Index back = Mesh::previous(h);
        offer(mesh_.from(back), value + mesh_.lengths()[back], label, field);
      }
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
  std::vector<Entry> heap_;  // its memory stays from run to run
};

}  // namespace

std::unique_ptr<Engine> make_dijkstra(const Mesh& mesh) { return std::make_unique<Dijkstra>(mesh); }

}  // namespace brushfire::detail
