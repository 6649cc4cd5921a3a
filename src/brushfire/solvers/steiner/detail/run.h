// What a run on weights leaves behind for paths, and what is read off it.
#pragma once

#include <brushfire/solvers/steiner/detail/search.h>
#include <brushfire/solvers/steiner/weighted_distance.h>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

namespace brushfire::steiner {

struct Run {
  std::shared_ptr<const WeightedMesh> mesh;
  std::shared_ptr<const PointLayout> layout;
  std::vector<detail::LocatedSource> sources;  // on mesh->mesh(); labels are positions in the caller's list
  double base = 0;                             // the least offset, in the caller's units: fronts start from there
  Front front;                                 // of real costs
  bool towards = false;                        // the sources are where one goes to
  std::vector<Source> given;                   // the caller's
  // The caller's targets on mesh->mesh(), one list each: a place on a wall has sides.
  std::vector<std::vector<PointLocation>> targets;
  std::vector<std::vector<ValueAt>> target_values;
};

// Throws Error(InvalidArgument) where it is out of range.
void check_tolerance(double tolerance);
// How dense points lie for it; each doubling makes them twice as dense.
Density density_for(Costs costs, double tolerance, unsigned doublings);

// Of the sources, at least one, whose offsets must be finite. Throws Error(InvalidArgument) otherwise.
double least_offset(std::span<const Source> sources);

// Puts sources and targets on run.mesh; where curves are among the sources, run.layout must be there. Throws
// Error(InvalidArgument) for no sources, an offset that is not finite and a source behind a wall.
void locate(std::span<const Source> sources, std::span<const SurfacePoint> targets, Run& run);

// Which source the path to there begins at: a position in run.sources.
Index source_behind(const Run& run, Index parent);

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

}  // namespace brushfire::steiner
