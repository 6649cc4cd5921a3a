// brushfire view: a page that shows the mesh and computes as one clicks.
#include "computing.h"
#include "page.h"
#include "sources.h"
#include "surface.h"

#include <brushfire/core/error.h>
#include <brushfire/io/write_bytes.h>
#include <brushfire/io/write_mesh.h>

#include <filesystem>
#include <memory>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire view bunny.ply
  brushfire view bunny.ply --source 0,500 -o page.html
  brushfire view cortex.gii --source 4711 --method exact -o cortex.html

The page is one file with the mesh and the library in it: it works from a disk or a mail, without a network. Click sets
the source, Shift-click adds one, dragging moves one. Without -o it is written into a folder for temporary files and
opened in the system's browser. Sources are those that the page starts with; the first corner of face 0 where none is
given. With walls the page holds what they leave open, cut apart along them.)";

struct Arguments {
  std::string file, output;
  SharedArguments shared;
};

std::string as_json(const SurfacePoint& p) {
  return "{\"face\": " + std::to_string(p.face) + ", \"weights\": [" + exact(p.weights[0]) + ", " +
         exact(p.weights[1]) + ", " + exact(p.weights[2]) + "]}";
}

// What the page starts with.
std::string state_of(const Arguments& a, const std::vector<SurfacePoint>& sources, const DistanceOptions& options) {
  std::string places;
  for (const SurfacePoint& p : sources) places += (places.empty() ? "" : ", ") + as_json(p);
  if (sources.empty()) places = as_json({0, {1, 0, 0}});
  Record names;
  names.add("name", std::filesystem::path(a.file).filename().string());
  names.add("method", std::string(brushfire::name_of(options.method)));
  if (options.method == Method::Windows) names.add("tolerance", exact(options.tolerance));
  const std::string record = names.json();
  return record.substr(0, record.rfind('}')) + ", \"sources\": [" + places + "]}";
}

// On the mesh that the page holds, which is what walls leave open; a place on a wall is one on each side of it.
std::vector<SurfacePoint> open_points(const Domain& domain, const std::vector<Source>& sources) {
  std::vector<SurfacePoint> points;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const std::vector<SurfacePoint> sides = domain.on_open(sources[i].point);
    if (sides.empty()) refuse("source " + std::to_string(i) + " lies behind a wall");
    points.insert(points.end(), sides.begin(), sides.end());
  }
  return points;
}

void check_sources(const std::vector<Where>& places) {
  for (const Where& p : places) {
    if (p.has_offset) refuse("'" + p.text + "': the page's sources start at 0");
  }
}

// A file of its own: names of before are pages that may still be open.
std::filesystem::path temporary_page(const std::string& mesh_file) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::string name = "brushfire-" + std::filesystem::path(mesh_file).stem().string();
  for (int k = 1;; ++k) {
    std::filesystem::path path = folder / (name + "-" + std::to_string(k) + ".html");
    if (!std::filesystem::exists(path)) return path;
  }
}

int view_verb(const Arguments& a, const Talk& talk) {
  const bool starts_somewhere = given(a.shared, {Shared::Source, Shared::Sources}) != nullptr;
  const std::vector<Where> places =
      starts_somewhere ? parse_point_sources(a.shared, "the page starts from places") : std::vector<Where>{};
  check_sources(places);
  const DistanceOptions options = computation(a.shared);
  std::string page = empty_page();
  const Surface surface(a.file, a.shared);
  if (surface.mesh().face_count() == 0) throw Error(ErrorCode::InvalidArgument, a.file + " has no faces to show");
  PlaceFinder finder(surface.mesh(), a.shared.snap_within);
  const std::vector<SurfacePoint> sources = open_points(surface.domain(), sources_on(surface, finder, places));
  finder.tell(talk);
  const Mesh& open = surface.open_for_file();
  if (open.face_count() == 0) refuse(a.file + ": walls leave no face to show");
  const std::vector<std::uint8_t> mesh = encode_mesh(open, "ply");
  const std::string_view bytes(reinterpret_cast<const char*>(mesh.data()), mesh.size());
  page = page_with(std::move(page), {bytes, state_of(a, sources, options)});

  const std::string path = a.output.empty() ? temporary_page(a.file).string() : a.output;
  write_text(path, page);
  const bool is_shown = a.output.empty() && open_in_browser(path);
  if (talk.json) {
    write_stdout(Record().add("file", a.file).add("output", path).add("shown", is_shown).json());
  } else if (a.output.empty() && !is_shown) {
    write_stdout("no browser could be started here; the page is " + path + "\n");
  } else if (path != "-") {
    talk.say("the page is " + path);
  }
  return kOk;
}

}  // namespace

void add_view(CommandLine& command_line) {
  const auto a = std::make_shared<Arguments>();
  command_line.add("view", "A page that shows the mesh and computes as you click", [&](Verb& verb) {
    add_surface(verb, a->file);
    verb.option("-o,--output", a->output, "FILE.html", "Write the page there and open no browser; - prints it");
    verb.talks();
    add_shared(verb, a->shared,
               {.without = {{kWeights, "the page computes distances, without costs"},
                            {{Shared::Scalar, Shared::Name}, "distances are computed in the page, not read"},
                            {{Shared::Bound, Shared::Precision, Shared::Radius, Shared::Threads},
                             "the page computes whole fields on one thread; it takes --method and --tolerance"},
                            {{Shared::Unit}, "the page shows lengths in the mesh's own unit"}}});
    verb.examples(kExamples);
    verb.run([a](Talk& talk) { return view_verb(*a, talk); });
  });
}

}  // namespace brushfire::tool
