// brushfire pairs: distances of many pairs of vertices.
#include "computing.h"
#include "interrupt.h"
#include "surface.h"
#include "walls.h"
#include "weights.h"

#include <brushfire/io/npy.h>
#include <brushfire/io/write_bytes.h>
#include <brushfire/queries/pair_distances.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire pairs scan.ply pairs.txt -o apart.csv
  brushfire pairs pose.off matches.npy --method exact --normalise -o error.npy

PAIRS has two vertices to a line, or is a (k, 2) array in .npy. Of a correspondence, where each vertex was put and where it
belongs: its geodesic error, with --normalise as shape matching reports it, in units of the square root of the surface's
area. Pairs are grouped by where they start: one run for each such vertex. -o FILE.csv has both vertices and the
distance, .npy the distances, in the order of the pairs; what nothing leads to is inf. On the standard error: the mean,
the median and the greatest of the finite ones.)";

struct Arguments {
  std::string file, pairs, output;
  SharedArguments shared;
  bool normalise = false;
};

std::string csv(std::span<const std::array<Index, 2>> pairs, std::span<const double> distance) {
  std::string text = "from,to,distance\n";
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    text += std::to_string(pairs[i][0]) + "," + std::to_string(pairs[i][1]) + "," + exact(distance[i]) + "\n";
  }
  return text;
}

struct Summary {
  std::size_t finite = 0;
  double mean = 0, median = 0, greatest = 0;
};

Summary summary_of(std::vector<double> values) {
  values.erase(std::remove(values.begin(), values.end(), kInfinity), values.end());
  Summary s{.finite = values.size()};
  if (values.empty()) return s;
  std::sort(values.begin(), values.end());
  for (const double v : values) s.mean += v / static_cast<double>(values.size());
  s.median = values[values.size() / 2];
  s.greatest = values.back();
  return s;
}

void check(const Arguments& a, const Talk& talk) {
  const bool is_known = a.output.empty() || a.output == "-" || a.output.ends_with(".csv") || a.output.ends_with(".npy");
  if (!is_known) refuse("-o takes FILE.csv or FILE.npy");
  if (talk.json && a.output == "-") refuse("only one of -o - and --json can have the standard output");
}

void write(const Arguments& a, std::span<const std::array<Index, 2>> pairs, std::span<const double> distance,
           const Talk& talk) {
  if (a.output.ends_with(".npy")) return write_npy(a.output, distance);
  if (a.output.ends_with(".csv")) return write_text(a.output, csv(pairs, distance));
  if (!talk.json) write_stdout(csv(pairs, distance));
}

int pairs_verb(const Arguments& a, const Talk& talk) {
  check(a, talk);
  MatrixOptions options;
  options.distance = computation(a.shared);
  options.threads = std::exchange(options.distance.threads, 1);  // they share out the runs
  const Surface surface(a.file, a.shared);
  const std::vector<std::array<Index, 2>> pairs = vertex_pairs(a.pairs, surface.file().mesh.vertex_count());
  std::vector<std::array<Index, 2>> on_mesh = pairs;
  for (auto& [from, to] : on_mesh) {
    from = surface.vertex(from);
    to = surface.vertex(to);
  }
  stop_if_interrupted();
  weigh(options.distance, a.shared, surface);
  options.distance.progress = talk.progress("pairs");
  std::vector<double> distance = pair_distances(surface.domain(), on_mesh, options);
  talk.end_progress();
  const double unit = a.normalise ? root_of_area(surface.mesh()) : 1;
  for (double& d : distance) d /= unit;
  write(a, pairs, distance, talk);
  const Summary s = summary_of(distance);
  if (talk.json) {
    Record record;
    record.add("file", a.file)
        .add("pairs", static_cast<std::int64_t>(pairs.size()))
        .add("reached", static_cast<std::int64_t>(s.finite))
        .add("mean", s.mean)
        .add("median", s.median)
        .add("greatest", s.greatest)
        .add("normalised_by", unit)
        .add("unit", unit_of(a.shared));
    write_stdout(record.add("output", a.output).json());
  } else {
    talk.say(counted(pairs.size(), "pair", "pairs") + ", " + std::to_string(s.finite) + " reached: mean " +
             exact(s.mean) + ", median " + exact(s.median) + ", greatest " + exact(s.greatest));
  }
  return kOk;
}

}  // namespace

void add_pairs(CommandLine& command_line) {
  const auto a = std::make_shared<Arguments>();
  command_line.add("pairs", "Distances of many pairs of vertices", [&](Verb& verb) {
    add_surface(verb, a->file);
    verb.argument("PAIRS", a->pairs, "Two vertices to a line, or a (k, 2) array in .npy");
    verb.flag("--normalise", a->normalise, "In units of the square root of the area of the surface");
    verb.option("-o,--output", a->output, "FILE", "Write the distances: .csv .npy; - prints CSV, as without");
    verb.talks();
    add_shared(verb, a->shared,
               {.without = {{kStarting, "PAIRS says where distances start"},
                            {{Shared::Scalar, Shared::Name}, "distances are computed here, not read"}}});
    verb.examples(kExamples);
    verb.run([a](Talk& talk) { return pairs_verb(*a, talk); });
  });
}

}  // namespace brushfire::tool
