// brushfire certify: what can be proven about a field, whoever made it.
#include "computing.h"
#include "fields.h"
#include "interrupt.h"
#include "output.h"
#include "sources.h"
#include "surface.h"

#include <brushfire/io/npy.h>
#include <brushfire/io/write_bytes.h>
#include <brushfire/io/write_field.h>
#include <brushfire/queries/certify.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire certify bunny.ply heat.npy --source 0
  brushfire certify bunny.ply heat.npy --source 0 --within 0.01 || echo off by more than 1 %
  brushfire certify bunny.ply gdist.csv --sources seeds.txt --json
  brushfire certify bunny.ply heat.npy --source 0 -o wrong.ply
  brushfire certify huge.ply heat.npy --source 0 --tolerance 1e-3 -o bounds.csv

For every vertex a lower and an upper bound of the distance are proven, and every value outside of them is proven wrong;
so are NaN, a number where no source leads, and inf where one does. With --within E the values may be off by the share E
of the distance, as the tool that made them says. Exit code 0 where nothing is proven wrong, 5 where something is.

A field is any file with one number per vertex (as for brushfire compare), in the order of the mesh's vertices. The
bounds are those of an exact run and differ by rounding; with --tolerance T they are up to 2 T of the distance apart,
which is quicker on large meshes.

-o FILE.csv has a line per vertex: value, bounds, by how much it is wrong at least (negative: too short; 0: nothing is
proven), and what is wrong. FILE.npy has lower, upper and that error, one row per vertex. FILE.ply, .vtk and the other
formats of brushfire distance are coloured by how large the error is.)";

struct Arguments {
  std::string mesh, field, output;
  SharedArguments shared;
  std::optional<double> within;
  std::optional<int> show;
};

constexpr int kShown = 10;

bool ends_with(const std::string& path, const char* ending) { return path.ends_with(ending); }

void check(const Arguments& a, const Talk& talk) {
  check_output(a.output);
  if (a.output == "-" && talk.json) refuse("only one of -o - and --json can have the standard output");
}

// That of the bounds: exact ones if nothing is said.
double tolerance_asked(const Arguments& a) { return given(a.shared, kAccuracy) ? computation(a.shared).tolerance : 0; }

// The vertices that are proven wrong, the largest errors first; ties by number.
std::vector<Index> wrong_vertices(const Certificate& c) {
  std::vector<Index> wrong;
  for (Index v = 0; v < c.finding.size(); ++v) {
    if (c.finding[v] != Finding::Possible) wrong.push_back(v);
  }
  const auto size = [&](Index v) { return std::isnan(c.proven_error[v]) ? kInfinity : std::abs(c.proven_error[v]); };
  std::stable_sort(wrong.begin(), wrong.end(), [&](Index a, Index b) { return size(a) > size(b); });
  return wrong;
}

// ---- per vertex

std::string as_csv(const std::vector<double>& field, const Certificate& c) {
  std::string text = "vertex,value,lower,upper,proven_error,finding\n";
  for (Index v = 0; v < field.size(); ++v) {
    text += std::to_string(v) + "," + exact(field[v]) + "," + exact(c.lower[v]) + "," + exact(c.upper[v]) + "," +
            exact(c.proven_error[v]) + "," + std::string(name_of(c.finding[v])) + "\n";
  }
  return text;
}

void write(const std::string& path, const Mesh& mesh, const std::vector<double>& field, const Certificate& c) {
  if (path == "-" || ends_with(path, ".csv")) return write_text(path, as_csv(field, c));
  if (ends_with(path, ".npy")) {
    std::vector<double> rows;
    for (std::size_t v = 0; v < field.size(); ++v) {
      rows.insert(rows.end(), {c.lower[v], c.upper[v], c.proven_error[v]});
    }
    return write_npy(path, rows, std::vector<std::size_t>{field.size(), 3});
  }
  std::vector<double> size;
  for (const double e : c.proven_error) size.push_back(std::isnan(e) ? kInfinity : std::abs(e));
  write_field(path, mesh, {.values = size, .labels = {}, .name = "proven_error"});
}

// ---- in words and as JSON

