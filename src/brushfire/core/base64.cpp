// Base64 (RFC 4648), both ways.
#include <brushfire/core/detail/base64.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace brushfire::detail {

namespace {

constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t kForeign = 255, kSpace = 254, kPadding = 253;

constexpr std::array<std::uint8_t, 256> make_table() {
  std::array<std::uint8_t, 256> table{};
  for (std::uint8_t& t : table) t = kForeign;
  for (std::size_t k = 0; k < kAlphabet.size(); ++k) {
    table[static_cast<unsigned char>(kAlphabet[k])] = static_cast<std::uint8_t>(k);
  }
  for (const char c : {' ', '\t', '\n', '\r'}) table[static_cast<unsigned char>(c)] = kSpace;
  table['='] = kPadding;
  return table;
}
constexpr std::array<std::uint8_t, 256> kTable = make_table();

}  // namespace

Base64Result decode_base64(std::string_view text, std::size_t limit) {
  Base64Result result;
  result.bytes.reserve(std::min(text.size() / 4 * 3 + 3, limit));
  std::uint32_t bits = 0;
  int have = 0;  // characters of the current group of four
  std::size_t k = 0;
  for (; k < text.size() && (have != 0 || result.bytes.size() < limit); ++k) {
    const std::uint8_t value = kTable[static_cast<unsigned char>(text[k])];
    if (value == kSpace) continue;
    if (value == kPadding) break;
    if (value == kForeign) {
      result.ok = false;
      break;
    }
    bits = bits << 6 | value;
    if (++have == 4) {
      for (const int shift : {16, 8, 0}) result.bytes.push_back(static_cast<char>(bits >> shift & 255));
      bits = 0;
      have = 0;
    }
  }
  // A last group of two or three characters holds one or two bytes, and is filled up with '='.
  if (have >= 2) result.bytes.push_back(static_cast<char>(bits >> (6 * have - 8) & 255));
  if (have == 3) result.bytes.push_back(static_cast<char>(bits >> 2 & 255));
  for (; have % 4 != 0 && k < text.size(); ++k) {
    const std::uint8_t value = kTable[static_cast<unsigned char>(text[k])];
    if (value == kPadding) {
      ++have;
    } else if (value != kSpace) {
      break;
    }
  }
  result.consumed = k;
  return result;
}

std::string encode_base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i)
      bits = bits << 8 | (k + i < bytes.size() ? static_cast<unsigned char>(bytes[k + i]) : 0u);
    for (std::size_t i = 0; i < 4; ++i) {
      text += k + i <= bytes.size() ? kAlphabet[bits >> (18 - 6 * i) & 63] : '=';
    }
  }
  return text;
}

}  // namespace brushfire::detail
