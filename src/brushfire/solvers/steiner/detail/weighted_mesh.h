// A mesh as the search on it sees it: walls and fences cut open, a weight for every face and edge.
#pragma once

#include <brushfire/mesh/domain.h>
#include <brushfire/solvers/steiner/detail/edge_table.h>
#include <brushfire/solvers/steiner/detail/stretches.h>
#include <brushfire/solvers/steiner/weights.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace brushfire::steiner {

// From an edge on one side of a fence to one on another, which lies over the same two vertices of the caller's mesh.
struct Bridge {
  Index from = kNoIndex, to = kNoIndex;  // edges
  bool mirrored = false;                 // the two run in opposite directions
  double cost = 0;                       // of crossing, in mesh().unit()
};

// Weights in the numbers of domain.open(), all of it without walls of cost +inf. O(faces).
Weights weights_on_open(const Domain& domain, const Weights& weights);

// What becomes of faces of weight +inf: they are cut out; or left, as faces that nothing enters, where that is the
// same, since they part the faces around no vertex.
enum class Walls : std::uint8_t { CutOut, Left };

class WeightedMesh {
 public:
  // Throws as check() does. O(vertices + faces + edges that are special).
  WeightedMesh(const Domain& domain, const Weights& weights, Walls walls = Walls::CutOut);

  // The same mesh, in the same numbers, with other weights; null where fences are others, or what is cut out. Throws as
  // check() does. O(faces + edges that are special).
  std::shared_ptr<const WeightedMesh> reweighted(const Weights& weights) const;

  const Domain& domain() const { return domain_; }
  const Mesh& mesh() const { return fenced_.open(); }
  const EdgeTable& edges() const { return *edges_; }
  double face_weight(Index f) const { return face_weight_[f]; }  // +inf: nothing enters
  // The least of the edge's own and of those of its faces.
  double edge_weight(Index e) const { return edge_weight_[e]; }
  std::span<const Bridge> bridges(Index edge) const;
  std::span<const Bridge> all_bridges() const { return bridges_; }
  const Stretches& stretches() const { return stretches_; }
  bool is_isotropic() const { return !pace_ && !stretches_.any(); }
  double mean_weight() const { return mean_weight_; }  // harmonic, so that walls and marshes do not count
  // Where slopes count: null elsewhere.
  const SlopePace* pace() const { return pace_ ? &*pace_ : nullptr; }
  double height(Index v) const { return mesh().positions()[v].z / mesh().unit(); }

  // Points and vertices of the caller's mesh there and back, as those of Domain. No point behind a wall is anywhere.
  std::vector<SurfacePoint> on_open(const SurfacePoint& point) const;
  Index open_vertex(Index v) const { return fenced_.vertex(v); }  // of domain().open()
  Index face(Index f) const { return domain_.face(fenced_.face(f)); }
  Index vertex(Index v) const { return domain_.vertex(fenced_.vertex(v)); }
  void to_caller(std::span<SurfacePoint> points) const;

 private:
  struct Opened {  // weights in the numbers of domain.open()
    Weights weights;
  };
  WeightedMesh(const Domain& domain, const Opened& given, Walls walls);
  void set_weights(const Weights& opened);
  void find_bridges(const std::vector<EdgeCost>& fences);
  std::vector<Index> open_halfedges(Index a, Index b) const;

  bool is_entered(const SurfacePoint& point) const;

  Domain domain_;
  Walls walls_;
  Barriers barriers_;  // of domain_.open(): fences, and walls that are cut out
  Domain fenced_;      // that with these cut open
  std::shared_ptr<const EdgeTable> edges_;
  std::vector<double> face_weight_, edge_weight_;
  std::vector<Bridge> bridges_;  // by `from`
  Stretches stretches_;
  double mean_weight_ = 1;
  std::optional<SlopePace> pace_;
};

}  // namespace brushfire::steiner
