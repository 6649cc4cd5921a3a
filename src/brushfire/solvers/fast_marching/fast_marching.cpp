// From a problem to a march and back: starts, stops, targets, labels.
#include <brushfire/solvers/fast_marching/detail/fast_marching.h>

#include <brushfire/core/detail/planar.h>
#include <brushfire/core/detail/prefetch.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/solvers/detail/float_range.h>
#include <brushfire/solvers/detail/local_mesh.h>
#include <brushfire/solvers/detail/sheets.h>
#include <brushfire/solvers/detail/start.h>
#include <brushfire/solvers/fast_marching/detail/cost_seeds.h>
#include <brushfire/solvers/fast_marching/detail/fronts.h>
#include <brushfire/solvers/fast_marching/detail/march.h>
#include <brushfire/solvers/fast_marching/detail/ring_blocks.h>
#include <brushfire/solvers/partition/worker_team.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace brushfire::fast_marching {
namespace {

using detail::LocalMesh;

FrontModel front_model(Method method) {
  if (method == Method::KimmelSethian) return FrontModel::Planar;
  return method == Method::NovotniKlein2002 ? FrontModel::LiteralCircular : FrontModel::Circular;
}

// The value at a target in the frame of an edge (fronts_kernel.h) with values t1 and t2 at its ends; through its first
// end where the front does not reach it otherwise.
template <class Front>
double update(double length, Vec2 at, double t1, double t2) {
  const auto front = portable::FrontOverEdge<Front, double>::of(length, 1 / length, t1, t2);
  bool through = false;
  const double value = front.update(at.x, at.y, norm(at), true, through);
  return through ? value : t1 + norm(at);
}

double update(FrontModel model, double length, Vec2 at, double t1, double t2) {
  if (model == FrontModel::Planar) return update<PlanarFront>(length, at, t1, t2);
  if (model == FrontModel::LiteralCircular) return update<LiteralCircularFront>(length, at, t1, t2);
  return update<CircularFront>(length, at, t1, t2);
}

// Rounds are as short as it would take to wait for another thread, and a part is soon in another cache.
constexpr std::chrono::microseconds kStealAfter{0};

// The methods in one precision.
template <class T>
class Marcher {
 public:
  // `weights`: of the faces, in the local order; empty: 1 everywhere. They stay.
  Marcher(const LocalMesh& local, Index part_size, std::span<const double> weights = {})
      : local_(local),
        mesh_(local.mesh()),
        costs_(mesh_, weights),
        rings_(build_rings<T>(mesh_, part_size, Variant::Best, costs_)),
        state_(rings_.layout.parts) {
    // Half a mean edge measured best; the front is that wide, and order inside it does not matter.
    state_.buckets_per_unit = static_cast<T>(2 / rings_.layout.mean_edge);
  }

  void solve(const detail::Problem& in_callers_numbers, DistanceField& field) {
    sources_.clear();
    for (const detail::LocatedSource& s : in_callers_numbers.sources) {
      sources_.push_back({local_.location(s.at), s.offset, s.label});
    }
    targets_.clear();
    for (const PointLocation& at : in_callers_numbers.targets) targets_.push_back(local_.location(at));
    detail::Problem problem = in_callers_numbers;
    problem.sources = sources_;
    problem.targets = targets_;
    start(problem);
    if (front_model(problem.options->method) == FrontModel::LiteralCircular) {
      check_cancel(problem);
      march_label_setting<T>(rings_, state_, [&] { check_cancel(problem); });
    } else {
      march(problem);
    }
    for (std::size_t i = 0; i < problem.targets.size(); ++i) evaluate(problem, i, field);
    write(problem, field);
  }

