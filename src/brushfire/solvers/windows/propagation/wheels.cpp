// Turns about a hub, and where a ray comes to the rim.
#include <brushfire/solvers/windows/propagation/wheels.h>

#include <brushfire/core/detail/sort.h>
#include <brushfire/solvers/windows/propagation/fan.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// Nearer to the rim than by this share of a spoke, light goes on face by face: it may graze a vertex.
constexpr double kClearOfRim = 1 - 0x1p-20;
// Less than half a turn, in which a ray is at a place of its own on every spoke that it meets.
constexpr double kMostOfHalfTurn = 3;
// Fewer faces are crossed one by one.
constexpr Index kFewFaces = 4;
// Blocks of spokes that are looked at; behind the last one the window may stop anywhere.
constexpr int kLooks = 128;

// Where a ray that starts from a source and meets a spoke at `from` from the hub, meets another one that is turned by
// u; negative or infinite: it does not come there. In a frame that has the hub at its origin.
Real place_on(Vec2 u, Vec2 source, Real from) { return -source.y * from / (-u.x * source.y - u.y * (from - source.x)); }

}  // namespace

void Wheels::add(std::span<const WindowFace> faces, Index halfedge) {
  const Index hub = faces[halfedge / 3].vertex[halfedge % 3];
  const auto is_good = [&](Index h) {
    const WindowFace& f = faces[h / 3];
    return f.usable && f.double_area > 0 && f.vertex[h % 3] == hub;
  };
  const auto over = [&](Index h) {  // to the face beyond, if it is alike
    const WindowFace& f = faces[h / 3];
    return f.beyond[h % 3] == Beyond::Face ? f.opposite[h % 3] : kNoIndex;
  };
  if (!is_good(halfedge)) return;
  // Back to the first face, or all around; h leaves the hub.
  Index first = halfedge;
  for (Index h = over(first); h != kNoIndex; h = over(first)) {
    h = 3 * (h / 3) + next3(h % 3);
    if (!is_good(h)) return;
    first = h;
    if (first == halfedge) break;
  }
  std::vector<Index> out, in;
  for (Index h = first; h != kNoIndex;) {
    if (!is_good(h)) return;
    out.push_back(h);
    in.push_back(3 * (h / 3) + previous3(h % 3));
    h = over(in.back());
    if (h == first) break;
  }
  if (place_.empty()) place_.resize(3 * faces.size());
  std::reverse(in.begin(), in.end());
  const bool closed = over(in.front()) == first;
  add_sweep(faces, std::move(out), true, closed);
  add_sweep(faces, std::move(in), false, closed);
}

void Wheels::add_sweep(std::span<const WindowFace> faces, std::vector<Index> entrance, bool from_hub, bool closed) {
  const Index number = static_cast<Index>(sweeps_.size()), count = static_cast<Index>(entrance.size());
  Sweep sweep;
  sweep.from_hub = from_hub;
  sweep.closed = closed;
  sweep.turn.reserve(count + 1);
  sweep.angle.reserve(count + 1);
  sweep.length.reserve(count + 1);
  std::vector<double> nearest;
  nearest.reserve(count);
  Vec2 turn{1, 0};
  double angle = 0;
  const auto add_spoke = [&](Real length) {
    sweep.turn.push_back(turn);
    sweep.angle.push_back(angle);
    sweep.length.push_back(length);
    if (sweep.length.size() > 1) nearest.push_back(to_double(length));
  };
  for (Index i = 0; i < count; ++i) {
    const Index h = entrance[i];
    if (place_[h].sweep == kNoIndex) place_[h] = {number, i};  // an edge between two hubs is a spoke of the first
    const WindowFace& f = faces[h / 3];
    add_spoke(f.length[h % 3]);
    const Vec2 opening = opening_at(f, from_hub ? h % 3 : next3(h % 3));
    const Real inverse = 1 / length_of(opening.x, opening.y);
    const Vec2 by{opening.x * inverse, opening.y * inverse};
    turn = {turn.x * by.x - turn.y * by.y, turn.x * by.y + turn.y * by.x};
    angle += std::atan2(to_double(opening.y), to_double(opening.x));
    if (i + 1 == count) add_spoke(f.length[from_hub ? previous3(h % 3) : next3(h % 3)]);
  }
  while (!nearest.empty()) {
    std::vector<double> pairs(nearest.size() / 2);
    for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = std::min(nearest[2 * i], nearest[2 * i + 1]);
    sweep.nearest.push_back(std::exchange(nearest, std::move(pairs)));
  }
  sweep.entrance = std::move(entrance);
  sweeps_.push_back(std::move(sweep));
}

