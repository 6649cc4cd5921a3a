// Angles without a call: of single numbers or of lanes.
#pragma once

#include <brushfire/core/detail/lanes.h>
#include <brushfire/core/types.h>

#include <array>

namespace brushfire::fast_marching {

// Of the arc tangent, by odd powers from the highest on.
// Based on: Abramowitz, Stegun (1964), Handbook of Mathematical Functions, 4.4.49.
inline constexpr std::array kAngleSeries{0.0028662257,  -0.0161657367, 0.0429096138,
                                         -0.0752896400, 0.1065626393,  -0.1420889944,
                                         0.1999355085,  -0.3333314528, 1.0};

}  // namespace brushfire::fast_marching

#define BRUSHFIRE_KERNEL <brushfire/solvers/fast_marching/detail/angle_kernel.h>
#include <brushfire/core/detail/each_target.h>
