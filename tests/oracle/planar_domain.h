// Random planar domains with polygonal holes, and shortest paths in them by the visibility graph: a truth that knows
// nothing of windows. Coordinates are integers, and every decision is exact.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace brushfire::oracle {

struct LatticePoint {
  std::int64_t x = 0, y = 0;
};

// A triangulated square from which triangles were taken. Holes may touch each other and the outside in a vertex, and
// may cut the domain into pieces.
struct PlanarDomain {
  std::vector<LatticePoint> points;
  std::vector<Face> faces;    // the domain
  std::vector<Face> removed;  // the holes

  Mesh mesh() const;
};

// cells x cells squares, each split by a random diagonal; corners moved at random unless `regular`. Up to `holes` holes
// of one to nine triangles, at least one. Coordinates are multiples of six.
PlanarDomain random_domain(std::mt19937& random, int cells, int holes, bool regular);

// A point of the domain with integer coordinates: a vertex, the midpoint of an edge or the centroid of a face.
struct DomainPoint {
  LatticePoint at;
  SurfacePoint on;
};
DomainPoint random_point(const PlanarDomain& domain, std::mt19937& random);
DomainPoint random_point(const PlanarDomain& domain, Index face, std::mt19937& random);

// Whether the open segment pq avoids the holes. Touching their corners and running along their edges is allowed,
// running along an edge that lies between two holes is not.
bool visible(const PlanarDomain& domain, LatticePoint p, LatticePoint q);

// Length of the shortest path inside the domain from the source to every vertex; infinity where there is none.
// O(vertices^2 * removed).
std::vector<long double> visibility_distances(const PlanarDomain& domain, LatticePoint source);
// The same from a polyline, each segment of which lies in a face: from its places and the feet on its segments that are
// seen. (What sees a segment but not its foot is reached around the corner that hides the foot.)
std::vector<long double> visibility_distances(const PlanarDomain& domain, std::span<const LatticePoint> curve);

}  // namespace brushfire::oracle
