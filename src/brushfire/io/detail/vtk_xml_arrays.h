// The arrays of VTK XML: text, base64 and appended data, raw or compressed by zlib, LZ4 or LZMA.
#pragma once

#include <brushfire/io/detail/input.h>
#include <brushfire/io/detail/numbers.h>
#include <brushfire/io/detail/xml.h>

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace brushfire::detail {

struct Base64Result;

// Where an array stands, before it is decoded.
struct ArrayPlace {
  std::string name, format;
  NumberType type = NumberType::Float64;
  std::size_t line = 0, begin = 0, end = 0;  // bytes of the text, or of the appended data
  std::uint64_t components = 1;
};

// Whether a <DataArray> holds numbers of a type that is read; strings and bits are not.
bool has_numbers(const XmlElement& e);

// All throw Error(FileMalformed) with the array's line. `input` must outlive the object.
class VtkXmlArrays {
 public:
  explicit VtkXmlArrays(const Input& input) : input_(&input), budget_(input.inflate_budget()) {}

  // What <VTKFile> says of byte order, sizes and compressor.
  void read_root(const XmlElement& root);
  // What <AppendedData> says of its encoding.
  void read_encoding(const XmlElement& appended) { appended_is_base64_ = appended.attribute("encoding") == "base64"; }
  // Where the appended data begins: behind the underscore from byte `begin` on; beyond the file where there is none.
  void find_appended(std::size_t begin);

  ArrayPlace place_of(const XmlElement& e) const;

  // The values of an array: `expected` of them, or as many as there are.
  std::vector<double> numbers(const ArrayPlace& a, std::optional<std::uint64_t> expected = std::nullopt);

 private:
  enum class Compressor : std::uint8_t { None, Zlib, Lz4, Xz };

  Compressor compressor_of(const XmlElement& root) const;
  void spend(const ArrayPlace& a, std::size_t bytes);
  std::vector<char> decode(const ArrayPlace& a);
  std::size_t header_size() const { return header_is_64_ ? 8 : 4; }
  std::uint64_t header_word(std::string_view bytes, std::size_t k) const;
  std::vector<char> unpack(const ArrayPlace& a, std::string_view bytes);
  std::size_t compressed_header_size(const ArrayPlace& a, std::string_view bytes) const;
  std::string expand(std::string_view block, char* target, std::size_t size) const;
  bool can_expand_to(std::size_t size, std::string_view block) const;
  std::vector<char> inflate_blocks(const ArrayPlace& a, std::string_view header, std::string_view data);
  std::vector<char> decode_base64_block(const ArrayPlace& a, std::string_view text);
  Base64Result decode_some(const ArrayPlace& a, std::string_view text, std::size_t size) const;
  [[noreturn]] void fail_short(const ArrayPlace& a) const;

  const Input* input_;
  std::size_t budget_;
  std::size_t appended_ = 0;
  bool header_is_64_ = false, appended_is_base64_ = false;
  Compressor compressor_ = Compressor::None;
  std::endian order_ = std::endian::little;
};

}  // namespace brushfire::detail
