// write_lines(): curves on a mesh (paths, isolines) into files that other programs open.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_path.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace brushfire {

struct LinesOptions {
  // Of drawings that are cut or milled, svg and dxf.
  double millimetres = 1;  // how long one unit of the mesh is
  std::string view = "";   // svg: front, back, left, right, top, bottom; "": along the shortest side of the curves
  bool outline = false;    // the mesh's boundary, and in svg its silhouette, too

  // One number for each curve, that of VALUE_NAME: an isoline's level, a path's cost. Empty: the curves' lengths.
  std::span<const double> values = {};
};

// Writes the curves; the extension decides (or `format`, an extension without dot, for names that have none):
//   json  {"schema": 1, VALUE_NAME of the first line where there is one line, "lines": [{VALUE_NAME, "closed",
//         "points": [{"face", "weights", "position"}, ...]}, ...]}; a single line's points also at the top level
//   obj   v and l records, full precision; a closed curve repeats its first vertex number
//   ply   ascii: vertices in double and edge elements
//   vtp   VTK XML PolyData with lines, ascii; VALUE_NAME as cell data, the faces as point data
//   csv   line,VALUE_NAME,point,x,y,z,face,w0,w1,w2,closed
//   svg   the curves as seen in one view, one path element each, in real size: its unit is a millimetre
//   dxf   release 12, 3D polylines in millimetres; VALUE_NAME is their layer
// read_lines() reads all but svg and dxf back.
// A mesh without positions has json only, without "position". The file appears complete or not at all; "-" is standard
// output and needs `format`. Throws Error(FileNotWritable), Error(UnknownFormat), Error(InvalidArgument).
void write_lines(const std::string& path, const Mesh& mesh, std::span<const SurfacePath> lines,
                 const std::string& value_name, const std::string& format = "", const LinesOptions& options = {});

// The file's bytes in place of the file; `format` is an extension without dot.
std::vector<std::uint8_t> encode_lines(const Mesh& mesh, std::span<const SurfacePath> lines,
                                       const std::string& value_name, const std::string& format,
                                       const LinesOptions& options = {});

// Throws the Error(UnknownFormat) or Error(InvalidArgument) that write_lines() would: for finding out before the curves
// are computed.
void check_lines_format(const std::string& path, const std::string& format = "", const LinesOptions& options = {});

}  // namespace brushfire
