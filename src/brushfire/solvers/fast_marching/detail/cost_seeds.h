// Where fronts start and are read where faces cost different things: within the faces that hold a point.
#pragma once

#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/detail/start.h>
#include <brushfire/solvers/fast_marching/detail/face_costs.h>

#include <span>
#include <vector>

namespace brushfire::fast_marching {

// In memory that it keeps: what it returns lasts until the next call.
class CostSeeds {
 public:
  // The corners of all faces that hold the point, and what it costs to get there straight within one of these.
  std::span<const detail::Seed> around(const Mesh& mesh, const FaceCosts& costs, const PointLocation& at);

 private:
  detail::SeedSearch search_;
  std::vector<double> weight_;
  std::vector<detail::Seed> seeds_;
};

// From a to b straight within a face that holds both; +inf where there is none.
double straight_cost(const Mesh& mesh, const FaceCosts& costs, const PointLocation& a, const PointLocation& b);

}  // namespace brushfire::fast_marching
