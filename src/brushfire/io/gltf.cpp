// glTF 2.0 (.gltf, .glb): the triangles of the default scene, node transforms applied, all primitives in one mesh.
//
// glTF stores coordinates as 32-bit floats or smaller. Exporters split vertices along creases of normals and texture;
// as everywhere but in STL, nothing is welded.
#include <brushfire/core/detail/base64.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/draco.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/json.h>
#include <brushfire/io/detail/meshopt.h>
#include <brushfire/io/detail/numbers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
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

struct Chunks {
  std::string_view json, binary;
  std::size_t json_begin = 0;
};

Chunks split_glb(const Input& input) {
  const std::string_view bytes = input.bytes();
  if (bytes.substr(0, 4) != "glTF") return {bytes, {}, 0};
  const auto word = [&](std::size_t at) { return load<std::uint32_t>(bytes.data() + at, std::endian::little); };
  constexpr std::uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942;
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  if (bytes.size() < kHeader + kChunkHeader) input.fail_byte(bytes.size(), "the file ends within the GLB header");
  if (word(4) != 2) input.fail_byte(4, "version " + std::to_string(word(4)) + " of GLB is not read, only 2");
  Chunks chunks;
  for (std::size_t at = kHeader; at + kChunkHeader <= bytes.size();) {
    const std::uint32_t size = word(at), type = word(at + 4);
    if (size > bytes.size() - at - kChunkHeader)
      input.fail_byte(at, "a chunk of " + std::to_string(size) + " bytes reaches beyond the end of the file");
    const std::string_view content = bytes.substr(at + kChunkHeader, size);
    if (type == kJson && chunks.json.empty()) {
      chunks.json = content;
      chunks.json_begin = at + kChunkHeader;
    }
    if (type == kBinary && chunks.binary.empty()) chunks.binary = content;
    at += kChunkHeader + size;
  }
  if (chunks.json.empty()) input.fail_byte(kHeader, "has no JSON chunk");
  return chunks;
}

class GltfReader {
 public:
  explicit GltfReader(const Input& input)
      : input_(&input),
        chunks_(split_glb(input)),
        json_(parse_json(input, chunks_.json, chunks_.json_begin)),
        budget_(input.inflate_budget()) {}

  MeshParts read() {
    try {
      return read_scene();
    } catch (const Json::exception& e) {  // a value of another type than the format says
      fail(std::string("not as glTF says: ") + printable(e.what()));
    }
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const { input_->fail(cause); }

  // The element `index` of the top-level list `list`.
  const Json& item(const char* list, std::size_t index) const {
    const auto found = json_.find(list);
    if (found == json_.end() || !found->is_array() || index >= found->size()) {
      fail(std::string("there is no ") + list + "[" + std::to_string(index) + "]");
    }
    return (*found)[index];
  }

  // A whole number >= 0 in `object`.
  static std::optional<std::size_t> number(const Json& object, const char* key, const Input& input) {
    const auto found = object.find(key);
    if (found == object.end()) return std::nullopt;
    if (!found->is_number_unsigned())
      input.fail(std::string(key) + " is " +
                 quote(found->dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 60)) +
                 ", not a whole number");
    return found->get<std::size_t>();
  }
  std::optional<std::size_t> number(const Json& object, const char* key) const { return number(object, key, *input_); }
  std::size_t needed(const Json& object, const char* key) const {
    const std::optional<std::size_t> n = number(object, key);
    if (!n) fail(std::string(key) + " is missing");
    return *n;
  }

