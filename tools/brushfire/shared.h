// The options that verbs share: each stands once in one table, which parsing, help, completion and manual pages are
// made from. A verb has all of them, under the same names and with the same meaning, but those that it refuses, by name
// and with the reason. Whoever adds an option adds a row (shared.cpp), a variable (SharedArguments), and its meaning
// where the others have theirs: on the mesh (surface.h), in it (walls.h), where distances start from (sources.h), how
// they are computed (computing.h).
#pragma once

#include "command_line.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace brushfire::tool {

enum class Shared : std::uint8_t {
  Source,
  Sources,
  SnapWithin,
  Scalar,
  Name,
  Method,
  Tolerance,
  Bound,
  Precision,
  Radius,
  Threads,
  Weld,
  Mask,
  Region,
  BlockFaces,
  BlockEdges,
  BlockVertices,
  Weights,
  EdgeWeights,
  Cost,
  Grain,
  Slope,
  Steepest,
  Tacking,
  Towards,
  Unit,
};

// What was given: nothing, "" and no entries where it was not.
struct SharedArguments {
  std::vector<std::string> sources;
  std::string sources_file;
  std::optional<double> snap_within;
  std::string scalar_file, array_name;
  std::vector<std::string> methods;
  std::optional<double> tolerance;
  std::string bound, precision;
  std::optional<double> radius;
  std::optional<int> threads;
  std::optional<double> weld;
  std::string mask_file, region, faces_file, edges_file, vertices_file;
  std::string weights_file, edge_weights_file, grain_file, slope;
  std::vector<std::string> costs;  // of labels
  std::optional<double> steepest;
  bool tacking = false, towards = false;
  std::string unit;
};

// Options that a verb has not, and why: "a path is exact".
struct Without {
  std::vector<Shared> options;
  std::string reason;
};

// What is a verb's own in what it shares.
struct SharedOptions {
  std::vector<Without> without{};
  std::map<Shared, std::string> also{};  // more names for the same: {Shared::Source, "--from"}
  std::string method = "windows";        // what is computed with if nothing is said, for the help
  std::string threads = "0";
};

// Where distances start from, and how they are computed: for those who do neither.
inline const std::vector<Shared> kStarting{Shared::Source, Shared::Sources, Shared::SnapWithin};
inline const std::vector<Shared> kAccuracy{Shared::Tolerance, Shared::Bound, Shared::Precision};
inline const std::vector<Shared> kComputing{Shared::Method,    Shared::Tolerance, Shared::Bound,
                                            Shared::Precision, Shared::Radius,    Shared::Threads};

inline const std::vector<Shared> kWalls{Shared::Mask, Shared::Region, Shared::BlockFaces, Shared::BlockEdges,
                                        Shared::BlockVertices};

// What going costs; without the last four one costs as much one way as the other.
inline const std::vector<Shared> kWeights{Shared::Weights, Shared::EdgeWeights, Shared::Cost,    Shared::Grain,
                                          Shared::Slope,   Shared::Steepest,    Shared::Tacking, Shared::Towards};
inline const std::vector<Shared> kSlopes{Shared::Slope, Shared::Steepest, Shared::Tacking, Shared::Towards};

// Binds the options, or refuses them. `arguments` must outlive the parsing.
void add_shared(Verb& verb, SharedArguments& arguments, const SharedOptions& options = {});

// Every option as it is typed, "--radius", in the order of the enumeration.
std::vector<std::string> shared_names();

// The first of these that was given; nullptr where none was.
const char* given(const SharedArguments& arguments, const std::vector<Shared>& options);

// ---- --unit

// "3.2 mm", for people; without --unit just the number.
std::string with_unit(double length, const SharedArguments& arguments);
// For JSON: null without --unit.
Record::Value unit_of(const SharedArguments& arguments);
// How long one unit of the mesh is; a millimetre where nothing is said.
double millimetres(const SharedArguments& arguments);

}  // namespace brushfire::tool
