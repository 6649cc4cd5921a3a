// Shortest paths along edges: an upper bound of the geodesic distance, and the floor for everything else.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/detail/engine.h>

#include <memory>

namespace brushfire::detail {

std::unique_ptr<Engine> make_dijkstra(const Mesh& mesh);

}  // namespace brushfire::detail
