// The words, numbers and strings of legacy VTK, in text or in big-endian bytes.
#pragma once

#include <brushfire/io/detail/input.h>
#include <brushfire/io/detail/numbers.h>
#include <brushfire/io/detail/text.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace brushfire::detail {

// A cursor through the file. What is promised and cannot be there throws Error(FileMalformed) before memory is taken
// for it.
class VtkText {
 public:
  explicit VtkText(const Input& input) : text(input, input.bytes()), input_(&input) {}

  TextCursor text;      // stands behind what was read last
  bool binary = false;  // numbers and strings are bytes; words and counts are text in either case

  std::string_view one_word(const char* what);
  std::string type_name() { return std::string(one_word("a type")); }
  NumberType read_type() { return type_named(type_name()); }

  std::vector<double> read_array(NumberType type, std::size_t n);
  // Attributes may also be bits or strings, which are passed over: empty.
  std::vector<double> read_attribute_array(const std::string& type, std::size_t n);
  std::size_t count_of_tuples();

  // a * b, where so many numbers can follow.
  std::size_t checked_product(std::size_t a, std::size_t b) const;

  // The line, or the byte of a binary file.
  std::size_t place() const;
  [[noreturn]] void fail(const std::string& cause) const;

 private:
  NumberType type_named(const std::string& name) const;
  void skip_string();
  std::string_view take_bytes(std::size_t size);

  const Input* input_;
};

}  // namespace brushfire::detail
