// Text in pictures.
#pragma once

#include <brushfire/figure/colormap.h>
#include <brushfire/figure/image.h>

#include <memory>
#include <string>
#include <string_view>

namespace brushfire::detail {

// A TrueType font, or none: then nothing is written and every text is empty.
class Font {
 public:
  // The file named, or the first of a list of usual places; none there: an empty font. Throws Error(FileNotReadable)
  // or Error(FileMalformed) for a file that was named and cannot be used.
  explicit Font(const std::string& file);
  ~Font();
  Font(Font&&) noexcept;

  bool empty() const { return state_ == nullptr; }
  double width(std::string_view utf8, double height) const;  // pixels
  // Writes with the baseline's left end at (x, y); anti-aliased, over what is there.
  void write(Image& picture, double x, double y, double height, std::string_view utf8, Color color) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace brushfire::detail