std::string json(const Arguments& a, const std::vector<double>& field, const Certificate& c,
                 const std::vector<Index>& wrong, std::size_t shown, const PlaceFinder& places) {
  const auto count = [](Index n) { return std::int64_t{n}; };
  Record record;
  record.add("mesh", a.mesh)
      .add("field", a.field)
      .add("verdict", c.proven_wrong() > 0 ? "proven wrong" : "nothing proven wrong")
      .add("vertices", count(static_cast<Index>(field.size())))
      .add("possible", count(c.possible))
      .add("proven_wrong", count(c.proven_wrong()))
      .add("too_short", count(c.too_short))
      .add("too_long", count(c.too_long))
      .add("not_reachable", count(c.not_reachable))
      .add("not_reached", count(c.not_reached))
      .add("not_a_number", count(c.not_a_number))
      .add("tolerance", tolerance_asked(a))
      .add("within", a.within.value_or(0))
      .add("radius", a.shared.radius.value_or(kInfinity))
      .add("unit", unit_of(a.shared))
      .add("least_within", c.least_within)
      .add("worst_vertex", c.worst_vertex == kNoIndex ? -1 : count(c.worst_vertex))
      .add("max_gap", c.max_gap);
  std::vector<Record> list;
  for (std::size_t i = 0; i < shown; ++i) {
    const Index v = wrong[i];
    list.emplace_back()
        .add("vertex", count(v))
        .add("finding", std::string(name_of(c.finding[v])))
        .add("value", field[v])
        .add("lower", c.lower[v])
        .add("upper", c.upper[v])
        .add("proven_error", c.proven_error[v]);
  }
  record.add("wrong", std::move(list));
  places.add_to(record);
  record.add("output", a.output);
  return record.json();
}

std::string line_of(Index v, double value, const Certificate& c) {
  std::string text = "  vertex " + std::to_string(v) + " reads " + exact(value) + ": ";
  switch (c.finding[v]) {
    case Finding::TooShort:
      return text + "too short by " + readable(-c.proven_error[v]) + " or more, the distance is at least " +
             exact(c.lower[v]);
    case Finding::TooLong:
      return text + "too long by " + readable(c.proven_error[v]) + " or more, the distance is at most " +
             exact(c.upper[v]);
    case Finding::NotReachable:
      return text + "no source leads there, only inf is right";
    case Finding::NotReached:
      return text + "a source leads there, at " + exact(c.upper[v]) + " or less";
    case Finding::NotANumber:
    case Finding::Possible:
      break;
  }
  return text + "no number";
}

std::string in_words(const Arguments& a, const std::vector<double>& field, const Certificate& c,
                     const std::vector<Index>& wrong, std::size_t shown) {
  std::string text = a.field + " on " + a.mesh + ": ";
  const std::string gap = "the bounds are within " + readable(100 * c.max_gap) + " % of each other";
  if (wrong.empty()) {
    return text + "nothing is proven wrong\n  " + counted(c.possible, "vertex", "vertices") + " may be right; " + gap +
           "\n";
  }
  text += "proven wrong\n  " + std::to_string(wrong.size()) + " of " + counted(field.size(), "vertex", "vertices") +
          " cannot be right; " + gap + "\n";
  const auto note = [&](Index n, const char* what) {
    if (n > 0) text += "  " + std::to_string(n) + " " + what + "\n";
  };
  note(c.too_short, "too short");
  note(c.too_long, "too long");
  note(c.not_reachable, "a number where no source leads");
  note(c.not_reached, "inf where a source leads");
  note(c.not_a_number, "not a number");
  if (c.least_within < kInfinity) text += "  with --within " + exact(c.least_within) + " nothing would be\n";
  for (std::size_t i = 0; i < shown; ++i) text += line_of(wrong[i], field[wrong[i]], c) + "\n";
  if (shown < wrong.size()) text += "  ... (-o FILE.csv has all of them)\n";
  return text;
}

