// What the parts of a mesh share in a run.
#pragma once

#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/windows/algebra/rays.h>
#include <brushfire/solvers/windows/propagation/certified_value.h>
#include <brushfire/solvers/windows/propagation/structure.h>
#include <brushfire/solvers/windows/propagation/targets.h>
#include <brushfire/solvers/windows/propagation/vertex_entries.h>

#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// The vertices that a run touches are listed up to one in as many.
inline constexpr Index kFewTouched = 4;

// While parts are at work, each writes only to entries of its own vertices and faces and reads no other part's entries
// of the arrays by vertex; everything else stands still.
struct RunState {
  RunState(const Mesh& mesh, unsigned part_bits)
      : structure(mesh, part_bits), rounding(rounding_of(structure.unevenness)) {}

  WindowStructure structure;
  std::vector<VertexValues> values;          // [vertex_count]
  std::vector<PseudoSource> pseudo_sources;  // [vertex_count]
  std::vector<Provenance> provenance;        // [vertex_count] in runs with several sources
  std::vector<Ray> rays;       // [vertex_count] in runs that keep them: what brought every vertex its least value
  std::vector<Index> touched;  // of each part, from its first vertex' number / kFewTouched on: see OwnVertices
  Targets targets;

  const detail::Problem* problem = nullptr;
  MergeBudget budget;
  Rounding rounding;
  bool several = false;     // sources
  bool in_lists = false;    // windows travel in lists
  double bucket_width = 1;  // of the queues
  Real shift = 0;           // added to all values, so that none is negative
  Real radius = kInfinity;  // nothing beyond is wanted

  bool merges() const { return budget.share > 0; }
  bool keeps_rays() const { return problem->options->keep_paths || problem->options->keep_windows; }
  // The value with which paths from a source start.
  Real start_of(Index label) const { return problem->sources[label].offset + shift; }
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
