// The table.
#include "shared.h"

#include "computing.h"

#include <brushfire/solvers/distance.h>

#include <algorithm>
#include <array>
#include <utility>

namespace brushfire::tool {
namespace {

constexpr std::array<std::pair<std::string_view, double>, 5> kUnits{
    {{"mm", 1}, {"um", 1e-3}, {"cm", 10}, {"m", 1000}, {"in", 25.4}}};

std::vector<std::string> unit_names() {
  std::vector<std::string> names;
  for (const auto& [name, size] : kUnits) names.emplace_back(name);
  return names;
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method m : all_methods()) names.emplace_back(name_of(m));
  // Where the build lacks it, what is missing is said later.
  if (names.back() != name_of(Method::Heat)) names.emplace_back(name_of(Method::Heat));
  return names;
}

struct Row {
  Shared option;
  const char* name;
  const char* also;  // another name for it, "-r", or ""
  void (*bind)(Verb& verb, const char* names, SharedArguments& a, const SharedOptions& own);
  bool (*is_given)(const SharedArguments& a);
};

const std::vector<Row>& table() {
  static const std::vector<Row> rows{
      {Shared::Source, "--source", "-s",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.sources, "PLACE", "Distances start from here, a place or a curve; may be repeated");
       },
       [](const SharedArguments& a) { return !a.sources.empty(); }},
      {Shared::Sources, "--sources", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.sources_file, "LIST", "File of places to start from, one per line, # comments");
       },
       [](const SharedArguments& a) { return !a.sources_file.empty(); }},
      {Shared::SnapWithin, "--snap-within", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.snap_within, "R", kLimit,
                     "Refuse positions (at:x,y,z) that are farther than this from the surface");
       },
       [](const SharedArguments& a) { return a.snap_within.has_value(); }},
      {Shared::Scalar, "--scalar", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.scalar_file, "FIELD",
                     "The values of this file, one per vertex, in place of distances: .npy .csv .txt .gii ...");
       },
       [](const SharedArguments& a) { return !a.scalar_file.empty(); }},
      {Shared::Name, "--name", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.array_name, "NAME", "Which array or column of a file of values; the first if not given");
       },
       [](const SharedArguments& a) { return !a.array_name.empty(); }},
      {Shared::Method, "--method", "-m",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions& own) {
         verb.choice(names, a.methods, method_names(), ("How to compute (" + own.method + ")").c_str());
       },
       [](const SharedArguments& a) { return !a.methods.empty(); }},
      {Shared::Tolerance, "--tolerance", "--accuracy",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.tolerance, "T", kTolerances,
                     "Relative error that windows keeps at every vertex, 0 to 0.1; or draft, standard, fine,\n"
                     "exact: 0.01, 0.001, 0.00001, 0 (1e-3)");
       },
       [](const SharedArguments& a) { return a.tolerance.has_value(); }},
      {Shared::Bound, "--bound", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.choice(names, a.bound, bound_names(), "Never shorter (upper), never longer (lower) than the truth");
       },
       [](const SharedArguments& a) { return !a.bound.empty(); }},
      {Shared::Precision, "--precision", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.choice(names, a.precision, {"float32", "float64"}, "Arithmetic of the marching methods (float32)");
       },
       [](const SharedArguments& a) { return !a.precision.empty(); }},
      {Shared::Radius, "--radius", "-r",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.radius, "R", kLimit, "Stop at this distance; what is farther reads inf");
       },
       [](const SharedArguments& a) { return a.radius.has_value(); }},
      {Shared::Threads, "--threads", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions& own) {
         verb.option(names, a.threads, "N", whole_from(0, kMostThreads),
                     ("Threads to work with; 0: one per processor (" + own.threads + ")").c_str());
       },
       [](const SharedArguments& a) { return a.threads.has_value(); }},
      {Shared::Weld, "--weld", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.weld, "T", kLength, "Join vertices within T of one another (0: equal ones)");
       },
       [](const SharedArguments& a) { return a.weld.has_value(); }},
      {Shared::Mask, "--mask", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.mask_file, "FIELD",
                     "Stay where these values are above 0: in faces whose three vertices are");
       },
       [](const SharedArguments& a) { return !a.mask_file.empty(); }},
      {Shared::Region, "--region", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.region, "FILE:LABEL",
                     "Stay where the file's values are these labels, by number or name, with commas");
       },
       [](const SharedArguments& a) { return !a.region.empty(); }},
      {Shared::BlockFaces, "--block-faces", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.faces_file, "FILE", "Nothing enters these faces: their numbers, or a 0 or 1 for each");
       },
       [](const SharedArguments& a) { return !a.faces_file.empty(); }},
      {Shared::BlockEdges, "--block-edges", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.edges_file, "FILE",
                     "Nothing crosses these edges: pairs of vertices, one to a line, or .npy");
       },
       [](const SharedArguments& a) { return !a.edges_file.empty(); }},
      {Shared::BlockVertices, "--block-vertices", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.vertices_file, "FILE",
                     "Nothing passes these vertices, nor enters their faces: their numbers, or a 0 or 1\nfor each");
       },
       [](const SharedArguments& a) { return !a.vertices_file.empty(); }},
      {Shared::Weights, "--weights", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.weights_file, "FIELD",
                     "What a unit of length costs in each face, > 0, inf: a wall; FILE:NAME is a property of\n"
                     "a mesh's faces");
       },
       [](const SharedArguments& a) { return !a.weights_file.empty(); }},
      {Shared::EdgeWeights, "--edge-weights", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.edge_weights_file, "FILE", "Lines of two vertices, cost along their edge, cost to cross");
       },
       [](const SharedArguments& a) { return !a.edge_weights_file.empty(); }},
      {Shared::Cost, "--cost", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.costs, "LABEL=COST",
                     "With labels as --weights: what these cost; others 1; may be repeated");
       },
       [](const SharedArguments& a) { return !a.costs.empty(); }},
      {Shared::Grain, "--grain", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.grain_file, "FILE",
                     "For each face x y z of a direction, and how many times as much going across it costs");
       },
       [](const SharedArguments& a) { return !a.grain_file.empty(); }},
      {Shared::Slope, "--slope", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.slope, "NAME", "What slopes cost: tobler, naismith, energy, or a file of paces");
       },
       [](const SharedArguments& a) { return !a.slope.empty(); }},
      {Shared::Steepest, "--steepest", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.option(names, a.steepest, "S", kPositive, "With --slope: no step is steeper than this");
       },
       [](const SharedArguments& a) { return a.steepest.has_value(); }},
      {Shared::Tacking, "--tacking", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.flag(names, a.tacking, "With --slope: steep steps go in tacks, where that is cheaper");
       },
       [](const SharedArguments& a) { return a.tacking; }},
      {Shared::Towards, "--towards", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.flag(names, a.towards, "With --slope: to the sources, not from them");
       },
       [](const SharedArguments& a) { return a.towards; }},
      {Shared::Unit, "--unit", "",
       [](Verb& verb, const char* names, SharedArguments& a, const SharedOptions&) {
         verb.choice(names, a.unit, unit_names(), "What the mesh is measured in");
       },
       [](const SharedArguments& a) { return !a.unit.empty(); }},
  };
  return rows;
}

