// Marching in parts as small as a test wants them.
#pragma once

#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/fast_marching/detail/fast_marching.h>

#include <memory>
#include <span>
#include <vector>

namespace brushfire::test {

class PartSolver {
 public:
  PartSolver(Mesh mesh, Index part_size)
      : mesh_(std::move(mesh)), engine_(fast_marching::make_engine(mesh_, part_size)) {}

  // As distance() gives it, but for what lies beyond the radius.
  DistanceField distance(std::span<const Source> sources, const DistanceOptions& options,
                         std::vector<Index>* touched = nullptr) {
    DistanceField field;
    distance(sources, options, field, touched);
    return field;
  }
  void distance(std::span<const Source> sources, const DistanceOptions& options, DistanceField& field,
                std::vector<Index>* touched = nullptr) {
    sources_.clear();
    for (const Source& s : sources) {
      sources_.push_back({locate(mesh_, s.point), s.offset / mesh_.unit(), static_cast<Index>(sources_.size())});
    }
    targets_.clear();
    for (const SurfacePoint& t : options.targets) targets_.push_back(locate(mesh_, t));
    field.distance.assign(mesh_.vertex_count(), kInfinity);
    field.source.assign(mesh_.vertex_count(), kNoIndex);
    field.target_distance.assign(targets_.size(), kInfinity);
    field.target_source.assign(targets_.size(), kNoIndex);
    engine_->solve({sources_, targets_, options.max_distance / mesh_.unit(), &options, touched, {}, options.cancel},
                   field);
    for (double& d : field.distance) d *= mesh_.unit();
    for (double& d : field.target_distance) d *= mesh_.unit();
  }

 private:
  Mesh mesh_;
  std::unique_ptr<detail::Engine> engine_;
  std::vector<detail::LocatedSource> sources_;
  std::vector<PointLocation> targets_;
};

}  // namespace brushfire::test
