// The texts of a Zarr group and the names of its chunks.
#include <brushfire/io/detail/zarr.h>

#include <cstdio>

namespace brushfire::detail {
namespace {

std::string list_of(const std::vector<std::uint64_t>& numbers) {
  std::string text = "[";
  for (std::size_t k = 0; k < numbers.size(); ++k) text += (k > 0 ? ", " : "") + std::to_string(numbers[k]);
  return text + "]";
}

std::string list_of(const std::vector<std::string>& names) {
  std::string text = "[";
  for (std::size_t k = 0; k < names.size(); ++k) text += (k > 0 ? ", " : "") + json_string(names[k]);
  return text + "]";
}

// What is in no chunk: nothing that could be taken for a distance. Of coordinates there are all chunks; xarray would
// take a value of format 2 for "missing", and the numbers for floats.
std::string fill_of(const ZarrArray& array, int format) {
  if (array.type != "int64") return "\"NaN\"";
  return format == 2 ? "null" : "-1";
}

std::string array_v3(const ZarrArray& a) {
  return "{\"zarr_format\": 3, \"node_type\": \"array\", \"shape\": " + list_of(a.shape) +
         ", \"data_type\": " + json_string(a.type) +
         ", \"chunk_grid\": {\"name\": \"regular\", \"configuration\": {\"chunk_shape\": " + list_of(a.chunk) +
         "}}, \"chunk_key_encoding\": {\"name\": \"default\", \"configuration\": {\"separator\": \"/\"}}, "
         "\"fill_value\": " +
         fill_of(a, 3) +
         ", \"codecs\": [{\"name\": \"bytes\", \"configuration\": {\"endian\": \"little\"}}], \"attributes\": {}, "
         "\"dimension_names\": " +
         list_of(a.dimensions) + "}";
}

std::string array_v2(const ZarrArray& a) {
  const char* type = a.type == "float32" ? "<f4" : a.type == "float64" ? "<f8" : "<i8";
  return "{\"zarr_format\": 2, \"shape\": " + list_of(a.shape) + ", \"chunks\": " + list_of(a.chunk) +
         ", \"dtype\": " + json_string(type) + ", \"compressor\": null, \"fill_value\": " + fill_of(a, 2) +
         ", \"order\": \"C\", \"filters\": null, \"dimension_separator\": \".\"}";
}

}  // namespace

std::string json_string(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) {
      quoted += c;
    } else {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      quoted += code;
    }
  }
  return quoted + '"';
}

ZarrGroup::ZarrGroup(int format, std::vector<ZarrArray> arrays, std::string attributes)
    : format_(format), arrays_(std::move(arrays)), attributes_(std::move(attributes)) {}

std::vector<std::pair<std::string, std::string>> ZarrGroup::texts() const {
  std::vector<std::pair<std::string, std::string>> files;
  std::string all;
  if (format_ == 3) {
    for (const ZarrArray& a : arrays_) {
      files.emplace_back(a.name + "/zarr.json", array_v3(a));
      all += (all.empty() ? "" : ", ") + json_string(a.name) + ": " + array_v3(a);
    }
    files.emplace_back("zarr.json",
                       "{\"zarr_format\": 3, \"node_type\": \"group\", \"attributes\": {" + attributes_ +
                           "}, \"consolidated_metadata\": {\"kind\": \"inline\", \"must_understand\": false, "
                           "\"metadata\": {" +
                           all + "}}}\n");
    return files;
  }
  const std::string group = "{\"zarr_format\": 2}", attributes = "{" + attributes_ + "}";
  all = "\".zgroup\": " + group + ", \".zattrs\": " + attributes;
  for (const ZarrArray& a : arrays_) {
    const std::string dimensions = "{\"_ARRAY_DIMENSIONS\": " + list_of(a.dimensions) + "}";
    files.emplace_back(a.name + "/.zarray", array_v2(a));
    files.emplace_back(a.name + "/.zattrs", dimensions);
    all += ", " + json_string(a.name + "/.zarray") + ": " + array_v2(a);
    all += ", " + json_string(a.name + "/.zattrs") + ": " + dimensions;
  }
  files.emplace_back(".zmetadata", "{\"zarr_consolidated_format\": 1, \"metadata\": {" + all + "}}\n");
  files.emplace_back(".zattrs", attributes);
  files.emplace_back(".zgroup", group);
  return files;
}

std::string ZarrGroup::chunk_path(const ZarrArray& array, std::uint64_t k) const {
  const char* separator = format_ == 3 ? "/" : ".";
  std::string path = array.name + (format_ == 3 ? "/c/" : "/") + std::to_string(k);
  for (std::size_t d = 1; d < array.shape.size(); ++d) path += std::string(separator) + "0";
  return path;
}

}  // namespace brushfire::detail
