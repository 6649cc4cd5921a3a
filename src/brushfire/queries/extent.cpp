// Bounds on the eccentricity of every vertex, narrowed by one exact field after the other.
#include <brushfire/queries/extent.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/components.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace brushfire {
namespace {

// The bounds of one component.
class Bounds {
 public:
  Bounds(std::vector<Index> vertices, const ExtentOptions& options)
      : vertices_(std::move(vertices)),
        lower_(vertices_.size(), 0),
        upper_(vertices_.size(), kInfinity),
        measured_(vertices_.size(), false),
        options_(options) {}

  void run(DistanceSolver& solver, SparseField& field, std::vector<double>& distance) {
    const std::size_t from = next();
    const Source source{vertex_point(solver.mesh(), vertices_[from])};
    DistanceOptions run;
    run.method = Method::Exact;
    run.threads = options_.threads;
    run.cancel = options_.cancel;
    solver.distance_sparse(std::span(&source, 1), run, field);
    for (std::size_t i = 0; i < field.vertex.size(); ++i) distance[field.vertex[i]] = field.distance[i];
    take(from, distance);
    for (const Index v : field.vertex) distance[v] = kInfinity;
    from_greatest_upper_ = !from_greatest_upper_;
    ++result_.runs;
  }

  bool done() const {
    const double scale = 1 + options_.tolerance;
    return (result_.diameter_upper <= scale * result_.diameter_lower &&
            result_.radius_upper <= scale * result_.radius_lower) ||
           result_.runs == vertices_.size() || (options_.max_runs > 0 && result_.runs >= options_.max_runs);
  }

  const Extent& result() const { return result_; }

 private:
  // Where to measure: the vertex that may have the farthest vertex of all, or the one that may be the centre.
  std::size_t next() const {
    std::size_t best = vertices_.size();
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      if (measured_[i]) continue;
      if (best == vertices_.size() || (from_greatest_upper_ ? upper_[i] > upper_[best] : lower_[i] < lower_[best])) {
        best = i;
      }
    }
    return best;
  }

  void take(std::size_t from, const std::vector<double>& distance) {
    std::size_t farthest = from;
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      if (distance[vertices_[i]] > distance[vertices_[farthest]]) farthest = i;
    }
    const double eccentricity = distance[vertices_[farthest]];
    measured_[from] = true;
    if (result_.pair[0] == kNoIndex || eccentricity > result_.diameter_lower) {
      result_.diameter_lower = eccentricity;
      result_.pair = {std::min(vertices_[from], vertices_[farthest]), std::max(vertices_[from], vertices_[farthest])};
    }
    if (result_.centre == kNoIndex || eccentricity < result_.radius_upper) {
      result_.radius_upper = eccentricity;
      result_.centre = vertices_[from];
    }
    double upper = 0, lower = kInfinity;
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const double d = distance[vertices_[i]];
      lower_[i] = std::max({lower_[i], d, eccentricity - d});
      upper_[i] = std::min(upper_[i], eccentricity + d);
      if (i == from) lower_[i] = upper_[i] = eccentricity;
      upper = std::max(upper, upper_[i]);
      lower = std::min(lower, lower_[i]);
    }
    // Rounding of sums must not part what belongs together.
    result_.diameter_upper = std::max(upper, result_.diameter_lower);
    result_.radius_lower = std::min(lower, result_.radius_upper);
  }

  std::vector<Index> vertices_;
  std::vector<double> lower_, upper_;  // of eccentricities
  std::vector<char> measured_;
  const ExtentOptions& options_;
  bool from_greatest_upper_ = true;
  Extent result_;
};

}  // namespace

Extent extent(const Domain& domain, const ExtentOptions& options) {
  if (!(options.tolerance >= 0)) {
    throw Error(ErrorCode::InvalidArgument, "tolerance " + std::to_string(options.tolerance) + " is not >= 0");
  }
  // The two sides of a wall are two places here: only so does the triangle inequality hold.
  const Mesh& mesh = domain.open();
  const detail::Components components = detail::components_of(mesh);
  std::vector<std::vector<Index>> members(components.count);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (components.of_vertex[v] != kNoIndex) members[components.of_vertex[v]].push_back(v);
  }
  const CancelScope listen(options.cancel);
  DistanceSolver solver(mesh);
  SparseField field;
  std::vector<double> distance(mesh.vertex_count(), kInfinity);
  Extent best;
  double upper = 0;
  Index runs = 0;
  for (std::vector<Index>& vertices : members) {
    Bounds bounds(std::move(vertices), options);
    do {
      bounds.run(solver, field, distance);
      const Extent& e = bounds.result();
      if (options.progress && e.diameter_upper > 0) options.progress(e.diameter_lower / e.diameter_upper);
    } while (!bounds.done());
    runs += bounds.result().runs;
    upper = std::max(upper, bounds.result().diameter_upper);
    if (best.centre == kNoIndex || bounds.result().diameter_lower > best.diameter_lower) best = bounds.result();
  }
  best.diameter_upper = upper;
  best.runs = runs;
  if (best.centre == kNoIndex) return best;
  best.pair = {domain.vertex(best.pair[0]), domain.vertex(best.pair[1])};
  best.centre = domain.vertex(best.centre);
  if (best.pair[0] > best.pair[1]) std::swap(best.pair[0], best.pair[1]);
  return best;
}

}  // namespace brushfire
