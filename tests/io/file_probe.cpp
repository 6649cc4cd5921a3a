// What brushfire reads, as arrays for a script to compare; how long reading takes.
//
//   file_probe mesh FILE PREFIX     PREFIX.positions.npy, PREFIX.faces.npy, PREFIX.origin.npy, PREFIX.map.npy
//   file_probe field FILE PREFIX    PREFIX.values.npy
//   file_probe write FILE OUTPUT    the mesh of FILE with its x coordinates as values
//   file_probe time FILE            processor seconds of reading FILE, the median of five
#include <brushfire/core/error.h>
#include <brushfire/io/npy.h>
#include <brushfire/io/read_field.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/io/write_field.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

namespace {

using namespace brushfire;

void mesh_to_arrays(const std::string& file, const std::string& prefix) {
  const LoadedMesh loaded = read_mesh(file);
  std::vector<double> positions;
  for (const Vec3& p : loaded.mesh.positions()) positions.insert(positions.end(), {p.x, p.y, p.z});
  std::vector<Index> faces;
  for (const Face& f : loaded.mesh.faces()) faces.insert(faces.end(), f.begin(), f.end());
  const std::vector<std::size_t> positions_shape{positions.size() / 3, 3}, faces_shape{faces.size() / 3, 3};
  write_npy(prefix + ".positions.npy", positions, positions_shape);
  write_npy(prefix + ".faces.npy", faces, faces_shape);
  write_npy(prefix + ".origin.npy", loaded.face_origin);
  write_npy(prefix + ".map.npy", loaded.vertex_map);
}

void write_with_x(const std::string& file, const std::string& output) {
  const Mesh mesh = read_mesh(file).mesh;
  std::vector<double> x;
  for (const Vec3& p : mesh.positions()) x.push_back(p.x);
  write_field(output, mesh, {x, {}, "x", "source"});
}

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void time_reading(const std::string& file) {
  std::array<double, 5> times{};
  std::string format;
  for (double& t : times) {
    const double start = seconds();
    format = read_mesh(file).format;
    t = seconds() - start;
  }
  std::sort(times.begin(), times.end());
  std::printf("%s %.3f\n", format.c_str(), times[2]);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    if (words.size() == 3 && words[0] == "mesh") {
      mesh_to_arrays(words[1], words[2]);
    } else if (words.size() == 3 && words[0] == "field") {
      write_npy(words[2] + ".values.npy", read_field(words[1]).values);
    } else if (words.size() == 3 && words[0] == "write") {
      write_with_x(words[1], words[2]);
    } else if (words.size() == 2 && words[0] == "time") {
      time_reading(words[1]);
    } else {
      std::fprintf(stderr, "usage: file_probe mesh|field|write FILE OUTPUT, file_probe time FILE\n");
      return 2;
    }
  } catch (const Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 3;
  }
  return 0;
}
