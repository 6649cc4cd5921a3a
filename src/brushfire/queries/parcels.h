// Distances between the regions of a labelled surface, without a matrix of all its vertices.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/queries/distance_matrix.h>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace brushfire {

enum class ParcelDistance : std::uint8_t {
  Min,        // of the nearest two vertices: one run per parcel
  Hausdorff,  // of the vertex of either that is farthest from the other parcel: one run per parcel
  Centroid,   // of their centroids, see below: one short run per vertex, then one per parcel
  Mean,       // over all pairs of vertices: one run per vertex
  Max,        // of the two vertices that are farthest apart: one run per vertex
};

// "min", "hausdorff", "centroid", "mean", "max". Throws Error(InvalidArgument) that lists them.
ParcelDistance parcel_distance_named(std::string_view name);

struct ParcelMatrix {
  std::vector<std::int64_t> label;  // of each parcel, ascending
  std::vector<double> distance;     // [parcels * parcels] symmetric; +inf: unreachable
  // [parcels] ParcelDistance::Centroid only: the vertex of each parcel with the least sum of distances to its other
  // vertices (weighted by their areas), the lowest of equals.
  std::vector<Index> centroid;
  std::vector<Index> vertices;  // [parcels] how many there are
};

// label: one per vertex; a parcel is all vertices of one label that are in an open face. Those below `least_label` (0:
// negative ones) are in no parcel. Mean and Max are what the matrix of all vertices gives, diagonal blocks included
// (the diagonal of Mean is the mean over pairs of a parcel, each vertex with itself among them), to rounding; Min and
// Hausdorff have a diagonal of 0. options are those of a matrix: method, radius (what is farther is unreachable),
// threads. Throws Error(InvalidArgument) where there is not one label per vertex, and as distance() does.
ParcelMatrix parcel_distances(const Domain& domain, std::span<const std::int64_t> label, ParcelDistance kind,
                              std::int64_t least_label = 0, const MatrixOptions& options = {});

}  // namespace brushfire
