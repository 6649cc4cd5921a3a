// Fans around the corners of walls, with and without them.
#include <brushfire/solvers/steiner/detail/wall_faces.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace brushfire::steiner {
namespace {

class Fans {
 public:
  Fans(const Mesh& mesh, const Weights& weights) : mesh_(mesh), opposite_(mesh.opposite()), weights_(weights) {
    for (const EdgeCost& e : weights.edges) {
      if (e.crossing > 0) fences_.insert(std::minmax(e.vertices[0], e.vertices[1]));
    }
  }

  bool are_parted_at(Index v) {
    corners_ = mesh_.corners(v);
    const auto open_corners = std::count_if(corners_.begin(), corners_.end(), [&](Index h) { return is_open(h); });
    if (open_corners < 2) return false;  // most: inside of walls
    const std::size_t whole = count(v, false), open = count(v, true);
    return open > whole;
  }

 private:
  bool is_open(Index h) const { return weights_.face[Mesh::face_of(h)] < kInfinity; }

  // Fans around the vertex that have an open face; or the pieces that its open faces hang together in.
  std::size_t count(Index v, bool only_open) {
    piece_.resize(corners_.size());
    std::iota(piece_.begin(), piece_.end(), std::size_t{0});
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (only_open && !is_open(corners_[i])) continue;
      for (const Index edge : {corners_[i], Mesh::previous(corners_[i])}) {
        if (!fences_.empty() && fences_.contains(std::minmax(mesh_.from(edge), mesh_.to(edge)))) continue;
        for (Index g = opposite_[edge]; g != edge; g = opposite_[g]) {
          if (!only_open || is_open(g)) join(i, corner_at(v, Mesh::face_of(g)));
        }
      }
    }
    std::set<std::size_t> pieces;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (is_open(corners_[i])) pieces.insert(root(i));
    }
    return pieces.size();
  }

  std::size_t corner_at(Index v, Index f) const {
    const auto is_here = [&](Index h) { return Mesh::face_of(h) == f && mesh_.from(h) == v; };
    return static_cast<std::size_t>(std::find_if(corners_.begin(), corners_.end(), is_here) - corners_.begin());
  }
  std::size_t root(std::size_t i) const {
    while (piece_[i] != i) i = piece_[i];
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    if (j < piece_.size()) piece_[root(i)] = root(j);
  }

  const Mesh& mesh_;
  std::span<const Index> opposite_, corners_;
  const Weights& weights_;
  std::set<std::pair<Index, Index>> fences_;
  std::vector<std::size_t> piece_;
};

}  // namespace

bool walls_part_a_vertex(const Mesh& mesh, const Weights& weights) {
  const auto is_wall = [](double w) { return w == kInfinity; };
  if (std::none_of(weights.face.begin(), weights.face.end(), is_wall)) return false;
  std::vector<std::uint8_t> is_seen(mesh.vertex_count(), 0);
  Fans fans(mesh, weights);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (!is_wall(weights.face[f])) continue;
    for (const Index v : mesh.faces()[f]) {
      if (std::exchange(is_seen[v], std::uint8_t{1}) == 0 && fans.are_parted_at(v)) return true;
    }
  }
  return false;
}

}  // namespace brushfire::steiner
