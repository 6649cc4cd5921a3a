// glTF 2.0 (.gltf, .glb): the triangles of the default scene, node transforms applied, all primitives in one mesh.
//
// glTF stores coordinates as 32-bit floats or smaller. Exporters split vertices along creases of normals and texture;
// as everywhere but in STL, nothing is welded.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/draco.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/gltf_file.h>
#include <brushfire/io/detail/meshopt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

namespace brushfire::detail {

namespace {

using Matrix = std::array<double, 16>;  // column by column, as in the file
constexpr Matrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix m{};
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t r = 0; r < 4; ++r) {
      for (std::size_t k = 0; k < 4; ++k) m[4 * c + r] += a[4 * k + r] * b[4 * c + k];
    }
  }
  return m;
}

Vec3 apply(const Matrix& m, const Vec3& p) {
  return {m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12], m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
          m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]};
}

class GltfReader {
 public:
  explicit GltfReader(const Input& input) : name_(input.name()), file_(input), json_(file_.json()) {}

  MeshParts read() {
    try {
      return read_scene();
    } catch (const Json::exception& e) {  // a value of another type than the format says
      file_.fail(std::string("not as glTF says: ") + printable(e.what()));
    }
  }

 private:
  MeshParts read_scene() {
    parts_.places_are_lines = false;
    if (!json_.is_object()) file_.fail("not as glTF says: no object at the top");
    check_version();
    check_extensions();
    const std::size_t nodes = json_.contains("nodes") ? json_.at("nodes").size() : 0;
    visited_.assign(nodes, false);
    if (json_.contains("scenes")) {
      const Json& scene = file_.item("scenes", file_.number(json_, "scene").value_or(0));
      if (scene.contains("nodes")) {
        for (const Json& node : scene.at("nodes")) add_tree(node_number(node));
      }
    } else {
      add_roots(nodes);
    }
    if (left_out_ != 0)
      parts_.remarks.push_back(counted(left_out_, "primitive of points or lines", "primitives of points or lines") +
                               " left out");
    if (primitives_ > 1)
      parts_.remarks.push_back(std::to_string(primitives_) + " primitives merged, their vertices one after the other");
    parts_.remarks.emplace_back("glTF stores coordinates as 32-bit floats");
    return std::move(parts_);
  }

  // glTF 1.0 is another format under the same names.
  void check_version() const {
    const auto asset = json_.find("asset");
    if (asset == json_.end() || !asset->is_object() || !asset->contains("version")) return;
    const auto version = asset->at("version").get<std::string>();
    if (version.substr(0, 2) != "2.") file_.fail("glTF " + printable(version) + " is not read, only 2.0");
  }

  // What a file requires must be known: it may change the shape. These change its looks only, or the types of numbers
  // that are read anyway.
  void check_extensions() {
    static constexpr std::string_view kHarmless[]{
        "KHR_mesh_quantization", "KHR_texture_transform",  "KHR_texture_basisu",
        "KHR_lights_punctual",   "KHR_xmp_json_ld",        "KHR_xmp",
        "EXT_texture_webp",      "EXT_texture_avif",       "MSFT_texture_dds",
        "KHR_animation_pointer", "EXT_lights_image_based", "EXT_lights_ies"};
    const auto is_harmless = [](std::string_view name) {
      return name.substr(0, 14) == "KHR_materials_" || (name == "EXT_meshopt_compression" && has_meshopt()) ||
             (name == "KHR_draco_mesh_compression" && has_draco()) ||
             std::find(std::begin(kHarmless), std::end(kHarmless), name) != std::end(kHarmless);
    };
    if (json_.contains("extensionsRequired")) {
      for (const Json& e : json_.at("extensionsRequired")) {
        const auto name = e.get<std::string>();
        if (!is_harmless(name)) file_.fail("requires the extension " + quote(name) + ", which is not read");
      }
    }
    // What is used without being required may be left out, as the format says; instances are worth a word.
    if (!json_.contains("extensionsUsed")) return;
    for (const Json& e : json_.at("extensionsUsed")) {
      if (e.get<std::string>() == "EXT_mesh_gpu_instancing") parts_.remarks.emplace_back("instances left out");
    }
  }

