// Reading of places.
#include "where.h"

#include <brushfire/mesh/nearest_point.h>

#include <brushfire/core/error.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>

namespace brushfire::tool {
namespace {

// At most forty characters, and of these no raw bytes: what was given may be a binary file.
std::string quote(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string out = "'";
  for (const unsigned char c : text.substr(0, kLongest)) {
    static constexpr char kHex[] = "0123456789abcdef";
    if (c >= 0x20 && c < 0x7f) {
      out += static_cast<char>(c);
    } else {
      out += std::string("\\x") + kHex[c >> 4] + kHex[c & 15];
    }
  }
  return out + (text.size() > kLongest ? "...'" : "'");
}

[[noreturn]] void refuse(std::string_view text, const char* why) {
  throw Error(ErrorCode::InvalidArgument,
              quote(text) + " is no place on a mesh: " + why +
                  "; write a vertex (17), a face and weights (f:120:.2,.3,.5) or a position (x,y,z)");
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

// Takes a line off the text: up to LF, CR LF or CR.
std::string_view next_line(std::string_view& text) {
  const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
  const std::string_view line = text.substr(0, end);
  const std::size_t mark = text.substr(end, 2) == "\r\n" ? 2 : 1;
  text.remove_prefix(std::min(end + mark, text.size()));
  return line;
}

// The whole text as a finite number, or nothing.
std::optional<double> number(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

// The whole text as a count; one too large for 64 bits reads as the largest: it is out of range either way.
std::optional<std::uint64_t> whole(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || text.empty()) return {};
  if (error == std::errc::result_out_of_range) return UINT64_MAX;
  return error == std::errc{} ? std::optional(value) : std::nullopt;
}

std::optional<std::array<double, 3>> three_numbers(std::string_view text) {
  std::array<double, 3> values{};
  for (int k = 0; k < 3; ++k) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (k == 2)) return {};
    const std::optional<double> value = number(text.substr(0, comma));
    if (!value) return {};
    values[k] = *value;
    if (k < 2) text.remove_prefix(comma + 1);
  }
  return values;
}

}  // namespace

Where parse_where(std::string_view text) {
  Where where;
  where.text = trimmed(text);
  std::string_view place = where.text;
  if (const std::size_t at = place.find('@'); at != std::string_view::npos) {
    const std::optional<double> offset = number(place.substr(at + 1));
    if (!offset) refuse(where.text, "what follows @ is not a number");
    where.offset = *offset;
    where.has_offset = true;
    place = trimmed(place.substr(0, at));
  }
  if (place.empty()) refuse(where.text, "it is empty");
  if (place.starts_with("f:")) {
    const std::size_t colon = place.find(':', 2);
    if (colon == std::string_view::npos) refuse(where.text, "the weights are missing");
    const std::optional<std::uint64_t> face = whole(place.substr(2, colon - 2));
    if (!face) refuse(where.text, "the face is not a number");
    const auto weights = three_numbers(place.substr(colon + 1));
    if (!weights) refuse(where.text, "the weights are not three numbers");
    where.place = FacePlace{*face, *weights};
  } else if (place.find(',') != std::string_view::npos) {
    const auto xyz = three_numbers(place);
    if (!xyz) refuse(where.text, "a position is three numbers");
    where.place = Vec3{(*xyz)[0], (*xyz)[1], (*xyz)[2]};
  } else {
    const std::optional<std::uint64_t> vertex = whole(place);
    if (!vertex) refuse(where.text, "a vertex is a whole number from 0 up");
    where.place = VertexPlace{*vertex};
  }
  return where;
}

std::vector<Where> read_where_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ErrorCode::FileNotReadable, path + ": cannot be opened");
  std::string bytes;
  for (char block[4096]; file.read(block, sizeof block), file.gcount() > 0;) {
    bytes.append(block, static_cast<std::size_t>(file.gcount()));
  }
  std::string_view rest = bytes;
  if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);  // a byte order mark
  std::vector<Where> places;
  for (int number = 1; !rest.empty(); ++number) {
    const std::string_view line = next_line(rest);
    const std::string_view content = trimmed(line.substr(0, line.find('#')));
    if (content.empty()) continue;
    try {
      places.push_back(parse_where(content));
    } catch (const Error& e) {
      throw Error(e.code(), path + ":" + std::to_string(number) + ": " + e.what());
    }
  }
  if (file.bad()) throw Error(ErrorCode::FileNotReadable, path + ": cannot be read");
  return places;
}

Snap snapper(const Mesh& mesh) {
  const auto finder = std::make_shared<std::optional<NearestPointFinder>>();
  return [mesh, finder](Vec3 position) {
    if (!*finder) finder->emplace(mesh);
    return (**finder)(position).point;
  };
}

SurfacePoint resolve(const Where& where, const Mesh& mesh, const Snap& snap) {
  const auto in_range = [&](std::uint64_t index, Index count, const char* what) {
    if (index < count) return static_cast<Index>(index);
    throw Error(ErrorCode::IndexOutOfRange,
                quote(where.text) + ": there is no such " + what + ", the mesh has " + std::to_string(count));
  };
  if (const auto* vertex = std::get_if<VertexPlace>(&where.place)) {
    return vertex_point(mesh, in_range(vertex->index, mesh.vertex_count(), "vertex"));
  }
  if (const auto* in_face = std::get_if<FacePlace>(&where.place)) {
    const SurfacePoint point{in_range(in_face->face, mesh.face_count(), "face"), in_face->weights};
    locate(mesh, point);
    return point;
  }
  return snap(std::get<Vec3>(where.place));
}

}  // namespace brushfire::tool
