// What is read off the distance fields of many places, one after the other, without keeping them: how far the farthest
// vertex is, how far the surface is on average, and how large the disc is that holds a share of it.
#pragma once

#include <brushfire/mesh/domain.h>
#include <brushfire/queries/distance_matrix.h>

#include <vector>

namespace brushfire {

// Areas of the open faces, a third to each corner, [vertex_count] of domain.mesh(), in units of the mesh squared.
std::vector<double> vertex_areas(const Domain& domain);

// The distance of the vertex that is farthest from each place, among those that can be reached from it: [places]; +inf
// for a place from which nothing can be (a vertex in no open face). One run per place, shared out to threads. Throws as
// distance_matrix() does.
std::vector<double> eccentricities(const Domain& domain, Places places = {}, const MatrixOptions& options = {});

// The mean distance of the surface that can be reached from each place, weighted by area: [places], +inf as above. The
// mean over all of them is the classical average geodesic distance of the surface. Cost and errors as above.
std::vector<double> average_distances(const Domain& domain, Places places = {}, const MatrixOptions& options = {});

// Of a geodesic disc around each place.
struct Discs {
  std::vector<double> radius;     // [places] mesh units; +inf as above
  std::vector<double> perimeter;  // [places] the length of its rim, of the isoline at the radius
  std::vector<double> area;       // [places] share times the area of the place's component, to rounding
};

// The disc around each place that holds `share` (in (0, 1]) of the area of its component (of those on both sides of a
// wall that parts the surface, for a place on it): fields are linear in every
// face, as for isolines, and the disc is what is nearer than its radius. Small shares cost what they reach. Throws
// Error(InvalidArgument) for another share, and as distance_matrix() does.
// Compare: surfdist, Connectome Workbench (-surface-geodesic-rois), which take vertices or radii.
Discs discs_of_share(const Domain& domain, double share, Places places = {}, const MatrixOptions& options = {});

}  // namespace brushfire
