// STL, ascii and binary: triangles without shared vertices, welded where coordinates are exactly equal.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/binary.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/text.h>

#include <array>
#include <bit>
#include <cmath>

namespace brushfire::detail {

namespace {

constexpr std::size_t kHeader = 84, kRow = 50;  // bytes: 80 free ones and the count; normal, corners, attribute

// Numbers points by their exact coordinates, in the order in which they come. Open addressing; the slot keeps part of
// the hash, so that a point is looked at only where it is almost certainly the same.
class Welder {
 public:
  explicit Welder(std::vector<Vec3>& points) : points_(&points), slots_(kSmallest) {}

  // -0 and 0 are the same place, and become 0.
  static Vec3 without_minus_zero(Vec3 p) { return {p.x + 0.0, p.y + 0.0, p.z + 0.0}; }

  static std::uint64_t hash(const Vec3& p) {
    std::uint64_t h = 0;
    for (const double c : {p.x, p.y, p.z}) {
      h = (h ^ std::bit_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15u;
      h ^= h >> 32;
    }
    return h;
  }

  void prefetch(std::uint64_t hash) const {
#if defined(__GNUC__)
    __builtin_prefetch(&slots_[hash & (slots_.size() - 1)]);
#else
    static_cast<void>(hash);
#endif
  }

  Index number(const Vec3& p, std::uint64_t hash) {
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = hash & mask;
    for (; slots_[at].index != kNoIndex; at = (at + 1) & mask) {
      if (slots_[at].tag == tag && (*points_)[slots_[at].index] == p) return slots_[at].index;
    }
    const auto index = static_cast<Index>(points_->size());
    slots_[at] = {tag, index};
    points_->push_back(p);
    if (2 * points_->size() > slots_.size()) grow();
    return index;
  }

 private:
  struct Slot {
    std::uint32_t tag = 0;
    Index index = kNoIndex;
  };
  static constexpr std::size_t kSmallest = 1024;

  void grow() {
    std::vector<Slot> larger(2 * slots_.size());
    const std::size_t mask = larger.size() - 1;
    for (const Slot& s : slots_) {
      if (s.index == kNoIndex) continue;
      std::size_t at = hash((*points_)[s.index]) & mask;
      while (larger[at].index != kNoIndex) at = (at + 1) & mask;
      larger[at] = s;
    }
    slots_ = std::move(larger);
  }

  std::vector<Vec3>* points_;
  std::vector<Slot> slots_;
};

std::size_t triangles_of_binary(std::string_view bytes) {
  return bytes.size() < kHeader ? 0 : load<std::uint32_t>(bytes.data() + 80, std::endian::little);
}

// Some programs leave a few bytes behind the last triangle. Text cannot be mistaken for that: its bytes 80 to 83 would
// promise more than a hundred million triangles.
constexpr std::size_t kMostTrailing = 84;

bool has_binary_size(std::string_view bytes, std::size_t most_trailing) {
  if (bytes.size() < kHeader) return false;
  const std::size_t there = bytes.size() - kHeader, promised = triangles_of_binary(bytes) * kRow;
  return promised <= there && there - promised <= most_trailing;
}

bool starts_with_solid(std::string_view bytes) {
  const std::string_view text = text_start(bytes);
  std::string word(text.substr(0, 5));
  for (char& c : word) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return word == "solid" && text.size() > 5 && TextCursor::is_space(text[5]);
}

MeshParts read_binary(const Input& input) {
  const std::string_view bytes = input.bytes();
  if (bytes.size() < kHeader) input.fail_byte(bytes.size(), "the file ends within the 84 bytes of a binary STL header");
  const std::size_t triangles = triangles_of_binary(bytes), there = (bytes.size() - kHeader) / kRow;
  if (triangles > there) {
    input.fail_byte(80, "the header promises " + std::to_string(triangles) + " triangles, but only " +
                            std::to_string(there) + " follow");
  }
  MeshParts parts;
  parts.places_are_lines = false;
  if (const std::size_t beyond = bytes.size() - kHeader - triangles * kRow; beyond != 0) {
    parts.remarks.push_back(counted(beyond, "byte", "bytes") + " behind the last triangle left out");
  }
  parts.faces.reserve(triangles);
  parts.vertex_map.resize(3 * triangles);
  parts.positions.reserve(triangles / 2 + 3);
  Welder welder(parts.positions);
  // A few triangles at a time: their slots are on the way from memory before they are needed.
  constexpr std::size_t kBatch = 16;
  std::array<Vec3, 3 * kBatch> points;
  std::array<std::uint64_t, 3 * kBatch> hashes;
  for (std::size_t first = 0; first < triangles; first += kBatch) {
    const std::size_t n = std::min(kBatch, triangles - first);
    for (std::size_t k = 0; k < 3 * n; ++k) {
      const std::size_t at = kHeader + (first + k / 3) * kRow + 12 + 12 * (k % 3);
      const char* p = bytes.data() + at;
      float c[3];
      for (std::size_t i = 0; i < 3; ++i) c[i] = load<float>(p + 4 * i, std::endian::little);
      if (!std::isfinite(c[0]) || !std::isfinite(c[1]) || !std::isfinite(c[2])) {
        input.fail_byte(at, "triangle " + std::to_string(first + k / 3) + " has a coordinate that is not finite");
      }
      points[k] = Welder::without_minus_zero({c[0], c[1], c[2]});
      hashes[k] = Welder::hash(points[k]);
      welder.prefetch(hashes[k]);
    }
    for (std::size_t k = 0; k < 3 * n; ++k) parts.vertex_map[3 * first + k] = welder.number(points[k], hashes[k]);
    for (std::size_t f = first; f < first + n; ++f) {
      parts.faces.add_triangle(parts.vertex_map[3 * f], parts.vertex_map[3 * f + 1], parts.vertex_map[3 * f + 2],
                               kHeader + f * kRow);
    }
  }
  return parts;
}

class AsciiReader {
 public:
  explicit AsciiReader(const Input& input) : text_(input, input.bytes()), welder_(parts_.positions) {}

