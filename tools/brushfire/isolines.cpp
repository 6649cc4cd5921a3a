// brushfire isolines: curves of equal distance.
#include "computing.h"
#include "fields.h"
#include "interrupt.h"
#include "output.h"
#include "sources.h"
#include "surface.h"
#include "weights.h"

#include <brushfire/core/error.h>
#include <brushfire/io/write_lines.h>
#include <brushfire/queries/curved_isolines.h>
#include <brushfire/queries/isolines.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire isolines bunny.ply --source 0 --count 20 -o lines.obj
  brushfire isolines part.stl --source 0 --source 99 --every 0.4 -o toolpath.svg
  brushfire isolines bunny.ply --source 0 --levels 0.01,0.02,0.05 --chord-error 1e-5 -o arcs.json
  brushfire isolines bunny.ply --scalar thickness.npy --levels 2.5 -o contour.vtp

Straight pieces between the mesh's edges, or with --chord-error E exact arcs, written as chords that are no farther
than E from them. Each curve is ordered and oriented: smaller values on its left. Places are written as for brushfire
distance.)";

struct Arguments {
  std::string file, output, levels;
  SharedArguments shared;
  DrawingArguments drawing;
  std::optional<double> every, chord_error;
  std::optional<int> count;
};

void check(const Arguments& a) {
  check_scalar_or_source(a.shared);
  if (!a.levels.empty() + a.every.has_value() + a.count.has_value() != 1) {
    refuse("which levels? give one of --levels, --every and --count");
  }
  if (!a.levels.empty() && !decimals(a.levels)) {
    refuse("--levels takes numbers between commas (1,2.5,3), not " + in_quotes(a.levels));
  }
  if (a.chord_error) {
    if (!a.shared.scalar_file.empty())
      refuse("--chord-error: arcs follow distances: give --source in place of --scalar");
    if (const char* name = given(a.shared, kWeights)) {
      refuse("--chord-error: not with " + std::string(name) + ": arcs are those of distances");
    }
    const Method method = computation(a.shared, Method::Exact).method;
    if (method != Method::Exact && method != Method::Windows) {
      refuse("--chord-error: " + std::string(name_of(method)) + " has no arcs to follow; exact and windows have");
    }
  }
  if (a.output.empty()) refuse("where to? give -o lines.obj or another of " + extensions_of(lines_written()));
}

// The least and the greatest finite value; {inf, -inf} where there is none.
std::pair<double, double> range_of(std::span<const double> values) {
  std::pair range{kInfinity, -kInfinity};
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    range = {std::min(range.first, v), std::max(range.second, v)};
  }
  return range;
}

std::vector<double> levels_of(const Arguments& a, std::span<const double> values) {
  if (a.count) return levels_between(values, static_cast<Index>(*a.count));
  if (!a.every) {
    std::vector<double> levels = *decimals(a.levels);
    std::sort(levels.begin(), levels.end());
    return levels;
  }
  try {
    return levels_every(values, *a.every);
  } catch (const Error& e) {
    refuse(std::string("--every: ") + e.what());
  }
}

// Levels at which there can be no curve are told, with the range in which there are some.
std::size_t tell_outside(const Arguments& a, const std::vector<double>& levels, std::pair<double, double> range,
                         const Talk& talk) {
  const auto is_outside = [&](double level) { return level < range.first || level > range.second; };
  const auto outside = static_cast<std::size_t>(std::count_if(levels.begin(), levels.end(), is_outside));
  if (outside == 0 && !levels.empty()) return 0;
  const std::string values = range.first > range.second ? "there is no finite value on this mesh"
                                                        : "the values run from " + with_unit(range.first, a.shared) +
                                                              " to " + with_unit(range.second, a.shared);
  talk.say(outside == 0 ? "no level: " + values
                        : counted(outside, "level lies", "levels lie") + " outside of the range: " + values);
  return outside;
}

