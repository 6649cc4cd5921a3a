// From a problem to a march and back: starts, stops, targets, labels.
#include <brushfire/solvers/carried_source/detail/engine.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/solvers/carried_source/detail/march.h>
#include <brushfire/solvers/carried_source/detail/points.h>
#include <brushfire/solvers/carried_source/detail/records.h>
#include <brushfire/solvers/detail/float_range.h>
#include <brushfire/solvers/detail/local_mesh.h>
#include <brushfire/solvers/detail/sheets.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <utility>

namespace brushfire::carried_source {
namespace {

using detail::LocalMesh;
using detail::LocatedSource;
using detail::Problem;

// In one precision.
template <class T>
class Marcher {
 public:
  explicit Marcher(const LocalMesh& local)
      : local_(local), mesh_(local.mesh()), records_(build_records<T>(mesh_)), march_(records_), points_(mesh_) {}

  void solve(const Problem& problem, DistanceField& field) {
    sources_.clear();
    for (const LocatedSource& s : problem.sources) sources_.push_back({local_.location(s.at), s.offset, s.label});
    targets_.clear();
    for (const PointLocation& at : problem.targets) targets_.push_back(local_.location(at));
    start(problem.max_distance);
    march(problem);
    for (std::size_t i = 0; i < targets_.size(); ++i) evaluate(i, field);
    write(problem, field);
  }

 private:
  void start(double max_distance) {
    march_.reset();
    final_ = kInfinity;
    base_ = kInfinity;
    for (const LocatedSource& s : sources_) base_ = std::min(base_, s.offset);
    march_.label_fronts(sources_.front().label != sources_.back().label);  // labels ascend
    for (const LocatedSource& s : sources_) {
      const double offset = s.offset - base_;
      for (const Points::Near& n : points_.around(s.at, crossings(s.at), max_distance - s.offset)) {
        const auto value = static_cast<T>(offset + n.distance);
        march_.begin_at({n.vertex, value, n.seen ? static_cast<T>(offset) : value, static_cast<T>(n.to_source.x),
                         static_cast<T>(n.to_source.y), n.sector, s.label});
      }
    }
  }

  // Of the edges that what begins at a source sees through. A source on a wall is one on each side of it: where the
  // wall ends beside it, its light comes to the tip from both sides at once, and one of them is not carried on.
  int crossings(const PointLocation& at) const {
    if (at.on != PointLocation::On::Vertex) return records_.most_unrolled;
    const auto is_boundary = [&](Index h) { return mesh_.opposite(h) == h; };
    const auto corners = mesh_.corners(at.vertex);
    const bool on_wall = sources_.size() > 1 && std::any_of(corners.begin(), corners.end(), [&](Index h) {
                           return is_boundary(h) || is_boundary(Mesh::previous(h));
                         });
    return on_wall ? 1 : 0;
  }

  void march(const Problem& problem) {
    const double last = last_front(problem);
    std::size_t first_open_target = 0;
    while (march_.advance()) {
      const double front = base_ + static_cast<double>(march_.settled());
      while (first_open_target < targets_.size() && is_final(targets_[first_open_target], front)) ++first_open_target;
      const bool all_final = !targets_.empty() && first_open_target == targets_.size();
      if (front > last || all_final) {
        final_ = front;
        break;
      }
      march_.work();
      check_cancel(problem);
    }
  }

  void check_cancel(const Problem& problem) const {
    if (problem.cancel && problem.cancel->cancelled()) throw Error(ErrorCode::Cancelled, "cancelled");
    if (problem.options->progress) {
      problem.options->progress(static_cast<double>(march_.touched().size()) /
                                static_cast<double>(mesh_.vertex_count()));
    }
  }

  double value(Index v) const { return static_cast<double>(march_.value(v)); }

  // A target is read from the corners of its faces, so these have to be final.
  bool is_final(const PointLocation& at, double front) {
    if (at.on == PointLocation::On::Vertex) return base_ + value(at.vertex) < front;
    const auto corners = points_.corners(at);
    return std::all_of(corners.begin(), corners.end(),
                       [&](const detail::Seed& c) { return base_ + value(c.vertex) < front; });
  }

  // How far the front has to go for what is asked within max_distance: to the corners around the targets, too.
  double last_front(const Problem& problem) {
    double around = 0;
    for (const PointLocation& at : targets_) {
      if (at.on == PointLocation::On::Vertex) continue;
      for (const detail::Seed& c : points_.corners(at)) around = std::max(around, c.distance);
    }
    return problem.max_distance + around;
  }

