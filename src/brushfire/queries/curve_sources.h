// Curves as sources, made from paths, boundary curves and regions of a labelled surface.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/boundaries.h>
#include <brushfire/mesh/curve_source.h>
#include <brushfire/mesh/surface_path.h>

#include <cstdint>
#include <span>

namespace brushfire {

// A path, an isoline, a drawn curve as a source. Throws Error(InvalidArgument) for one without points.
CurveSource curve_source(const SurfacePath& path);

// Boundary curves as one source of as many pieces. Throws Error(InvalidArgument) for none: a mesh without a boundary.
CurveSource curve_source(const Mesh& mesh, std::span<const Boundary> curves);

// A region: distances are 0 everywhere in it (CurveSource::inside), and outside from its border on. Throws
// Error(InvalidArgument) for an empty one, and Error(IndexOutOfRange) for a face that does not exist. O(vertices +
// faces log faces).
//
// Faces, in any order.
CurveSource region_of_faces(const Mesh& mesh, std::span<const Index> faces);
// Vertices (not 0) and what lies between them: edges of two, faces of three. [vertex_count]
CurveSource region_of_vertices(const Mesh& mesh, std::span<const std::uint8_t> vertices);

}  // namespace brushfire
