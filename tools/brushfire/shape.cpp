// brushfire shape: meshes of well-known surfaces, to try things on.
#include "command_line.h"
#include "output.h"

#include <brushfire/io/write_field.h>
#include <brushfire/mesh/delaunay.h>
#include <brushfire/mesh/shapes.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire shape sphere -o sphere.ply
  brushfire shape terrain --vertices 1000000 -o terrain.ply
  brushfire shape paper-square -o square.obj
)";

// Every generator takes the number of vertices that it should come near to.
struct NamedShape {
  const char* name;
  std::function<Shape(double vertices)> make;
};

Index rounded(double value, double least = 1) {
  constexpr double kMost = 4e9;  // fits; whether the shape does is for the generator to say
  return static_cast<Index>(std::clamp(std::round(value), least, kMost));
}

// Of an icosahedron split so often: 10 * 4^levels + 2 vertices.
Index icosphere_levels(double vertices) { return rounded(std::log2(std::max(1.0, (vertices - 2) / 10)) / 2, 0); }

const std::vector<NamedShape>& named_shapes() {
  static const std::vector<NamedShape> shapes{
      {"plane", [](double n) { return shapes::plane(rounded(std::sqrt(n) - 1), rounded(std::sqrt(n) - 1)); }},
      {"delaunay-square",
       [](double n) {
         const Index side = rounded(0.8 * std::sqrt(n));
         return shapes::delaunay_square(side, rounded(n - 4.0 * side, 0));
       }},
      {"paper-square", [](double) { return shapes::paper_square(); }},
      {"saddle", [](double n) { return shapes::saddle(rounded(std::sqrt(n) - 1)); }},
      {"terrain", [](double n) { return shapes::noise_terrain(rounded(std::sqrt(n) - 1), rounded(std::sqrt(n) - 1)); }},
      {"cube", [](double n) { return shapes::cube(rounded(std::sqrt(n / 6))); }},
      {"sphere", [](double n) { return shapes::icosphere(icosphere_levels(n)); }},
      {"folded-sphere", [](double n) { return shapes::folded_sphere(icosphere_levels(n)); }},
      {"cone", [](double n) { return shapes::cone(rounded(std::sqrt(n / 6)), rounded(6 * std::sqrt(n / 6), 3)); }},
      {"cylinder",
       [](double n) { return shapes::cylinder(rounded(std::sqrt(n / 6)), rounded(6 * std::sqrt(n / 6), 3)); }},
      {"torus",
       [](double n) { return shapes::torus(rounded(1.6 * std::sqrt(n), 3), rounded(0.63 * std::sqrt(n), 3)); }},
  };
  return shapes;
}

struct Arguments {
  std::string name, output;
  std::optional<double> vertices;
};

int shape(const Arguments& arguments, const Talk& talk) {
  constexpr double kVertices = 10000;
  const double vertices = arguments.vertices.value_or(kVertices);
  check_output(arguments.output);
  Mesh mesh;
  for (const NamedShape& s : named_shapes()) {
    if (s.name == arguments.name) mesh = s.make(vertices).mesh();
  }
  write_field(arguments.output, mesh, {}, arguments.output == "-" ? "ply" : "");
  talk.say(arguments.output + ": " + counted(mesh.vertex_count(), "vertex", "vertices") + ", " +
           counted(mesh.face_count(), "face", "faces"));
  return kOk;
}

}  // namespace

void add_shape(CommandLine& command_line) {
  const auto arguments = std::make_shared<Arguments>();
  std::vector<std::string> names;
  for (const NamedShape& s : named_shapes()) names.emplace_back(s.name);
  command_line.add("shape", "Make a mesh of a well-known surface", [&](Verb& verb) {
    verb.choice("shape", arguments->name, names, "Which one");
    verb.option("-n,--vertices", arguments->vertices, "N", {.low = 1}, "About how many vertices (10000)");
    verb.required_option("-o,--output", arguments->output, "FILE", "Where to: .ply .vtk .obj ...; - prints PLY");
    verb.talks();
    verb.examples(kExamples);
    verb.run([arguments](Talk& talk) { return shape(*arguments, talk); });
  });
}

}  // namespace brushfire::tool
