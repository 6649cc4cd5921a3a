// Terrain: a mesh from a grid of heights, and places on it by their map coordinates.
//
// Example:
//     const std::vector<double> heights{0, 1, 0, 1, 2, 1};  // two rows of three
//     const brushfire::Terrain terrain(heights, 3, 2, {.right = {10, 0}, .down = {0, -10}});
//     const brushfire::SurfacePoint p = terrain.below(12, -4);
//     std::printf("%g\n", brushfire::position(terrain.mesh(), p).z);
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <array>
#include <span>
#include <vector>

namespace brushfire {

// Where the heights stand: that of column c and row r at origin + c * right + r * down. What GIS programs call a
// geotransform speaks of the corners of cells: its origin is half a cell away from this one.
struct GridPlacement {
  std::array<double, 2> origin{0, 0};
  std::array<double, 2> right{1, 0};
  std::array<double, 2> down{0, -1};
};

// Heights at the crossings of a grid, joined by two triangles for every cell. The diagonal is the one over which the
// heights differ less, which is the shorter one where cells are squares; where they differ as much, the one from the
// first corner. A cell of which one corner has no height is one triangle, one of which more have none is a hole.
class Terrain {
 public:
  // heights[row * columns + column], along rows; the vertices are numbered so. Those that are not finite, or equal to
  // `no_data`, stand for none: their vertices are in no face, at height 0. Throws Error(InvalidArgument) where there
  // are not columns * rows heights, fewer than two of either, or a placement whose axes are parallel. O(heights).
  Terrain(std::span<const double> heights, Index columns, Index rows, const GridPlacement& placement = {},
          double no_data = kInfinity);

  const Mesh& mesh() const { return mesh_; }
  Index columns() const { return columns_; }
  Index rows() const { return rows_; }

  // The point of the surface with these map coordinates: straight below (or above), and not the nearest one, which on a
  // slope lies sideways. Nowhere (SurfacePoint::is_nowhere()) beside the grid and in holes. O(1).
  SurfacePoint below(double x, double y) const;

 private:
  Mesh mesh_;
  Index columns_, rows_;
  GridPlacement placement_;
  std::vector<Index> first_face_;  // [cells + 1]
};

}  // namespace brushfire
