// brushfire gradient: in which direction a field grows, and how fast.
#include "computing.h"
#include "fields.h"
#include "interrupt.h"
#include "output.h"
#include "sources.h"
#include "surface.h"
#include "weights.h"

#include <brushfire/io/write_columns.h>
#include <brushfire/queries/gradient.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire gradient bunny.ply --source 0 -o gradient.vtk
  brushfire gradient bunny.ply --source 0 --on vertices -o gradient.npy
  brushfire gradient cortex.gii --scalar thickness.func.gii -o steepest.csv
  brushfire gradient bunny.ply --sources seeds.txt --radius 0.05 -o - | head

A vector for every face, in its plane: the direction in which the value grows fastest, as long as the change of value per
unit of length. Of distances it is about 1 long and points away from the source. With --on vertices it is the mean of
the faces around, weighted by their area. Distances are exact if nothing else is said: what little a tolerance lets
neighbours differ by is much where it is divided by the length of an edge.

.npy has a row x, y, z for each face (or vertex), nan where there is no value; .csv and .json say the same in text; .vtk
(ParaView: Glyph) and .ply hold the mesh, too. Without -o the result is told in words.)";

struct Arguments {
  std::string file, output, on = "faces";
  SharedArguments shared;
};

void check(const Arguments& a, const Talk& talk) {
  check_scalar_or_source(a.shared);
  check_output(a.output, Columns::Kind::Vectors);
  if (a.output == "-" && talk.json) refuse("only one of -o - and --json can have the standard output");
}

// One value per vertex of surface.domain().open(): at walls, on every side of them.
std::vector<double> field_of(const Arguments& a, const Surface& surface, PlaceFinder& finder, const Talk& talk) {
  const Domain& domain = surface.domain();
  if (!a.shared.scalar_file.empty()) {
    return domain.spread(values_on(surface, a.shared.scalar_file, a.shared.array_name));
  }
  const std::vector<Source> sources = sources_on(surface, finder, parse_sources(a.shared));
  finder.tell(talk);
  DistanceOptions options = computation(a.shared, Method::Exact);
  weigh(options, a.shared, surface);
  options.progress = talk.progress("distance");
  DistanceField field = distance(domain, sources, options);
  talk.end_progress();
  return domain.has_walls() ? std::move(field.side_distance) : std::move(field.distance);
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::vector<Vec3> on_vertices(const Domain& domain, const std::vector<double>& field) {
  std::vector<Vec3> vectors = vertex_gradients(domain, field);
  std::vector<std::uint8_t> has_value(vectors.size(), 0);
  for (Index v = 0; v < field.size(); ++v) {
    if (std::isfinite(field[v])) has_value[domain.vertex(v)] = 1;
  }
  for (Index v = 0; v < vectors.size(); ++v) {
    if (!has_value[v] || (domain.has_walls() && !domain.is_open(v))) vectors[v] = {kNone, kNone, kNone};
  }
  return vectors;
}

std::vector<Vec3> on_faces(const Domain& domain, const std::vector<double>& field) {
  std::vector<Vec3> vectors = face_gradients(domain, field);
  std::vector<std::uint8_t> has_value(vectors.size(), 0);
  for (Index f = 0; f < domain.open().face_count(); ++f) {
    const Face& face = domain.open().faces()[f];
    has_value[domain.face(f)] = std::all_of(face.begin(), face.end(), [&](Index v) { return std::isfinite(field[v]); });
  }
  for (Index f = 0; f < vectors.size(); ++f) {
    if (!has_value[f]) vectors[f] = {kNone, kNone, kNone};
  }
  return vectors;
}

// Three numbers for each face of the file, or for each of its vertices; nan where the field has no value.
std::vector<double> rows_of(const Arguments& a, const Surface& surface, const std::vector<double>& field) {
  const Domain& domain = surface.domain();
  const std::vector<Vec3> vectors =
      a.on == "vertices" ? surface.on_file<Vec3>(on_vertices(domain, field)) : on_faces(domain, field);
  std::vector<double> rows;
  rows.reserve(3 * vectors.size());
  for (const Vec3& g : vectors) rows.insert(rows.end(), {g.x, g.y, g.z});
  return rows;
}

struct Lengths {
  std::size_t count = 0;
  double least = kInfinity, mean = 0, greatest = 0;
};

Lengths lengths_of(const std::vector<double>& rows) {
  Lengths l;
  for (std::size_t i = 0; i < rows.size(); i += 3) {
    const double length = norm(Vec3{rows[i], rows[i + 1], rows[i + 2]});
    if (!std::isfinite(length)) continue;
    ++l.count;
    l.least = std::min(l.least, length);
    l.greatest = std::max(l.greatest, length);
    l.mean += (length - l.mean) / static_cast<double>(l.count);
  }
  return l;
}

int gradient_verb(const Arguments& a, const Talk& talk) {
  check(a, talk);
  const Surface surface(a.file, a.shared);
  stop_if_interrupted();
  PlaceFinder finder(surface.mesh(), a.shared.snap_within);
  const std::vector<double> rows = rows_of(a, surface, field_of(a, surface, finder, talk));
  const Lengths lengths = lengths_of(rows);
  if (!a.output.empty()) {
    write_columns(a.output, surface.file().mesh,
                  {.names = {"x", "y", "z"},
                   .values = rows,
                   .on = a.on == "faces" ? Columns::On::Faces : Columns::On::Vertices,
                   .kind = Columns::Kind::Vectors,
                   .name = "gradient"},
                  a.output == "-" ? "csv" : "");
  }
  if (talk.json) {
    Record record;
    record.add("file", a.file)
        .add("on", a.on)
        .add("unit", unit_of(a.shared))
        .add("vectors", static_cast<std::int64_t>(rows.size() / 3))
        .add("without_value", static_cast<std::int64_t>(rows.size() / 3 - lengths.count))
        .add("min_length", lengths.least)
        .add("mean_length", lengths.mean)
        .add("max_length", lengths.greatest);
    finder.add_to(record);
    write_stdout(record.add("output", a.output).json());
    return kOk;
  }
  const std::string words = "gradients on " + std::to_string(lengths.count) + " of " + std::to_string(rows.size() / 3) +
                            " " + a.on +
                            (lengths.count == 0 ? ""
                                                : ", " + readable(lengths.least) + " to " + readable(lengths.greatest) +
                                                      " long, mean " + readable(lengths.mean));
  a.output.empty() ? write_stdout(words + "\n") : talk.say(words);
  return kOk;
}

}  // namespace

void add_gradient(CommandLine& command_line) {
  const auto a = std::make_shared<Arguments>();
  command_line.add("gradient", "In which direction a field grows, and how fast", [&](Verb& verb) {
    add_surface(verb, a->file);
    verb.choice("--on", a->on, {"faces", "vertices"}, "Where the vectors are");
    verb.option("-o,--output", a->output, "FILE",
                ("Write them: " + extensions_of(columns_written(Columns::Kind::Vectors)) + "; - prints CSV").c_str());
    verb.talks();
    add_shared(verb, a->shared, {.method = "exact"});
    verb.examples(kExamples);
    verb.run([a](Talk& talk) { return gradient_verb(*a, talk); });
  });
}

}  // namespace brushfire::tool
