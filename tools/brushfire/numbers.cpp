// Reading of numbers.
#include "numbers.h"

#include "command_line.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace brushfire::tool {
namespace {

std::string described(const Range& range) {
  const bool has_low = range.low > kAnyNumber.low, has_high = range.high < kAnyNumber.high;
  std::string text = range.whole ? "a whole number" : "a number";
  if (has_low && has_high) {
    text += " from " + exact(range.low) + " to " + exact(range.high);
  } else if (has_low) {
    text += (range.above_low ? " > " : " >= ") + exact(range.low);
  }
  for (const NumberWord& w : range.words) text += (&w == &range.words.back() ? " or " : ", ") + std::string(w.first);
  return text + (range.high == kInfinity ? " or inf" : "");
}

bool is_in(const Range& range, double value) {
  return value >= range.low && value <= range.high && !(range.above_low && value == range.low) &&
         !(range.whole && value != std::floor(value));
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string out = "'";
  for (const unsigned char c : text.substr(0, kLongest)) {
    static constexpr char kHex[] = "0123456789abcdef";
    if (c >= 0x20 && c < 0x7f) {
      out += static_cast<char>(c);
    } else {
      out += std::string("\\x") + kHex[c >> 4] + kHex[c & 15];
    }
  }
  return out + (text.size() > kLongest ? "...'" : "'");
}

std::optional<double> decimal(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value + 0.0;  // -0.0 + 0.0 is 0.0
}

double number_in(const Range& range, std::string_view option, std::string_view text) {
  for (const NumberWord& w : range.words) {
    if (trimmed(text) == w.first) return w.second;
  }
  std::optional<double> value = decimal(text);
  if (range.high == kInfinity && trimmed(text) == "inf") value = kInfinity;
  if (value && is_in(range, *value)) return *value;
  refuse(std::string(option) + " takes " + described(range) + ", not " + in_quotes(text));
}

std::optional<std::vector<double>> decimals(std::string_view text, char between) {
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(between, begin), text.size());
    const std::optional<double> value = decimal(text.substr(begin, end - begin));
    if (!value) return {};
    values.push_back(*value);
    begin = end + 1;
  }
  return values;
}

}  // namespace brushfire::tool
