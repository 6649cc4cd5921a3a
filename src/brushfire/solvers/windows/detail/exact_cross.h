// A whole list of windows from one edge of a triangle to the other two, column by column.
#pragma once

#include <brushfire/solvers/windows/detail/exact_lists.h>
#include <brushfire/solvers/windows/detail/face.h>

#include <vector>

namespace brushfire::detail {

// Where the apex lies for each window of a list: what tells which edges the window goes on to.
struct Sight {
  // Positive where a part of the window passes the apex on the left (the ray to the apex crosses the edge right of the
  // window's start), on the right. Both: the window sees the apex.
  std::vector<double> left, right;
  // The length of the straight path to the apex; infinite where the apex is clearly not seen.
  std::vector<double> value;
};

// Fills `sight` for the whole list.
void look_at_apex(const WindowColumns& windows, Index count, const Frame& frame, Sight& sight);

// The place of the least number; `count` > 0.
Index least_of(const double* numbers, Index count);

// One angle, two sides. Of the windows that see the apex, one is the best there: `best` (kNoIndex: none is known). A
// window whose ray to the apex crosses the edge left of the best one's has nothing to give on the right where that ray
// or its limit ray on the right crosses the best one's: there the path along the best one's is shorter. So each window
// normally goes on to one edge, the best one to both.
//
// True where it is enough that the first `left_end` windows go left and those from right_begin on right; false where the
// windows' order is not that simple, and choose_sides() must be asked for each.
struct Sides {
  Index left_end = 0, right_begin = 0;
};
bool sides_in_order(const WindowColumns& windows, Index count, const Frame& frame, const Sight& sight, Index best,
                    Sides& sides);

// Whether window i has to go on to the left, to the right.
struct Way {
  bool left, right;
};
Way choose_sides(const WindowColumns& windows, const Frame& frame, const Sight& sight, Index best, Index i);

// The windows' parts left of the apex on the edge from the start to the apex, the parts right of it on the edge from
// the apex to the end (as in propagate()); sight_right / sight_left: the windows' own Sight::right, left. Returns how
// many there are: what is not lit and slivers are left out.
Index cross_to_left(const WindowColumns& windows, Index count, const Frame& frame, const double* sight_right,
                    const WindowColumns& out);
Index cross_to_right(const WindowColumns& windows, Index count, const Frame& frame, const double* sight_left,
                     const WindowColumns& out);

// The values at both ends.
void end_values(const WindowColumns& windows, Index count, double* d0, double* d1);

}  // namespace brushfire::detail