  std::size_t node_number(const Json& node) const {
    if (!node.is_number_unsigned() || node.get<std::size_t>() >= visited_.size())
      file_.fail("a node that does not exist is named");
    return node.get<std::size_t>();
  }

  // Without scenes: every node that is no one's child.
  void add_roots(std::size_t nodes) {
    std::vector<bool> is_child(nodes, false);
    for (std::size_t n = 0; n < nodes; ++n) {
      const Json& node = file_.item("nodes", n);
      if (!node.contains("children")) continue;
      for (const Json& child : node.at("children")) is_child[node_number(child)] = true;
    }
    for (std::size_t n = 0; n < nodes; ++n) {
      if (!is_child[n]) add_tree(n);
    }
    if (nodes == 0 && json_.contains("meshes")) {
      for (std::size_t m = 0; m < json_.at("meshes").size(); ++m) add_mesh(m, kIdentity);
    }
  }

  // Depth first in the file's order, on a stack of its own: trees may be deep.
  void add_tree(std::size_t root) {
    struct Entry {
      std::size_t node;
      Matrix transform;
    };
    std::vector<Entry> stack{{root, kIdentity}};
    while (!stack.empty()) {
      const Entry entry = stack.back();
      stack.pop_back();
      if (visited_[entry.node])
        file_.fail("node " + std::to_string(entry.node) + " is reached twice: the nodes are no tree");
      visited_[entry.node] = true;
      const Json& node = file_.item("nodes", entry.node);
      const Matrix transform = product(entry.transform, local_transform(node));
      if (const std::optional<std::size_t> mesh = file_.number(node, "mesh")) add_mesh(*mesh, transform);
      if (!node.contains("children")) continue;
      const Json& children = node.at("children");
      if (!children.is_array()) file_.fail("children is no list");
      for (std::size_t k = children.size(); k-- > 0;) stack.push_back({node_number(children[k]), transform});
    }
  }

  template <std::size_t N>
  std::array<double, N> numbers(const Json& object, const char* key, const std::array<double, N>& otherwise) const {
    if (!object.contains(key)) return otherwise;
    const Json& list = object.at(key);
    if (!list.is_array() || list.size() != N)
      file_.fail(std::string(key) + " does not have " + std::to_string(N) + " numbers");
    std::array<double, N> values;
    for (std::size_t k = 0; k < N; ++k) values[k] = list[k].template get<double>();
    return values;
  }

  Matrix local_transform(const Json& node) const {
    if (node.contains("matrix")) return numbers<16>(node, "matrix", kIdentity);
    const auto t = numbers<3>(node, "translation", {0, 0, 0});
    const auto q = numbers<4>(node, "rotation", {0, 0, 0, 1});  // x y z w
    const auto s = numbers<3>(node, "scale", {1, 1, 1});
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    return {s[0] * (1 - 2 * (y * y + z * z)),
            s[0] * 2 * (x * y + z * w),
            s[0] * 2 * (x * z - y * w),
            0,
            s[1] * 2 * (x * y - z * w),
            s[1] * (1 - 2 * (x * x + z * z)),
            s[1] * 2 * (y * z + x * w),
            0,
            s[2] * 2 * (x * z + y * w),
            s[2] * 2 * (y * z - x * w),
            s[2] * (1 - 2 * (x * x + y * y)),
            0,
            t[0],
            t[1],
            t[2],
            1};
  }

  void add_mesh(std::size_t number_of_mesh, const Matrix& transform) {
    const Json& mesh = file_.item("meshes", number_of_mesh);
    for (const Json& primitive : mesh.at("primitives")) add_primitive(primitive, transform);
  }

