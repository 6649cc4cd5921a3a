// The diagonal of a 3 by 4 rectangle is 5 long.
#include <brushfire/brushfire.h>

#include <cstdio>
#include <vector>

int main() {
  const std::vector<brushfire::Vec3> positions{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {0, 4, 0}};
  const std::vector<brushfire::Face> faces{{0, 1, 2}, {0, 2, 3}};
  const brushfire::Mesh mesh(positions, faces);
  const std::vector<brushfire::Source> sources{{brushfire::vertex_point(mesh, 0)}};
  const std::vector<double> distance = brushfire::distance(mesh, sources).distance;
  std::printf("%g\n", distance[2]);
  return distance[2] > 4.99 && distance[2] < 5.01 ? 0 : 1;
}
