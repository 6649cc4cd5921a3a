// Newton's method on the places where a path crosses edges.
#include <brushfire/queries/detail/strip.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace brushfire::weighted {
namespace {

// Lengths are smoothed to sqrt(length^2 + m^2) while Newton's method runs, since stops may meet: from the first to the
// last share of the mean leg, a tenth at a time. The last one changes a cost by less than rounding does.
constexpr double kFirstSmoothing = 1e-1, kLastSmoothing = 1e-9;
constexpr int kMostSteps = 60;  // at one smoothing; 3 to 8 are usual

class Newton {
 public:
  Newton(const WeightedMesh& mesh, const Strip& strip) : strip_(strip) {
    const std::size_t n = strip.stops.size();
    for (std::size_t k = 0; k < strip.legs.size(); ++k) {
      from_.push_back(rail(mesh, strip.legs[k], strip.stops[k], true));
      to_.push_back(rail(mesh, strip.legs[k], strip.stops[k + 1], false));
    }
    length_.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
      at_.push_back(strip.stops[k].at);
      if (strip.stops[k].slides()) length_[k] = mesh.mesh().lengths()[mesh.edges().halfedge(strip.stops[k].edge)];
    }
    gradient_.resize(n);
    diagonal_.resize(n);
    beside_.resize(n);
    step_.resize(n);
    factor_.resize(n);
  }

  double cost(const std::vector<double>& at, double smoothing) const {
    double sum = 0;
    for (std::size_t k = 0; k < from_.size(); ++k) {
      const Vec2 d = way(at, k);
      sum += strip_.legs[k].weight * std::sqrt(dot(d, d) + smoothing * smoothing);
    }
    return sum;
  }

  // The places with the least cost.
  std::vector<double> minimize() {
    double sum = 0;
    for (std::size_t k = 0; k < from_.size(); ++k) sum += norm(way(at_, k));
    const double mean = sum / static_cast<double>(std::max<std::size_t>(1, from_.size()));
    std::vector<double> best = at_;
    double least = cost(at_, 0);
    for (double share = kFirstSmoothing; mean > 0 && share >= 0.5 * kLastSmoothing; share *= 0.1) {
      for (int i = 0; i < kMostSteps && improve(share * mean); ++i) {
      }
      const double now = cost(at_, 0);
      if (now < least) {
        least = now;
        best = at_;
      }
    }
    return best;
  }

 private:
  Vec2 way(const std::vector<double>& at, std::size_t k) const {
    return to_[k].origin + at[k + 1] * to_[k].direction - (from_[k].origin + at[k] * from_[k].direction);
  }

  void differentiate(double smoothing) {
    std::fill(gradient_.begin(), gradient_.end(), 0);
    std::fill(diagonal_.begin(), diagonal_.end(), 0);
    std::fill(beside_.begin(), beside_.end(), 0);
    for (std::size_t k = 0; k < from_.size(); ++k) {
      const Vec2 d = way(at_, k), a = from_[k].direction, b = to_[k].direction;
      const double r = std::sqrt(dot(d, d) + smoothing * smoothing), w = strip_.legs[k].weight;
      const double da = dot(d, a) / r, db = dot(d, b) / r;
      gradient_[k] -= w * da;
      gradient_[k + 1] += w * db;
      diagonal_[k] += w * (dot(a, a) - da * da) / r;
      diagonal_[k + 1] += w * (dot(b, b) - db * db) / r;
      beside_[k] = -w * (dot(a, b) - da * db) / r;
    }
  }

  // Whether it stays: at an end of its edge, and driven there.
  bool is_held(std::size_t k) const {
    return !strip_.stops[k].slides() || (at_[k] <= 0 && gradient_[k] > 0) || (at_[k] >= length_[k] && gradient_[k] < 0);
  }

  // The Newton step of those that are free: a tridiagonal system, solved from one end to the other and back.
  void find_step() {
    constexpr double kDamping = 1e-12;
    const std::size_t n = at_.size();
    for (std::size_t k = 0; k < n; ++k) {
      const bool held = is_held(k);
      const double before = k > 0 && !held && !is_held(k - 1) ? beside_[k - 1] : 0;
      const double after = k + 1 < n && !held && !is_held(k + 1) ? beside_[k] : 0;
      const double diagonal = held || diagonal_[k] == 0 ? 1 : diagonal_[k] * (1 + kDamping);
      const double pivot = diagonal - (k > 0 ? before * factor_[k - 1] : 0);
      factor_[k] = after / pivot;
      step_[k] = ((held ? 0 : -gradient_[k]) - (k > 0 ? before * step_[k - 1] : 0)) / pivot;
    }
    for (std::size_t k = n - 1; k-- > 0;) step_[k] -= factor_[k] * step_[k + 1];
  }

  // One step, shortened until it lowers the cost; false where none does by more than rounding.
  bool improve(double smoothing) {
    constexpr double kRounding = 1e-15, kShortest = 1e-8;
    differentiate(smoothing);
    find_step();
    const double before = cost(at_, smoothing);
    std::vector<double> moved(at_.size());
    for (double share = 1; share > kShortest; share *= 0.5) {
      for (std::size_t k = 0; k < at_.size(); ++k) {
        moved[k] = strip_.stops[k].slides() ? std::clamp(at_[k] + share * step_[k], 0.0, length_[k]) : at_[k];
      }
      const double after = cost(moved, smoothing);
      if (!(after < before)) continue;
      at_.swap(moved);
      return before - after > kRounding * before;
    }
    return false;
  }

  const Strip& strip_;
  std::vector<Rail> from_, to_;  // of each leg
  std::vector<double> length_;   // of the edges that stops slide on
  std::vector<double> at_, gradient_, diagonal_, beside_, step_, factor_;
};

}  // namespace

double straighten(const WeightedMesh& mesh, Strip& strip) {
  const std::vector<double> at = Newton(mesh, strip).minimize();
  for (std::size_t k = 0; k < at.size(); ++k) strip.stops[k].at = at[k];
  return cost_of(mesh, strip);
}

}  // namespace brushfire::weighted
