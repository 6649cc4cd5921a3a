// The number that windows are made of: double, or DoubleDouble for meshes whose lengths differ too much.
//
// All of this room is compiled twice: file by file for doubles, and once more as a whole by in_double_doubles.cpp. Each
// time everything lies in a namespace of its own, so that both live in one program; see docs/decisions/wide-numbers.md.
#pragma once

#include <brushfire/core/detail/double_double.h>
#include <brushfire/core/types.h>

#include <cmath>
#include <limits>

// (Macros, because a namespace's name cannot be an argument.)
#ifdef BRUSHFIRE_WIDE_NUMBERS
#define BRUSHFIRE_NUMBERS in_double_doubles
#else
#define BRUSHFIRE_NUMBERS inline in_doubles
#endif

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

#ifdef BRUSHFIRE_WIDE_NUMBERS
using Real = detail::DoubleDouble;
inline constexpr double kEpsilon = 0x1p-103;
inline constexpr bool kWide = true;
#else
using Real = double;
inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
inline constexpr bool kWide = false;
#endif

// Tolerances are given for doubles; those that stand for rounding shrink with it, those that balance rounding against
// its effect with the root.
inline constexpr double kFiner = kEpsilon / std::numeric_limits<double>::epsilon();
inline constexpr double kSqrtFiner = kWide ? 0x1p-26 : 1;

using std::abs, std::copysign, std::hypot, std::isfinite, std::isnan, std::sqrt;  // DoubleDouble's are found by it

// For what needs no more, such as the order of events.
constexpr double to_double(const Real& number) { return static_cast<double>(number); }

using Vec2 = BasicVec2<Real>;
using Vec3 = BasicVec3<Real>;

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
