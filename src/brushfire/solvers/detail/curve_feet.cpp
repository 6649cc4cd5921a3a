// Feet of vertices and targets on segments, in one face laid flat.
#include <brushfire/solvers/detail/curve_feet.h>

#include <brushfire/mesh/detail/flat_face.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace brushfire::detail {
namespace {

struct Foot {
  double share = 0;  // of the way along the segment
  double value = 0;  // offset there and straight way
};

// Where the least of offset and straight way from `to` (weights in the segment's face) comes from. The ends of the
// segment by their weights in that face.
Foot foot_on(const Mesh& mesh, const CurveSegment& s, const std::array<double, 3>& to) {
  const std::array<Vec2, 3> corners = flat_corners(mesh, s.face);
  const Vec2 along = flat_difference(corners, s.from, s.to), way = flat_difference(corners, s.from, to);
  const double length = norm(along), rise = s.to_offset - s.from_offset;
  const double ahead = dot(way, along) / length, away = std::abs(cross(along, way)) / length;
  const double slope = std::clamp(rise / length, -1.0, 1.0), steep = std::sqrt((1 - slope) * (1 + slope));
  const double lean = slope == 0 ? 0 : steep > 0 ? away * slope / steep : std::copysign(kInfinity, slope);
  const double share = std::clamp((ahead - lean) / length, 0.0, 1.0);
  return {share, s.from_offset + share * rise + std::hypot(ahead - share * length, away)};
}

// The segment as another face at the edge sees it.
CurveSegment in_face(const Mesh& mesh, const LocatedCurve& curve, CurveSegment s, Index face) {
  s.from = *weights_in(mesh, curve.places[s.from_place].at, face);
  s.to = *weights_in(mesh, curve.places[s.to_place].at, face);
  s.face = face;
  return s;
}

// visit(segment) as each of its faces sees it.
template <class Visit>
void for_each_face(const Mesh& mesh, const LocatedCurve& curve, const CurveSegment& s, Visit&& visit) {
  visit(s);
  if (!s.along_edge) return;
  for (Index k = 0; k < 3; ++k) {
    if (s.from[k] > 0 || s.to[k] > 0) continue;
    const Index h = 3 * s.face + (k + 1) % 3;
    for (Index g = mesh.opposite(h); g != h; g = mesh.opposite(g)) visit(in_face(mesh, curve, s, Mesh::face_of(g)));
  }
}

SurfacePoint point_on(const CurveSegment& s, double share) {
  SurfacePoint p{s.face, {}};
  for (std::size_t k = 0; k < 3; ++k) p.weights[k] = (1 - share) * s.from[k] + share * s.to[k];
  return p;
}

void add_feet(const Mesh& mesh, const LocatedSource& source, std::vector<LocatedSource>& points) {
  const LocatedCurve& curve = *source.curve;
  for (const CurvePlace& p : curve.places) points.push_back({p.at, source.offset + p.offset, source.label});
  for (const CurveSegment& segment : curve.segments) {
    if (!mesh.is_face_usable(segment.face)) continue;
    for_each_face(mesh, curve, segment, [&](const CurveSegment& s) {
      for (std::size_t k = 0; k < 3; ++k) {
        std::array<double, 3> corner{0, 0, 0};
        corner[k] = 1;
        const double share = foot_on(mesh, s, corner).share;
        if (share <= 0 || share >= 1) continue;  // a place
        const double offset = s.from_offset + share * (s.to_offset - s.from_offset);
        points.push_back({locate(mesh, point_on(s, share), 0), source.offset + offset, source.label});
      }
    });
  }
}

}  // namespace

void replace_curves_by_feet(const Mesh& mesh, std::vector<LocatedSource>& sources) {
  if (!any_curve(sources)) return;
  std::vector<LocatedSource> points;
  for (LocatedSource& s : sources) {
    if (s.curve) {
      add_feet(mesh, s, points);
    } else {
      points.push_back(std::move(s));
    }
  }
  sources = std::move(points);
}

bool any_slope(std::span<const LocatedSource> sources) {
  return std::any_of(sources.begin(), sources.end(), [](const LocatedSource& s) {
    if (!s.curve) return false;
    const auto differs = [&](const CurvePlace& p) { return p.offset != s.curve->places.front().offset; };
    return std::any_of(s.curve->places.begin(), s.curve->places.end(), differs);
  });
}

CurveValue straight_from_curves(const Mesh& mesh, std::span<const LocatedSource> sources, const PointLocation& target) {
  CurveValue best;
  for (const LocatedSource& source : sources) {
    if (!source.curve) continue;
    for (const CurveSegment& segment : source.curve->segments) {
      if (!mesh.is_face_usable(segment.face)) continue;
      for_each_face(mesh, *source.curve, segment, [&](const CurveSegment& s) {
        const auto weights = weights_in(mesh, target, s.face);
        if (!weights) return;
        const double value = source.offset + foot_on(mesh, s, *weights).value;
        if (std::pair(value, source.label) < std::pair(best.distance, best.label)) best = {value, source.label};
      });
    }
  }
  return best;
}

CurveValue from_regions(const Mesh& mesh, std::span<const LocatedSource> sources, const PointLocation& point) {
  CurveValue best;
  for (const LocatedSource& source : sources) {
    if (!source.curve || !source.curve->holds(mesh, point)) continue;
    if (std::pair(source.offset, source.label) < std::pair(best.distance, best.label)) {
      best = {source.offset, source.label};
    }
  }
  return best;
}

}  // namespace brushfire::detail