DistanceField solve(const Arguments& a, const Surface& surface, PlaceFinder& places, const Talk& talk) {
  const std::vector<Source> sources = sources_on(surface, places, parse_sources(a.shared));
  places.tell(talk);
  DistanceOptions options = computation(a.shared, Method::Exact);
  weigh(options, a.shared, surface);
  options.keep_windows = a.chord_error.has_value();
  options.progress = talk.progress("distance");
  DistanceField field = distance(surface.domain(), sources, options);
  talk.end_progress();
  return field;
}

std::vector<Isoline> curves_of(const Arguments& a, const Domain& domain, const DistanceField& field,
                               const std::vector<double>& levels) {
  if (!a.chord_error)
    return isolines(domain, field.side_distance.empty() ? field.distance : field.side_distance, levels);
  std::vector<Isoline> found = curved_isolines(*field.windows, levels, *a.chord_error);
  for (Isoline& line : found) domain.to_mesh(line.line.points);
  return found;
}

int isolines_verb(const Arguments& a, const Talk& talk) {
  check(a);
  LinesOptions drawing = lines_options(a.output, a.drawing, a.shared);
  const Surface surface(a.file, a.shared);
  const Mesh& mesh = surface.mesh();
  stop_if_interrupted();
  PlaceFinder places(mesh, a.shared.snap_within);
  DistanceField field;
  if (a.shared.scalar_file.empty()) {
    field = solve(a, surface, places, talk);
  } else {
    field.distance = values_on(surface, a.shared.scalar_file, a.shared.array_name);
  }
  const std::vector<double> levels = levels_of(a, field.distance);
  const std::pair<double, double> range = range_of(field.distance);
  const std::size_t outside = tell_outside(a, levels, range, talk);
  const std::vector<Isoline> found = curves_of(a, surface.domain(), field, levels);
  std::vector<SurfacePath> lines;
  std::vector<double> level_of;
  double length = 0;
  std::int64_t closed = 0;
  for (const Isoline& line : found) {
    lines.push_back(line.line);
    level_of.push_back(line.level);
    length += line.line.length;
    closed += line.line.closed;
  }
  drawing.values = level_of;
  write_lines(a.output, mesh, lines, "level", "", drawing);
  if (talk.json) {
    Record record;
    record.add("file", a.file)
        .add("least", range.first)
        .add("greatest", range.second)
        .add("unit", unit_of(a.shared))
        .add("levels", static_cast<std::int64_t>(levels.size()))
        .add("levels_outside", static_cast<std::int64_t>(outside))
        .add("lines", static_cast<std::int64_t>(lines.size()))
        .add("closed", closed)
        .add("length", length);
    places.add_to(record);
    record.add("output", a.output);
    write_stdout(record.json());
  } else {
    talk.say(counted(lines.size(), "curve", "curves") + " at " + counted(levels.size(), "level", "levels") + ", " +
             with_unit(length, a.shared) + " long in all");
  }
  return kOk;
}

}  // namespace

void add_isolines(CommandLine& command_line) {
  const auto a = std::make_shared<Arguments>();
  command_line.add("isolines", "Curves of equal distance, ordered and oriented", [&](Verb& verb) {
    add_surface(verb, a->file);
    verb.option("--levels", a->levels, "L,L,...", "At these values");
    verb.option("--every", a->every, "H", kPositive, "At the multiples of H");
    verb.option("--count", a->count, "N", whole_from(1, 1000000), "At N values that divide the range evenly");
    verb.option("--chord-error,--curved", a->chord_error, "E", kPositive, "Exact arcs, as polylines that near to them");
    add_lines_output(verb, a->output, a->drawing);
    verb.talks();
    add_shared(verb, a->shared, {.method = "exact"});
    verb.examples(kExamples);
    verb.run([a](Talk& talk) { return isolines_verb(*a, talk); });
  });
}

}  // namespace brushfire::tool
