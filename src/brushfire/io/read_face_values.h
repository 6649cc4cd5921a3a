// read_face_values(): one number per face from the files of meshes that have them.
#pragma once

#include <string>
#include <vector>

namespace brushfire {

// The scalar `name` on the faces of a PLY (a property of its faces), legacy VTK (SCALARS or an array of a FIELD behind
// CELL_DATA) or VTK XML file (CellData), in the order of the file's faces (cells). Throws as read_field() does, and
// Error(UnknownFormat) for other files, which have none.
std::vector<double> read_face_values(const std::string& path, const std::string& name);

}  // namespace brushfire
