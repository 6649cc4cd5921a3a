// glTF files of one triangle that is packed by meshoptimizer or Draco, as their programs pack it.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace brushfire::test {

// In base64: three points, the same through a filter; the corners as triangles and as indices.
namespace meshopt {
inline constexpr const char* plain =
    "oAAAATAAAACAATAAAACAAAABDAAAAP8BDAAAAIAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA=";
inline constexpr const char* filtered =
    "oAABPAAAAGAvAAE4AAAABAABDAAAAEAAATgAAAAEAAAAATgAAAAEAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAADyAAAA8gAAAPI=";
inline constexpr const char* triangles = "4PAAdodWZ3iphmWJaJgBaQAA";
inline constexpr const char* indices = "0AAEBAAAAAA=";
}  // namespace meshopt

// 61 and 70 bytes.
namespace draco {
inline constexpr const char* sequential =
    "RFJBQ08CAgEAAAABAwEAAQIBAQAJAwAAAAAAAAAAAAAAAAAAAAAAQEAAAAAAAAAAAAAAQEAAAIBAAAAAAAA==";
inline constexpr const char* edgebreaker =
    "RFJBQ08CAgEBAAAAAwEAAQAAAQf/AREB/wAAAQAJAwAAAAAAQEAAAAAAAAAAAAAAQEAAAIBAAAAAAAAAAAAAAAAAAAAAAA==";
}  // namespace draco

// Vertices and corners packed by meshoptimizer into buffer views of their own.
inline std::string packed_gltf(const char* points, const char* filter, const char* corners, const char* mode) {
  const auto buffer = [](const char* base64, std::size_t size) {
    return "{\"byteLength\":" + std::to_string(size) + ",\"uri\":\"data:;base64," + base64 + "\"}";
  };
  const auto view = [](int number, std::size_t size, std::size_t packed_size, int stride, const std::string& rest) {
    const std::string n = std::to_string(number);
    return "{\"buffer\":2,\"byteLength\":" + std::to_string(size) +
           ",\"extensions\":{\"EXT_meshopt_compression\":{\"buffer\":" + n +
           ",\"byteLength\":" + std::to_string(packed_size) + ",\"byteStride\":" + std::to_string(stride) +
           ",\"count\":3," + rest + "}}}";
  };
  const auto size_of = [](std::string_view text) {
    return text.size() / 4 * 3 - static_cast<std::size_t>(std::count(text.begin(), text.end(), '='));
  };
  return "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"EXT_meshopt_compression\"],\"nodes\":[{\"mesh\":0}"
         "],"
         "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],\"accessors\":[{"
         "\"bufferView\":0,"
         "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":5125,\"count\":3,"
         "\"type\":\"SCALAR\"}],\"bufferViews\":[" +
         view(0, 36, size_of(points), 12, "\"mode\":\"ATTRIBUTES\",\"filter\":\"" + std::string(filter) + "\"") + "," +
         view(1, 12, size_of(corners), 4, "\"mode\":\"" + std::string(mode) + "\"") + "],\"buffers\":[" +
         buffer(points, size_of(points)) + "," + buffer(corners, size_of(corners)) + ",{\"byteLength\":48}]}";
}

// Packed by Draco, with the numbers of points and triangles that the stream holds itself.
inline std::string draco_gltf(const char* base64, std::size_t size) {
  return "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],\"nodes\":[{"
         "\"mesh\":0}],"
         "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"extensions\":{"
         "\"KHR_draco_mesh_compression\":{\"bufferView\":0,\"attributes\":{\"POSITION\":0}}}}]}],\"accessors\":[{"
         "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{\"componentType\":5125,\"count\":3,\"type\":"
         "\"SCALAR\"}],"
         "\"bufferViews\":[{\"buffer\":0,\"byteLength\":" +
         std::to_string(size) + "}],\"buffers\":[{\"byteLength\":" + std::to_string(size) + ",\"uri\":\"data:;base64," +
         base64 + "\"}]}";
}

}  // namespace brushfire::test
