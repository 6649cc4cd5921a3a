// brushfire isolines: curves of equal distance.
#include "command_line.h"
#include "interrupt.h"
#include "output.h"
#include "surface.h"
#include "where.h"

#include <brushfire/core/error.h>
#include <brushfire/io/read_field.h>
#include <brushfire/io/write_lines.h>
#include <brushfire/queries/curved_isolines.h>
#include <brushfire/queries/isolines.h>
#include <brushfire/solvers/distance.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire isolines bunny.ply --source 0 --count 20 -o lines.obj
  brushfire isolines part.stl --source 0 --source 99 --every 0.4 -o toolpath.svg
  brushfire isolines bunny.ply --source 0 --levels 0.01,0.02,0.05 --curved 1e-5 -o arcs.json
  brushfire isolines bunny.ply --scalar thickness.npy --levels 2.5 -o contour.vtp

Straight pieces between the mesh's edges, or with --curved E exact arcs within the chord error E. Each curve is ordered
and oriented: smaller values on its left. Places are written as for brushfire distance.)";

struct Arguments {
  SurfaceArguments surface;
  DrawingArguments drawing;
  std::string output, levels, scalar_file, method = "exact";
  std::vector<std::string> sources;
  std::optional<double> every, count, curved, snap_within;
};

void check(const Arguments& a) {
  if (a.sources.empty() == a.scalar_file.empty()) refuse("give --source (the distance from there) or --scalar");
  if (!a.levels.empty() + a.every.has_value() + a.count.has_value() != 1) {
    refuse("which levels? give one of --levels, --every and --count");
  }
  if (a.curved && (!a.scalar_file.empty() || a.method != "exact"))
    refuse("--curved needs a --source and --method exact");
  check_snap_within(a.snap_within);
  if (a.output.empty()) refuse("where to? give -o lines.obj or another of " + extensions_of(lines_written()));
}

// "1,2.5,3": numbers between commas.
std::vector<double> numbers(const std::string& text) {
  std::vector<double> out;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    double value = 0;
    const auto [stop, status] = std::from_chars(text.data() + begin, text.data() + end, value);
    if (status != std::errc() || stop != text.data() + end) refuse("'" + text + "': levels are written as 1,2.5,3");
    out.push_back(value);
    begin = end + 1;
  }
  return out;
}

std::vector<double> levels_of(const Arguments& a, std::span<const double> values) {
  if (a.every) {
    try {
      return levels_every(values, *a.every);
    } catch (const Error& e) {
      refuse(std::string("--every: ") + e.what());
    }
  }
  if (!a.count) {
    std::vector<double> levels = numbers(a.levels);
    std::sort(levels.begin(), levels.end());
    return levels;
  }
  constexpr double kMost = 1e6;
  if (!(*a.count >= 1 && *a.count <= kMost) || *a.count != std::floor(*a.count)) {
    refuse("--count takes a whole number from 1 to 1000000");
  }
  return levels_between(values, static_cast<Index>(*a.count));
}

DistanceField solve(const Arguments& a, const Surface& surface, PlaceFinder& places, const Talk& talk) {
  const Mesh& mesh = surface.mesh();
  std::vector<Source> sources;
  for (const std::string& text : split_places(a.sources)) {
    const Where where = parse_where(text);
    sources.push_back({places.source(surface.place(where)), where.offset});
  }
  places.tell(talk);
  DistanceOptions options;
  options.method = method_named(a.method);
  options.keep_windows = a.curved.has_value();
  options.cancel = &cancel_token();
  options.progress = talk.progress("distance");
  DistanceField field = distance(mesh, sources, options);
  talk.end_progress();
  return field;
}

int isolines_verb(const Arguments& a, const Talk& talk) {
  check(a);
  const LinesOptions drawing = lines_options(a.output, a.drawing);
  const Surface surface(a.surface);
  const Mesh& mesh = surface.mesh();
  stop_if_interrupted();
  PlaceFinder places(mesh, a.snap_within);
  DistanceField field;
  if (a.sources.empty()) {
    if (surface.is_welded()) refuse("--scalar has values for the file's vertices: no --weld");
    field.distance = values_on_vertices(read_field(a.scalar_file), mesh.vertex_count(), kInfinity);
  } else {
    field = solve(a, surface, places, talk);
  }
  const std::vector<double> levels = levels_of(a, field.distance);
  const std::vector<Isoline> found =
      a.curved ? curved_isolines(*field.windows, levels, *a.curved) : isolines(mesh, field.distance, levels);
  std::vector<SurfaceLine> lines;
  double length = 0;
  std::int64_t closed = 0;
  for (const Isoline& line : found) {
    lines.push_back({line.line.points, line.line.closed, line.level});
    length += line.line.length;
    closed += line.line.closed;
  }
  write_lines(a.output, mesh, lines, "level", "", drawing);
  if (talk.json) {
    Record record;
    record.add("file", a.surface.file)
        .add("levels", static_cast<std::int64_t>(levels.size()))
        .add("lines", static_cast<std::int64_t>(lines.size()))
        .add("closed", closed)
        .add("length", length);
    places.add_to(record);
    record.add("output", a.output);
    write_stdout(record.json());
  } else {
    talk.say(counted(lines.size(), "curve", "curves") + " at " + counted(levels.size(), "level", "levels") + ", " +
             readable(length) + " long in all");
  }
  return kOk;
}

}  // namespace

void add_isolines(CommandLine& command_line) {
  const auto a = std::make_shared<Arguments>();
  std::vector<std::string> methods;
  for (const Method m : all_methods()) methods.emplace_back(name_of(m));
  command_line.add("isolines", "Curves of equal distance, ordered and oriented", [&](Verb& verb) {
    add_surface(verb, a->surface);
    verb.option("-s,--source", a->sources, "PLACE", "Distances from here; may be repeated");
    verb.option("--scalar", a->scalar_file, "FIELD", "These values instead, one per vertex");
    verb.option("--levels", a->levels, "L,L,...", "At these values");
    verb.option("--every", a->every, "H", "At the multiples of H");
    verb.option("--count", a->count, "N", "At N values that divide the range evenly");
    verb.option("--curved", a->curved, "E", "Exact arcs, as polylines within this chord error");
    verb.choice("-m,--method", a->method, methods, "How to compute");
    add_snap_within(verb, a->snap_within);
    add_lines_output(verb, a->output, a->drawing);
    verb.talks();
    verb.examples(kExamples);
    verb.run([a](Talk& talk) { return isolines_verb(*a, talk); });
  });
}

}  // namespace brushfire::tool
