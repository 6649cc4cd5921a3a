// Pairs of segments with the same ends in opposite order.
#include <brushfire/queries/detail/retraced_segments.h>

#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/queries/detail/curve_star.h>

#include <algorithm>

namespace brushfire::detail {
namespace {

// Ends this near to each other, as a share of their face's longest edge, are one: a path that is traced from its other
// end crosses edges at the same places but for rounding, of which hundreds of faces leave 1e-12.
constexpr double kSameEnd = 1e-9;

bool runs_back(const Mesh& mesh, const LocatedCurve& curve, Index face, const CurveSegment& a, const CurveSegment& b) {
  const auto apart = [&](Index p, Index q) {
    return distance_within(mesh, face, curve.places[p].at, curve.places[q].at);
  };
  // Short ones are not one because both of their ends are near.
  const double near = std::min(kSameEnd * longest_edge(mesh, face), 0.25 * a.length / mesh.unit());
  return apart(a.from_place, b.to_place) <= near && apart(a.to_place, b.from_place) <= near;
}

}  // namespace

std::vector<bool> retraced_segments(const Mesh& mesh, const LocatedCurve& curve, const SegmentsByFace& by_face) {
  std::vector<bool> retraced(curve.segments.size(), false);
  for (Index i = 0; i < curve.segments.size(); ++i) {
    const CurveSegment& s = curve.segments[i];
    if (retraced[i] || !(s.length > kNoDirection * longest_edge(mesh, s.face) * mesh.unit())) continue;
    Index back = kNoIndex;
    const auto [first, last] = by_face.equal_range(s.face);
    for (auto other = first; other != last; ++other) {
      const Index j = other->second;
      if (j <= i || j >= back || retraced[j]) continue;
      if (runs_back(mesh, curve, s.face, s, curve.segments[j])) back = j;
    }
    if (back != kNoIndex) retraced[i] = retraced[back] = true;
  }
  return retraced;
}

}  // namespace brushfire::detail
