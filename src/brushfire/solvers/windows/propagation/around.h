// What the corners around a vertex add up to: the sum of their angles, and how uneven their edges are.
#pragma once

#include <brushfire/solvers/windows/propagation/structure.h>

#include <brushfire/solvers/windows/propagation/fan.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// The sum of angles in (0, pi), as the product of as many turns of the plane: an arc tangent for each would take longer
// than all the rest.
struct AngleSum {
  Real x = 1, y = 0;  // the sum's direction
  Index turns = 0;    // that are full

  // An angle of these cosine and sine.
  void add(Real cosine, Real sine) {
    const Real turned_x = x * cosine - y * sine, turned_y = x * sine + y * cosine;
    turns += y < 0 && turned_y >= 0 ? 1 : 0;
    x = turned_x, y = turned_y;
  }
  double value() const { return 2 * kPi * (turns + (y < 0 ? 1 : 0)) + std::atan2(to_double(y), to_double(x)); }
  // By more than kFlat; judged by the direction, which is as precise for small angles as for large ones.
  bool exceeds_pi() const { return turns > 0 || (y < 0 && (x >= 0 || y < kFlat * x)); }
  bool exceeds_two_pi() const { return turns > 1 || (turns == 1 && (y < 0 || x <= 0 || y > kFlat * x)); }
};

// What the corners at a vertex are.
struct Around {
  AngleSum angles;
  Index faces = 0;
  float shortest = std::numeric_limits<float>::infinity(), longest = 0;  // of their edges

  // Whether a corner's edges may differ by more than kUnevenEdges; also where floats cannot tell.
  bool is_uneven() const { return !(static_cast<double>(longest) < kUnevenEdges * static_cast<double>(shortest)); }

  // Whether the angles are less than this, whatever rounding has made of them: a side of a face is known to some ten
  // epsilons of the ratio of its edges (docs/tolerance.md), and so is its angle.
  bool is_surely_below(double sum, double ratio) const {
    constexpr double kEachAngle = 32 * kEpsilon;
    return angles.value() + kEachAngle * ratio * faces < sum;
  }

  // Corner k of a face that has an area.
  void add(const WindowFace& f, Index k) {
    const Real a = f.length[k], b = f.length[previous3(k)], inverse = 1 / (a * b);
    const Vec2 opening = opening_at(f, k);
    angles.add(opening.x * inverse, opening.y * inverse);
    ++faces;
    shortest = std::min({shortest, static_cast<float>(a), static_cast<float>(b)});
    longest = std::max({longest, static_cast<float>(a), static_cast<float>(b)});
  }
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
