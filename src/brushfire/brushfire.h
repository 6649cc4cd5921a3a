// Everything public, in one include. What is not listed here is not installed: installation reads this file.
#pragma once

#include <brushfire/config.h>
#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/core/parallel.h>
#include <brushfire/core/progress.h>
#include <brushfire/core/types.h>
#include <brushfire/mesh/cut.h>
#include <brushfire/mesh/delaunay.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/nearest_point.h>
#include <brushfire/mesh/polygons.h>
#include <brushfire/mesh/reachable.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/mesh/subdivide.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/mesh/weld.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/window_field.h>
#include <brushfire/version.h>
#if BRUSHFIRE_QUERIES
#include <brushfire/queries/certify.h>
#include <brushfire/queries/compare.h>
#include <brushfire/queries/curved_isolines.h>
#include <brushfire/queries/distance_matrix.h>
#include <brushfire/queries/gradient.h>
#include <brushfire/queries/isolines.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/sampling.h>
#include <brushfire/queries/shorten.h>
#include <brushfire/queries/straightest.h>
#include <brushfire/queries/surface_path.h>
#include <brushfire/queries/voronoi.h>
#endif
#if BRUSHFIRE_IO
#include <brushfire/io/byte_stream.h>
#include <brushfire/io/formats.h>
#include <brushfire/io/npy.h>
#include <brushfire/io/read_field.h>
#include <brushfire/io/read_lines.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/io/unfinished.h>
#include <brushfire/io/write_bytes.h>
#include <brushfire/io/write_columns.h>
#include <brushfire/io/write_field.h>
#include <brushfire/io/write_lines.h>
#include <brushfire/io/write_mesh.h>
#endif
#if BRUSHFIRE_FIGURE
#include <brushfire/figure/ambient_occlusion.h>
#include <brushfire/figure/camera.h>
#include <brushfire/figure/colormap.h>
#include <brushfire/figure/image.h>
#include <brushfire/figure/render.h>
#endif
