// A run of an engine itself, past distance(): for engines made in ways that distance() does not make them.
#pragma once

#include <brushfire/solvers/detail/engine.h>

#include <vector>

namespace brushfire::test {

// The field in mesh.unit(); radius and counts of distance() are not applied.
inline DistanceField run(detail::Engine& engine, const Mesh& mesh, const std::vector<Source>& sources,
                         const DistanceOptions& options, std::vector<Index>* touched = nullptr) {
  std::vector<detail::LocatedSource> located;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    located.push_back(detail::located(mesh, sources[i], static_cast<Index>(i)));
    located.back().offset /= mesh.unit();
  }
  std::vector<PointLocation> targets;
  for (const SurfacePoint& t : options.targets) targets.push_back(locate(mesh, t));
  DistanceField field;
  field.distance.assign(mesh.vertex_count(), kInfinity);
  field.source.assign(mesh.vertex_count(), kNoIndex);
  field.target_distance.assign(targets.size(), kInfinity);
  field.target_source.assign(targets.size(), kNoIndex);
  engine.solve({located, targets, options.max_distance / mesh.unit(), &options, touched, {}, options.cancel}, field);
  return field;
}

}  // namespace brushfire::test
