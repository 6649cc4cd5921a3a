// What a run reached, and why it did not reach the rest.
#pragma once

#include "talk.h"

#include <brushfire/mesh/domain.h>
#include <brushfire/solvers/distance.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace brushfire::tool {

class Reached {
 public:
  Reached() = default;
  // O(faces) where a radius or targets may have stopped the run, and nothing otherwise.
  Reached(const Domain& domain, std::span<const Source> sources, const DistanceOptions& options,
          const DistanceField& field);

  // Whether no way leads there at all, whatever the radius. For targets that the run did not reach.
  bool is_unreachable(const SurfacePoint& point) const;

  // [vertex_count] 1 for vertices of infinite `distance` to which a way leads: the radius, or the last target, was
  // nearer. Empty where there is none.
  std::vector<std::uint8_t> not_visited(std::span<const double> distance) const;

  // reached, unreachable (no way leads there), beyond_radius (seen by the front, but farther than the radius or not
  // final), not_visited (the run was over before): counts of vertices.
  void add_to(Record& record) const;
  // ", 3 lie beyond the radius, 4 cannot be reached".
  std::string in_words() const;

 private:
  Index reached_ = 0, unreachable_ = 0, beyond_radius_ = 0, not_visited_ = 0;
  bool has_radius_ = false;
  Domain domain_{Mesh()};
  std::vector<std::uint8_t> is_reachable_;  // of domain_.open(); empty: all that was reached is all that can be
};

}  // namespace brushfire::tool
