// The loops over a list of windows that crosses a triangle, for each target.
#pragma once

#include <brushfire/core/detail/lanes.h>
#include <brushfire/solvers/windows/algebra/exact_cross.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#define BRUSHFIRE_KERNEL <brushfire/solvers/windows/algebra/crossing_kernel.h>
#include <brushfire/core/detail/each_target.h>
