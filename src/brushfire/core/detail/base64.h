// Base64, as it stands in XML and JSON.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace brushfire::detail {

struct Base64Result {
  std::vector<char> bytes;
  std::size_t consumed = 0;  // characters of the text, up to and including padding
  bool ok = true;            // false: a foreign character at `consumed`
};

// Decodes up to padding or the end; white space is skipped. At most `limit` bytes, a multiple of three, come out.
Base64Result decode_base64(std::string_view text, std::size_t limit = static_cast<std::size_t>(-1));

std::string encode_base64(std::string_view bytes);

}  // namespace brushfire::detail
