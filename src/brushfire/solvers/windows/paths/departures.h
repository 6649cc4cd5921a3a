// The angles at which the shortest paths of one field leave their source: of many vertices for about the cost of one
// look at each face.
#pragma once

#include <brushfire/solvers/window_field.h>
#include <brushfire/solvers/windows/paths/record.h>
#include <brushfire/solvers/windows/paths/trace.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// Rays of one pseudo-source that were traced, by the halfedges over which they came. Another ray that comes over one of
// these and sees the pseudo-source in the same place goes back by the same way, laid flat: its angle is that of the
// traced one plus what is between the two here.
class TracedRays {
 public:
  explicit TracedRays(std::size_t vertices);  // of how many the rays will be asked for

  struct Angle {
    double angle = 0;  // at the pseudo-source
    double sense = 1;  // of the way in which it grows: 1: counter-clockwise in the face there; -1: clockwise
  };
  // Of a ray of this pseudo-source, where one that is known came over the same edge. The sense is that in the
  // crossing's face.
  std::optional<Angle> find(const RayCrossing& crossing, Index pseudo_source) const;
  // Of a ray that came by these: its angle, and the sense in the last one's face.
  void add(std::span<const RayCrossing> trail, Index pseudo_source, Angle angle);
  // The same where the last one is where it came upon a known one: once is enough there, and chains stay short.
  void add_before_known(std::span<const RayCrossing> trail, Index pseudo_source, Angle angle);

 private:
  struct Entry {
    Index halfedge, pseudo_source;
    Vec2 source, direction;  // in the halfedge's frame
    Angle angle;
  };
  std::size_t slot_of(Index halfedge, Index pseudo_source) const;
  void add(const Entry& entry);

  // Open addressing: a slot holds a position in entries_, plus 1; 0: free.
  std::vector<std::uint32_t> slots_;  // a power of two
  std::vector<Entry> entries_;
};

// Of one field; the legs that have to be traced are given to `angle_of`, which says their angles. (Where a leg begins
// at a bend, whose angle nobody asks for, it may say anything.)
class Departures {
 public:
  using AngleOf = std::function<TracedRays::Angle(const WindowField::Leg&)>;
  // vertices: how many will be asked for, about.
  Departures(const WindowField& field, std::size_t vertices, AngleOf angle_of);

  struct Departure {
    Index vertex = kNoIndex;  // as WindowField::Leg::vertex
    double angle = 0;         // where the leg starts: not within any range
  };
  // Of the last leg of the path to a vertex that is reached; throws as WindowField::last_leg() does.
  Departure of(Index vertex);

  // What a field keeps, for those in this room that read it.
  static const WindowFieldData& data_of(const WindowField& field) { return *field.data_; }

 private:
  std::optional<Departure> follow(Index vertex);

  const WindowField& field_;
  AngleOf angle_of_;
  TracedRays rays_;
  std::vector<RayCrossing> trail_;
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
