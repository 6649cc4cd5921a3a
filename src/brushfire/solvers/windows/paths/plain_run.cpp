// A PlainRun as a WindowField.
#include <brushfire/solvers/windows/paths/plain_run.h>

#include <brushfire/solvers/windows/paths/record.h>

#include <limits>
#include <utility>

namespace brushfire::windows {
namespace {

PointRecord record_of(const PlainRun::Record& r) { return {r.value, r.label, ray_of(r.ray)}; }

}  // namespace

std::shared_ptr<const WindowField> window_field_of(const PlainRun& run) {
  auto data = std::make_shared<WindowFieldData>();
  data->mesh = run.mesh;
  data->sources.assign(run.problem->sources.begin(), run.problem->sources.end());
  data->curves = CurveIndex(run.mesh, data->sources);
  data->shift = run.shift;
  data->relative = run.relative;
  data->absolute = run.absolute;
  data->exact = run.exact;
  data->view = run.problem->view;
  PointRecord unknown;
  if (!run.whole) unknown.value = std::numeric_limits<double>::quiet_NaN();
  data->bases.assign(run.problem->bases.begin(), run.problem->bases.end());
  data->vertices.resize(run.mesh.vertex_count(), unknown);
  for (const PlainRun::Record& r : run.vertices) data->vertices.set(r.vertex, record_of(r));
  data->targets.assign(run.problem->targets.begin(), run.problem->targets.end());
  for (const PlainRun::Record& r : run.targets) data->target.push_back(record_of(r));
  data->all_points = run.all_points;
  return std::make_shared<WindowField>(std::move(data));
}

}  // namespace brushfire::windows
