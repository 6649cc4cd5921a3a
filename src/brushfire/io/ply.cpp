// PLY, read: ascii and binary of both byte orders, any property types, faces and triangle strips.
#include <brushfire/io/detail/binary.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/lines_along.h>
#include <brushfire/io/detail/ply.h>
#include <brushfire/io/detail/ply_rows.h>
#include <brushfire/io/detail/text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace brushfire::detail {

namespace {

using ply::AsciiRows;
using ply::BinaryRows;
using ply::Element;
using ply::Encoding;
using ply::Header;
using ply::Property;
using ply::Type;

// Positions of vertices in one stride, each coordinate at an offset of its own.
void convert_positions(const char* block, std::size_t stride, const std::array<std::size_t, 3>& offset,
                       const std::array<Type, 3>& type, std::endian order, std::span<Vec3> out) {
  const auto convert = [&]<class T>(T) {
    for (std::size_t v = 0; v < out.size(); ++v) {
      const char* p = block + v * stride;
      out[v] = {static_cast<double>(load<T>(p + offset[0], order)), static_cast<double>(load<T>(p + offset[1], order)),
                static_cast<double>(load<T>(p + offset[2], order))};
    }
  };
  if (type == std::array{Type::Float64, Type::Float64, Type::Float64}) {
    convert(double{});
  } else if (type == std::array{Type::Float32, Type::Float32, Type::Float32}) {
    convert(float{});
  } else {
    for (std::size_t v = 0; v < out.size(); ++v) {
      const char* p = block + v * stride;
      out[v] = {load_number(type[0], p + offset[0], order), load_number(type[1], p + offset[1], order),
                load_number(type[2], p + offset[2], order)};
    }
  }
}

template <class Rows>
class PlyReader {
 public:
  PlyReader(const Input& input, const Header& header) : rows_(input, header), header_(&header) {}

  MeshParts read() {
    parts_.places_are_lines = header_->encoding == Encoding::Ascii;
    bool has_vertices = false;
    for (const Element& e : header_->elements) {
      if (check_rows(e) == 0) continue;  // rows without properties are nothing
      if (e.name == "vertex") {
        read_vertices(e);
        has_vertices = true;
      } else if (const Property* p = corner_list(e); p != nullptr && e.name == "face") {
        read_faces(e, *p);
      } else if (p != nullptr && e.name == "tristrips") {
        read_strips(e, *p);
      } else {
        skip(e);
      }
    }
    if (!has_vertices) rows_.fail(rows_.place(), "the file has no vertices");
    if (rows_.rows_with_more() != 0) {
      parts_.remarks.push_back(counted(rows_.rows_with_more(), "row has", "rows have") +
                               " more values than the header names: left out");
    }
    if (rows_.has_rest()) parts_.remarks.emplace_back("more follows the last row than the header names: left out");
    return std::move(parts_);
  }

  // The property `name` of vertices or faces; "" takes `quality`, or the first that is no coordinate, normal or colour.
  LoadedField read_field(const std::string& name, ValuesOn on) {
    const std::string_view element = on == ValuesOn::Faces ? "face" : "vertex";
    LoadedField field;
    for (const Element& e : header_->elements) {
      const Property* p = e.name == element ? scalar(e, name) : nullptr;
      check_rows(e);
      if (p != nullptr) {
        field.name = p->name;
        read_column(e, *p, field.values);
        return field;
      }
      if (!e.properties.empty()) skip(e);
    }
    rows_.fail(rows_.place(), (on == ValuesOn::Faces ? "the faces" : "the vertices") + std::string(" have no scalar") +
                                  (name.empty() ? std::string() : " " + quote(name)));
  }

  LoadedLines read_lines() {
    std::vector<std::array<Index, 2>> edges;
    for (const Element& e : header_->elements) {
      if (check_rows(e) == 0) continue;
      if (e.name == "vertex") {
        read_vertices(e);
      } else if (e.name == "edge") {
        read_edges(e, edges);
      } else {
        skip(e);
      }
    }
    return lines_along(parts_.positions, edges);
  }

