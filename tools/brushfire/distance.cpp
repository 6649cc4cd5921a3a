// brushfire distance: the distance of every vertex from the nearest source.
#include "computing.h"
#include "fields.h"
#include "interrupt.h"
#include "numbers.h"
#include "output.h"
#include "reached.h"
#include "sources.h"
#include "surface.h"
#include "weighted.h"
#include "where.h"

#include <brushfire/queries/curve_sides.h>
#include <brushfire/solvers/distance.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Places (for --source and --target):
  17                vertex 17, counted from 0 in the file's order
  0,5,9             three vertices
  f:120:.2,.3,.5    in face 120, with these weights of its three corners
  at:1.5,0,-2       the point of the surface nearest to this position
  17@0.5            any of them, with the value 0.5 to start from (sources only)

Curves (for --source):
  boundary          the boundary of the mesh; boundary:2 is one of the curves that brushfire info lists
  path:0,at:1,0,2   the shortest path between places
  chain:3,4,5       along the edges between vertices
  region:F:LABEL    a region by the labels of file F, of vertices or of faces: 0 inside
  drawn.obj         the curves of a file (.csv .json .obj .ply .vtp), each a source of its own

Examples:
  brushfire distance bunny.ply --source 0
  brushfire distance bunny.ply --source 0 --source 1200@0.05 -o distance.npy
  brushfire distance bunny.ply --sources landmarks.txt --radius 0.1 -o coloured.ply
  brushfire distance bunny.ply --source 0 --target 5000 --target f:120:.2,.3,.5
  brushfire distance bunny.ply --source 0 --method dijkstra --json
  brushfire distance part.stl --source boundary -o from-the-rim.ply
  brushfire distance bunny.ply --source drawn.obj --signed -o sides.ply
  brushfire distance bunny.ply --source 0 --tolerance 1e-4 -o within-0.01-percent.npy
  brushfire distance bunny.ply --source 0 --target 5000 --tolerance fine --bound upper
  brushfire distance terrain.ply --source 0 --weights friction.npy -o cost.npy
  brushfire distance bunny.ply --source 0 -o - | sort -t, -gk2 | tail -1

The extension of -o decides: .ply (MeshLab; colours, and the distance as vertex quality), .vtk .vtp (ParaView), .obj
(colours only), .npy (float64), .csv, .json, .gii, .curv. Only .json tells vertices that were not visited from those
that cannot be reached.
Without -o and --target the result is told in words. Targets print one distance per line, inf and exit code 4
where no source reaches; the run ends once their distances are final, so that a file written beside them may hold less
than all. Vertices that cannot be reached, or lie beyond the radius, read inf in files.)";

struct Arguments {
  std::string file, output;
  SharedArguments shared;
  std::vector<std::string> targets;
  bool labels = false, is_signed = false;
  std::optional<int> refine;
};

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

// Everything about one run that is told, in words or as JSON.
struct Run {
  Mesh mesh;
  std::vector<Source> sources;
  DistanceOptions options;
  std::vector<Where> target_places;
  DistanceField field;
  Reached reached;
  double read_s = 0, set_up_s = 0, solve_s = 0;

  // The vertex that is farthest away among those reached; kNoIndex where none is.
  Index farthest() const {
    Index best = kNoIndex;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const double d = field.distance[v];
      if (d != kInfinity && (best == kNoIndex || d > field.distance[best])) best = v;
    }
    return best;
  }
};

void check(const Arguments& arguments, const Talk& talk) {
  check_output(arguments.output);
  if (arguments.is_signed) check_signed(arguments.shared);
  if (arguments.is_signed && !arguments.targets.empty()) {
    refuse("--signed: not with --target: the field has the signs");
  }
  if (arguments.output == "-" && (talk.json || !arguments.targets.empty())) {
    refuse("only one of -o -, --json and --target can have the standard output");
  }
}

std::int64_t count(std::uint64_t n) { return static_cast<std::int64_t>(n); }

std::string json(const Arguments& arguments, const Run& run, const PlaceFinder& places) {
  const DistanceField& field = run.field;
  const Index farthest = run.farthest();
  Record record;
  record.add("file", arguments.file)
      .add("method", std::string(name_of(field.method)))
      .add("precision", precision_of(run.options))
      .add("tolerance", tolerance_of(run.options))
      .add("bound", field.method == Method::Windows ? Record::Value(name_of(run.options.bound)) : nullptr)
      .add("vertices", count(run.mesh.vertex_count()))
      .add("faces", count(run.mesh.face_count()))
      .add("sources", count(run.sources.size()))
      .add("radius", run.options.max_distance)
      .add("unit", unit_of(arguments.shared));
  run.reached.add_to(record);
  record.add("max_error_bound", field.max_error_bound)
      .add("max_distance", farthest == kNoIndex ? kInfinity : field.distance[farthest])
      .add("farthest_vertex", farthest == kNoIndex ? -1 : count(farthest))
      .add("updates", count(field.updates))
      .add("read_s", run.read_s)
      .add("set_up_s", run.set_up_s)
      .add("solve_s", run.solve_s);
  std::vector<Record> targets;
  for (std::size_t i = 0; i < run.target_places.size(); ++i) {
    const bool reached = field.target_distance[i] != kInfinity;
    Record& target = targets.emplace_back();
    target.add("where", run.target_places[i].text)
        .add("reached", reached)
        .add("unreachable", !reached && run.reached.is_unreachable(run.options.targets[i]))
        .add("distance", field.target_distance[i])
        .add("source", reached ? count(field.target_source[i]) : -1);
  }
  record.add("targets", std::move(targets));
  places.add_to(record);
  record.add("output", arguments.output);
  return record.json();
}

