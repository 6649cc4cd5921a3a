// A mesh finer than the caller's, on which linear isolines run as the level sets of the exact distance do.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/window_field.h>
#include <brushfire/solvers/windows/paths/point_values.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace brushfire::detail {

// Every face that a level may cross, halved again and again over its triangles' longest sides until the corners of each
// triangle tell how each level runs through it (corners_tell()), or its sides are no longer than the chord error.
// Faces that share an edge halve it in the same places. The finer mesh is only combinatorial: isolines() looks at
// values and connections, not at where vertices are.
//
// Based on: Rivara, "Algorithms for refining triangular grids", 1984 (halves over longest sides end, and stay fat).
class LevelMesh {
 public:
  LevelMesh(const WindowField& field, std::span<const double> levels, double chord_error);

  const Mesh& mesh() const { return fine_; }
  // By its vertices; what is unreachable, or farther than the run went, lies above all levels.
  const std::vector<double>& values() const { return values_; }
  // A vertex on the caller's mesh.
  const SurfacePoint& origin(Index v) const { return origin_[v]; }
  // The face of the caller's mesh in which a face lies.
  Index parent(Index fine_face) const { return parent_[fine_face]; }

 private:
  struct Triangle {
    std::array<Index, 3> vertices;
    std::array<std::array<double, 3>, 3> weights;  // of them, in the face
    bool is_told = false;
  };
  struct FaceTriangles {
    Index face;
    double finest;  // mesh.unit(): shorter sides are not halved
    std::vector<Triangle> triangles;
    std::vector<windows::FaceFront> fronts;  // found when they are needed
    bool waits = true;
  };

  // A side of a triangle: its ends, and the edge that it lies on (its lowest halfedge), or the face that it is inside
  // of.
  struct Side {
    Index low, high, home;
    friend bool operator==(const Side&, const Side&) = default;
  };
  struct SideHash {
    std::size_t operator()(const Side& s) const {
      std::uint64_t h = (std::uint64_t{s.low} << 32 | s.high) * 0x9e3779b97f4a7c15u;
      h ^= h >> 29;
      return static_cast<std::size_t>((h + s.home) * 0xbf58476d1ce4e5b9u);
    }
  };

  bool may_cross(Index face) const;
  double finest_in(Index face) const;
  void refine(FaceTriangles& f);
  std::optional<std::size_t> side_to_halve(FaceTriangles& f, Triangle& t, const std::array<Vec2, 3>& corners) const;
  bool is_told(FaceTriangles& f, const Triangle& t, const std::array<Vec2, 3>& corners) const;
  void halve(FaceTriangles& f, std::size_t triangle, std::size_t side);
  Index middle_of(const FaceTriangles& f, const Triangle& t, std::size_t side);
  Side side_of(Index face, const Triangle& t, std::size_t side) const;
  Index edge_of(Index face, const Triangle& t, std::size_t side) const;
  Index vertex_of(Index v);
  Index add_vertex(const SurfacePoint& p);
  double known_value(Index v) const;
  void wake_neighbours(Index halfedge);
  void finish();

  const WindowField& field_;
  const Mesh& mesh_;
  std::vector<double> levels_;  // ascending, in mesh.unit()
  double finest_, above_;
  std::vector<FaceTriangles> faces_;
  std::vector<Index> place_;  // [face_count] in faces_; kNoIndex
  std::vector<Index> waiting_;
  std::vector<Index> known_;  // [vertex_count] the number here of a vertex of the caller's mesh; kNoIndex
  std::unordered_map<Side, Index, SideHash> middles_;
  std::vector<SurfacePoint> origin_;
  std::vector<double> values_;
  std::vector<bool> is_known_;  // [vertices here] whether the run came there
  std::vector<Index> parent_;
  Mesh fine_;
};

}  // namespace brushfire::detail
