// What all engines share after a run: the radius, units, offsets, counts.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/detail/offsets.h>
#include <brushfire/solvers/distance.h>

#include <span>
#include <vector>

namespace brushfire::detail {

// Applies the radius, goes back to the mesh's units, counts.
void finish(const Mesh& mesh, std::span<const PointLocation> targets, const Offsets& offsets,
            const DistanceOptions& options, DistanceField& field);

// The touched vertices within the radius, ascending, in the mesh's units. `touched` is sorted on the way.
void collect(double unit, std::span<const PointLocation> targets, const Offsets& offsets,
             const DistanceOptions& options, DistanceField& field, std::vector<Index>& touched, SparseField& result);

}  // namespace brushfire::detail
