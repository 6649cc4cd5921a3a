// An image in memory, and the files it is written to.
#pragma once

#include <brushfire/figure/colormap.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace brushfire {

// Pixels row by row from the top left, four bytes each: red, green, blue, alpha (not premultiplied).
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  // [height * width * 4]

  Image() = default;
  Image(int w, int h) : width(w), height(h), rgba(4 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 0) {}
  std::uint8_t* pixel(int x, int y) { return &rgba[4 * (static_cast<std::size_t>(y) * width + x)]; }
  const std::uint8_t* pixel(int x, int y) const { return &rgba[4 * (static_cast<std::size_t>(y) * width + x)]; }
};

// Puts `color` with opacity `alpha` over a pixel, which may itself be transparent.
void blend_over(std::uint8_t* pixel, Color color, float alpha);

// The bytes of a PNG file. Deterministic: the same image gives the same bytes with the same zlib.
std::vector<std::uint8_t> encode_png(const Image& image);

// The bytes of an animated WebP file that loops for ever: frames of equal size, shown for `milliseconds` each.
// Throws Error(InvalidArgument) for no frames, frames of different sizes, or where the library was built without WebP.
std::vector<std::uint8_t> encode_webp(std::span<const Image> frames, int milliseconds);

}  // namespace brushfire
