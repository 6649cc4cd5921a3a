// Dijkstra's algorithm on the edge graph.
#include <brushfire/core/detail/sort.h>
#include <brushfire/solvers/detail/dijkstra.h>

#include <brushfire/core/error.h>
#include <brushfire/solvers/detail/start.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
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
    wait_for(problem.targets);
    goal_ = problem.sources.size() == 1 && awaited_.size() == 1 && mesh_.has_positions() ? awaited_.front() : kNoIndex;
    for (const LocatedSource& s : problem.sources) start(s, field);
    march(problem, field);
    if (!awaited_.empty()) drop_front(field);
    for (std::size_t i = 0; i < problem.targets.size(); ++i) evaluate(problem, i, field);
  }

 private:
  struct Entry {
    double key, value;    // the least that a way through the vertex to the goal can be
    Index label, vertex;  // the source's; equal values go to the lowest
    bool operator>(const Entry& other) const { return key > other.key || (key == other.key && label > other.label); }
  };

  // From one source to one vertex the front spreads that way first (A*: Hart, Nilsson, Raphael 1968): no way along
  // edges is shorter than the straight line. Without a goal the key is the value.
  double key(Index v, double value) const {
    if (goal_ == kNoIndex) return value;
    return value + norm((1 / mesh_.unit()) * (mesh_.positions()[goal_] - mesh_.positions()[v]));
  }

  void offer(Index v, double value, Index label, DistanceField& field) {
    const double before = field.distance[v];
    if (value < before || (value == before && label < field.source[v])) {
      if (touched_ && field.source[v] == kNoIndex) touched_->push_back(v);
      field.distance[v] = value;
      field.source[v] = label;
      heap_.push_back({key(v, value), value, label, v});
      std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    }
  }

  // The corners of every face that holds the source; on an edge that is all faces of the edge.
  void start(const LocatedSource& s, DistanceField& field) {
    for (const Seed& seed : seeds_.in_own_faces(mesh_, s.at)) {
      offer(seed.vertex, s.offset + seed.distance, s.label, field);
    }
  }

  // For the vertices that all targets are read off.
  void wait_for(std::span<const PointLocation> targets) {
    awaited_.clear();
    for (const PointLocation& at : targets) {
      for (const Seed& seed : seeds_.in_own_faces(mesh_, at)) awaited_.push_back(seed.vertex);
    }
    detail::sort(awaited_.begin(), awaited_.end());
    awaited_.erase(std::unique(awaited_.begin(), awaited_.end()), awaited_.end());
    to_come_ = awaited_.size();
  }
  // Whether the last one of them is final now that v is.
  bool was_last(Index v) {
    if (to_come_ == 0 || !std::binary_search(awaited_.begin(), awaited_.end(), v)) return false;
    --to_come_;
    return to_come_ == 0;
  }

  // By more than what keys are rounded by.
  bool is_beyond_goal(double key, const DistanceField& field) const {
    const double value = field.distance[goal_];
    return key > value + 8 * std::numeric_limits<double>::epsilon() * std::abs(value);
  }

  void march(const Problem& problem, DistanceField& field) {
    constexpr std::uint64_t kPollInterval = 4096;
    const std::span<const double> lengths = mesh_.lengths();
    const std::span<const Face> faces = mesh_.faces();
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
      const auto [key, value, label, v] = heap_.back();
      heap_.pop_back();
      if (value != field.distance[v] || label != field.source[v]) continue;
      if (goal_ == kNoIndex ? value > problem.max_distance || was_last(v) : is_beyond_goal(key, field)) break;
      if (value > problem.max_distance) continue;
      if (++field.updates % kPollInterval == 0 && problem.cancel && problem.cancel->cancelled()) {
        throw Error(ErrorCode::Cancelled, "cancelled");
      }
      for (const Index h : mesh_.corners(v)) {
        const Index f = Mesh::face_of(h), first = 3 * f, k = h - first;
        const Index ahead = k == 2 ? 0 : k + 1, behind = k == 0 ? 2 : k - 1;
        offer(faces[f][ahead], value + lengths[h], label, field);
        offer(faces[f][behind], value + lengths[first + behind], label, field);
      }
    }
  }

  // What a front that was stopped had still to make less reads +inf.
  void drop_front(DistanceField& field) const {
    for (const auto& [key, value, label, v] : heap_) {
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
  std::vector<Index> awaited_;  // ascending
  std::size_t to_come_ = 0;     // of them
  Index goal_ = kNoIndex;       // where it is one
  std::vector<Entry> heap_;     // its memory stays from run to run
};

}  // namespace

std::unique_ptr<Engine> make_dijkstra(const Mesh& mesh) { return std::make_unique<Dijkstra>(mesh); }

}  // namespace brushfire::detail
