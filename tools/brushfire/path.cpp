// brushfire path: shortest paths, through waypoints, and curves pulled tight.
#include "computing.h"
#include "interrupt.h"
#include "output.h"
#include "sources.h"
#include "surface.h"
#include "weighted.h"

#include <brushfire/io/write_lines.h>
#include <brushfire/mesh/reachable.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/shorten.h>

#include <algorithm>
#include <memory>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire path bunny.ply --from 0 --to 12000
  brushfire path bunny.ply --from 0 --to f:120:.2,.3,.5 -o path.obj
  brushfire path bunny.ply --from 0 --to 12000 --via 77 --via 3100 -o path.json
  brushfire path bunny.ply --sources exits.txt --to 12000 --to 300 -o way-out.vtp
  brushfire path bunny.ply --from 0 --via 500 --via 900 --closed --tighten -o loop.vtp
  brushfire path bunny.ply --from 0 --to 12000 --method dijkstra -o edges.csv
  brushfire path terrain.ply --from 0 --to 900 --weights friction.npy --edge-weights roads.txt --json

The path is exact: its length is the distance to rounding. Of several sources the nearest one is taken, for each --to.
--via goes through points in the order given, and bends there; --tighten pulls the whole like a rubber band until it is
locally shortest, keeping its way around handles and holes (--from and --to stay where they are; a --closed one is held
nowhere). Without -o the lengths are printed, one per line. Places are written as for brushfire distance. Exit code 4:
no way, or none within --radius.)";

struct Arguments {
  std::string file, output;
  SharedArguments shared;
  DrawingArguments drawing;
  std::vector<std::string> to, via;
  bool closed = false, tighten = false;
};

// A path, and where from and where to, by their places among those given.
struct Found {
  SurfacePath path;
  Index source = kNoIndex;
  std::string to;
};

Method method_of(const Arguments& a) {
  if (given(a.shared, kWeights)) return Method::Exact;
  const Method method = computation(a.shared, Method::Exact).method;
  if (method != Method::Exact && method != Method::Dijkstra) {
    refuse("--method: " + std::string(name_of(method)) + " has no paths; exact and dijkstra have");
  }
  return method;
}

// Waypoints, and what is done to the path through them.
bool is_tour(const Arguments& a) { return !a.via.empty() || a.closed || a.tighten; }

void check(const Arguments& a) {
  if (!given(a.shared, {Shared::Source, Shared::Sources})) refuse("where from? give --from");
  if (a.to.empty() && !a.closed) refuse("where to? give --to (or --closed)");
  if (a.closed && !a.to.empty()) refuse("a --closed path ends at --from: no --to");
  if (method_of(a) != Method::Exact && is_tour(a)) refuse("--via, --closed and --tighten need --method exact");
  if (given(a.shared, kWeights) && is_tour(a)) refuse("--via, --closed and --tighten are for paths without weights");
}

std::vector<Found> along_edges(const Domain& domain, const std::vector<Source>& sources,
                               const std::vector<SurfacePoint>& targets, const DistanceOptions& options) {
  const auto check_vertex = [&](const SurfacePoint& p) {
    if (p.is_nowhere() || locate(domain.mesh(), p).on == PointLocation::On::Vertex) return;
    refuse("paths along edges (--method dijkstra) run between vertices");
  };
  for (const Source& s : sources) {
    if (s.curve) refuse("--method dijkstra: paths along edges start at vertices, not at curves");
    check_vertex(s.point);
  }
  for (const SurfacePoint& t : targets) check_vertex(t);
  std::vector<Found> found;
  for (SourcePath& path : edge_paths_to(domain, sources, targets, options)) {
    const Index source = path.source;
    found.push_back({std::move(path), source, ""});
  }
  return found;
}

std::vector<Found> across_faces(const Domain& domain, const std::vector<Source>& sources,
                                const std::vector<SurfacePoint>& targets, const DistanceOptions& options) {
  DistanceSolver solver(domain);
  std::vector<Found> found;
  for (SourcePath& path : paths_to(solver, sources, targets, options)) {
    const Index source = path.source;
    found.push_back({std::move(path), source, ""});
  }
  return found;
}

std::vector<Found> tour(const Arguments& a, const Domain& domain, const std::vector<SurfacePoint>& waypoints,
                        const DistanceOptions& options) {
  DistanceSolver solver(domain);
  SurfacePath path = path_through(solver, waypoints, a.closed, options);
  if (a.tighten && !path.points.empty()) path = shorten(domain, path.points, a.closed);
  return {{std::move(path), 0, ""}};
}

