// How the curvature of the surface corrects that of fronts.
#pragma once

#include <cmath>
#include <type_traits>

namespace brushfire::fast_marching {

// What the surface around a vertex lacks to be flat, and a third of the area of the faces there.
struct AngleDeficit {
  float angle = 0;  // 2 pi less the sum of the angles; 0 where the vertex is no inner one, or flat to kFlat
  float area = 0;

  AngleDeficit& operator+=(const AngleDeficit& other) {
    angle += other.angle, area += other.area;
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
inline float curvature_correction(const AngleDeficit& own, const AngleDeficit& around) {
  return around.area > 0 ? kStep * around.angle / around.area * std::sqrt(own.area) : 0;
}

}  // namespace brushfire::fast_marching
