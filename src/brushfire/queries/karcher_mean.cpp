// Descent along the mean of the logarithmic map.
#include <brushfire/queries/karcher_mean.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/queries/detail/leaving_angles.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/straightest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace brushfire {
namespace {

// On the open mesh.
class Descent {
 public:
  Descent(const Mesh& mesh, std::vector<SurfacePoint> points, std::vector<double> weights)
      : mesh_(mesh), solver_(mesh), points_(std::move(points)), weights_(std::move(weights)) {
    for (const double w : weights_) total_weight_ += w;
  }

  // What is to become small: the weighted mean of squared distances; +inf where a point is not reached.
  struct Measured {
    SurfacePoint at;
    double value = kInfinity;
    std::vector<double> distance;  // of the points
    std::shared_ptr<const WindowField> windows;
  };

  Measured measure(const SurfacePoint& at) {
    DistanceOptions options;
    options.method = Method::Exact;
    options.keep_paths = true;
    options.targets = points_;
    const Source source{at};
    SparseField field = solver_.distance_sparse(std::span(&source, 1), options);
    Measured m{at, 0, std::move(field.target_distance), std::move(field.windows)};
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (weights_[i] > 0) m.value += weights_[i] * m.distance[i] * m.distance[i] / total_weight_;
    }
    return m;
  }

  // The mean of the points in the tangent plane there; none at a vertex that has no such plane.
  struct Step {
    double angle = 0, length = 0;
  };
  std::optional<Step> step(const Measured& m) const {
    const PointLocation at = locate(mesh_, m.at);
    if (at.on == PointLocation::On::Vertex && mesh_.links()[at.vertex] == Link::Other) return std::nullopt;
    const detail::LeavingAngles leaving(mesh_, m.at);
    Vec2 mean{0, 0};
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!(weights_[i] > 0) || m.distance[i] == 0) continue;
      const SurfacePath path = path_to(*m.windows, points_[i]);
      if (path.points.size() < 2) continue;
      const double share = weights_[i] / total_weight_;
      mean = mean + share * leaving.vector(leaving.towards(path.points[1]), m.distance[i]);
    }
    const auto [angle, length] = leaving.polar(mean);
    return Step{angle, length};
  }

  // Where it begins: the point from which the others are nearest; of many, some.
  Measured start() {
    constexpr std::size_t kMost = 16;
    Measured best;
    const std::size_t stride = (points_.size() + kMost - 1) / kMost;
    for (std::size_t i = 0; i < points_.size(); i += stride) {
      Measured m = measure(points_[i]);
      ++runs;
      if (m.value < best.value) best = std::move(m);
    }
    return best;
  }

  Index runs = 0;

 private:
  const Mesh& mesh_;
  DistanceSolver solver_;
  std::vector<SurfacePoint> points_;
  std::vector<double> weights_;
  double total_weight_ = 0;
};

std::vector<double> checked(std::span<const double> weights, std::size_t points) {
  if (points == 0) throw Error(ErrorCode::InvalidArgument, "no points: a mean needs at least one");
  if (weights.empty()) return std::vector<double>(points, 1);
  if (weights.size() != points) {
    throw Error(ErrorCode::InvalidArgument,
                std::to_string(weights.size()) + " weights for " + std::to_string(points) + " points");
  }
  double sum = 0;
  for (const double w : weights) {
    if (!(w >= 0) || !std::isfinite(w)) {
      throw Error(ErrorCode::InvalidArgument, "a weight is " + std::to_string(w) + ", and not finite and >= 0");
    }
    sum += w;
  }
  if (!(sum > 0)) throw Error(ErrorCode::InvalidArgument, "all weights are 0");
  return {weights.begin(), weights.end()};
}

}  // namespace

KarcherMean karcher_mean(const Domain& domain, std::span<const SurfacePoint> points, std::span<const double> weights,
                         const KarcherMeanOptions& options) {
  std::vector<double> checked_weights = checked(weights, points.size());
  std::vector<SurfacePoint> on_open;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::vector<SurfacePoint> sides = domain.on_open(points[i]);
    if (sides.empty()) {
      throw Error(ErrorCode::InvalidArgument, "point " + std::to_string(i) + " lies behind a wall, or in no face");
    }
    on_open.push_back(sides.front());
  }
  const CancelScope listen(options.cancel);
  const Mesh& mesh = domain.open();
  Descent descent(mesh, std::move(on_open), std::move(checked_weights));
  Descent::Measured here = descent.start();
  KarcherMean mean;
  while (here.value < kInfinity && !mean.converged && descent.runs < options.max_steps + points.size()) {
    const std::optional<Descent::Step> step = descent.step(here);
    mean.last_step = step ? step->length : 0;
    mean.converged = mean.last_step <= options.tolerance * std::sqrt(here.value);
    // Half as far until the sum falls: near the cut locus of a point a whole step may go too far.
    constexpr int kMostHalvings = 20;
    bool better = false;
    double length = mean.last_step;
    for (int i = 0; i < kMostHalvings && !better && !mean.converged; ++i, length *= 0.5) {
      Descent::Measured next = descent.measure(straightest(mesh, here.at, step->angle, length).path.points.back());
      ++descent.runs;
      better = next.value < here.value;
      if (better) here = std::move(next);
    }
    mean.converged = mean.converged || !better;
  }
  mean.steps = descent.runs;
  if (here.value == kInfinity) {
    mean.deviation = kInfinity;
    return mean;
  }
  mean.point = here.at;
  domain.to_mesh(std::span(&mean.point, 1));
  mean.deviation = std::sqrt(here.value);
  return mean;
}

}  // namespace brushfire
