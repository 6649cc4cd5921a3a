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
// where they cross edges, and within a face where the pace is tacking().
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

  // Any function, at equal steps of 2.5e-4 from the first slope to the last; > 0 and finite there. Throws
  // Error(InvalidArgument).
  static SlopePace function(double first, double last, const std::function<double(double)>& pace);

  // No step is steeper than this, up or down; steeper ground can still be traversed. Throws Error(InvalidArgument)
  // where nothing is left.
  SlopePace up_to(double steepest) const;
  // Steep steps go in tacks wherever that is cheaper: a longer way as steep as some gentler slope t costs pace(t) |s /
  // t| on the map at a slope of s, however steep that is (also beyond the last sample). Left and right of the straight
  // way in turns such tacks are real ways, as near to it as one likes. Where pace(length, rise) = length * pace(rise /
  // length) is convex, as Tobler's is, the cost of a direction in a plane is then convex, too: no other mixture of
  // directions is cheaper than going straight. (Where it is not, as Naismith's, two slopes in turns may be; that is not
  // looked for.)
  SlopePace tacking() const;

  // +inf beyond the samples, but for tacks.
  double operator()(double slope) const {
    constexpr double kRounding = 1e-9;  // of the place of a sample
    const double exact = (slope - first_) * per_slope_;
    if (!(exact >= -kRounding && exact <= last_place_ + kRounding)) {
      const double steep = slope > 0 ? slope * climb_ : -slope * descent_;
      return slope != 0 && (slope > 0) == (exact > 0) ? steep : kInfinity;
    }
    const double place = exact < 0 ? 0 : exact < last_place_ ? exact : last_place_;
    const auto i = static_cast<std::size_t>(place < last_place_ ? place : last_place_ - 1);
    return pace_[i] + (place - static_cast<double>(i)) * (pace_[i + 1] - pace_[i]);
  }
  double least() const;

 private:
  SlopePace(double first, double last, const std::function<double(double)>& pace);

  double first_ = 0, per_slope_ = 1, last_place_ = 0;
  double climb_ = kInfinity, descent_ = kInfinity;  // of a unit of height in tacks
  std::vector<double> pace_;                        // at equal steps
};

}  // namespace brushfire
