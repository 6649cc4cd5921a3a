// XML as a stream of finished elements: nothing is built in memory but the path to the current one.
#pragma once

#include <brushfire/io/detail/input.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace brushfire::detail {

struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::size_t line = 0;        // of the start tag
  std::size_t text_begin = 0;  // bytes between the start tag and the end tag, or the first child if there is one
  std::size_t text_end = 0;
  bool has_children = false;

  // Empty where there is no such attribute.
  std::string_view attribute(std::string_view key) const;
  // A number >= 0; `otherwise` where there is no such attribute. Throws where it is something else.
  std::uint64_t count(const Input& input, std::string_view key, std::uint64_t otherwise = 0) const;
};

// Calls `finished` at the end of every element with the path from the root to it, itself last. Elements may be nested
// 64 deep; entities of the file's own are refused (a few bytes could stand for gigabytes). Where `stop_at` is given,
// parsing ends behind the start tag of that name, whose text_begin is returned; otherwise the size of the input.
// Throws Error(FileMalformed) with the line.
std::size_t parse_xml(const Input& input, std::string_view stop_at,
                      const std::function<void(std::span<const XmlElement> path)>& finished);

}  // namespace brushfire::detail
