// What the update asks of a value type, for plain numbers: the same source is compiled for one source and for several,
// one to a lane.
#pragma once

#include <brushfire/core/detail/inline.h>

#include <cmath>
#include <cstdint>
#include <type_traits>

namespace brushfire::carried_source {

// A value type V has the arithmetic operators and comparisons that give a Mask<V>, is made from a number of the mesh by
// V(number), and has root(), lesser(), magnitude(), select(mask, a, b). A Mask has &, |, ^, without(a, b) = b and not
// a, and any().
template <class V>
struct ValueTraits;

template <>
struct ValueTraits<float> {
  using Scalar = float;
  using Sectors = std::uint16_t;
};
template <>
struct ValueTraits<double> {
  using Scalar = double;
  using Sectors = std::uint16_t;
};

template <class V>
using ScalarOf = typename ValueTraits<V>::Scalar;
template <class V>
using SectorsOf = typename ValueTraits<V>::Sectors;

BRUSHFIRE_INLINE float root(float a) { return std::sqrt(a); }
BRUSHFIRE_INLINE double root(double a) { return std::sqrt(a); }
BRUSHFIRE_INLINE float lesser(float a, float b) { return a < b ? a : b; }
BRUSHFIRE_INLINE double lesser(double a, double b) { return a < b ? a : b; }
BRUSHFIRE_INLINE float magnitude(float a) { return std::abs(a); }
BRUSHFIRE_INLINE double magnitude(double a) { return std::abs(a); }
BRUSHFIRE_INLINE float select(bool mask, float a, float b) { return mask ? a : b; }
BRUSHFIRE_INLINE double select(bool mask, double a, double b) { return mask ? a : b; }
BRUSHFIRE_INLINE bool without(bool a, bool b) { return b && !a; }
BRUSHFIRE_INLINE bool any(bool mask) { return mask; }

// The lanes whose sector is in a set of sectors, a bit for each. V says of which width the mask is.
template <class V>
BRUSHFIRE_INLINE std::enable_if_t<std::is_floating_point_v<V>, bool> are_in(std::uint16_t sectors, std::uint16_t set) {
  return (sectors & set) != 0;
}

}  // namespace brushfire::carried_source
