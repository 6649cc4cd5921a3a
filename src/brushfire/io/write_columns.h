// write_columns(): several numbers per vertex or per face (a log map, gradients) into files that other programs open.
#pragma once

#include <brushfire/io/formats.h>
#include <brushfire/mesh/mesh.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace brushfire {

struct Columns {
  enum class On : std::uint8_t { Vertices, Faces };
  enum class Kind : std::uint8_t {
    Numbers,
    Texture,  // the first two are coordinates in a picture: what 3D programs call UV
    Vectors,  // the first three are one vector
  };

  std::vector<std::string> names;    // of the columns
  std::span<const double> values;    // [rows][names], row by row
  std::span<const Index> rows = {};  // which vertex or face each row belongs to, ascending; empty: all of them
  On on = On::Vertices;
  Kind kind = Kind::Numbers;
  std::string name = "value";  // of the whole, where the format has names
};

// Writes the columns; the extension decides (or `format`, an extension without dot, for names that have none):
//   npy   float64, one row for each vertex or face of the mesh, NaN where there is none
//   csv   vertex,NAMES... or face,NAMES...: the rows that there are, in full precision
//   json  {"schema": 1, "vertices" or "faces": how many the mesh has, "vertex" or "face": [...], NAME: [...],
//         ...};
//         what is not finite is null
//   ply   binary: the mesh with the columns as double properties, texture coordinates as texture_u and texture_v
//   vtk   legacy PolyData, binary: the columns as scalars, vectors or texture coordinates
//   obj   text: the mesh with texture coordinates, and no other columns
// Where there are rows for some vertices only, the last three hold the part of the mesh between them: these vertices,
// with their numbers in the whole as `vertex`, and the faces all of whose corners they are. Rows for some faces only do
// not go into these formats.
//
// The file appears under its name complete or not at all; "-" is standard output and needs `format`. Throws
// Error(FileNotWritable), Error(UnknownFormat), and Error(InvalidArgument) where sizes do not fit or a format has no
// place for what is given.
void write_columns(const std::string& path, const Mesh& mesh, const Columns& columns, const std::string& format = "");

// Throws what write_columns() would for such a name and kind: for finding out before anything is computed.
void check_columns_format(const std::string& path, Columns::Kind kind, const std::string& format = "");

std::vector<FileFormat> columns_written(Columns::Kind kind);

}  // namespace brushfire
