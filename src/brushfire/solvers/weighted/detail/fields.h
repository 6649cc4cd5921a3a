// From a search's front, or what windows know, to a WeightedField in the caller's numbers and units.
#pragma once

#include <brushfire/solvers/steiner/detail/run.h>
#include <brushfire/solvers/weighted/weighted_distance.h>

#include <algorithm>

namespace brushfire::weighted {

using steiner::Run;

// Throws Error(InvalidArgument) where it is out of range.
void check_tolerance(double tolerance);

// The upper bounds of vertices and targets, and whose they are, in the caller's numbers and units.
void fill_upper(const Run& run, double max_distance, WeightedField& field);

// WeightedField::side_distance, where there are walls: value(v) is what is known at vertex v of run.mesh, final up to
// the horizon.
template <class Value>
void fill_sides(const Run& run, double horizon, Value value, double max_distance, WeightedField& field) {
  const Domain& domain = run.mesh->domain();
  if (!domain.has_walls()) return;
  field.side_distance.assign(domain.open().vertex_count(), kInfinity);
  for (Index v = 0; v < run.mesh->mesh().vertex_count(); ++v) {
    const double at = value(v), d = at <= horizon ? run.base + at * run.mesh->mesh().unit() : kInfinity;
    double& least = field.side_distance[run.mesh->open_vertex(v)];
    if (d <= max_distance) least = std::min(least, d);
  }
}

}  // namespace brushfire::weighted
