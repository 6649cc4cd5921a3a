// brushfire matrix: distances from many places to many places.
#include "computing.h"
#include "interrupt.h"
#include "job_progress.h"
#include "matrix_files.h"
#include "row_lists.h"
#include "sources.h"
#include "surface.h"
#include "weights.h"

#include <brushfire/core/error.h>
#include <brushfire/queries/distance_matrix.h>
#include <brushfire/queries/matrix_job.h>
#include <brushfire/queries/pair_distances.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Rows and columns:
  all               every vertex, in the file's order
  0:1000, 0:1000:5  vertices from the first to before the last; 0-999,5000 has the last, too
  0,5,9             these vertices; at:1.5,0,-2, f:120:.2,.3,.5 and others as for `brushfire distance --source`
  FILE              one place, or a list of vertices, per line, as for `brushfire distance --sources`; vertices in .npy;
                    a mask or label file: where it is above 0
  FILE:LABEL,...    vertices with these labels: lh.aparc.annot:insula,cuneus

--source and --sources are another way to say --rows.

Examples:
  brushfire matrix cortex.gii -o d.npy
  brushfire matrix cortex.gii --method carried-source --symmetric mean -o d.zarr
  brushfire matrix cortex.gii --rows 0,5,9 --columns landmarks.txt --dtype float64 -o d.npy
  brushfire matrix cortex.gii --nearest 1001 -o d.npy   # sorted rows, and d.index.npy
  brushfire matrix cortex.gii --radius 20 --method exact -o near.npz
  brushfire matrix cortex.gii --shard 3/16 -o d.npy     # writes d.03-of-16.npy, for brushfire merge
  brushfire matrix pose1.off pose2.off pose3.off --normalise -o matrices/

Of several meshes every matrix becomes FOLDER/NAME.npy, by the name of the mesh's file.

.npy and .zarr are the dense matrix; with --radius, .npz (scipy.sparse.load_npz) and .mtx (MatrixMarket) hold what is
within it; there, columns are all vertices. All are jobs: interrupted or killed, the same command goes on where it
stopped; started a second time, it helps the first one. Shards of a .zarr store on a shared disk write into it together.)";

