// Developments of cones, cylinders and cubes.
#include "oracle/closed_forms.h"

#include <algorithm>
#include <array>
#include <vector>

namespace brushfire::oracle {
namespace {

struct Spot {
  Real x = 0, y = 0, z = 0;
};

// A symmetry of the cube that brings the face that holds `a` to the floor z = 0.
Spot to_floor(const Vec3& a, Spot p) {
  if (a.z == 0) return p;
  if (a.z == 1) return {p.x, p.y, 1 - p.z};
  if (a.x == 0) return {p.z, p.y, p.x};
  if (a.x == 1) return {p.z, p.y, 1 - p.x};
  if (a.y == 0) return {p.x, p.z, p.y};
  return {p.x, p.z, 1 - p.y};
}

// The cube stands on [i,i+1] x [j,j+1]; one quarter turn over one of the four edges on the floor.
Spot rolled(int way, Real i, Real j, Spot p) {
  switch (way) {
    case 0:
      return {i + 1 + p.z, p.y, i + 1 - p.x};
    case 1:
      return {i - p.z, p.y, p.x - i};
    case 2:
      return {p.x, j + 1 + p.z, j + 1 - p.y};
    default:
      return {p.x, j - p.z, p.y - j};
  }
}

struct Roll {
  Spot from, goal;
  std::array<Spot, 6> centres;  // of the faces: which one lies on the floor
  Real best = kFar;

  void go(Real i, Real j, unsigned seen) {
    for (unsigned f = 0; f < 6; ++f) {
      if (centres[f].z != 0) continue;
      if (seen >> f & 1) return;
      seen |= 1U << f;
      break;
    }
    if (goal.z == 0) best = std::min(best, std::hypot(goal.x - from.x, goal.y - from.y));
    constexpr std::array<std::array<int, 2>, 4> kStep{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (int way = 0; way < 4; ++way) {
      Roll next = *this;
      next.goal = rolled(way, i, j, goal);
      for (Spot& c : next.centres) c = rolled(way, i, j, c);
      next.go(i + kStep[way][0], j + kStep[way][1], seen);
      best = std::min(best, next.best);
    }
  }
};

}  // namespace

Real cone_distance(Real a, Real b, Real turn, Real total) {
  const Real angle = std::min(turn, total - turn);
  if (angle >= kHalfTurn) return a + b;
  const Real half = std::sin(angle / 2);
  return std::sqrt((a - b) * (a - b) + 4 * a * b * half * half);
}

Real cylinder_distance(Real turn, Real rise) { return std::hypot(turn, rise); }

Real cube_distance(const Vec3& a, const Vec3& b) {
  const auto spot = [](const Vec3& p) { return Spot{p.x, p.y, p.z}; };
  Roll roll{to_floor(a, spot(a)), to_floor(a, spot(b)), {}, kFar};
  roll.centres = {Spot{0.5, 0.5, 0}, {0.5, 0.5, 1}, {0, 0.5, 0.5}, {1, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 1, 0.5}};
  roll.go(0, 0, 0);
  return roll.best;
}

}  // namespace brushfire::oracle
