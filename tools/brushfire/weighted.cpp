// Costs in place of distances: the run, and how it is told.
#include "weighted.h"

#include "fields.h"
#include "interrupt.h"
#include "sources.h"

#include <brushfire/queries/weighted_path.h>

#include <algorithm>
#include <chrono>
#include <optional>

namespace brushfire::tool {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::int64_t count(std::uint64_t n) { return static_cast<std::int64_t>(n); }

// What both verbs need: the mesh, weights, sources and targets.
struct Scene {
  Scene(const WeightedRequest& request, const Talk& talk)
      : options(weighted_computation(request.shared)),
        source_places(parse_sources(request.shared)),
        target_places(parse_places(request.targets, "a target")),
        surface(request.file, request.shared),
        finder(surface.mesh(), request.shared.snap_within) {
    stop_if_interrupted();
    sources = sources_on(surface, finder, source_places);
    for (const Where& w : target_places) options.targets.push_back(finder.target(surface.place(w)));
    finder.tell(talk);
    solver.emplace(surface.domain(), *surface.weights());
  }

  WeightedOptions options;
  std::vector<Where> source_places, target_places;
  Surface surface;
  PlaceFinder finder;
  std::vector<Source> sources;
  std::optional<WeightedSolver> solver;
};

std::string method_name(const Scene& scene) {
  if (scene.options.marching) return std::string(name_of(*scene.options.marching));
  return scene.solver->weights().uniform() > 0 ? "windows" : "steiner";
}

Record head(const WeightedRequest& request, const Scene& scene) {
  Record record;
  record.add("file", request.file)
      .add("method", method_name(scene))
      .add("weights", request.shared.weights_file)
      .add("edge_weights", request.shared.edge_weights_file)
      .add("grain", request.shared.grain_file)
      .add("slope", request.shared.slope)
      .add("towards", request.shared.towards)
      .add("tolerance", scene.options.tolerance)
      .add("sources", count(scene.sources.size()))
      .add("radius", scene.options.max_distance)
      .add("unit", unit_of(request.shared));
  return record;
}

std::string needed_in_words(const WeightedField& field) {
  const WeightedNeeds& needed = field.needed;
  if (needed.refinements == 0) return "";
  if (!needed.is_reachable) return "; refining would bring that no nearer";
  return "; everywhere with --refine " + std::to_string(field.refinements + needed.refinements) + ": some " +
         readable(needed.time) + " times as long" +
         (needed.points > 0 ? ", " + counted(needed.points, "point", "points") + " on edges" : "");
}

std::string json(const WeightedRequest& request, const Scene& scene, const WeightedField& field, double solve_s) {
  Record record = head(request, scene);
  record.add("vertices", count(scene.surface.mesh().vertex_count()))
      .add("faces", count(scene.surface.mesh().face_count()))
      .add("reached", count(field.reached))
      .add("max_error_bound", field.max_error_bound)
      .add("mean_error_bound", field.mean_error_bound)
      .add("engine", std::string(name_of(field.engine)))
      .add("points", count(field.points))
      .add("refinements", std::int64_t{field.refinements})
      .add("needed_refinements",
           field.needed.is_reachable ? Record::Value(std::int64_t{field.needed.refinements}) : Record::Value(nullptr))
      .add("needed_points", count(field.needed.points))
      .add("needed_time", field.needed.time)
      .add("solve_s", solve_s);
  std::vector<Record> targets;
  for (std::size_t i = 0; i < scene.target_places.size(); ++i) {
    targets.emplace_back()
        .add("where", scene.target_places[i].text)
        .add("reached", field.target_distance[i] < kInfinity)
        .add("cost", field.target_distance[i])
        .add("lower", field.target_lower.empty() ? Record::Value(nullptr) : Record::Value(field.target_lower[i]))
        .add("source", field.target_source[i] == kNoIndex ? std::int64_t{-1} : count(field.target_source[i]));
  }
  record.add("targets", std::move(targets));
  scene.finder.add_to(record);
  return record.add("output", request.output).json();
}

std::string in_words(const WeightedRequest& request, const Scene& scene, const WeightedField& field, double solve_s) {
  std::string text = request.file + ": " + counted(scene.surface.mesh().vertex_count(), "vertex", "vertices") + ", " +
                     counted(scene.surface.mesh().face_count(), "face", "faces") + "\n";
  text += "weighted, from " + counted(scene.sources.size(), "source", "sources") + ": reached " +
          counted(field.reached, "vertex", "vertices") + "\n";
  if (!field.lower.empty()) {
    text += "no cost is higher than the least by more than " + readable(100 * field.max_error_bound) + " % (proven), " +
            readable(100 * field.mean_error_bound) +
            " % on average; asked for: " + readable(100 * scene.options.tolerance) + " %" + needed_in_words(field) +
            "\n";
  }
  return text + "solved in " + duration(solve_s) +
         (field.engine == WeightedEngine::Windows    ? ", by windows that refract"
          : field.engine == WeightedEngine::Marching ? ", by marching: nothing is proven"
                                                     : "") +
         (field.points > 0 ? ", with " + counted(field.points, "point", "points") + " on edges" : "");
}

void refuse_unreached(const Scene& scene, const std::vector<double>& costs) {
  for (std::size_t i = 0; i < costs.size(); ++i) {
    if (costs[i] == kInfinity) throw Unreachable(scene.target_places[i].text, false);
  }
}

std::vector<Record> legs_of(const WeightedPath& path) {
  std::vector<Record> legs;
  for (const WeightedLeg& leg : path.legs) {
    Record& record = legs.emplace_back();
    record.add("face", count(leg.face))
        .add("length", leg.length)
        .add("weight", leg.weight)
        .add("toll", leg.toll)
        .add("cost", leg.cost());
    if (leg.along[0] == kNoIndex) continue;
    record.add("along", std::to_string(leg.along[0]) + " " + std::to_string(leg.along[1]));
  }
  return legs;
}

std::string json(const WeightedRequest& request, const Scene& scene, const std::vector<WeightedPath>& paths) {
  std::vector<Record> list;
  double cost = 0, length = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const WeightedPath& path = paths[i];
    cost += path.cost;
    length += path.length;
    list.emplace_back()
        .add("to", scene.target_places[i].text)
        .add("source", path.source == kNoIndex ? std::int64_t{-1} : count(path.source))
        .add("cost", path.cost)
        .add("lower", path.lower)
        .add("length", path.length)
        .add("points", count(path.points.size()))
        .add("legs", legs_of(path));
  }
  Record record = head(request, scene);
  record.add("cost", cost).add("length", length).add("paths", std::move(list));
  scene.finder.add_to(record);
  return record.add("output", request.output).json();
}

}  // namespace

