// What brought points their values: what paths are made from. Of runs in doubles; others hand over what they know as
// doubles (PlainRun).
#pragma once

#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/detail/sheets.h>
#include <brushfire/solvers/windows/detail/rays.h>

#include <memory>
#include <span>
#include <vector>

namespace brushfire::detail::BRUSHFIRE_NUMBERS {

struct PointRecord {
  Real value = kInfinity;  // mesh.unit(), offsets included
  Index label = kNoIndex;
  Ray ray;
};

struct WindowFieldData {
  Mesh mesh;
  std::vector<LocatedSource> sources;
  Real shift = 0;     // what was added to every value so that none is negative
  bool exact = true;  // no merging: rays lead back to roots
  bool all_points = false;
  std::vector<PointRecord> vertices;      // [vertex_count]; value NaN: farther than the run went
  std::vector<PointLocation> targets;     // where not all_points
  std::vector<PointRecord> target;        // [targets]
  std::vector<std::size_t> first_kept;    // [halfedge_count + 1] where all_points
  std::vector<Window> kept;               // by halfedge
  std::shared_ptr<const SheetView> view;  // where `mesh` is a single mesh (sheets.h): of the caller's

  // Sets the last two.
  void keep(std::span<const KeptWindow> windows);
};

}  // namespace brushfire::detail::BRUSHFIRE_NUMBERS
