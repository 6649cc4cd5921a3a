// brushfire terrain: a mesh from a grid of heights, and values of its vertices as a grid.
#include "command_line.h"
#include "fields.h"
#include "numbers.h"
#include "output.h"

#include <brushfire/io/read_grid.h>
#include <brushfire/io/write_field.h>
#include <brushfire/io/write_grid.h>
#include <brushfire/mesh/report.h>

#include <memory>
#include <optional>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire terrain dem.asc -o terrain.ply
  brushfire terrain heights.npy --cell 30 -o terrain.ply
  brushfire terrain heights.npy --cell 30 --no-data -32768 -o terrain.ply
  brushfire distance terrain.ply --source 0 --slope tobler -o seconds.npy
  brushfire terrain dem.asc --values seconds.npy -o seconds.asc
  brushfire terrain dem.tif -o terrain.ply       (where the build has GDAL)

The vertices are the grid's, row by row; cells without a height are holes. Each cell is two triangles, over the diagonal
along which the heights differ less. Without GDAL: gdal_translate -of AAIGrid dem.tif dem.asc.)";

struct Arguments {
  std::string file, output, values;
  std::optional<double> cell, no_data;
};

// What the vertices have, as a grid that lies where the heights do.
int write_values_as_grid(const Arguments& a, Grid grid, const Talk& talk) {
  grid.heights = values_of(read_field(a.values), a.values, grid.heights.size(), a.file);
  write_grid(a.output, grid);
  if (talk.json) {
    Record record;
    record.add("file", a.file)
        .add("values", a.values)
        .add("columns", std::int64_t{grid.columns})
        .add("rows", std::int64_t{grid.rows})
        .add("output", a.output);
    write_stdout(record.json());
  } else {
    talk.say(a.output + ": " + std::to_string(grid.columns) + " x " + std::to_string(grid.rows) + " values");
  }
  return kOk;
}

int terrain(const Arguments& a, const Talk& talk) {
  if (a.values.empty()) check_output(a.output);
  Grid grid = read_grid(a.file);
  if (a.cell) grid.placement = {{0, 0}, {*a.cell, 0}, {0, -*a.cell}};
  if (!a.values.empty()) return write_values_as_grid(a, std::move(grid), talk);
  const Terrain made(grid.heights, grid.columns, grid.rows, grid.placement, a.no_data.value_or(kInfinity));
  const Mesh& mesh = made.mesh();
  write_field(a.output, mesh, {}, a.output == "-" ? "ply" : "");
  const auto holes = 2 * std::uint64_t{grid.columns - 1} * (grid.rows - 1) - mesh.face_count();
  if (talk.json) {
    Record record;
    record.add("file", a.file)
        .add("columns", std::int64_t{grid.columns})
        .add("rows", std::int64_t{grid.rows})
        .add("vertices", std::int64_t{mesh.vertex_count()})
        .add("faces", std::int64_t{mesh.face_count()})
        .add("faces_missing", static_cast<std::int64_t>(holes))
        .add("output", a.output);
    write_stdout(record.json());
  } else {
    talk.say(a.output + ": " + std::to_string(grid.columns) + " x " + std::to_string(grid.rows) + " heights, " +
             counted(mesh.face_count(), "face", "faces") +
             (holes > 0 ? ", " + counted(holes, "is", "are") + " missing for want of heights" : ""));
  }
  return kOk;
}

}  // namespace

void add_terrain(CommandLine& command_line) {
  const auto arguments = std::make_shared<Arguments>();
  command_line.add("terrain", "Make a mesh of a grid of heights", [&](Verb& verb) {
    verb.argument(
        "FILE", arguments->file,
        "The grid: .asc (ESRI ASCII grid; - is standard input), .npy (rows x columns); .tif and others by GDAL");
    verb.option("--cell", arguments->cell, "S", kPositive, "How far apart the heights are, in their own unit (1)");
    verb.option("--no-data", arguments->no_data, "V", kAnyNumber, "Heights that stand for none, besides NaN");
    verb.option(
        "--values", arguments->values, "FIELD",
        "Values of the vertices, in place of heights: writes a grid, .asc .npy .tif, that lies where FILE does");
    verb.required_option("-o,--output", arguments->output, "FILE", "Where to: .ply .vtk .obj ...; - prints PLY");
    verb.talks();
    verb.examples(kExamples);
    verb.run([arguments](Talk& talk) { return terrain(*arguments, talk); });
  });
}

}  // namespace brushfire::tool
