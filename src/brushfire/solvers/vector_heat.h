// The vector heat method: values, tangent vectors and logarithmic maps carried over a surface by heat.
//
// Beside the exact ones (queries/straightest.h, queries/log_coordinates.h) these are smooth, and defined everywhere:
// where a shortest path is not unique they blend. In builds with Eigen only; docs/heat.md.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/solvers/heat_options.h>

#include <complex>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace brushfire {

// How log_map() is computed.
enum class LogMapStrategy : std::uint8_t {
  VectorHeat,      // radius by the heat method, angle between a radial and a parallel field
  AffineLocal,     // coordinates carried along by the connection, in the frames of the vertices
  AffineAdaptive,  // the same in one parallel frame: the most accurate, at twice the time
};

// For one mesh, factored once, with what a call needs when it first needs it. Tangent vectors are complex numbers in
// the frames of tangent_frames(). Only for surfaces whose faces lie the same way round and whose edges have one or two
// of them. Of the options time_factor, time and delaunay count: borders are free. Not for use from several threads at
// once.
//
// Other components have no value: NaN. In its own component everything has one, however far away.
//
// Walls are borders of what is open, which alone has to be such a surface. What has a direction at its own vertex
// (frames, carried vectors, the rows of the Laplacian) is told for every vertex of domain.open(): those of the mesh,
// then further sides of vertices that walls part. Of all else a vertex on a wall has what its nearer side has, where
// the most heat comes.
//
// Based on: Sharp, Soliman, Crane, "The vector heat method", 2019; Soliman, Sharp, "The affine heat method", 2025.
class VectorHeatSolver {
 public:
  // Throws Error(InvalidArgument) for other surfaces, options out of range, and without Eigen.
  explicit VectorHeatSolver(const Domain& domain, const HeatOptions& options = {});
  ~VectorHeatSolver();
  VectorHeatSolver(VectorHeatSolver&&) noexcept;
  VectorHeatSolver& operator=(VectorHeatSolver&&) noexcept;

  // Unit vectors at every vertex of domain.open(), [its vertex_count] each: x + i y is the complex number of a tangent
  // vector. x lies along the vertex's first edge; y is a quarter of a turn on from it, seen against the normal. Angles
  // around a vertex are stretched to a full turn, on a border to half of one. Zero at a vertex in no face. Throws
  // Error(InvalidArgument) for a mesh without positions.
  struct Frames {
    std::vector<Vec3> x, y, normal;
  };
  Frames tangent_frames() const;

  // The value of the nearest of the vertices, blended where several are equally near: [vertex_count], between the least
  // and the largest of the values. A vertex on a wall feeds all its sides. Throws Error(InvalidArgument) where there is
  // not one value per vertex, or none, and for a vertex behind walls, and Error(IndexOutOfRange).
  std::vector<double> extend(std::span<const Index> vertices, std::span<const double> values);

  // The vector of the nearest of the vertices, carried along the shortest path: [vertex_count of domain.open()].
  // Directions and lengths are blended apart; 0 where directions cancel. Throws as extend(), and for a vertex that
  // walls part: its sides have no common frame.
  std::vector<std::complex<double>> transport(std::span<const Index> vertices,
                                              std::span<const std::complex<double>> vectors);

  // Where each vertex lies as seen from the source, in the source's frame and in units of the mesh: [vertex_count], 0
  // at the source. Throws Error(IndexOutOfRange), and Error(InvalidArgument) for a source behind walls or parted by
  // them.
  std::vector<std::complex<double>> log_map(Index source, LogMapStrategy strategy = LogMapStrategy::AffineLocal);

  // The Laplacian of tangent vectors: Hermitian, positive semidefinite; rows and columns ascend. Both triangles are
  // stored.
  struct SparseComplex {
    std::vector<Index> row, column;
    std::vector<std::complex<double>> value;
  };
  SparseComplex connection_laplacian() const;

  double time() const;  // in units of the mesh squared

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace brushfire
