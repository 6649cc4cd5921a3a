// Text by stb_truetype.
#include <brushfire/figure/detail/text.h>

#include <brushfire/core/detail/base64.h>
#include <brushfire/core/error.h>
#include <brushfire/figure/detail/font_data.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#include <stb_truetype.h>

namespace brushfire::detail {
namespace {

std::vector<unsigned char> read_file(const std::string& name) {
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  const std::unique_ptr<std::FILE, Close> file(std::fopen(name.c_str(), "rb"));
  std::vector<unsigned char> bytes;
  if (!file) return bytes;
  std::array<unsigned char, 65536> buffer;
  // NOLINTNEXTLINE(clang-analyzer-unix.Stream): at the end it reads nothing, which ends the loop
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), file.get())) {
    bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(n));
  }
  return bytes;
}

std::vector<unsigned char> built_in_font() {
  std::string text;
  for (const std::string_view line : font_in_base64()) text += line;
  const std::vector<char> bytes = decode_base64(text).bytes;
  return {bytes.begin(), bytes.end()};
}

// The next character; a byte that is not UTF-8 reads as itself (Latin-1).
int next_code_point(std::string_view& text) {
  const auto byte = [&text](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned lead = byte(0);
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC0 ? 2 : 1;
  unsigned code = length == 1 ? lead : lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) {
      text.remove_prefix(1);
      return static_cast<int>(lead);
    }
    code = code << 6 | (byte(i) & 0x3FU);
  }
  text.remove_prefix(length);
  return static_cast<int>(code);
}

}  // namespace

struct Font::State {
  std::vector<unsigned char> bytes;
  stbtt_fontinfo info{};

  // Calls draw(code point, x) along the line and returns where it ends, in pixels from its start.
  template <class Draw>
  double layout(std::string_view text, double scale, Draw&& draw) const {
    double x = 0;
    int previous = 0;
    while (!text.empty()) {
      const int code = next_code_point(text);
      if (previous != 0) x += scale * stbtt_GetCodepointKernAdvance(&info, previous, code);
      draw(code, x);
      int advance = 0, bearing = 0;
      stbtt_GetCodepointHMetrics(&info, code, &advance, &bearing);
      x += scale * advance;
      previous = code;
    }
    return x;
  }
  double scale(double height) const {
    return static_cast<double>(stbtt_ScaleForPixelHeight(&info, static_cast<float>(height)));
  }
};

Font::Font(const std::string& file) : state_(std::make_unique<State>()) {
  state_->bytes = file.empty() ? built_in_font() : read_file(file);
  if (state_->bytes.empty()) throw Error(ErrorCode::FileNotReadable, file + ": cannot be read as a font");
  const int offset = stbtt_GetFontOffsetForIndex(state_->bytes.data(), 0);
  if (offset < 0 || stbtt_InitFont(&state_->info, state_->bytes.data(), offset) == 0) {
    throw Error(ErrorCode::FileMalformed, file + ": not a TrueType font");
  }
}

Font::~Font() = default;
Font::Font(Font&&) noexcept = default;

double Font::width(std::string_view utf8, double height) const {
  return state_->layout(utf8, state_->scale(height), [](int, double) {});
}

void Font::write(Image& picture, double x, double y, double height, std::string_view utf8, Color color) const {
  const double scale = state_->scale(height);
  std::vector<unsigned char> coverage;
  state_->layout(utf8, scale, [&](int code, double along) {
    const double left = x + along;
    const float shift = static_cast<float>(left - std::floor(left));
    const float s = static_cast<float>(scale);
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    stbtt_GetCodepointBitmapBoxSubpixel(&state_->info, code, s, s, shift, 0, &x0, &y0, &x1, &y1);
    const int w = x1 - x0, h = y1 - y0;
    if (w <= 0 || h <= 0) return;
    coverage.assign(static_cast<std::size_t>(w) * h, 0);
    stbtt_MakeCodepointBitmapSubpixel(&state_->info, coverage.data(), w, h, w, s, s, shift, 0, code);
    for (int row = 0; row < h; ++row) {
      for (int column = 0; column < w; ++column) {
        const int px = static_cast<int>(std::floor(left)) + x0 + column;
        const int py = static_cast<int>(std::lround(y)) + y0 + row;
        if (px < 0 || py < 0 || px >= picture.width || py >= picture.height) continue;
        blend_over(picture.pixel(px, py), color,
                   static_cast<float>(coverage[static_cast<std::size_t>(row) * w + column]) / 255.0F);
      }
    }
  });
}

}  // namespace brushfire::detail
