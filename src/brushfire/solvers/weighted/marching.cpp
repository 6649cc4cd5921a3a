// The search's mesh, on which walls are cut, is what is marched over.
#include <brushfire/solvers/weighted/detail/marching.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/solvers/fast_marching/detail/fast_marching.h>
#include <brushfire/solvers/weighted/detail/fields.h>

#include <algorithm>
#include <string>
#include <vector>

namespace brushfire::weighted {

using steiner::WeightedMesh;

std::unique_ptr<detail::Engine> make_march(const WeightedMesh& mesh, const Weights& weights) {
  if (!weights.edges.empty() || !weights.is_isotropic()) {
    throw Error(ErrorCode::InvalidArgument,
                "marching takes weights of faces only: roads, fences, slopes and grain are for the search over points "
                "on edges");
  }
  std::vector<double> of_faces(mesh.mesh().face_count());
  for (Index f = 0; f < of_faces.size(); ++f) of_faces[f] = mesh.face_weight(f);
  return fast_marching::make_weighted_engine(mesh.mesh(), of_faces);
}

WeightedField march(const std::shared_ptr<const WeightedMesh>& mesh, detail::Engine& engine,
                    std::span<const Source> sources, const WeightedOptions& options) {
  const Method method = *options.marching;
  if (method != Method::NovotniKlein && method != Method::KimmelSethian) {
    throw Error(ErrorCode::InvalidArgument,
                "weights are marched over by novotni-klein or kimmel-sethian, not by " + std::string(name_of(method)));
  }
  if (std::any_of(sources.begin(), sources.end(), [](const Source& s) { return s.curve != nullptr; })) {
    throw Error(ErrorCode::InvalidArgument, "marching with weights starts at points, not at curves");
  }
  Run run;
  run.mesh = mesh;
  steiner::locate(sources, options.targets, run);
  std::vector<PointLocation> places;
  for (const auto& sides : run.targets) places.insert(places.end(), sides.begin(), sides.end());
  const double unit = mesh->mesh().unit();
  DistanceOptions how;
  how.method = method;
  how.progress = options.progress;
  DistanceField found;
  const Index count = mesh->mesh().vertex_count();
  found.distance.assign(count, kInfinity);
  found.source.assign(count, kNoIndex);
  found.target_distance.assign(places.size(), kInfinity);
  found.target_source.assign(places.size(), kNoIndex);
  engine.solve({.sources = run.sources,
                .targets = places,
                .max_distance = (options.max_distance - run.base) / unit,
                .options = &how,
                .cancel = current_cancel_token()},
               found);

  WeightedField field;
  field.engine = WeightedEngine::Marching;
  const auto value = [&](double v) {
    const double d = run.base + v * unit;
    return d <= options.max_distance ? d : kInfinity;
  };
  const auto take = [&](double v, Index label, double& least, Index& source) {
    const double d = value(v);
    if (!(d < least)) return;
    least = d;
    source = label;
  };
  field.distance.assign(mesh->domain().mesh().vertex_count(), kInfinity);
  field.source.assign(field.distance.size(), kNoIndex);
  for (Index v = 0; v < count; ++v) {
    take(found.distance[v], found.source[v], field.distance[mesh->vertex(v)], field.source[mesh->vertex(v)]);
  }
  fill_sides(run, kInfinity, [&](Index v) { return found.distance[v]; }, options.max_distance, field);
  std::size_t place = 0;
  for (const auto& sides : run.targets) {
    double& d = field.target_distance.emplace_back(kInfinity);
    Index& source = field.target_source.emplace_back(kNoIndex);
    for (std::size_t i = 0; i < sides.size(); ++i, ++place) {
      take(found.target_distance[place], found.target_source[place], d, source);
    }
  }
  field.reached = static_cast<Index>(
      std::count_if(field.distance.begin(), field.distance.end(), [](double d) { return d < kInfinity; }));
  return field;
}

}  // namespace brushfire::weighted
