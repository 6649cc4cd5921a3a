// Unrolls faces behind obtuse corners, with the directions that vertices on the way know.
#include <brushfire/solvers/carried_source/detail/unrolled.h>

#include <brushfire/core/detail/planar.h>

#include <cmath>

namespace brushfire::carried_source {
namespace {

constexpr double kRightAngle = 1e-9;  // rounding of coordinates tilts right angles by less: not obtuse yet

double angle_of(Vec2 a) { return std::atan2(a.y, a.x); }
double reduced(double angle) { return angle - 2 * kPi * std::round(angle / (2 * kPi)); }

// The side at a vertex along halfedge h of a face, by the corner there.
Index side_along(const Mesh& mesh, const Fans& fans, Index h, Index vertex) {
  return mesh.from(h) == vertex ? fans.side(h, true) : fans.side(Mesh::next(h), false);
}

}  // namespace

bool Unroller::is_obtuse(Index corner) const {
  const double a = lengths_[corner], b = lengths_[Mesh::previous(corner)];
  const double across = lengths_[Mesh::next(corner)];
  return a > 0 && b > 0 && a * a + b * b < across * across * (1 - kRightAngle);
}

// The corner of a face that lies in the plane as it is, or mirrored; `next`: the vertex at the corner's first side.
Unroller::Anchor Unroller::anchor(Index corner, bool mirrored, Vec2 at, Vec2 next) const {
  const FanCorner& c = fans_.corner(corner);
  const bool same_turn = c.mirrored == mirrored;
  return {mesh_.from(corner), at, same_turn, c.fan, same_turn ? c.low : c.high, angle_of(next - at), kNoIndex};
}

Direction Unroller::direction(const Anchor& from, Vec2 towards) const {
  const double turn = reduced(angle_of(towards - from.at) - from.in_plane);
  return fans_.within(from.vertex, from.fan, from.same_turn ? from.angle + turn : from.angle - turn);
}

UnrolledEnd Unroller::end(Index corner, const Anchor& at, const Anchor& other, Index side_to_other) const {
  UnrolledEnd e{at.vertex,         at.at,        at.same_turn, direction(at, {0, 0}), direction(at, other.at), {},
                at.side_to_corner, side_to_other};
  const FanCorner& c = fans_.corner(corner);  // its first side lies on the x axis, where its face is not mirrored
  const double turn = angle_of(at.at);
  e.from_corner = {c.mirrored ? c.high - turn : c.low + turn, c.fan, c.sector};
  return e;
}

bool Unroller::unroll(Index corner, int most, std::vector<UnrolledTriangle>& triangles, int& crossed) const {
  const Index across = Mesh::next(corner), third = Mesh::previous(corner);
  const double to_right = lengths_[corner], to_left = lengths_[third];
  const bool same_turn = !fans_.corner(corner).mirrored;
  Vec2 at_left = apex_over_edge(to_right, to_left, lengths_[across], mesh_.double_area(Mesh::face_of(corner)));
  // What is left of the angle lies between right and left; the edge between right_end and left_end is crossed next.
  Anchor right = anchor(across, false, {to_right, 0}, at_left), left = anchor(third, false, at_left, {0, 0});
  right.side_to_corner = fans_.side(across, false), left.side_to_corner = fans_.side(third, true);
  Anchor right_end = right, left_end = left;
  Index over = across;
  for (crossed = 0; crossed < most && lengths_[over] > 0;) {
    const Index g = mesh_.neighbour(over);
    if (g == over) return false;
    ++crossed;
    // The face behind, counter-clockwise in the plane: left end, right end, apex; `g` runs that way unless mirrored.
    const bool mirrored = mesh_.from(g) != left_end.vertex;
    const Index to_apex_from_left = mirrored ? Mesh::next(g) : Mesh::previous(g);
    const Index to_apex_from_right = mirrored ? Mesh::previous(g) : Mesh::next(g);
    const Index at_apex = Mesh::previous(g), apex = mesh_.from(at_apex);
    if (apex == mesh_.from(corner)) return false;
    const Vec2 own = apex_over_edge(lengths_[g], lengths_[to_apex_from_left], lengths_[to_apex_from_right],
                                    mesh_.double_area(Mesh::face_of(g)));
    const Vec2 along = (1 / lengths_[g]) * (right_end.at - left_end.at);
    const Vec2 at = left_end.at + own.x * along + own.y * Vec2{-along.y, along.x};
    // At the apex the next vertex counter-clockwise is the left end.
    const Anchor behind = anchor(at_apex, mirrored, at, left_end.at);
    const bool beyond_right = cross(right.at, at) <= 0, beyond_left = cross(at, left.at) <= 0;
    const bool between = !beyond_right && !beyond_left;
    const bool splits_right = between && dot(right.at, at) > 0, splits_left = between && dot(at, left.at) > 0;
    const auto side_of = [&](Index h, Index vertex) { return side_along(mesh_, fans_, h, vertex); };
    if (splits_right && behind.vertex != right.vertex) {
      const bool edge = right.vertex == right_end.vertex && right.at == right_end.at;
      const Index there = edge ? side_of(to_apex_from_right, right.vertex) : kNoIndex;
      const Index back = edge ? side_of(to_apex_from_right, apex) : kNoIndex;
      triangles.push_back({corner, same_turn, end(corner, right, behind, there), end(corner, behind, right, back)});
    }
    if (splits_left && behind.vertex != left.vertex) {
      const bool edge = left.vertex == left_end.vertex && left.at == left_end.at;
      const Index there = edge ? side_of(to_apex_from_left, left.vertex) : kNoIndex;
      const Index back = edge ? side_of(to_apex_from_left, apex) : kNoIndex;
      triangles.push_back({corner, same_turn, end(corner, behind, left, back), end(corner, left, behind, there)});
    }
    if (splits_right && splits_left) return true;
    if (splits_right || (!splits_left && beyond_right)) {  // go on to the left
      if (splits_right) right = behind;
      right_end = behind, over = to_apex_from_left;
    } else {
      if (splits_left) left = behind;
      left_end = behind, over = to_apex_from_right;
    }
  }
  return false;
}

}  // namespace brushfire::carried_source
