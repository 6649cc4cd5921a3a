// Random curves on a mesh, of every kind, and how far a point is from one in the plane.
#pragma once

#include <brushfire/mesh/curve_source.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/queries/straightest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "support/random_points.h"

namespace brushfire::test {

// A vertex, a point of an edge or a point inside face f.
inline SurfacePoint any_point_in(Index f, std::mt19937& random) {
  const auto k = static_cast<std::size_t>(random() % 3);
  const double a = uniform(random), b = (1 - a) * uniform(random);
  SurfacePoint p{f, {0, 0, 0}};
  switch (random() % 3) {
    case 0:
      p.weights[k] = 1;
      break;
    case 1:
      p.weights[k] = a;
      p.weights[(k + 1) % 3] = 1 - a;
      break;
    default:
      p.weights = {a, b, 1 - a - b};
  }
  return p;
}

// From place to place through faces that hold them: along edges, through vertices and across itself, with places that
// are repeated.
inline std::vector<SurfacePoint> random_walk(const Mesh& mesh, int places, std::mt19937& random) {
  std::vector<SurfacePoint> walk{any_point(mesh, random)};
  while (static_cast<int>(walk.size()) < places) {
    const std::vector<Index> faces = faces_at(mesh, locate(mesh, walk.back()));
    walk.push_back(random() % 8 == 0 ? walk.back() : any_point_in(faces[random() % faces.size()], random));
  }
  return walk;
}

// Straight sides over many faces.
inline std::vector<SurfacePoint> random_polygon(const Mesh& mesh, int sides, double length, std::mt19937& random) {
  std::vector<SurfacePoint> polygon{any_point(mesh, random)};
  for (int i = 0; i < sides; ++i) {
    const Trace side = straightest(mesh, polygon.back(), 2 * kPi * uniform(random), length * uniform(random));
    polygon.insert(polygon.end(), side.path.points.begin() + (side.path.points.empty() ? 0 : 1),
                   side.path.points.end());
  }
  return polygon;
}

// One where the curve can be closed, there and back again where it is.
inline CurveSource random_curve(const Mesh& mesh, double length, std::mt19937& random) {
  CurveSource curve;
  curve.places = random() % 2 == 0 ? random_walk(mesh, 2 + static_cast<int>(random() % 12), random)
                                   : random_polygon(mesh, 1 + static_cast<int>(random() % 4), length, random);
  if (random() % 4 == 0) {
    for (std::size_t i = curve.places.size(); i-- > 0;) curve.places.push_back(curve.places[i]);
    curve.closed = true;
  }
  return curve;
}

// Offsets that a curve can have: any that differ by no more than its segments are long.
inline void give_offsets(const Mesh& mesh, CurveSource& curve, std::mt19937& random) {
  const LocatedCurve located = locate(mesh, curve);
  curve.offsets.assign(curve.places.size(), uniform(random));
  // Along the curve: a random wave that is flat enough everywhere, and the same at equal places.
  const double slope = uniform(random), x = uniform(random), y = uniform(random), z = uniform(random);
  const Vec3 direction = (slope / norm(Vec3{x, y, z})) * Vec3{x, y, z};
  for (std::size_t i = 0; i < curve.places.size(); ++i) {
    const Vec3 p = position(mesh, curve.places[i]);
    curve.offsets[i] += dot(direction, p);
  }
}

// The least of value and straight way from a segment to p, for values that change linearly along it.
inline double planar_distance(Vec3 p, Vec3 a, Vec3 b, double value_a, double value_b) {
  const double at_ends = std::min(value_a + norm(p - a), value_b + norm(p - b)), length = norm(b - a);
  if (!(length > 0)) return at_ends;
  const Vec3 along = (1 / length) * (b - a);
  const double slope = std::clamp((value_b - value_a) / length, -1.0, 1.0);
  const double ahead = dot(p - a, along), away = norm(cross(along, p - a)), rise = std::sqrt(1 - slope * slope);
  if (!(rise > 0)) return at_ends;
  const double foot = ahead - away * slope / rise;
  return foot > 0 && foot < length ? value_a + slope * ahead + rise * away : at_ends;
}
inline double planar_distance(const Mesh& mesh, const CurveSource& curve, Vec3 p) {
  double least = kInfinity;
  const std::size_t n = curve.places.size();
  const auto offset = [&](std::size_t i) { return curve.offsets.empty() ? 0 : curve.offsets[i]; };
  for (std::size_t i = 0; i + (curve.closed || n == 1 ? 0 : 1) < n; ++i) {
    const std::size_t j = (i + 1) % n;
    const Vec3 a = position(mesh, curve.places[i]), b = position(mesh, curve.places[j]);
    least = std::min(least, planar_distance(p, a, b, offset(i), offset(j)));
  }
  return least;
}

}  // namespace brushfire::test
