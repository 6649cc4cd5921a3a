// The arrays of VTK XML, decoded: blocks behind their sizes, packed or not, in base64 or not.
#include <brushfire/io/detail/vtk_xml_arrays.h>

#include <brushfire/core/detail/base64.h>
#include <brushfire/io/detail/inflate.h>
#include <brushfire/io/detail/text.h>

#include <algorithm>

namespace brushfire::detail {

namespace {

std::optional<NumberType> type_of(const XmlElement& e) {
  struct Name {
    std::string_view name;
    NumberType type;
  };
  static constexpr Name kNames[]{{"Int8", NumberType::Int8},       {"UInt8", NumberType::UInt8},
                                 {"Int16", NumberType::Int16},     {"UInt16", NumberType::UInt16},
                                 {"Int32", NumberType::Int32},     {"UInt32", NumberType::UInt32},
                                 {"Int64", NumberType::Int64},     {"UInt64", NumberType::UInt64},
                                 {"Float32", NumberType::Float32}, {"Float64", NumberType::Float64}};
  for (const Name& n : kNames) {
    if (n.name == e.attribute("type")) return n.type;
  }
  return std::nullopt;
}

}  // namespace

bool has_numbers(const XmlElement& e) { return type_of(e).has_value(); }

void VtkXmlArrays::read_root(const XmlElement& root) {
  order_ = root.attribute("byte_order") == "BigEndian" ? std::endian::big : std::endian::little;
  header_is_64_ = root.attribute("header_type") == "UInt64";
  compressor_ = compressor_of(root);
}

VtkXmlArrays::Compressor VtkXmlArrays::compressor_of(const XmlElement& root) const {
  const std::string_view name = root.attribute("compressor");
  if (name.empty()) return Compressor::None;
  if (name == "vtkZLibDataCompressor") return Compressor::Zlib;
  if (name == "vtkLZ4DataCompressor") return Compressor::Lz4;
  if (name == "vtkLZMADataCompressor") return Compressor::Xz;
  input_->fail_line(root.line, "compressor " + quote(name) + " is not read, only those of zlib, LZ4 and LZMA");
}

ArrayPlace VtkXmlArrays::place_of(const XmlElement& e) const {
  ArrayPlace a;
  a.name = e.attribute("Name");
  a.format = e.attribute("format");
  const std::optional<NumberType> type = type_of(e);
  if (!type) input_->fail_line(e.line, "numbers of type " + quote(e.attribute("type")) + " are not read");
  a.type = *type;
  a.line = e.line;
  a.components = e.count(*input_, "NumberOfComponents", 1);
  a.begin = a.format == "appended" ? as_size(e.count(*input_, "offset")) : e.text_begin;
  a.end = e.text_end;
  return a;
}

void VtkXmlArrays::find_appended(std::size_t begin) {
  appended_ = begin;
  const std::string_view bytes = input_->bytes();
  if (appended_ >= bytes.size()) return;
  const std::size_t underscore = bytes.find('_', appended_);
  if (underscore == std::string_view::npos) input_->fail_byte(appended_, "appended data does not start with '_'");
  appended_ = underscore + 1;
}

std::vector<double> VtkXmlArrays::numbers(const ArrayPlace& a, std::optional<std::uint64_t> expected) {
  std::vector<double> values;
  if (a.format == "ascii" || a.format.empty()) {
    TextCursor text(*input_, input_->bytes().substr(a.begin, a.end - a.begin), a.line);
    while (text.to_word()) values.push_back(text.number_here("a number"));
  } else {
    const std::vector<char> raw = decode(a);
    spend(a, raw.size());
    values.resize(raw.size() / size_of(a.type));
    load_numbers(a.type, raw.data(), order_, values.size(), values.data());
  }
  if (expected && values.size() != *expected) {
    input_->fail_line(a.line, "the array has " + std::to_string(values.size()) + " numbers, but " +
                                  std::to_string(*expected) + " are needed");
  }
  return values;
}

// Many pieces may name the same appended data: what comes out altogether is bounded by the file's size.
void VtkXmlArrays::spend(const ArrayPlace& a, std::size_t bytes) {
  if (bytes > budget_) input_->fail_line(a.line, "the arrays come to far more than the file's size: refused");
  budget_ -= bytes;
}

std::vector<char> VtkXmlArrays::decode(const ArrayPlace& a) {
  if (a.format == "binary") return decode_base64_block(a, input_->bytes().substr(a.begin, a.end - a.begin));
  if (a.format != "appended") input_->fail_line(a.line, "data of format " + quote(a.format) + " is not read");
  const std::string_view data = input_->bytes().substr(std::min(appended_, input_->size()));
  if (a.begin >= data.size())
    input_->fail_line(a.line, "offset " + std::to_string(a.begin) + " is beyond the appended data");
  if (appended_is_base64_) return decode_base64_block(a, data.substr(a.begin));
  return unpack(a, data.substr(a.begin));
}

std::uint64_t VtkXmlArrays::header_word(std::string_view bytes, std::size_t k) const {
  const char* p = bytes.data() + k * header_size();
  return header_is_64_ ? load<std::uint64_t>(p, order_) : load<std::uint32_t>(p, order_);
}

// Raw bytes: [size] data, or [blocks][block size][last block size][compressed sizes...] data.
std::vector<char> VtkXmlArrays::unpack(const ArrayPlace& a, std::string_view bytes) {
  if (compressor_ == Compressor::None) {
    if (bytes.size() < header_size()) fail_short(a);
    const std::uint64_t size = header_word(bytes, 0);
    bytes.remove_prefix(header_size());
    if (size > bytes.size()) fail_short(a);
    return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)};
  }
  const std::size_t header = compressed_header_size(a, bytes);
  return inflate_blocks(a, bytes.substr(0, header), bytes.substr(header));
}

