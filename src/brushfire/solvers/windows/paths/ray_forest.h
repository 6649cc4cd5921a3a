// The rays of one field's last legs, laid one over the other where they run through the same faces from the same place.
// What is carried along them and adds up, such as a gradient, is carried once.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/solvers/window_field.h>
#include <brushfire/solvers/windows/paths/record.h>
#include <brushfire/solvers/windows/paths/trace.h>

#include <optional>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// Every ray is a unit arrow, times the weight that it was added with. Where rays share an edge, and see their
// pseudo-source in the same place from there, their arrows are summed: what follows is linear in them.
class RayForest {
 public:
  explicit RayForest(const WindowField& field);  // which must outlive it

  // How the last leg of a vertex ends there, and where it began.
  struct Arrival {
    Index halfedge = kNoIndex;  // of the face over which it came to the vertex, opposite of it
    Vec2 arrow;                 // in the frame of the halfedge
    Index start = kNoIndex;     // vertex, or vertex count + position of the source
    bool crosses = false;     // an edge, in whose frame sums() has it; else it lies in the halfedge's face
  };
  // Adds the last leg of a vertex. Nothing, and nothing was added, where its way is not beyond doubt:
  // WindowField::last_leg() then knows. O(edges crossed until another ray is met).
  std::optional<Arrival> add(Index vertex, double weight);

  // The ray that came to a vertex, as it was kept: nothing where it came along an edge, or is from a run on other faces.
  struct Ray {
    Index halfedge = kNoIndex;
    Vec2 arrow, apex;   // of unit length; the vertex; in the frame of the halfedge
    double length = 0;  // in the mesh's units: from the pseudo-source
  };
  std::optional<Ray> arrival(Index vertex) const;

  // An edge that rays have crossed, in the frame of its halfedge in the face that they come from.
  struct Crossing {
    Index halfedge = kNoIndex;
    Vec2 source;             // where they come from
    Vec2 arrow;              // the sum of theirs
    Index start = kNoIndex;  // where the halfedge's face holds their beginning: as in Arrival; else none
  };
  // Every crossing once, with what all rays that were added send over it. O(crossings).
  std::vector<Crossing> sums() const;

 private:
  struct Node {
    Vec2 source, direction;  // of the ray that made it
    Vec2 parent_direction;   // the same direction in the parent's frame
    Vec2 arrow;              // the sum of those of rays that end before the next crossing
    Index halfedge, pseudo_source;
    Index parent = kNoIndex;  // towards the pseudo-source; a lower number
    Index next = kNoIndex;    // at the same halfedge
    Index start = kNoIndex;
    bool turned = false;  // the parent's frame lies the other way round
  };
  Index find(const RayCrossing& crossing, Index pseudo_source) const;
  Index add_trail(Index root, std::size_t count, Index pseudo_source, Index start, bool can_be_shared);

  const WindowFieldData& data_;
  std::vector<Index> first_;  // [halfedge_count] a node there
  std::vector<Node> nodes_;
  std::vector<RayCrossing> trail_;  // of the ray at hand, from its vertex
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
