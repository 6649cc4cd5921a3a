// The sources at which a leg may start, by vertex and by face.
#pragma once

#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/windows/algebra/curve_segments.h>
#include <brushfire/solvers/windows/paths/leg_origins.h>
#include <brushfire/solvers/windows/paths/wedge.h>

#include <array>
#include <span>
#include <unordered_map>

namespace brushfire::windows {

// Where on a segment of a curve offset and way to the origin are least together, as a share of it:
// LineSource::sight_of().
inline DoubleDouble best_share(const SegmentInFace& s, WideVec2 from, WideVec2 to) {
  const WideVec2 step = to - from;
  const DoubleDouble length = norm(step), slope = (DoubleDouble(s.to_value) - DoubleDouble(s.from_value)) / length;
  const DoubleDouble ahead = -dot(from, step) / length, aside = cross(from, step) / length;
  const DoubleDouble rise2 = (DoubleDouble(1) - slope) * (DoubleDouble(1) + slope);
  const DoubleDouble away = aside.high < 0 ? -aside : aside;
  if (!(rise2.high > 0)) return slope.high > 0 ? 0.0 : 1.0;
  const DoubleDouble share = (ahead - away * slope / sqrt(rise2)) / length;
  return share.high > 0 ? (share < 1.0 ? share : DoubleDouble(1)) : DoubleDouble(0);
}

// Of curves only their places at vertices: the others are looked up in a CurveIndex.
class LegSources {
 public:
  struct Inside {
    Index source;
    std::array<double, 3> weights;
  };
  struct AtVertex {
    Index source;
    double offset;  // of the place, beyond that of the source
  };

  LegSources(const Mesh& mesh, std::span<const detail::LocatedSource> sources) {
    for (Index s = 0; s < sources.size(); ++s) {
      if (sources[s].curve) {
        add_places(*sources[s].curve, s);
        continue;
      }
      const PointLocation& place = sources[s].at;
      if (place.on == PointLocation::On::Vertex) {
        at_.emplace(place.vertex, AtVertex{s, 0});
        continue;
      }
      for (const PointInFace& f : names_of(mesh, place)) in_.emplace(f.face, Inside{s, f.weights});
    }
  }

  auto at(Index vertex) const { return at_.equal_range(vertex); }
  auto in(Index face) const { return in_.equal_range(face); }

 private:
  void add_places(const LocatedCurve& curve, Index source) {
    for (const CurvePlace& p : curve.places) {
      if (p.at.on == PointLocation::On::Vertex) at_.emplace(p.at.vertex, AtVertex{source, p.offset});
    }
  }

  std::unordered_multimap<Index, Inside> in_;
  std::unordered_multimap<Index, AtVertex> at_;
};

}  // namespace brushfire::windows
