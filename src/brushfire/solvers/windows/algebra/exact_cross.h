// A whole list of windows from one edge of a triangle to the other two, column by column.
#pragma once

#include <brushfire/solvers/windows/algebra/columns.h>
#include <brushfire/solvers/windows/algebra/frame.h>

#include <cstdint>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// Where the apex lies for each window of a list: what tells which edges the window goes on to.
struct Sight {
  // Positive where a part of the window passes the apex on the left (the ray to the apex crosses the edge right of the
  // window's start), on the right. Both: the window sees the apex.
  std::vector<Real> left, right;
  // The length of the straight path to the apex; infinite where the apex is clearly not seen.
  std::vector<Real> value;
  Index least = kNoIndex;  // the place of the least value; kNoIndex: all are infinite
  // Those that pass the apex on the left, on the right; bit i: window i. Of lists that are longer it means nothing.
  std::uint64_t passes_left = 0, passes_right = 0;
};

// Fills `sight` for the whole list, which has windows.
void look_at_apex(const WindowColumns& windows, Index count, const Frame& frame, Sight& sight);

// The place of the least number; kNoIndex: all are infinite. `count` > 0.
Index least_of(const Real* numbers, Index count);

// Which windows go on to the left: those in [0, left_end) with goes_left > 0; to the right: those in
// [right_begin, count) with goes_right > 0.
struct Routes {
  Index left_end = 0, right_begin = 0;
  const Real *goes_left = nullptr, *goes_right = nullptr;  // Sight's own or the two below
  std::vector<Real> some_left, some_right;
};

// One angle, one split (Chen and Han 1990): of the windows that see the apex only the best one there, `best` (kNoIndex:
// none is known), has children on both sides. A window whose ray to the apex crosses the edge left of the best one's
// has nothing to give on the right where its limit ray on the right crosses the best one's ray to the apex: there the
// path along the best one's is shorter. So the others normally go on to one side each, and the windows' order says
// which.
void find_routes(const WindowColumns& windows, Index count, const Frame& frame, const Sight& sight, Index best,
                 Routes& routes);

// The windows' parts left of the apex on the edge from the start to the apex, the parts right of it on the edge from
// the apex to the end (as in propagate()). Return how many there are: what is not visible and slivers are left out.
Index cross_to_left(const WindowColumns& windows, const Routes& routes, const Sight& sight, const Frame& frame,
                    const WindowColumns& out);
Index cross_to_right(const WindowColumns& windows, Index count, const Routes& routes, const Sight& sight,
                     const Frame& frame, const WindowColumns& out);

// The values at both ends.
void end_values(const WindowColumns& windows, Index count, Real* d0, Real* d1);

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
