// Where on a curve, and on which side of it, shortest paths arrive: nearest places and signed distances.
#pragma once

#include <brushfire/mesh/domain.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/window_field.h>

#include <cstdint>
#include <span>
#include <vector>

namespace brushfire {

// Left and right of a curve as it runs through its places, the faces lying counter-clockwise.
enum class CurveSide : std::int8_t { Left = -1, None = 0, Right = 1 };

struct CurveArrival {
  Index source = kNoIndex;  // position in the list of sources; kNoIndex: unreachable
  Index place = kNoIndex;   // in CurveSource::places, where the segment begins; kNoIndex: the source is a point
  double share = 0;         // of the way from that place to the next one that differs, in [0,1]
  CurveSide side = CurveSide::None;
};

// The nearest place on the nearest source for every vertex, [vertex_count], and on which side of the curve the shortest
// path from the vertex arrives there. Where several are equally near, that of the path that path_to() would show.
//
// The rule of sides: a path that arrives inside a segment arrives on its left or on its right. At a place, segments
// leave in directions around it; the path lies between two of them, and its side is that of the first one clockwise:
// left if the curve goes out there, right if it comes in. (So it is also where a curve passes a place more than once.)
// At the end of an open curve it is the side of the line straight on, which halves the directions (on a boundary the
// two sides of the segment, as far as there is surface); on a curve itself, and at a point, there is none.
// Segments that the curve runs over once more, the other way round, part nothing: both of their sides are that of the
// sector in which they lie where the curve's other segments leave them, and a curve without others has no sides.
//
// Around a vertex whose faces form several fans only the segments in the path's own fan count; one that the curve does
// not enter is on the side of its borders, where edges of three and more faces join it to others.
//
// `field`: of an exact run from these sources with DistanceOptions::keep_paths, on this mesh, without walls. Throws
// what WindowField::last_leg() throws, and Error(InvalidArgument) where a path arrives at a vertex in a fan that
// nothing but that vertex joins to those of the curve. O(edges crossed by paths).
std::vector<CurveArrival> arrivals(const WindowField& field, std::span<const Source> sources);
// The same within walls: paths keep to what is open, and sides are those of the whole mesh, from whatever face of it a
// path arrives, whether or not there is a wall along the curve or across it. A vertex on a wall has the arrival of its
// nearest side; of several that are equally near that of the lowest source, and rather not on the left.
// `field`: of an exact run in the domain from these sources with DistanceOptions::keep_paths.
std::vector<CurveArrival> arrivals(const Domain& domain, const DistanceField& field, std::span<const Source> sources);

// Distance with a sign, [vertex_count]: negative on the left of the nearest curve, positive on its right (and where
// there is no side), +inf where unreachable. So the inside of a closed curve that runs counter-clockwise is negative,
// and curves that nest with opposite senses bound what lies between them. An exact run; of `how` max_distance, threads,
// progress and cancel count. Throws Error(InvalidArgument) for a source that is a point, for offsets, and what
// arrivals() and distance() throw.
// Within walls: of the sides that arrivals() tells.
std::vector<double> signed_distance(const Domain& domain, std::span<const Source> curves,
                                    const DistanceOptions& how = {});
// The same from a field: that of an exact run in the domain from these curves, with DistanceOptions::keep_paths.
std::vector<double> signed_distance(const Domain& domain, const DistanceField& field, std::span<const Source> curves);

}  // namespace brushfire