 private:
  void start(const detail::Problem& problem) {
    workers_.assemble(problem.options->threads, rings_.layout.parts.count());
    for_each_part(state_.used, is_much(state_.touched()), [&](Index part) { state_.reset_part(part); });
    state_.reset();
    final_ = kInfinity;
    base_ = kInfinity;
    for (const detail::LocatedSource& s : problem.sources) base_ = std::min(base_, s.offset);
    // One source needs no labels; neither does a method that keeps them anyway.
    // (Those of a curve have one label, and labels ascend.)
    const bool several = problem.sources.front().label != problem.sources.back().label;
    state_.labelled = several || front_model(problem.options->method) == FrontModel::LiteralCircular;
    if (state_.labelled && state_.label.empty()) state_.label.assign(state_.front_at.size(), kNoIndex);
    state_.start.clear();
    if (state_.labelled) state_.start.resize(problem.sources.back().label + 1);
    // The other two are given what their papers give them: the corners around the source.
    const int crossings = problem.options->method == Method::NovotniKlein ? rings_.layout.longest_unfolding : 0;
    for (const detail::LocatedSource& s : problem.sources) {
      const double offset = s.offset - base_;
      if (state_.labelled) state_.start[s.label] = static_cast<T>(offset);
      for (const detail::Seed& seed : first_seeds(s.at, crossings, problem.max_distance - s.offset)) {
        state_.seed(seed.vertex, static_cast<T>(offset + seed.distance), s.label);
      }
    }
  }

  // With costs those of the faces that the source is in: fronts beyond them are bent.
  std::span<const detail::Seed> first_seeds(const PointLocation& at, int crossings, double limit) const {
    return costs_.any() ? seeds_around(at) : seeds_.in_sight(mesh_, at, crossings, limit);
  }

  std::span<const detail::Seed> seeds_around(const PointLocation& at) const {
    return costs_.any() ? cost_seeds_.around(mesh_, costs_, at) : seeds_.in_own_faces(mesh_, at);
  }

  void march(const detail::Problem& problem) {
    const double last = last_front(problem);
    std::size_t first_open_target = 0;
    march_part_ = march_part<T>(front_model(problem.options->method), state_.labelled);
    state_.begin_run();
    while (state_.next_round()) {
      const double front = base_ + static_cast<double>(state_.front());
      while (first_open_target < problem.targets.size() && is_final(problem.targets[first_open_target], front)) {
        ++first_open_target;
      }
      const bool all_final = !problem.targets.empty() && first_open_target == problem.targets.size();
      if (front > last || all_final) {
        final_ = front;
        break;
      }
      work(problem.cancel);
      check_cancel(problem);
    }
  }

  // One round.
  void work(const CancelToken* cancel) {
    constexpr std::size_t kWorthSharing = 64;
    if (!workers_.team() || state_.load < kWorthSharing) {
      for (const partition::Due& d : state_.due) march_part_(rings_, state_, d.part);
      return;
    }
    workers_.work(state_.due, [this, cancel](unsigned, Index part) {
      if (!(cancel && cancel->cancelled())) march_part_(rings_, state_, part);
    });
  }

  // Shares the parts out to the team. Where there is little to do, telling others of it would take longer.
  template <class Act>
  void for_each_part(const std::vector<Index>& parts, bool is_much, const Act& act) {
    std::atomic<std::size_t> next{0};
    const auto take = [&](unsigned, std::size_t) {
      for (std::size_t i = next++; i < parts.size(); i = next++) act(parts[i]);
    };
    if (workers_.team() && is_much) {
      workers_.team()->run(std::min<std::size_t>(workers_.size(), parts.size()), std::ref(take));
    } else {
      take(0, 0);
    }
  }

  void check_cancel(const detail::Problem& problem) const {
    if (problem.cancel && problem.cancel->cancelled()) throw Error(ErrorCode::Cancelled, "cancelled");
    if (problem.options->progress) {
      problem.options->progress(static_cast<double>(state_.touched()) / static_cast<double>(state_.front_at.size()));
    }
  }

  double value(Index v) const { return static_cast<double>(state_.front_at[v].value); }
  Index label(Index v) const { return state_.labelled ? state_.label[v] : value(v) < kInfinity ? 0 : kNoIndex; }

  // A target is read from the corners of its faces, so these have to be final.
  bool is_final(const PointLocation& at, double front) const {
    if (at.on == PointLocation::On::Vertex) return base_ + value(at.vertex) < front;
    for (const detail::Seed& seed : seeds_around(at)) {
      if (!(base_ + value(seed.vertex) < front)) return false;
    }
    return true;
  }

