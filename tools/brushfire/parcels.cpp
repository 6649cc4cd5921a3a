// brushfire parcels: distances between the regions of a labelled surface.
#include "computing.h"
#include "fields.h"
#include "interrupt.h"
#include "output.h"
#include "surface.h"
#include "weights.h"

#include <brushfire/io/npy.h>
#include <brushfire/io/write_bytes.h>
#include <brushfire/queries/parcels.h>

#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire parcels lh.white.gii lh.aparc.annot -o min.csv
  brushfire parcels lh.white.gii lh.aparc.annot --distance mean --method exact -o mean.npy
  brushfire parcels lh.midthickness.surf.gii schaefer.label.gii --distance centroid --ignore 0 -o d.csv

LABELS is any file with one label per vertex. --distance: min, of the nearest two vertices (the default); hausdorff, of
the vertex of either that is farthest from the other parcel; centroid, of the vertices in their middles; mean and max,
over all pairs of vertices. min and hausdorff take one run per parcel, mean and max one per vertex, and none of them
keeps a matrix of all vertices.

Vertices with a label below 0, with a label of --ignore, or that a mask closes are in no parcel. -o FILE.csv has names
and numbers, .npy the numbers, in the order of the labels.)";

struct Arguments {
  std::string file, labels, output, kind = "min";
  SharedArguments shared;
  std::vector<std::string> ignored;
};

std::vector<std::int64_t> labels_of(const Arguments& a, const Surface& surface, const LoadedField& field) {
  const Index count = surface.file().mesh.vertex_count();
  std::vector<std::int64_t> labels;
  for (const double value : surface.on_mesh(values_of(field, a.labels, count, "the mesh"), a.labels)) {
    labels.push_back(std::isfinite(value) ? std::llround(value) : -1);
    if (std::isfinite(value) && value != std::floor(value)) {
      refuse(a.labels + ": labels are whole numbers, not " + exact(value));
    }
  }
  for (const std::string& text : a.ignored) {
    std::optional<double> key = decimal(text);
    for (const LoadedField::Label& l : field.label_names) {
      if (l.name == text) key = static_cast<double>(l.key);
    }
    if (!key) refuse("--ignore: " + in_quotes(text) + " is no label of " + a.labels);
    for (std::int64_t& label : labels) {
      if (static_cast<double>(label) == *key) label = -1;
    }
  }
  return labels;
}

std::string name_of_label(std::int64_t key, const std::map<std::int64_t, std::string>& names) {
  const auto named = names.find(key);
  return named == names.end() ? std::to_string(key) : named->second;
}

// In quotes where it would fall apart.
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string csv(const ParcelMatrix& m, const std::map<std::int64_t, std::string>& names) {
  std::string text = "parcel";
  for (const std::int64_t key : m.label) text += "," + csv_cell(name_of_label(key, names));
  text += "\n";
  for (std::size_t i = 0; i < m.label.size(); ++i) {
    text += csv_cell(name_of_label(m.label[i], names));
    for (std::size_t j = 0; j < m.label.size(); ++j) text += "," + exact(m.distance[i * m.label.size() + j]);
    text += "\n";
  }
  return text;
}

int parcels_verb(const Arguments& a, const Talk& talk) {
  const bool is_npy = a.output.ends_with(".npy");
  if (!a.output.empty() && a.output != "-" && !is_npy && !a.output.ends_with(".csv"))
    refuse("-o takes FILE.csv or FILE.npy");
  if (talk.json && a.output == "-") refuse("only one of -o - and --json can have the standard output");
  MatrixOptions options;
  options.distance = computation(a.shared);
  options.threads = std::exchange(options.distance.threads, 1);
  const Surface surface(a.file, a.shared);
  stop_if_interrupted();
  const LoadedField field = read_field(a.labels, a.shared.array_name);
  std::map<std::int64_t, std::string> names;
  for (const LoadedField::Label& l : field.label_names) names[l.key] = l.name;
  weigh(options.distance, a.shared, surface);
  options.distance.progress = talk.progress("parcels");
  const ParcelMatrix m =
      parcel_distances(surface.domain(), labels_of(a, surface, field), parcel_distance_named(a.kind), 0, options);
  talk.end_progress();
  if (m.label.empty()) refuse(a.labels + ": there is no parcel: no vertex has a label of 0 or more");
  if (is_npy) {
    write_npy(a.output, m.distance, std::vector<std::size_t>{m.label.size(), m.label.size()});
  } else if (!a.output.empty() && a.output != "-") {
    const std::string text = csv(m, names);
    write_bytes(a.output, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }
  if (talk.json) {
    std::vector<Record> list;
    for (std::size_t i = 0; i < m.label.size(); ++i) {
      list.emplace_back()
          .add("label", m.label[i])
          .add("name", name_of_label(m.label[i], names))
          .add("vertices", std::int64_t{m.vertices[i]})
          .add("centroid",
               m.centroid.empty() ? Record::Value(nullptr) : std::int64_t{surface.file_vertex(m.centroid[i])});
    }
    Record record;
    record.add("file", a.file).add("distance", a.kind).add("unit", unit_of(a.shared)).add("parcels", std::move(list));
    write_stdout(record.add("output", a.output).json());
  } else if (a.output.empty() || a.output == "-") {
    write_stdout(csv(m, names));
  } else {
    talk.say(a.output + ": " + counted(m.label.size(), "parcel", "parcels"));
  }
  return kOk;
}

}  // namespace

void add_parcels(CommandLine& command_line) {
  const auto a = std::make_shared<Arguments>();
  command_line.add("parcels", "Distances between labelled regions", [&](Verb& verb) {
    add_surface(verb, a->file);
    verb.argument("LABELS", a->labels, "One label per vertex: .annot, .label.gii, .npy, .txt, ...");
    verb.choice("--distance", a->kind, {"min", "hausdorff", "centroid", "mean", "max"}, "Which one (min)");
    verb.option("--ignore", a->ignored, "LABEL", "No parcel: a number or a name; may be repeated");
    verb.option("-o,--output", a->output, "FILE", "Write the matrix: .csv .npy; - prints CSV, as without");
    verb.talks();
    add_shared(verb, a->shared,
               {.without = {{kSlopes, "distances between parcels are the same both ways, and slopes are not"},
                            {kStarting, "distances run from every parcel"},
                            {{Shared::Scalar}, "the labels that part it are LABELS"}}});
    verb.examples(kExamples);
    verb.run([a](Talk& talk) { return parcels_verb(*a, talk); });
  });
}

}  // namespace brushfire::tool
