// The sources at which a leg may start, by vertex and by face.
#pragma once

#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/windows/paths/leg_origins.h>

#include <array>
#include <span>
#include <unordered_map>

namespace brushfire::windows {

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
