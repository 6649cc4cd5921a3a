// Which numbers a run needs: doubles, or wider ones where lengths differ too much for them.
#include <brushfire/solvers/windows/engine.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/detail/sheets.h>

#include <algorithm>
#include <span>
#include <utility>

namespace brushfire::windows {
namespace {

// Doubles serve exact runs as long as they are sure to tell the distance between any two neighbours to this share of
// it. Scans and most machine parts have 1e-14 to 1e-10 (docs/decisions/wide-numbers.md). Wider numbers take some 30
// times as long: where that means more than seconds, fewer digits have to do. What is sure is always said in
// error_bound.
constexpr double kDoubtAllowed = 1e-9, kDoubtAllowedInLarge = 1e-3;
constexpr Index kLarge = 1 << 13;  // faces
// And runs with a tolerance to this share of the tolerance.
constexpr double kOfTolerance = 1.0 / 64;

// From a source that is no vertex to the nearest corner of its face: the least distance that a tolerance is kept to.
double nearest_corner(const Mesh& mesh, std::span<const detail::LocatedSource> sources) {
  double nearest = kInfinity;
  for (const detail::LocatedSource& s : sources) {
    if (s.curve || s.at.on == PointLocation::On::Vertex) continue;
    for (const double d : corner_distances(mesh, s.at)) {
      if (d > 0) nearest = std::min(nearest, d);
    }
  }
  return nearest;
}

// One part: what crosses from part to part forgets its trail (Trails), and threads would not make up for the numbers.
constexpr unsigned kOnePart = 31;

class Windows final : public detail::Engine {
 public:
  Windows(Mesh mesh, Merging merging, std::unique_ptr<NumberedEngine> in_doubles)
      : mesh_(std::move(mesh)), merging_(merging), narrow_(std::move(in_doubles)) {}

  void set_up(const DistanceOptions& options) override { engine_for(options).set_up(options); }
  void solve(const detail::Problem& problem, DistanceField& field) override {
    const bool beside = is_beside_vertex(problem);
    (beside ? in_wider_numbers() : engine_for(*problem.options)).solve(problem, field);
  }
  bool lists_touched() const override { return true; }

 private:
  static double tolerance_of(const DistanceOptions& options) {
    return options.method == Method::Exact ? 0 : options.tolerance;
  }
  detail::Engine& engine_for(const DistanceOptions& options) {
    const double tolerance = tolerance_of(options);
    const double allowed = mesh_.face_count() < kLarge ? kDoubtAllowed : kDoubtAllowedInLarge;
    if (narrow_->doubt() <= std::max(allowed, kOfTolerance * tolerance)) return *narrow_;
    return in_wider_numbers();
  }
  // Whether a vertex is so near to a source that rounding is more than the tolerance leaves for it.
  bool is_beside_vertex(const detail::Problem& problem) const {
    const double tolerance = tolerance_of(*problem.options);
    return tolerance > 0 &&
           narrow_->absolute_rounding() > kOfTolerance * tolerance * nearest_corner(mesh_, problem.sources);
  }
  detail::Engine& in_wider_numbers() {
    if (!wide_) wide_ = in_double_doubles::make_engine(mesh_, kOnePart, merging_);
    return *wide_;
  }

  Mesh mesh_;
  Merging merging_;
  std::unique_ptr<NumberedEngine> narrow_, wide_;
};

}  // namespace

std::unique_ptr<detail::Engine> make_windows(const Mesh& mesh, unsigned part_bits, Merging merging) {
  if (mesh.vertex_count() >= kNoIndex / 2) throw Error(ErrorCode::TooLarge, "too many vertices for windows");
  auto engine = in_doubles::make_engine(mesh, part_bits, merging);
  // Copies of faces are looked for where their edges have been met: other meshes pay nothing for it. (Two copies on
  // their own are a flat bag, and no harm.)
  std::shared_ptr<const detail::Sheets> sheets = engine->has_spines() ? detail::Sheets::of(mesh) : nullptr;
  if (!sheets) return std::make_unique<Windows>(mesh, merging, std::move(engine));
  engine.reset();
  return detail::make_on_one_sheet(
      std::move(sheets), [part_bits, merging](const Mesh& single) -> std::unique_ptr<detail::Engine> {
        return std::make_unique<Windows>(single, merging, in_doubles::make_engine(single, part_bits, merging));
      });
}

}  // namespace brushfire::windows
