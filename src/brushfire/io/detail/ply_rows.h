// The rows of a PLY file's elements, from bytes and from text.
#pragma once

#include <brushfire/io/detail/binary.h>
#include <brushfire/io/detail/input.h>
#include <brushfire/io/detail/ply.h>
#include <brushfire/io/detail/text.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

namespace brushfire::detail::ply {

// Rows of binary elements: a bounds-checked walk over bytes.
class BinaryRows {
 public:
  BinaryRows(const Input& input, const Header& header) : input_(&input), order_(header.order()), at_(header.size) {}

  std::size_t place() const { return at_; }
  std::endian order() const { return order_; }

  // `size` bytes, which must be there.
  const char* take(std::size_t size, const Element& e, std::uint64_t row) {
    if (size > input_->size() - at_) {
      input_->fail_byte(input_->size(), "the file ends in row " + std::to_string(row) + " of the " +
                                            std::to_string(e.count) + " of element " + quote(e.name));
    }
    const char* p = input_->bytes().data() + at_;
    at_ += size;
    return p;
  }

  // The same where they are there; nullptr otherwise, and nothing is taken.
  const char* peek(std::size_t size) const {
    return size <= input_->size() - at_ ? input_->bytes().data() + at_ : nullptr;
  }

  double number(Type type, const Element& e, std::uint64_t row) {
    return load_number(type, take(size_of(type), e, row), order_);
  }

  // What the header promises must be there, at the shortest: every number, and no entries in lists.
  void check_promise(const Element& e, std::size_t shortest_row) const {
    if (shortest_row != 0 && e.count > (input_->size() - at_) / shortest_row) {
      input_->fail_line(e.line, "the header promises " + std::to_string(e.count) + " rows of element " + quote(e.name) +
                                    " of at least " + std::to_string(shortest_row) + " bytes, but only " +
                                    std::to_string(input_->size() - at_) + " bytes follow");
    }
  }
  static std::size_t shortest(const Property& p) { return size_of(p.is_list ? p.count_type : p.type); }

  void begin_row(const Element&, std::uint64_t) {}
  void end_row() {}
  std::size_t rows_with_more() const { return 0; }
  bool has_rest() const { return !text_start(input_->bytes().substr(at_)).empty(); }

  [[noreturn]] void fail(std::size_t place, const std::string& cause) const { input_->fail_byte(place, cause); }

 private:
  const Input* input_;
  std::endian order_;
  std::size_t at_;
};

// The same over text, where every row is a line.
class AsciiRows {
 public:
  AsciiRows(const Input& input, const Header& header)
      : input_(&input), text_(input, input.bytes().substr(header.size), header.lines + 1) {}

  std::size_t place() const { return text_.line(); }

  // To the line of the next row.
  void begin_row(const Element& e, std::uint64_t row) {
    if (!text_.to_word()) text_.fail("the file ends before " + row_name(e, row));
  }
  double number(Type, const Element& e, std::uint64_t row) {
    if (!text_.to_word_on_line()) text_.fail("the line ends within " + row_name(e, row));
    return text_.number_here("a number");
  }
  // What stands in the line behind the row's values belongs to no property.
  void end_row() {
    if (!text_.to_word_on_line()) return;
    ++rows_with_more_;
    text_.skip_to_end_of_line();
  }
  std::size_t rows_with_more() const { return rows_with_more_; }
  // Whether something follows the last row.
  bool has_rest() { return text_.to_word(); }

  void check_promise(const Element& e, std::size_t shortest_row) const {
    if (shortest_row != 0 && e.count > (text_.left() + 1) / shortest_row) {
      input_->fail_line(e.line, "the header promises " + std::to_string(e.count) + " rows of element " + quote(e.name) +
                                    ", but only " + std::to_string(text_.left()) + " bytes follow");
    }
  }
  static std::size_t shortest(const Property&) { return 2; }  // a digit and what ends it

  [[noreturn]] void fail(std::size_t place, const std::string& cause) const { input_->fail_line(place, cause); }

 private:
  static std::string row_name(const Element& e, std::uint64_t row) {
    return "row " + std::to_string(row) + " of the " + std::to_string(e.count) + " of element " + quote(e.name);
  }

  const Input* input_;
  TextCursor text_;
  std::size_t rows_with_more_ = 0;
};

}  // namespace brushfire::detail::ply
