// Options of the heat method.
#pragma once

#include <cstdint>

namespace brushfire {

// What heat does at the border of an open surface. (The Poisson equation behind it is free there in all three.)
enum class HeatBoundary : std::uint8_t {
  Neumann,    // none leaves: curves of equal distance tend to meet the border at right angles
  Dirichlet,  // the border is kept cold: curves bend along it. No source may lie on it
  Averaged,   // the mean of both, as Crane, Weischedel and Wardetzky suggest; a source on the border is fine
};

struct HeatOptions {
  // For how long heat spreads: time_factor times the square of the mean edge length (of the triangulation that is
  // computed on). In [1e-12, 1e6]. Larger ones smooth more.
  double time_factor = 1;
  // The time itself, in units of the mesh squared, in place of the factor, within the same range; 0: the factor counts.
  double time = 0;
  HeatBoundary boundary = HeatBoundary::Neumann;
  // On the intrinsic Delaunay triangulation of the surface, whose edges are flipped without moving a vertex; non-
  // manifold edges, borders and mirrored faces by way of the tufted cover. False: on the faces as they are.
  bool delaunay = true;
  // What is added to the diagonal of the Poisson equation in place of holding one vertex of each component: other
  // libraries add 1e-6, which flattens far values by some 1e-3. For comparisons with them; 0: nothing. In [0, 1].
  double poisson_shift = 0;

  friend bool operator==(const HeatOptions&, const HeatOptions&) = default;
};

}  // namespace brushfire
