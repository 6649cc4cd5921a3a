// brushfire matrix: distances from many places to many places.
#include "accuracy.h"
#include "command_line.h"
#include "interrupt.h"
#include "surface.h"
#include "where.h"

#include <brushfire/core/error.h>
#include <brushfire/queries/distance_matrix.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Rows and columns:
  all               every vertex, in the file's order
  0,5,9             these vertices; at:1.5,0,-2, f:120:.2,.3,.5 and others as for `brushfire distance --source`
  FILE              one place, or a list of vertices, per line, as for `brushfire distance --sources`

Examples:
  brushfire matrix cortex.gii -o d.npy
  brushfire matrix cortex.gii --rows 0,5,9 --cols landmarks.txt --dtype float64 -o d.npy
  brushfire matrix cortex.gii --radius 20 --method exact -o near.npz

.npy is the dense matrix, written row by row: interrupted, the same command goes on where it stopped. With --radius,
.npz (scipy.sparse.load_npz) and .mtx (MatrixMarket) hold what is within it; there, columns are all vertices.)";

struct Arguments {
  SurfaceArguments surface;
  std::string output;
  std::string rows = "all", columns = "all";
  Accuracy accuracy;
  std::string type = "float32";
  std::optional<double> radius, threads, snap_within;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool is_file(const std::string& text) {
  return !text.starts_with("f:") && !text.starts_with("at:") &&
         text.find_first_not_of("0123456789,") != std::string::npos;
}

std::vector<Where> parse_places(const std::string& text) {
  if (is_file(text)) return read_where_file(text);
  std::vector<Where> places;
  for (const std::string& place : split_places({text})) places.push_back(parse_where(place));
  return places;
}

// The places of a list; nullopt for all vertices, which are those of the file.
std::optional<std::vector<Place>> places_on(const Surface& surface, PlaceFinder& finder, const std::string& text) {
  if (text == "all" && !surface.is_welded()) return std::nullopt;
  std::vector<Place> places;
  if (text == "all") {
    for (Index v = 0; v < surface.file().mesh.vertex_count(); ++v) places.emplace_back(surface.vertex(v));
    return places;
  }
  for (const Where& where : parse_places(text)) {
    if (where.has_offset) throw Error(ErrorCode::InvalidArgument, "'" + where.text + "': a matrix has no offsets");
    // A vertex in no face is a legal row (of infinities), but not a point of the surface.
    const VertexPlace* vertex = std::get_if<VertexPlace>(&where.place);
    if (vertex && vertex->index < surface.file().mesh.vertex_count()) {
      places.push_back(surface.vertex(static_cast<Index>(vertex->index)));
    } else {
      places.push_back(finder.source(surface.place(where)));
    }
  }
  return places;
}

bool is_sparse(const std::string& path) { return path.ends_with(".npz") || path.ends_with(".mtx"); }

unsigned threads_of(const Arguments& arguments) {
  const double threads = arguments.threads.value_or(0);
  if (!(threads >= 0 && threads <= 4096 && threads == std::floor(threads))) {
    throw Error(ErrorCode::InvalidArgument, "--threads takes a whole number: 0 means one per processor");
  }
  return static_cast<unsigned>(threads);
}

void check(const Arguments& arguments) {
  const bool sparse = is_sparse(arguments.output);
  check_snap_within(arguments.snap_within);
  if (!sparse && !arguments.output.ends_with(".npy")) {
    throw Error(ErrorCode::InvalidArgument, "where to? give -o FILE.npy, .npz or .mtx");
  }
  if (sparse && !arguments.radius) {
    throw Error(ErrorCode::InvalidArgument, arguments.output + ": a sparse matrix needs a --radius");
  }
  if (sparse && arguments.surface.weld) {
    throw Error(
        ErrorCode::InvalidArgument,
        arguments.output + ": its columns are the mesh's vertices: no --weld (brushfire convert writes a welded mesh)");
  }
  if (sparse && arguments.columns != "all") {
    throw Error(ErrorCode::InvalidArgument, arguments.output + ": the columns of a sparse matrix are all vertices");
  }
  if (arguments.radius && !(*arguments.radius >= 0)) {
    throw Error(ErrorCode::InvalidArgument, "--radius " + exact(*arguments.radius) + " is not a number >= 0");
  }
}

template <class T>
std::uint64_t write_sparse(const Arguments& arguments, const Mesh& mesh, Places rows, const MatrixOptions& options) {
  const SparseMatrix<T> matrix = distances_within<T>(mesh, *arguments.radius, rows, options);
  write_sparse_matrix(arguments.output, matrix);
  return matrix.value.size();
}

int matrix_verb(const Arguments& arguments, const Talk& talk) {
  check(arguments);
  MatrixOptions options;
  options.threads = threads_of(arguments);
  apply(arguments.accuracy, options.distance);
  options.distance.max_distance = arguments.radius.value_or(kInfinity);
  options.distance.cancel = &cancel_token();
  options.distance.progress = talk.progress("matrix");

  const Surface surface(arguments.surface);
  const Mesh& mesh = surface.mesh();
  stop_if_interrupted();
  PlaceFinder finder(mesh, arguments.snap_within);
  const std::optional<std::vector<Place>> row_places = places_on(surface, finder, arguments.rows);
  const std::optional<std::vector<Place>> column_places = places_on(surface, finder, arguments.columns);
  finder.tell(talk);
  const Places rows = row_places ? Places(*row_places) : std::nullopt;
  const Places columns = column_places ? Places(*column_places) : std::nullopt;
  const std::uint64_t row_count = rows ? rows->size() : mesh.vertex_count();
  const std::uint64_t column_count = columns ? columns->size() : mesh.vertex_count();

  const auto start = std::chrono::steady_clock::now();
  const bool is_float = arguments.type == "float32";
  std::uint64_t entries = row_count * column_count;
  if (is_sparse(arguments.output)) {
    entries = is_float ? write_sparse<float>(arguments, mesh, rows, options)
                       : write_sparse<double>(arguments, mesh, rows, options);
  } else {
    write_distance_matrix(arguments.output, mesh, rows, columns, is_float ? ValueType::Float32 : ValueType::Float64,
                          options);
  }
  const double solve_s = seconds_since(start);
  talk.end_progress();

  const std::optional<double> tolerance = promised_error(options.distance);
  if (talk.json) {
    Record record;
    record.add("file", arguments.surface.file)
        .add("method", std::string(name_of(options.distance.method)))
        .add("tolerance", tolerance ? Record::Value(*tolerance) : Record::Value(nullptr))
        .add("vertices", std::int64_t{mesh.vertex_count()})
        .add("rows", static_cast<std::int64_t>(row_count))
        .add("columns", static_cast<std::int64_t>(column_count))
        .add("entries", static_cast<std::int64_t>(entries))
        .add("radius", arguments.radius.value_or(kInfinity))
        .add("dtype", arguments.type)
        .add("solve_s", solve_s);
    finder.add_to(record);
    write_stdout(record.add("output", arguments.output).json());
  } else {
    talk.say(arguments.output + ": " + std::to_string(row_count) + " x " + std::to_string(column_count) + ", " +
             counted(entries, "entry", "entries") + ", in " + duration(solve_s));
  }
  return kOk;
}

}  // namespace

void add_matrix(CommandLine& command_line) {
  const auto arguments = std::make_shared<Arguments>();
  command_line.add("matrix", "Distances from many places to many places", [&](Verb& verb) {
    add_surface(verb, arguments->surface);
    verb.option("--rows", arguments->rows, "PLACES", "all, a list of vertices, or a file with one place per line");
    verb.option("--cols", arguments->columns, "PLACES", "The same for the columns");
    verb.option("-r,--radius", arguments->radius, "R",
                "Stop at this distance; what is farther reads inf or is left out");
    add_accuracy(verb, arguments->accuracy);
    verb.choice("--dtype", arguments->type, {"float32", "float64"}, "Type of the values");
    verb.option("--threads", arguments->threads, "N", "How many threads; one per processor if not given");
    add_snap_within(verb, arguments->snap_within);
    verb.option("-o,--output", arguments->output, "FILE", "Write the matrix: .npy, with --radius also .npz .mtx");
    verb.talks();
    verb.examples(kExamples);
    verb.run([arguments](Talk& talk) { return matrix_verb(*arguments, talk); });
  });
}

}  // namespace brushfire::tool
