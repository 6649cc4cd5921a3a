// brushfire sample: places spread evenly over a surface.
#include "computing.h"
#include "fields.h"
#include "interrupt.h"
#include "output.h"
#include "sources.h"
#include "surface.h"
#include "weights.h"

#include <brushfire/queries/centroidal.h>
#include <brushfire/queries/sampling.h>

#include <algorithm>
#include <memory>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire sample bunny.ply --count 100 > places.txt
  brushfire sample bunny.ply --count 100 --source 12000 -o distance-from-samples.ply
  brushfire sample cortex.gii --count 200 --lloyd --mask cortex.label -o cells.label.gii > seeds.txt

Farthest points: again and again the vertex that is farthest from all before it, one number per line; --source says
where to begin. With --lloyd these are then moved to the middles of their cells, exactly and for at most --rounds rounds
(20): cells of about one size, around points of faces, written as f:FACE:WEIGHTS. Either list is what --sources of the
other verbs reads. -o writes the distance from the nearest of them and its number for every vertex.)";

struct Arguments {
  std::string file, output;
  SharedArguments shared;
  std::optional<int> count, rounds;
  bool lloyd = false;
};

// What was found, in either way.
struct Found {
  std::vector<std::string> places;
  std::vector<double> distance;
  std::vector<Index> nearest;
  double covering_radius = 0;
  std::vector<double> energy;  // of --lloyd
};

std::vector<Index> first_vertices(const Arguments& a, const Surface& surface, PlaceFinder& finder) {
  std::vector<Index> first;
  if (!given(a.shared, {Shared::Source, Shared::Sources})) return first;
  for (const Source& s : sources_on(surface, finder, parse_point_sources(a.shared, "samples are vertices"))) {
    const PointLocation at = locate(surface.mesh(), s.point);
    if (at.on != PointLocation::On::Vertex) refuse("samples are vertices: --source takes vertices here");
    first.push_back(at.vertex);
  }
  return first;
}

Found farthest(const Arguments& a, const Surface& surface, PlaceFinder& finder, const DistanceOptions& options) {
  Samples s =
      farthest_points(surface.domain(), static_cast<Index>(*a.count), first_vertices(a, surface, finder), options);
  Found found{{}, std::move(s.distance), std::move(s.nearest), s.covering_radius, {}};
  for (const Index v : s.vertices) found.places.push_back(std::to_string(surface.file_vertex(v)));
  return found;
}

std::string place_text(const SurfacePoint& p) {
  return "f:" + std::to_string(p.face) + ":" + exact(p.weights[0]) + "," + exact(p.weights[1]) + "," +
         exact(p.weights[2]);
}

Found centroidal(const Arguments& a, const Surface& surface, PlaceFinder& finder, const DistanceOptions& how) {
  const Samples s = farthest_points(surface.domain(), static_cast<Index>(*a.count), first_vertices(a, surface, finder));
  std::vector<SurfacePoint> first;
  for (const Index v : s.vertices) first.push_back(vertex_point(surface.mesh(), v));
  CentroidalOptions options;
  options.max_rounds = static_cast<Index>(a.rounds.value_or(static_cast<int>(options.max_rounds)));
  options.threads = how.threads;
  options.progress = how.progress;
  options.cancel = how.cancel;
  CentroidalVoronoi c = centroidal_voronoi(surface.domain(), first, options);
  Found found{{}, std::move(c.distance), std::move(c.nearest), 0, std::move(c.energy)};
  for (const SurfacePoint& p : c.sites) found.places.push_back(place_text(p));
  for (const double d : found.distance)
    found.covering_radius = d < kInfinity ? std::max(found.covering_radius, d) : found.covering_radius;
  return found;
}

int sample_verb(const Arguments& a, const Talk& talk) {
  check_output(a.output);
  if (!a.count) refuse("how many? give --count");
  if (a.output == "-") refuse("the list has the standard output: -o takes a file");
  if (a.rounds && !a.lloyd) refuse("--rounds is for --lloyd");
  if (a.lloyd && given(a.shared, {Shared::Method, Shared::Tolerance, Shared::Bound, Shared::Radius})) {
    refuse("--lloyd is exact: there is no --method, tolerance or radius to choose");
  }
  if (const char* name = given(a.shared, kWeights); name != nullptr && a.lloyd) {
    refuse("--lloyd: not with " + std::string(name) + ": middles of cells are those of distances");
  }
  DistanceOptions options = computation(a.shared);
  const Surface surface(a.file, a.shared);
  stop_if_interrupted();
  PlaceFinder finder(surface.mesh(), a.shared.snap_within);
  weigh(options, a.shared, surface);
  options.progress = talk.progress("samples");
  const Found found = a.lloyd ? centroidal(a, surface, finder, options) : farthest(a, surface, finder, options);
  finder.tell(talk);
  talk.end_progress();
  if (!a.output.empty()) {
    write_values(surface, a.output,
                 {.values = surface.on_file<double>(found.distance),
                  .labels = surface.on_file<Index>(found.nearest),
                  .label_name = "sample"});
  }
  if (talk.json) {
    Record record;
    record.add("file", a.file)
        .add("unit", unit_of(a.shared))
        .add("count", static_cast<std::int64_t>(found.places.size()))
        .add("places", found.places)
        .add("covering_radius", found.covering_radius)
        .add("rounds", a.lloyd ? Record::Value(static_cast<std::int64_t>(found.energy.size() - 1)) : nullptr)
        .add("energy", a.lloyd ? Record::Value(found.energy.back()) : nullptr)
        .add("energy_before", a.lloyd ? Record::Value(found.energy.front()) : nullptr);
    finder.add_to(record);
    write_stdout(record.add("output", a.output).json());
    return kOk;
  }
  std::string lines;
  for (const std::string& place : found.places) lines += place + "\n";
  write_stdout(lines);
  talk.say(counted(found.places.size(), "place", "places") + ", no vertex farther than " +
           with_unit(found.covering_radius, a.shared) + " from one");
  return kOk;
}

}  // namespace

void add_sample(CommandLine& command_line) {
  const auto a = std::make_shared<Arguments>();
  command_line.add("sample", "Places spread evenly over the surface", [&](Verb& verb) {
    add_surface(verb, a->file);
    verb.option("--count", a->count, "N", whole_from(1, 1000000), "How many");
    verb.flag("--lloyd", a->lloyd, "Then move them to the middles of their cells");
    verb.option("--rounds", a->rounds, "N", whole_from(0, 100000), "At most so many times (20)");
    verb.option("-o,--output", a->output, "FILE",
                ("Write the distance from the nearest: " + extensions_of(fields_written())).c_str());
    verb.talks();
    add_shared(verb, a->shared,
               {.without = {{{Shared::Scalar, Shared::Name}, "distances are computed here, not read"}}});
    verb.examples(kExamples);
    verb.run([a](Talk& talk) { return sample_verb(*a, talk); });
  });
}

}  // namespace brushfire::tool
