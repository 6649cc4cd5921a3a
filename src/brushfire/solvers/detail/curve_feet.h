// Curves for methods that start at points: as their points that are nearest to the vertices around them.
#pragma once

#include <brushfire/solvers/detail/engine.h>

#include <vector>

namespace brushfire::detail {

// Puts points in the place of every curve, with its label: its places, and of each of its segments the points nearest
// to the corners of the faces that hold it. From these every such corner is as far as it is from the curve, to
// rounding; what lies farther away is not seen from nearer by, and the error falls with the square of an edge over the
// distance. O(segments).
void replace_curves_by_feet(const Mesh& mesh, std::vector<LocatedSource>& sources);

// Whether the offset changes along one of the curves.
bool any_slope(std::span<const LocatedSource> sources);

// The least that a target inside a face or on an edge reads straight from the curves in its faces, offsets included,
// and whose that is; +inf and kNoIndex where there is none.
struct CurveValue {
  double distance = kInfinity;
  Index label = kNoIndex;
};
CurveValue straight_from_curves(const Mesh& mesh, std::span<const LocatedSource> sources, const PointLocation& target);

// The least that a point reads because it lies in a region (LocatedCurve::inside); +inf and kNoIndex where it does not.
CurveValue from_regions(const Mesh& mesh, std::span<const LocatedSource> sources, const PointLocation& point);

}  // namespace brushfire::detail