  // How far the front has to go for what is asked within max_distance: to the corners around the targets, too.
  double last_front(const detail::Problem& problem) const {
    double around = 0;
    for (const PointLocation& at : problem.targets) {
      if (at.on == PointLocation::On::Vertex) continue;
      for (const detail::Seed& seed : seeds_around(at)) around = std::max(around, seed.distance);
    }
    return problem.max_distance + around;
  }

  // A target inside a face is one more corner: of the three triangles that it forms with the face's edges; on an edge,
  // of those in all faces of the edge. From a source in the same face or the next it is reached straight.
  void evaluate(const detail::Problem& problem, std::size_t i, DistanceField& field) const {
    const PointLocation& at = problem.targets[i];
    double best = kInfinity;
    Index source = kNoIndex;
    const auto consider = [&](double d, Index l) {
      if (d < kInfinity && std::pair(d, l) < std::pair(best, source)) best = d, source = l;
    };
    if (at.on == PointLocation::On::Vertex) {
      consider(base_ + value(at.vertex), label(at.vertex));
    } else {
      for (const detail::Seed& seed : seeds_around(at)) {
        consider(base_ + value(seed.vertex) + seed.distance, label(seed.vertex));
      }
      if (mesh_.is_face_usable(at.face)) {
        detail::for_edges_around(mesh_, at, [&](Index h, Vec2 p) { through_edge(problem, h, p, consider); });
      }
      for (const detail::LocatedSource& s : problem.sources) {
        const double d =
            costs_.any() ? straight_cost(mesh_, costs_, s.at, at) : detail::straight_distance(mesh_, s.at, at);
        consider(s.offset + d, s.label);
      }
    }
    field.target_distance[i] = best;
    field.target_source[i] = source;
  }

  // `at`: the target in the frame of halfedge h.
  template <class Consider>
  void through_edge(const detail::Problem& problem, Index h, Vec2 at, const Consider& consider) const {
    const Index v1 = mesh_.from(h), v2 = mesh_.to(h);
    const Index l = label(v1);
    if (l == kNoIndex || l != label(v2)) return;
    const double started = state_.labelled ? static_cast<double>(state_.start[l]) : 0.0;
    const FrontModel model = front_model(problem.options->method);
    const double w = costs_.of(Mesh::face_of(h));
    const double d = update(model, w * mesh_.length(h), w * at, value(v1) - started, value(v2) - started);
    consider(base_ + started + d, l);
  }

  void write(const detail::Problem& problem, DistanceField& field) {
    field.updates = state_.pops();
    std::atomic<Index> beyond{0};
    const auto write_part = [&](Index part) { beyond += write(problem, part, field); };
    for_each_part(state_.used, !problem.touched && is_much(state_.touched()), write_part);
    field.beyond_radius = beyond;
  }
  static bool is_much(std::size_t vertices) { return vertices > 20000; }

  // Returns how many vertices of a part have values that are not final.
  Index write(const detail::Problem& problem, Index part, DistanceField& field) const {
    Index beyond = 0;
    if (state_.touched_most(part) && !problem.touched) {
      constexpr Index kAhead = 32;  // places in the caller's order are far from each other
      const Index end = state_.end(part);
      for (Index place = state_.begin(part); place < end; ++place) {
        if (place + kAhead < end) prefetch_entries(local_.vertex(place + kAhead), field);
        beyond += !write_vertex(problem, place, field);
      }
    } else {
      for (const Index place : state_.parts[part].touched) {
        if (!rings_.layout.parts.is_ghost(place)) beyond += !write_vertex(problem, place, field);
      }
    }
    return beyond;
  }

  static void prefetch_entries(Index v, const DistanceField& field) {
    prefetch(&field.distance[v]);
    prefetch(&field.source[v]);
  }

  // False where the value is there, but not final.
  bool write_vertex(const detail::Problem& problem, Index place, DistanceField& field) const {
    const double d = base_ + static_cast<double>(state_.front_at[place].value);
    if (d >= final_) return !(d < kInfinity);
    const Index v = local_.vertex(place);
    field.distance[v] = d;
    field.source[v] = state_.labelled ? state_.label[place] : problem.sources.front().label;
    if (problem.touched) problem.touched->push_back(v);
    return true;
  }

