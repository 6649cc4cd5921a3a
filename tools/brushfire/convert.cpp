// brushfire convert: any file that is read to any that is written.
#include "output.h"
#include "surface.h"
#include "where.h"

#include <brushfire/core/error.h>
#include <brushfire/io/read_field.h>
#include <brushfire/io/read_lines.h>
#include <brushfire/io/write_field.h>
#include <brushfire/io/write_mesh.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <utility>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire convert scan.obj scan.ply
  brushfire convert part.stl part.off --weld 1e-6
  brushfire convert lh.white lh.white.surf.gii
  brushfire convert lh.white lh.thickness.ply --scalar lh.thickness
  brushfire convert distance.npy distance.csv
  brushfire convert path.json path.dxf --mesh part.stl --unit in

What is converted is what the output holds: a mesh, with the values of --scalar where it has a place for them; values on
vertices where the output is .npy, .csv, .json, .curv, .shape.gii, .func.gii or .label.gii; curves where it is .svg or
.dxf, or with --mesh, the surface that they lie on. A field file alone is converted without a mesh. Numbers of vertices
stay; --weld changes them. With walls the mesh is what they leave open, cut apart along them: a vertex on a wall becomes
one on each side of it, the first keeps its number, the others follow behind all.)";

struct Arguments {
  std::string input, output, mesh_file;
  SharedArguments shared;
  DrawingArguments drawing;
};

bool ends_with_any(const std::string& text, std::initializer_list<const char*> ends) {
  return std::any_of(ends.begin(), ends.end(), [&](const char* end) { return text.ends_with(end); });
}

bool holds_values_only(const std::string& output) {
  return ends_with_any(output, {".npy", ".csv", ".json", ".curv", ".shape.gii", ".func.gii", ".label.gii"});
}

