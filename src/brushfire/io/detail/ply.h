// PLY: the header, and access to the rows of its elements, for meshes and for vertex scalars.
#pragma once

#include <brushfire/io/detail/input.h>
#include <brushfire/io/detail/numbers.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace brushfire::detail::ply {

using Type = NumberType;

struct Property {
  std::string name;
  Type type = Type::Float32;
  bool is_list = false;
  Type count_type = Type::UInt8;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::size_t line = 0;  // of the header
  std::vector<Property> properties;

  // `property` in lower case; the file may write it in capitals.
  const Property* find(std::string_view property) const;
};

enum class Encoding : std::uint8_t { Ascii, Little, Big };

struct Header {
  Encoding encoding = Encoding::Ascii;
  std::vector<Element> elements;
  std::size_t size = 0;   // bytes up to the first row
  std::size_t lines = 0;  // lines up to the first row

  std::endian order() const { return encoding == Encoding::Big ? std::endian::big : std::endian::little; }
};

Header read_header(const Input& input);

}  // namespace brushfire::detail::ply
