// Random triangulations of a square, and simple polygons on them that go through faces, along edges and over vertices.
#pragma once

#include <brushfire/mesh/curve_source.h>
#include <brushfire/mesh/delaunay.h>
#include <brushfire/queries/path.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "curves/random_curves.h"

namespace brushfire::test {

inline Mesh random_triangulation(std::mt19937& random) {
  std::vector<Vec2> points;
  for (int i = 0; i < 40; ++i) points.push_back({uniform(random), uniform(random)});
  return delaunay(points).mesh();
}

inline bool is_inside(const std::vector<Vec3>& polygon, const Vec3& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec3 &a = polygon[i], &b = polygon[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
  }
  return inside;
}

inline double area(const std::vector<Vec3>& polygon) {
  double twice = 0;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    twice += (polygon[j].x - polygon[i].x) * (polygon[j].y + polygon[i].y);
  }
  return 0.5 * twice;
}

// The corners of a star-shaped polygon, counter-clockwise, at vertices, on edges and inside faces.
inline std::vector<SurfacePoint> star_shaped(const Mesh& mesh, std::mt19937& random) {
  std::vector<SurfacePoint> corners;
  Vec3 middle;
  const std::size_t count = 3 + random() % 7;
  for (std::size_t i = 0; i < count; ++i) {
    corners.push_back(any_point(mesh, random));
    middle = middle + (1.0 / static_cast<double>(count)) * position(mesh, corners.back());
  }
  const auto angle = [&](const SurfacePoint& p) {
    const Vec3 d = position(mesh, p) - middle;
    return std::atan2(d.y, d.x);
  };
  std::sort(corners.begin(), corners.end(), [&](const auto& a, const auto& b) { return angle(a) < angle(b); });
  return corners;
}

// Its sides as shortest paths; clockwise where it is turned.
struct SimplePolygon {
  CurveSource curve;
  std::vector<Vec3> corners;

  SimplePolygon(const Mesh& mesh, std::mt19937& random, bool turned) {
    PathFinder paths(mesh);
    do {  // there and back along one line has no inside
      curve = {paths.through(star_shaped(mesh, random), true).points, true};
      corners.clear();
      for (const SurfacePoint& p : curve.places) corners.push_back(position(mesh, p));
    } while (!(std::abs(area(corners)) > 1e-6));
    if (turned) std::reverse(curve.places.begin(), curve.places.end());
  }
  bool holds(const Vec3& p) const { return is_inside(corners, p); }
};

}  // namespace brushfire::test
