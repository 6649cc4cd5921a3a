// A path over a weighted mesh as places that may slide along edges and legs between them.
#pragma once

#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/steiner/detail/run.h>

#include <span>
#include <vector>

namespace brushfire::weighted {

using steiner::WeightedMesh;

// Where a path turns. At a fence it arrives on one side and goes on from the other.
struct Stop {
  enum class On : std::uint8_t { Place, Vertex, Edge };
  On on = On::Place;
  PointLocation place;                               // On::Place: stays
  Index vertex = kNoIndex, vertex_after = kNoIndex;  // On::Vertex
  Index edge = kNoIndex, edge_after = kNoIndex;      // On::Edge
  double at = 0;                                     // along `edge`, from its start; mesh.unit()
  bool mirrored = false;                             // edge_after runs the other way
  double toll = 0;                                   // of the fences that are crossed here

  bool slides() const { return on == On::Edge; }
};

// Straight in a face, or along an edge.
struct StripLeg {
  Index face = kNoIndex;  // kNoIndex: along `edge`
  Index edge = kNoIndex;  // kNoIndex: in `face`
  double weight = 0;
};

struct Strip {
  std::vector<Stop> stops;
  std::vector<StripLeg> legs;  // [stops - 1]
};

Stop at_vertex(Index v);
Stop on_edge(Index e, double at);
Stop at_place(const PointLocation& place);  // a vertex where it is one

// The cheapest leg between two stops that have a face or an edge in common; weight +inf where they have none.
StripLeg cheapest_leg(const WeightedMesh& mesh, const Stop& from, const Stop& to);

// Where a stop is in the plane of a leg (or on the line of its edge): origin + at * direction.
struct Rail {
  Vec2 origin, direction;
};
Rail rail(const WeightedMesh& weighted, const StripLeg& leg, const Stop& stop, bool stop_is_first);

double length_of(const WeightedMesh& mesh, const Strip& strip, std::size_t leg);  // mesh.unit()
double cost_of(const WeightedMesh& mesh, const Strip& strip);                     // mesh.unit()

// Back along the parents from a place whose value is known. Where nothing leads there: no stops.
Strip trace(const steiner::Run& run, const PointLocation& target, const steiner::ValueAt& value);

// The least cost among paths over the same edges and faces, in the same order: the cost is convex in where the stops
// are, and Newton's method finds its minimum, whose derivative along an edge is Snell's law. Returns the cost.
double straighten(const WeightedMesh& mesh, Strip& strip);

// straighten(), and then past every vertex that the path goes through on either side of it, as long as that is cheaper:
// a locally shortest path. Returns the cost.
double make_locally_shortest(const WeightedMesh& mesh, Strip& strip);

}  // namespace brushfire::weighted
