// Arms around a place of a curve, and the one clockwise of a path.
#include <brushfire/queries/detail/curve_star.h>

#include <brushfire/mesh/detail/flat_face.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace brushfire::detail {
namespace {

double wrapped(double angle, double turn) {
  const double a = std::fmod(angle, turn);
  return a < 0 ? a + turn : a;
}

// A segment by which a curve leaves a place, forwards or backwards, and the place towards which; kNoIndex: it ends.
struct Way {
  Index segment = kNoIndex, place = kNoIndex;
};
Way way_from(const Mesh& mesh, const LocatedCurve& curve, Index place, bool forwards) {
  Way first;
  Index at = place;
  for (std::size_t steps = 0; steps < curve.segments.size(); ++steps) {
    const Index i = forwards ? curve.places[at].after : curve.places[at].before;
    if (i == kNoIndex) break;
    const CurveSegment& s = curve.segments[i];
    at = forwards ? s.to_place : s.from_place;
    if (first.place == kNoIndex) first = {i, at};
    if (s.length > kNoDirection * longest_edge(mesh, s.face) * mesh.unit()) {
      return common_face(mesh, curve.places[place].at, curve.places[at].at) != kNoIndex ? Way{i, at} : first;
    }
  }
  return {};
}

}  // namespace

double longest_edge(const Mesh& mesh, Index face) {
  return std::max({mesh.length(3 * face), mesh.length(3 * face + 1), mesh.length(3 * face + 2)});
}

SurfacePoint point_of(const CurvePlace& place) { return {place.at.face, place.at.weights}; }

CurveStar::CurveStar(const Mesh& mesh, const LocatedCurve& curve, std::span<const Index> places,
                     const std::vector<bool>& retraced, Index face)
    : angles_(face == kNoIndex ? LeavingAngles(mesh, point_of(curve.places[places.front()]))
                               : LeavingAngles(mesh, point_of(curve.places[places.front()]), face)),
      is_fan_(face != kNoIndex),
      is_arc_(!angles_.closed()),
      // The sector outside of a boundary is some angle more.
      turn_(angles_.total() + (is_arc_ ? 1 : 0)),
      grows_left_(angles_.grow_counter_clockwise()) {
  for (const Index p : places) {
    add(mesh, curve, p, false, retraced);
    add(mesh, curve, p, true, retraced);
  }
}

void CurveStar::add(const Mesh& mesh, const LocatedCurve& curve, Index place, bool goes_out,
                    const std::vector<bool>& retraced) {
  const Way way = way_from(mesh, curve, place, goes_out);
  if (way.place == kNoIndex || retraced[way.segment]) return;
  const SurfacePoint next = point_of(curve.places[way.place]);
  if (!is_fan_) return arms_.push_back({angles_.towards(next), goes_out});
  std::vector<double> angles = angles_.all_towards(next);
  if (!is_arc_ && !angles.empty()) angles.erase(angles.begin() + 1, angles.end());  // the others are the same
  for (const double angle : angles) arms_.push_back({angle, goes_out});
}

CurveSide CurveStar::side_of(const SurfacePoint& from) const {
  if (arms_.empty()) return CurveSide::None;
  const double angle = is_fan_ ? angles_.all_towards(from).front() : angles_.towards(from);
  // Counter-clockwise from an arm to the path.
  const auto from_arm = [&](const Arm& a) { return grows_left_ ? angle - a.angle : a.angle - angle; };
  const auto behind = [&](const Arm& a) { return wrapped(from_arm(a), turn_); };
  if (is_fan_ && is_arc_) return side_between_borders(from_arm);
  if (arms_.size() == 1) {
    return is_in_first_half(from_arm(arms_[0])) == arms_[0].goes_out ? CurveSide::Left : CurveSide::Right;
  }
  const auto nearer = [&](const Arm& a, const Arm& b) { return behind(a) < behind(b); };
  return std::min_element(arms_.begin(), arms_.end(), nearer)->goes_out ? CurveSide::Left : CurveSide::Right;
}

// In a fan whose borders lead to other fans, the curve goes on there: clockwise of all arms it is the other side of the
// next one.
template <class FromArm>
CurveSide CurveStar::side_between_borders(const FromArm& from_arm) const {
  const Arm* best = &arms_.front();
  for (const Arm& a : arms_) {
    const double there = from_arm(a), known = from_arm(*best);
    if (there >= 0 ? !(known >= 0 && known <= there) : known < 0 && there > known) best = &a;
  }
  return best->goes_out == (from_arm(*best) >= 0) ? CurveSide::Left : CurveSide::Right;
}

// Of the two that an arm and the line straight on make of the directions. On an arc the latter may lie outside.
bool CurveStar::is_in_first_half(double from_arm) const {
  if (is_arc_) return (from_arm >= 0) == (std::abs(from_arm) <= kPi);
  return wrapped(from_arm, turn_) <= 0.5 * turn_;
}

}  // namespace brushfire::detail
