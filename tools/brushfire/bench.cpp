// brushfire bench: what the methods cost on a mesh, and how far off they are.
#include "computing.h"
#include "interrupt.h"
#include "process.h"
#include "sources.h"
#include "surface.h"

#include <brushfire/core/parallel.h>
#include <brushfire/queries/compare.h>
#include <brushfire/solvers/distance.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire bench bunny.ply
  brushfire bench bunny.ply --method windows:1e-4 --method novotni-klein:float64
  brushfire bench bunny.ply --spread 8 --threads 2 --json
  brushfire bench large.ply --method novotni-klein --repeat 9 --no-error

A method may be followed by :float64 (its arithmetic) or by a tolerance (windows:1e-4) of its own, as in other verbs.
Without --source and --spread the first vertex is solved from. Every repetition builds the mesh
from its arrays, with its walls and all that the method needs (set-up), and then solves for each source (solve, per source); what is
printed is the median. Times are processor time; with --threads above 1 they are by the clock on the wall: threads share
out the sources, and where there are more of them than sources, they work on one field together. Memory is the most that
the first repetition took beyond the arrays that it started from. Errors are relative, over all vertices and sources,
against the exact distances.)";

struct Arguments {
  std::string file;
  SharedArguments shared;
  std::optional<int> spread, repeat;
  bool no_error = false;
};

struct Plan {
  std::vector<DistanceOptions> methods;
  std::vector<Where> places;  // none: vertices spread over the mesh
  std::size_t source_count = 1, repetitions = 5;
  unsigned threads = 1;
};

struct Result {
  double set_up_s = 0, solve_s = 0;
  double reached = 0, updates = 0;  // per source
  std::optional<std::uint64_t> memory;
  double mean_error = 0, max_error = 0;
  double proven = kInfinity;  // the largest of the fields' own bounds
};

std::string name_of(const DistanceOptions& options) {
  std::string name(brushfire::name_of(options.method));
  if (options.method == Method::Windows) name += ":" + readable(options.tolerance);
  if (options.precision == Precision::Double) name += ":float64";
  return name;
}

Plan plan_of(const Arguments& a) {
  Plan plan;
  plan.source_count = static_cast<std::size_t>(a.spread.value_or(1));
  plan.repetitions = static_cast<std::size_t>(a.repeat.value_or(5));
  plan.threads = thread_count(static_cast<unsigned>(a.shared.threads.value_or(1)));
  const char* const source = given(a.shared, {Shared::Source, Shared::Sources});
  if (a.spread && source) refuse("--spread chooses vertices, " + std::string(source) + " names places: give one");
  if (source) plan.places = parse_sources(a.shared);
  const std::span<const Method> all = all_methods();
  plan.methods = computations(a.shared, {all.begin(), all.end()});
  for (DistanceOptions& options : plan.methods) options.threads = 1;
  return plan;
}

// The places named, or vertices that have faces, evenly spread over their numbers, from the first one on.
std::vector<Source> sources_of(const Arguments& a, const Plan& plan, const Surface& surface, PlaceFinder& places) {
  if (!plan.places.empty()) return sources_on(surface, places, plan.places);
  const Mesh& mesh = surface.mesh();
  std::vector<Source> sources;
  std::vector<Index> candidates;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (surface.domain().is_open(v)) candidates.push_back(v);
  }
  if (candidates.empty()) refuse(a.file + ": no vertex has a face to start from");
  const std::size_t count = std::min(plan.source_count, candidates.size());
  for (std::size_t i = 0; i < count; ++i) {
    sources.push_back({vertex_point(mesh, candidates[i * candidates.size() / count])});
  }
  return sources;
}

class Bench {
 public:
  Bench(const Surface& surface, std::vector<Source> sources, const Plan& plan, bool with_error)
      : mesh_(surface.mesh()), barriers_(surface.barriers()), sources_(std::move(sources)), plan_(plan) {
    if (!with_error) return;
    DistanceOptions exact = plan.methods.front();
    exact.method = Method::Exact;
    truth_.resize(sources_.size());
    DistanceSolver solver(surface.domain());
    for (std::size_t i = 0; i < sources_.size(); ++i) truth_[i] = field(solver, i, exact).distance;
  }

