// Following a ray back to its pseudo-source.
#pragma once

#include <brushfire/solvers/window_field.h>
#include <brushfire/solvers/windows/paths/record.h>

#include <functional>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// Places on an edge are known to a few epsilons of its length. A ray may cross no edge this near (share of the edge) to
// an end or to the point before: what is longer keeps its direction to 1e-7.
inline constexpr Real kTooShort = 1e-8;
// By what angle the ray may miss its pseudo-source: seen from the last edge crossed.
inline constexpr Real kMissed = 1e-7;

// Where a ray, followed backwards, comes into a face over one of its edges. In the frame of the edge's halfedge in it.
struct RayCrossing {
  Index halfedge = kNoIndex;
  Vec2 source;            // the ray's pseudo-source
  Vec2 point;             // on the edge
  bool mirrored = false;  // the face lies the other way round than the one where the trace began
};
using CrossingListener = std::function<bool(const RayCrossing&)>;

// The leg that ends at the point `at` of the face of its halfedge and came along the record's ray. No points
// where rounding could have decided anything about it, or where it is not as long as the values at its ends say:
// find_leg() then has to look. `knows_the_rest`, where given, hears of each crossing and may end the trace there: no
// points either.
WindowField::Leg trace_leg(const WindowFieldData& data, const FaceWeights& at, const PointRecord& record,
                           const CrossingListener& knows_the_rest = {});

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