std::string json(const Arguments& a, Method method, const std::vector<Found>& all, const PlaceFinder& finder) {
  double length = 0;
  std::int64_t points = 0;
  std::vector<Record> list;
  for (const Found& f : all) {
    length += f.path.length;
    points += static_cast<std::int64_t>(f.path.points.size());
    list.emplace_back()
        .add("to", f.to)
        .add("source", f.source == kNoIndex ? std::int64_t{-1} : std::int64_t{f.source})
        .add("length", f.path.length)
        .add("points", static_cast<std::int64_t>(f.path.points.size()));
  }
  Record record;
  record.add("file", a.file)
      .add("method", std::string(name_of(method)))
      .add("radius", a.shared.radius.value_or(kInfinity))
      .add("unit", unit_of(a.shared))
      .add("length", length)
      .add("points", points)
      .add("closed", a.closed)
      .add("paths", std::move(list));
  finder.add_to(record);
  return record.add("output", a.output).json();
}

void write(const Arguments& a, const Mesh& mesh, const std::vector<Found>& all, const LinesOptions& drawing) {
  std::vector<SurfacePath> lines;
  for (const Found& f : all) {
    if (!f.path.points.empty()) lines.push_back(f.path);
  }
  if (!lines.empty()) write_lines(a.output, mesh, lines, "length", "", drawing);
}

bool is_connected(const Domain& domain, const std::vector<Source>& sources, const SurfacePoint& target) {
  const std::vector<std::uint8_t> is_reachable = reachable(domain.open(), open_places_of(domain, sources));
  const std::vector<SurfacePoint> ends = domain.on_open(target);
  return std::any_of(ends.begin(), ends.end(),
                     [&](const SurfacePoint& p) { return is_reachable[domain.open().faces()[p.face][0]] != 0; });
}

int path_verb(const Arguments& a, const Talk& talk) {
  check(a);
  const LinesOptions drawing = lines_options(a.output, a.drawing, a.shared);
  if (given(a.shared, kWeights)) return weighted_path({a.file, a.output, a.shared, a.to}, drawing, talk);
  const DistanceOptions options = computation(a.shared, Method::Exact);
  const std::vector<Where> source_places = parse_sources(a.shared), via = parse_places(a.via, "a waypoint"),
                           to = parse_places(a.to, "the end of a path");
  if (is_tour(a) && (source_places.size() != 1 || to.size() + (a.closed ? 1 : 0) != 1)) {
    refuse("--via, --closed and --tighten are for one --from and one --to");
  }
  if (is_tour(a) && source_places.front().is_curve()) refuse("--via, --closed and --tighten go from place to place");
  const Surface surface(a.file, a.shared);
  const Mesh& mesh = surface.mesh();
  stop_if_interrupted();
  PlaceFinder finder(mesh, a.shared.snap_within);
  const std::vector<Source> sources = sources_on(surface, finder, source_places);
  std::vector<SurfacePoint> waypoints{sources.front().point}, targets;
  for (const Where& w : via) waypoints.push_back(finder.target(surface.place(w)));
  for (const Where& w : to) targets.push_back(finder.target(surface.place(w)));
  waypoints.insert(waypoints.end(), targets.begin(), targets.end());
  finder.tell(talk);

  std::vector<Found> found = is_tour(a) ? tour(a, surface.domain(), waypoints, options)
                             : options.method == Method::Exact
                                 ? across_faces(surface.domain(), sources, targets, options)
                                 : along_edges(surface.domain(), sources, targets, options);
  for (std::size_t i = 0; i < found.size(); ++i) found[i].to = a.closed ? source_places[0].text : to[i].text;
  if (!a.output.empty()) write(a, mesh, found, drawing);
  if (talk.json) {
    write_stdout(json(a, options.method, found, finder));
  } else if (a.output.empty()) {
    std::string lines;
    for (const Found& f : found) lines += exact(f.path.length) + "\n";
    write_stdout(lines);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i].path.points.empty()) continue;
    throw Unreachable(found[i].to,
                      is_connected(surface.domain(), sources, targets.empty() ? waypoints.back() : targets[i]));
  }
  return kOk;
}

}  // namespace

void add_path(CommandLine& command_line) {
  const auto arguments = std::make_shared<Arguments>();
  command_line.add("path", "Shortest paths between points", [&](Verb& verb) {
    add_surface(verb, arguments->file);
    verb.option("-t,--to,--target", arguments->to, "PLACE", "Where it ends; may be repeated");
    verb.option("--via", arguments->via, "PLACE", "A point on the way; may be repeated");
    verb.flag("--closed", arguments->closed, "Back to --from in the end");
    verb.flag("--tighten", arguments->tighten, "Pull tight: no bends at --via");
    add_lines_output(verb, arguments->output, arguments->drawing);
    verb.talks();
    add_shared(verb, arguments->shared,
               {.without = {{kAccuracy, "a path is exact, its length is the distance to rounding"},
                            {{Shared::Scalar, Shared::Name}, "a path follows distances, which are computed here"}},
                .also = {{Shared::Source, "--from"}},
                .method = "exact; only exact and dijkstra have paths"});
    verb.examples(kExamples);
    verb.run([arguments](Talk& talk) { return path_verb(*arguments, talk); });
  });
}

}  // namespace brushfire::tool
