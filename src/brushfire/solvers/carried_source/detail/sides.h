// The sides of all vertices: where they run, and which light passes below them. The records of both ends are made of
// it.
#pragma once

#include <brushfire/core/detail/inline.h>
#include <brushfire/core/detail/uninitialized.h>
#include <brushfire/solvers/carried_source/detail/optics.h>
#include <brushfire/solvers/carried_source/detail/records.h>
#include <brushfire/solvers/carried_source/detail/rings.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace brushfire::carried_source {

// Of a halfedge that leaves a vertex with a regular ring (rings.h): the side along it, and the corner that it names.
template <class T>
struct RingSide {
  T c = 1, s = 0, length = 0;
  float angle = 0;
  SightSets sets;
  std::uint8_t number = 0, count = 0;  // the side's, and the corner's, of so many at the vertex
  bool bends = false;                  // Fans::bends_light()
  bool is_alone = false;               // the vertex has no regular ring: all else is void, but for is_split
  bool is_split = false;               // the corner is obtuse, and unrolled into acute ones

  BRUSHFIRE_INLINE Index next() const { return number + 1u == count ? 0 : number + Index{1}; }
};

// A side of a record, as both ends see it.
template <class T>
inline void set_side(T length, const Optic& here, const Optic& there, bool end_bends, Side<T>& side, DarkSets& dark,
                     LensNumbers& lenses) {
  side.length = length;
  side.c = static_cast<T>(here.c), side.s = static_cast<T>(here.s);
  side.end_c = static_cast<T>(there.c), side.end_s = static_cast<T>(there.s);
  side.sector = static_cast<std::uint8_t>(there.sector);
  side.end_bends = end_bends ? 1 : 0;
  for (int hand = 0; hand < 2; ++hand) {
    side.turned[hand] = here.sets.turned[hand], side.end_turned[hand] = there.sets.turned[hand];
    dark.here[hand] = here.sets.dark[hand], dark.end[hand] = there.sets.dark[hand];
    lenses.here[hand] = here.lenses[hand], lenses.end[hand] = there.lenses[hand];
  }
}

// An obtuse corner, and the halfedge of the one face behind it; kNoIndex: there is none, or more.
struct ObtuseCorner {
  Index corner = kNoIndex, behind = kNoIndex;
};

// A direction, with all that is known of it at its vertex.
struct Heading {
  Vec2 unit{1, 0};
  double angle = 0;
  Index fan = 0;
};

// Where fans are not regular rings, vertices are laid out one by one (`alone`).
template <class T>
class Sides {
 public:
  explicit Sides(const Mesh& mesh);

  RingSide<T>& operator[](Index h) { return sides_[h]; }
  const RingSide<T>& operator[](Index h) const { return sides_[h]; }
  bool is_alone(Index v) const { return alone_of_[v] != kNoIndex; }
  const VertexOptics& alone(Index v) const { return alone_[alone_of_[v]]; }
  bool bends_light(Index v) const;
  bool is_odd(Index v) const { return is_alone(v) && alone(v).fans().is_odd(); }

  // Of a corner and its two sides, as Fans has them.
  Index number(Index corner, bool own) const {
    const RingSide<T>& side = sides_[corner];
    if (side.is_alone) return alone(mesh_.from(corner)).fans().side(corner, own);
    return own ? side.number : side.next();
  }
  Index sector(Index corner) const {
    const RingSide<T>& side = sides_[corner];
    return side.is_alone ? alone(mesh_.from(corner)).fans().corner(corner).sector : side.number;
  }
  bool is_mirrored(Index corner) const {
    return sides_[corner].is_alone && alone(mesh_.from(corner)).fans().corner(corner).mirrored;
  }
  bool is_seam(Index corner, bool own) const;
  Optic optic(Index corner, bool own) const;

  // As Mesh::neighbour(), quicker.
  Index neighbour(Index h) const {
    const RingSide<T>& side = sides_[h];
    if (side.is_alone) return mesh_.neighbour(h);
    return Mesh::previous(ring_corner(mesh_.from(h), side.number == 0 ? side.count - 1u : side.number - 1u));
  }

  // Where a corner begins in its fan.
  Heading first_side(Index corner) const;
  // A heading from any angle to one below the sum of all. Of a direction that is no side.
  Optic optic(Index v, const Heading& heading);

  const std::vector<ObtuseCorner>& obtuse() const { return obtuse_; }
  double sum_of_lengths() const { return sum_of_lengths_; }  // of all halfedges
  std::vector<Around<T>> take_around() { return std::move(around_); }
  std::vector<Lenses> take_lenses() { return lenses_.take(); }

 private:
  Index ring_corner(Index v, Index number) const {
    const Index* corner = mesh_.corners(v).data();
    while (sides_[*corner].number != number) ++corner;
    return *corner;
  }
  void take(Index v, const Ring& ring);
  bool is_slit(const Ring& ring) const;
  void lay_out_alone(Index v);

  const Mesh& mesh_;
  UninitializedArray<RingSide<T>> sides_;  // by halfedge
  std::vector<Around<T>> around_;          // [vertex_count]
  std::vector<float> sums_;                // [vertex_count] of the angles of regular rings
  std::vector<Index> alone_of_;            // [vertex_count] the number in alone_; kNoIndex: a regular ring
  std::vector<VertexOptics> alone_;
  FanBuilder fans_;
  LensStore lenses_;
  std::vector<ObtuseCorner> obtuse_;
  double sum_of_lengths_ = 0;
};

extern template class Sides<float>;
extern template class Sides<double>;

}  // namespace brushfire::carried_source
