// What it costs to cross a face or an edge: --weights, --edge-weights, --cost, --slope, --steepest and --towards.
#pragma once

#include "command_line.h"
#include "surface.h"

#include <brushfire/solvers/weighted/weighting.h>

#include <string>

namespace brushfire::tool {

// On surface.mesh(). Throws Error(InvalidArgument) where a file does not fit the mesh, for options that have no meaning
// together, and what the readers throw.
Weights weights_of(const SharedArguments& arguments, const Surface& surface);

// --tolerance, --accuracy, --bound and --radius. Throws Error(InvalidArgument) for options that have no meaning here.
WeightedOptions weighted_computation(const SharedArguments& arguments);

// What costs are computed by, as results name it.
std::string method_of(const Weighting& weighting);

// Makes costs of distances where weights were given, in surface.domain(). Throws as weighted_computation() does.
void weigh(DistanceOptions& options, const SharedArguments& arguments, const Surface& surface);

}  // namespace brushfire::tool
