// What a run in wider numbers leaves behind for paths: as doubles, and in types that every number's room can name.
#pragma once

#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/window_field.h>
#include <brushfire/solvers/windows/paths/point_values.h>

#include <memory>
#include <vector>

namespace brushfire::windows {

// See WindowFieldData and what it holds; by the mesh's numbers.
struct PlainRun {
  struct Record {
    Index vertex = kNoIndex;  // of targets: none
    double value = kInfinity;
    Index label = kNoIndex;
    PlainRay ray;
  };
  Mesh mesh;
  const detail::Problem* problem = nullptr;
  double shift = 0, relative = 0, absolute = 0;
  bool exact = true, whole = true;                // merged nothing; went as far as there is way
  std::vector<Record> vertices;                   // those with a final value
  std::vector<Record> targets;                    // [targets]
  std::shared_ptr<const PointValues> all_points;  // where asked for
};

std::shared_ptr<const WindowField> window_field_of(const PlainRun& run);

}  // namespace brushfire::windows
