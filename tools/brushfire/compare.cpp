// brushfire compare: how far one field is from another.
#include "fields.h"
#include "surface.h"

#include <brushfire/core/error.h>
#include <brushfire/io/read_field.h>
#include <brushfire/queries/compare.h>
#include <brushfire/queries/vertex_measures.h>

#include <cstdio>
#include <memory>
#include <optional>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire distance bunny.ply --source 0 --method novotni-klein -o fast.npy
  brushfire distance bunny.ply --source 0 --method dijkstra -o edges.npy
  brushfire compare edges.npy fast.npy
  brushfire compare edges.npy fast.npy --mesh bunny.ply --json
  brushfire compare edges.npy fast.npy --fail-above 0.1 || echo too far apart

A field is any file with one number per vertex: .npy .csv .json .txt, or a .ply or .vtk that brushfire wrote. Relative
errors are |A - B| / |B|; vertices where B is 0 (the sources) are left out. With --mesh the means are also weighted by
area, so that a dense corner of the mesh counts by its size and not by its vertices. With --fail-above E the exit code
is 5 where a relative error is greater than E, or a vertex is reached by one of the two only. With walls in the --mesh,
what lies behind them is not compared.
)";

struct Arguments {
  std::string field, reference, mesh;
  SharedArguments shared;
  std::optional<double> fail_above;
};

// Vertices that only one of the two reaches are infinitely far apart.
bool is_above(const FieldComparison& c, double limit) {
  return c.relative.max > limit || c.missing > 0 || c.surplus > 0;
}

void add_measure(Record& record, const std::string& name, const ErrorMeasure& error) {
  record.add("mean_" + name, error.mean)
      .add("rms_" + name, error.root_mean_square)
      .add("max_" + name, error.max)
      .add("max_" + name + "_vertex", error.max_vertex == kNoIndex ? std::int64_t{-1} : std::int64_t{error.max_vertex});
}

std::string json(const Arguments& arguments, const FieldComparison& c) {
  Record record;
  const auto add = [&](const char* key, Index value) { record.add(key, std::int64_t{value}); };
  record.add("field", arguments.field).add("reference", arguments.reference).add("mesh", arguments.mesh);
  record.add("unit", unit_of(arguments.shared));
  add("compared", c.compared);
  add("zero_reference", c.zero_reference);
  add("missing", c.missing);
  add("surplus", c.surplus);
  add("unreached_in_both", c.unreached_in_both);
  add_measure(record, "relative", c.relative);
  record.add("mean_signed_relative", c.mean_signed_relative);
  add_measure(record, "absolute", c.absolute);
  record.add("max_at_zero_reference", c.max_at_zero_reference);
  if (c.has_weights) {
    record.add("area_weighted_mean_relative", c.weighted_relative.mean)
        .add("area_weighted_rms_relative", c.weighted_relative.root_mean_square)
        .add("area_weighted_mean_absolute", c.weighted_absolute.mean)
        .add("area_weighted_rms_absolute", c.weighted_absolute.root_mean_square);
  }
  if (arguments.fail_above) {
    record.add("fail_above", *arguments.fail_above).add("failed", is_above(c, *arguments.fail_above));
  }
  return record.json();
}

// One line of the table: mean, root mean square, maximum.
std::string row(const char* name, const ErrorMeasure& error) {
  char text[160];
  std::snprintf(text, sizeof text, "  %-26s %12s %12s %12s\n", name, readable(error.mean).c_str(),
                readable(error.root_mean_square).c_str(), readable(error.max).c_str());
  std::string line = text;
  if (error.max_vertex != kNoIndex) {
    line.insert(line.size() - 1, " at vertex " + std::to_string(error.max_vertex));
  }
  return line;
}

std::string in_words(const Arguments& arguments, const FieldComparison& c) {
  std::string text = arguments.field + " against " + arguments.reference + ": " +
                     counted(c.compared, "vertex", "vertices") + " compared\n";
  const std::string unit = arguments.shared.unit.empty() ? "" : ", " + arguments.shared.unit;
  char head[160];
  std::snprintf(head, sizeof head, "  %-26s %12s %12s %12s\n", "", "mean", "rms", "max");
  text += head + row("relative error", c.relative) + row(("absolute error" + unit).c_str(), c.absolute);
  if (c.has_weights) {
    text +=
        row("relative, by area", c.weighted_relative) + row(("absolute, by area" + unit).c_str(), c.weighted_absolute);
  }
  text += "  mean signed relative error " + readable(c.mean_signed_relative) + "\n";
  const auto note = [&](Index n, const char* what) {
    if (n > 0) text += "  " + counted(n, "vertex", "vertices") + " " + what + "\n";
  };
  note(c.zero_reference, "left out: the reference is 0 there");
  note(c.missing, "reached by the reference only");
  note(c.surplus, "not reached by the reference");
  note(c.unreached_in_both, "reached by neither");
  if (arguments.fail_above && is_above(c, *arguments.fail_above)) {
    text += "  farther apart than " + readable(*arguments.fail_above) + "\n";
  }
  return text;
}

int compare(const Arguments& arguments, const Talk& talk) {
  const LoadedField reference = read_field(arguments.reference, arguments.shared.array_name);
  std::size_t count = reference.values.size();
  std::string counting = arguments.reference;
  std::vector<double> areas;
  std::vector<std::uint8_t> open;
  if (!arguments.mesh.empty()) {
    const Surface surface(arguments.mesh, arguments.shared);
    areas = vertex_areas(surface.domain());
    open = surface.open_vertices();
    count = areas.size();
    counting = arguments.mesh;
  } else if (const char* walls = given(arguments.shared, kWalls)) {
    refuse(std::string(walls) + " is on a mesh: give --mesh, too");
  }
  std::vector<double> b = values_of(reference, arguments.reference, count, counting);
  std::vector<double> a =
      values_of(read_field(arguments.field, arguments.shared.array_name), arguments.field, count, counting);
  for (std::size_t v = 0; v < open.size(); ++v) {
    if (!open[v]) a[v] = b[v] = kInfinity;  // reached by neither, whatever they say
  }
  const FieldComparison result = compare_fields(a, b, areas);
  write_stdout(talk.json ? json(arguments, result) : in_words(arguments, result));
  return arguments.fail_above && is_above(result, *arguments.fail_above) ? kProvenWrong : kOk;
}

}  // namespace

void add_compare(CommandLine& command_line) {
  const auto arguments = std::make_shared<Arguments>();
  command_line.add("compare", "How far one field is from another", [&](Verb& verb) {
    verb.argument("A", arguments->field, "The field to judge");
    verb.argument("B", arguments->reference, "The reference");
    verb.option("--mesh", arguments->mesh, "FILE", "The mesh of both: adds means weighted by area");
    verb.option("--fail-above", arguments->fail_above, "E", kLimit,
                "Exit code 5 where a relative error is greater than this");
    verb.talks();
    add_shared(verb, arguments->shared,
               {.without = {{kWeights, "two fields are read, and none is computed"},
                            {kStarting, "two fields are read, and nothing starts anywhere"},
                            {kComputing, "two fields are read, and none is computed"},
                            {{Shared::Scalar}, "the values are A and B"},
                            {{Shared::Weld}, "fields are compared vertex by vertex, as they stand in their files"}}});
    verb.examples(kExamples);
    verb.run([arguments](Talk& talk) { return compare(*arguments, talk); });
  });
}

}  // namespace brushfire::tool
