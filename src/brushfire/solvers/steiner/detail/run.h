// What a run on weights leaves behind for paths.
#pragma once

#include <brushfire/solvers/steiner/detail/search.h>

#include <memory>
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

// Which source the path to there begins at: a position in run.sources.
Index source_behind(const Run& run, Index parent);

}  // namespace brushfire::steiner
