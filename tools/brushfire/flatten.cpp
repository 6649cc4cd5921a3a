// brushfire flatten: the surface laid flat, as texture coordinates.
#include "computing.h"
#include "interrupt.h"
#include "numbers.h"
#include "output.h"
#include "surface.h"

#include <brushfire/io/write_columns.h>
#include <brushfire/queries/flatten.h>

#include <memory>
#include <string>
#include <vector>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Straight distances in the plane come as near to the geodesic ones as they can: by
multidimensional scaling of the distances from landmarks. What is no disc is cut to one along shortest ways; with walls
(--block-edges SEAM) these are the seams. What is written is the mesh, cut open, with its coordinates in the unit square;
.csv, .json and .npy list u and v in the mesh's units, and the number of the vertex in the file.

Examples:
  brushfire flatten scan.ply -o uv.obj
  brushfire flatten scan.ply --landmarks 300 --method exact -o uv.obj
  brushfire flatten cone.ply --block-edges seam.txt -o uv.ply
  brushfire flatten scan.ply --json                              # how far it is from the surface)";

struct Arguments {
  std::string file, output;
  std::optional<int> landmarks;
  SharedArguments shared;
};

void write(const Arguments& a, const Flattening& flat) {
  const bool is_list =
      a.output == "-" || a.output.ends_with(".csv") || a.output.ends_with(".json") || a.output.ends_with(".npy");
  const std::vector<std::array<double, 2>> uv = is_list ? flat.uv : in_unit_square(flat.uv);
  std::vector<double> rows;
  for (std::size_t v = 0; v < uv.size(); ++v) {
    rows.insert(rows.end(), {uv[v][0], uv[v][1], static_cast<double>(flat.original_vertex[v])});
  }
  write_columns(a.output, flat.mesh,
                {.names = {"u", "v", "original"}, .values = rows, .kind = Columns::Kind::Texture, .name = "flattening"},
                a.output == "-" ? "csv" : "");
}

int flatten_verb(const Arguments& a, const Talk& talk) {
  check_output(a.output, Columns::Kind::Texture);
  if (a.output == "-" && talk.json) refuse("only one of -o - and --json can have the standard output");
  FlattenOptions options;
  options.distance = computation(a.shared);
  options.landmarks = static_cast<Index>(a.landmarks.value_or(static_cast<int>(options.landmarks)));
  const Surface surface(a.file, a.shared);
  stop_if_interrupted();
  const Flattening flat =
      surface.domain().has_walls() ? flatten(surface.domain(), options) : flatten(surface.mesh(), options);
  if (!a.output.empty()) write(a, flat);
  const Distortion& d = flat.distortion;
  if (talk.json) {
    Record record;
    record.add("file", a.file)
        .add("method", std::string(name_of(options.distance.method)))
        .add("vertices", std::int64_t{surface.mesh().vertex_count()})
        .add("cut_vertices", std::int64_t{flat.mesh.vertex_count()})
        .add("landmarks", static_cast<std::int64_t>(flat.landmarks.size()))
        .add("stress", d.stress)
        .add("stretch", d.stretch)
        .add("max_stretch", d.max_stretch)
        .add("min_stretch", d.min_stretch)
        .add("angle", d.angle)
        .add("flipped_faces", std::int64_t{d.flipped})
        .add("unit", unit_of(a.shared));
    write_stdout(record.add("output", a.output).json());
    return kOk;
  }
  const std::string words = "stress " + readable(d.stress) + " by " +
                            counted(flat.landmarks.size(), "landmark", "landmarks") + "; lengths times " +
                            readable(d.min_stretch) + " to " + readable(d.max_stretch) + ", " + readable(d.stretch) +
                            " in the mean; " + counted(d.flipped, "face", "faces") + " turned over";
  if (!a.output.empty()) talk.say(a.output + ": " + words);
  if (a.output.empty()) write_stdout(words + "\n");
  return kOk;
}

}  // namespace

void add_flatten(CommandLine& command_line) {
  const auto a = std::make_shared<Arguments>();
  command_line.add("flatten", "The surface laid flat: texture coordinates", [&](Verb& verb) {
    add_surface(verb, a->file);
    verb.option("--landmarks", a->landmarks, "N", whole_from(3, 10000), "Vertices whose distances are used (100)");
    verb.option("-o,--output", a->output, "FILE",
                ("Write the coordinates: " + extensions_of(columns_written(Columns::Kind::Texture)) + "; - prints CSV")
                    .c_str());
    verb.talks();
    add_shared(verb, a->shared,
               {.without = {{kWeights, "what is laid flat is the surface, whose distances count"},
                            {kStarting, "landmarks are chosen, each the farthest from those before"},
                            {{Shared::Radius}, "every vertex needs its distance from every landmark"},
                            {{Shared::Scalar, Shared::Name}, "distances are computed here, not read"}}});
    verb.examples(kExamples);
    verb.run([a](Talk& talk) { return flatten_verb(*a, talk); });
  });
}

}  // namespace brushfire::tool
