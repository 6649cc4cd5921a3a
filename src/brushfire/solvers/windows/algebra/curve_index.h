// Which curves are to be seen from which faces.
#pragma once

#include <brushfire/core/detail/sort.h>
#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/windows/algebra/curve_segments.h>
#include <brushfire/solvers/windows/algebra/rays.h>

#include <algorithm>
#include <span>
#include <tuple>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// A segment of a curve in a face, or a place of one that is no vertex, in each of its faces.
struct CurveInFace {
  Index face, source;
  Index segment;  // kNoIndex: a place
  Index place;    // kNoIndex: a segment
};

class CurveIndex {
 public:
  CurveIndex() = default;
  CurveIndex(const Mesh& mesh, std::span<const detail::LocatedSource> sources) {
    for (Index s = 0; s < sources.size(); ++s) {
      if (sources[s].curve) add(mesh, *sources[s].curve, s);
    }
    detail::sort(entries_.begin(), entries_.end(), [](const CurveInFace& a, const CurveInFace& b) {
      return std::tie(a.face, a.source, a.segment, a.place) < std::tie(b.face, b.source, b.segment, b.place);
    });
  }

  std::span<const CurveInFace> in(Index face) const {
    const auto [first, last] = std::equal_range(entries_.begin(), entries_.end(), face, ByFace{});
    return {entries_.data() + (first - entries_.begin()), static_cast<std::size_t>(last - first)};
  }

 private:
  struct ByFace {
    bool operator()(const CurveInFace& a, Index face) const { return a.face < face; }
    bool operator()(Index face, const CurveInFace& a) const { return face < a.face; }
  };

  void add(const Mesh& mesh, const LocatedCurve& curve, Index source) {
    for (Index i = 0; i < curve.segments.size(); ++i) {
      for_each_face_of(mesh, curve, i, 0,
                       [&](const SegmentInFace& s) { entries_.push_back({s.face, source, i, kNoIndex}); });
    }
    for (Index i = 0; i < curve.places.size(); ++i) {
      if (curve.places[i].at.on == PointLocation::On::Vertex) continue;
      for_each_face_around(mesh, curve.places[i].at,
                           [&](const FaceWeights& f) { entries_.push_back({f.face, source, kNoIndex, i}); });
    }
  }

  std::vector<CurveInFace> entries_;  // by face
};

// A place of a curve in a face that holds it, where the index says so.
inline FaceWeights place_in_face(const Mesh& mesh, const LocatedCurve& curve, Index place, Index face) {
  return {face, weights_from(*weights_in(mesh, curve.places[place].at, face))};
}

// The place on a segment at the share t of its length, by its weights.
inline std::array<Real, 3> weights_along(const SegmentInFace& s, Real share) {
  std::array<Real, 3> weights;
  for (std::size_t k = 0; k < 3; ++k) weights[k] = (1 - share) * s.from[k] + share * s.to[k];
  return weights;
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
