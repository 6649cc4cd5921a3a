// Both children of a window at once.
#pragma once

#include <brushfire/solvers/windows/algebra/propagate.h>

namespace brushfire::windows {

// Slivers are left out.
struct Children {
  Window left, right;
  bool has_left = false, has_right = false;
};

inline Children children_of(const Window& w, const Frame& frame) {
  Children children;
  propagate(
      w, frame,
      [&](const Window& left) {
        children.left = left;
        children.has_left = !is_sliver(left);
      },
      [&](const Window& right) {
        children.right = right;
        children.has_right = !is_sliver(right);
      });
  return children;
}

}  // namespace brushfire::windows
