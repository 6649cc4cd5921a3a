// Faces over the same three vertices as one sheet: a mesh with one face of each such set, and an engine that runs on
// it.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/detail/engine.h>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace brushfire::detail {

// Copies: faces over the same three vertices, in any order. They carry the same light (L9 of docs/tolerance.md), unless
// it starts inside one of them. "The single mesh" has one face of each set, the lowest, in the order of the caller's
// mesh, and all of its vertices, with their numbers.
class Sheets {
 public:
  // Null where no face has copies (or where the lengths of copies may differ: slits in a mesh from lengths). Each of
  // `apart` (ascending) stays a face of its own. O(faces), but for vertices at which many faces meet: sorted.
  static std::shared_ptr<const Sheets> of(const Mesh& mesh, std::span<const Index> apart = {});
  // The same, or null without a look at the faces where they are no more than a closed surface with few handles has:
  // for engines that a few copies do no harm.
  static std::shared_ptr<const Sheets> where_likely(const Mesh& mesh) {
    return mesh.face_count() / 17 * 8 > mesh.vertex_count() ? of(mesh) : nullptr;
  }

  const Mesh& mesh() const { return mesh_; }      // the caller's
  const Mesh& single() const { return single_; }  // the single mesh; the same unit()

  // Whether a point belongs to its face alone, and that face has copies.
  bool is_inside_copy(const PointLocation& at) const;
  // Whether two points lie inside different copies of one face.
  bool are_inside_two_copies(const PointLocation& a, const PointLocation& b) const;

  // The same point by a face of the single mesh: of what is inside of a copy, where it is inside of the single face.
  PointLocation to_single(const PointLocation& at) const;
  std::shared_ptr<const LocatedCurve> to_single(const std::shared_ptr<const LocatedCurve>& curve) const;
  // And back, to the face that stands for all.
  SurfacePoint from_single(const SurfacePoint& at) const { return {face_[at.face], at.weights}; }

 private:
  explicit Sheets(const Mesh& mesh) : mesh_(mesh) {}  // NOLINT(modernize-pass-by-value): its caller keeps it

  Mesh mesh_, single_;
  std::vector<Index> number_;    // [face_count] of the face in the single mesh
  std::vector<Index> face_;      // [single face_count] the caller's
  std::vector<bool> is_copied_;  // [single face_count]
};

// What a run on a single mesh has to know of the mesh that it stands for: whoever reads its windows asks in that one's
// numbers.
struct SheetView {
  std::shared_ptr<const Sheets> sheets;
  std::vector<PointLocation> sources, targets;  // the caller's
};

// An engine that runs the engines that `make` makes of single meshes.
std::unique_ptr<Engine> make_on_one_sheet(std::shared_ptr<const Sheets> sheets,
                                          std::function<std::unique_ptr<Engine>(const Mesh&)> make);

}  // namespace brushfire::detail
