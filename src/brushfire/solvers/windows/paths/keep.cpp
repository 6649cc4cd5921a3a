// What a run in doubles leaves behind for paths.
#include <brushfire/solvers/windows/paths/record.h>
#include <brushfire/solvers/windows/paths/results.h>

#include <limits>
#include <memory>
#include <utility>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// What paths and points inside of faces need later.
void Results::keep() {
  const Mesh& mesh = run_.structure.mesh;
  auto data = std::make_shared<WindowFieldData>();
  data->mesh = mesh;
  data->sources.assign(run_.problem->sources.begin(), run_.problem->sources.end());
  data->curves = CurveIndex(mesh, data->sources);
  data->bases.assign(run_.problem->bases.begin(), run_.problem->bases.end());
  data->shift = run_.shift;
  data->relative = run_.rounding.relative;
  data->absolute = run_.rounding.absolute;
  PointRecord unknown;
  if (run_.radius < kInfinity) unknown.value = std::numeric_limits<double>::quiet_NaN();
  constexpr Index kMany =
      4;  // of as many vertices one was touched: looking for its record costs more than room for all
  if (run_.problem->touched && run_.problem->touched->size() < mesh.vertex_count() / kMany) {
    data->vertices.resize_few(mesh.vertex_count(), run_.problem->touched->size(), unknown);
  } else {
    data->vertices.resize(mesh.vertex_count(), unknown);
  }
  for (const Part& part : parts_) {
    part.vertices().for_each_touched([&](Index v) {
      if (run_.values[v].lower > run_.radius || !is_owner(v)) return;
      data->vertices.set(run_.structure.outer_vertex(v), {run_.values[v].lower, label_of(v), outer(run_.rays[v])});
    });
  }
  data->targets.assign(run_.problem->targets.begin(), run_.problem->targets.end());
  for (Index i = 0; i < run_.targets.size(); ++i) {
    const TargetState& t = run_.targets[i];
    data->target.push_back({t.lower, t.lower < kInfinity ? label_of(t.ray.pseudo_source) : kNoIndex, outer(t.ray)});
  }
  data->exact = !run_.merges();
  data->view = run_.problem->view;
  data->all_points = point_values();
  field_.windows = std::make_shared<WindowField>(std::move(data));
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
