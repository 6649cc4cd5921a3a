// SlopePace: what a step costs by how steeply it goes up or down.
#pragma once

#include <brushfire/core/types.h>

#include <functional>
#include <span>
#include <vector>

namespace brushfire {

// The cost of a unit of length on the map (not along the slope), by the slope: height gained per length on the map,
// below 0 downhill. Between samples it is linear, beyond the first and the last it is infinite. Paths over vertices
// and edges are as good as the function allows; where climbing in zigzags is cheaper than straight up, paths do so only
// where they cross edges, and not within a face.
class SlopePace {
 public:
  // Tobler's hiking function (1993): 6 exp(-3.5 |slope + 0.05|) km/h. In seconds per metre, for maps in metres.
  static SlopePace tobler();
  // Naismith's rule (1892) with Langmuir's corrections (1984): 5 km/h, 6 s more for every metre up, 2 s less for every
  // metre down gentle slopes (5 to 12 degrees), 2 s more down steep ones. In seconds per metre.
  static SlopePace naismith();
  // The energy of walking by Minetti et al. (2002), Energy cost of walking and running at extreme uphill and downhill
  // slopes: J per kg and metre, slopes between -0.5 and 0.5.
  static SlopePace energy();
  // A table: slopes ascend, at least two of them; paces > 0. Linear between. Throws Error(InvalidArgument).
  static SlopePace table(std::span<const double> slopes, std::span<const double> paces);

  // No step is steeper than this, up or down; steeper ground can still be traversed. Throws Error(InvalidArgument)
  // where nothing is left.
  SlopePace up_to(double steepest) const;

  // +inf beyond the samples.
  double operator()(double slope) const {
    constexpr double kRounding = 1e-9;  // of the place of a sample
    const double exact = (slope - first_) * per_slope_;
    if (!(exact >= -kRounding && exact <= last_place_ + kRounding)) return kInfinity;
    const double place = exact < 0 ? 0 : exact < last_place_ ? exact : last_place_;
    const auto i = static_cast<std::size_t>(place < last_place_ ? place : last_place_ - 1);
    return pace_[i] + (place - static_cast<double>(i)) * (pace_[i + 1] - pace_[i]);
  }
  double least() const;

 private:
  SlopePace(double first, double last, const std::function<double(double)>& pace);

  double first_ = 0, per_slope_ = 1, last_place_ = 0;
  std::vector<double> pace_;  // at equal steps
};

}  // namespace brushfire
