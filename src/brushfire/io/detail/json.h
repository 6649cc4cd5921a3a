// JSON of a file as a tree, refused where it is nested without end.
#pragma once

#include <brushfire/io/detail/input.h>

#include <nlohmann/json.hpp>

#include <string_view>

namespace brushfire::detail {

using Json = nlohmann::json;

// `begin`: where `text` stands in the input, for messages.
inline Json parse_json(const Input& input, std::string_view text, std::size_t begin) {
  constexpr int kDeepest = 64;
  const auto callback = [&](int depth, Json::parse_event_t, Json&) {
    // Thrown through the parser, which holds nothing that would leak.
    if (depth > kDeepest) input.fail_byte(begin, "JSON is nested more than 64 deep");
    return true;
  };
  try {
    return Json::parse(text.begin(), text.end(), callback);
  } catch (const Json::parse_error& e) {
    input.fail_byte(begin + (e.byte > 0 ? e.byte - 1 : 0), "not JSON");
  } catch (const Json::exception&) {
    input.fail_byte(begin, "JSON with a number that no double holds");
  }
}

}  // namespace brushfire::detail
