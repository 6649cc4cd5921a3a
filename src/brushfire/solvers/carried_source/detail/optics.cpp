// Directions and sets of all sides.
#include <brushfire/solvers/carried_source/detail/optics.h>

#include <brushfire/core/cancel.h>

#include <algorithm>
#include <cmath>

namespace brushfire::carried_source {
namespace {

constexpr double kSeamRounding = 1e-9;  // of angles, by far

}  // namespace

Optics::Optics(const Mesh& mesh, const Fans& fans) : mesh_(mesh), fans_(fans) {
  lenses_.emplace_back();  // number 0: nothing comes through
  begin_.reserve(mesh.vertex_count() + std::size_t{1});
  begin_.push_back(0);
  for (Index v = 0; v < mesh.vertex_count(); ++v) begin_.push_back(begin_.back() + fans.side_count(v));
  sides_.resize(begin_.back());
  Poll poll;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    for (const Index h : mesh.corners(v)) {
      if (!mesh.is_face_usable(Mesh::face_of(h))) continue;
      poll();
      const FanCorner& c = fans.corner(h);
      sides_[begin_[v] + c.first_side] = of(v, {c.low, c.fan, c.sector});
      // The last side of an open fan is no other corner's first.
      const bool ends = fans.is_odd(v) || !(fans.sectors(v).front().around < kInfinity);
      if (ends) sides_[begin_[v] + c.last_side] = of(v, {c.high, c.fan, c.sector});
    }
  }
}

bool Optics::is_seam(Index v, const Direction& at) const {
  const std::span<const Sector> sectors = fans_.sectors(v);
  if (at.sector >= sectors.size() || fans_.is_odd(v)) return false;
  return at.angle > sectors[at.sector].around - kSeamRounding;
}

Optic Optics::of(Index v, const Direction& named) {
  const Direction at = shared(v, named);
  Optic o;
  o.angle = at.angle;
  o.c = std::cos(at.angle), o.s = std::sin(at.angle);
  o.sector = at.sector;
  if (!fans_.is_odd(v)) {
    o.sets = sight_of(fans_.sectors(v), at.angle);
    return o;
  }
  const auto [ends, is_new] = fan_ends_.try_emplace(v);
  if (is_new) ends->second = ends_of_fans(mesh_, fans_, v);
  for (const Hand hand : {Hand::Left, Hand::Right}) {
    o.lenses[static_cast<std::size_t>(hand)] = keep(lenses_of(fans_.sectors(v), ends->second, at, hand));
  }
  return o;
}

Index Optics::keep(const Lenses& lenses) {
  if (std::none_of(lenses.begin(), lenses.end(), [](const Lens& l) { return l.visible; })) return 0;
  lenses_.push_back(lenses);
  return static_cast<Index>(lenses_.size() - 1);
}

}  // namespace brushfire::carried_source
