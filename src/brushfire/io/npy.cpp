// NumPy's .npy, versions 1 to 3.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/binary.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/input.h>
#include <brushfire/io/detail/output.h>
#include <brushfire/io/npy.h>

#include <cmath>
#include <cstring>

namespace brushfire {

namespace {

using detail::Input;
using detail::load;
using detail::quote;

constexpr std::string_view kMagic{"\x93NUMPY", 6};
constexpr double kLargestExactInteger = 9007199254740992.0;  // 2^53

struct NpyHeader {
  std::string descr;
  bool fortran = false;
  std::vector<std::size_t> shape;
  std::size_t size = 0;  // bytes up to the values
};

// The header is a Python dictionary literal of three known keys; this reads just that.
class HeaderParser {
 public:
  HeaderParser(const Input& input, std::size_t begin, std::size_t end)
      : input_(&input), text_(input.bytes()), at_(begin), end_(end) {}

  void parse(NpyHeader& header) {
    bool has_descr = false, has_order = false, has_shape = false;
    expect('{');
    while (!accept('}')) {
      const std::string key = string();
      expect(':');
      if (key == "descr") {
        if (peek() == '[') fail("records are not read");
        header.descr = string();
        has_descr = true;
      } else if (key == "fortran_order") {
        header.fortran = boolean();
        has_order = true;
      } else if (key == "shape") {
        header.shape = tuple();
        has_shape = true;
      } else {
        fail("the header has the key " + quote(key));
      }
      accept(',');
    }
    if (!has_descr || !has_order || !has_shape) fail("the header lacks descr, fortran_order or shape");
  }

 private:
  char peek() {
    while (at_ < end_ && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
    if (at_ >= end_) fail("the header ends early");
    return text_[at_];
  }
  bool accept(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!accept(c)) fail(quote(text_.substr(at_, 1)) + " where '" + c + "' is expected");
  }
  std::string string() {
    const char mark = peek();
    if (mark != '\'' && mark != '"') fail("a string is expected");
    const std::size_t begin = ++at_;
    while (at_ < end_ && text_[at_] != mark) ++at_;
    if (at_ >= end_) fail("the header ends within a string");
    return std::string(text_.substr(begin, at_++ - begin));
  }
  bool boolean() {
    peek();
    for (const bool value : {true, false}) {
      const std::string_view word = value ? "True" : "False";
      if (text_.substr(at_, word.size()) == word) {
        at_ += word.size();
        return value;
      }
    }
    fail("True or False is expected");
  }
  std::vector<std::size_t> tuple() {
    constexpr std::size_t kMostDimensions = 64;
    std::vector<std::size_t> shape;
    expect('(');
    while (!accept(')')) {
      std::size_t value = 0;
      if (peek() < '0' || peek() > '9') fail("a dimension is expected");
      while (at_ < end_ && text_[at_] >= '0' && text_[at_] <= '9') {
        const auto digit = static_cast<std::size_t>(text_[at_++] - '0');
        if (value > (SIZE_MAX - digit) / 10) fail("a dimension is beyond 64 bits");
        value = 10 * value + digit;
      }
      shape.push_back(value);
      if (shape.size() > kMostDimensions) fail("more than 64 dimensions");
      accept(',');
    }
    return shape;
  }
  [[noreturn]] void fail(const std::string& cause) const { input_->fail_byte(at_, cause); }

