// From which sectors of a vertex light passes below an edge at it, and how its direction reads in the edge's frame.
#pragma once

#include <brushfire/solvers/carried_source/detail/fans.h>

#include <array>
#include <span>
#include <vector>

namespace brushfire::carried_source {

// On which side of an edge, as it leaves the vertex, the target lies.
enum class Hand : std::uint8_t { Left, Right };

// Of an edge, by Hand. Directions are kept as vectors, which forget whole turns, where the sum of all angles around a
// vertex is not 2 pi: the sector says which turn is meant. Light from a sector in `turned` is turned by that sum first;
// what comes from one in `dark` never lights the edge, though the vector may look so: a saddle or a boundary casts a
// shadow there.
struct SightSets {
  SectorSet turned[2] = {0, 0}, dark[2] = {0, 0};
};

// At a vertex with one fan.
SightSets sight_of(std::span<const Sector> sectors, double angle);

// A vector becomes (xx x + xy y, yx x + yy y); nothing where the light does not come to the edge.
struct Lens {
  double xx = 0, xy = 0, yx = 0, yy = 0;
  bool visible = false;
};
using Lenses = std::array<Lens, kSectors>;

// Where a fan of an odd vertex ends.
struct FanEnd {
  Index fan = 0;
  double angle = 0;
  bool is_first = false;
  Index edge = kNoIndex;
};
// Of all fans but those that share a sector: two of each that is not closed.
std::vector<FanEnd> ends_of_fans(const Mesh& mesh, const Fans& fans, Index v);

// At an odd vertex, by sector: light from another fan comes over an edge that both fans end with, straight on.
Lenses lenses_of(std::span<const Sector> sectors, std::span<const FanEnd> ends, const Direction& at, Hand hand);

}  // namespace brushfire::carried_source
