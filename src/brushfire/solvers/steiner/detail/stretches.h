// What a grain makes of the faces: a face is laid out so that lengths in it are costs, and its edges are stretched.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/steiner/weights.h>

#include <array>
#include <span>
#include <vector>

namespace brushfire::steiner {

// Of one face: of its edges from corner k to the next, and of its area.
struct FaceStretch {
  std::array<double, 3> along{1, 1, 1};
  double area = 1;
};
FaceStretch stretch_of(const Mesh& mesh, Index f, const Grain& grain);

class Stretches {
 public:
  Stretches() = default;  // no grain
  // `grain` of the mesh's faces; empty: none. The mesh has positions.
  Stretches(const Mesh& mesh, std::span<const Grain> grain);

  friend bool operator==(const Stretches&, const Stretches&) = default;

  bool any() const { return !along_.empty(); }
  // What a unit of length along a halfedge costs in its face, without the weight.
  double along(Index h) const { return any() ? along_[h] : 1; }
  // By how much the face's area grows.
  double area(Index f) const { return any() ? across_[f] : 1; }
  // From one point of a face to another, straight; in mesh.unit(), without the weight.
  double within(const Mesh& mesh, Index f, const std::array<double, 3>& a, const std::array<double, 3>& b) const;

 private:
  std::vector<double> along_;   // [halfedges]
  std::vector<double> across_;  // [faces]
};

}  // namespace brushfire::steiner
