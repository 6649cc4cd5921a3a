// The loops over a list of windows that is trimmed, for each target.
#pragma once

#include <brushfire/core/detail/lanes.h>
#include <brushfire/solvers/windows/algebra/columns.h>
#include <brushfire/solvers/windows/algebra/dominance.h>

#include <cstdint>

#define BRUSHFIRE_KERNEL <brushfire/solvers/windows/propagation/trimming_kernel.h>
#include <brushfire/core/detail/each_target.h>
