// Weights from files.
#include "weights.h"

#include "computing.h"
#include "fields.h"
#include "numbers.h"
#include "text_lines.h"

#include <brushfire/core/error.h>
#include <brushfire/io/npy.h>
#include <brushfire/io/read_face_values.h>
#include <brushfire/io/read_field.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <utility>
#include <vector>

namespace brushfire::tool {
namespace {

constexpr double kDefaultTolerance = 0.01;

// FILE, or FILE:NAME where there is no file of that whole name.
std::vector<double> face_values(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || std::ifstream(text).good()) return read_field(text).values;
  return read_face_values(text.substr(0, colon), text.substr(colon + 1));
}

// One for every triangle, or for every face of the file, whose triangles share it.
std::vector<double> on_faces(const std::string& file, std::vector<double> values, const Surface& surface) {
  const Index count = surface.mesh().face_count();
  if (values.size() == count) return values;
  const std::vector<Index>& origin = surface.file().face_origin;
  const Index faces = origin.empty() ? count : *std::max_element(origin.begin(), origin.end()) + 1;
  if (values.size() < faces || origin.empty()) {
    refuse(file + ": " + counted(values.size(), "value", "values") + ", but the mesh has " + std::to_string(count) +
           " faces");
  }
  std::vector<double> on_triangles;
  on_triangles.reserve(count);
  for (const Index f : origin) on_triangles.push_back(values[f]);
  return on_triangles;
}

std::vector<double> face_weights(const std::string& file, const Surface& surface) {
  return on_faces("--weights " + file, face_values(file), surface);
}

// What labels cost, by their keys.
std::map<double, double> costs_of(const SharedArguments& a, const LoadedField& field) {
  std::map<double, double> costs;
  for (const std::string& text : a.costs) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string::npos || equals == 0) refuse("--cost " + text + ": LABEL=COST is needed, marsh=4");
    const double cost =
        text.substr(equals + 1) == "inf" ? kInfinity : number_in(kPositive, "--cost", text.substr(equals + 1));
    for (const double key : keys_named(field, text.substr(0, equals), a.weights_file, "--cost")) costs[key] = cost;
  }
  return costs;
}

// Labels of faces cost what they cost; of vertices, a face costs the mean of its three corners.
std::vector<double> label_weights(const SharedArguments& a, const Surface& surface) {
  const std::string& file = a.weights_file;
  LoadedField field;
  if (file.rfind(':') != std::string::npos && !std::ifstream(file).good()) {
    field.values = face_values(file);
  } else {
    field = read_field(file);
  }
  const std::map<double, double> costs = costs_of(a, field);
  const bool of_vertices = !field.vertices.empty() || field.values.size() == surface.file().mesh.vertex_count();
  if (of_vertices) field.values = values_on_vertices(field, surface.file().mesh.vertex_count());
  for (double& value : field.values) {
    const auto found = costs.find(value);
    value = found == costs.end() ? 1 : found->second;
  }
  if (!of_vertices) return on_faces("--weights " + file, std::move(field.values), surface);
  const std::vector<double> at = surface.on_mesh(std::move(field.values), file);
  std::vector<double> weights;
  for (const Face& f : surface.mesh().faces()) weights.push_back((at[f[0]] + at[f[1]] + at[f[2]]) / 3);
  return weights;
}

Index vertex_of(double value, const Surface& surface, const std::string& file) {
  const Index count = surface.is_welded() ? surface.file().mesh.vertex_count() : surface.mesh().vertex_count();
  if (!(value >= 0 && value < count && value == std::floor(value))) {
    refuse("--edge-weights " + file + ": there is no vertex " + exact(value) + ", the mesh has " +
           std::to_string(count));
  }
  return surface.vertex(static_cast<Index>(value));
}

double number_of(const std::string& word, const TextLines& lines) {
  if (word == "inf") return kInfinity;
  if (const auto number = decimal(word)) return *number;
  throw Error(ErrorCode::FileMalformed, lines.here() + in_quotes(word) + " is no number");
}

