// MeshParts: what a reader gathers, and how it becomes a mesh.
#pragma once

#include <brushfire/core/cancel.h>
#include <brushfire/core/types.h>
#include <brushfire/io/detail/input.h>
#include <brushfire/io/read_mesh.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace brushfire::detail {

// The faces of a file, in its order. Triangles go straight into their array for as long as nothing else comes.
class FaceList {
 public:
  // `place`: the line or byte of the face, for the message where an index is beyond the vertices.
  void add_triangle(Index a, Index b, Index c, std::size_t place) {
    note(std::max({a, b, c}), place);
    if (all_triangles_) {
      triangles_.push_back({a, b, c});
    } else {
      const Index corners[3]{a, b, c};
      append(corners);
    }
    ++count_;
  }
  void add(std::span<const Index> corners, std::size_t place);
  void reserve(std::size_t faces) { triangles_.reserve(faces); }
  std::size_t count() const { return count_; }

  // Triangles for all faces; face_origin stays empty where triangles are all there was. Throws where a face names a
  // vertex that is not there: `places_are_lines` says how to word it, `counts_from` (0 or 1) how the file counts.
  void finish(const Input& input, bool places_are_lines, Index counts_from, std::span<const Vec3> positions,
              std::vector<Face>& faces, std::vector<Index>& face_origin, std::vector<std::string>& remarks);

 private:
  void note(Index largest, std::size_t place) {
    poll_();
    if (largest >= largest_) {
      if (largest > largest_ || count_ == 0) {
        largest_face_ = count_;
        largest_place_ = place;
      }
      largest_ = largest;
    }
  }
  void append(std::span<const Index> corners);
  void leave_fast_path();

  Poll poll_;
  bool all_triangles_ = true;
  std::size_t count_ = 0;  // of the file, left-out ones included
  std::size_t left_out_ = 0;
  std::vector<Face> triangles_;
  std::vector<Index> offset_, corners_;  // polygons, once there is one that is no triangle
  std::vector<Index> number_;            // of each polygon in the file
  Index largest_ = 0;
  std::size_t largest_face_ = 0, largest_place_ = 0;
};

struct MeshParts {
  std::vector<Vec3> positions;
  FaceList faces;
  bool places_are_lines = true;
  Index counts_from = 0;  // the number of the file's first vertex, for messages
  std::vector<Index> vertex_map;
  std::string structure;
  std::vector<std::string> remarks;
};

// For files whose vertices all have two coordinates.
inline constexpr const char* kPlanarRemark = "the vertices have two coordinates: z is 0";

LoadedMesh finish(const Input& input, MeshParts&& parts, const char* format);

// "1 face", "2 faces".
std::string counted(std::size_t n, const char* one, const char* many);

}  // namespace brushfire::detail
