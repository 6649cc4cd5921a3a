// A curve as points along it: what no way to the curve is longer than.
#pragma once

#include <brushfire/mesh/curve_source.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/distance.h>

#include <algorithm>
#include <vector>

namespace brushfire::test {

// Sources on every segment of a curve, `pieces` pieces apart.
inline std::vector<Source> samples(const Mesh& mesh, const CurveSource& curve, int pieces) {
  std::vector<Source> points;
  const LocatedCurve located = locate(mesh, curve);
  for (const CurveSegment& s : located.segments) {
    for (int i = 0; i <= pieces; ++i) {
      const double t = static_cast<double>(i) / pieces;
      Source point{{s.face, {0, 0, 0}}, (1 - t) * s.from_offset + t * s.to_offset};
      for (std::size_t k = 0; k < 3; ++k) point.point.weights[k] = (1 - t) * s.from[k] + t * s.to[k];
      points.push_back(point);
    }
  }
  if (located.segments.empty()) points.push_back({curve.places.front(), located.least_offset});
  return points;
}

inline double longest_segment(const Mesh& mesh, const CurveSource& curve) {
  double longest = 0;
  for (const CurveSegment& s : locate(mesh, curve).segments) longest = std::max(longest, s.length);
  return longest;
}

}  // namespace brushfire::test
