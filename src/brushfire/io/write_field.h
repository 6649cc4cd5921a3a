// write_field(): a mesh and a scalar per vertex (a distance, say) into files that other programs open.
#pragma once

#include <brushfire/mesh/mesh.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace brushfire {

// What to write beside the mesh. Everything is [vertex_count] or empty.
struct FieldView {
  std::span<const double> values = {};  // infinity where unreachable
  std::span<const Index> labels = {};   // kNoIndex is written as -1
  std::string name = "distance";        // what the values are called where the format has names
  std::string label_name = "source";
  // Where 0, values are written as NaN (null in json) and labels as -1: outside a mask. [vertex_count] or empty.
  std::span<const std::uint8_t> mask = {};
  std::string structure = "";  // LoadedMesh::structure, which GIFTI keeps
  // Not 0: infinite only because the run ended before it got there, for json. [vertex_count] or empty.
  std::span<const std::uint8_t> not_visited = {};
};

// Throws the Error(UnknownFormat) that write_field() would: for finding out before anything is computed. Arguments as
// there.
void check_field_format(const std::string& path, const std::string& format = "");

// Writes mesh and field; the extension decides (or `format`, an extension without dot, for names that have none):
//   ply   binary little-endian: double coordinates, the values as double property `quality` (which MeshLab reads),
//         labels as int property, faces, vertex colours (viridis over the finite values, grey where there is none)
//   vtk   legacy VTK PolyData, binary, doubles     vtp  VTK XML PolyData, appended raw, doubles
//   obj   text: coordinates in full precision with vertex colours; the values themselves do not fit into OBJ
//   gii   GIFTI functional data without the mesh: float32, the format has no wider type
//   curv  FreeSurfer curvature file: float32, values only
//   npy   values as float64, or the labels as int32 where there are no values
//   csv   vertex,NAME[,LABEL_NAME]; text that reads back as the same doubles; inf
//   json  {"schema": 1, ...}; what is not finite is null, and the vertices that were not visited are listed by
//         number
// Colours of an empty mesh, a constant field or an unreachable vertex are defined too: dark, dark, grey.
//
// The file appears under its name complete or not at all; "-" is standard output and needs `format`. Throws
// Error(FileNotWritable), Error(UnknownFormat), and Error(InvalidArgument) where a size does not fit the mesh, a format
// has no place for what is given, or a mesh without positions should go into a format that needs them.
void write_field(const std::string& path, const Mesh& mesh, const FieldView& field, const std::string& format = "");

// The file's bytes in place of the file; `format` is an extension without dot.
std::vector<std::uint8_t> encode_field(const Mesh& mesh, const FieldView& field, const std::string& format);

}  // namespace brushfire
