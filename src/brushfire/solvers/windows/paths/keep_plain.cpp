// What a run in wider numbers leaves behind for paths; part of in_double_doubles.cpp.
#include <brushfire/solvers/windows/paths/plain_run.h>
#include <brushfire/solvers/windows/paths/results.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

brushfire::Vec2 plain(const Vec2& p) { return {to_double(p.x), to_double(p.y)}; }
PlainRay plain(const Ray& ray) {
  return {plain(ray.source), ray.halfedge, ray.pseudo_source, ray.kind == WindowKind::Linear};
}

}  // namespace

void Results::keep() {
  PlainRun run;
  run.mesh = run_.structure.mesh;
  run.problem = run_.problem;
  run.shift = to_double(run_.shift);
  run.relative = run_.rounding.relative;
  run.absolute = run_.rounding.absolute;
  run.exact = !run_.merges();
  run.whole = !(run_.radius < kInfinity);
  for (const Part& part : parts_) {
    part.vertices().for_each_touched([&](Index v) {
      if (run_.values[v].lower > run_.radius || !is_owner(v)) return;
      run.vertices.push_back(
          {run_.structure.outer_vertex(v), to_double(run_.values[v].lower), label_of(v), plain(outer(run_.rays[v]))});
    });
  }
  for (Index i = 0; i < run_.targets.size(); ++i) {
    const TargetState& t = run_.targets[i];
    run.targets.push_back({kNoIndex, to_double(t.lower), t.lower < kInfinity ? label_of(t.ray.pseudo_source) : kNoIndex,
                           plain(outer(t.ray))});
  }
  run.all_points = point_values();
  field_.windows = window_field_of(run);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
