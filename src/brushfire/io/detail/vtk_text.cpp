// Legacy VTK's numbers and strings.
#include <brushfire/io/detail/vtk_text.h>

#include <cstdint>
#include <optional>

namespace brushfire::detail {

namespace {

std::optional<NumberType> type_of(std::string_view name) {
  struct Name {
    std::string_view name;
    NumberType type;
  };
  static constexpr Name kNames[]{{"char", NumberType::Int8},
                                 {"signed_char", NumberType::Int8},
                                 {"unsigned_char", NumberType::UInt8},
                                 {"short", NumberType::Int16},
                                 {"unsigned_short", NumberType::UInt16},
                                 {"int", NumberType::Int32},
                                 {"unsigned_int", NumberType::UInt32},
                                 {"long", NumberType::Int64},
                                 {"unsigned_long", NumberType::UInt64},
                                 {"vtktypeint64", NumberType::Int64},
                                 {"vtktypeuint64", NumberType::UInt64},
                                 {"vtkIdType", NumberType::Int32},
                                 {"vtkidtype", NumberType::Int32},
                                 {"float", NumberType::Float32},
                                 {"double", NumberType::Float64}};
  for (const Name& n : kNames) {
    if (n.name == name) return n.type;
  }
  return std::nullopt;
}

}  // namespace

std::string_view VtkText::one_word(const char* what) {
  if (!text.to_word()) text.fail_end(what);
  return text.word_here();
}

NumberType VtkText::type_named(const std::string& name) const {
  const std::optional<NumberType> type = type_of(name);
  if (!type) fail("numbers of type " + quote(name) + " are not read");
  return *type;
}

std::vector<double> VtkText::read_attribute_array(const std::string& type, std::size_t n) {
  if (type == "bit" && binary) {
    text.next_line();
    take_bytes((n + 7) / 8);
  } else if (type == "string" || type == "utf8_string") {
    text.next_line();
    for (std::size_t k = 0; k < n; ++k) skip_string();
  } else {
    return read_array(type == "bit" ? NumberType::UInt8 : type_named(type), n);
  }
  return {};
}

// A line of text; in binary files bytes behind their number, whose own size stands in its two highest bits.
void VtkText::skip_string() {
  if (!binary) {
    if (!text.next_line()) text.fail_end("a string");
    return;
  }
  constexpr std::size_t kBytes[]{8, 4, 2, 1};
  if (text.left() == 0) fail("the file ends within the strings");
  const auto first = static_cast<unsigned char>(text.peek());
  std::uint64_t length = 0;
  for (const char c : take_bytes(kBytes[first >> 6])) length = length << 8 | static_cast<unsigned char>(c);
  take_bytes(as_size(length & (~std::uint64_t{0} >> (64 - (8 * kBytes[first >> 6] - 2)))));
}

std::string_view VtkText::take_bytes(std::size_t size) {
  if (size > text.left())
    fail(std::to_string(size) + " bytes are promised, but only " + std::to_string(text.left()) + " follow");
  return text.take(size, 1);
}

// Tuples of bits take less than a byte each.
std::size_t VtkText::count_of_tuples() {
  const std::int64_t n = text.integer("the number of tuples");
  if (n < 0 || static_cast<std::uint64_t>(n) / 8 > text.left()) {
    fail("the number of tuples is " + std::to_string(n) + ", but only " + std::to_string(text.left()) +
         " bytes follow");
  }
  return static_cast<std::size_t>(n);
}

std::size_t VtkText::checked_product(std::size_t a, std::size_t b) const {
  if (b != 0 && a / 8 > text.left() / b + 1) {
    fail(std::to_string(a) + " times " + std::to_string(b) + " numbers are promised, but only " +
         std::to_string(text.left()) + " bytes follow");
  }
  return a * b;
}

std::vector<double> VtkText::read_array(NumberType type, std::size_t n) {
  std::vector<double> values;
  if (binary) {
    text.next_line();
    const std::string_view raw = text.take(n, size_of(type));
    if (raw.size() != n * size_of(type)) {
      fail(std::to_string(n) + " numbers are promised, but only " + std::to_string(text.left()) + " bytes follow");
    }
    values.resize(n);
    // NOLINTNEXTLINE(bugprone-suspicious-stringview-data-usage): as long as n numbers are
    load_numbers(type, raw.data(), std::endian::big, n, values.data());
    return values;
  }
  text.check_count(n, "the number of values", 2);
  values.reserve(n);
  for (std::size_t k = 0; k < n; ++k) values.push_back(text.number("a number"));
  return values;
}

std::size_t VtkText::place() const {
  return binary ? static_cast<std::size_t>(text.position() - input_->bytes().data()) : text.line();
}

void VtkText::fail(const std::string& cause) const {
  if (binary) input_->fail_byte(place(), cause);
  input_->fail_line(place(), cause);
}

}  // namespace brushfire::detail
