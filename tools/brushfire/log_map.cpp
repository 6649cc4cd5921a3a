// brushfire log-map: the surroundings of a place, laid flat.
#include "computing.h"
#include "interrupt.h"
#include "output.h"
#include "sources.h"
#include "surface.h"

#include <brushfire/io/write_columns.h>
#include <brushfire/mesh/reachable.h>
#include <brushfire/queries/log_coordinates.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire log-map bunny.ply --source 17 --radius 0.02 -o disc.csv
  brushfire log-map bunny.ply --source 17 --radius 0.02 --direction 0,1,0 -o decal.obj
  brushfire log-map bunny.ply --source at:0.1,0.2,0 --snap-within 0.01 -o polar.npy
  brushfire log-map bunny.ply --source 17 --radius 0.02 -o - | sort -t, -gk4 | tail -1

For every vertex within the radius: its distance from the source (exact), and the angle at which the shortest path leaves
there, counter-clockwise from --direction (or from the first edge there), in radians. u and v are the same in Cartesian
coordinates, u along that direction: what a decal is stuck on by. At a vertex the faces around add up to the full turn
that is told, more or less than 2 pi; u and v are laid flat by stretching it to 2 pi (at the mesh's border it stays).

.csv and .json list the vertices that were reached. .npy has a row u, v, radius, angle for every vertex of the mesh, nan
where it was not reached. .ply, .vtk and .obj hold the part of the mesh that was reached, with u and v as texture
coordinates and, but for .obj, `vertex`, the number in the whole mesh. Without -o the result is told in words.)";

constexpr std::size_t kColumns = 4;  // u, v, radius, angle

struct Arguments {
  std::string file, direction, output;
  SharedArguments shared;
};

void check(const Arguments& a, const Talk& talk) {
  check_output(a.output, Columns::Kind::Texture);
  if (a.output == "-" && talk.json) refuse("only one of -o - and --json can have the standard output");
}

std::optional<Vec3> direction_of(const Arguments& a) {
  if (a.direction.empty()) return std::nullopt;
  const std::optional<std::vector<double>> xyz = decimals(a.direction);
  if (!xyz || xyz->size() != 3 || *xyz == std::vector<double>{0, 0, 0}) {
    refuse("--direction takes X,Y,Z, three numbers that are not all 0, not " + in_quotes(a.direction));
  }
  return Vec3{(*xyz)[0], (*xyz)[1], (*xyz)[2]};
}

// u, v, radius and angle of each.
std::vector<double> rows_of(const Mesh& mesh, const SurfacePoint& source, const SparseLogMap& map) {
  const std::vector<std::array<double, 2>> flat = flat_coordinates(mesh, source, map);
  std::vector<double> rows;
  rows.reserve(kColumns * flat.size());
  for (std::size_t i = 0; i < flat.size(); ++i) {
    rows.insert(rows.end(), {flat[i][0], flat[i][1], map.radius[i], map.angle[i]});
  }
  return rows;
}

// On the numbers of the file, which are more where vertices were joined.
SparseLogMap on_file(const Surface& surface, SparseLogMap map) {
  if (!surface.is_welded()) return map;
  std::vector<Index> row(surface.mesh().vertex_count(), kNoIndex);
  for (std::size_t i = 0; i < map.vertex.size(); ++i) row[map.vertex[i]] = static_cast<Index>(i);
  SparseLogMap out{{}, {}, {}, map.total_angle};
  for (Index v = 0; v < surface.file().mesh.vertex_count(); ++v) {
    const Index i = row[surface.vertex(v)];
    if (i == kNoIndex) continue;
    out.vertex.push_back(v);
    out.radius.push_back(map.radius[i]);
    out.angle.push_back(map.angle[i]);
  }
  return out;
}

