// Directions from the corners of a face to points of it.
#include <brushfire/solvers/carried_source/detail/points.h>

#include <brushfire/mesh/detail/flat_face.h>

#include <algorithm>
#include <cmath>

namespace brushfire::carried_source {

const Fans& Points::fans(Index v) {
  const auto [at, is_new] = fans_.try_emplace(v);
  if (is_new) at->second = builder_.at(v);
  return at->second;
}

void Points::add_face(Index f, const std::array<double, 3>& weights) {
  for (Index h = 3 * f; h < 3 * f + 3; ++h) {
    if (mesh_.length(h) == 0) {
      near_.push_back({mesh_.from(h), mesh_.length(Mesh::previous(h)) * weights[Mesh::previous(h) % 3], {}, false, 0});
      continue;
    }
    const Vec2 at = point_over(mesh_, h, weights);
    const FanCorner& corner = this->corner(h);
    const double turn = std::atan2(at.y, at.x), distance = norm(at);
    const double angle = corner.mirrored ? corner.high - turn : corner.low + turn;
    near_.push_back(
        {mesh_.from(h), distance, {distance * std::cos(angle), distance * std::sin(angle)}, true, corner.sector});
  }
}

// Points of an edge have a name in each of its faces: the one that all names lead to, so that they give the same bits.
PointLocation Points::by_lowest_halfedge(const PointLocation& at) const {
  const Index h = at.halfedge;
  Index lowest = h;
  for (Index g = mesh_.opposite(h); g != h; g = mesh_.opposite(g)) lowest = std::min(lowest, g);
  return on_other_halfedge(mesh_, at, lowest);
}

std::span<const Points::Near> Points::around(const PointLocation& named, int crossings, double limit) {
  near_.clear();
  const bool on_edge = named.on == PointLocation::On::Edge && mesh_.is_face_usable(named.face);
  const PointLocation at = on_edge ? by_lowest_halfedge(named) : named;
  if (at.on == PointLocation::On::Vertex) {
    near_.push_back({at.vertex, 0, {}, true, 0});
  } else if (!mesh_.is_face_usable(at.face)) {
    for (const detail::Seed& s : seeds_.in_own_faces(mesh_, at)) near_.push_back({s.vertex, s.distance, {}, false, 0});
  } else if (at.on == PointLocation::On::Interior) {
    add_face(at.face, at.weights);
  } else {
    Index g = at.halfedge;
    do {
      add_face(Mesh::face_of(g), on_other_halfedge(mesh_, at, g).weights);
      g = mesh_.opposite(g);
    } while (g != at.halfedge);
  }
  if (at.on == PointLocation::On::Vertex && crossings == 0) return near_;
  for (const detail::Seed& s : seeds_.in_sight(mesh_, at, crossings, limit)) {
    if (s.corner == kNoIndex) continue;
    const FanCorner& corner = this->corner(s.corner);
    const double angle = corner.mirrored ? corner.high - s.turn : corner.low + s.turn;
    near_.push_back(
        {s.vertex, s.distance, {s.distance * std::cos(angle), s.distance * std::sin(angle)}, true, corner.sector});
  }
  return near_;
}

SourceAt<double> Points::see(Index v, const Known& known, const Direction& side, Hand hand, double length) {
  const Fans& fans = this->fans(v);
  const std::span<const Sector> sectors = fans.sectors();
  const double sign = hand == Hand::Left ? 1 : -1;
  if (fans.is_odd()) {
    const Lens lens = lenses_of(sectors, ends_of_fans(mesh_, fans, v), side, hand)[known.sector];
    const double x = lens.xx * known.to_source.x + lens.xy * known.to_source.y;
    const double y = lens.yx * known.to_source.x + lens.yy * known.to_source.y;
    return source_below<double>(known.value, known.sigma, x, y, false, !lens.visible, 1, 0, 1, 0, 1, length);
  }
  const SightSets sets = sight_of(sectors, side.angle);
  const auto i = static_cast<std::size_t>(hand);
  const double around = sectors.front().around, turned = side.angle + sign * (around < kInfinity ? around : 0);
  return source_below<double>(known.value, known.sigma, known.to_source.x, known.to_source.y,
                              (sets.turned[i] >> known.sector & 1u) != 0, (sets.dark[i] >> known.sector & 1u) != 0,
                              std::cos(side.angle), std::sin(side.angle), std::cos(turned), std::sin(turned), sign,
                              length);
}

Points::Lights Points::below_edge(Index h, const Known& from, const Known& to) {
  const Index next = Mesh::next(h);
  const double length = mesh_.length(h);
  const Hand here = corner(h).mirrored ? Hand::Right : Hand::Left;
  const Hand there = corner(next).mirrored ? Hand::Left : Hand::Right;
  // As the side that all faces at it share: sets are those of angles below the sum of all.
  const auto side = [&](Index v, Index corner, bool own) {
    const Fans& fans = this->fans(v);
    const Direction d = fans.direction(corner, own);
    return within(fans.sectors(), d.fan, d.angle);
  };
  Lights lights{see(mesh_.from(h), from, side(mesh_.from(h), h, true), here, length),
                see(mesh_.to(h), to, side(mesh_.to(h), next, false), there, length)};
  lights.to.x = length - lights.to.x;
  return lights;
}

double Points::through_edge(Index h, Vec2 at, const Known& from, const Known& to) {
  const Lights l = below_edge(h, from, to);
  return offer_over<double>(mesh_.length(h), at.x, at.y, norm(at), from.value, to.value, l.from, l.to).value;
}

std::array<double, 2> Points::from_either_end(Index h, Vec2 at, const Known& from, const Known& to) {
  Lights l = below_edge(h, from, to);
  const double length = mesh_.length(h);
  l.to.x = length - l.to.x;
  return {offer_beside<double>(length, at.x, at.y, norm(at), from.value, to.value, l.from).value,
          offer_beside<double>(length, length - at.x, at.y, norm(Vec2{length - at.x, at.y}), to.value, from.value, l.to)
              .value};
}

}  // namespace brushfire::carried_source
