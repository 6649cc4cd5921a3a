// A consumer of the solvers alone: no files are read, no pictures drawn.
#include <brushfire/brushfire.h>

#include <cmath>
#include <cstdio>
#include <vector>

int main() {
  const brushfire::Mesh mesh(std::vector<brushfire::Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                             std::vector<brushfire::Face>{{0, 1, 2}, {0, 2, 3}});
  const std::vector<brushfire::Source> sources{{brushfire::vertex_point(mesh, 1)}};
  const double diagonal = brushfire::distance(mesh, sources, {.method = brushfire::Method::Exact}).distance[3];
  std::printf("%.17g\n", diagonal);
  return std::abs(diagonal - std::sqrt(2.0)) < 1e-15 ? 0 : 1;
}