struct Arguments {
  std::string file, output;
  std::vector<std::string> more;  // files
  SharedArguments shared;
  std::string rows, columns;  // "": all
  std::string type = "float32";
  bool normalise = false;
  MatrixFileArguments file_options;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Nothing for all vertices.
std::optional<std::vector<Where>> parse_rows(const Arguments& a, Index count) {
  if (given(a.shared, {Shared::Source, Shared::Sources})) {
    if (!a.rows.empty()) refuse("--rows and --source both say where the rows start from: give one");
    return parse_point_sources(a.shared, "rows start from places");
  }
  return parse_row_list(a.rows, "--rows", count);
}

// The places of a list; nullopt for all vertices, which are those of the file.
std::optional<std::vector<Place>> places_on(const Surface& surface, PlaceFinder& finder,
                                            const std::optional<std::vector<Where>>& list) {
  const Index count = surface.file().mesh.vertex_count();
  if (!list && !surface.is_welded()) return std::nullopt;
  std::vector<Place> places;
  if (!list) {
    for (Index v = 0; v < count; ++v) places.emplace_back(surface.vertex(v));
    return places;
  }
  for (const Where& where : *list) {
    if (where.has_offset) refuse("'" + where.text + "': a matrix has no offsets");
    // A vertex in no face is a legal row (of infinities), but not a point of the surface.
    const VertexPlace* vertex = std::get_if<VertexPlace>(&where.place);
    if (vertex && vertex->index < count) {
      places.emplace_back(surface.vertex(static_cast<Index>(vertex->index)));
    } else {
      places.emplace_back(finder.source(surface.place(where)));
    }
  }
  return places;
}

bool is_sparse(const std::string& path) { return path.ends_with(".npz") || path.ends_with(".mtx"); }

void check(const Arguments& a) {
  const bool sparse = is_sparse(a.output);
  if (!sparse && !is_dense(a.output)) refuse("where to? give -o FILE.npy, .zarr, .npz or .mtx");
  check(a.file_options, a.output);
  if (!sparse) return;
  if (!a.shared.radius || *a.shared.radius == kInfinity) refuse(a.output + ": a sparse matrix needs a --radius");
  if (a.shared.weld) {
    refuse(a.output + ": its columns are the mesh's vertices: no --weld (brushfire convert writes a welded mesh)");
  }
  if (!a.columns.empty() && a.columns != "all") refuse(a.output + ": the columns of a sparse matrix are all vertices");
}

// What a run has written.
struct Written {
  std::string output;  // of a shard its own file
  std::uint64_t rows = 0, columns = 0, entries = 0, found = 0;
  bool complete = true;
};

// As files hold it.
MatrixFileOptions layout_of(const Arguments& a, double unit) {
  MatrixFileOptions layout = file_options(a.file_options);
  layout.unit = unit;
  return layout;
}

// Nothing in a .npy, .npz or .mtx file tells whether its matrix is the one that is asked for, as a store does.
void warn_of_replacing(const std::string& output, const Talk& talk) {
  if (!std::filesystem::is_regular_file(output)) return;
  talk.say(output + ": is there already; the new matrix takes its place once it is complete");
}

Written write_sparse(const Arguments& a, const Domain& domain, Places rows, ValueType type,
                     const MatrixOptions& options, double unit, const Talk& talk) {
  Written w{.output = a.output};
  std::size_t found = 0;
  w.rows = rows ? rows->size() : domain.mesh().vertex_count();
  w.columns = domain.mesh().vertex_count();
  MatrixOptions told = options;
  Progress report;
  told.distance.progress = [&](double share) {
    if (!report) {
      if (found > 0) talk.say(resuming(a.output, found, w.rows));
      if (found == 0) warn_of_replacing(a.output, talk);
      report = job_progress(talk, w.rows, found);
    }
    if (report) report(share);
  };
  w.entries = write_distances_within(a.output, domain, *a.shared.radius, rows, type, told, layout_of(a, unit), &found);
  w.found = found;
  return w;
}

Written write_dense(const Arguments& a, const Domain& domain, Places rows, Places columns, ValueType type,
                    const MatrixOptions& options, double unit, const Talk& talk) {
  Progress report;
  MatrixOptions told = options;
  told.distance.progress = [&](double share) {
    if (report) report(share);
  };
  MatrixJob job(a.output, domain, rows, columns, type, told, layout_of(a, unit));
  Written w{.output = job.output().string(), .rows = job.rows(), .found = job.found()};
  const std::uint64_t nearest = file_options(a.file_options).nearest;
  w.columns = nearest > 0 ? nearest : job.columns();
  w.entries = w.rows * w.columns;
  if (job.is_complete()) {
    talk.say(w.output + ": is complete already");
    return w;
  }
  if (w.found > 0) talk.say(resuming(w.output, w.found, w.rows));
  if (w.found == 0) warn_of_replacing(w.output, talk);
  report = job_progress(talk, w.rows, w.found);
  job.run();
  w.complete = job.is_complete();
  return w;
}

// Of one mesh.
std::uint64_t write_matrix(const Arguments& arguments, const Talk& talk) {
  check(arguments);
  MatrixOptions options;
  options.distance = computation(arguments.shared);
  options.threads = std::exchange(options.distance.threads, 1);  // they share out the rows

  const Surface surface(arguments.file, arguments.shared);
  const Index count = surface.file().mesh.vertex_count();
  const std::optional<std::vector<Where>> row_list = parse_rows(arguments, count);
  const std::optional<std::vector<Where>> column_list = parse_row_list(arguments.columns, "--columns", count);
  const Mesh& mesh = surface.mesh();
  stop_if_interrupted();
  PlaceFinder finder(mesh, arguments.shared.snap_within);
  const std::optional<std::vector<Place>> row_places = places_on(surface, finder, row_list);
  const std::optional<std::vector<Place>> column_places = places_on(surface, finder, column_list);
  finder.tell(talk);
  weigh(options.distance, arguments.shared, surface);
  const Places rows = row_places ? Places(*row_places) : std::nullopt;
  const Places columns = column_places ? Places(*column_places) : std::nullopt;
  const std::uint64_t column_count = columns ? columns->size() : mesh.vertex_count();

  const double unit = arguments.normalise ? root_of_area(mesh) : 1;
  const auto start = std::chrono::steady_clock::now();
  const ValueType type = arguments.type == "float32" ? ValueType::Float32 : ValueType::Float64;
  const Written written = is_sparse(arguments.output)
                              ? write_sparse(arguments, surface.domain(), rows, type, options, unit, talk)
                              : write_dense(arguments, surface.domain(), rows, columns, type, options, unit, talk);
  const double solve_s = seconds_since(start);
  talk.end_progress();

  if (talk.json && arguments.more.empty()) {
    Record record;
    record.add("file", arguments.file)
        .add("method", options.distance.weighting ? method_of(*options.distance.weighting)
                                                  : std::string(name_of(options.distance.method)))
        .add("precision", precision_of(options.distance))
        .add("tolerance", options.distance.weighting ? options.distance.weighting->options().tolerance
                                                     : tolerance_of(options.distance))
        .add("vertices", std::int64_t{mesh.vertex_count()})
        .add("rows", static_cast<std::int64_t>(written.rows))
        .add("resumed_at_row", static_cast<std::int64_t>(written.found))
        .add("complete", written.complete)
        .add("columns", static_cast<std::int64_t>(column_count))
        .add("entries", static_cast<std::int64_t>(written.entries))
        .add("radius", options.distance.max_distance)
        .add("normalised_by", unit)
        .add("unit", unit_of(arguments.shared))
        .add("dtype", arguments.type)
        .add("solve_s", solve_s);
    finder.add_to(record);
    write_stdout(record.add("output", written.output).json());
  } else if (!talk.json) {
    talk.say(written.output + ": " + std::to_string(written.rows) + " x " + std::to_string(written.columns) + ", " +
             counted(written.entries, "entry", "entries") + ", in " + duration(solve_s) +
             (written.complete ? "" : "; rows of other shards are still missing"));
  }
  return written.entries;
}

// Where the matrix of each of several meshes goes.
std::vector<std::filesystem::path> outputs_of(const Arguments& arguments, std::span<const std::string> files) {
  const std::filesystem::path folder(arguments.output);
  if (folder.has_extension() && !std::filesystem::is_directory(folder)) {
    refuse(arguments.output + ": several meshes need a folder: -o FOLDER/");
  }
  std::vector<std::filesystem::path> outputs;
  for (const std::string& file : files) {
    const std::filesystem::path output = folder / (std::filesystem::path(file).stem().string() + ".npy");
    if (std::find(outputs.begin(), outputs.end(), output) != outputs.end()) {
      refuse("two of the meshes would become " + output.string());
    }
    outputs.push_back(output);
  }
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw Error(ErrorCode::FileNotWritable, folder.string() + ": " + failure.message());
  return outputs;
}

int write_matrices(const Arguments& arguments, const Talk& talk) {
  std::vector<std::string> files{arguments.file};
  files.insert(files.end(), arguments.more.begin(), arguments.more.end());
  const std::vector<std::filesystem::path> outputs = outputs_of(arguments, files);
  const auto start = std::chrono::steady_clock::now();
  std::uint64_t entries = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    Arguments one = arguments;
    one.file = files[i];
    one.output = outputs[i].string();
    entries += write_matrix(one, talk);
  }
  if (talk.json) {
    Record record;
    record.add("files", static_cast<std::int64_t>(files.size()))
        .add("entries", static_cast<std::int64_t>(entries))
        .add("dtype", arguments.type)
        .add("seconds", seconds_since(start));
    write_stdout(record.add("output", arguments.output).json());
  }
  return kOk;
}

