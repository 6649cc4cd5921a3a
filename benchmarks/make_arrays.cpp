// Turns a mesh file into raw arrays that every program of a comparison reads, refined as often as asked.
//
//   make_arrays MESH VERTICES FACES [ROUNDS]
//
// Writes float64 x y z and int32 triples (raw, little endian). Each of the ROUNDS splits every triangle into four by
// Loop's rule, with noise of 2 % of the edge length, so that the result is curved and irregular at its own scale and
// not a flat copy of the coarse mesh. Not a scan, but near one.
#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/subdivide.h>

#include <cstdint>
#include <cstdio>
#include <string>

#include "measure.h"

namespace brushfire::benchmark {
namespace {

int run(int count, char** arguments) {
  if (count < 4) {
    std::fprintf(stderr, "usage: make_arrays MESH VERTICES FACES [ROUNDS]\n");
    return 2;
  }
  Mesh mesh = read_mesh(arguments[1]).mesh;
  const int rounds = count > 4 ? std::stoi(arguments[4]) : 0;
  for (int round = 0; round < rounds; ++round) {
    mesh = subdivided(mesh, {SubdivisionRule::LoopOdd, 0.02, static_cast<std::uint64_t>(round) + 1}).mesh();
  }
  write_positions(arguments[2], mesh.positions());
  write_faces(arguments[3], mesh.faces());
  return 0;
}

}  // namespace
}  // namespace brushfire::benchmark

int main(int count, char** arguments) {
  return brushfire::benchmark::guarded("make_arrays", brushfire::benchmark::run, count, arguments);
}