 private:
  void read_edges(const Element& e, std::vector<std::array<Index, 2>>& edges) {
    const Property *first = e.find("vertex1"), *second = e.find("vertex2");
    if (first == nullptr || second == nullptr || first->is_list || second->is_list) {
      rows_.fail(rows_.place(), "the edges have no properties vertex1 and vertex2");
    }
    for (std::uint64_t row = 0; row < e.count; ++row) {
      rows_.begin_row(e, row);
      const std::size_t place = rows_.place();
      std::array<Index, 2>& edge = edges.emplace_back();
      for (const Property& p : e.properties) {
        if (&p != first && &p != second) {
          skip_property(e, row, p);
          continue;
        }
        const double v = rows_.number(p.type, e, row);
        if (!(v >= 0) || v != std::floor(v) || v >= static_cast<double>(parts_.positions.size())) {
          rows_.fail(place, "edge " + std::to_string(row) + " names vertex " + text_of(v) + ", but there are " +
                                std::to_string(parts_.positions.size()) + " before it");
        }
        edge[&p == first ? 0 : 1] = static_cast<Index>(v);
      }
      rows_.end_row();
    }
  }

  static const Property* scalar(const Element& e, const std::string& name) {
    const Property* p = e.find(name.empty() ? "quality" : name);
    if (p != nullptr) return p->is_list ? nullptr : p;
    if (!name.empty()) return nullptr;
    static constexpr std::string_view kOthers[]{"x",     "y",    "z",     "nx", "ny", "nz", "red",
                                                "green", "blue", "alpha", "s",  "t",  "u",  "v"};
    for (const Property& q : e.properties) {
      if (!q.is_list && std::find(std::begin(kOthers), std::end(kOthers), q.name) == std::end(kOthers)) return &q;
    }
    return nullptr;
  }

  // Returns the fewest bytes of a row, after checking that there are enough for all.
  std::size_t check_rows(const Element& e) const {
    std::size_t shortest_row = 0;
    for (const Property& p : e.properties) shortest_row += Rows::shortest(p);
    rows_.check_promise(e, shortest_row);
    return shortest_row;
  }

  static const Property* corner_list(const Element& e) {
    const Property* p = e.find("vertex_indices");
    if (p == nullptr) p = e.find("vertex_index");
    return p != nullptr && p->is_list ? p : nullptr;
  }

  void read_vertices(const Element& e) {
    std::array<std::size_t, 3> axis{};
    for (std::size_t k = 0; k < 3; ++k) {
      const char name[]{static_cast<char>('x' + k), 0};
      const Property* p = e.find(name);
      if (p == nullptr || p->is_list) rows_.fail(rows_.place(), std::string("the vertices have no property ") + name);
      axis[k] = static_cast<std::size_t>(p - e.properties.data());
    }
    parts_.positions.reserve(as_size(e.count));
    if constexpr (std::is_same_v<Rows, BinaryRows>) {
      if (read_vertices_of_fixed_size(e, axis)) return;
    }
    std::vector<double> row(e.properties.size());
    for (std::uint64_t v = 0; v < e.count; ++v) {
      rows_.begin_row(e, v);
      const std::size_t place = rows_.place();
      for (std::size_t k = 0; k < row.size(); ++k) {
        if (e.properties[k].is_list) {
          skip_list(e, v, e.properties[k]);
        } else {
          row[k] = rows_.number(e.properties[k].type, e, v);
        }
      }
      rows_.end_row();
      add_vertex({row[axis[0]], row[axis[1]], row[axis[2]]}, place);
    }
  }

  void add_vertex(const Vec3& p, std::size_t place) {
    check_finite(p, parts_.positions.size(), place);
    parts_.positions.push_back(p);
  }

  void check_finite(const Vec3& p, std::size_t v, std::size_t place) const {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      rows_.fail(place, "vertex " + std::to_string(v) + " has a coordinate that is not finite");
    }
  }

