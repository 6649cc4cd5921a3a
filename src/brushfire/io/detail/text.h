// TextCursor: words and numbers out of text, with the line for messages.
#pragma once

#include <brushfire/core/cancel.h>
#include <brushfire/core/types.h>
#include <brushfire/io/detail/input.h>

#include <fast_float/fast_float.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

namespace brushfire::detail {

// The content from its first character that is no white space: where a text says what it is.
inline std::string_view text_start(std::string_view bytes) {
  return bytes.substr(std::min(bytes.find_first_not_of(" \t\r\n\v\f"), bytes.size()));
}

// A number in a spelling that C++ does not know: Fortran's exponents (3.0D+00), and Microsoft's names for what is no
// number (-1.#IND, 1.#QNAN, 1.#INF). False where the word is no number at all.
bool read_foreign_number(std::string_view word, double& value);

// Walks over text that is in memory: nothing is copied, and a line may be of any length. Lines end in LF, CR LF or CR.
class TextCursor {
 public:
  // `comment`: the character that starts a comment up to the end of the line; 0 for none.
  TextCursor(const Input& input, std::string_view text, std::size_t first_line = 1, char comment = 0)
      : input_(&input), at_(text.data()), end_(text.data() + text.size()), line_(first_line), comment_(comment) {}

  std::size_t line() const { return line_; }
  const char* position() const { return at_; }
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
  static bool is_line_end(char c) { return c == '\n' || c == '\r'; }
  static bool is_space(char c) { return is_blank(c) || is_line_end(c); }

  // To the next word on this line; false at its end.
  bool to_word_on_line() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    if (at_ != end_ && comment_ != 0 && *at_ == comment_) skip_to_end_of_line();
    return at_ != end_ && !is_line_end(*at_);
  }

  // To the next word, on whatever line; false at the end of the text.
  bool to_word() {
    while (!to_word_on_line()) {
      if (at_ == end_) return false;
      pass_line_end();
    }
    return true;
  }

  void skip_to_end_of_line() {
    while (at_ != end_ && !is_line_end(*at_)) ++at_;
  }

  // Past the end of this line; false where it was the last.
  bool next_line() {
    skip_to_end_of_line();
    if (at_ == end_) return false;
    pass_line_end();
    return true;
  }

