// WindowField: what a window run knows beyond the values at vertices, for paths and for points inside faces.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <memory>
#include <span>
#include <vector>

namespace brushfire {

namespace windows {            // NOLINT(modernize-concat-nested-namespaces)
inline namespace in_doubles {  // see windows/algebra/real.h
struct WindowFieldData;
class Departures;
}  // namespace in_doubles
}  // namespace windows

// Made by a run with DistanceOptions::keep_paths or keep_windows (DistanceField::windows). Immutable; safe to read from
// many threads; shares the mesh. All lengths are in the mesh's units.
//
// A shortest path is a chain of straight legs (straight when the faces that they cross are laid flat) that bend at
// vertices. To trace the path to a point, ask for its last leg, then for the last leg of the vertex where that leg
// starts, and so on until a leg starts at a source:
//
//   WindowField::Leg leg = field.windows->last_leg(v);
//   while (leg.vertex != kNoIndex) leg = field.windows->last_leg(leg.vertex);
//   // now leg.source says which source, leg.points.back() where it is
class WindowField {
 public:
  struct Leg {
    // From the point that was asked for, backwards, to where the leg starts: both ends, and every edge crossed between
    // them. Consecutive points share a face. A leg that passes through a vertex ends there (the path goes on straight
    // through it, or bends). Only the point itself where the leg has no length: at a source.
    std::vector<SurfacePoint> points;
    double length = 0;        // of the leg; the legs of a path add up to the distance minus the source's offset
    Index vertex = kNoIndex;  // the vertex where the leg starts; kNoIndex: it starts at `source`, or there is no path
    Index source = kNoIndex;  // position of the source in the caller's list; kNoIndex: unreachable, points is empty
  };

  // The value at a surface point, and the nearest source: exact like those of vertices. Anywhere where the run was told
  // keep_windows; else at vertices and at the run's targets (given with the same face and weights) only: throws
  // Error(InvalidArgument) for other points. O(windows of the face).
  struct Value {
    double distance = kInfinity;
    Index source = kNoIndex;
  };
  Value value(const SurfacePoint& point) const;

  // The last leg of the shortest path to a vertex, or to a point under the conditions of value(). Runs without merging
  // only (exact, or windows with tolerance 0): throws Error(InvalidArgument) otherwise. O(edges crossed).
  Leg last_leg(Index vertex) const;
  Leg last_leg(const SurfacePoint& point) const;

  // The mesh of the run.
  const Mesh& mesh() const noexcept;

  explicit WindowField(std::shared_ptr<const windows::WindowFieldData> data);

 private:
  friend class windows::Departures;
  std::shared_ptr<const windows::WindowFieldData> data_;
};

}  // namespace brushfire
