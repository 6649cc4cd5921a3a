// The segments of a curve, by all faces that see them.
#pragma once

#include <brushfire/mesh/curve_source.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/windows/algebra/face_shape.h>

#include <array>
#include <optional>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// A segment of a curve in one face, by the weights of its ends and the values there.
struct SegmentInFace {
  Index face;
  std::array<Real, 3> from, to;
  Real from_value, to_value;
};

// Segment i of a curve in a face of the mesh, where the face holds it; `start` is added to the curve's offsets.
inline std::optional<SegmentInFace> segment_in_face(const Mesh& mesh, const LocatedCurve& curve, Index i, Index face,
                                                    Real start) {
  const CurveSegment& s = curve.segments[i];
  const Real from_value = start + s.from_offset, to_value = start + s.to_offset;
  if (s.face == face) return SegmentInFace{face, weights_from(s.from), weights_from(s.to), from_value, to_value};
  if (!s.along_edge) return std::nullopt;
  const auto from = weights_in(mesh, curve.places[s.from_place].at, face);
  const auto to = weights_in(mesh, curve.places[s.to_place].at, face);
  if (!from || !to) return std::nullopt;
  return SegmentInFace{face, weights_from(*from), weights_from(*to), from_value, to_value};
}

// visit(SegmentInFace) for each face that holds segment i: one, or all at the edge along which it lies.
template <class Visit>
void for_each_face_of(const Mesh& mesh, const LocatedCurve& curve, Index i, Real start, Visit&& visit) {
  const CurveSegment& s = curve.segments[i];
  visit(*segment_in_face(mesh, curve, i, s.face, start));
  if (!s.along_edge) return;
  Index h = 3 * s.face;  // the edge: that without the corner that has no share in either end
  for (Index k = 0; k < 3; ++k) {
    if (s.from[k] == 0 && s.to[k] == 0) h = 3 * s.face + (k + 1) % 3;
  }
  const auto opposite = mesh.opposite();
  for (Index g = opposite[h]; g != h; g = opposite[g]) {
    if (const auto segment = segment_in_face(mesh, curve, i, Mesh::face_of(g), start)) visit(*segment);
  }
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
