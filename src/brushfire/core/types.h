// The scalars and small vectors that every floor uses.
#pragma once

#include <array>  // IWYU pragma: export
#include <cmath>
#include <cstdint>  // IWYU pragma: export
#include <limits>

namespace brushfire {

// Numbers vertices, faces and halfedges.
using Index = std::uint32_t;

// "None": no vertex, no face, no source. Reads -1 as a signed 32-bit integer, which is what files and numpy show.
inline constexpr Index kNoIndex = std::numeric_limits<Index>::max();

// The distance of what cannot be reached.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline constexpr double kPi = 3.14159265358979323846;

// The three vertices of a triangle, in order.
using Face = std::array<Index, 3>;

template <class Real>
struct BasicVec2 {
  Real x = 0, y = 0;
  friend constexpr bool operator==(const BasicVec2&, const BasicVec2&) = default;
  friend constexpr BasicVec2 operator+(BasicVec2 a, BasicVec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr BasicVec2 operator-(BasicVec2 a, BasicVec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr BasicVec2 operator*(Real s, BasicVec2 a) { return {s * a.x, s * a.y}; }

  friend constexpr Real dot(BasicVec2 a, BasicVec2 b) { return a.x * b.x + a.y * b.y; }
  // Twice the signed area of (0, a, b): positive where b lies to the left of a.
  friend constexpr Real cross(BasicVec2 a, BasicVec2 b) { return a.x * b.y - a.y * b.x; }
  friend Real norm(BasicVec2 a) {
    using std::sqrt;
    return sqrt(dot(a, a));
  }
};

template <class Real>
struct BasicVec3 {
  Real x = 0, y = 0, z = 0;
  friend constexpr bool operator==(const BasicVec3&, const BasicVec3&) = default;
  friend constexpr BasicVec3 operator+(BasicVec3 a, BasicVec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr BasicVec3 operator-(BasicVec3 a, BasicVec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr BasicVec3 operator*(Real s, BasicVec3 a) { return {s * a.x, s * a.y, s * a.z}; }

  friend constexpr Real dot(BasicVec3 a, BasicVec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend constexpr BasicVec3 cross(BasicVec3 a, BasicVec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend Real norm(BasicVec3 a) {
    using std::sqrt;
    return sqrt(dot(a, a));
  }
};

using Vec2 = BasicVec2<double>;
using Vec3 = BasicVec3<double>;

// Declared here as well, for whoever calls them by their full names.
constexpr double dot(Vec2 a, Vec2 b);
constexpr double cross(Vec2 a, Vec2 b);
double norm(Vec2 a);
constexpr double dot(Vec3 a, Vec3 b);
constexpr Vec3 cross(Vec3 a, Vec3 b);
double norm(Vec3 a);

}  // namespace brushfire