// What is said of a vertex holds for all that were joined to it.
Certificate on_file(const Surface& surface, Certificate c) {
  if (!surface.is_welded()) return c;
  c.lower = surface.on_file<double>(c.lower);
  c.upper = surface.on_file<double>(c.upper);
  c.proven_error = surface.on_file<double>(c.proven_error);
  c.finding = surface.on_file<Finding>(c.finding);
  const auto count = [&](Finding f) { return static_cast<Index>(std::count(c.finding.begin(), c.finding.end(), f)); };
  c.possible = count(Finding::Possible);
  c.too_short = count(Finding::TooShort);
  c.too_long = count(Finding::TooLong);
  c.not_reachable = count(Finding::NotReachable);
  c.not_reached = count(Finding::NotReached);
  c.not_a_number = count(Finding::NotANumber);
  c.worst_vertex = surface.file_vertex(c.worst_vertex);
  return c;
}

int certify_verb(const Arguments& a, const Talk& talk) {
  check(a, talk);
  const std::vector<Where> places = parse_sources(a.shared);
  CertifyOptions options;
  options.tolerance = tolerance_asked(a);
  options.within = a.within.value_or(0);
  options.max_distance = a.shared.radius.value_or(kInfinity);
  options.threads = static_cast<unsigned>(a.shared.threads.value_or(0));
  const auto most = static_cast<std::size_t>(a.show.value_or(kShown));

  const Surface surface(a.mesh, a.shared);
  stop_if_interrupted();
  const Index count = surface.file().mesh.vertex_count();
  std::vector<double> field = values_of(read_field(a.field, a.shared.array_name), a.field, count, a.mesh);
  // What lies behind walls may be no number, as it is in GIFTI.
  const std::vector<std::uint8_t> open = surface.open_vertices();
  for (std::size_t v = 0; v < open.size(); ++v) {
    if (!open[v] && std::isnan(field[v])) field[v] = kInfinity;
  }
  PlaceFinder finder(surface.mesh(), a.shared.snap_within);
  const std::vector<Source> sources = sources_on(surface, finder, places);
  finder.tell(talk);

  options.cancel = &cancel_token();
  options.progress = talk.progress("certify");
  const Certificate certificate =
      on_file(surface, certify(surface.domain(), surface.on_mesh(field, a.field), sources, options));
  talk.end_progress();

  if (!a.output.empty()) write(a.output, surface.file().mesh, field, certificate);
  const std::vector<Index> wrong = wrong_vertices(certificate);
  const std::size_t shown = std::min(most, wrong.size());
  if (talk.json) {
    write_stdout(json(a, field, certificate, wrong, shown, finder));
  } else if (a.output == "-") {
    talk.say(in_words(a, field, certificate, wrong, shown));
  } else {
    write_stdout(in_words(a, field, certificate, wrong, shown));
  }
  return wrong.empty() ? kOk : kProvenWrong;
}

}  // namespace

void add_certify(CommandLine& command_line) {
  const auto arguments = std::make_shared<Arguments>();
  command_line.add("certify", "What can be proven about a field, whoever made it", [&](Verb& verb) {
    verb.argument("MESH", arguments->mesh, "The mesh");
    verb.argument("FIELD", arguments->field, "The distances to judge, one number per vertex");
    verb.option("--within", arguments->within, "E", kLimit, "Values may be off by this share of the distance (0)");
    verb.option("--show", arguments->show, "N", whole_from(0, 1e9),
                "How many wrong vertices to tell, the largest errors first (10)");
    verb.option("-o,--output", arguments->output, "FILE", "Write what is known of every vertex: .csv .npy .ply ...");
    verb.talks();
    add_shared(
        verb, arguments->shared,
        {.without = {{kWeights, "what is judged are distances; brushfire distance --weights proves its own bounds"},
                     {{Shared::Method}, "bounds are proven by exact, or with --tolerance by windows"},
                     {{Shared::Bound}, "both bounds are proven"},
                     {{Shared::Precision}, "only the marching methods have one, and they prove nothing"},
                     {{Shared::Scalar}, "the values to judge are FIELD"}}});
    verb.examples(kExamples);
    verb.run([arguments](Talk& talk) { return certify_verb(*arguments, talk); });
  });
}

}  // namespace brushfire::tool
