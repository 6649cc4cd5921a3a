// read_field(): one number per vertex (scalars, labels, masks) from the files that have them.
#pragma once

#include <brushfire/core/types.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace brushfire {

// Values in the order of the file's vertices. Labels and masks are numbers too: masks 0 and 1, labels their keys.
struct LoadedField {
  std::vector<double> values;

  // vertices[values.size()]: which vertex each value belongs to, where the file lists vertices (FreeSurfer .label, CSV
  // with a column `vertex`); empty where values[v] is that of vertex v.
  std::vector<Index> vertices;

  // Vertices whose value is infinite only because the run that wrote it ended before it came there; a way may lead to
  // them. The others are out of reach. Ascending; empty where a file does not say (only write_field()'s json does).
  std::vector<Index> not_visited;

  struct Label {
    std::int64_t key;
    std::string name;
  };
  std::vector<Label> label_names;  // of the table in GIFTI label and FreeSurfer annot files

  std::string name;    // of the array or column, where there is one
  std::string format;  // "NPY", "text", "CSV", "GIFTI", ...
};

// Reads the file at `path`; "-" is standard input. By content, or by extension:
//   .npy                a vector (or one column)
//   .csv .tsv           a header line of names, or none; separated by comma, semicolon or tab
//   .txt .dat .asc .1D  numbers separated by space; # starts a comment
//   .json               the object that write_field() writes; null reads as infinity, not_visited as that
//   .gii                GIFTI shape, func or label
//   .curv .annot .label FreeSurfer; also by the names lh.thickness, rh.sulc, lh.aparc.annot, ...
//   .ply .vtk .vtp      a scalar that stands on the vertices of a mesh
// `name` chooses among several arrays or columns; without it the first is taken (in PLY `quality`, if it is there).
// Infinity and NaN are values here. Throws as read_mesh() does.
LoadedField read_field(const std::string& path, const std::string& name = "");
LoadedField read_field(std::span<const std::byte> content, const std::string& file_name, const std::string& name = "");

// The field as one value per vertex: `otherwise` where the file had none. Throws Error(InvalidArgument) where the
// number of values is not `vertex_count`, and Error(IndexOutOfRange) where a listed vertex does not exist.
std::vector<double> values_on_vertices(const LoadedField& field, Index vertex_count, double otherwise = 0);

}  // namespace brushfire
