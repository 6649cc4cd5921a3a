// Geodesic centroidal Voronoi cells (Lloyd's method), and medoids.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/distance.h>

#include <span>
#include <vector>

namespace brushfire {

struct CentroidalOptions {
  Index max_rounds = 20;    // of moving the sites
  double tolerance = 1e-3;  // stop where a round saves less than this share of the energy
  // One per vertex of the mesh, >= 0: how much of the surface counts where; empty: all of it alike.
  std::span<const double> density = {};
  unsigned threads = 1;
  Progress progress = nullptr;
  const CancelToken* cancel = nullptr;
};

struct CentroidalVoronoi {
  std::vector<SurfacePoint> sites;
  std::vector<double> distance;  // [vertex_count] exact, from the nearest site; +inf: none reaches
  std::vector<Index> nearest;    // [vertex_count] its number; kNoIndex: none
  // Before the first round and after each: the integral of the squared distance from the nearest site over the surface
  // (a third of each face counting for each corner). It falls.
  std::vector<double> energy;
};

// Moves the sites to the middles of their cells, again and again: cells of about one size and shape. The middle of a
// cell is one step of Karcher's mean: the mean, over the cell, of the directions and lengths in which the shortest
// paths from the site leave, walked straight on. Begins with farthest points, or with `first`. Sites are points of the
// surface, not vertices; one at a vertex that has no tangent plane stays there. A round costs one exact field from all
// sites together and the last legs of its paths. Throws Error(InvalidArgument) for no sites, more than open vertices,
// bad densities, and as distance() does.
//
// Based on: Lloyd, "Least squares quantization in PCM", 1982; Du, Faber, Gunzburger, "Centroidal Voronoi
// Tessellations", 1999; on surfaces with the logarithmic map: Sharp, Soliman, Crane, "The Vector Heat Method", 2019.
CentroidalVoronoi centroidal_voronoi(const Domain& domain, Index count, const CentroidalOptions& options = {});
CentroidalVoronoi centroidal_voronoi(const Domain& domain, std::span<const SurfacePoint> first,
                                     const CentroidalOptions& options = {});

struct Medoids {
  std::vector<Index> places;   // which of the given ones, in the order in which they were chosen
  std::vector<Index> nearest;  // [places given] which medoid, by its position in `places`
  double cost = 0;             // the weighted sum of the distances from the nearest medoid
};

// The `count` of the places that have the least sum of distances from all places to the nearest of them: greedy choice,
// then exchanges of one for another as long as one pays. A local optimum. `distances`: [n * n], row by row; +inf counts
// as farther than everything else together. `weights`: empty, or [n] >= 0. O(n^2) memory is the caller's; each exchange
// is found in O(n^2). Throws Error(InvalidArgument) for a matrix that is not square or has NaN, and for a count of 0 or
// more than n.
//
// Based on: Kaufman, Rousseeuw, "Partitioning Around Medoids", 1990; Schubert, Rousseeuw, "Faster k-Medoids
// Clustering", 2019 (all exchanges for one newcomer at once).
Medoids k_medoids(std::span<const double> distances, Index count, std::span<const double> weights = {});

}  // namespace brushfire
