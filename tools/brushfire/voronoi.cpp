// brushfire voronoi: which source is nearest where.
#include "computing.h"
#include "fields.h"
#include "interrupt.h"
#include "output.h"
#include "sources.h"
#include "surface.h"
#include "weights.h"

#include <brushfire/io/write_lines.h>
#include <brushfire/queries/voronoi.h>

#include <memory>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire voronoi bunny.ply --source 0,500,12000
  brushfire voronoi cortex.gii --sources landmarks.txt --mask medial-wall.label.gii -o cells.label.gii
  brushfire voronoi bunny.ply --sources shops.txt --borders borders.obj --json
  brushfire sample bunny.ply --count 50 | brushfire voronoi bunny.ply --sources - -o cells.ply

One line per cell: the source, its area, how many vertices are nearest to it. Offsets (17@0.5) are additive weights: a
source that starts with a greater value has the smaller cell. -o writes distance and nearest source of every vertex, in
the formats of brushfire distance; --borders writes where two cells meet, as the formats of brushfire path; --json also
lists the borders' lengths and the dual, the triples of cells that meet. Exact unless --method says otherwise.)";

struct Arguments {
  std::string file, output, borders;
  SharedArguments shared;
  DrawingArguments drawing;
};

std::vector<std::int64_t> sizes_of(const VoronoiDiagram& cells) {
  std::vector<std::int64_t> sizes(cells.area.size(), 0);
  for (const Index s : cells.source) {
    if (s != kNoIndex) ++sizes[s];
  }
  return sizes;
}

std::string json(const Arguments& a, const VoronoiDiagram& cells, const std::vector<Where>& places,
                 const PlaceFinder& finder) {
  std::vector<Record> list, borders, dual;
  const std::vector<std::int64_t> sizes = sizes_of(cells);
  for (std::size_t s = 0; s < cells.area.size(); ++s) {
    list.emplace_back().add("where", places[s].text).add("area", cells.area[s]).add("vertices", sizes[s]);
  }
  for (const VoronoiBorder& b : cells.borders) {
    borders.emplace_back()
        .add("a", std::int64_t{b.sources[0]})
        .add("b", std::int64_t{b.sources[1]})
        .add("length", b.line.length)
        .add("closed", b.line.closed);
  }
  for (const Face& t : cells.dual) {
    dual.emplace_back().add("a", std::int64_t{t[0]}).add("b", std::int64_t{t[1]}).add("c", std::int64_t{t[2]});
  }
  Record record;
  record.add("file", a.file).add("unit", unit_of(a.shared)).add("cells", std::move(list));
  record.add("borders", std::move(borders)).add("dual", std::move(dual));
  finder.add_to(record);
  return record.add("output", a.output).json();
}

std::string in_words(const Arguments& a, const VoronoiDiagram& cells, const std::vector<Where>& places) {
  std::string text;
  const std::vector<std::int64_t> sizes = sizes_of(cells);
  const std::string unit = a.shared.unit.empty() ? "" : " " + a.shared.unit + "^2";
  for (std::size_t s = 0; s < cells.area.size(); ++s) {
    text += places[s].text + ": " + readable(cells.area[s]) + unit + ", " +
            counted(static_cast<std::uint64_t>(sizes[s]), "vertex", "vertices") + "\n";
  }
  return text;
}

int voronoi_verb(const Arguments& a, const Talk& talk) {
  check_output(a.output);
  if (a.output == "-" && talk.json) refuse("only one of -o - and --json can have the standard output");
  const LinesOptions drawing = a.borders.empty() ? LinesOptions{} : lines_options(a.borders, a.drawing, a.shared);
  DistanceOptions options = computation(a.shared, Method::Exact);
  const std::vector<Where> places = parse_sources(a.shared);
  const Surface surface(a.file, a.shared);
  stop_if_interrupted();
  PlaceFinder finder(surface.mesh(), a.shared.snap_within);
  const std::vector<Source> sources = sources_on(surface, finder, places);
  finder.tell(talk);
  weigh(options, a.shared, surface);
  options.progress = talk.progress("cells");
  const VoronoiDiagram cells = voronoi(surface.domain(), sources, options);
  talk.end_progress();

  if (!a.output.empty()) {
    write_values(surface, a.output,
                 {.values = surface.on_file<double>(cells.distance), .labels = surface.on_file<Index>(cells.source)});
  }
  if (!a.borders.empty()) {
    std::vector<SurfacePath> lines;
    for (const VoronoiBorder& b : cells.borders) lines.push_back(b.line);
    write_lines(a.borders, surface.mesh(), lines, "length", "", drawing);
  }
  if (talk.json) {
    write_stdout(json(a, cells, places, finder));
  } else if (a.output != "-") {
    write_stdout(in_words(a, cells, places));
  }
  return kOk;
}

}  // namespace

void add_voronoi(CommandLine& command_line) {
  const auto a = std::make_shared<Arguments>();
  command_line.add("voronoi", "Which source is nearest where: cells, their areas and borders", [&](Verb& verb) {
    add_surface(verb, a->file);
    verb.option("-o,--output", a->output, "FILE",
                ("Write distance and nearest source: " + extensions_of(fields_written()) + "; - prints CSV").c_str());
    verb.option("--borders", a->borders, "CURVES",
                ("Write where cells meet: " + extensions_of(lines_written())).c_str());
    add_drawing(verb, a->drawing);
    verb.talks();
    add_shared(
        verb, a->shared,
        {.without = {{{Shared::Scalar, Shared::Name}, "distances are computed here, not read"}}, .method = "exact"});
    verb.examples(kExamples);
    verb.run([a](Talk& talk) { return voronoi_verb(*a, talk); });
  });
}

}  // namespace brushfire::tool
