// One row of points offers what it has to another row of the same face.
#pragma once

#include <brushfire/core/detail/lanes.h>
#include <brushfire/core/types.h>
#include <brushfire/solvers/steiner/detail/travel.h>

#include <vector>

namespace brushfire::steiner {

// The points that offer, in the frame of their edge: point i lies at (at[i], 0).
struct Offering {
  const double* at = nullptr;
  const double* value = nullptr;
  Index first = 0, last = 0;  // which of them, both included
  double least = 0;           // of their values
};

// The points that are offered something: point j lies at start + at[j] * direction.
struct Receiving {
  const double* at = nullptr;
  const double* value = nullptr;
  Vec2 start, direction;
  Index room = 0;  // how many, a multiple of the lanes
};

// What keeps offers below every distance that they stand for, point by point (see lower_costs.h).
struct LowerTerms {
  std::vector<double> height;    // of the neighbourhood, over the line of the other edge
  std::vector<double> reach;     // the longer one of the two intervals at the point
  std::vector<double> variance;  // a quarter of that squared
  std::vector<double> quotient;  // of the variance and the squared height, at most in the two intervals
  std::vector<double> ceiling;   // beside the common vertex: its share of the most that may be asked; +inf elsewhere
};

// What came of it, for each receiving point: the least offer, where it is below the point's value; and whose it is.
struct Offers {
  std::vector<double> value;
  std::vector<double> from;  // a number of an offering point, as a double; -1: nothing is lower
};

// By how much a distance in a face may be off for the rounding of its coordinates, as a share of the longest edge: they
// have two roundings each, their squares, sum and root one.
inline constexpr double kPlaceRounding = 0x1p-48;

// Real costs where slopes count: `gradient` is that of the height, in the frame of the offering edge. As relax_rows()
// in the kernel, one pair of points after the other.
bool relax_sloped_rows(const Offering& from, const Receiving& to, double weight, Vec2 gradient, const Travel& travel,
                       Offers& offers);

}  // namespace brushfire::steiner

#define BRUSHFIRE_KERNEL <brushfire/solvers/steiner/detail/relax_kernel.h>
#include <brushfire/core/detail/each_target.h>