  MeshParts read() {
    std::size_t solids = 0;
    while (text_.to_word()) {
      expect("solid");
      text_.skip_to_end_of_line();  // a name
      read_facets();
      ++solids;
    }
    if (solids > 1) parts_.remarks.push_back(std::to_string(solids) + " solids merged");
    return std::move(parts_);
  }

 private:
  void read_facets() {
    while (true) {
      const std::string_view word = next_word("endsolid");
      if (word == "endsolid") break;
      if (word != "facet") text_.fail(quote(word) + " where facet or endsolid is expected");
      const std::size_t line = text_.line();
      // The normal may be wrong or no number at all, and is not needed.
      while (next_word("outer") != "outer") {
        if (word_ == "vertex" || word_ == "endfacet") text_.fail(quote(word_) + " where outer is expected");
      }
      expect("loop");
      std::array<Index, 3> corner;
      for (Index& v : corner) {
        expect("vertex");
        const Vec3 p = Welder::without_minus_zero(text_.point());
        v = welder_.number(p, Welder::hash(p));
        parts_.vertex_map.push_back(v);
      }
      parts_.faces.add_triangle(corner[0], corner[1], corner[2], line);
      expect("endloop");
      expect("endfacet");
    }
    text_.skip_to_end_of_line();
  }

  // Keywords are lower case in the format's description, and upper case in some files.
  std::string_view next_word(const char* expected) {
    word_ = text_.word();
    for (char& c : word_) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    if (word_.empty()) text_.fail_end(expected);
    return word_;
  }
  void expect(const char* keyword) {
    const std::string_view word = next_word(keyword);
    if (word != keyword) text_.fail(quote(word) + " where " + keyword + " is expected");
  }

  TextCursor text_;
  MeshParts parts_;
  Welder welder_;
  std::string word_;
};

}  // namespace

bool is_binary_stl(std::string_view bytes) { return has_binary_size(bytes, 0) && triangles_of_binary(bytes) != 0; }

bool is_stl(std::string_view bytes) { return starts_with_solid(bytes) || is_binary_stl(bytes); }

// Some binary files start with "solid" too: the size decides.
MeshParts read_stl(const Input& input) {
  if (!has_binary_size(input.bytes(), kMostTrailing) && starts_with_solid(input.bytes())) {
    return AsciiReader(input).read();
  }
  return read_binary(input);
}

}  // namespace brushfire::detail
