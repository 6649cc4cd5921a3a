// MEDIT .meshb (binary, versions 1 to 4): vertices, triangles and quadrilaterals; everything else is passed over.
//
// Based on: L. Marechal, The GMF libraries, the file format of libMeshb (INRIA).
#include <brushfire/io/detail/binary.h>
#include <brushfire/io/detail/formats.h>

#include <array>
#include <bit>
#include <cmath>

namespace brushfire::detail {

namespace {

// A file starts with the number 1, whose bytes tell the order of all others, and a version that tells their sizes:
// floats up to version 1, doubles from 2; places in the file of 64 bits from 3; whole numbers of 64 bits from 4.
class MeditBinary {
 public:
  explicit MeditBinary(const Input& input) : input_(&input) {}

  MeshParts read() {
    parts_.places_are_lines = false;
    parts_.counts_from = 1;
    read_start();
    // Each section names where the next one stands; they only ever go forward, so that the walk ends.
    while (at_ != 0) {
      const std::int32_t keyword = int32();
      const std::int64_t next = version_ >= 3 ? int64() : int32();
      if (keyword == kEnd) break;
      if (next != 0 && (next <= static_cast<std::int64_t>(at_) || static_cast<std::uint64_t>(next) > input_->size())) {
        fail("the place of the next section is " + std::to_string(next));
      }
      read_section(keyword);
      at_ = static_cast<std::size_t>(next);
    }
    if (!has_vertices_) input_->fail("the file has no vertices");
    return std::move(parts_);
  }

 private:
  static constexpr std::int32_t kDimension = 3, kVertices = 4, kTriangles = 6, kQuadrilaterals = 7, kEnd = 54;

  void read_start() {
    order_ = std::endian::little;
    if (int32() != 1) {
      at_ = 0;
      order_ = std::endian::big;
      if (int32() != 1) fail("the file does not start with the number 1");
    }
    version_ = int32();
    if (version_ < 1 || version_ > 4) fail("version " + std::to_string(version_) + " is not read, only 1 to 4");
  }

  void read_section(std::int32_t keyword) {
    if (keyword == kDimension) {
      dimension_ = int32();
      if (dimension_ != 2 && dimension_ != 3) {
        fail("dimension " + std::to_string(dimension_) + " is not read, only 2 and 3");
      }
    } else if (keyword == kVertices) {
      read_vertices();
    } else if (keyword == kTriangles || keyword == kQuadrilaterals) {
      read_faces(keyword == kTriangles ? 3 : 4);
    }
  }

  void read_vertices() {
    const std::size_t real = version_ == 1 ? 4 : 8, dimension = static_cast<std::size_t>(dimension_);
    const std::size_t n = count(dimension * real + whole_size());
    parts_.positions.reserve(parts_.positions.size() + n);
    for (std::size_t v = 0; v < n; ++v) {
      const std::size_t place = at_;
      std::array<double, 3> c{};
      for (std::size_t k = 0; k < dimension; ++k) {
        c[k] = real == 4 ? load<float>(take(4), order_) : load<double>(take(8), order_);
        if (!std::isfinite(c[k])) {
          input_->fail_byte(place, "vertex " + std::to_string(v + 1) + " has a coordinate that is not finite");
        }
      }
      take(whole_size());  // a reference
      parts_.positions.push_back({c[0], c[1], c[2]});
    }
    has_vertices_ = true;
  }

  void read_faces(std::size_t corners) {
    const std::size_t n = count((corners + 1) * whole_size());
    std::array<Index, 4> v{};
    for (std::size_t f = 0; f < n; ++f) {
      const std::size_t place = at_;
      for (std::size_t k = 0; k < corners; ++k) {
        const std::int64_t number = whole();
        if (number < 1 || number > static_cast<std::int64_t>(kNoIndex)) {
          input_->fail_byte(place, "a face names vertex " + std::to_string(number) + ", but they count from 1");
        }
        v[k] = static_cast<Index>(number - 1);
      }
      take(whole_size());  // a reference
      parts_.faces.add(std::span<const Index>(v).first(corners), place);
    }
  }

  const char* take(std::size_t size) {
    if (size > input_->size() - at_) input_->fail_byte(input_->size(), "the file ends within a section");
    at_ += size;
    return input_->bytes().data() + at_ - size;
  }
  std::int32_t int32() { return load<std::int32_t>(take(4), order_); }
  std::int64_t int64() { return load<std::int64_t>(take(8), order_); }
  std::size_t whole_size() const { return version_ >= 4 ? 8 : 4; }
  std::int64_t whole() { return version_ >= 4 ? int64() : int32(); }
  // A count of rows of `bytes_each` bytes, all of which must be there.
  std::size_t count(std::size_t bytes_each) {
    const std::int64_t n = whole();
    if (n < 0 || static_cast<std::uint64_t>(n) > (input_->size() - at_) / bytes_each) {
      fail(std::to_string(n) + " rows are promised, but only " + std::to_string(input_->size() - at_) +
           " bytes follow");
    }
    return static_cast<std::size_t>(n);
  }
  [[noreturn]] void fail(const std::string& cause) const { input_->fail_byte(at_, cause); }

  const Input* input_;
  std::size_t at_ = 0;
  std::endian order_ = std::endian::little;
  std::int32_t version_ = 0, dimension_ = 3;
  MeshParts parts_;
  bool has_vertices_ = false;
};

}  // namespace

// The number 1 and a version, in either byte order.
bool is_medit_binary(std::string_view bytes) {
  if (bytes.size() < 8) return false;
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const auto version = load<std::int32_t>(bytes.data() + 4, order);
    // NOLINTNEXTLINE(bugprone-suspicious-stringview-data-usage): its size was looked at
    if (load<std::int32_t>(bytes.data(), order) == 1 && version >= 1 && version <= 4) return true;
  }
  return false;
}

MeshParts read_medit_binary(const Input& input) { return MeditBinary(input).read(); }

}  // namespace brushfire::detail
