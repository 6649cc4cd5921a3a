// Sources and targets on the search's mesh, and its front in the caller's numbers.
#include <brushfire/solvers/steiner/detail/run.h>

#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>
#include <brushfire/solvers/steiner/detail/curve_points.h>

#include <cmath>
#include <string>

namespace brushfire::steiner {

Index parent_of(const Run& run, Index point) {
  const Index edge = run.layout->edge_of(point), i = point - run.layout->row(edge);
  const Index h = run.mesh->edges().halfedge(edge);
  if (i == 0) return run.front.vertex_parent[run.mesh->mesh().from(h)];
  if (i + 1 == run.layout->count(edge)) return run.front.vertex_parent[run.mesh->mesh().to(h)];
  return run.front.parent[point];
}

// Measured (docs/weights.md): so dense, upper bounds are off by about half of the tolerance on average and by all of it
// at most, and lower ones by the tolerance on average.
Density density_for(Costs costs, double tolerance, unsigned doublings) {
  const double finer = std::ldexp(1.0, -static_cast<int>(doublings)), root = std::sqrt(tolerance) * finer;
  const auto most = static_cast<Index>(std::min(4096.0, 64 / finer));
  if (costs == Costs::Real) return {3 * root, std::min(0.25, 8 * tolerance * finer), most};
  return {2.1 * root / (1 + root), std::min(0.25, 0.7 * tolerance * finer), 4 * most};
}

double least_offset(std::span<const Source> sources) {
  if (sources.empty()) throw Error(ErrorCode::InvalidArgument, "no source given: a distance needs at least one");
  double least = kInfinity;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (!std::isfinite(sources[i].offset)) {
      throw Error(ErrorCode::InvalidArgument,
                  "offset " + number_as_text(sources[i].offset) + " of source " + std::to_string(i) + " is not finite");
    }
    least = std::min(least, brushfire::least_offset(sources[i]));
  }
  return least;
}

void locate(std::span<const Source> sources, std::span<const SurfacePoint> targets, Run& run) {
  const WeightedMesh& mesh = *run.mesh;
  run.base = least_offset(sources);
  run.given.assign(sources.begin(), sources.end());
  const double unit = mesh.mesh().unit();
  std::vector<std::uint8_t> is_open(sources.size(), 0);
  for (const PointSource& s : with_points_of_curves(mesh, run.layout.get(), sources)) {
    for (const SurfacePoint& p : mesh.on_open(s.point)) {
      is_open[s.label] = 1;
      run.sources.push_back({brushfire::locate(mesh.mesh(), p), (s.offset - run.base) / unit, s.label, nullptr});
    }
  }
  if (const auto closed = std::find(is_open.begin(), is_open.end(), 0); closed != is_open.end()) {
    throw Error(ErrorCode::InvalidArgument, "source " + std::to_string(closed - is_open.begin()) +
                                                " lies behind a wall: nothing can be reached from there");
  }
  for (const SurfacePoint& t : targets) {
    std::vector<PointLocation>& sides = run.targets.emplace_back();
    for (const SurfacePoint& p : mesh.on_open(t)) sides.push_back(brushfire::locate(mesh.mesh(), p));
  }
}

Index source_behind(const Run& run, Index parent) {
  while (parent < kFromSource) parent = parent_of(run, parent);
  return parent == kNoIndex ? kNoIndex : parent - kFromSource;
}

}  // namespace brushfire::steiner
