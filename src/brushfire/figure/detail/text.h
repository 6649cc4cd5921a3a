// Text in pictures.
#pragma once

#include <brushfire/figure/colormap.h>
#include <brushfire/figure/image.h>

#include <memory>
#include <string>
#include <string_view>

namespace brushfire::detail {

// A TrueType font.
class Font {
 public:
  // The file named, or, where the name is empty, the built-in one: a part of DejaVu Sans (Latin, Greek, Cyrillic), so
  // that pictures are the same on every machine. Throws Error(FileNotReadable) or Error(FileMalformed) for a file that
  // cannot be used.
  explicit Font(const std::string& file);
  ~Font();
  Font(Font&&) noexcept;

  double width(std::string_view utf8, double height) const;  // pixels
  // Writes with the baseline's left end at (x, y); anti-aliased, over what is there.
  void write(Image& picture, double x, double y, double height, std::string_view utf8, Color color) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace brushfire::detail
