// What a search on weights leaves behind for whoever reads values and paths off it.
#pragma once

#include <brushfire/solvers/steiner/detail/search.h>

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

// How dense points lie for it; each doubling makes them twice as dense.
Density density_for(Costs costs, double tolerance, unsigned doublings);

// Of the sources, at least one, whose offsets must be finite. Throws Error(InvalidArgument) otherwise.
double least_offset(std::span<const Source> sources);

// Puts sources and targets on run.mesh; where curves are among the sources, run.layout must be there. Throws
// Error(InvalidArgument) for no sources, an offset that is not finite and a source behind a wall.
void locate(std::span<const Source> sources, std::span<const SurfacePoint> targets, Run& run);

// The parent of a point, whether it is a vertex or between two.
Index parent_of(const Run& run, Index point);

// Which source the path to there begins at: a position in run.sources.
Index source_behind(const Run& run, Index parent);

}  // namespace brushfire::steiner
