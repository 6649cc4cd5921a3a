// brushfire path: shortest paths, through waypoints, and curves pulled tight.
#include "command_line.h"
#include "interrupt.h"
#include "output.h"
#include "surface.h"
#include "where.h"

#include <brushfire/core/error.h>
#include <brushfire/io/write_lines.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/shorten.h>

#include <memory>
#include <optional>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire path bunny.ply --from 0 --to 12000
  brushfire path bunny.ply --from 0 --to f:120:.2,.3,.5 -o path.obj
  brushfire path bunny.ply --from 0 --to 12000 --via 77 --via 3100 -o path.json
  brushfire path bunny.ply --from 0 --via 500 --via 900 --closed --tighten -o loop.vtp
  brushfire path bunny.ply --from 0 --to 12000 --method dijkstra -o edges.csv

The path is exact: its length is the distance to rounding. --via goes through points in the order given, and bends
there; --tighten pulls the whole like a rubber band until it is locally shortest, keeping its way around handles and
holes (--from and --to stay where they are; a --closed one is held nowhere). Methods other than exact and dijkstra have
no paths. Without -o the length is printed. Places are written as for brushfire distance. Exit code 4: no way.)";

struct Arguments {
  SurfaceArguments surface;
  DrawingArguments drawing;
  std::string from, to, output, method = "exact";
  std::vector<std::string> via;
  std::optional<double> snap_within;
  bool closed = false, tighten = false;
};

void check(const Arguments& a) {
  if (a.from.empty()) throw Error(ErrorCode::InvalidArgument, "where from? give --from");
  if (a.to.empty() && !a.closed) throw Error(ErrorCode::InvalidArgument, "where to? give --to (or --closed)");
  if (a.closed && !a.to.empty()) throw Error(ErrorCode::InvalidArgument, "a --closed path ends at --from: no --to");
  check_snap_within(a.snap_within);
  if (a.method != "exact" && (!a.via.empty() || a.closed || a.tighten)) {
    throw Error(ErrorCode::InvalidArgument, "--via, --closed and --tighten need --method exact");
  }
}

std::vector<std::string> places_of(const Arguments& a) {
  std::vector<std::string> places{a.from};
  places.insert(places.end(), a.via.begin(), a.via.end());
  if (!a.to.empty()) places.push_back(a.to);
  return places;
}

SurfacePath along_edges(const Mesh& mesh, const SurfacePoint& from, const SurfacePoint& to) {
  if (from.is_nowhere() || to.is_nowhere()) return {};
  const PointLocation a = locate(mesh, from), b = locate(mesh, to);
  if (a.on != PointLocation::On::Vertex || b.on != PointLocation::On::Vertex) {
    throw Error(ErrorCode::InvalidArgument, "paths along edges (--method dijkstra) run between vertices");
  }
  DistanceOptions options;
  options.method = Method::Dijkstra;
  options.targets = {to};
  options.cancel = &cancel_token();
  const Source source{from};
  return edge_path_to(mesh, distance(mesh, std::span(&source, 1), options), b.vertex);
}

SurfacePath find(const Arguments& a, const Mesh& mesh, std::span<const SurfacePoint> points) {
  if (a.method == "dijkstra") return along_edges(mesh, points.front(), points.back());
  SurfacePath path = PathFinder(mesh).through(points, a.closed, &cancel_token());
  if (a.tighten && !path.points.empty()) path = shorten(mesh, path.points, a.closed);
  return path;
}

int path_verb(const Arguments& a, const Talk& talk) {
  check(a);
  const LinesOptions drawing = lines_options(a.output, a.drawing);
  std::vector<Where> places;
  for (const std::string& text : places_of(a)) {
    places.push_back(parse_where(text));
    if (places.back().has_offset) throw Error(ErrorCode::InvalidArgument, "'" + text + "': a path has no offset");
  }
  const Surface surface(a.surface);
  const Mesh& mesh = surface.mesh();
  stop_if_interrupted();
  PlaceFinder finder(mesh, a.snap_within);
  std::vector<SurfacePoint> points;
  for (const Where& w : places) points.push_back(finder.target(surface.place(w)));
  finder.tell(talk);

  const SurfacePath path = find(a, mesh, points);
  if (path.points.empty()) throw Unreachable(places.back().text);
  if (!a.output.empty()) {
    const SurfaceLine line{path.points, path.closed, path.length};
    write_lines(a.output, mesh, std::span(&line, 1), "length", "", drawing);
  }
  if (talk.json) {
    Record record;
    record.add("file", a.surface.file)
        .add("method", a.method)
        .add("length", path.length)
        .add("points", static_cast<std::int64_t>(path.points.size()))
        .add("closed", path.closed);
    finder.add_to(record);
    record.add("output", a.output);
    write_stdout(record.json());
  } else if (a.output.empty()) {
    write_stdout(exact(path.length) + "\n");
  }
  return kOk;
}

}  // namespace

void add_path(CommandLine& command_line) {
  const auto arguments = std::make_shared<Arguments>();
  command_line.add("path", "Shortest path between points", [&](Verb& verb) {
    add_surface(verb, arguments->surface);
    verb.option("--from", arguments->from, "PLACE", "Where the path begins");
    verb.option("--to", arguments->to, "PLACE", "Where it ends");
    verb.option("--via", arguments->via, "PLACE", "A point on the way; may be repeated");
    verb.flag("--closed", arguments->closed, "Back to --from in the end");
    verb.flag("--tighten", arguments->tighten, "Pull tight: no bends at --via");
    verb.choice("-m,--method", arguments->method, {"exact", "dijkstra"}, "How to compute");
    add_snap_within(verb, arguments->snap_within);
    add_lines_output(verb, arguments->output, arguments->drawing);
    verb.talks();
    verb.examples(kExamples);
    verb.run([arguments](Talk& talk) { return path_verb(*arguments, talk); });
  });
}

}  // namespace brushfire::tool
