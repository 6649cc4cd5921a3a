// KHR_draco_mesh_compression of glTF, where the library was built with Draco.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace brushfire::detail {

struct DracoMesh {
  std::vector<double> positions;  // three to a point
  std::vector<double> corners;    // three to a triangle
};

bool has_draco();

// Unpacks points and triangles; `position` is the unique number of the attribute that holds the former. What the stream
// promises beyond `most` points or triangles is refused before memory is taken for it. Returns an empty string or what
// is wrong.
std::string unpack_draco(std::string_view packed, std::uint32_t position, std::size_t most, DracoMesh& out);

}  // namespace brushfire::detail
