// The faces around a vertex in order, with the angles that they take.
#pragma once

#include <brushfire/mesh/mesh.h>

#include <vector>

namespace brushfire::detail {

struct FanCorner {
  Index corner = kNoIndex;  // the halfedge that starts at the vertex
  bool reversed = false;    // the fan enters this face over the corner's other edge
  double start = 0;         // where the face begins, measured around the vertex
  double angle = 0;         // how much it takes
};

struct TangentFan {
  std::vector<FanCorner> corners;
  double total = 0;
  bool closed = false;

  bool grows_counter_clockwise() const { return corners.empty() || !corners.front().reversed; }
  // The fan's angle of a direction `inside` from the edge along `corner`; the corner must be in the fan.
  double around(Index corner, double inside) const;
  // The corner that holds an angle, and the angle from the edge along that corner. 0 <= angle <= total.
  std::pair<Index, double> at(double angle) const;
};

// Throws Error(InvalidArgument) for a vertex whose faces form neither a circle nor an arc.
TangentFan tangent_fan(const Mesh& mesh, Index vertex);

// Of any vertex, the faces around it that hang together with one of them over edges of two faces. `corner`: the
// halfedge of a usable face that starts at the vertex.
TangentFan tangent_fan_of(const Mesh& mesh, Index corner);

}  // namespace brushfire::detail
