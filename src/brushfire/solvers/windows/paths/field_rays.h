// The rays of one field's last legs in the frames of the edges that they cross: for what is added up along them, such
// as a gradient.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/solvers/window_field.h>
#include <brushfire/solvers/windows/paths/record.h>
#include <brushfire/solvers/windows/paths/trace.h>

#include <optional>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

class FieldRays {
 public:
  explicit FieldRays(const WindowField& field);  // which must outlive it

  // The ray that came to a vertex, as it was kept.
  struct Arrival {
    Index halfedge = kNoIndex;  // over which it came, opposite of the vertex
    Vec2 apex, arrow;           // the vertex; the way it came, of length 1; in the frame of the halfedge
    double length = 0;          // in the mesh's units: from the pseudo-source
  };
  // Nothing where it came along an edge, or is of a run on other faces.
  std::optional<Arrival> arrival(Index vertex) const;

  // From where the value of a vertex came: vertex, or vertex count + position of the source; kNoIndex: from nowhere.
  Index pseudo_source(Index vertex) const { return data_.vertices[vertex].ray.pseudo_source; }

  // Follows the ray of a vertex that has an arrival() back to where the last leg starts: a pseudo-source as above.
  // Nothing where its way is not beyond doubt: WindowField::last_leg() then knows. `crossings`: what it held is
  // replaced. O(edges crossed).
  std::optional<Index> trace(Index vertex, std::vector<RayCrossing>& crossings) const;

 private:
  const WindowFieldData& data_;
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