// The numbers of every line; # starts a comment.
std::vector<std::vector<double>> read_rows(const std::string& file) {
  TextLines lines(file);
  std::vector<std::vector<double>> rows;
  for (std::string line; lines.next(line);) {
    line.resize(std::min(line.find('#'), line.size()));
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::vector<double> row;
    for (std::string word; words >> word;) row.push_back(number_of(word, lines));
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

// Rows of four numbers, one for every face: a direction and the cost across it.
std::vector<Grain> grain_of(const std::string& file, const Surface& surface) {
  std::vector<double> place;  // of the row of every triangle
  const std::vector<std::vector<double>> rows = rows_of(file);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() != 4) {
      refuse("--grain " + file + ": the direction's x y z, and how many times as much going across it costs, not " +
             counted(rows[i].size(), "number", "numbers"));
    }
    place.push_back(static_cast<double>(i));
  }
  std::vector<Grain> grain;
  for (const double i : on_faces("--grain " + file, std::move(place), surface)) {
    const std::vector<double>& row = rows[static_cast<std::size_t>(i)];
    grain.push_back({{row[0], row[1], row[2]}, row[3]});
  }
  return grain;
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

Weights weights_of(const SharedArguments& a, const Surface& surface) {
  if (const char* steep = given(a, {Shared::Steepest, Shared::Tacking, Shared::Towards}); steep && a.slope.empty()) {
    refuse(std::string(steep) + ": without --slope it makes no difference");
  }
  if (!a.costs.empty() && a.weights_file.empty()) refuse("--cost: of which labels? give them by --weights");
  Weights weights;
  if (!a.costs.empty()) {
    weights.face = label_weights(a, surface);
  } else if (!a.weights_file.empty()) {
    weights.face = face_weights(a.weights_file, surface);
  }
  if (!a.edge_weights_file.empty()) weights.edges = edge_costs(a.edge_weights_file, surface);
  if (!a.grain_file.empty()) weights.grain = grain_of(a.grain_file, surface);
  if (!a.slope.empty()) weights.pace = pace_of(a.slope);
  if (weights.pace && a.steepest) weights.pace = weights.pace->up_to(*a.steepest);
  if (weights.pace && a.tacking) weights.pace = weights.pace->tacking();
  return weights;
}

WeightedOptions weighted_computation(const SharedArguments& a) {
  if (given(a, {Shared::Precision})) refuse("--precision: with --weights it is not to be chosen");
  if ((!a.slope.empty() || !a.grain_file.empty()) && a.bound == "lower") {
    refuse("--bound lower: with --slope and --grain there are upper bounds only");
  }
  DistanceOptions plain = computation(a);
  WeightedOptions options;
  options.tolerance = given(a, {Shared::Tolerance}) ? plain.tolerance : kDefaultTolerance;
  options.towards = a.towards;
  options.lower = plain.bound != Bound::Upper;
  options.max_distance = plain.max_distance;
  options.cancel = plain.cancel;
  if (given(a, {Shared::Method})) {
    if (plain.method != Method::KimmelSethian) {
      refuse("--method " + a.methods.front() +
             ": costs are found without --method (bounds on both sides), or by kimmel-sethian (fast, without a bound)");
    }
    if (a.bound == "lower") refuse("--bound lower: marching has no bounds");
    options.marching = plain.method;
  }
  return options;
}

std::string method_of(const Weighting& weighting) {
  return weighting.options().marching ? std::string(name_of(*weighting.options().marching)) : "steiner";
}

void weigh(DistanceOptions& options, const SharedArguments& a, const Surface& surface) {
  if (surface.weights() == nullptr) return;
  const WeightedOptions how = weighted_computation(a);
  options.weighting = std::make_shared<const Weighting>(surface.domain(), *surface.weights(),
                                                        WeightingOptions{how.tolerance, how.towards, how.marching});
}

}  // namespace brushfire::tool
