// Where one may not go: --mask, --region, --block-faces, --block-edges and --block-vertices.
#pragma once

#include "shared.h"

#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/domain.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace brushfire::tool {

struct Walls {
  Barriers barriers;
  std::vector<std::uint8_t> mask;  // [vertices of mesh] what --mask and --region leave open; empty: neither was given
};

// The walls that were asked for, in a mesh whose vertex v was vertex_map[.] of the file's; an empty map: v. Throws
// Error(InvalidArgument) where a file does not fit the mesh or a region has no vertex, and what the readers throw.
Walls walls_of(const SharedArguments& arguments, const Mesh& file, const Mesh& mesh, std::span<const Index> vertex_map);

// Pairs of vertices of a mesh of `count`: one pair to a line, or (k, 2) in .npy. Throws Error(InvalidArgument) for
// what is none, and what the readers throw.
std::vector<std::array<Index, 2>> vertex_pairs(const std::string& file, Index count);

}  // namespace brushfire::tool