  DracoMesh from_accessors(const Json& primitive) {
    DracoMesh data;
    data.positions = file_.accessor(file_.needed(primitive.at("attributes"), "POSITION"), 3);
    if (const std::optional<std::size_t> indices = file_.number(primitive, "indices")) {
      data.corners = file_.accessor(*indices, 1);
    } else {
      data.corners.resize(data.positions.size() / 3);
      std::iota(data.corners.begin(), data.corners.end(), 0.0);
    }
    return data;
  }

  DracoMesh unpacked(const Json& extension) {
    DracoMesh data;
    const std::size_t position = file_.needed(extension.at("attributes"), "POSITION");
    const std::string_view packed = file_.range_of(file_.item("bufferViews", file_.needed(extension, "bufferView")));
    constexpr std::size_t kEach = 6 * sizeof(double);  // three coordinates, three corners
    const std::string error = unpack_draco(packed, static_cast<std::uint32_t>(position), file_.budget() / kEach, data);
    if (!error.empty()) file_.fail("a primitive packed by Draco " + error);
    file_.spend((data.positions.size() + data.corners.size()) * sizeof(double));
    return data;
  }

  void add_primitive(const Json& primitive, const Matrix& transform) {
    constexpr std::size_t kTriangles = 4, kStrip = 5, kFan = 6;
    const std::size_t mode = file_.number(primitive, "mode").value_or(kTriangles);
    if (mode > kFan) file_.fail("mode " + std::to_string(mode) + " does not exist");
    if (mode < kTriangles) {
      ++left_out_;
      return;
    }
    ++primitives_;
    const bool is_packed =
        primitive.contains("extensions") && primitive.at("extensions").contains("KHR_draco_mesh_compression");
    const DracoMesh data =
        is_packed ? unpacked(primitive.at("extensions").at("KHR_draco_mesh_compression")) : from_accessors(primitive);
    const std::vector<double>&xyz = data.positions, &corners = data.corners;
    const auto first = parts_.positions.size();
    const std::size_t count = xyz.size() / 3;
    if (first + count >= kNoIndex) throw Error(ErrorCode::TooLarge, printable(name_) + ": more than 2^32 vertices");
    for (std::size_t v = 0; v < count; ++v) {
      const Vec3 p = apply(transform, {xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]});
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        file_.fail("vertex " + std::to_string(first + v) + " has a coordinate that is not finite");
      }
      parts_.positions.push_back(p);
    }
    for (const double v : corners) {
      if (!(v >= 0) || v >= static_cast<double>(count) || v != std::floor(v)) {
        file_.fail("a primitive names vertex " + std::to_string(static_cast<std::int64_t>(v)) + ", but has " +
                   std::to_string(count));
      }
    }
    const auto corner = [&](std::size_t k) { return static_cast<Index>(first + static_cast<std::size_t>(corners[k])); };
    if (mode == kTriangles || is_packed) {
      for (std::size_t k = 0; k + 2 < corners.size(); k += 3)
        parts_.faces.add_triangle(corner(k), corner(k + 1), corner(k + 2), 0);
      return;
    }
    for (std::size_t k = 2; k < corners.size(); ++k) {
      const bool turned = mode == kStrip && k % 2 != 0;
      const Index a = mode == kFan ? corner(0) : corner(k - 2), b = corner(k - 1), c = corner(k);
      if (a == b || b == c || c == a) continue;
      parts_.faces.add_triangle(turned ? b : a, turned ? a : b, c, 0);
    }
  }

  std::string name_;
  GltfFile file_;
  const Json& json_;
  MeshParts parts_;
  std::vector<bool> visited_;
  std::size_t primitives_ = 0, left_out_ = 0;
};

}  // namespace

bool is_gltf(std::string_view bytes) { return bytes.substr(0, 4) == "glTF"; }

MeshParts read_gltf(const Input& input) { return GltfReader(input).read(); }

}  // namespace brushfire::detail
