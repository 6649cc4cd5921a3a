// Unrolls faces behind obtuse corners, with the directions that vertices on the way know.
#include <brushfire/solvers/carried_source/detail/unrolled.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/planar.h>
#include <brushfire/solvers/carried_source/detail/need.h>
#include <brushfire/solvers/detail/unfolding_limit.h>
#include <brushfire/solvers/fast_marching/detail/angle.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace brushfire::carried_source {
namespace {

// Of complex numbers: b turned by a, or back by it.
Vec2 turned(Vec2 a, Vec2 b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }
Vec2 turned_back(Vec2 a, Vec2 b) { return {a.x * b.x + a.y * b.y, a.x * b.y - a.y * b.x}; }

Vec2 unit(Vec2 a) {
  const double length = norm(a);
  return length > 0 ? Vec2{a.x / length, a.y / length} : Vec2{1, 0};
}

// A face by the lengths of its edges from the one of a halfedge on.
struct Shape {
  double length, next, previous, double_area;
};
Shape shape_of(const Mesh& mesh, Index h) {
  const Mesh::FaceGeometry face = mesh.face_geometry(Mesh::face_of(h));
  const Index k = h % 3;
  return {face.lengths[k], face.lengths[(k + 1) % 3], face.lengths[(k + 2) % 3], face.double_area};
}

}  // namespace

template <class T>
Unroller<T>::Unroller(const Mesh& mesh, Sides<T>& sides)
    : mesh_(mesh),
      of_fans_(sides),
      first_side_(mesh.vertex_count(), kNoIndex),
      first_update_(mesh.vertex_count(), kNoIndex) {}

template <class T>
void Unroller<T>::unroll_all() {
  detail::UnfoldingLimit limit(mesh_.face_count());
  sides_.reserve(of_fans_.obtuse().size()), updates_.reserve(4 * of_fans_.obtuse().size());
  Poll poll{256};
  for (const ObtuseCorner& obtuse : of_fans_.obtuse()) {
    poll();
    int crossed = 0;
    const std::size_t before = updates_.size();
    of_fans_[obtuse.corner].is_split = unroll(obtuse, limit.faces(), crossed);
    limit.add((updates_.size() - before) / 2);
    most_crossed_ = std::max(most_crossed_, crossed);
  }
}

// The corner of a face that lies in the plane as it is, or mirrored, between two others, counter-clockwise.
template <class T>
typename Unroller<T>::Anchor Unroller<T>::anchor(Index corner, bool mirrored, Vec2 at, Vec2 next, Vec2 previous) const {
  const bool same_turn = of_fans_.is_mirrored(corner) == mirrored;
  return {{mesh_.from(corner), at}, corner, same_turn, (same_turn ? next : previous) - at, {}, false};
}

template <class T>
Heading Unroller<T>::heading(const Anchor& from, Vec2 way) const {
  const Vec2 turn = turned_back(unit(from.along), way);
  const double size = of_fans_.is_alone(from.vertex) ? std::atan2(std::abs(turn.y), turn.x)
                                                     : fast_marching::portable::quick_angle(turn.x, std::abs(turn.y));
  Heading h = of_fans_.first_side(from.corner);
  h.unit = unit(from.same_turn ? turned(turn, h.unit) : turned_back(turn, h.unit));
  h.angle += (turn.y < 0) == from.same_turn ? -size : size;
  return h;
}

template <class T>
typename Unroller<T>::Made Unroller<T>::make_side(const Anchor& from, const Anchor& to, double length) {
  const Vec2 way = unit(to.at - from.at);
  const Optic here = of_fans_.optic(from.vertex, heading(from, way));
  const Heading back = heading(to, {-way.x, -way.y});
  const Optic there = of_fans_.optic(to.vertex, back);
  UnrolledSide<T>& s = sides_.emplace_back();
  const auto number = static_cast<Index>(sides_.size() - 1);
  s.next = std::exchange(first_side_[from.vertex], number);
  s.end = to.vertex;
  s.angle = static_cast<float>(here.angle);
  LensNumbers lenses;
  set_side(static_cast<T>(length), here, there, of_fans_[to.corner].bends, s.side, s.dark, lenses);
  if (lenses.any()) s.lenses = static_cast<Index>(lenses_.size()), lenses_.push_back(lenses);
  constexpr double kWholeTurn = 1e-3;  // or less than nothing
  return {SideName::unrolled(number), back.angle - there.angle > kWholeTurn};
}

// What `own`, the right or the left one of a triangle, offers to its corner; `edge`: its side to the other one, where
// that is a fan's.
template <class T>
void Unroller<T>::add_update(const Anchor& corner, Anchor& own, Anchor& other, bool is_right, Index edge) {
  const double length = norm(other.at - own.at), along = norm(own.at);
  if (!(length > 0) || !(along > 0)) return;
  UnrolledUpdate<T> u;
  u.support = edge != kNoIndex ? SideName::of_fan(edge) : make_side(own, other, length).side;
  if (own.to_corner.is_none()) {
    const Made made = make_side(own, corner, along);
    own.to_corner = made.side, own.ends_at_seam = made.ends_at_seam;
  }
  u.target = own.to_corner;
  u.length = static_cast<T>(length);
  u.need = need_of(static_cast<T>(along), static_cast<T>(norm(other.at)), u.length);
  u.update.bits = (of_fans_.sector(corner.corner) << Update::kSectorShift) | (own.ends_at_seam ? Update::kSeam : 0) |
                  (own.same_turn == is_right ? 0 : Update::kHere) | (other.same_turn == is_right ? Update::kThere : 0) |
                  (corner.same_turn == is_right ? Update::kSameTurn : 0);
  u.next = std::exchange(first_update_[own.vertex], static_cast<Index>(updates_.size()));
  updates_.push_back(u);
}

