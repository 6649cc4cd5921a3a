// What a unit of length costs in each face: a face of weight w is laid out w times as large, so that its side has one
// length in each of its faces, and values are costs.
#pragma once

#include <brushfire/mesh/mesh.h>

#include <span>
#include <utility>

namespace brushfire::fast_marching {

class FaceCosts {
 public:
  FaceCosts() = default;  // distances
  FaceCosts(const Mesh& mesh, std::span<const double> weights) : mesh_(&mesh), weights_(weights) {}

  bool any() const { return !weights_.empty(); }
  double of(Index face) const { return any() ? weights_[face] : 1; }

  // Harmonic, so that what is very dear does not count.
  double mean() const {
    double sum = 0;
    for (const double w : weights_) sum += 1 / w;
    return any() ? static_cast<double>(weights_.size()) / sum : 1;
  }

  // That of all faces at a vertex; 0 where they differ, or there are none.
  double around(Index v) const {
    if (!any()) return 1;
    double same = 0;
    for (const Index h : mesh_->corners(v)) {
      const double w = of(Mesh::face_of(h));
      if (same != 0 && w != same) return 0;
      same = w;
    }
    return same;
  }

 private:
  const Mesh* mesh_ = nullptr;
  std::span<const double> weights_;  // [face_count]; empty: none
};

}  // namespace brushfire::fast_marching
