// Directions and sets of all sides.
#include <brushfire/solvers/carried_source/detail/optics.h>

#include <algorithm>
#include <cmath>

namespace brushfire::carried_source {

Index LensStore::keep(const Lenses& lenses) {
  if (std::none_of(lenses.begin(), lenses.end(), [](const Lens& l) { return l.visible; })) return 0;
  lenses_.push_back(lenses);
  return static_cast<Index>(lenses_.size() - 1);
}

VertexOptics::VertexOptics(const Mesh& mesh, Index v, Fans fans, LensStore& lenses) : fans_(std::move(fans)) {
  if (fans_.is_odd()) ends_ = ends_of_fans(mesh, fans_, v);
  sides_.resize(fans_.side_count());
  for (const Index h : mesh.corners(v)) {
    if (!mesh.is_face_usable(Mesh::face_of(h))) continue;
    const FanCorner& c = fans_.corner(h);
    sides_[c.first_side] = in_direction({c.low, c.fan, c.sector}, lenses);
    // The last side of an open fan is no other corner's first.
    const bool ends = fans_.is_odd() || !(fans_.sectors().front().around < kInfinity);
    if (ends) sides_[c.last_side] = in_direction({c.high, c.fan, c.sector}, lenses);
  }
}

Optic VertexOptics::in_direction(const Direction& named, LensStore& lenses) const {
  const Direction at = fans_.is_seam(named) ? within(fans_.sectors(), named.fan, 0) : named;
  Optic o;
  o.angle = at.angle;
  o.c = std::cos(at.angle), o.s = std::sin(at.angle);
  o.sector = at.sector;
  if (!fans_.is_odd()) {
    o.sets = sight_of(fans_.sectors(), at.angle);
    return o;
  }
  for (const Hand hand : {Hand::Left, Hand::Right}) {
    o.lenses[static_cast<std::size_t>(hand)] = lenses.keep(lenses_of(fans_.sectors(), ends_, at, hand));
  }
  return o;
}

}  // namespace brushfire::carried_source
