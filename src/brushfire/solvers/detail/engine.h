// What every solver implements, behind distance(): one class, made once per mesh, run many times.
#pragma once

#include <brushfire/solvers/distance.h>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

namespace brushfire::detail {

struct SheetView;

// A source after validation: where it lies, and its offset in mesh.unit().
struct LocatedSource {
  PointLocation at;
  double offset = 0;
  Index label = 0;  // position in the caller's list
  // Where set, the source is this curve, with lengths and offsets in mesh.unit(), these from `offset` on (the least of
  // them is 0); `at` is its first place.
  std::shared_ptr<const LocatedCurve> curve = nullptr;
};

// A source of the caller's, with its offset (of a curve: the least) still in the mesh's units: see Offsets. Throws what
// locate() throws for points and for curves.
LocatedSource located(const Mesh& mesh, const Source& source, Index label);

inline bool any_curve(std::span<const LocatedSource> sources) {
  return std::any_of(sources.begin(), sources.end(), [](const LocatedSource& s) { return s.curve != nullptr; });
}

// One run as an engine sees it: validated, in mesh.unit().
struct Problem {
  std::span<const LocatedSource> sources;    // not empty
  std::span<const PointLocation> targets;    // may be empty
  double max_distance = kInfinity;           // in mesh.unit()
  const DistanceOptions* options = nullptr;  // for everything else: precision, progress
  // Where set, the run must cost what it reaches: nothing may be done for all vertices. The engine appends every vertex
  // whose entry in the field it changed, once each, in any order and also when it throws; error_bound stays empty.
  // Only given to an engine that lists_touched().
  std::vector<Index>* touched = nullptr;
  // What is added to values afterwards, by source, in the mesh's units; empty: 0. For what outlives the run.
  std::span<const double> bases{};
  const CancelToken* cancel = nullptr;  // the caller's, else what the calling thread listens to
  // Where set, this is a run on a single mesh: see sheets.h.
  std::shared_ptr<const SheetView> view = nullptr;
};

// Fills `field` in mesh.unit(): distance and source of every vertex ([vertex_count], already sized, +inf and kNoIndex),
// target_distance and target_source ([targets], likewise), updates; values beyond max_distance may be left in,
// distance() removes them. Throws Error(Cancelled).
class Engine {
 public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;
  // Builds what solve() with these options would build when first called. Most engines do that in their constructor.
  virtual void set_up(const DistanceOptions& options) { static_cast<void>(options); }
  virtual void solve(const Problem& problem, DistanceField& field) = 0;
  // True where solve() honours Problem::touched; otherwise distance_sparse() looks at all vertices.
  virtual bool lists_touched() const { return false; }
};

}  // namespace brushfire::detail