  // The common case, all vertices in one stride: one block of bytes, each coordinate converted in a loop of its own.
  bool read_vertices_of_fixed_size(const Element& e, const std::array<std::size_t, 3>& axis) {
    std::size_t stride = 0;
    std::array<std::size_t, 3> offset{};
    for (std::size_t k = 0; k < e.properties.size(); ++k) {
      if (e.properties[k].is_list) return false;
      for (std::size_t a = 0; a < 3; ++a) {
        if (axis[a] == k) offset[a] = stride;
      }
      stride += size_of(e.properties[k].type);
    }
    const std::size_t begin = rows_.place();
    const std::size_t count = as_size(e.count);
    const char* block = rows_.take(as_size(std::uint64_t{stride} * e.count), e, e.count);
    const std::array<Type, 3> type{e.properties[axis[0]].type, e.properties[axis[1]].type, e.properties[axis[2]].type};
    const std::size_t first = parts_.positions.size();
    parts_.positions.resize(first + count);
    Vec3* out = parts_.positions.data() + first;
    convert_positions(block, stride, offset, type, rows_.order(), {out, count});
    for (std::size_t v = 0; v < count; ++v) check_finite(out[v], first + v, begin + v * stride);
    return true;
  }

  // The entries of the list property at hand.
  std::size_t list_length(const Element& e, std::uint64_t row, const Property& p) {
    const std::size_t place = rows_.place();
    const double n = rows_.number(p.count_type, e, row);
    // In text a list may claim any length; each entry has to follow, so nothing is taken on trust.
    if (!(n >= 0) || n != std::floor(n) || n > 4294967295.0) {
      rows_.fail(place, "a list of element " + quote(e.name) + " has " + text_of(n) + " entries");
    }
    return static_cast<std::size_t>(n);
  }

  static std::string text_of(double n) {
    if (n == std::floor(n) && std::abs(n) < 1e15) return std::to_string(static_cast<std::int64_t>(n));
    return std::to_string(n);
  }

  void skip_list(const Element& e, std::uint64_t row, const Property& p) {
    const std::size_t n = list_length(e, row, p);
    if constexpr (std::is_same_v<Rows, BinaryRows>) {
      rows_.take(n * size_of(p.type), e, row);
    } else {
      for (std::size_t k = 0; k < n; ++k) rows_.number(p.type, e, row);
    }
  }

  void skip_property(const Element& e, std::uint64_t row, const Property& p) {
    if (p.is_list) {
      skip_list(e, row, p);
    } else {
      rows_.number(p.type, e, row);
    }
  }

  // One number of every row.
  void read_column(const Element& e, const Property& wanted, std::vector<double>& values) {
    for (std::uint64_t row = 0; row < e.count; ++row) {
      rows_.begin_row(e, row);
      for (const Property& p : e.properties) {
        if (&p == &wanted) {
          values.push_back(rows_.number(p.type, e, row));
        } else {
          skip_property(e, row, p);
        }
      }
      rows_.end_row();
    }
  }

  void skip(const Element& e) {
    for (std::uint64_t row = 0; row < e.count; ++row) {
      rows_.begin_row(e, row);
      for (const Property& p : e.properties) skip_property(e, row, p);
      rows_.end_row();
    }
  }

  // Calls use(entries, place) for the list `wanted` of every row.
  template <class Use>
  void for_each_list(const Element& e, const Property& wanted, double lowest, Use use) {
    std::vector<double> entries;
    for (std::uint64_t row = 0; row < e.count; ++row) {
      rows_.begin_row(e, row);
      const std::size_t place = rows_.place();
      for (const Property& p : e.properties) {
        if (&p != &wanted) {
          skip_property(e, row, p);
          continue;
        }
        const std::size_t n = list_length(e, row, p);
        entries.clear();
        for (std::size_t k = 0; k < n; ++k) {
          const double v = rows_.number(p.type, e, row);
          if (!(v >= lowest) || v != std::floor(v) || v >= static_cast<double>(kNoIndex)) {
            rows_.fail(place,
                       "row " + std::to_string(row) + " of element " + quote(e.name) + " names vertex " + text_of(v));
          }
          entries.push_back(v);
        }
        use(entries, place);
      }
      rows_.end_row();
    }
  }

