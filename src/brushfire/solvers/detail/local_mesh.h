// A mesh in an order that keeps neighbours close in memory.
#pragma once

#include <brushfire/core/detail/uninitialized.h>
#include <brushfire/mesh/detail/locality_order.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace brushfire::detail {

class LocalMesh {
 public:
  explicit LocalMesh(const Mesh& mesh) : mesh_(mesh) {
    if (is_local(mesh)) return;
    VertexOrder order = vertex_locality_order(mesh);
    face_rank_ = face_ranks(mesh.faces(), order.vertex_rank);
    mesh_ = mesh.renumbered(order.vertices, order.vertex_rank, face_rank_);
    vertex_ = std::move(order.vertices);
  }

  const Mesh& mesh() const { return mesh_; }

  // From numbers of this mesh to the caller's, and back.
  Index vertex(Index local) const { return vertex_.empty() ? local : vertex_[local]; }
  // What each of the caller's faces has ([face_count]), in the order of this mesh.
  std::vector<double> of_faces(std::span<const double> values) const {
    std::vector<double> here(values.begin(), values.end());
    for (std::size_t f = 0; f < here.size() && !vertex_.empty(); ++f) here[face_rank_[f]] = values[f];
    return here;
  }
  PointLocation location(PointLocation at) const {
    if (vertex_.empty()) return at;
    const Index face = at.face;
    at.face = face_rank_[face];
    if (at.halfedge != kNoIndex) at.halfedge = 3 * at.face + (at.halfedge - 3 * face);
    if (at.vertex != kNoIndex) {
      Index k = 0;  // a point at a vertex weighs that alone
      while (k < 2 && !(at.weights[k] > 0)) ++k;
      at.vertex = mesh_.from(3 * at.face + k);
    }
    return at;
  }

 private:
  Mesh mesh_;
  UninitializedArray<Index> vertex_;     // [vertex_count] the caller's numbers; empty: the same
  UninitializedArray<Index> face_rank_;  // [face_count] the number here of each of the caller's faces
};

}  // namespace brushfire::detail
