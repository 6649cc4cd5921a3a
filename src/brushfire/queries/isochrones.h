// Isochrones: what can be reached within a time, as polygons on the map.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace brushfire {

// A closed ring on the map: x and y, the first point not repeated. Outer rings run counter-clockwise, holes clockwise.
using MapRing = std::vector<std::array<double, 2>>;

struct MapPolygon {
  MapRing outer;
  std::vector<MapRing> holes;
};

// Where the values are below the level: of the field that is linear in every face and has these values at the vertices
// ([vertex_count]; +inf: none, and none in the faces there), seen from above. For surfaces that are a map: every face
// counter-clockwise from above, no two over one another, edges of two faces at most, such as Terrain makes. In a domain
// with walls only what they leave open counts, and polygons end at walls. In the order of their first vertices or
// edges. Throws Error(InvalidArgument) where there is not one value per vertex, for a
// mesh without positions and a level that is not finite. O(faces), and rings times holes.
std::vector<MapPolygon> isochrone(const Domain& domain, std::span<const double> values, double level);

// A GeoJSON FeatureCollection (RFC 7946) with one MultiPolygon for each level, which its property "level" names. In the
// mesh's coordinates, which RFC 7946 wants to be longitude and latitude; GIS programs take others if told so.
std::string isochrones_as_geojson(const Domain& domain, std::span<const double> values, std::span<const double> levels);

}  // namespace brushfire
