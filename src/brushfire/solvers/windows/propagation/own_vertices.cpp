// What changes an entry.
#include <brushfire/solvers/windows/propagation/own_vertices.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

bool OwnVertices::see(Index v, Real value, const Ray& ray) {
  Real& least = run_->values[own(v)].lower;
  const bool lower = value < least;
  if (!lower && (!run_->several || value > least || label_of(ray.pseudo_source) >= run_->provenance[v].label))
    return false;
  least = value;
  run_->values[v].direct = false;
  if (run_->several) run_->provenance[v] = {ray.pseudo_source, label_of(ray.pseudo_source)};
  if (!run_->rays.empty()) run_->rays[v] = ray;
  return true;
}

void OwnVertices::receive(Index v, Real upper, Real estimate) {
  VertexValues& at = run_->values[own(v)];
  if (at.upper == kInfinity) touch(v, upper);
  at.upper = std::min(at.upper, upper);
  at.estimate = std::min(at.estimate, estimate);
}

void OwnVertices::forget() {
  for_each_touched([&](Index v) {
    run_->values[v].forget();
    run_->pseudo_sources[v] = {};
    if (!run_->provenance.empty()) run_->provenance[v] = {};
    if (!run_->rays.empty()) run_->rays[v] = {};
  });
  touched_ = 0;
  fallen_.clear();
  labels_.clear();
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
