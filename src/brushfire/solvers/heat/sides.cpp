// Where walls part a vertex, and where they leave nothing of it.
#include <brushfire/solvers/heat/sides.h>

#include <brushfire/core/error.h>

#include <algorithm>
#include <string>

namespace brushfire::heat {

std::vector<Index> sides_of(const Domain& domain, Index vertex) {
  std::vector<Index> sides;
  for (const SurfacePoint& p : domain.on_open(vertex_point(domain.mesh(), vertex))) {
    sides.push_back(locate(domain.open(), p).vertex);
  }
  if (sides.empty()) {
    throw Error(ErrorCode::InvalidArgument,
                "vertex " + std::to_string(vertex) + " lies behind a wall: nothing can be reached from there");
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

Index only_side_of(const Domain& domain, Index vertex) {
  const std::vector<Index> sides = sides_of(domain, vertex);
  if (sides.size() > 1) {
    throw Error(ErrorCode::InvalidArgument, "walls part the surface at vertex " + std::to_string(vertex) +
                                                ": directions on its sides have no common frame");
  }
  return sides.front();
}

}  // namespace brushfire::heat
