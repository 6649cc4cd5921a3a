// Where a curve runs back the way that it came: it has two sides at one place there, and parts nothing.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/curve_source.h>
#include <brushfire/mesh/mesh.h>

#include <unordered_map>
#include <vector>

namespace brushfire::detail {

// Segments by the faces that hold them.
using SegmentsByFace = std::unordered_multimap<Index, Index>;

// Which segments the curve runs over once more, the other way round: pairs with the same two ends, each segment in one
// at most. Geodesic polygons have them wherever two sides leave a corner for the same saddle vertex. [segments].
// O(segments, times how many share a face).
std::vector<bool> retraced_segments(const Mesh& mesh, const LocatedCurve& curve, const SegmentsByFace& by_face);

}  // namespace brushfire::detail