std::size_t VtkXmlArrays::compressed_header_size(const ArrayPlace& a, std::string_view bytes) const {
  if (bytes.size() < header_size()) fail_short(a);
  const std::uint64_t blocks = header_word(bytes, 0);
  if (bytes.size() / header_size() < 3 || blocks > bytes.size() / header_size() - 3) fail_short(a);
  return as_size(3 + blocks) * header_size();
}

// One block of compressed data into `size` bytes at `target`; an empty string, or what is wrong.
std::string VtkXmlArrays::expand(std::string_view block, char* target, std::size_t size) const {
  if (compressor_ == Compressor::Lz4) return expand_lz4(block, target, size);
  if (compressor_ == Compressor::Xz) return expand_xz(block, target, size);
  return inflate_exactly(block, target, size);
}

// Neither deflate nor LZ4 does better than 1032 to 1; for xz there is no such bound but what the file may inflate to.
bool VtkXmlArrays::can_expand_to(std::size_t size, std::string_view block) const {
  return compressor_ == Compressor::Xz || can_inflate_to(size, block);
}

std::vector<char> VtkXmlArrays::inflate_blocks(const ArrayPlace& a, std::string_view header, std::string_view data) {
  const std::uint64_t blocks = header_word(header, 0), size = header_word(header, 1), last = header_word(header, 2);
  const std::uint64_t whole = blocks == 0 ? 0 : last == 0 ? blocks : blocks - 1;
  const bool too_large =
      (whole != 0 && size > budget_ / whole) || last > budget_ || (blocks != 0 && whole * size > budget_ - last);
  if (too_large) input_->fail_line(a.line, "the array inflates to far more than the file's size: refused");
  std::vector<char> out;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t length = as_size(header_word(header, 3 + b));
    if (length > data.size()) fail_short(a);
    const std::size_t wanted = as_size(b + 1 == blocks && last != 0 ? last : size);
    const std::size_t at = out.size();
    if (!can_expand_to(wanted, data.substr(0, length))) fail_short(a);
    out.resize(at + wanted);
    const std::string error = expand(data.substr(0, length), out.data() + at, wanted);
    if (!error.empty()) input_->fail_line(a.line, "block " + std::to_string(b) + " of the array: " + error);
    data.remove_prefix(length);
  }
  return out;
}

// The header of compressed data is a base64 stream of its own. What follows an array in appended data is the next
// array or the end of the file, so only what is needed is decoded.
std::vector<char> VtkXmlArrays::decode_base64_block(const ArrayPlace& a, std::string_view text) {
  const auto view = [](const std::vector<char>& bytes) { return std::string_view(bytes.data(), bytes.size()); };
  const std::vector<char> start = decode_some(a, text, header_size()).bytes;
  const std::uint64_t first = header_word(view(start), 0);
  if (first > text.size()) fail_short(a);  // bytes of data, or blocks
  if (compressor_ == Compressor::None)
    return unpack(a, view(decode_some(a, text, header_size() + as_size(first)).bytes));
  const std::size_t size = as_size((3 + first) * header_size());
  const Base64Result header = decode_some(a, text, size);
  std::size_t compressed = 0;
  for (std::size_t b = 0; b < first; ++b) {
    const std::size_t length = as_size(header_word(view(header.bytes), 3 + b));
    if (length > text.size() - compressed) fail_short(a);
    compressed += length;
  }
  const Base64Result data = decode_some(a, text.substr(header.consumed), compressed);
  return inflate_blocks(a, view(header.bytes).substr(0, size), view(data.bytes));
}

// At least `size` bytes from the start of the text.
Base64Result VtkXmlArrays::decode_some(const ArrayPlace& a, std::string_view text, std::size_t size) const {
  Base64Result result = decode_base64(text, size);
  if (result.bytes.size() >= size) return result;
  if (!result.ok) input_->fail_line(a.line, "the array's data is not base64");
  fail_short(a);
}

void VtkXmlArrays::fail_short(const ArrayPlace& a) const { input_->fail_line(a.line, "the array's data ends early"); }

}  // namespace brushfire::detail
