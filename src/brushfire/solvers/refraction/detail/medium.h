// A weighted mesh as windows see it: face records, what a unit of length costs there, and where light refracts.
#pragma once

#include <brushfire/solvers/steiner/detail/weighted_mesh.h>
#include <brushfire/solvers/windows/propagation/structure.h>

#include <memory>
#include <vector>

namespace brushfire::refraction {

// By the inner numbers of `structure`, which is of the mesh with its walls cut open, in one part. O(vertices + faces).
struct Medium {
  explicit Medium(const steiner::WeightedMesh& weighted);

  // Light may be followed here: no fences and no slopes, weights no more than kMostContrast apart, and lengths that
  // doubles can tell apart.
  bool is_followable() const { return followable; }

  windows::WindowStructure structure;
  std::vector<double> weight;           // [faces]
  std::vector<double> along;            // [halfedges] of the edge, no more than in its faces
  std::vector<std::uint8_t> is_border;  // [halfedges] another weight beyond, or the edge is cheaper than its face
  std::vector<std::uint8_t> is_pivot;   // [vertices] paths may bend there in any direction: not all is one weight
  double bucket_width = 1;              // of the queue, in costs
  double rounding = 0;                  // absolute, of costs
  bool followable = true;
};

// Beyond this windows are cut into ever more pieces, and rounding in a dear face is much in a cheap one.
inline constexpr double kMostContrast = 1e4;

}  // namespace brushfire::refraction
