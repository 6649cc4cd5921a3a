// What a run in wider numbers leaves behind for paths: as doubles, and in types that every number's room can name.
#pragma once

#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/window_field.h>

#include <memory>
#include <vector>

namespace brushfire::windows {

// See WindowFieldData and what it holds; by the mesh's numbers.
struct PlainRun {
  struct Ray {
    brushfire::Vec2 source;
    Index halfedge = kNoIndex, root = kNoIndex;
  };
  struct Record {
    Index vertex = kNoIndex;  // of targets: none
    double value = kInfinity;
    Index label = kNoIndex;
    Ray ray;
  };
  struct Window {
    Index halfedge = kNoIndex, root = kNoIndex;
    brushfire::Vec2 source;
    double b0 = 0, b1 = 0, sigma = 0, d0 = 0, d1 = 0, slack = 0;
  };

  Mesh mesh;
  const detail::Problem* problem = nullptr;
  double shift = 0;
  bool exact = true, whole = true;  // merged nothing; went as far as there is way
  std::vector<Record> vertices;     // those with a final value
  std::vector<Record> targets;      // [targets]
  std::vector<Window> windows;      // where asked for
};

std::shared_ptr<const WindowField> window_field_of(const PlainRun& run);

}  // namespace brushfire::windows
