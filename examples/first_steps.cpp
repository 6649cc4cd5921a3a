// Reads a mesh, computes the distance of every vertex from vertex 0, writes a coloured file.
#include <brushfire/brushfire.h>

#include <cstdio>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    const brushfire::Mesh mesh = brushfire::read_mesh(argv[1]).mesh;
    const std::vector<brushfire::Source> sources{{brushfire::vertex_point(mesh, 0)}};

    const brushfire::DistanceField field = brushfire::distance(mesh, sources);

    brushfire::write_field(argv[2], mesh, {.values = field.distance, .labels = field.source});
    std::printf("%u of %u vertices reached\n", field.reached, mesh.vertex_count());
  } catch (const brushfire::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());  // one line: what, where, and what to do
    return 1;
  }
}
