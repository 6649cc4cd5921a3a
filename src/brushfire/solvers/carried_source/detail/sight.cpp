// Sorts sectors by the angle between their light and an edge.
#include <brushfire/solvers/carried_source/detail/sight.h>

#include <algorithm>
#include <cmath>

namespace brushfire::carried_source {
namespace {

constexpr double kRounding = 1e-9;  // of angles, by far

enum class Sight : std::uint8_t { Plain, Turned, Dark };

// The source lies `behind` the edge, that is below it as seen from the target, by an angle in [0, pi], or no light
// comes by.
Sight sight_of(const Sector& sector, double angle, Hand hand) {
  const double half = (sector.high - sector.low) / 2, middle = (sector.low + sector.high) / 2;
  const double behind = hand == Hand::Left ? angle - middle : middle - angle;
  if (std::abs(behind) < half - kRounding) return Sight::Plain;  // the edge is in this sector
  if (behind > 0) return behind - half > kPi || behind + half > 2 * kPi ? Sight::Dark : Sight::Plain;
  if (behind + sector.around - half < kPi) return Sight::Turned;
  return half - behind > kPi ? Sight::Dark : Sight::Plain;
}

// By the angle around the vertex from the source to the edge: "d" is +-(phi - turn), phi the source's.
Lens lens(double turn, bool reflected, Hand hand) {
  const double c = std::cos(turn), s = std::sin(turn);
  const double sign = (hand == Hand::Left) != reflected ? 1 : -1;
  return {c, s, -sign * s, sign * c, true};
}

// The edge of a halfedge by the same number for all its faces.
Index edge_of(const Mesh& mesh, Index h) {
  Index lowest = h;
  for (Index g = mesh.opposite(h); g != h; g = mesh.opposite(g)) lowest = std::min(lowest, g);
  return lowest;
}

}  // namespace

SightSets sight_of(std::span<const Sector> sectors, double angle) {
  SightSets sets;
  for (const Hand hand : {Hand::Left, Hand::Right}) {
    const auto i = static_cast<std::size_t>(hand);
    for (std::size_t k = 0; k < sectors.size(); ++k) {
      const Sight sight = sight_of(sectors[k], angle, hand);
      const auto bit = static_cast<SectorSet>(1u << k);
      if (sight == Sight::Turned) sets.turned[i] = static_cast<SectorSet>(sets.turned[i] | bit);
      if (sight == Sight::Dark) sets.dark[i] = static_cast<SectorSet>(sets.dark[i] | bit);
    }
  }
  return sets;
}

std::vector<FanEnd> ends_of_fans(const Mesh& mesh, const Fans& fans, Index v) {
  std::vector<FanEnd> ends;
  const std::span<const Sector> sectors = fans.sectors();
  // The first and the last angle of each fan.
  const auto is_open = [&](Index fan, double& last) {
    bool open = false;
    for (const Sector& s : sectors) {
      if (s.fan == fan) open = !(s.around < kInfinity), last = s.high;
    }
    return open;
  };
  for (const Index h : mesh.corners(v)) {
    if (!mesh.is_face_usable(Mesh::face_of(h)) || fans.corner(h).sector == kSharedSector) continue;
    const FanCorner& c = fans.corner(h);
    double last = 0;
    if (!is_open(c.fan, last)) continue;
    if (c.low == 0) ends.push_back({c.fan, 0, true, edge_of(mesh, c.mirrored ? Mesh::previous(h) : h)});
    if (c.high == last) ends.push_back({c.fan, last, false, edge_of(mesh, c.mirrored ? h : Mesh::previous(h))});
  }
  return ends;
}

Lenses lenses_of(std::span<const Sector> sectors, std::span<const FanEnd> ends, const Direction& at, Hand hand) {
  Lenses lenses;
  if (at.sector == kSharedSector && sectors.size() < kSectors) return lenses;
  for (std::size_t k = 0; k < sectors.size(); ++k) {
    const Sector& sector = sectors[k];
    const double half = (sector.high - sector.low) / 2, middle = (sector.low + sector.high) / 2;
    if (sector.fan == at.fan) {
      const Sight sight = sight_of(sector, at.angle, hand);
      const double whole = hand == Hand::Left ? sector.around : -sector.around;
      if (sight != Sight::Dark) lenses[k] = lens(at.angle + (sight == Sight::Turned ? whole : 0), false, hand);
      const double behind = hand == Hand::Left ? at.angle - middle : middle - at.angle;
      if (sector.around < kInfinity || (sight == Sight::Plain && behind > -half)) continue;
    }
    double nearest = kPi;
    for (const FanEnd& to : ends) {
      if (to.fan != at.fan || to.is_first != (hand == Hand::Left)) continue;
      for (const FanEnd& from : ends) {
        if (from.fan != sector.fan || from.edge != to.edge || &from == &to) continue;
        const double between = std::abs(at.angle - to.angle) + std::abs(middle - from.angle);
        if (between - half >= nearest) continue;
        nearest = between - half;
        // The light leaves its fan on the side on which it enters this one: the fans are turned alike, or not.
        const bool reflected = from.is_first == to.is_first;
        lenses[k] = reflected ? lens(to.angle + from.angle - at.angle, true, hand)
                              : lens(at.angle - to.angle + from.angle, false, hand);
      }
    }
  }
  return lenses;
}

}  // namespace brushfire::carried_source
