// brushfire bench: what the methods cost on a mesh, and how far off they are.
#include "command_line.h"
#include "interrupt.h"
#include "process.h"
#include "where.h"

#include <brushfire/core/error.h>
#include <brushfire/core/parallel.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/queries/compare.h>
#include <brushfire/solvers/distance.h>

#include <algorithm>
#include <charconv>
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
  brushfire bench bunny.ply --sources 8 --threads 2 --json
  brushfire bench large.ply --method novotni-klein --repeat 9 --no-error

A method may be followed by :float64 (its arithmetic) or by a tolerance (windows:1e-4). Every repetition builds the mesh
from its arrays, with all that the method needs (set-up), and then solves for each source (solve, per source); what is
printed is the median. Times are processor time; with --threads above 1 they are by the clock on the wall: threads share
out the sources, and where there are more of them than sources, they work on one field together. Memory is the most that
the first repetition took beyond the arrays that it started from. Errors are relative, over all vertices and sources,
against the exact distances.)";

struct Arguments {
  std::string file;
  std::vector<std::string> methods, sources;
  std::optional<double> source_count, repeat, threads, snap_within;
  bool no_error = false;
};

struct Plan {
  std::vector<DistanceOptions> methods;
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

// Methods that compute in the precision that is asked for.
bool has_precision(Method method) { return method == Method::NovotniKlein || method == Method::KimmelSethian; }

// "windows:1e-4", "novotni-klein:float64", "exact".
DistanceOptions method_of(const std::string& text) {
  DistanceOptions options;
  const std::size_t colon = text.find(':');
  options.method = method_named(text.substr(0, colon));
  options.cancel = &cancel_token();
  if (colon == std::string::npos) return options;
  const std::string detail = text.substr(colon + 1);
  const bool marches = has_precision(options.method);
  if (marches && (detail == "float32" || detail == "float64")) {
    options.precision = detail == "float32" ? Precision::Float : Precision::Double;
  } else if (options.method == Method::Windows) {
    const char* end = detail.data() + detail.size();
    const auto [stop, status] = std::from_chars(detail.data(), end, options.tolerance);
    const bool fits = options.tolerance >= 0 && options.tolerance <= kMaxTolerance;
    if (status != std::errc() || stop != end || !fits) {
      refuse("'" + text + "': a tolerance is a number from 0 to 0.1");
    }
  } else {
    refuse("'" + text +
           "': " + (marches ? "after the colon goes float32 or float64" : "this method has nothing to choose"));
  }
  return options;
}

std::string name_of(const DistanceOptions& options) {
  std::string name(brushfire::name_of(options.method));
  if (options.method == Method::Windows) name += ":" + readable(options.tolerance);
  if (options.precision == Precision::Double) name += ":double";
  return name;
}

Plan plan_of(const Arguments& a) {
  Plan plan;
  constexpr int kMany = 100000;
  plan.source_count = static_cast<std::size_t>(whole_number(a.source_count, 1, 1, kMany, "--sources"));
  plan.repetitions = static_cast<std::size_t>(whole_number(a.repeat, 5, 1, kMany, "--repeat"));
  plan.threads = static_cast<unsigned>(whole_number(a.threads, 1, 1, kMostThreads, "--threads"));
  check_snap_within(a.snap_within);
  if (a.source_count && !a.sources.empty()) refuse("--sources N chooses vertices, --source names places: give one");
  for (const std::string& text : a.methods) plan.methods.push_back(method_of(text));
  if (!a.methods.empty()) return plan;
  for (const Method m : all_methods()) plan.methods.push_back(method_of(std::string(brushfire::name_of(m))));
  return plan;
}

// The places named, or vertices that have faces, evenly spread over their numbers, from the first one on.
std::vector<SurfacePoint> sources_of(const Arguments& a, const Plan& plan, const Mesh& mesh, PlaceFinder& places) {
  std::vector<SurfacePoint> points;
  for (const std::string& text : split_places(a.sources)) points.push_back(places.source(parse_where(text)));
  if (!points.empty()) return points;
  std::vector<Index> candidates;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.corners(v).empty()) candidates.push_back(v);
  }
  if (candidates.empty()) refuse(a.file + ": no vertex has a face to start from");
  const std::size_t count = std::min(plan.source_count, candidates.size());
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back(vertex_point(mesh, candidates[i * candidates.size() / count]));
  }
  return points;
}

class Bench {
 public:
  Bench(const Mesh& mesh, std::vector<SurfacePoint> sources, const Plan& plan, bool with_error)
      : mesh_(mesh), sources_(std::move(sources)), plan_(plan) {
    if (!with_error) return;
    DistanceOptions exact = method_of("exact");
    truth_.resize(sources_.size());
    DistanceSolver solver(mesh);
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
  static DistanceField field(DistanceSolver& solver, const SurfacePoint& point, const DistanceOptions& options) {
    const Source source{point};
    return solver.distance({&source, 1}, options);
  }
  DistanceField field(DistanceSolver& solver, std::size_t source, const DistanceOptions& options) const {
    return field(solver, sources_[source], options);
  }

  double now() const {
    if (plan_.threads == 1) return cpu_seconds();
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  // One repetition: seconds of set-up, seconds per source.
  std::pair<double, double> repeat(const DistanceOptions& options, bool first, Result& result) const {
    const double begin = now();
    const Mesh mesh(mesh_.positions(), mesh_.faces());
    const unsigned threads = std::min(plan_.threads, static_cast<unsigned>(sources_.size()));
    DistanceOptions each = options;
    each.threads = plan_.threads / threads;
    std::vector<DistanceSolver> solvers;
    for (unsigned t = 0; t < threads; ++t) solvers.emplace_back(mesh).set_up(options);
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
  std::vector<SurfacePoint> sources_;
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
        .add("precision", !has_precision(options.method)          ? Record::Value(nullptr)
                          : options.precision == Precision::Float ? Record::Value(std::string("float32"))
                                                                  : Record::Value(std::string("float64")))
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
      .add("threads", std::int64_t{plan.threads})
      .add("repetitions", static_cast<std::int64_t>(plan.repetitions))
      .add("clock", std::string(plan.threads == 1 ? "processor" : "wall"))
      .add("methods", std::move(methods));
  places.add_to(record);
  return record.json();
}

int bench(const Arguments& a, const Talk& talk) {
  const Plan plan = plan_of(a);
  const Mesh mesh = read_mesh(a.file).mesh;
  PlaceFinder places(mesh, a.snap_within);
  const std::vector<SurfacePoint> sources = sources_of(a, plan, mesh, places);
  places.tell(talk);
  const Progress progress = talk.progress("bench");
  const Bench bench(mesh, sources, plan, !a.no_error);
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
    verb.argument("FILE", arguments->file, "The mesh; - reads standard input");
    verb.option("-m,--method,--methods", arguments->methods, "NAME", "What to measure (all); may be repeated");
    verb.option("-s,--source", arguments->sources, "PLACE", "Solve from here; may be repeated");
    verb.option("--sources", arguments->source_count, "N", "Solve from each of N vertices, spread over the mesh (1)");
    verb.option("--repeat", arguments->repeat, "N", "Repetitions (5)");
    verb.option("--threads", arguments->threads, "N", "Threads that share out the sources, or a field (1)");
    add_snap_within(verb, arguments->snap_within);
    verb.flag("--no-error", arguments->no_error, "Do not compute the exact distances to compare with");
    verb.talks();
    verb.examples(kExamples);
    verb.run([arguments](Talk& talk) { return bench(*arguments, talk); });
  });
}

}  // namespace brushfire::tool
