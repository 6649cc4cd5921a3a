// Obtuse corners: what lights them from farther away, over the faces behind their opposite edge.
//
// Based on: Kimmel, Sethian (1998), Computing Geodesic Paths on Manifolds, section 4.
#pragma once

#include <brushfire/solvers/carried_source/detail/need.h>
#include <brushfire/solvers/carried_source/detail/sides.h>

#include <vector>

namespace brushfire::carried_source {

// A side by its number at the vertex, or one over unrolled faces by its number among all of these.
class SideName {
 public:
  SideName() = default;
  static SideName of_fan(Index number) { return SideName(number); }
  static SideName unrolled(Index number) { return SideName(number | kUnrolled); }

  bool is_none() const { return bits_ == kNoIndex; }
  bool is_unrolled() const { return (bits_ & kUnrolled) != 0; }
  Index number() const { return bits_ & ~kUnrolled; }

 private:
  static constexpr Index kUnrolled = Index{1} << 31;
  explicit SideName(Index bits) : bits_(bits) {}
  Index bits_ = kNoIndex;
};

// A way straight over unrolled faces.
template <class T>
struct UnrolledSide {
  Index next = kNoIndex;  // of the same vertex
  Index end = kNoIndex;
  float angle = 0;
  Index lenses = kNoIndex;  // LensNumbers, where one of the ends is odd
  DarkSets dark;
  Side<T> side;
};

// What a vertex offers over the edge to the end of its side `support`, to the end of its side `target`: an obtuse
// corner.
template <class T>
struct UnrolledUpdate {
  Index next = kNoIndex;  // of the same vertex
  SideName support, target;
  T length = 0;  // of the edge
  Need<T> need;
  Update update;  // its support, and whether it is across, are still to be said
};

template <class T>
class Unroller {
 public:
  Unroller(const Mesh& mesh, Sides<T>& sides);

  // All obtuse corners of the sides, which are told which of them are split.
  void unroll_all();

  // The last ones of a vertex; kNoIndex: there are none.
  Index first_side(Index v) const { return first_side_[v]; }
  Index first_update(Index v) const { return first_update_[v]; }
  const UnrolledSide<T>& side(Index i) const { return sides_[i]; }
  const LensNumbers& lenses(const UnrolledSide<T>& side) const { return lenses_[side.lenses]; }
  const UnrolledUpdate<T>& update(Index i) const { return updates_[i]; }
  int most_crossed() const { return most_crossed_; }  // faces behind one corner

 private:
  struct Place {
    Index vertex = kNoIndex;
    Vec2 at;
  };
  // A vertex of the unrolled faces, and how its fan lies in the plane.
  struct Anchor : Place {
    Index corner = kNoIndex;
    bool same_turn = true;      // whether its angles run counter-clockwise in the plane
    Vec2 along;                 // the first side of the corner
    SideName to_corner;         // its side to the obtuse corner
    bool ends_at_seam = false;  // as its update says it
  };
  Anchor anchor(Index corner, bool mirrored, Vec2 at, Vec2 next, Vec2 previous) const;
  Heading heading(const Anchor& from, Vec2 way) const;
  bool unroll(const ObtuseCorner& obtuse, int most, int& crossed);
  void add_triangle(const Anchor& corner, Anchor& right, Anchor& left, Index right_edge, Index left_edge);
  void add_update(const Anchor& corner, Anchor& own, Anchor& other, bool is_right, Index edge);
  struct Made {
    SideName side;
    bool ends_at_seam = false;  // its direction back is named by the sum of all angles
  };
  Made make_side(const Anchor& from, const Anchor& to, double length);

  const Mesh& mesh_;
  Sides<T>& of_fans_;
  std::vector<Index> first_side_, first_update_;  // [vertex_count]
  std::vector<UnrolledSide<T>> sides_;
  std::vector<LensNumbers> lenses_;
  std::vector<UnrolledUpdate<T>> updates_;
  int most_crossed_ = 0;
};

extern template class Unroller<float>;
extern template class Unroller<double>;

}  // namespace brushfire::carried_source