int weighted_distance(const WeightedRequest& request, const Talk& talk) {
  Scene scene(request, talk);
  const bool wants_lower = request.shared.bound == "lower";
  scene.options.refinements = static_cast<unsigned>(request.refinements);
  scene.options.progress = talk.progress("distance");
  const auto start = std::chrono::steady_clock::now();
  const WeightedField field = scene.solver->distance(scene.sources, scene.options);
  const double solve_s = seconds_since(start);
  talk.end_progress();
  if (wants_lower && field.lower.empty()) refuse("--bound lower: from curves there are upper bounds only");
  if (!request.output.empty()) {
    const std::vector<double>& values = wants_lower ? field.lower : field.distance;
    const bool has_labels = !request.output.ends_with(".gii");
    write_values(scene.surface, request.output,
                 {.values = scene.surface.on_file<double>(values),
                  .labels = has_labels ? scene.surface.on_file<Index>(field.source) : std::vector<Index>{}});
  }
  const std::vector<double>& at_targets = wants_lower ? field.target_lower : field.target_distance;
  if (talk.json) {
    write_stdout(json(request, scene, field, solve_s));
  } else if (!scene.target_places.empty()) {
    std::string lines;
    for (const double d : at_targets) lines += exact(d) + "\n";
    write_stdout(lines);
  } else if (request.output.empty()) {
    write_stdout(in_words(request, scene, field, solve_s) + "\n");
  } else {
    talk.say(in_words(request, scene, field, solve_s));
  }
  refuse_unreached(scene, field.target_distance);
  return kOk;
}

int weighted_path(const WeightedRequest& request, LinesOptions drawing, const Talk& talk) {
  Scene scene(request, talk);
  if (scene.options.marching) refuse("--method: paths of costs come from points on edges");
  const std::vector<WeightedPath> paths =
      weighted_paths(*scene.solver, scene.sources, scene.options.targets, scene.options);
  std::vector<SurfacePath> lines;
  std::vector<double> costs, cost_of;  // of all; of those that are lines
  for (const WeightedPath& path : paths) {
    costs.push_back(path.cost);
    if (path.points.empty()) continue;
    lines.push_back(path);
    cost_of.push_back(path.cost);
  }
  if (!request.output.empty() && !lines.empty()) {
    drawing.values = cost_of;
    write_lines(request.output, scene.surface.mesh(), lines, "cost", "", drawing);
  }
  if (talk.json) {
    write_stdout(json(request, scene, paths));
  } else if (request.output.empty()) {
    std::string text;
    for (const double cost : costs) text += exact(cost) + "\n";
    write_stdout(text);
  }
  refuse_unreached(scene, costs);
  return kOk;
}

}  // namespace brushfire::tool
