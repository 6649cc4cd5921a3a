// Where one may not go: --mask, --region, --block-faces, --block-edges and --block-vertices.
#pragma once

#include "shared.h"

#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/domain.h>

#include <cstdint>
#include <span>
#include <vector>

namespace brushfire::tool {

struct Walls {
  Barriers barriers;
  std::vector<std::uint8_t> mask;  // [vertices of mesh] what --mask and --region leave open; empty: neither was given
};

// The walls that were asked for, in a mesh whose vertex v was vertex_map[.] of the file's; an empty map: v. Throws
// Error(InvalidArgument) where a file does not fit the mesh or a region has no vertex, and what the readers throw.
Walls walls_of(const SharedArguments& arguments, const Mesh& file, const Mesh& mesh, std::span<const Index> vertex_map);

}  // namespace brushfire::tool