std::string names_of(const Row& row) { return row.name + std::string(*row.also ? "," : "") + row.also; }

const std::string* reason_against(const Row& row, const SharedOptions& options) {
  for (const Without& w : options.without) {
    if (std::find(w.options.begin(), w.options.end(), row.option) != w.options.end()) return &w.reason;
  }
  return nullptr;
}

}  // namespace

void add_shared(Verb& verb, SharedArguments& arguments, const SharedOptions& options) {
  verb.group("Options that verbs share");
  for (const Row& row : table()) {
    if (const std::string* reason = reason_against(row, options)) {
      verb.refused(names_of(row).c_str(), true, *reason);
      continue;
    }
    const auto also = options.also.find(row.option);
    const std::string names = names_of(row) + (also == options.also.end() ? "" : "," + also->second);
    row.bind(verb, names.c_str(), arguments, options);
  }
  verb.group("");
}

std::vector<std::string> shared_names() {
  std::vector<std::string> names;
  for (const Row& row : table()) names.emplace_back(row.name);
  return names;
}

const char* given(const SharedArguments& arguments, const std::vector<Shared>& options) {
  for (const Row& row : table()) {
    const bool asked = std::find(options.begin(), options.end(), row.option) != options.end();
    if (asked && row.is_given(arguments)) return row.name;
  }
  return nullptr;
}

std::string with_unit(double length, const SharedArguments& arguments) {
  return readable(length) + (arguments.unit.empty() ? "" : " " + arguments.unit);
}

Record::Value unit_of(const SharedArguments& arguments) {
  return arguments.unit.empty() ? Record::Value(nullptr) : Record::Value(arguments.unit);
}

double millimetres(const SharedArguments& arguments) {
  for (const auto& [name, size] : kUnits) {
    if (name == arguments.unit) return size;
  }
  return 1;
}

}  // namespace brushfire::tool
