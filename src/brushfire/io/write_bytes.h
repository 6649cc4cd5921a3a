// Bytes made elsewhere (pictures, SVG) into a file that appears complete or not at all.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace brushfire {

// "-" is standard output. Throw Error(FileNotWritable).
void write_bytes(const std::string& path, std::span<const std::uint8_t> bytes);
void write_text(const std::string& path, std::string_view text);

}  // namespace brushfire
