// Many rays of one field followed back to their pseudo-sources, fast: each step turns what is known about a ray from
// the frame of one edge into that of the next, by angles that are looked up. A step waits for the face that it comes
// to, so that several rays take turns.
//
// Of a ray that comes from s in a direction u of length 1, u, s x u (the moment, by which it passes the frame's origin)
// and s . u (how far along it began) are known. Where it goes on to the left of a face's apex, the next frame has the
// same origin, so that the latter stay as they are and u turns by the corner's angle; to the right the apex is the next
// origin.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/solvers/window_field.h>
#include <brushfire/solvers/windows/paths/field_rays.h>
#include <brushfire/solvers/windows/paths/record.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

class RayWalk {
 public:
  explicit RayWalk(const WindowField& field);  // which must outlive it. O(faces)

  // Where a ray comes into a face, followed backwards, in the frame of the edge's halfedge in it.
  struct Crossing {
    Index halfedge = kNoIndex;
    double across = 0;  // of the way that the ray came, of length 1, what is at a right angle to the edge
    double moment = 0;
  };
  // Of one vertex.
  struct Ray {
    Index vertex = kNoIndex;
    FieldRays::Arrival arrival;
    // Where the last leg starts, as FieldRays::trace() has it: nothing where that is not beyond doubt, where the ray is
    // said to pass through a vertex, or a face on the way is oriented against the one before.
    std::optional<Index> start;
    std::vector<Crossing> crossings;  // empty: there is nothing to cross, or no start
    Vec2 u;                           // in the last one's frame
  };
  // Fills start, crossings and u of each, from vertex and arrival. O(edges crossed).
  void follow(std::span<Ray> rays) const;

 private:
  struct Face {
    std::array<double, 3> length, cosine, sine;  // of halfedge k, and of the angle at its start
    std::array<Index, 3> across, vertex;  // the halfedge beyond it, kNoIndex where it is not the only one; its start
  };
  // Where a ray may begin: at a vertex, or at a point by the one or two faces that hold it.
  struct Goal {
    Index vertex = kNoIndex;
    std::array<FaceWeights, 2> places{FaceWeights{kNoIndex, {}}, FaceWeights{kNoIndex, {}}};
    double value = 0;
  };
  // A ray on its way.
  struct Step {
    Ray* ray = nullptr;
    Index halfedge = kNoIndex;
    Vec2 u;
    double moment = 0, along = 0;
    double room =
        0;  // nearer to a vertex than this, it may be said to go through it, or rounding decides on which side
    Index vertex = kNoIndex, face = kNoIndex, beyond = kNoIndex;  // where it may have begun: of its goal
  };
  enum class Went { On, Home, Astray };
  std::optional<Goal> goal_of(Index pseudo_source) const;
  bool begin(Step& step) const;
  Went on(Step& step) const;
  bool is_home(const Step& step) const;

  const WindowFieldData& data_;
  std::vector<Face> faces_;
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