  Result run(const DistanceOptions& options) const {
    Result result;
    std::vector<double> set_ups, solves;
    for (std::size_t i = 0; i < plan_.repetitions; ++i) {
      const bool first = i == 0;
      const bool counts_memory = first && reset_peak_memory();
      const std::uint64_t before = resident_memory();
      const auto [set_up_s, solve_s] = repeat(options, first, result);
      set_ups.push_back(set_up_s);
      solves.push_back(solve_s);
      if (counts_memory) result.memory = std::max(peak_memory(), before) - before;
    }
    result.set_up_s = median(set_ups);
    result.solve_s = median(solves);
    return result;
  }

 private:
  DistanceField field(DistanceSolver& solver, std::size_t source, const DistanceOptions& options) const {
    return solver.distance({&sources_[source], 1}, options);
  }

  Domain walled(Mesh mesh) const {
    const bool has_walls = !barriers_.vertices.empty() || !barriers_.faces.empty() || !barriers_.edges.empty();
    return has_walls ? Domain(std::move(mesh), barriers_) : Domain(std::move(mesh));
  }

  double now() const {
    if (plan_.threads == 1) return cpu_seconds();
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  // One repetition: seconds of set-up, seconds per source.
  std::pair<double, double> repeat(const DistanceOptions& options, bool first, Result& result) const {
    const double begin = now();
    const Domain domain = walled(Mesh(mesh_.positions(), mesh_.faces()));
    const unsigned threads = std::min(plan_.threads, static_cast<unsigned>(sources_.size()));
    DistanceOptions each = options;
    each.threads = plan_.threads / threads;
    std::vector<DistanceSolver> solvers;
    for (unsigned t = 0; t < threads; ++t) solvers.emplace_back(domain).set_up(options);
    const double built = now();
    // What is kept of a field for the report is little, and taken after the clock has stopped where it costs time.
    std::vector<DistanceField> fields(first ? sources_.size() : 0);
    parallel_for(
        sources_.size(), threads,
        [&](unsigned worker, std::size_t i) {
          DistanceField solved = field(solvers[worker], i, each);
          if (first) fields[i] = std::move(solved);
        },
        options.cancel);
    const double end = now();
    if (first) report(fields, result);
    return {built - begin, (end - built) / static_cast<double>(sources_.size())};
  }

  void report(const std::vector<DistanceField>& fields, Result& result) const {
    const double share = 1 / static_cast<double>(fields.size());
    result.proven = 0;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      result.reached += share * fields[i].reached;
      result.updates += share * static_cast<double>(fields[i].updates);
      result.proven = std::max(result.proven, fields[i].max_error_bound);
      if (truth_.empty()) continue;
      const ErrorMeasure error = compare_fields(fields[i].distance, truth_[i]).relative;
      result.mean_error += share * error.mean;
      result.max_error = std::max(result.max_error, error.max);
    }
  }

  const Mesh& mesh_;
  const Barriers& barriers_;
  std::vector<Source> sources_;
  const Plan& plan_;
  std::vector<std::vector<double>> truth_;  // per source; empty where errors are not asked for
};

double vertices_per_second(const Result& r) { return r.solve_s > 0 ? r.reached / r.solve_s : 0; }

// A number with a unit of thousands: "12.3 M".
std::string short_number(double value) {
  constexpr std::array kUnits{"", " k", " M", " G"};
  std::size_t unit = 0;
  for (; value >= 999.5 && unit + 1 < kUnits.size(); ++unit) value /= 1000;
  char text[32];
  std::snprintf(text, sizeof text, "%.3g%s", value, kUnits[unit]);
  return text;
}

std::string percent(double relative) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", 100 * relative);
  return std::isfinite(relative) ? text : "-";
}

std::string row(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    char text[64];
    std::snprintf(text, sizeof text, i == 0 ? "%-20s" : "%11s", cells[i].c_str());
    line += text;
  }
  return line + "\n";
}

std::string in_words(const Arguments& a, const Plan& plan, const Mesh& mesh, std::size_t sources,
                     const std::vector<Result>& results) {
  std::string text = a.file + ": " + counted(mesh.vertex_count(), "vertex", "vertices") + ", " +
                     counted(mesh.face_count(), "face", "faces") + "; " + counted(sources, "source", "sources") + ", " +
                     counted(plan.threads, "thread", "threads") + ", median of " + std::to_string(plan.repetitions) +
                     "\n";
  text += row({"method", "set-up", "solve", "vertices/s", "updates", "memory", "B/vertex", "mean error", "max error",
               "proven"});
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Result& r = results[i];
    const double memory = r.memory ? static_cast<double>(*r.memory) : 0;
    text +=
        row({name_of(plan.methods[i]), duration(r.set_up_s), duration(r.solve_s), short_number(vertices_per_second(r)),
             short_number(r.updates), r.memory ? short_number(memory) + "B" : "-",
             r.memory ? short_number(memory / mesh.vertex_count()) : "-", a.no_error ? "-" : percent(r.mean_error),
             a.no_error ? "-" : percent(r.max_error), percent(r.proven)});
  }
  return text;
}

