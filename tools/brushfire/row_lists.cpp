// Reading of --rows and --columns.
#include "row_lists.h"

#include "fields.h"

#include <brushfire/core/error.h>
#include <brushfire/io/read_field.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>

namespace brushfire::tool {
namespace {

constexpr std::string_view kDigits = "0123456789";

Where vertex(std::uint64_t index) {
  Where where;
  where.place = VertexPlace{index};
  where.text = std::to_string(index);
  return where;
}

std::uint64_t number(std::string_view digits, std::uint64_t otherwise) {
  if (digits.empty()) return otherwise;
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return error == std::errc{} ? value : UINT64_MAX;
}

// "5", "0-999", "0:1000", "0:1000:10": digits, with the one sign or the other between them.
bool is_range(std::string_view item) {
  return !item.empty() && item.find_first_not_of("0123456789:-") == std::string_view::npos &&
         item.find_first_of(kDigits) != std::string_view::npos;
}

void add_range(std::string_view item, const std::string& option, Index count, std::vector<Where>& places) {
  const auto refuse_item = [&](const char* why) {
    refuse(option + ": " + in_quotes(item) + " is no range of vertices: " + why);
  };
  std::uint64_t begin = 0, end = count, step = 1;
  if (const std::size_t dash = item.find('-'); dash != std::string_view::npos) {
    if (dash == 0 || dash + 1 == item.size() || item.find_first_not_of(kDigits, dash + 1) != std::string_view::npos)
      refuse_item("write the first and the last, 0-999");
    begin = number(item.substr(0, dash), 0);
    const std::uint64_t last = number(item.substr(dash + 1), 0);
    if (last < begin) refuse_item("the last comes before the first");
    end = last == UINT64_MAX ? last : last + 1;
  } else if (const std::size_t colon = item.find(':'); colon != std::string_view::npos) {
    const std::size_t second = std::min(item.find(':', colon + 1), item.size());
    begin = number(item.substr(0, colon), 0);
    end = number(item.substr(colon + 1, second - colon - 1), count);
    if (second < item.size()) step = number(item.substr(second + 1), 1);
    if (step == 0 || item.find(':', second + 1 < item.size() ? second + 1 : item.size()) != std::string_view::npos)
      refuse_item("write FIRST:END or FIRST:END:STEP");
  } else {
    places.push_back(vertex(number(item, 0)));
    return;
  }
  if (end > count || begin > count) {
    throw Error(ErrorCode::IndexOutOfRange, option + " " + std::string(item) + ": the mesh has " +
                                                std::to_string(count) + " vertices, 0 to " + std::to_string(count - 1));
  }
  for (std::uint64_t v = begin; v < end; v += std::min(step, end - v)) places.push_back(vertex(v));
}

// Nothing where one of the items between commas is no range.
std::optional<std::vector<Where>> ranges(const std::string& text, const std::string& option, Index count) {
  if (text.find_first_of(":-") == std::string::npos) return std::nullopt;
  std::vector<std::string_view> items;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    items.push_back(trimmed(std::string_view(text).substr(begin, end - begin)));
    begin = end + 1;
  }
  if (!std::all_of(items.begin(), items.end(), is_range)) return std::nullopt;
  std::vector<Where> places;
  for (const std::string_view item : items) add_range(item, option, count, places);
  return places;
}

bool is_file(const std::string& path) {
  std::error_code error;
  return std::filesystem::exists(path, error);
}

// Of a file with values: a list of vertices, or where the value is above 0.
std::vector<Where> vertices_of(const std::string& file, const std::string& option, Index count) {
  const LoadedField field = read_field(file);
  std::vector<Where> places;
  if (field.format == "FreeSurfer label") {
    for (const Index v : field.vertices) places.push_back(vertex(v));
    return places;
  }
  const auto is_bit = [](double v) { return v == 0 || v == 1; };
  const bool is_mask = field.format != "NPY" || (field.values.size() == count && count > 2 &&
                                                 std::all_of(field.values.begin(), field.values.end(), is_bit));
  if (!is_mask) {
    const auto is_number = [](double value) { return value >= 0 && value == std::floor(value); };
    const auto odd = std::find_if_not(field.values.begin(), field.values.end(), is_number);
    if (odd != field.values.end()) refuse(option + " " + file + ": " + exact(*odd) + " is no vertex");
    for (const double value : field.values) places.push_back(vertex(static_cast<std::uint64_t>(value)));
    return places;
  }
  const std::vector<double> values = values_on_vertices(field, count, 0);
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (values[v] > 0) places.push_back(vertex(v));
  }
  if (places.empty()) refuse(option + " " + file + ": no vertex has a value above 0");
  return places;
}

std::vector<Where> vertices_with_label(const std::string& file, std::string_view labels, const std::string& option,
                                       Index count) {
  const LoadedField field = read_field(file);
  const std::vector<double> keys = keys_named(field, labels, file, option);
  const std::vector<double> values = values_of(field, file, count, "the mesh");
  std::vector<Where> places;
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (std::find(keys.begin(), keys.end(), values[v]) != keys.end()) places.push_back(vertex(v));
  }
  if (places.empty()) refuse(option + ": no vertex has " + in_quotes(file + ":" + std::string(labels)));
  return places;
}

// A file that read_field() reads, and that is no list of places as text.
bool has_values(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension().string();
  for (const char* known : {".npy", ".gii", ".annot", ".label", ".curv"}) {
    if (extension == known) return true;
  }
  return false;
}

}  // namespace

std::optional<std::vector<Where>> parse_row_list(const std::string& text, const std::string& option, Index count) {
  if (text.empty() || text == "all") return std::nullopt;
  if (!is_file(text)) {
    if (std::optional<std::vector<Where>> found = ranges(text, option, count)) return found;
    const std::size_t colon = text.rfind(':');
    if (colon != std::string::npos && colon > 0 && is_file(text.substr(0, colon))) {
      return vertices_with_label(text.substr(0, colon), std::string_view(text).substr(colon + 1), option, count);
    }
    if (text.starts_with("f:") || text.starts_with("at:") ||
        text.find_first_not_of("0123456789, ") == std::string::npos) {
      std::vector<Where> places;
      for (const std::string& place : split_places({text})) places.push_back(parse_where(place));
      return places;
    }
  }
  if (has_values(text)) return vertices_of(text, option, count);
  return read_where_file(text);
}

}  // namespace brushfire::tool
