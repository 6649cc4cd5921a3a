// brushfire measure: how large a surface is by its own distances.
#include "computing.h"
#include "fields.h"
#include "interrupt.h"
#include "output.h"
#include "surface.h"

#include <brushfire/queries/extent.h>
#include <brushfire/queries/vertex_measures.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire measure part.stl                                   # diameter, radius and centre, with proof
  brushfire measure scan.ply --within 0.001                    # to 0.1 %
  brushfire measure scan.ply --of eccentricity -o farthest.ply
  brushfire measure cortex.gii --of average --mask cortex.label -o mean.func.gii
  brushfire measure cortex.gii --of disc-radius --share 0.05 -o radius.npy

Without --of: the two vertices that are farthest apart (the diameter) and the one from which no vertex is far (the
centre), each with a lower and an upper bound; exact fields are computed until the bounds are within --within of each
other (1e-6), or --most-runs of them were.

--of computes a number for every vertex, from a field of its own each: how far the farthest vertex is (eccentricity),
the mean distance of the surface (average), or of the disc around it that holds --share of the surface the radius, the
perimeter or the area.)";

struct Arguments {
  std::string file, output, of;
  SharedArguments shared;
  std::optional<double> within, share;
  std::optional<int> most_runs;
};

void check(const Arguments& a, const Talk& talk) {
  check_output(a.output);
  if (a.of.empty()) {
    if (!a.output.empty()) refuse("-o writes a number for every vertex: which? give --of");
    if (given(a.shared, {Shared::Method, Shared::Tolerance, Shared::Bound, Shared::Precision, Shared::Radius})) {
      refuse("diameter and centre are proven by exact fields; --method and the like are for --of");
    }
  } else {
    if (a.within || a.most_runs) refuse("--within and --most-runs are for the diameter: no --of");
    if (a.output.empty()) refuse("where to? give -o FILE for the number of every vertex");
    if (a.output == "-" && talk.json) refuse("only one of -o - and --json can have the standard output");
  }
  const bool is_disc = a.of.starts_with("disc-");
  if (is_disc && !a.share) refuse("--of " + a.of + ": of which --share of the surface?");
  if (!is_disc && a.share) refuse("--share is for --of disc-radius, disc-perimeter and disc-area");
}

std::vector<double> values_of(const Arguments& a, const Domain& domain, const MatrixOptions& options) {
  if (a.of == "eccentricity") return eccentricities(domain, std::nullopt, options);
  if (a.of == "average") return average_distances(domain, std::nullopt, options);
  Discs discs = discs_of_share(domain, *a.share, std::nullopt, options);
  if (a.of == "disc-perimeter") return std::move(discs.perimeter);
  return a.of == "disc-area" ? std::move(discs.area) : std::move(discs.radius);
}

int of_every_vertex(const Arguments& a, const Surface& surface, const Talk& talk) {
  MatrixOptions options;
  options.distance = computation(a.shared);
  options.threads = std::exchange(options.distance.threads, 1);
  options.distance.progress = talk.progress(a.of.c_str());
  const std::vector<double> values = values_of(a, surface.domain(), options);
  talk.end_progress();
  write_values(surface, a.output, {.values = surface.on_file<double>(values), .name = a.of});
  const std::vector<double> area = vertex_areas(surface.domain());
  double least = kInfinity, greatest = 0, sum = 0, weight = 0;
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (!(values[v] < kInfinity)) continue;
    least = std::min(least, values[v]);
    greatest = std::max(greatest, values[v]);
    sum += area[v] * values[v];
    weight += area[v];
  }
  const double mean = weight > 0 ? sum / weight : kInfinity;
  if (talk.json) {
    Record record;
    record.add("file", a.file).add("of", a.of).add("unit", unit_of(a.shared)).add("least", least);
    record.add("mean", mean).add("greatest", greatest).add("output", a.output);
    write_stdout(record.json());
  } else {
    talk.say(a.of + ": " + readable(least) + " to " + readable(greatest) + ", mean " + readable(mean));
  }
  return kOk;
}

int of_all(const Arguments& a, const Surface& surface, const Talk& talk) {
  ExtentOptions options;
  options.tolerance = a.within.value_or(1e-6);
  options.max_runs = static_cast<Index>(a.most_runs.value_or(0));
  options.threads = static_cast<unsigned>(a.shared.threads.value_or(0));
  options.cancel = &cancel_token();
  options.progress = talk.progress("extent");
  const Extent e = extent(surface.domain(), options);
  talk.end_progress();
  const auto vertex = [&](Index v) { return v == kNoIndex ? -1 : std::int64_t{surface.file_vertex(v)}; };
  const double area = std::accumulate(surface.mesh().double_areas().begin(), surface.mesh().double_areas().end(), 0.0);
  if (talk.json) {
    Record record;
    record.add("file", a.file)
        .add("unit", unit_of(a.shared))
        .add("diameter_lower", e.diameter_lower)
        .add("diameter_upper", e.diameter_upper)
        .add("from", vertex(e.pair[0]))
        .add("to", vertex(e.pair[1]))
        .add("radius_lower", e.radius_lower)
        .add("radius_upper", e.radius_upper)
        .add("centre", vertex(e.centre))
        .add("fields", std::int64_t{e.runs});
    write_stdout(record.json());
    return kOk;
  }
  if (e.centre == kNoIndex || !(area > 0)) {
    write_stdout("no face: there is nothing to measure\n");
    return kOk;
  }
  write_stdout("diameter: " + readable(e.diameter_lower) + " .. " + with_unit(e.diameter_upper, a.shared) +
               ", from vertex " + std::to_string(vertex(e.pair[0])) + " to " + std::to_string(vertex(e.pair[1])) +
               "\nradius: " + readable(e.radius_lower) + " .. " + with_unit(e.radius_upper, a.shared) +
               ", from vertex " + std::to_string(vertex(e.centre)) + "\nproven by " +
               counted(e.runs, "exact field", "exact fields") + "\n");
  return kOk;
}

int measure_verb(const Arguments& a, const Talk& talk) {
  check(a, talk);
  const Surface surface(a.file, a.shared);
  stop_if_interrupted();
  return a.of.empty() ? of_all(a, surface, talk) : of_every_vertex(a, surface, talk);
}

}  // namespace

void add_measure(CommandLine& command_line) {
  const auto a = std::make_shared<Arguments>();
  command_line.add("measure", "Diameter, centre, and how far every vertex is from the rest", [&](Verb& verb) {
    add_surface(verb, a->file);
    verb.choice("--of", a->of, {"eccentricity", "average", "disc-radius", "disc-perimeter", "disc-area"},
                "A number for every vertex");
    verb.option("--share", a->share, "P", {.low = 0, .high = 1, .above_low = true},
                "Of the surface, that the disc holds: 0.05 is 5 %");
    verb.option("--within", a->within, "E", kLength, "How near the bounds come to each other, as a share (1e-6)");
    verb.option("--most-runs", a->most_runs, "N", whole_from(1, 1000000000), "At most so many fields for the bounds");
    verb.option("-o,--output", a->output, "FILE",
                ("Write the numbers: " + extensions_of(fields_written()) + "; - prints CSV").c_str());
    verb.talks();
    add_shared(verb, a->shared,
               {.without = {{kWeights, "discs and extents are measured in lengths"},
                            {kStarting, "every vertex is measured from"},
                            {{Shared::Scalar, Shared::Name}, "distances are computed here, not read"}}});
    verb.examples(kExamples);
    verb.run([a](Talk& talk) { return measure_verb(*a, talk); });
  });
}

}  // namespace brushfire::tool