std::string json(const Arguments& a, const Plan& plan, const Mesh& mesh, std::size_t sources, const PlaceFinder& places,
                 const std::vector<Result>& results) {
  std::vector<Record> methods;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Result& r = results[i];
    const DistanceOptions& options = plan.methods[i];
    const auto memory = [&](double share) {
      return r.memory ? Record::Value(static_cast<double>(*r.memory) * share) : Record::Value(nullptr);
    };
    const auto error = [&](double e) { return a.no_error ? Record::Value(nullptr) : Record::Value(e); };
    methods.emplace_back()
        .add("method", std::string(brushfire::name_of(options.method)))
        .add("tolerance", options.method == Method::Windows ? Record::Value(options.tolerance) : nullptr)
        .add("precision", precision_of(options))
        .add("set_up_s", r.set_up_s)
        .add("solve_s", r.solve_s)
        .add("vertices_per_s", vertices_per_second(r))
        .add("updates", r.updates)
        .add("memory_bytes", memory(1))
        .add("memory_bytes_per_vertex", memory(1.0 / mesh.vertex_count()))
        .add("mean_relative_error", error(r.mean_error))
        .add("max_relative_error", error(r.max_error))
        .add("max_error_bound", r.proven);
  }
  Record record;
  record.add("file", a.file)
      .add("vertices", std::int64_t{mesh.vertex_count()})
      .add("faces", std::int64_t{mesh.face_count()})
      .add("sources", static_cast<std::int64_t>(sources))
      .add("radius", a.shared.radius.value_or(kInfinity))
      .add("threads", std::int64_t{plan.threads})
      .add("repetitions", static_cast<std::int64_t>(plan.repetitions))
      .add("clock", std::string(plan.threads == 1 ? "processor" : "wall"))
      .add("methods", std::move(methods));
  places.add_to(record);
  return record.json();
}

int bench(const Arguments& a, const Talk& talk) {
  const Plan plan = plan_of(a);
  const Surface surface(a.file, a.shared);
  const Mesh& mesh = surface.mesh();
  PlaceFinder places(mesh, a.shared.snap_within);
  const std::vector<Source> sources = sources_of(a, plan, surface, places);
  places.tell(talk);
  const Progress progress = talk.progress("bench");
  const Bench bench(surface, sources, plan, !a.no_error);
  std::vector<Result> results;
  for (const DistanceOptions& options : plan.methods) {
    stop_if_interrupted();
    if (progress) progress(static_cast<double>(results.size()) / static_cast<double>(plan.methods.size()));
    results.push_back(bench.run(options));
  }
  talk.end_progress();
  write_stdout(talk.json ? json(a, plan, mesh, sources.size(), places, results)
                         : in_words(a, plan, mesh, sources.size(), results));
  return kOk;
}

}  // namespace

void add_bench(CommandLine& command_line) {
  const auto arguments = std::make_shared<Arguments>();
  command_line.add("bench", "What the methods cost on a mesh, and how far off they are", [&](Verb& verb) {
    add_surface(verb, arguments->file);
    verb.option("--spread", arguments->spread, "N", whole_from(1, 100000),
                "Solve from each of N vertices, spread over the mesh");
    verb.option("--repeat", arguments->repeat, "N", whole_from(1, 100000), "Repetitions (5)");
    verb.flag("--no-error", arguments->no_error, "Do not compute the exact distances to compare with");
    verb.talks();
    add_shared(verb, arguments->shared,
               {.without = {{kWeights, "methods are compared on distances, and costs have one method"},
                            {{Shared::Unit}, "bench tells times and relative errors, and no lengths"},
                            {{Shared::Scalar, Shared::Name}, "distances are computed here, not read"}},
                .also = {{Shared::Method, "--methods"}},
                .method = "all of them; may be repeated",
                .threads = "1"});
    verb.examples(kExamples);
    verb.run([arguments](Talk& talk) { return bench(*arguments, talk); });
  });
}

}  // namespace brushfire::tool