double least(const DistanceField& field) { return *std::min_element(field.distance.begin(), field.distance.end()); }

std::string in_words(const Arguments& arguments, const Run& run) {
  const DistanceField& field = run.field;
  std::string text = arguments.file + ": " + counted(run.mesh.vertex_count(), "vertex", "vertices") + ", " +
                     counted(run.mesh.face_count(), "face", "faces") + "\n";
  text += std::string(name_of(field.method)) + " from " + counted(run.sources.size(), "source", "sources") +
          " reached " + counted(field.reached, "vertex", "vertices") + run.reached.in_words() + "\n";
  if (const Index v = run.farthest(); v != kNoIndex) {
    text += "farthest: vertex " + std::to_string(v) + " at " + with_unit(field.distance[v], arguments.shared) + "\n";
    if (arguments.is_signed) text += "least: " + with_unit(least(field), arguments.shared) + "\n";
  }
  if (field.method == Method::Windows) {
    text += "no distance is wrong by more than " + readable(100 * field.max_error_bound) +
            " % (proven; asked for: " + readable(100 * run.options.tolerance) + " %)\n";
  }
  text += "read in " + duration(run.read_s) + ", set up in " + duration(run.set_up_s) + ", solved in " +
          duration(run.solve_s);
  return text;
}

// On the file's own vertices, whatever was welded. GIFTI holds maps, and a second one only where it is asked for.
void write(const Arguments& arguments, const Run& run, const Surface& surface) {
  const std::vector<double> values = surface.on_file<double>(run.field.distance);
  std::vector<Index> labels;
  if (arguments.labels || !arguments.output.ends_with(".gii")) labels = surface.on_file<Index>(run.field.source);
  const std::vector<std::uint8_t> not_visited = run.reached.not_visited(run.field.distance);
  write_values(surface, arguments.output,
               {.values = values, .labels = labels, .not_visited = surface.on_file<std::uint8_t>(not_visited)});
}

int distance_verb(const Arguments& arguments, const Talk& talk) {
  // What can be wrong without the mesh is said before a large file is read.
  check(arguments, talk);
  if (given(arguments.shared, kWeights)) {
    return weighted_distance(
        {arguments.file, arguments.output, arguments.shared, arguments.targets, arguments.refine.value_or(0)}, talk);
  }
  if (arguments.refine) refuse("--refine: without weights every distance is within the tolerance anyway");
  Run run;
  DistanceOptions& options = run.options;
  options = computation(arguments.shared, arguments.is_signed ? Method::Exact : DistanceOptions{}.method);
  options.keep_paths = arguments.is_signed;
  const std::vector<Where> source_places = parse_sources(arguments.shared);
  run.target_places = parse_places(arguments.targets, "a target");

  const Stopwatch reading;
  const Surface surface(arguments.file, arguments.shared);
  run.mesh = surface.mesh();
  run.read_s = reading.seconds();
  stop_if_interrupted();

  PlaceFinder places(run.mesh, arguments.shared.snap_within);
  run.sources = sources_on(surface, places, source_places);
  options.progress = talk.progress("distance");
  for (const Where& w : run.target_places) options.targets.push_back(places.target(surface.place(w)));
  places.tell(talk);

  const Stopwatch setting_up;
  DistanceSolver solver(surface.domain());
  solver.set_up(options);
  run.set_up_s = setting_up.seconds();

  const Stopwatch solving;
  run.field = solver.distance(run.sources, options);
  if (arguments.is_signed) run.field.distance = signed_distance(surface.domain(), run.field, run.sources);
  run.solve_s = solving.seconds();
  talk.end_progress();
  run.reached = Reached(surface.domain(), run.sources, options, run.field);

  if (!arguments.output.empty()) write(arguments, run, surface);
  if (talk.json) {
    write_stdout(json(arguments, run, places));
  } else if (!run.target_places.empty()) {
    std::string lines;
    for (const double d : run.field.target_distance) lines += exact(d) + "\n";
    write_stdout(lines);
  } else if (arguments.output.empty()) {
    write_stdout(in_words(arguments, run) + "\n");
  } else {
    talk.say(in_words(arguments, run));
  }
  for (std::size_t i = 0; i < run.target_places.size(); ++i) {
    if (run.field.target_distance[i] != kInfinity) continue;
    throw Unreachable(run.target_places[i].text, !run.reached.is_unreachable(options.targets[i]));
  }
  return kOk;
}

}  // namespace

void add_distance(CommandLine& command_line) {
  const auto arguments = std::make_shared<Arguments>();
  command_line.add("distance", "Distance of every vertex from the nearest source", [&](Verb& verb) {
    add_surface(verb, arguments->file);
    verb.option("-t,--target", arguments->targets, "PLACE", "Print the distance of this point; may be repeated");
    verb.option("-o,--output", arguments->output, "FILE",
                ("Write the field: " + extensions_of(fields_written()) + "; - prints CSV").c_str());
    verb.flag("--labels", arguments->labels, "Write the nearest source into .gii too, as other formats have it");
    verb.flag("--signed", arguments->is_signed,
              "From curves: negative on their left, as inside of those that run counter-clockwise");
    verb.option("--refine", arguments->refine, "N", whole_from(0, 30),
                "With --weights: run again, N times at most, until the tolerance is met everywhere");
    verb.talks();
    add_shared(verb, arguments->shared,
               {.without = {{{Shared::Scalar, Shared::Name}, "distances are computed here, not read"}}});
    verb.examples(kExamples);
    verb.run([arguments](Talk& talk) { return distance_verb(*arguments, talk); });
  });
}

}  // namespace brushfire::tool
