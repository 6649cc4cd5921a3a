// Calls CGAL. Measurements only: CGAL's algorithms are GPL and no part of the library.
#include "cgal_exact.h"

#ifdef BRUSHFIRE_HAVE_CGAL

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

namespace brushfire::benchmark {

std::optional<std::vector<double>> cgal_exact(std::span<const Vec3> positions, std::span<const Face> faces,
                                              Index source) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  using Paths = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Surface>>;
  using Vertex = Surface::Vertex_index;

  Surface surface;
  for (const Vec3& p : positions) surface.add_vertex({p.x, p.y, p.z});
  for (const auto& [a, b, c] : faces) {
    if (surface.add_face(Vertex(a), Vertex(b), Vertex(c)) == Surface::null_face()) return std::nullopt;
  }
  Paths paths(surface);
  paths.add_source_point(Vertex(source));
  std::vector<double> distance(positions.size());
  for (Index v = 0; v < distance.size(); ++v) {
    const double d = paths.shortest_distance_to_source_points(Vertex(v)).first;
    distance[v] = d < 0 ? kInfinity : d;  // CGAL says -1 where there is no path
  }
  return distance;
}

}  // namespace brushfire::benchmark

#else

namespace brushfire::benchmark {

std::optional<std::vector<double>> cgal_exact(std::span<const Vec3>, std::span<const Face>, Index) {
  return std::nullopt;
}

}  // namespace brushfire::benchmark

#endif
