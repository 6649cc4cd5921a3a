// Weights from files.
#include "weights.h"

#include "computing.h"
#include "numbers.h"

#include <brushfire/core/error.h>
#include <brushfire/io/npy.h>
#include <brushfire/io/read_field.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

namespace brushfire::tool {
namespace {

constexpr double kDefaultTolerance = 0.01;

// One for every triangle, or for every face of the file, whose triangles share it.
std::vector<double> face_weights(const std::string& file, const Surface& surface) {
  std::vector<double> values = read_field(file).values;
  const Index count = surface.mesh().face_count();
  if (values.size() == count) return values;
  const std::vector<Index>& origin = surface.file().face_origin;
  const Index faces = origin.empty() ? count : *std::max_element(origin.begin(), origin.end()) + 1;
  if (values.size() < faces || origin.empty()) {
    refuse("--weights " + file + ": " + counted(values.size(), "value", "values") + ", but the mesh has " +
           std::to_string(count) + " faces");
  }
  std::vector<double> on_triangles;
  on_triangles.reserve(count);
  for (const Index f : origin) on_triangles.push_back(values[f]);
  return on_triangles;
}

Index vertex_of(double value, const Surface& surface, const std::string& file) {
  const Index count = surface.is_welded() ? surface.file().mesh.vertex_count() : surface.mesh().vertex_count();
  if (!(value >= 0 && value < count && value == std::floor(value))) {
    refuse("--edge-weights " + file + ": there is no vertex " + exact(value) + ", the mesh has " +
           std::to_string(count));
  }
  return surface.vertex(static_cast<Index>(value));
}

double number_of(const std::string& word, const std::string& file, std::size_t line) {
  if (word == "inf") return kInfinity;
  if (const auto number = decimal(word)) return *number;
  throw Error(ErrorCode::FileMalformed, file + ":" + std::to_string(line) + ": " + in_quotes(word) + " is no number");
}

// The numbers of every line; # starts a comment.
std::vector<std::vector<double>> read_rows(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw Error(ErrorCode::FileNotReadable, file + ": cannot be read");
  std::vector<std::vector<double>> rows;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    line.resize(std::min(line.find('#'), line.size()));
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::vector<double> row;
    for (std::string word; words >> word;) row.push_back(number_of(word, file, number));
    if (!row.empty()) rows.push_back(std::move(row));
  }
  return rows;
}

// Rows of three or four numbers: two vertices, the cost along the edge, the cost to cross it.
std::vector<std::vector<double>> rows_of(const std::string& file) {
  if (!file.ends_with(".npy")) return read_rows(file);
  const NpyArray array = read_npy(file);
  const std::size_t columns = array.shape.size() == 2 ? array.shape[1] : 1;
  std::vector<std::vector<double>> rows;
  for (auto row = array.values.begin(); row != array.values.end(); row += static_cast<std::ptrdiff_t>(columns)) {
    rows.emplace_back(row, row + static_cast<std::ptrdiff_t>(columns));
  }
  return rows;
}

std::vector<EdgeCost> edge_costs(const std::string& file, const Surface& surface) {
  std::vector<EdgeCost> edges;
  for (const std::vector<double>& row : rows_of(file)) {
    if (row.size() != 3 && row.size() != 4) {
      refuse("--edge-weights " + file +
             ": an edge is two vertices, the cost along it (inf: as in its faces) and, if "
             "wanted, the cost to cross it, not " +
             counted(row.size(), "number", "numbers"));
    }
    edges.push_back(
        {{vertex_of(row[0], surface, file), vertex_of(row[1], surface, file)}, row[2], row.size() == 4 ? row[3] : 0});
  }
  return edges;
}

// A name, or a file of slopes and paces.
SlopePace pace_of(const std::string& slope) {
  if (slope == "tobler") return SlopePace::tobler();
  if (slope == "naismith") return SlopePace::naismith();
  if (slope == "energy") return SlopePace::energy();
  std::vector<double> slopes, paces;
  for (const std::vector<double>& row : rows_of(slope)) {
    if (row.size() != 2) refuse("--slope " + slope + ": a line is a slope and the pace there, two numbers");
    slopes.push_back(row[0]);
    paces.push_back(row[1]);
  }
  return SlopePace::table(slopes, paces);
}

}  // namespace

void add_weights(Verb& verb, WeightArguments& arguments) {
  verb.option("--weights", arguments.faces_file, "FIELD", "What a unit of length costs in each face, > 0; inf: a wall");
  verb.option("--edge-weights", arguments.edges_file, "FILE",
              "Lines of two vertices, cost along their edge, cost to cross");
  verb.option("--slope", arguments.slope, "NAME", "What slopes cost: tobler, naismith, energy, or a file of paces");
  verb.option("--steepest", arguments.steepest, "S", kPositive, "With --slope: no step is steeper than this");
  verb.flag("--towards", arguments.towards, "With --slope: to the sources, not from them");
}

Weights weights_of(const WeightArguments& arguments, const Surface& surface) {
  Weights weights;
  if (!arguments.faces_file.empty()) weights.face = face_weights(arguments.faces_file, surface);
  if (!arguments.edges_file.empty()) weights.edges = edge_costs(arguments.edges_file, surface);
  if (!arguments.slope.empty()) weights.pace = pace_of(arguments.slope);
  if (weights.pace && arguments.steepest) weights.pace = weights.pace->up_to(*arguments.steepest);
  return weights;
}

WeightedOptions weighted_computation(const SharedArguments& a, const WeightArguments& weights) {
  if (const char* name = given(a, {Shared::Method, Shared::Precision})) {
    refuse(std::string(name) + ": with --weights there is one method, points on edges");
  }
  if (weights.slope.empty() && (weights.steepest || weights.towards)) {
    refuse(std::string(weights.towards ? "--towards" : "--steepest") + ": without --slope it makes no difference");
  }
  if (!weights.slope.empty() && a.bound == "lower") refuse("--bound lower: with --slope there are upper bounds only");
  DistanceOptions plain = computation(a);
  WeightedOptions options;
  options.tolerance = given(a, {Shared::Tolerance}) ? plain.tolerance : kDefaultTolerance;
  options.towards = weights.towards;
  options.lower = plain.bound != Bound::Upper;
  options.max_distance = plain.max_distance;
  options.cancel = plain.cancel;
  return options;
}

}  // namespace brushfire::tool
