// EXT_meshopt_compression of glTF, where the library was built with meshoptimizer.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace brushfire::detail {

// How a buffer view is packed, in the extension's words.
struct MeshoptView {
  std::string mode;             // ATTRIBUTES, TRIANGLES, INDICES
  std::string filter = "NONE";  // OCTAHEDRAL, QUATERNION, EXPONENTIAL
  std::size_t count = 0, stride = 0;
};

bool has_meshopt();

// Unpacks into `out`, which has count * stride bytes. Returns an empty string or what is wrong.
std::string unpack_meshopt(const MeshoptView& view, std::string_view packed, std::vector<char>& out);

}  // namespace brushfire::detail
