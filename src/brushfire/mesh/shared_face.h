// Faces that several cells share: finer than one label per vertex.
#pragma once

#include <brushfire/core/types.h>

#include <array>

namespace brushfire {

// A face whose corners lie in different cells, and how far each corner is from the source of each of them. In between
// the distances are taken as linear, and a place lies in the cell of the nearest source.
struct SharedFace {
  Index face = kNoIndex;
  std::array<Index, 3> label{};                     // of each corner
  std::array<std::array<double, 3>, 3> distance{};  // [corner][k]: from the source of corner k
};

}  // namespace brushfire
