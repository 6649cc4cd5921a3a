// A weighted mesh as windows see it: face records, what a unit of length costs there, and where light refracts.
#pragma once

#include <brushfire/solvers/steiner/detail/weighted_mesh.h>
#include <brushfire/solvers/windows/propagation/rounding.h>
#include <brushfire/solvers/windows/propagation/structure.h>

#include <memory>
#include <vector>

namespace brushfire::refraction {

// What rounding may do to costs, as a share of how far apart their bounds may be.
inline constexpr double kRoundingOfTolerance = 1e-2;

// By the inner numbers of `structure`, which is of the mesh with its walls cut open, in one part. O(vertices + faces).
struct Medium {
  explicit Medium(const steiner::WeightedMesh& weighted);

  // Light may be followed here, and told to well below `tolerance`: no fences and no slopes, weights that are not too
  // far apart, and lengths that doubles can tell apart.
  bool is_followable(double tolerance) const {
    return followable && rounding.relative <= kRoundingOfTolerance * tolerance;
  }

  windows::WindowStructure structure;
  std::vector<double> weight;           // [faces]
  std::vector<double> along;            // [halfedges] of the edge, no more than in its faces
  std::vector<std::uint8_t> is_border;  // [halfedges] another weight beyond, or the edge is cheaper than its face
  std::vector<std::uint8_t> is_pivot;   // [vertices] paths may bend there in any direction: a border ends there
  double bucket_width = 1;              // of the queue, in costs
  windows::Rounding rounding;           // of costs
  bool followable = true;
};

}  // namespace brushfire::refraction
