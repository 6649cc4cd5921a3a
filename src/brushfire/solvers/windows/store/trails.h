// Which faces a window has crossed since its pseudo-source: what ends light that goes round and round.
#pragma once

#include <brushfire/solvers/windows/algebra/real.h>

#include <algorithm>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// A shortest path crosses a face once: between two visits it could go straight through the face, which is no longer,
// and as that would bend where the path first left the face, there is a shorter one still. So a window that comes to a
// face where it has been is on no shortest path. That is what ends every run, whatever rounding makes of the values:
// all faces of a branch differ, so none is longer than there are faces. (A path can come back only along the line of an
// edge; what is on such lines vertices tell each other. Faces without area are nothing but such lines, and are left to
// WindowMemory.) Merged windows begin a new trail (L1), so none are made where circles are no longer: in thin faces.
class Trails {
 public:
  // The trail of what leaves a face: with it.
  Index with(Index trail, Index face) {
    const Index length = trail == kNoIndex ? 1 : steps_[trail].length + 1;
    steps_.push_back({trail, face, length});
    return static_cast<Index>(steps_.size() - 1);
  }

  // Whether it has been in the face. Looks a little way back, since circles are short as a rule, and all the way at
  // every power of two: cheap for long trails, and none that goes in a circle is missed for long.
  bool has_been(Index trail, Index face) const {
    constexpr Index kShort = 64;
    if (trail == kNoIndex) return false;
    const Index length = steps_[trail].length;
    Index left = (length & (length - 1)) == 0 ? length : std::min(kShort, length);
    for (; left > 0; --left, trail = steps_[trail].before) {
      if (steps_[trail].face == face) return true;
    }
    return false;
  }
  void clear() { steps_.clear(); }

 private:
  struct Step {
    Index before, face, length;
  };
  std::vector<Step> steps_;
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
