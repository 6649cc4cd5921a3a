// The ray that brought a point its value: what paths and paths' bends are made from.
#pragma once

#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/windows/detail/face.h>
#include <brushfire/solvers/windows/detail/window.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace brushfire::detail::BRUSHFIRE_NUMBERS {

// The ray comes over `halfedge` from `source` (in the halfedge's frame; y >= 0: from inside of the halfedge's face or
// its edge). kNoIndex: along an edge of a face with a repeated vertex, or the point is the source itself.
struct Ray {
  Vec2 source;
  Index halfedge = kNoIndex;
  Index root = kNoIndex;  // vertex, or vertex count + position of the source
  WindowKind kind = WindowKind::Circular;
};

struct PointRecord {
  Real value = kInfinity;  // mesh.unit(), offsets included
  Index label = kNoIndex;
  Ray ray;
};

// The records of a mesh's vertices: of every one, or, after a run that costs what it reaches, of those alone.
class VertexRecords {
 public:
  // One for each of `count` vertices, `unknown` until it is set.
  void resize(Index count, const PointRecord& unknown);
  // Room for up to `expected` vertices of `count`; the others read `unknown`.
  void resize_few(Index count, std::size_t expected, const PointRecord& unknown);

  void set(Index v, const PointRecord& record);
  const PointRecord& operator[](Index v) const { return slots_.empty() ? records_[v] : few_[slots_[find(v)]].record; }
  Index size() const noexcept { return count_; }

 private:
  struct Numbered {
    Index vertex;
    PointRecord record;
  };
  std::size_t find(Index v) const;

  Index count_ = 0;
  std::vector<PointRecord> records_;  // [vertex_count], or none
  // Open addressing: a slot holds a position in few_; 0 is that of the unknown one, and means that the slot is free.
  std::vector<std::uint32_t> slots_;  // a power of two, or none
  std::vector<Numbered> few_;
};

struct KeptWindow {
  Index halfedge;
  Window window;
};

struct WindowFieldData {
  Mesh mesh;
  std::vector<LocatedSource> sources;
  std::vector<Real> bases;  // what is to be added to values, by source, in the mesh's units; empty: 0
  Real shift = 0;           // what was added to every value so that none is negative
  bool exact = true;        // no merging: rays lead back to roots
  bool all_points = false;
  VertexRecords vertices;               // [vertex_count]; value NaN: farther than the run went
  std::vector<PointLocation> targets;   // where not all_points
  std::vector<PointRecord> target;      // [targets]
  std::vector<std::size_t> first_kept;  // [halfedge_count + 1] where all_points
  std::vector<Window> kept;             // by halfedge

  // Sets the last two.
  void keep(std::span<const KeptWindow> windows);
};

// A point of a face in the frame of the face's halfedge k; weights by corner.
Vec2 in_frame(const Frame& frame, Index k, const std::array<Real, 3>& weights);

// All descriptions of a point by faces that contain it: itself, and for a point on an edge, the edge's other faces.
struct FaceWeights {
  Index face;
  std::array<Real, 3> weights;
};
template <class Visit>
void for_each_face_around(const Mesh& mesh, const PointLocation& at, Visit&& visit) {
  visit(FaceWeights{at.face, at.weights});
  if (at.on != PointLocation::On::Edge) return;
  const Index h = at.halfedge, from = mesh.from(h);
  const auto opposite = mesh.opposite();
  for (Index g = opposite[h]; g != h; g = opposite[g]) {
    FaceWeights other{Mesh::face_of(g), {0, 0, 0}};
    const bool same_way = mesh.from(g) == from;
    other.weights[g % 3] = at.weights[same_way ? h % 3 : next3(h % 3)];
    other.weights[next3(g % 3)] = at.weights[same_way ? next3(h % 3) : h % 3];
    visit(other);
  }
}
std::vector<FaceWeights> faces_around(const Mesh& mesh, const PointLocation& at);

}  // namespace brushfire::detail::BRUSHFIRE_NUMBERS
