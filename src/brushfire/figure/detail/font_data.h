// The font that pictures are lettered with where no other is named.
#pragma once

#include <span>
#include <string_view>

namespace brushfire::detail {

// A TrueType file in base64, in lines: compilers limit the length of one literal.
std::span<const std::string_view> font_in_base64();

}  // namespace brushfire::detail
