// CurveSource: a curve on the surface that distances are measured from, as the true segments that it is made of.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>  // IWYU pragma: export

#include <array>
#include <span>
#include <vector>

namespace brushfire {

// A polyline on the surface: places in order, each joined to the next by the straight segment within a face that holds
// both. It may cross itself, run along edges, through vertices and along the boundary, and stand still; a single place
// is a point. A place that is nowhere (SurfacePoint{}) parts the curve: what comes before and after it are pieces of
// one source.
struct CurveSource {
  std::vector<SurfacePoint> places;
  bool closed = false;  // the last place of every piece is joined to its first, which need not be repeated
  // Values that the front starts with at the places, linear in between; in the mesh's units. [places] (those of places
  // that are nowhere are not looked at), or empty: 0 everywhere.
  std::vector<double> offsets = {};
  // Faces, in any order, that belong to the source with all their points, which begin with the curve's value as well:
  // of a region, whose border the places are. What lies in them is read; a front still starts from the curve alone.
  std::vector<Index> inside = {};
};

// A piece of a curve within one face. Where it runs along an edge, one of the edge's faces names it and all of them see
// it.
struct CurveSegment {
  Index face = kNoIndex;
  std::array<double, 3> from{}, to{};  // weights in the face: two different points
  double from_offset = 0,
         to_offset = 0;  // in the mesh's units; no farther apart than the segment is long, but for rounding
  double length = 0;     // in the mesh's units
  Index from_place = kNoIndex, to_place = kNoIndex;  // in LocatedCurve::places
  bool along_edge = false;
};

// A place of a curve, and the segments that meet there; kNoIndex where the curve begins or ends.
struct CurvePlace {
  PointLocation at;
  double offset = 0;
  Index before = kNoIndex, after = kNoIndex;  // in LocatedCurve::segments
  Index number = kNoIndex;                    // in CurveSource::places, the first of several that are one
};

struct LocatedCurve {
  std::vector<CurvePlace> places;      // without repetitions of the one before, at least one
  std::vector<CurveSegment> segments;  // in order
  double least_offset = 0;
  std::vector<Index> inside;  // ascending

  // Whether one of the faces that hold a point is inside.
  bool holds(const Mesh& mesh, const PointLocation& point) const;
};

// Splits a curve into its segments. Places on edges and vertices are in all of their faces, so consecutive places have
// to share a face, an edge or a vertex, whatever faces they are named by; where they share several, the segment lies in
// the face that names the first, else in that which names the second, else in the lowest. Throws Error(InvalidArgument)
// for a curve without places, for consecutive places that share no face, for a number of offsets other than that of
// places, offsets that are not finite, and offsets that differ by more than the segment between them is long (or at
// all, where two places are equal), and offsets that change where there are faces inside; the message names the places.
// Throws Error(IndexOutOfRange) for a face inside that does not exist. Throws what locate() of a point throws.
// O(places), more at vertices of very many faces.
LocatedCurve locate(const Mesh& mesh, const CurveSource& curve);

}  // namespace brushfire
