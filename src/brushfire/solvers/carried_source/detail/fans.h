// The faces around every vertex as fans, in which directions are true angles.
#pragma once

#include <brushfire/mesh/mesh.h>

#include <cstdint>
#include <span>
#include <vector>

namespace brushfire::carried_source {

// Sectors of a vertex, a bit for each.
using SectorSet = std::uint16_t;
inline constexpr Index kSectors = 16;
// Where a vertex has more fans than there are sectors, those beyond share the last: light from there is not followed.
inline constexpr Index kSharedSector = kSectors - 1;

// A range of directions at a vertex, in one fan: the corner of a face, or some that follow each other where there are
// more of them than sectors.
struct Sector {
  double low = 0, high = 0;
  double around = kInfinity;  // the sum of the fan's angles where it is closed; +inf: it is open
  Index fan = 0;
};

// A direction at a vertex. The angles of a fan begin with 0 at its first side and are not reduced by anything; in a
// closed fan the first side is the last one, too, at the sum of all angles.
struct Direction {
  double angle = 0;
  Index fan = 0;
  Index sector = 0;  // that holds it, or one of two
};

// A corner of a usable face in a fan of its vertex, counter-clockwise there; `mirrored`: it is clockwise in its face.
struct FanCorner {
  double low = 0, high = 0;
  Index first_side = 0, last_side = 0;  // by number at the vertex
  Index fan = 0;
  std::uint8_t sector = 0;
  bool mirrored = false;
};

// Faces that meet over edges of two faces follow each other in a fan; a boundary or an edge of more faces ends it.
// Faces that name a vertex twice are in no fan. At an odd vertex every fan has sides of its own, a first and a last one
// also where it is closed.
class Fans {
 public:
  explicit Fans(const Mesh& mesh);

  const FanCorner& corner(Index halfedge) const { return corners_[halfedge]; }
  std::span<const Sector> sectors(Index v) const {
    return {sectors_.data() + sector_begin_[v], sector_begin_[v + 1] - sector_begin_[v]};
  }
  Index side_count(Index v) const { return side_count_[v]; }  // of the sides of fans
  // Whether the faces around a vertex are several fans, or one that ends with edges of three faces and more.
  bool is_odd(Index v) const { return odd_[v]; }
  // Whether there is a shadow behind the vertex, whatever the light: it has one fan, whose angles sum to more than a
  // full turn, or to more than half of one where it is open.
  bool bends_light(Index v) const;

  // A corner's two sides: along the halfedge that names it, or along the one before.
  Index side(Index corner, bool own) const {
    const FanCorner& c = corners_[corner];
    return own != c.mirrored ? c.first_side : c.last_side;
  }
  Direction direction(Index corner, bool own) const {
    const FanCorner& c = corners_[corner];
    return {own != c.mirrored ? c.low : c.high, c.fan, c.sector};
  }
  // A direction of any angle by the angle below the sum of all, in a closed fan, and with its sector.
  Direction within(Index v, Index fan, double angle) const;

  // The edge of a halfedge by the same number for all its faces. Of odd vertices only.
  Index edge(Index halfedge) const { return edge_[halfedge]; }

 private:
  struct Loose {
    Index corner = kNoIndex;
    bool mirrored = false;
  };

  void build(Index v);
  Loose beside(Loose at, bool forward) const;
  bool string_together(Loose from);
  struct Range {
    Index begin = 0, end = 0;  // in all_
    bool closed = false;
  };
  Index lay_out(const Range& range, Index fan, Index side, bool ends_meet);
  void share_sectors();
  void name_edges();

  const Mesh& mesh_;
  std::span<const Index> opposite_;
  std::span<const double> lengths_, areas_;
  std::vector<FanCorner> corners_;  // by halfedge
  std::vector<Sector> sectors_;
  std::vector<Index> sector_begin_, side_count_;
  std::vector<bool> odd_;
  std::vector<Index> edge_;  // by halfedge; empty where no vertex is odd
  // Of the vertex at hand: one fan, and all of them one after the other.
  std::vector<Loose> fan_, all_;
  std::vector<Range> ranges_;
  std::vector<double> around_;
};

}  // namespace brushfire::carried_source