  const LocalMesh& local_;
  const Mesh& mesh_;
  FaceCosts costs_;
  Rings<T> rings_;
  std::vector<detail::LocatedSource> sources_;  // of the run, in local numbers
  std::vector<PointLocation> targets_;
  mutable detail::SeedSearch seeds_;
  mutable CostSeeds cost_seeds_;
  MarchState<T> state_;
  MarchPart<T> march_part_ = nullptr;  // of this run
  partition::WorkerTeam workers_{kStealAfter};
  double base_ = 0;           // the lowest offset: values are kept relative to it
  double final_ = kInfinity;  // where the front stopped
};

class FastMarching final : public detail::Engine {
 public:
  FastMarching(Mesh mesh, Index part_size, std::vector<double> weights = {})
      : mesh_(std::move(mesh)),
        part_size_(part_size),
        weights_(std::move(weights)),
        float_is_enough_(detail::fits_float(mesh_) && fit_float(weights_)) {}

  bool lists_touched() const override { return true; }

  void set_up(const DistanceOptions& options) override {
    const LocalMesh& mesh = local();  // first: it orders the weights
    if (options.method == Method::NovotniKlein2002) {
      if (!literal_) literal_.emplace(mesh, kNoIndex, weights_);
    } else if (options.precision == Precision::Float && float_is_enough_) {
      if (!in_float_) in_float_.emplace(mesh, part_size_, weights_);
    } else {
      if (!in_double_) in_double_.emplace(mesh, part_size_, weights_);
    }
  }

  void solve(const detail::Problem& problem, DistanceField& field) override {
    set_up(*problem.options);
    if (problem.options->method == Method::NovotniKlein2002) {
      literal_->solve(problem, field);
    } else if (problem.options->precision == Precision::Float && float_is_enough_) {
      in_float_->solve(problem, field);
    } else {
      in_double_->solve(problem, field);
    }
  }

 private:
  const LocalMesh& local() {
    if (!local_) {
      local_.emplace(mesh_);
      weights_ = local_->of_faces(weights_);
    }
    return *local_;
  }

  // Squares of lengths times weights stay far from where floats end.
  static bool fit_float(const std::vector<double>& weights) {
    return std::all_of(weights.begin(), weights.end(), [](double w) { return 0x1p-20 <= w && w <= 0x1p20; });
  }

  Mesh mesh_;
  Index part_size_;
  std::vector<double> weights_;  // of the faces; in the local order once there is one
  bool float_is_enough_;
  std::optional<LocalMesh> local_;
  std::optional<Marcher<float>> in_float_;
  std::optional<Marcher<double>> in_double_, literal_;  // literal: label-setting, all of the mesh in one queue
};

}  // namespace

// Of smaller parts there is more to tell others about, larger ones leave threads without work; a small mesh is done
// sooner than it takes to share it out. Measured: docs/decisions/speed.md.
Index usual_part_size(const Mesh& mesh) {
  constexpr Index kWorthParts = Index{1} << 17, kVertices = Index{1} << 16;
  return mesh.vertex_count() < kWorthParts ? kNoIndex : kVertices;
}

// (A few copies elsewhere do no harm: fronts pass edges of many faces one face at a time.)
std::unique_ptr<detail::Engine> make_engine(const Mesh& mesh) {
  std::shared_ptr<const detail::Sheets> sheets = detail::Sheets::where_likely(mesh);
  const auto make = [](const Mesh& m) { return make_engine(m, usual_part_size(m)); };
  return sheets ? detail::make_on_one_sheet(std::move(sheets), make) : make(mesh);
}

std::unique_ptr<detail::Engine> make_weighted_engine(const Mesh& mesh, std::span<const double> weights) {
  return std::make_unique<FastMarching>(mesh, usual_part_size(mesh),
                                        std::vector<double>(weights.begin(), weights.end()));
}

std::unique_ptr<detail::Engine> make_engine(const Mesh& mesh, Index part_size) {
  return std::make_unique<FastMarching>(mesh, part_size);
}

}  // namespace brushfire::fast_marching
