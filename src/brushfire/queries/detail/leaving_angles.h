// The directions in which paths leave one point, and vectors in its tangent plane.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/queries/detail/tangent_fan.h>
#include <brushfire/solvers/window_field.h>
#include <brushfire/solvers/windows/paths/departures.h>

#include <array>
#include <utility>
#include <vector>

namespace brushfire::detail {

class LeavingAngles {
 public:
  // Throws Error(InvalidArgument) for a vertex whose faces form neither a circle nor an arc.
  LeavingAngles(const Mesh& mesh, const SurfacePoint& source);
  // At any vertex, in the fan of the faces that hang together with one of them.
  LeavingAngles(const Mesh& mesh, const SurfacePoint& vertex, Index face);

  double total() const { return at_vertex() ? fan_.total : 2 * kPi; }
  // Directions go all the way around.
  bool closed() const { return !at_vertex() || fan_.closed; }
  bool is_source(Index vertex) const { return at_vertex() && vertex == source_.vertex; }

  // Of a leg; of one that does not start at the source, nothing.
  windows::TracedRays::Angle of(const WindowField::Leg& leg) const;
  // An angle within the full turn.
  double within_turn(double angle) const;
  // Of a path whose second point this is; an angle as straightest() takes it.
  double towards(const SurfacePoint& point) const;
  // From a vertex, in the faces of its fan that hold the point: none, or several where it is on an edge.
  std::vector<double> all_towards(const SurfacePoint& point) const;
  // The other ends of the edges where an open fan begins and ends.
  std::vector<Index> borders() const;
  // Whether angles grow counter-clockwise.
  bool grow_counter_clockwise() const { return fan_.grows_counter_clockwise(); }

  // A direction as a vector of this length, and back. Around an inner vertex, where the full turn is not 2 pi, angles
  // are scaled to it; on a boundary they stay what they are, and what points outside comes back along the border.
  Vec2 vector(double angle, double length) const;
  std::pair<double, double> polar(Vec2 v) const;  // angle, length

 private:
  bool at_vertex() const { return source_.on == PointLocation::On::Vertex; }
  double sense_in(Index face) const;
  Index halfedge_in(Index face) const;
  bool runs_as_own(Index halfedge) const { return mesh_.from(halfedge) == mesh_.from(source_.halfedge); }
  double base_direction() const;
  double in_corner(Index corner, Vec2 d, const std::array<Vec2, 3>& corners) const;
  double over_own_edge(Index f, const std::array<Vec2, 3>& c, Vec2 d) const;

  const Mesh& mesh_;
  PointLocation source_;
  TangentFan fan_;
};

}  // namespace brushfire::detail