  void read_faces(const Element& e, const Property& list) {
    parts_.faces.reserve(as_size(e.count));
    std::uint64_t done = 0;
    if constexpr (std::is_same_v<Rows, BinaryRows>) {
      if (e.properties.size() == 1 && list.count_type <= Type::UInt8 &&
          (list.type == Type::Int32 || list.type == Type::UInt32)) {
        done = read_leading_triangles(e);
      }
    }
    std::vector<Index> corners;
    Element rest = e;  // the rows that are left
    rest.count -= done;
    const Property& same = *corner_list(rest);
    for_each_list(rest, same, 0, [&](const std::vector<double>& entries, std::size_t place) {
      corners.resize(entries.size());
      for (std::size_t k = 0; k < entries.size(); ++k) corners[k] = static_cast<Index>(entries[k]);
      parts_.faces.add(corners, place);
    });
  }

  // Rows "3 a b c" of 13 bytes, up to the first that is something else.
  std::uint64_t read_leading_triangles(const Element& e) {
    constexpr std::size_t kRow = 13;
    const std::endian order = rows_.order();
    std::uint64_t row = 0;
    for (; row < e.count; ++row) {
      const std::size_t place = rows_.place();
      const char* p = rows_.peek(kRow);
      if (p == nullptr || *p != 3) break;
      const Index a = load<Index>(p + 1, order), b = load<Index>(p + 5, order), c = load<Index>(p + 9, order);
      if (std::max({a, b, c}) == kNoIndex) break;
      parts_.faces.add_triangle(a, b, c, place);
      rows_.take(kRow, e, row);
    }
    return row;
  }

  // Strips of triangles, -1 ends one; every other triangle is turned round. Triangles that repeat a vertex only steer
  // the strip and are left out.
  void read_strips(const Element& e, const Property& list) {
    for_each_list(e, list, -1, [&](const std::vector<double>& entries, std::size_t place) {
      std::size_t begin = 0;
      for (std::size_t k = 0; k < entries.size(); ++k) {
        if (entries[k] < 0) {
          begin = k + 1;
        } else if (k >= begin + 2) {
          const auto a = static_cast<Index>(entries[k - 2]), b = static_cast<Index>(entries[k - 1]),
                     c = static_cast<Index>(entries[k]);
          if (a == b || b == c || c == a) continue;
          const bool turned = (k - begin) % 2 != 0;
          parts_.faces.add_triangle(turned ? b : a, turned ? a : b, c, place);
        }
      }
    });
  }

  Rows rows_;
  const Header* header_;
  MeshParts parts_;
};

LoadedField read_field_on(const Input& input, const std::string& name, ValuesOn on) {
  const Header header = ply::read_header(input);
  if (header.encoding == Encoding::Ascii) return PlyReader<AsciiRows>(input, header).read_field(name, on);
  return PlyReader<BinaryRows>(input, header).read_field(name, on);
}

}  // namespace

MeshParts read_ply(const Input& input) {
  const Header header = ply::read_header(input);
  if (header.encoding == Encoding::Ascii) return PlyReader<AsciiRows>(input, header).read();
  return PlyReader<BinaryRows>(input, header).read();
}

LoadedField read_ply_field(const Input& input, const std::string& name) {
  return read_field_on(input, name, ValuesOn::Vertices);
}

LoadedField read_ply_face_field(const Input& input, const std::string& name) {
  return read_field_on(input, name, ValuesOn::Faces);
}

LoadedLines read_ply_lines(const Input& input) {
  const Header header = ply::read_header(input);
  if (header.encoding == Encoding::Ascii) return PlyReader<AsciiRows>(input, header).read_lines();
  return PlyReader<BinaryRows>(input, header).read_lines();
}

}  // namespace brushfire::detail
