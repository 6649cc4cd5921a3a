// Indices that exist, coordinates that are finite.
#include <brushfire/mesh/detail/checked_copy.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/prefault.h>
#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace brushfire::detail {
namespace {

[[noreturn]] void throw_index_error(Index vertex_count, std::span<const Face> faces) {
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const Index v : faces[f]) {
      if (v < vertex_count) continue;
      throw Error(ErrorCode::InvalidMesh, "face " + std::to_string(f) + " names vertex " + std::to_string(v) +
                                              ", but there are " + std::to_string(vertex_count) + " vertices");
    }
  }
  throw Error(ErrorCode::Internal, "all faces name vertices that are there");
}

[[noreturn]] void throw_position_error(std::span<const Vec3> positions) {
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vec3& p = positions[v];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
    throw Error(ErrorCode::InvalidMesh, "vertex " + std::to_string(v) + " has a coordinate that is not finite: (" +
                                            number_as_text(p.x) + ", " + number_as_text(p.y) + ", " +
                                            number_as_text(p.z) + ")");
  }
  throw Error(ErrorCode::Internal, "all coordinates are finite");
}

[[noreturn]] void throw_too_far_out(std::span<const Vec3> positions) {
  const auto is_too_far_out = [](const Vec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > kMostCoordinate;
  };
  const auto p = std::find_if(positions.begin(), positions.end(), is_too_far_out);
  throw Error(ErrorCode::InvalidMesh, "vertex " + std::to_string(p - positions.begin()) + " lies at (" +
                                          number_as_text(p->x) + ", " + number_as_text(p->y) + ", " +
                                          number_as_text(p->z) +
                                          "): there are no numbers for distances between coordinates beyond 1e298; "
                                          "scale the mesh down");
}

// keep(i, item) for each of them.
template <class Keep>
void check_faces(Index vertex_count, std::span<const Face> faces, const Keep& keep) {
  Index highest = 0;
  in_pieces(faces.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const Face t = faces[f];
      highest = std::max({highest, t[0], t[1], t[2]});
      keep(f, t);
    }
  });
  if (!faces.empty() && highest >= vertex_count) throw_index_error(vertex_count, faces);
}

template <class Keep>
Box check_positions(std::span<const Vec3> positions, const Keep& keep) {
  Box box;
  Vec3 zero;  // stays so: 0 times what is not finite is NaN
  const auto take = [&](std::size_t v) {
    const Vec3 p = positions[v];
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    zero = zero + 0 * p;
    keep(v, p);
  };
  in_pieces(positions.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) take(v);
  });
  if (!(zero == Vec3{})) throw_position_error(positions);
  const double most = std::max({-box.low.x, -box.low.y, -box.low.z, box.high.x, box.high.y, box.high.z});
  if (most > kMostCoordinate) throw_too_far_out(positions);
  return box;
}

void check_count(std::span<const Face> faces) {
  if (faces.size() <= kNoIndex / 3) return;
  throw Error(ErrorCode::TooLarge, std::to_string(faces.size()) + " faces do not fit into 32-bit halfedge numbers");
}
void check_count(std::span<const Vec3> positions) {
  if (positions.size() < kNoIndex) return;
  throw Error(ErrorCode::TooLarge, std::to_string(positions.size()) + " vertices do not fit into 32-bit indices");
}

constexpr auto kKeepNothing = [](std::size_t, const auto&) {};

}  // namespace

void check(Index vertex_count, std::span<const Face> faces) {
  check_count(faces);
  check_faces(vertex_count, faces, kKeepNothing);
}

Box check(std::span<const Vec3> positions) {
  check_count(positions);
  return check_positions(positions, kKeepNothing);
}

UninitializedArray<Face> checked_copy(Index vertex_count, std::span<const Face> faces) {
  check_count(faces);
  UninitializedArray<Face> copy(faces.size());
  prefault(copy);
  check_faces(vertex_count, faces, [&](std::size_t f, const Face& t) { copy[f] = t; });
  return copy;
}

UninitializedArray<Vec3> checked_copy(std::span<const Vec3> positions, Box& bounds) {
  check_count(positions);
  UninitializedArray<Vec3> copy(positions.size());
  prefault(copy);
  bounds = check_positions(positions, [&](std::size_t v, const Vec3& p) { copy[v] = p; });
  return copy;
}

}  // namespace brushfire::detail