template <class T>
void Unroller<T>::add_triangle(const Anchor& corner, Anchor& right, Anchor& left, Index right_edge, Index left_edge) {
  add_update(corner, right, left, true, right_edge);
  add_update(corner, left, right, false, left_edge);
}

// The triangles that split the angle at an obtuse corner. Whether they split it into acute ones; false where it ended
// before: at a boundary, at an edge of more faces, after `most`. `crossed`: how many faces it looked at.
template <class T>
bool Unroller<T>::unroll(const ObtuseCorner& obtuse, int most, int& crossed) {
  const Index h = obtuse.corner, across = Mesh::next(h), third = Mesh::previous(h);
  const Shape own = shape_of(mesh_, h);
  const Vec2 at_right{own.length, 0};
  const Vec2 at_left = apex_over_edge(own.length, own.previous, own.next, own.double_area);
  const Anchor corner = anchor(h, false, {0, 0}, at_right, at_left);
  // What is left of the angle lies between right and left; the edge between right_end and left_end is crossed next.
  Anchor right = anchor(across, false, at_right, at_left, {0, 0}),
         left = anchor(third, false, at_left, {0, 0}, at_right);
  right.to_corner = SideName::of_fan(of_fans_.number(across, false)), right.ends_at_seam = of_fans_.is_seam(h, true);
  left.to_corner = SideName::of_fan(of_fans_.number(third, true)), left.ends_at_seam = of_fans_.is_seam(h, false);
  Place right_end = right, left_end = left;
  Index over = across;
  double over_length = own.next;
  for (crossed = 0; crossed < most && over_length > 0;) {
    const Index g = crossed == 0 ? obtuse.behind : of_fans_.neighbour(over);
    if (g == kNoIndex || g == over) return false;
    ++crossed;
    // The face behind, counter-clockwise in the plane: left end, right end, apex; `g` runs that way unless mirrored.
    const bool mirrored = mesh_.from(g) != left_end.vertex;
    const Index to_apex_from_left = mirrored ? Mesh::next(g) : Mesh::previous(g);
    const Index to_apex_from_right = mirrored ? Mesh::previous(g) : Mesh::next(g);
    const Index at_apex = Mesh::previous(g), apex = mesh_.from(at_apex);
    if (apex == corner.vertex) return false;
    const Shape face = shape_of(mesh_, g);
    const double from_left = mirrored ? face.next : face.previous, from_right = mirrored ? face.previous : face.next;
    const Vec2 in_frame = apex_over_edge(face.length, from_left, from_right, face.double_area);
    const Vec2 along = (1 / face.length) * (right_end.at - left_end.at);
    const Vec2 at = left_end.at + turned(along, in_frame);
    const bool beyond_right = cross(right.at, at) <= 0, beyond_left = cross(at, left.at) <= 0;
    const bool between = !beyond_right && !beyond_left;
    const bool splits_right = between && dot(right.at, at) > 0, splits_left = between && dot(at, left.at) > 0;
    Anchor behind = anchor(at_apex, mirrored, at, left_end.at, right_end.at);
    // The sides along an edge of this face, at its two ends.
    const auto side_at = [&](Index edge, Index vertex) {
      return mesh_.from(edge) == vertex ? of_fans_.number(edge, true) : of_fans_.number(Mesh::next(edge), false);
    };
    if (splits_right && behind.vertex != right.vertex) {
      const bool is_edge = right.vertex == right_end.vertex && right.at == right_end.at;
      add_triangle(corner, right, behind, is_edge ? side_at(to_apex_from_right, right.vertex) : kNoIndex,
                   is_edge ? side_at(to_apex_from_right, apex) : kNoIndex);
    }
    if (splits_left && behind.vertex != left.vertex) {
      const bool is_edge = left.vertex == left_end.vertex && left.at == left_end.at;
      add_triangle(corner, behind, left, is_edge ? side_at(to_apex_from_left, apex) : kNoIndex,
                   is_edge ? side_at(to_apex_from_left, left.vertex) : kNoIndex);
    }
    if (splits_right && splits_left) return true;
    if (splits_right || (!splits_left && beyond_right)) {  // go on to the left
      if (splits_right) right = behind;
      right_end = behind, over = to_apex_from_left, over_length = from_left;
    } else {
      if (splits_left) left = behind;
      left_end = behind, over = to_apex_from_right, over_length = from_right;
    }
  }
  return false;
}

template class Unroller<float>;
template class Unroller<double>;

}  // namespace brushfire::carried_source
