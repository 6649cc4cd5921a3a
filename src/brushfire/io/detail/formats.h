// The readers, one per format: each turns bytes into MeshParts or throws Error(FileMalformed).
#pragma once

#include <brushfire/io/detail/input.h>
#include <brushfire/io/detail/mesh_parts.h>

namespace brushfire::detail {

MeshParts read_obj(const Input& input);
MeshParts read_off(const Input& input);
MeshParts read_ply(const Input& input);

}  // namespace brushfire::detail
