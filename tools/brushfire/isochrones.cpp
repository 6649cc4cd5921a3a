// brushfire isochrones: what is reached within given costs, as polygons for maps.
#include "command_line.h"
#include "fields.h"
#include "numbers.h"
#include "output.h"
#include "surface.h"

#include <brushfire/io/write_bytes.h>
#include <brushfire/queries/isochrones.h>

#include <cstdint>
#include <memory>
#include <span>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire terrain dem.asc -o terrain.ply
  brushfire distance terrain.ply --source 4711 --slope tobler -o seconds.npy
  brushfire isochrones terrain.ply seconds.npy --levels 600,1200,1800 -o walks.geojson

One MultiPolygon for each level, in the mesh's x and y, for surfaces of which no two faces are over one another. Without
-o they go to standard output.)";

struct Arguments {
  std::string file, field, levels, output;
  SharedArguments shared;
};

int isochrones_verb(const Arguments& a, const Talk& talk) {
  const auto levels = decimals(a.levels);
  if (!levels) refuse("--levels takes numbers between commas (600,1200), not " + in_quotes(a.levels));
  const Surface surface(a.file, a.shared);
  const std::vector<double> values = values_on(surface, a.field, a.shared.array_name);
  const std::string text = isochrones_as_geojson(surface.domain(), values, *levels);
  if (a.output.empty() || a.output == "-") {
    write_stdout(text);
  } else {
    write_bytes(a.output, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
    talk.say(a.output + ": " + counted(levels->size(), "level", "levels"));
  }
  return kOk;
}

}  // namespace

void add_isochrones(CommandLine& command_line) {
  const auto arguments = std::make_shared<Arguments>();
  command_line.add("isochrones", "Regions within given distances or costs, as GeoJSON polygons", [&](Verb& verb) {
    verb.argument("FILE", arguments->file, "The mesh: a terrain");
    verb.argument("FIELD", arguments->field, "What it takes to get to every vertex: .npy .csv .txt ...");
    verb.option("--levels", arguments->levels, "L,L,...", "At these values");
    verb.option("-o,--output", arguments->output, "FILE", "Where to (standard output)");
    verb.talks();
    add_shared(verb, arguments->shared,
               {.without = {{kWeights, "costs are what the field holds: brushfire distance computes them"},
                            {kStarting, "nothing starts here: distances or costs are read"},
                            {kComputing, "nothing is computed here: distances or costs are read"},
                            {{Shared::Scalar}, "the values are those of FIELD"},
                            {{Shared::Unit}, "GeoJSON has the mesh's own coordinates"}}});
    verb.examples(kExamples);
    verb.run([arguments](Talk& talk) { return isochrones_verb(*arguments, talk); });
  });
}

}  // namespace brushfire::tool
