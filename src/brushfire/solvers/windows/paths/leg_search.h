// Finding the last leg of a path by looking, where the ray that was kept does not lead anywhere for sure.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/window_field.h>
#include <brushfire/solvers/windows/algebra/curve_index.h>

#include <functional>
#include <span>

namespace brushfire::windows {

// A point, and what a run knows of it and of the vertices. Lengths in mesh.unit(), offsets included in values.
struct LegQuestion {
  const Mesh& mesh;
  std::span<const detail::LocatedSource> sources;
  const CurveIndex& curves;                          // of these
  double shift = 0;                                  // what was added to every value
  const std::function<double(Index)>& vertex_value;  // NaN: not known
  PointLocation at;
  double value = 0;
  double room = 0;  // by which the leg and the value where it starts may miss that
  // The same for a leg of a length from a source, which is the whole path: kAgreement of the length and this.
  double rounding = 0;
  // Where the value seems to have come from. It is looked at first, and no more than that.
  Index pseudo_source = kNoIndex;  // vertex, or vertex count + position of the source
  Index halfedge =
      kNoIndex;  // of a face that holds the point: over this edge, from `from` in its frame; or from nowhere
  Vec2 from;
  bool parallel = false;  // `from` is a direction
};

// The leg that ends at the point: straight to a vertex or a source from which it explains the value; proven by its
// length, in numbers of 106 bits. Where nothing explains the value (to `room`), the shortest that was found. No
// points where there is none. Its length is in mesh.unit().
WindowField::Leg find_leg(const LegQuestion& question);

// By what share of its length a path may miss the value at its end.
inline constexpr double kAgreement = 1e-12;

// A leg that passes a vertex at this share of the way to the nearer of its ends goes through it: the bend that this
// makes cannot be told from straight.
inline constexpr double kThrough = 1e-9;

}  // namespace brushfire::windows