  MeshParts read_scene() {
    parts_.places_are_lines = false;
    if (!json_.is_object()) fail("not as glTF says: no object at the top");
    check_version();
    check_extensions();
    const std::size_t nodes = json_.contains("nodes") ? json_.at("nodes").size() : 0;
    visited_.assign(nodes, false);
    if (json_.contains("scenes")) {
      const Json& scene = item("scenes", number(json_, "scene").value_or(0));
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
    if (version.substr(0, 2) != "2.") fail("glTF " + printable(version) + " is not read, only 2.0");
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
        if (!is_harmless(name)) fail("requires the extension " + quote(name) + ", which is not read");
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
      fail("a node that does not exist is named");
    return node.get<std::size_t>();
  }

  // Without scenes: every node that is no one's child.
  void add_roots(std::size_t nodes) {
    std::vector<bool> is_child(nodes, false);
    for (std::size_t n = 0; n < nodes; ++n) {
      const Json& node = item("nodes", n);
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
      if (visited_[entry.node]) fail("node " + std::to_string(entry.node) + " is reached twice: the nodes are no tree");
      visited_[entry.node] = true;
      const Json& node = item("nodes", entry.node);
      const Matrix transform = product(entry.transform, local_transform(node));
      if (const std::optional<std::size_t> mesh = number(node, "mesh")) add_mesh(*mesh, transform);
      if (!node.contains("children")) continue;
      const Json& children = node.at("children");
      if (!children.is_array()) fail("children is no list");
      for (std::size_t k = children.size(); k-- > 0;) stack.push_back({node_number(children[k]), transform});
    }
  }

  template <std::size_t N>
  std::array<double, N> numbers(const Json& object, const char* key, const std::array<double, N>& otherwise) const {
    if (!object.contains(key)) return otherwise;
    const Json& list = object.at(key);
    if (!list.is_array() || list.size() != N)
      fail(std::string(key) + " does not have " + std::to_string(N) + " numbers");
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
    const Json& mesh = item("meshes", number_of_mesh);
    for (const Json& primitive : mesh.at("primitives")) add_primitive(primitive, transform);
  }

  DracoMesh from_accessors(const Json& primitive) {
    DracoMesh data;
    data.positions = accessor(needed(primitive.at("attributes"), "POSITION"), 3);
    if (const std::optional<std::size_t> indices = number(primitive, "indices")) {
      data.corners = accessor(*indices, 1);
    } else {
      data.corners.resize(data.positions.size() / 3);
      std::iota(data.corners.begin(), data.corners.end(), 0.0);
    }
    return data;
  }

  DracoMesh unpacked(const Json& extension) {
    DracoMesh data;
    const std::size_t position = needed(extension.at("attributes"), "POSITION");
    const std::string_view packed = range_of(item("bufferViews", needed(extension, "bufferView")));
    constexpr std::size_t kEach = 6 * sizeof(double);  // three coordinates, three corners
    const std::string error = unpack_draco(packed, static_cast<std::uint32_t>(position), budget_ / kEach, data);
    if (!error.empty()) fail("a primitive packed by Draco " + error);
    budget_ -= std::min(budget_, (data.positions.size() + data.corners.size()) * sizeof(double));
    return data;
  }

  void add_primitive(const Json& primitive, const Matrix& transform) {
    constexpr std::size_t kTriangles = 4, kStrip = 5, kFan = 6;
    const std::size_t mode = number(primitive, "mode").value_or(kTriangles);
    if (mode > kFan) fail("mode " + std::to_string(mode) + " does not exist");
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
    if (first + count >= kNoIndex)
      throw Error(ErrorCode::TooLarge, printable(input_->name()) + ": more than 2^32 vertices");
    for (std::size_t v = 0; v < count; ++v) {
      const Vec3 p = apply(transform, {xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]});
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        fail("vertex " + std::to_string(first + v) + " has a coordinate that is not finite");
      }
      parts_.positions.push_back(p);
    }
    for (const double v : corners) {
      if (!(v >= 0) || v >= static_cast<double>(count) || v != std::floor(v)) {
        fail("a primitive names vertex " + std::to_string(static_cast<std::int64_t>(v)) + ", but has " +
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

  // The numbers of an accessor, `components` to an element.
  std::vector<double> accessor(std::size_t index, std::size_t components) {
    const Json& a = item("accessors", index);
    const std::string name = "accessor " + std::to_string(index);
    if (a.at("type").get<std::string>() != (components == 3 ? "VEC3" : "SCALAR")) fail(name + " has the wrong type");
    const NumberType type = component_type(needed(a, "componentType"));
    const std::size_t count = needed(a, "count");
    // Many primitives may share one accessor: what comes out altogether is bounded by the file's size.
    if (count > budget_ / (components * sizeof(double)))
      fail("the accessors come to far more than the file's size: refused");
    budget_ -= count * components * sizeof(double);
    const double scale = a.contains("normalized") && a.at("normalized").get<bool>() ? largest(type) : 1;
    std::vector<double> values(count * components, 0.0);
    if (a.contains("bufferView")) {
      const std::size_t stride = number(item("bufferViews", needed(a, "bufferView")), "byteStride").value_or(0);
      read_elements(a, name, {type, count, components, stride}, scale, values.data());
    }
    if (a.contains("sparse")) apply_sparse(a.at("sparse"), name, {type, count, components, 0}, scale, values);
    return values;
  }

  // How numbers stand in a buffer view; stride 0: one element after the other.
  struct Layout {
    NumberType type;
    std::size_t count, components, stride;
  };

  // The elements of the buffer view that `object` names.
  void read_elements(const Json& object, const std::string& name, const Layout& layout, double scale, double* out) {
    const std::string_view bytes = view_bytes(item("bufferViews", needed(object, "bufferView")));
    const std::size_t element = layout.components * size_of(layout.type);
    const std::size_t stride = layout.stride != 0 ? layout.stride : element;
    const std::size_t offset = number(object, "byteOffset").value_or(0);
    const bool fits = offset <= bytes.size() &&
                      (layout.count == 0 || (element <= bytes.size() - offset &&
                                             layout.count - 1 <= (bytes.size() - offset - element) / stride));
    if (!fits) fail(name + " reaches beyond its buffer view of " + std::to_string(bytes.size()) + " bytes");
    for (std::size_t e = 0; e < layout.count; ++e) {
      for (std::size_t k = 0; k < layout.components; ++k) {
        const char* p = bytes.data() + offset + e * stride + k * size_of(layout.type);
        const double v = load_number(layout.type, p, std::endian::little);
        *out++ = scale == 1 ? v : std::max(v / scale, -1.0);
      }
    }
  }

  // Some elements of an accessor have values of their own.
  void apply_sparse(const Json& sparse, const std::string& name, Layout layout, double scale,
                    std::vector<double>& values) {
    const std::size_t count = needed(sparse, "count");
    if (count > layout.count) fail(name + " has more sparse elements than elements");
    layout.count = count;
    const Json& where = sparse.at("indices");
    std::vector<double> index(count), replaced(count * layout.components);
    read_elements(where, name, {component_type(needed(where, "componentType")), count, 1, 0}, 1, index.data());
    read_elements(sparse.at("values"), name, layout, scale, replaced.data());
    for (std::size_t e = 0; e < count; ++e) {
      const double at = index[e];
      if (!(at >= 0) || at != std::floor(at) || at >= static_cast<double>(values.size() / layout.components)) {
        fail(name + " has a sparse element beyond its end");
      }
      std::copy_n(replaced.begin() + static_cast<std::ptrdiff_t>(e * layout.components), layout.components,
                  values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(at) * layout.components));
    }
  }

  NumberType component_type(std::size_t code) const {
    constexpr std::array<NumberType, 7> kTypes{NumberType::Int8,   NumberType::UInt8, NumberType::Int16,
                                               NumberType::UInt16, NumberType::Int32, NumberType::UInt32,
                                               NumberType::Float32};
    constexpr std::size_t kFirst = 5120;
    if (code < kFirst || code >= kFirst + kTypes.size())
      fail("componentType " + std::to_string(code) + " does not exist");
    return kTypes[code - kFirst];
  }

  static double largest(NumberType type) {
    switch (type) {
      case NumberType::Int8:
        return 127;
      case NumberType::UInt8:
        return 255;
      case NumberType::Int16:
        return 32767;
      case NumberType::UInt16:
        return 65535;
      default:
        return 1;
    }
  }

  // The bytes of a buffer view, unpacked where they are packed.
  std::string_view view_bytes(const Json& view) {
    constexpr const char* kExtension = "EXT_meshopt_compression";
    const bool is_packed = view.contains("extensions") && view.at("extensions").contains(kExtension);
    if (!is_packed) return range_of(view);
    const auto found = unpacked_.find(&view);
    if (found != unpacked_.end()) return {found->second.data(), found->second.size()};
    const Json& extension = view.at("extensions").at(kExtension);
    MeshoptView packed;
    packed.mode = extension.at("mode").get<std::string>();
    packed.filter = extension.value("filter", "NONE");
    packed.count = needed(extension, "count");
    packed.stride = needed(extension, "byteStride");
    if (packed.stride == 0 || packed.count > budget_ / packed.stride) {
      fail("a buffer view unpacks to far more than the file's size: refused");
    }
    budget_ -= packed.count * packed.stride;
    std::vector<char>& out = unpacked_[&view];
    out.resize(packed.count * packed.stride);
    const std::string error = unpack_meshopt(packed, range_of(extension), out);
    if (!error.empty()) fail("a buffer view " + error);
    return {out.data(), out.size()};
  }

  std::string_view range_of(const Json& view) {
    const std::string_view buffer = buffer_bytes(needed(view, "buffer"));
    const std::size_t offset = number(view, "byteOffset").value_or(0), size = needed(view, "byteLength");
    if (offset > buffer.size() || size > buffer.size() - offset) {
      fail("a buffer view of " + std::to_string(size) + " bytes at " + std::to_string(offset) +
           " reaches beyond its buffer of " + std::to_string(buffer.size()));
    }
    return buffer.substr(offset, size);
  }

  // A buffer: the GLB's own chunk, base64 in the JSON, or a file beside. Each is fetched once.
  std::string_view buffer_bytes(std::size_t index) {
    const Json& buffer = item("buffers", index);
    if (!buffer.contains("uri")) {
      if (index != 0 || chunks_.binary.data() == nullptr) fail("buffer " + std::to_string(index) + " has no data");
      return chunks_.binary;
    }
    for (const Buffer& b : buffers_) {
      if (b.index == index) return b.input.bytes();
    }
    const auto& uri = buffer.at("uri").get_ref<const std::string&>();
    if (!uri.starts_with("data:")) {
      buffers_.push_back({index, input_->companion(decode_percent(uri), 1), nullptr});
      return buffers_.back().input.bytes();
    }
    constexpr std::string_view kMark = ";base64,";
    const std::size_t mark = uri.find(kMark);
    if (mark == std::string::npos) fail("buffer " + std::to_string(index) + " is data that is not base64");
    Base64Result decoded = decode_base64(std::string_view(uri).substr(mark + kMark.size()));
    if (!decoded.ok) fail("buffer " + std::to_string(index) + " is not base64");
    auto storage = std::make_unique<std::vector<char>>(std::move(decoded.bytes));
    const std::string_view bytes(storage->data(), storage->size());
    buffers_.push_back({index, Input::from_memory(bytes, "buffer"), std::move(storage)});
    return bytes;
  }

  static std::string decode_percent(const std::string& uri) {
    std::string out;
    const auto digit = [](char c) {
      return c >= '0' && c <= '9'   ? c - '0'
             : c >= 'a' && c <= 'f' ? c - 'a' + 10
             : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                    : -1;
    };
    for (std::size_t k = 0; k < uri.size(); ++k) {
      if (uri[k] == '%' && k + 2 < uri.size() && digit(uri[k + 1]) >= 0 && digit(uri[k + 2]) >= 0) {
        out += static_cast<char>(16 * digit(uri[k + 1]) + digit(uri[k + 2]));
        k += 2;
      } else {
        out += uri[k];
      }
    }
    return out;
  }

  struct Buffer {
    std::size_t index;
    Input input;
    std::unique_ptr<std::vector<char>> storage;
  };

  const Input* input_;
  Chunks chunks_;
  Json json_;
  std::size_t budget_;
  MeshParts parts_;
  std::vector<bool> visited_;
  std::vector<Buffer> buffers_;
  std::map<const Json*, std::vector<char>> unpacked_;  // buffer views
  std::size_t primitives_ = 0, left_out_ = 0;
};

}  // namespace

bool is_gltf(std::string_view bytes) { return bytes.substr(0, 4) == "glTF"; }

MeshParts read_gltf(const Input& input) { return GltfReader(input).read(); }

}  // namespace brushfire::detail
