// How the curvature of the surface bends fronts.
#pragma once

#include <brushfire/core/detail/planar.h>
#include <brushfire/core/types.h>
#include <brushfire/solvers/fast_marching/detail/vector_target.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

namespace brushfire::fast_marching {

// What the surface around a vertex lacks to be flat, and a third of the area of the faces there.
struct Patch {
  float deficit = 0;  // 2 pi less the sum of the angles; 0 where the vertex is no inner one, or flat to kFlat
  float area = 0;

  Patch& operator+=(const Patch& other) {
    deficit += other.deficit, area += other.area;
    return *this;
  }
};

// What rounding and quick_angle() make of a flat vertex is less.
template <class T>
inline constexpr double kFlat = std::is_same_v<T, float> ? 4e-6 : 1e-6;

// From one vertex to the next a front makes half an altitude in the mean: of the square root of a vertex's area.
inline constexpr float kStep = 0.4f;

// Gaussian curvature around a vertex (missing angle over area, of the vertex and its neighbours together) times the way
// that a front makes from one vertex to the next: what a front's own curvature loses there.
inline float front_bend(const Patch& own, const Patch& around) {
  return around.area > 0 ? kStep * around.deficit / around.area * std::sqrt(own.area) : 0;
}

// Of the arc tangent, by odd powers from the highest on.
// Based on: Abramowitz, Stegun (1964), Handbook of Mathematical Functions, 4.4.49.
inline constexpr std::array kAngleSeries{0.0028662257,  -0.0161657367, 0.0429096138,
                                         -0.0752896400, 0.1065626393,  -0.1420889944,
                                         0.1999355085,  -0.3333314528, 1.0};

// atan2(y, x) for y >= 0 to 2e-8 and rounding, without branches; 0 for (0, 0).
template <class T>
BRUSHFIRE_INLINE T quick_angle(T x, T y) {
  const T ax = std::abs(x);
  const T larger = ax > y ? ax : y, smaller = ax > y ? y : ax;
  const T t = smaller / (larger > 0 ? larger : 1), u = t * t;
  T p = static_cast<T>(kAngleSeries.front());
  for (std::size_t i = 1; i < kAngleSeries.size(); ++i) p = p * u + static_cast<T>(kAngleSeries[i]);
  const T octant = p * t;
  const T quadrant = y > ax ? T(0.5 * kPi) - octant : octant;
  return x < 0 ? T(kPi) - quadrant : quadrant;
}

}  // namespace brushfire::fast_marching