  // A target inside a face is one more vertex: over the edges of its face; on an edge, over the others of the faces
  // there. From a source in the same face or the next it is reached straight.
  void evaluate(std::size_t i, DistanceField& field) {
    const PointLocation& at = targets_[i];
    double best = kInfinity;
    Index source = kNoIndex;
    const auto offer = [&](double d, Index l) {
      if (d < kInfinity && std::pair(d, l) < std::pair(best, source)) best = d, source = l;
    };
    if (at.on == PointLocation::On::Vertex) {
      offer(base_ + value(at.vertex), march_.label(at.vertex));
    } else {
      for (const detail::Seed& c : points_.corners(at)) {
        offer(base_ + value(c.vertex) + c.distance, march_.label(c.vertex));
      }
      if (mesh_.is_face_usable(at.face)) {
        detail::for_edges_around(mesh_, at, [&](Index h, Vec2 p) { through_edge(h, p, offer); });
      }
      for (const LocatedSource& s : sources_) offer(s.offset + detail::straight_distance(mesh_, s.at, at), s.label);
    }
    field.target_distance[i] = best;
    field.target_source[i] = source;
  }

  // `at`: the target in the frame of halfedge h.
  template <class Offer>
  void through_edge(Index h, Vec2 at, const Offer& offer) {
    const Index v = mesh_.from(h), w = mesh_.to(h), here = march_.label(v), there = march_.label(w);
    if (here == kNoIndex || there == kNoIndex) return;
    if (here == there) {
      offer(base_ + points_.through_edge(h, at, known(v), known(w)), here);
    } else {
      const std::array<double, 2> values = points_.from_either_end(h, at, known(v), known(w));
      offer(base_ + values[0], here), offer(base_ + values[1], there);
    }
  }

  Points::Known known(Index v) const {
    const auto c = march_.carried(v);
    return {value(v), static_cast<double>(c.sigma), {static_cast<double>(c.x), static_cast<double>(c.y)}, c.sector};
  }

  void write(const Problem& problem, DistanceField& field) {
    field.updates = march_.turns();
    field.beyond_radius = 0;
    const auto write_one = [&](Index place) {
      const double d = base_ + value(place);
      if (!(d < final_)) {
        field.beyond_radius += d < kInfinity;
        return;
      }
      const Index v = local_.vertex(place);
      field.distance[v] = d;
      field.source[v] = march_.label(place);
      if (problem.touched) problem.touched->push_back(v);
    };
    if (march_.touched().size() > mesh_.vertex_count() / 2) {  // in order
      for (Index place = 0; place < mesh_.vertex_count(); ++place) write_one(place);
    } else {
      for (const Index place : march_.touched()) write_one(place);
    }
  }

  const LocalMesh& local_;
  const Mesh& mesh_;
  Records<T> records_;
  March<T> march_;
  Points points_;
  std::vector<LocatedSource> sources_;  // of the run, in local numbers
  std::vector<PointLocation> targets_;
  double base_ = 0;           // the lowest offset: values are kept relative to it
  double final_ = kInfinity;  // where the front stopped
};

class CarriedSource final : public detail::Engine {
 public:
  explicit CarriedSource(Mesh mesh) : mesh_(std::move(mesh)), float_is_enough_(detail::fits_float(mesh_)) {}

  bool lists_touched() const override { return true; }

  void set_up(const DistanceOptions& options) override {
    if (!local_) local_.emplace(mesh_);
    if (is_float(options)) {
      if (!in_float_) in_float_.emplace(*local_);
    } else {
      if (!in_double_) in_double_.emplace(*local_);
    }
  }

  void solve(const Problem& problem, DistanceField& field) override {
    set_up(*problem.options);
    if (is_float(*problem.options)) {
      in_float_->solve(problem, field);
    } else {
      in_double_->solve(problem, field);
    }
  }

 private:
  bool is_float(const DistanceOptions& options) const {
    return options.precision == Precision::Float && float_is_enough_;
  }

  Mesh mesh_;
  bool float_is_enough_;
  std::optional<LocalMesh> local_;
  std::optional<Marcher<float>> in_float_;
  std::optional<Marcher<double>> in_double_;
};

}  // namespace

std::unique_ptr<detail::Engine> make_engine(const Mesh& mesh) {
  std::shared_ptr<const detail::Sheets> sheets = detail::Sheets::where_likely(mesh);
  const auto make = [](const Mesh& m) -> std::unique_ptr<detail::Engine> { return std::make_unique<CarriedSource>(m); };
  return sheets ? detail::make_on_one_sheet(std::move(sheets), make) : make(mesh);
}

}  // namespace brushfire::carried_source
