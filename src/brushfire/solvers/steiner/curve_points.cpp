// Points along segments, as dense as those that they are searched with.
#include <brushfire/solvers/steiner/detail/curve_points.h>

#include <brushfire/core/error.h>
#include <brushfire/solvers/detail/curve_feet.h>

#include <algorithm>
#include <optional>

namespace brushfire::steiner {
namespace {

SurfacePoint point_on(const CurveSegment& s, double share) {
  SurfacePoint p{s.face, {}};
  for (std::size_t k = 0; k < 3; ++k) p.weights[k] = (1 - share) * s.from[k] + share * s.to[k];
  return p;
}

// The shares of the way along a segment at which the points of its edge lie, its ends left out. `middle`: of the
// segment, on mesh.mesh(), where it lies on an edge.
std::vector<double> shares_on_edge(const WeightedMesh& mesh, const PointLayout& layout, const CurveSegment& s,
                                   const PointLocation& middle) {
  const Index h = middle.halfedge, edge = mesh.edges().edge(h), first = mesh.edges().halfedge(edge);
  const double length = mesh.mesh().lengths()[h];
  const Face& corners = mesh.domain().mesh().faces()[s.face];
  // Whose weight in the segment's face is the place on the edge.
  const auto end = static_cast<std::size_t>(
      std::find(corners.begin(), corners.end(), mesh.vertex(mesh.mesh().to(first))) - corners.begin());
  std::vector<double> shares;
  if (!(length > 0) || end == 3) return shares;
  for (Index i = 0; i < layout.count(edge); ++i) {
    const double share = (layout.at_row(edge)[i] / length - s.from[end]) / (s.to[end] - s.from[end]);
    if (share > 0 && share < 1) shares.push_back(share);
  }
  return shares;
}

std::vector<double> shares_in_face(const WeightedMesh& mesh, const PointLayout& layout, const CurveSegment& s,
                                   Index face) {
  double longest = 0;
  Index points = 1;
  for (Index h = 3 * face; h < 3 * face + 3; ++h) {
    longest = std::max(longest, mesh.mesh().lengths()[h] * mesh.mesh().unit());
    points = std::max(points, layout.count(mesh.edges().edge(h)));
  }
  const double length = s.length * mesh.domain().mesh().unit();
  const auto count = std::clamp<Index>(static_cast<Index>(points * (length / longest)), 1, points);
  std::vector<double> shares;
  for (Index i = 1; i <= count; ++i) shares.push_back(static_cast<double>(i) / (count + 1));
  return shares;
}

void add_points(const WeightedMesh& mesh, const PointLayout& layout, const detail::LocatedSource& source,
                std::vector<PointSource>& points) {
  const Mesh& whole = mesh.domain().mesh();
  for (const CurveSegment& s : source.curve->segments) {
    const std::vector<SurfacePoint> sides = mesh.on_open(point_on(s, 0.5));
    if (!whole.is_face_usable(s.face) || sides.empty()) continue;
    const PointLocation middle = locate(mesh.mesh(), sides.front());
    const std::vector<double> shares = middle.on == PointLocation::On::Edge
                                           ? shares_on_edge(mesh, layout, s, middle)
                                           : shares_in_face(mesh, layout, s, sides.front().face);
    for (const double share : shares) points.push_back({point_on(s, share), source.offset, source.label});
  }
}

}  // namespace

std::vector<PointSource> with_points_of_curves(const WeightedMesh& mesh, const PointLayout* layout,
                                               std::span<const Source> sources) {
  std::vector<PointSource> points;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const auto label = static_cast<Index>(i);
    if (!sources[i].curve) {
      points.push_back({sources[i].point, sources[i].offset, label});
      continue;
    }
    std::vector<detail::LocatedSource> feet{detail::located(mesh.domain().mesh(), sources[i], label)};
    if (detail::any_slope(feet)) {
      throw Error(ErrorCode::InvalidArgument, "source " + std::to_string(i) +
                                                  ": offsets that change along a curve are for distances, not for "
                                                  "costs");
    }
    add_points(mesh, *layout, feet.front(), points);
    detail::replace_curves_by_feet(mesh.domain().mesh(), feet);
    for (const detail::LocatedSource& f : feet) points.push_back({{f.at.face, f.at.weights}, f.offset, label});
  }
  return points;
}

}  // namespace brushfire::steiner
