// The targets of a run that lie inside faces or on edges, by face. (Those at vertices are read off the vertices.)
#pragma once

#include <brushfire/solvers/windows/algebra/rays.h>
#include <brushfire/solvers/windows/propagation/structure.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

struct TargetInFace {
  Index face;
  Index target;
  std::array<Real, 3> weights;
};

struct TargetState {
  Real lower = kInfinity;     // least value of the windows that see the target, after merging
  Real upper = kInfinity;     // length of the shortest real path known
  Real estimate = kInfinity;  // what the window that gave `lower` expects the distance to be
  Ray ray;
};

// From a point of an inner face to the face's corners.
std::array<Real, 3> corner_distances_of(const WindowStructure& structure, const FaceWeights& at);

class Targets {
 public:
  // Forgets the targets of the run before and marks the faces of these.
  void place(std::span<const PointLocation> targets, WindowStructure& structure);
  void clear(WindowStructure& structure);

  Index size() const { return static_cast<Index>(states_.size()); }
  TargetState& operator[](Index target) { return states_[target]; }
  const TargetState& operator[](Index target) const { return states_[target]; }
  std::span<const TargetInFace> in_faces() const { return in_faces_; }

  template <class Visit>
  void for_each_in(Index face, Visit&& visit) const {
    auto t = std::lower_bound(in_faces_.begin(), in_faces_.end(), face,
                              [](const TargetInFace& a, Index f) { return a.face < f; });
    for (; t != in_faces_.end() && t->face == face; ++t) visit(*t);
  }

 private:
  std::vector<TargetState> states_;     // [targets]
  std::vector<TargetInFace> in_faces_;  // by face; a target on an edge once for each of its faces
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