void Wheels::stop_at(std::span<const Index> faces) {
  for (Sweep& sweep : sweeps_) sweep.stops.clear();
  if (empty()) return;
  for (const Index f : faces) {
    for (Index k = 0; k < 3; ++k) {
      const Place& place = place_[3 * f + k];
      if (place.sweep != kNoIndex) sweeps_[place.sweep].stops.push_back(place.face);
    }
  }
  for (Sweep& sweep : sweeps_) detail::sort(sweep.stops.begin(), sweep.stops.end());
}

// In larger and smaller blocks of spokes. Between the ends of a block the ray is nowhere farther from the hub than at
// one of them: its distance as a function of the angle is convex.
Wheels::Reach Wheels::last_before_rim(const Sweep& sweep, Index first, Vec2 source, Real from) {
  const Index count = static_cast<Index>(sweep.entrance.size());
  const auto end_after = [&](Index face, Index last) {
    const auto stop = std::lower_bound(sweep.stops.begin(), sweep.stops.end(), face);
    return stop == sweep.stops.end() ? last : std::min(*stop, last);
  };
  Reach reach{first, {1, 0}, 0};
  Vec2 start = sweep.turn[first];
  double start_angle = sweep.angle[first];
  Index end = end_after(first, sweep.closed && first > 0 ? count : count - 1);
  std::size_t level = 0;
  Real distance = from;
  for (int look = 0; look < kLooks && reach.face < end; ++look) {
    const Index at = reach.face;
    while (level > 0 && at % (Index{1} << level) != 0) --level;
    const Index block = at >> level, next = at + (Index{1} << level);
    bool passes =
        next <= end && block < sweep.nearest[level].size() && sweep.angle[next] - start_angle < kMostOfHalfTurn;
    if (passes) {
      const Vec2 turn = turned_back(sweep.turn[next], start);
      const Real there = place_on(turn, source, from);
      passes = there > 0 && std::max(there, distance) < kClearOfRim * sweep.nearest[level][block];
      if (passes) reach = {next, turn, reach.passed + (next - at)}, distance = there;
    }
    if (!passes && level == 0) break;
    level = passes ? std::min(level + 1, sweep.nearest.size() - 1) : level - 1;
    if (reach.face < count) continue;
    reach.face = 0;
    start = turned_back(start, sweep.turn[count]);
    start_angle -= sweep.angle[count];
    end = end_after(0, first - 1);
    level = 0;
  }
  return reach;
}

Index Wheels::carry(Index h, Window& w) const {
  const Place& place = place_[h];
  if (place.sweep == kNoIndex || w.kind != WindowKind::Circular || is_on_edge(w) || !(w.source.y < 0)) return h;
  const Sweep& sweep = sweeps_[place.sweep];
  Window seen = sweep.from_hub ? w : mirrored(w, sweep.length[place.face]);
  const Reach to = last_before_rim(sweep, place.face, seen.source, seen.b1);
  if (to.passed < kFewFaces) return h;
  const Real norm = length_of(to.turn.x, to.turn.y);
  const Vec2 turned = turned_back(seen.source, to.turn);
  seen.b0 = norm * place_on(to.turn, seen.source, seen.b0);
  seen.b1 = norm * place_on(to.turn, seen.source, seen.b1);
  seen.source = {turned.x / norm, turned.y / norm};
  if (!(seen.source.y < 0)) return h;
  seen.d0 = value_at(seen, seen.b0);
  seen.d1 = value_at(seen, seen.b1);
  w = sweep.from_hub ? seen : mirrored(seen, sweep.length[to.face]);
  return sweep.entrance[to.face];
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
