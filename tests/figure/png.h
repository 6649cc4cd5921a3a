// Reads PNG files back, by another library's decoder.
#pragma once

#include <brushfire/figure/image.h>

#include <string>
#include <vector>

namespace brushfire::test {

Image decode_png(const std::vector<std::uint8_t>& bytes);  // an empty image where it is not one
std::vector<std::uint8_t> read_bytes(const std::string& file);

}  // namespace brushfire::test
