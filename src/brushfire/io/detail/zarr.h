// Zarr: an array as a folder of uncompressed chunks with a description in JSON, which zarr-python and xarray read.
//
// Based on: "Zarr core specification, version 3.1" and "Zarr storage specification, version 2", zarr.dev.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace brushfire::detail {

// A two-dimensional array in a group, in chunks of whole rows; what is in no chunk reads NaN.
struct ZarrArray {
  std::string name;
  std::string type;  // "float32", "float64", "int64"
  std::vector<std::uint64_t> shape, chunk;
  std::vector<std::string> dimensions;  // their names, which xarray wants
};

// A group with arrays in it, in format 2 or 3: which text stands in which file of its folder. The texts list the
// arrays together, too, so that nobody has to search the folders ("consolidated").
class ZarrGroup {
 public:
  // `attributes`: members of a JSON object, "\"a\": 1".
  ZarrGroup(int format, std::vector<ZarrArray> arrays, std::string attributes);

  // Of files relative to the group's folder and their text; the group itself last, so that whoever sees it sees all.
  std::vector<std::pair<std::string, std::string>> texts() const;
  // Where chunk `k` of the array is, relative to the group's folder; further dimensions are one chunk.
  std::string chunk_path(const ZarrArray& array, std::uint64_t k) const;
  int format() const { return format_; }
  const std::vector<ZarrArray>& arrays() const { return arrays_; }

 private:
  int format_;
  std::vector<ZarrArray> arrays_;
  std::string attributes_;
};

// Text as a JSON string.
std::string json_string(const std::string& text);

}  // namespace brushfire::detail