std::string json(const Arguments& a, const Surface& surface, const SurfacePoint& source, const SparseLogMap& map,
                 const PlaceFinder& finder) {
  const Index count = surface.file().mesh.vertex_count();
  const std::vector<Index> is_reachable = [&] {
    const Domain& domain = surface.domain();
    const std::vector<std::uint8_t> on_open = reachable(domain.open(), domain.on_open(source));
    std::vector<Index> on_mesh(domain.mesh().vertex_count(), 0);
    for (Index v = 0; v < on_open.size(); ++v) on_mesh[domain.vertex(v)] |= on_open[v];
    return surface.on_file<Index>(on_mesh);
  }();
  const auto connected = std::count(is_reachable.begin(), is_reachable.end(), 1);
  const auto reached = static_cast<std::int64_t>(map.vertex.size());
  Record record;
  record.add("file", a.file)
      .add("vertices", std::int64_t{count})
      .add("radius", a.shared.radius.value_or(kInfinity))
      .add("unit", unit_of(a.shared))
      .add("reached", reached)
      .add("unreachable", std::int64_t{count} - connected)
      .add("not_visited", std::int64_t{connected} - reached)
      .add("max_distance", map.radius.empty() ? 0 : *std::max_element(map.radius.begin(), map.radius.end()))
      .add("total_angle", map.total_angle);
  finder.add_to(record);
  return record.add("output", a.output).json();
}

int log_map_verb(const Arguments& a, const Talk& talk) {
  check(a, talk);
  const std::optional<Vec3> direction = direction_of(a);
  const std::vector<Where> places = parse_point_sources(a.shared, "a log map is around one place");
  if (places.size() != 1) {
    refuse("a log map is around one place: " + std::to_string(places.size()) + " were given");
  }
  if (places[0].has_offset) refuse("'" + places[0].text + "': a log map has no offset");
  DistanceOptions options = computation(a.shared, Method::Exact);
  const Surface surface(a.file, a.shared);
  const Mesh& mesh = surface.mesh();
  stop_if_interrupted();
  PlaceFinder finder(mesh, a.shared.snap_within);
  const SurfacePoint source = sources_on(surface, finder, places).front().point;
  finder.tell(talk);

  options.progress = talk.progress("log map");
  DistanceSolver solver(surface.domain());
  SparseLogMap map = log_map(solver, source, options);
  talk.end_progress();
  // Directions are those in what is open; a source that has several sides was refused.
  const Mesh& open = surface.domain().open();
  const SurfacePoint side = surface.domain().on_open(source).front();
  turn(open, side, direction, map);
  map = on_file(surface, std::move(map));

  if (!a.output.empty()) {
    const std::vector<double> rows = rows_of(open, side, map);
    write_columns(a.output, surface.file().mesh,
                  {.names = {"u", "v", "radius", "angle"},
                   .values = rows,
                   .rows = map.vertex,
                   .kind = Columns::Kind::Texture,
                   .name = "log_map"},
                  a.output == "-" ? "csv" : "");
  }
  if (talk.json) {
    write_stdout(json(a, surface, source, map, finder));
    return kOk;
  }
  const std::string words =
      counted(map.vertex.size(), "vertex", "vertices") +
      (a.shared.radius ? " within " + with_unit(*a.shared.radius, a.shared) : std::string(" reached")) + " of '" +
      places[0].text + "', where the full turn is " + readable(map.total_angle) + " rad";
  a.output.empty() ? write_stdout(words + "\n") : talk.say(words);
  return kOk;
}

}  // namespace

void add_log_map(CommandLine& command_line) {
  const auto a = std::make_shared<Arguments>();
  command_line.add("log-map", "Distance and direction of every vertex around a place", [&](Verb& verb) {
    add_surface(verb, a->file);
    verb.option("--direction", a->direction, "X,Y,Z", "Where angle 0 points, laid onto the surface");
    verb.option(
        "-o,--output", a->output, "FILE",
        ("Write the map: " + extensions_of(columns_written(Columns::Kind::Texture)) + "; - prints CSV").c_str());
    verb.talks();
    const std::string exact = "a log map is exact, it is read off shortest paths";
    add_shared(verb, a->shared,
               {.without = {{kWeights, "directions and lengths of exact paths are those of the surface"},
                            {kAccuracy, exact},
                            {{Shared::Method}, exact},
                            {{Shared::Scalar, Shared::Name}, "distances are computed here, not read"}}});
    verb.examples(kExamples);
    verb.run([a](Talk& talk) { return log_map_verb(*a, talk); });
  });
}

}  // namespace brushfire::tool
