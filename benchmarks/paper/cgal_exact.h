// Exact distances by a program that is not ours, where it is installed: CGAL's Surface_mesh_shortest_path (Xin, Wang).
#pragma once

#include <brushfire/core/types.h>

#include <optional>
#include <span>
#include <vector>

namespace brushfire::benchmark {

// Distances of all vertices from vertex `source`. Nothing where this was built without CGAL or where CGAL refuses a
// face (it takes consistently oriented manifolds only): there is no independent truth then.
std::optional<std::vector<double>> cgal_exact(std::span<const Vec3> positions, std::span<const Face> faces,
                                              Index source);

}  // namespace brushfire::benchmark
