// Reading of places.
#include "where.h"

#include "curves.h"
#include "text_lines.h"

#include <brushfire/core/error.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace brushfire::tool {
namespace {

[[noreturn]] void refuse(std::string_view text, const char* why) {
  throw Error(ErrorCode::InvalidArgument,
              in_quotes(text) + " is no place on a mesh: " + why +
                  "; write a vertex (17), a face and weights (f:120:.2,.3,.5) or a position (at:1.5,0,-2)");
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
  const std::optional<std::vector<double>> values = decimals(text);
  if (!values || values->size() != 3) return {};
  return std::array{(*values)[0], (*values)[1], (*values)[2]};
}

// Up to the last @ that a number follows: file names may have others.
std::string_view without_offset(std::string_view text) {
  const std::size_t at = text.rfind('@');
  return at != std::string_view::npos && decimal(text.substr(at + 1)) ? trimmed(text.substr(0, at)) : text;
}

// Numbers of vertices and commas, with @ and what follows it.
bool is_list(std::string_view text) {
  if (text.starts_with("f:") || text.starts_with("at:") || parse_curve(without_offset(text))) return false;
  return text.find('@') != std::string_view::npos || text.find_first_not_of("0123456789, \t") == std::string_view::npos;
}

}  // namespace

Where parse_where(std::string_view text) {
  Where where;
  where.text = trimmed(text);
  std::string_view place = where.text;
  if (std::optional<CurvePlace> curve = parse_curve(without_offset(place))) {
    const std::string_view name = without_offset(place);
    where.has_offset = name.size() < place.size();
    if (where.has_offset) where.offset = *decimal(place.substr(place.rfind('@') + 1));
    where.place = std::move(*curve);
    return where;
  }
  if (const std::size_t at = place.find('@'); at != std::string_view::npos) {
    const std::optional<double> offset = decimal(place.substr(at + 1));
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
  } else if (place.starts_with("at:")) {
    const auto xyz = three_numbers(place.substr(3));
    if (!xyz) refuse(where.text, "a position is three numbers");
    where.place = Vec3{(*xyz)[0], (*xyz)[1], (*xyz)[2]};
  } else if (place.find(',') != std::string_view::npos) {
    refuse(where.text, is_list(place) ? "one place is needed here, and several numbers are several vertices"
                                      : "a position begins with at:");
  } else {
    const std::optional<std::uint64_t> vertex = whole(place);
    if (!vertex) refuse(where.text, "a vertex is a whole number from 0 up");
    where.place = VertexPlace{*vertex};
  }
  return where;
}

std::vector<std::string> split_places(const std::vector<std::string>& texts) {
  std::vector<std::string> places;
  for (const std::string& text : texts) {
    const std::string_view list = trimmed(text);
    // Other commas stand between numbers that belong together.
    if (!is_list(list)) {
      places.emplace_back(list);
      continue;
    }
    for (std::size_t begin = 0; begin <= list.size();) {
      const std::size_t end = std::min(list.find(',', begin), list.size());
      places.emplace_back(list.substr(begin, end - begin));
      begin = end + 1;
    }
  }
  return places;
}

std::vector<Where> read_where_file(const std::string& path, bool or_curves) {
  constexpr std::size_t kMost = 10'000'000;
  TextLines lines(path);
  const auto fail = [&](const std::string& what) { throw Error(ErrorCode::InvalidArgument, lines.here() + what); };
  std::vector<Where> places;
  for (std::string line; lines.next(line);) {
    const std::string_view content = trimmed(std::string_view(line).substr(0, line.find('#')));
    if (content.empty()) continue;
    if (places.size() == kMost) fail("more than ten million places");
    try {
      for (const std::string& place : split_places({std::string(content)})) places.push_back(parse_where(place));
    } catch (const Error& e) {
      const bool of_curves =
          or_curves && places.empty() && parse_curve(path).value_or(CurvePlace{}).kind == CurvePlace::Kind::File;
      fail(of_curves ? e.what() + ("; a file of curves is a source by its name: --source " + path) : e.what());
    }
  }
  return places;
}

SurfacePoint resolve(const Where& where, const Mesh& mesh, const Snap& snap) {
  const auto in_range = [&](std::uint64_t index, Index count, const char* what) {
    if (index < count) return static_cast<Index>(index);
    throw Error(ErrorCode::IndexOutOfRange,
                in_quotes(where.text) + ": there is no such " + what + ", the mesh has " + std::to_string(count));
  };
  if (const auto* vertex = std::get_if<VertexPlace>(&where.place)) {
    return target_point(mesh, in_range(vertex->index, mesh.vertex_count(), "vertex"));
  }
  if (const auto* in_face = std::get_if<FacePlace>(&where.place)) {
    const SurfacePoint point{in_range(in_face->face, mesh.face_count(), "face"), in_face->weights};
    locate(mesh, point);
    return point;
  }
  if (where.is_curve()) {
    throw Error(ErrorCode::InvalidArgument, in_quotes(where.text) + " is a curve, and one place is needed here");
  }
  return snap(std::get<Vec3>(where.place));
}

SurfacePoint PlaceFinder::target(const Where& where) {
  return resolve(where, mesh_, [&](Vec3 position) {
    if (!finder_) finder_.emplace(mesh_);
    const NearestPoint nearest = (*finder_)(position);
    moved(where, nearest.distance);
    return nearest.point;
  });
}

void PlaceFinder::moved(const Where& where, double distance) {
  if (within_ && distance > *within_) {
    throw Error(ErrorCode::InvalidArgument, in_quotes(where.text) + " is " + readable(distance) +
                                                " from the surface, farther than --snap-within " + exact(*within_));
  }
  if (known_.insert(where.text).second) snapped_.push_back({where.text, distance});
}

SurfacePoint PlaceFinder::source(const Where& where) {
  const SurfacePoint point = target(where);
  if (!point.is_nowhere()) return point;
  throw Error(ErrorCode::InvalidArgument,
              in_quotes(where.text) + ": this vertex is in no face, nothing can be reached from it");
}

void PlaceFinder::tell(const Talk& talk) const {
  // Positions that are read from text and lie on the surface miss it by the rounding of their last digit.
  constexpr double kRounding = 1e-6;
  const Box& box = mesh_.bounds();
  const double size = mesh_.unit() * norm((1 / mesh_.unit()) * (box.high - box.low));  // squares of it may vanish
  std::size_t moved = 0;
  const Snapped* farthest = nullptr;
  for (const Snapped& s : snapped_) {
    if (!(s.distance > kRounding * size)) continue;
    ++moved;
    if (farthest == nullptr || s.distance > farthest->distance) farthest = &s;
  }
  if (farthest == nullptr) return;
  const std::string off =
      readable(farthest->distance) + " from the surface (the mesh is " + readable(size) + " across)";
  const bool is_curve = parse_curve(without_offset(farthest->where)).has_value();
  talk.say(moved == 1 ? "'" + farthest->where + "' is " + (is_curve ? "up to " : "") + off + ": its nearest " +
                            (is_curve ? "points were taken" : "point was taken")
                      : std::to_string(moved) + " positions are off the surface, the farthest, '" + farthest->where +
                            "', " + off + ": their nearest points were taken");
}

void PlaceFinder::add_to(Record& record) const {
  std::vector<Record> list;
  double farthest = 0;
  for (const Snapped& s : snapped_) {
    list.emplace_back().add("where", s.where).add("distance", s.distance);
    farthest = std::max(farthest, s.distance);
  }
  record.add("snapped", std::move(list)).add("max_snap_distance", farthest);
}

}  // namespace brushfire::tool
