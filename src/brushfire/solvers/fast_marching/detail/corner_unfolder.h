// Obtuse corners become triangles that reach out of them, for the vertices at their other corners.
#pragma once

#include <brushfire/core/detail/planar.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/detail/unfolding_limit.h>
#include <brushfire/solvers/fast_marching/detail/face_costs.h>
#include <brushfire/solvers/fast_marching/detail/lane_writer.h>
#include <brushfire/solvers/fast_marching/detail/unfold.h>
#include <brushfire/solvers/fast_marching/detail/unfolded_corner.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace brushfire::fast_marching {

template <class T>
class CornerUnfolder {
 public:
  CornerUnfolder(const Mesh& mesh, Variant variant, const FaceCosts& costs)
      : mesh_(mesh),
        costs_(costs),
        unfolder_(mesh),
        limit_(mesh.face_count()),
        variant_(variant),
        scale_(1 / mesh.unit()) {}

  // Unfolds those of some corners that are obtuse. rings.add_unfolded(v, Corner): a triangle over which v updates the
  // corner; its sides at v go to that (a) and to the third vertex (b). rings.prefetch(v): the former will soon be
  // called for v. The order does not depend on the variant.
  template <class Rings>
  void unfold(std::span<const Index> corners, Rings& rings) {
    if (!unfolder_.is_plain() || costs_.any()) {
      for (const Index h : corners) unfold_any(h, rings);
      return;
    }
    pairs_.resize(corners.size());
    BRUSHFIRE_ON_TARGET(variant_, find_face_pairs(mesh_, unfolder_, corners, pairs_.data()));
    pairs_.resize((corners.size() + kCorners - 1) / kCorners * kCorners, corners.empty() ? FacePair{} : pairs_.back());
    UnfoldedCorners<T> four;
    for (std::size_t first = 0; first < corners.size(); first += kCorners) {
      for (std::size_t i = first + kCorners; i < std::min(first + 2 * kCorners, pairs_.size()); ++i) {
        for (const Index v : {pairs_[i].end[0], pairs_[i].end[1], pairs_[i].behind}) rings.prefetch(v);
      }
      const CornerSets sets =
          BRUSHFIRE_ON_TARGET(variant_, unfold_corners(mesh_.positions(), scale_, &pairs_[first], four));
      for (std::size_t k = 0; k < std::min(kCorners, corners.size() - first); ++k) {
        if ((sets.split >> k & 1u) != 0) {
          add(pairs_[first + k], four, k, rings);
        } else if ((sets.obtuse >> k & 1u) != 0) {
          unfold_any(corners[first + k], rings);
        }
      }
    }
  }

  const Unfolder& unfolder() const { return unfolder_; }
  std::span<const Index> unsplit() const { return unsplit_; }  // corners whose unfolding ended early
  int most_crossed() const { return most_crossed_; }           // faces that the longest unfolding crosses

 private:
  // Two triangles, each seen from its end and from behind.
  template <class Rings>
  BRUSHFIRE_INLINE void add(const FacePair& pair, const UnfoldedCorners<T>& four, std::size_t k, Rings& rings) {
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& side = four.side[i];
      const Corner at_end{pair.corner, pair.behind, side.length[k], side.between[k], side.dot_end[k], side.cross[k]};
      const Corner behind{pair.corner, pair.end[i], four.length[k], side.between[k], side.dot_behind[k], side.cross[k]};
      rings.add_unfolded(pair.end[i], at_end);
      rings.add_unfolded(pair.behind, behind);
    }
  }

  template <class Rings>
  void unfold_any(Index h, Rings& rings) {
    triangles_.clear();
    const Unfolding result = unfolder_.unfold(h, limit_.faces(), triangles_);
    if (!result.obtuse) return;
    limit_.add(triangles_.size());
    most_crossed_ = std::max(most_crossed_, result.crossed);
    if (!costs_.any()) {
      if (!result.split) unsplit_.push_back(h);
      for (const UnfoldedTriangle& t : triangles_) add(t, rings);
      return;
    }
    const Index f = Mesh::face_of(h), edge = Mesh::next(h);
    const Index behind = result.crossed == 1 ? unfolder_.face_over(f, mesh_.from(edge), mesh_.to(edge)) : kNoIndex;
    const double w = costs_.of(f);
    if (!result.split || behind == kNoIndex || costs_.of(behind) != w) return unsplit_.push_back(h);
    for (UnfoldedTriangle& t : triangles_) {
      t.at_first = w * t.at_first, t.at_second = w * t.at_second;
      add(t, rings);
    }
  }

  template <class Rings>
  static void add(const UnfoldedTriangle& t, Rings& rings) {
    const Vec2 along = t.at_second - t.at_first;
    const double to_first = norm(t.at_first), to_second = norm(t.at_second), between = norm(along);
    const double twice_area = std::abs(cross(t.at_first, t.at_second));
    rings.add_unfolded(t.first, {t.corner_vertex, t.second, to_first, between, -dot(t.at_first, along), twice_area});
    rings.add_unfolded(t.second, {t.corner_vertex, t.first, to_second, between, dot(t.at_second, along), twice_area});
  }

  const Mesh& mesh_;
  FaceCosts costs_;
  Unfolder unfolder_;
  brushfire::detail::UnfoldingLimit limit_;
  Variant variant_;
  double scale_;
  std::vector<FacePair> pairs_;  // of the corners at hand
  std::vector<Index> unsplit_;
  int most_crossed_ = 1;
  std::vector<UnfoldedTriangle> triangles_;  // of one corner
};

}  // namespace brushfire::fast_marching
