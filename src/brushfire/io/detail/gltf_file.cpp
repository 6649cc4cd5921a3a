// GLB chunks, JSON, buffers and accessors of glTF 2.0.
#include <brushfire/io/detail/gltf_file.h>

#include <brushfire/core/detail/base64.h>
#include <brushfire/io/detail/meshopt.h>

#include <array>
#include <cmath>

namespace brushfire::detail {

namespace {

double largest(NumberType type) {
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

std::string decode_percent(const std::string& uri) {
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

}  // namespace

GltfFile::GltfFile(const Input& input)
    : input_(&input),
      chunks_(split(input)),
      json_(parse_json(input, chunks_.json, chunks_.json_begin)),
      budget_(input.inflate_budget()) {}

GltfFile::Chunks GltfFile::split(const Input& input) {
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

const Json& GltfFile::item(const char* list, std::size_t index) const {
  const auto found = json_.find(list);
  if (found == json_.end() || !found->is_array() || index >= found->size()) {
    fail(std::string("there is no ") + list + "[" + std::to_string(index) + "]");
  }
  return (*found)[index];
}

std::optional<std::size_t> GltfFile::number(const Json& object, const char* key) const {
  const auto found = object.find(key);
  if (found == object.end()) return std::nullopt;
  if (!found->is_number_unsigned())
    fail(std::string(key) + " is " + quote(found->dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 60)) +
         ", not a whole number");
  return found->get<std::size_t>();
}

std::size_t GltfFile::needed(const Json& object, const char* key) const {
  const std::optional<std::size_t> n = number(object, key);
  if (!n) fail(std::string(key) + " is missing");
  return *n;
}

std::vector<double> GltfFile::accessor(std::size_t index, std::size_t components) {
  const Json& a = item("accessors", index);
  const std::string name = "accessor " + std::to_string(index);
  if (a.at("type").get<std::string>() != (components == 3 ? "VEC3" : "SCALAR")) fail(name + " has the wrong type");
  const NumberType type = component_type(needed(a, "componentType"));
  const std::size_t count = needed(a, "count");
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

// The elements of the buffer view that `object` names.
void GltfFile::read_elements(const Json& object, const std::string& name, const Layout& layout, double scale,
                             double* out) {
  const std::string_view bytes = view_bytes(item("bufferViews", needed(object, "bufferView")));
  const std::size_t element = layout.components * size_of(layout.type);
  const std::size_t stride = layout.stride != 0 ? layout.stride : element;
  const std::size_t offset = number(object, "byteOffset").value_or(0);
  const bool fits =
      offset <= bytes.size() && (layout.count == 0 || (element <= bytes.size() - offset &&
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
void GltfFile::apply_sparse(const Json& sparse, const std::string& name, Layout layout, double scale,
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

NumberType GltfFile::component_type(std::size_t code) const {
  constexpr std::array<NumberType, 7> kTypes{NumberType::Int8,   NumberType::UInt8, NumberType::Int16,
                                             NumberType::UInt16, NumberType::Int32, NumberType::UInt32,
                                             NumberType::Float32};
  constexpr std::size_t kFirst = 5120;
  if (code < kFirst || code >= kFirst + kTypes.size())
    fail("componentType " + std::to_string(code) + " does not exist");
  return kTypes[code - kFirst];
}

// The bytes of a buffer view, unpacked where they are packed.
std::string_view GltfFile::view_bytes(const Json& view) {
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

std::string_view GltfFile::range_of(const Json& view) {
  const std::string_view buffer = buffer_bytes(needed(view, "buffer"));
  const std::size_t offset = number(view, "byteOffset").value_or(0), size = needed(view, "byteLength");
  if (offset > buffer.size() || size > buffer.size() - offset) {
    fail("a buffer view of " + std::to_string(size) + " bytes at " + std::to_string(offset) +
         " reaches beyond its buffer of " + std::to_string(buffer.size()));
  }
  return buffer.substr(offset, size);
}

// A buffer: the GLB's own chunk, base64 in the JSON, or a file beside. Each is fetched once.
std::string_view GltfFile::buffer_bytes(std::size_t index) {
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

}  // namespace brushfire::detail
