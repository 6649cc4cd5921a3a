// What it costs to cross a face or an edge: --weights and --edge-weights.
#pragma once

#include "command_line.h"
#include "surface.h"

#include <brushfire/solvers/steiner/weighted_distance.h>

#include <optional>
#include <string>

namespace brushfire::tool {

struct WeightArguments {
  std::string faces_file, edges_file, slope;
  std::optional<double> steepest;
  bool towards = false;
  bool given() const { return !faces_file.empty() || !edges_file.empty() || !slope.empty(); }
};

void add_weights(Verb& verb, WeightArguments& arguments);

// On surface.mesh(). Throws Error(InvalidArgument) where a file does not fit the mesh, and what the readers throw.
Weights weights_of(const WeightArguments& arguments, const Surface& surface);

// --tolerance, --accuracy, --bound and --radius. Throws Error(InvalidArgument) for options that have no meaning here.
WeightedOptions weighted_computation(const SharedArguments& arguments, const WeightArguments& weights);

}  // namespace brushfire::tool