// The values of a file by itself, on the vertices that it lists or in its order.
FieldView view_of(const std::vector<double>& values, const LoadedField& field) {
  FieldView view{.values = values};
  const bool is_plain = !field.name.empty() && std::all_of(field.name.begin(), field.name.end(), [](unsigned char c) {
    return c < 128 && (std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.');
  });
  view.name = is_plain ? field.name : "value";
  return view;
}

std::vector<std::uint8_t> not_visited_of(const LoadedField& field, Index vertices) {
  std::vector<std::uint8_t> out(field.not_visited.empty() ? 0 : vertices, 0);
  for (const Index v : field.not_visited) out[v] = 1;
  return out;
}

std::string convert_field(const Arguments& a, const std::string& file) {
  const LoadedField field = read_field(file, a.shared.array_name);
  Index vertices = static_cast<Index>(field.values.size());
  for (const Index v : field.vertices) vertices = std::max(vertices, v + 1);
  const std::vector<double> values = values_on_vertices(field, vertices);
  // Formats of values know the number of vertices of a mesh, and nothing else of it.
  const Mesh mesh(std::vector<Vec3>(vertices), {});
  const std::vector<std::uint8_t> not_visited = not_visited_of(field, vertices);
  FieldView view = view_of(values, field);
  view.not_visited = not_visited;
  write_field(a.output, mesh, view);
  return field.format;
}

std::string convert_mesh(const Arguments& a) {
  const Surface surface(a.input, a.shared);
  const Domain& domain = surface.domain();
  if (a.shared.scalar_file.empty()) {
    write_mesh(a.output, surface.open_for_file(), "", surface.file().structure);
    return surface.file().format;
  }
  const LoadedField field = read_field(a.shared.scalar_file, a.shared.array_name);
  const std::vector<double> values = domain.spread(
      surface.on_mesh(values_on_vertices(field, surface.file().mesh.vertex_count()), a.shared.scalar_file));
  FieldView view = view_of(values, field);
  view.structure = surface.file().structure;
  const std::vector<std::uint8_t> not_visited = not_visited_of(field, surface.file().mesh.vertex_count());
  if (!surface.is_welded() && !domain.has_walls()) view.not_visited = not_visited;
  write_field(a.output, surface.open_for_file(), view);
  return surface.file().format;
}

// A mesh of nothing but the curves' points, one face at each: for drawings, which need no surface.
Mesh mesh_of_points(const LoadedLines& loaded) {
  std::vector<Vec3> positions;
  for (const LoadedLine& line : loaded.lines) {
    positions.insert(positions.end(), line.positions.begin(), line.positions.end());
  }
  std::vector<Face> faces;
  for (Index v = 0; v < positions.size(); ++v) faces.push_back({v, v, v});
  return Mesh(std::move(positions), std::move(faces));
}

bool is_drawing(const std::string& output) { return ends_with_any(output, {".svg", ".dxf"}); }

std::string convert_lines(const Arguments& a, const Talk& talk) {
  LinesOptions drawing = lines_options(a.output, a.drawing, a.shared);
  const LoadedLines loaded = read_lines(a.input);
  const bool has_mesh = !a.mesh_file.empty();
  if (!has_mesh && a.drawing.outline) refuse("--outline needs the --mesh");
  const Mesh mesh = has_mesh ? Surface(a.mesh_file, a.shared).mesh() : mesh_of_points(loaded);
  PlaceFinder finder(mesh, a.shared.snap_within);
  std::vector<SurfacePath> lines;
  std::vector<double> values;
  Index point = 0;
  for (const LoadedLine& line : loaded.lines) {
    SurfacePath& out = lines.emplace_back();
    out.closed = line.closed;
    values.push_back(line.value);
    if (has_mesh && !line.points.empty()) {
      out.points = line.points;
    } else {
      if (line.positions.empty() && !line.points.empty()) refuse(a.input + " has no positions: give the --mesh");
      for (const Vec3& p : line.positions) {
        const Where where{.place = p, .text = "point " + std::to_string(point)};
        out.points.push_back(has_mesh ? finder.target(where) : SurfacePoint{point, {1, 0, 0}});
        ++point;
      }
    }
  }
  finder.tell(talk);
  drawing.values = values;
  write_lines(a.output, mesh, lines, loaded.value_name.empty() ? "value" : loaded.value_name, "", drawing);
  return loaded.format;
}

std::string convert(const Arguments& a, const Talk& talk) {
  const bool is_mesh = a.mesh_file.empty() && !is_drawing(a.output) && !holds_values_only(a.output);
  if (is_mesh) return convert_mesh(a);
  if (const char* walls = given(a.shared, kWalls)) refuse(std::string(walls) + ": " + a.output + " holds no mesh");
  if (!a.mesh_file.empty() || is_drawing(a.output)) return convert_lines(a, talk);
  check_output(a.output);
  return convert_field(a, a.shared.scalar_file.empty() ? a.input : a.shared.scalar_file);
}

// Before a large file is read.
void check(const Arguments& a) {
  if (!a.mesh_file.empty() || is_drawing(a.output) || holds_values_only(a.output)) return;
  try {
    a.shared.scalar_file.empty() ? check_mesh_format(a.output) : check_field_format(a.output);
  } catch (const Error& e) {
    refuse(e.what());
  }
}

int convert_verb(const Arguments& a, const Talk& talk) {
  check(a);
  const std::string format = convert(a, talk);
  if (talk.json) {
    write_stdout(Record().add("file", a.input).add("format", format).add("output", a.output).json());
  } else {
    talk.say(a.output + ": from " + format);
  }
  return kOk;
}

}  // namespace

void add_convert(CommandLine& command_line) {
  const auto a = std::make_shared<Arguments>();
  command_line.add("convert", "Any file that is read to any that is written", [&](Verb& verb) {
    const std::string in = "What to convert. Meshes: " + names_of(meshes_read()) +
                           ".\nValues: " + names_of(fields_read()) + ".\nCurves: " + names_of(lines_read());
    const std::string out = "Where to. Meshes: " + extensions_of(meshes_written()) +
                            ".\nValues: " + extensions_of(fields_written()) +
                            ".\nCurves: " + extensions_of(lines_written());
    verb.argument("INPUT", a->input, in.c_str());
    verb.argument("OUTPUT", a->output, out.c_str());
    verb.option("--mesh", a->mesh_file, "FILE", "The input is curves, on this mesh");
    add_drawing(verb, a->drawing);
    verb.talks();
    add_shared(verb, a->shared,
               {.without = {{kWeights, "convert computes no distances"},
                            {{Shared::Source, Shared::Sources}, "nothing starts here: convert computes no distances"},
                            {kComputing, "convert computes no distances"}}});
    verb.examples(kExamples);
    verb.run([a](Talk& talk) { return convert_verb(*a, talk); });
  });
}

}  // namespace brushfire::tool