int matrix_verb(const Arguments& arguments, const Talk& talk) {
  if (!arguments.more.empty()) return write_matrices(arguments, talk);
  write_matrix(arguments, talk);
  return kOk;
}

}  // namespace

void add_matrix(CommandLine& command_line) {
  const auto arguments = std::make_shared<Arguments>();
  command_line.add("matrix", "Distances from many places to many places", [&](Verb& verb) {
    add_surface(verb, arguments->file);
    verb.arguments("MORE", arguments->more, "Further meshes: every one's matrix goes into a folder, -o FOLDER/");
    verb.option("--rows", arguments->rows, "PLACES", "all, vertices, ranges of them, labels, or a file of places");
    verb.option("--columns,--cols", arguments->columns, "PLACES", "The same for the columns");
    verb.flag("--normalise", arguments->normalise, "In units of the square root of the area of the surface");
    verb.choice("--dtype", arguments->type, {"float32", "float64"}, "Type of the values");
    verb.option("-o,--output", arguments->output, "FILE", "Write the matrix: .npy .zarr, with --radius also .npz .mtx");
    add_matrix_files(verb, arguments->file_options);
    verb.option("--shard", arguments->file_options.shard, "I/N", "Only the I-th (from 1) of N parts of the rows");
    verb.talks();
    add_shared(verb, arguments->shared,
               {.without = {{{Shared::Scalar, Shared::Name}, "distances are computed here, not read"}}});
    verb.examples(kExamples);
    verb.run([arguments](Talk& talk) { return matrix_verb(*arguments, talk); });
  });
}

}  // namespace brushfire::tool
