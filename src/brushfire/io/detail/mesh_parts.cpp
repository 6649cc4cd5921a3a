// From a reader's polygons to a mesh of triangles.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/mesh_parts.h>
#include <brushfire/mesh/polygons.h>

#include <numeric>
#include <utility>

namespace brushfire::detail {

std::string counted(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

void FaceList::add(std::span<const Index> corners, std::size_t place) {
  if (corners.size() == 3) return add_triangle(corners[0], corners[1], corners[2], place);
  if (!corners.empty()) note(*std::max_element(corners.begin(), corners.end()), place);
  leave_fast_path();
  if (corners.size() < 3) {
    ++left_out_;
  } else {
    append(corners);
  }
  ++count_;
}

void FaceList::append(std::span<const Index> corners) {
  corners_.insert(corners_.end(), corners.begin(), corners.end());
  offset_.push_back(static_cast<Index>(corners_.size()));
  number_.push_back(static_cast<Index>(count_));
}

void FaceList::leave_fast_path() {
  if (!all_triangles_) return;
  all_triangles_ = false;
  offset_.resize(triangles_.size() + 1);
  number_.resize(triangles_.size());
  std::iota(number_.begin(), number_.end(), Index{0});
  corners_.reserve(3 * triangles_.size());
  offset_[0] = 0;
  for (std::size_t f = 0; f < triangles_.size(); ++f) {
    corners_.insert(corners_.end(), triangles_[f].begin(), triangles_[f].end());
    offset_[f + 1] = static_cast<Index>(corners_.size());
  }
  triangles_ = {};
}

void FaceList::finish(const Input& input, bool places_are_lines, Index counts_from, std::span<const Vec3> positions,
                      std::vector<Face>& faces, std::vector<Index>& face_origin, std::vector<std::string>& remarks) {
  if (count_ != left_out_ && largest_ >= positions.size()) {
    const std::string cause = "face " + std::to_string(largest_face_ + counts_from) + " names vertex " +
                              std::to_string(std::uint64_t{largest_} + counts_from) + ", but there are " +
                              std::to_string(positions.size()) + " vertices" +
                              (counts_from != 0 ? ", counted from " + std::to_string(counts_from) : "");
    if (places_are_lines) input.fail_line(largest_place_, cause);
    input.fail_byte(largest_place_, cause);
  }
  if (all_triangles_) {
    faces = std::move(triangles_);
    return;
  }
  if (corners_.size() >= kNoIndex) {
    throw Error(ErrorCode::TooLarge, printable(input.name()) + ": " + std::to_string(corners_.size()) +
                                         " corners of faces do not fit into 32-bit indices");
  }
  Triangulation split = triangulate_polygons(positions, offset_, corners_);
  faces = std::move(split.faces);
  face_origin = std::move(split.origin);
  for (Index& f : face_origin) f = number_[f];
  if (left_out_ != 0) {
    remarks.push_back(counted(left_out_, "face", "faces") + " of fewer than three corners left out");
  }
}

LoadedMesh finish(const Input& input, MeshParts&& parts, const char* format) {
  LoadedMesh loaded;
  std::vector<Face> faces;
  parts.faces.finish(input, parts.places_are_lines, parts.counts_from, parts.positions, faces, loaded.face_origin,
                     parts.remarks);
  try {
    loaded.mesh = Mesh(std::move(parts.positions), std::move(faces));
  } catch (const Error& e) {
    throw Error(e.code() == ErrorCode::InvalidMesh ? ErrorCode::FileMalformed : e.code(),
                printable(input.name()) + ": " + e.what());
  }
  loaded.vertex_map = std::move(parts.vertex_map);
  loaded.structure = std::move(parts.structure);
  loaded.remarks = std::move(parts.remarks);
  loaded.format = format;
  return loaded;
}

}  // namespace brushfire::detail