  // The rest of this line without blanks at its ends.
  std::string_view rest_of_line() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    const char* begin = at_;
    skip_to_end_of_line();
    const char* last = at_;
    while (last != begin && is_blank(last[-1])) --last;
    return {begin, static_cast<std::size_t>(last - begin)};
  }

  // The next word; empty at the end of the text.
  std::string_view word() {
    if (!to_word()) return {};
    return word_here();
  }

  // The word that starts at the cursor.
  std::string_view word_here() {
    const char* begin = at_;
    while (at_ != end_ && !is_space(*at_)) ++at_;
    return {begin, static_cast<std::size_t>(at_ - begin)};
  }

  // The next number. `what` completes "... expected" in the message.
  double number(const char* what) {
    if (!to_word()) fail_end(what);
    return number_here(what);
  }

  double number_here(const char* what) {
    const char* begin = at_ != end_ && *at_ == '+' ? at_ + 1 : at_;
    double value = 0;
    const auto result = fast_float::from_chars(begin, end_, value);
    if (result.ec == std::errc() && (result.ptr == end_ || is_space(*result.ptr))) {
      at_ = result.ptr;
      return value;
    }
    begin = at_;
    if (!read_foreign_number(word_here(), value)) {
      at_ = begin;
      fail_word(what);
    }
    return value;
  }

  // The next number, which must be finite.
  double coordinate() {
    if (!to_word()) fail_end("a coordinate");
    return coordinate_here();
  }

  double coordinate_here() {
    const char* begin = at_;
    const double value = number_here("a coordinate");
    if (!std::isfinite(value)) {
      at_ = begin;
      fail("coordinate " + quote(word_here()) + " is not finite");
    }
    return value;
  }

  Vec3 point() {
    const double x = coordinate();
    const double y = coordinate();
    const double z = coordinate();
    return {x, y, z};
  }

  // The next integer. Whole numbers that are written as 3.0 are none.
  std::int64_t integer(const char* what) {
    if (!to_word()) fail_end(what);
    const char* begin = at_;
    const std::int64_t value = digits_here(what);
    if (at_ != end_ && !is_space(*at_)) {
      at_ = begin;
      fail_word(what);
    }
    return value;
  }

  // An integer at the cursor; anything may follow.
  std::int64_t digits_here(const char* what) {
    const char* begin = at_;
    bool negative = false;
    if (at_ != end_ && (*at_ == '-' || *at_ == '+')) negative = *at_++ == '-';
    std::uint64_t value = 0;
    int digits = 0;
    while (at_ != end_ && *at_ >= '0' && *at_ <= '9' && digits < 19) {
      value = 10 * value + static_cast<std::uint64_t>(*at_++ - '0');
      if (value != 0) ++digits;
    }
    const bool empty = at_ == begin || at_[-1] < '0' || at_[-1] > '9';
    if (empty || value > static_cast<std::uint64_t>(INT64_MAX) || (at_ != end_ && *at_ >= '0' && *at_ <= '9')) {
      at_ = begin;
      fail_word(what);
    }
    return negative ? -static_cast<std::int64_t>(value) : static_cast<std::int64_t>(value);
  }

  // An index that counts from `base`; what does not fit into 32 bits is an error here, what is beyond the vertices
  // where the faces are finished.
  Index index(std::int64_t base, const char* what = "a vertex number") {
    const std::int64_t value = integer(what);
    if (value < base || value - base >= static_cast<std::int64_t>(kNoIndex)) {
      fail(std::string(what) + " is " + std::to_string(value) +
           (value < base ? (base == 0 ? ", which is negative" : ", but they count from 1") : ", beyond 32 bits"));
    }
    return static_cast<Index>(value - base);
  }

  // A count that at least `bytes_each` bytes of what is left must stand behind: a promise that cannot be kept is an
  // error before memory is taken for it.
  std::size_t count(const char* what, std::size_t bytes_each) {
    const std::int64_t value = integer(what);
    if (value < 0) fail(std::string(what) + " is " + std::to_string(value) + ", which is negative");
    check_count(static_cast<std::uint64_t>(value), what, bytes_each);
    return static_cast<std::size_t>(value);
  }

  void check_count(std::uint64_t value, const char* what, std::size_t bytes_each) const {
    if (value > (left() + 1) / bytes_each) {
      fail(std::string(what) + " is " + std::to_string(value) + ", but only " + std::to_string(left()) +
           " bytes follow");
    }
  }

  // `n` items of `size` bytes as they are; fewer, and nothing taken, where the text ends before. Lines are not counted.
  std::string_view take(std::size_t n, std::size_t size) {
    if (n > left() / size) return {};
    const char* begin = at_;
    at_ += n * size;
    return {begin, n * size};
  }

  // Takes the character at the cursor where it is `c`.
  bool accept(char c) {
    if (at_ == end_ || *at_ != c) return false;
    ++at_;
    return true;
  }

  bool at_end() const { return at_ == end_; }
  char peek() const { return *at_; }

  [[noreturn]] void fail(const std::string& cause) const { input_->fail_line(line_, cause); }
  [[noreturn]] void fail_end(const char* what) const {
    fail(std::string("the file ends where ") + what + " is expected");
  }
  [[noreturn]] void fail_word(const char* what) {
    if (at_ == end_) fail_end(what);
    if (is_line_end(*at_)) fail(std::string("the line ends where ") + what + " is expected");
    fail(quote(word_here()) + " where " + what + " is expected");
  }

 private:
  void pass_line_end() {
    poll_();
    at_ += *at_ == '\r' && left() > 1 && at_[1] == '\n' ? 2 : 1;
    ++line_;
  }

  const Input* input_;
  const char* at_;
  const char* end_;
  std::size_t line_;
  Poll poll_;
  char comment_;
};

}  // namespace brushfire::detail
