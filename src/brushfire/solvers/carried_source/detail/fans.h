// The faces around a vertex as fans, in which directions are true angles.
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

// A direction of any angle by the angle below the sum of all, in a closed fan, and with its sector.
Direction within(std::span<const Sector> sectors, Index fan, double angle);

// A corner of a usable face in a fan of its vertex, counter-clockwise there; `mirrored`: it is clockwise in its face.
struct FanCorner {
  double low = 0, high = 0;
  Index first_side = 0, last_side = 0;  // by number at the vertex
  Index fan = 0;
  std::uint8_t sector = 0;
  bool mirrored = false;
};

// The fans of one vertex. Faces that meet over edges of two faces follow each other in a fan; a boundary or an edge of
// more faces ends it. Faces that name a vertex twice are in no fan. At an odd vertex every fan has sides of its own, a
// first and a last one also where it is closed.
class Fans {
 public:
  const FanCorner& corner(Index halfedge) const { return corners_[place(halfedge)]; }
  std::span<const Sector> sectors() const { return sectors_; }
  Index side_count() const { return side_count_; }
  // Whether the faces are several fans, or one that ends with edges of three faces and more.
  bool is_odd() const { return odd_; }
  // Whether there is a shadow behind the vertex, whatever the light: it has one fan, whose angles sum to more than a
  // full turn, or to more than half of one where it is open.
  bool bends_light() const;
  // A closed fan's first side may be named as its last, with the sum of all angles. (Odd vertices have two.)
  bool is_seam(const Direction& at) const;

  // A corner's two sides: along the halfedge that names it, or along the one before.
  Index side(Index corner, bool own) const {
    const FanCorner& c = this->corner(corner);
    return own != c.mirrored ? c.first_side : c.last_side;
  }
  Direction direction(Index corner, bool own) const {
    const FanCorner& c = this->corner(corner);
    return {own != c.mirrored ? c.low : c.high, c.fan, c.sector};
  }

 private:
  friend class FanBuilder;
  std::size_t place(Index halfedge) const;

  std::span<const Index> halfedges_;  // of the mesh: all corners at the vertex
  std::vector<FanCorner> corners_;    // as these
  std::vector<Sector> sectors_;
  Index side_count_ = 0;
  bool odd_ = false;
};

// Lays out vertices, one after the other. O(faces at the vertex), but for a logarithm.
class FanBuilder {
 public:
  explicit FanBuilder(const Mesh& mesh) : mesh_(mesh) {}

  // Not to be used for longer than the mesh.
  Fans at(Index v);

 private:
  struct Loose {
    Index corner = kNoIndex;
    bool mirrored = false;
  };
  struct Range {
    Index begin = 0, end = 0;  // in all_
    bool closed = false;
  };

  Loose beside(Loose at, bool forward) const;
  bool string_together(Loose from);
  bool ends_with_more() const;
  Index lay_out(const Range& range, Index fan, Index side, bool ends_meet, Fans& fans) const;
  void share_sectors(Fans& fans) const;

  const Mesh& mesh_;
  // Of the vertex at hand: one fan, and all of them one after the other.
  Index vertex_ = 0;
  std::vector<Loose> fan_, all_;
  std::vector<Range> ranges_;
  std::vector<double> around_;
  std::vector<bool> done_;  // as Fans::corners_
};

}  // namespace brushfire::carried_source