  const Input* input_;
  std::string_view text_;
  std::size_t at_, end_;
};

NpyHeader read_header(const Input& input) {
  const std::string_view bytes = input.bytes();
  if (bytes.substr(0, kMagic.size()) != kMagic) input.fail_byte(0, "the file does not start like a .npy file");
  if (bytes.size() < 10) input.fail_byte(bytes.size(), "the file ends within the header");
  const int version = static_cast<unsigned char>(bytes[6]);
  if (version < 1 || version > 3) input.fail_byte(6, "version " + std::to_string(version) + " is not known");
  NpyHeader header;
  std::size_t length = 0;
  std::size_t begin = 10;
  if (version == 1) {
    length = load<std::uint16_t>(bytes.data() + 8, std::endian::little);
  } else {
    begin = 12;
    if (bytes.size() < begin) input.fail_byte(bytes.size(), "the file ends within the header");
    length = load<std::uint32_t>(bytes.data() + 8, std::endian::little);
  }
  if (length > bytes.size() - begin) input.fail_byte(bytes.size(), "the file ends within the header");
  header.size = begin + length;
  HeaderParser(input, begin, header.size).parse(header);
  return header;
}

double half_to_double(std::uint16_t h) {
  const int exponent = (h >> 10) & 31;
  const double mantissa = h & 1023;
  double value = 0;
  if (exponent == 31) {
    value = mantissa == 0 ? kInfinity : std::nan("");
  } else {
    value = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
  }
  return (h & 0x8000) != 0 ? -value : value;
}

template <class T>
void convert(const Input& input, std::size_t begin, std::endian order, std::vector<double>& values) {
  const char* p = input.bytes().data() + begin;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto raw = load<T>(p + k * sizeof(T), order);
    values[k] = static_cast<double>(raw);
    if constexpr (sizeof(T) == 8 && std::is_integral_v<T>) {
      if (std::abs(values[k]) > kLargestExactInteger) {
        input.fail_byte(begin + k * sizeof(T), "the integer " + std::to_string(raw) + " is beyond 2^53");
      }
    }
  }
}

bool convert(const Input& input, const std::string& kind, std::size_t begin, std::endian order,
             std::vector<double>& values) {
  if (kind == "f8") {
    convert<double>(input, begin, order, values);
  } else if (kind == "f4") {
    convert<float>(input, begin, order, values);
  } else if (kind == "f2") {
    convert<std::uint16_t>(input, begin, order, values);
    for (double& v : values) v = half_to_double(static_cast<std::uint16_t>(v));
  } else if (kind == "i8") {
    convert<std::int64_t>(input, begin, order, values);
  } else if (kind == "i4") {
    convert<std::int32_t>(input, begin, order, values);
  } else if (kind == "i2") {
    convert<std::int16_t>(input, begin, order, values);
  } else if (kind == "i1") {
    convert<std::int8_t>(input, begin, order, values);
  } else if (kind == "u8") {
    convert<std::uint64_t>(input, begin, order, values);
  } else if (kind == "u4") {
    convert<std::uint32_t>(input, begin, order, values);
  } else if (kind == "u2") {
    convert<std::uint16_t>(input, begin, order, values);
  } else if (kind == "u1" || kind == "b1") {
    convert<std::uint8_t>(input, begin, order, values);
  } else {
    return false;
  }
  return true;
}

// Fortran order counts the first dimension fastest; the values are put into C order.
void to_c_order(NpyArray& array) {
  std::vector<double> out(array.values.size());
  std::vector<std::size_t> at(array.shape.size(), 0);
  for (double& target : out) {
    std::size_t from = 0;
    for (std::size_t d = array.shape.size(); d-- > 0;) from = from * array.shape[d] + at[d];
    target = array.values[from];
    for (std::size_t d = array.shape.size(); d-- > 0;) {
      if (++at[d] < array.shape[d]) break;
      at[d] = 0;
    }
  }
  array.values = std::move(out);
}

NpyArray read(const Input& input) {
  const NpyHeader header = read_header(input);
  NpyArray array;
  array.shape = header.shape;
  array.type = header.descr;
  const char mark = header.descr.empty() ? '?' : header.descr[0];
  const std::string kind = header.descr.size() == 3 ? header.descr.substr(1) : "";
  const std::string unknown = "numbers of type " + quote(header.descr) + " are not read";
  if (kind.empty() || kind[1] < '1' || kind[1] > '8' || std::strchr("<>|=", mark) == nullptr)
    input.fail_byte(10, unknown);
  const auto item = static_cast<std::size_t>(kind[1] - '0');
  const std::size_t left = input.size() - header.size;
  std::size_t count = 1;
  bool too_many = false, nothing = false;
  for (const std::size_t n : header.shape) nothing = nothing || n == 0;
  for (const std::size_t n : header.shape) {
    too_many = too_many || (!nothing && count > left / n);
    if (!too_many) count *= n;
  }
  if (nothing) count = 0;
  if (too_many || count > left / item) {
    input.fail_byte(header.size,
                    "the shape asks for more values than the " + std::to_string(left) + " bytes that follow");
  }
  if (count * item != left) {
    input.fail_byte(header.size,
                    std::to_string(left) + " bytes follow, but the shape asks for " + std::to_string(count * item));
  }
  array.values.resize(count);
  if (!convert(input, kind, header.size, mark == '>' ? std::endian::big : std::endian::little, array.values)) {
    input.fail_byte(10, unknown);
  }
  if (header.fortran && header.shape.size() > 1) to_c_order(array);
  return array;
}

template <class T>
void write(const detail::Destination& to, std::span<const T> values, std::span<const std::size_t> shape,
           const char* descr) {
  std::size_t product = 1;
  for (const std::size_t n : shape) product *= n;
  if (!shape.empty() && product != values.size()) {
    throw Error(ErrorCode::InvalidArgument, "the shape asks for " + std::to_string(product) +
                                                " values, but there are " + std::to_string(values.size()));
  }
  std::string tuple;
  const std::size_t whole = values.size();
  for (const std::size_t n : shape.empty() ? std::span<const std::size_t>(&whole, 1) : shape) {
    tuple += (tuple.empty() ? "" : " ") + std::to_string(n) + ",";
  }
  if (shape.size() > 1) tuple.pop_back();
  std::string header = std::string("{'descr': '") + descr + "', 'fortran_order': False, 'shape': (" + tuple + "), }";
  constexpr std::size_t kPreamble = 10, kAlignment = 64;
  header.append(kAlignment - 1 - (kPreamble + header.size()) % kAlignment, ' ');
  header += '\n';
  char length[2];
  detail::store(static_cast<std::uint16_t>(header.size()), length, std::endian::little);

  detail::Output out(to);
  out.write(kMagic);
  out.write(std::string_view("\x01\x00", 2));
  out.write(std::string_view(length, 2));
  out.write(header);
  out.values(values, std::endian::little);
  out.commit();
}

std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

void detail::write_npy_to(const Destination& to, std::span<const double> values) { write(to, values, {}, "<f8"); }
void detail::write_npy_to(const Destination& to, std::span<const Index> values) { write(to, values, {}, "<i4"); }

NpyArray read_npy(const std::string& path) { return read(Input::from_file(path)); }

NpyArray read_npy(std::span<const std::byte> content, const std::string& name) {
  return read(Input::from_memory(as_text(content), name));
}

void write_npy(const std::string& path, std::span<const double> values, std::span<const std::size_t> shape) {
  write(detail::Destination{path}, values, shape, "<f8");
}

void write_npy(const std::string& path, std::span<const std::int32_t> values, std::span<const std::size_t> shape) {
  write(detail::Destination{path}, values, shape, "<i4");
}

// The bits of kNoIndex are those of -1.
void write_npy(const std::string& path, std::span<const Index> values, std::span<const std::size_t> shape) {
  write(detail::Destination{path}, values, shape, "<i4");
}

}  // namespace brushfire
