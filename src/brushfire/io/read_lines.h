// read_lines(): curves (paths, isolines, drawn lines) from files, those of write_lines() among them.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/surface_point.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace brushfire {

struct LoadedLine {
  std::vector<Vec3> positions;       // of its points; empty where the file has none (JSON of a mesh without positions)
  std::vector<SurfacePoint> points;  // the same points on the mesh they were made on; empty where the file has none
  bool closed = false;               // the last point is joined to the first, which is not repeated
  double value = 0;                  // a path's length, an isoline's level; NaN where the file has none
};

struct LoadedLines {
  std::vector<LoadedLine> lines;  // in the order of the file
  std::string value_name;         // "length", "level"; empty where the file has none
  std::string format;             // "CSV", "JSON", "OBJ", "PLY", "VTP"
};

// Reads the file at `path`; "-" is standard input. By content, or by extension:
//   csv   columns line, x, y, z and face, w0, w1, w2 (one group at least), in any order; or as write_lines() writes
//   json  what write_lines() writes               obj   v and l (and p) records
//   ply   vertices and edge elements; edges that follow one another make a line
//   vtp   the Lines of VTK XML PolyData; the first scalar of the cells is the value
// csv and json have points on the mesh, all have positions. Throws as read_mesh() does.
LoadedLines read_lines(const std::string& path);
LoadedLines read_lines(std::span<const std::byte> content, const std::string& name);

}  // namespace brushfire
