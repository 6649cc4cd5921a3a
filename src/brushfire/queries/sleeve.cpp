// Unfolding of sleeves, and shortest paths in them.
//
// Based on: Lee, Preparata, "Euclidean shortest paths in the presence of rectilinear barriers", 1984 (the funnel).
#include <brushfire/queries/detail/sleeve.h>

#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/mesh/detail/wide_face.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace brushfire::detail {
namespace {

using On = PointLocation::On;

PointLocation at_vertex(const Mesh& mesh, Index vertex, Index face) {
  PointLocation at;
  at.on = On::Vertex;
  at.vertex = vertex;
  at.face = face;
  const Face& t = mesh.faces()[face];
  at.weights[static_cast<std::size_t>(std::find(t.begin(), t.end(), vertex) - t.begin())] = 1;
  return at;
}

bool lies_in(const Mesh& mesh, const PointLocation& point, Index face) {
  return weights_in(mesh, point, face).has_value();
}

Index longest_halfedge(const Mesh& mesh, Index f) {
  Index longest = 3 * f;
  for (const Index h : {3 * f + 1, 3 * f + 2}) {
    if (mesh.length(h) > mesh.length(longest)) longest = h;
  }
  return longest;
}

// Of length 1 to some 2^-100: one step of Newton's method from the root and quotient of doubles, whose error it
// squares.
WideVec2 unit(WideVec2 a) {
  const DoubleDouble square = dot(a, a);
  const double guess = 1 / std::sqrt(square.high);
  const DoubleDouble rest = DoubleDouble(1) - square * DoubleDouble::product(guess, guess);
  return (DoubleDouble(guess) + 0.5 * guess * rest.high) * a;
}

// A sleeve laid out in the plane face by face, its beginning in the origin: the edge of every step, seen by someone who
// walks along, and the end. In 106 bits: faces of a sleeve may be of very different sizes.
class Unfolding {
 public:
  struct Portal {
    WideVec2 left, right;
    bool left_is_from = false;  // whether the left end is the vertex that `out` starts from
  };

  Unfolding(const Mesh& mesh, const Sleeve& sleeve, FrameCache& frames)
      : mesh_(mesh), sleeve_(sleeve), frames_(frames) {
    portals_.reserve(sleeve.steps.size());
    corners_ = first_corners();
    const WideVec2 begin = wide_point(corners_, *weights_in(mesh, sleeve.begin, sleeve.first_face));
    for (WideVec2& corner : corners_) corner = corner - begin;
  }

  // The edge of step i; of steps in order, or those that were asked for before.
  const Portal& portal(std::size_t i) {
    while (portals_.size() <= i) advance(sleeve_.steps[portals_.size()]);
    return portals_[i];
  }
  // Once all edges were asked for.
  WideVec2 end() const { return wide_point(corners_, *weights_in(mesh_, sleeve_.end, sleeve_.last_face())); }
  const std::vector<Portal>& portals() const { return portals_; }
  std::size_t size() const { return sleeve_.steps.size(); }

 private:
  std::array<WideVec2, 3> first_corners() {
    std::array<WideVec2, 3> corners;
    const Index h = longest_halfedge(mesh_, sleeve_.first_face);
    if (!(mesh_.length(h) > 0)) return corners;
    const WideFrame& frame = frames_.of(h);
    corners[Mesh::next(h) % 3] = {frame.length, 0.0};
    corners[Mesh::previous(h) % 3] = frame.apex;
    return corners;
  }

  void advance(const Step& step) {
    const WideVec2 from = corners_[step.out % 3], to = corners_[Mesh::next(step.out) % 3];
    // Leaving a counter-clockwise face, the edge's far end lies to the left.
    portals_.push_back(mirrored_ ? Portal{from, to, true} : Portal{to, from, false});
    const bool same_start = mesh_.from(step.in) == mesh_.from(step.out);
    mirrored_ = mirrored_ != same_start;
    const WideVec2 u = same_start ? from : to, v = same_start ? to : from;
    const WideVec2& apex = frames_.of(step.in).apex;
    // Not by the edge's own length: keeps rounding from turning into a change of scale.
    const WideVec2 along = unit(v - u);
    const WideVec2 inward = mirrored_ ? WideVec2{along.y, -along.x} : WideVec2{-along.y, along.x};
    corners_[step.in % 3] = u;
    corners_[Mesh::next(step.in) % 3] = v;
    corners_[Mesh::previous(step.in) % 3] = u + apex.x * along + apex.y * inward;
  }

  const Mesh& mesh_;
  const Sleeve& sleeve_;
  FrameCache& frames_;
  std::array<WideVec2, 3> corners_;  // of the last face
  bool mirrored_ = false;            // whether it lies clockwise
  std::vector<Portal> portals_;
};

// The cross product, at least its sign: in doubles where their rounding, a few units in the last place of both
// products, cannot change that.
double turn(const WideVec2& a, const WideVec2& b) {
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  const double p = a.x.high * b.y.high, q = a.y.high * b.x.high;
  return std::abs(p - q) > kRounding * (std::abs(p) + std::abs(q)) ? p - q : cross(a, b).high;
}

// Where the shortest path from the beginning has to bend first: the step whose edge ends in that vertex.
struct Bend {
  std::size_t step;
  bool left;
};

// Lays out no more than it takes to tell.
std::optional<Bend> first_bend(Unfolding& flat) {
  WideVec2 left, right;  // the funnel's sides
  std::size_t left_step = 0, right_step = 0;
  bool open = false;
  for (std::size_t i = 0; i <= flat.size(); ++i) {
    const bool last = i == flat.size();
    const WideVec2 l = last ? flat.end() : flat.portal(i).left;
    const WideVec2 r = last ? l : flat.portal(i).right;
    if (!open) {
      left = l;
      right = r;
      left_step = right_step = i;
      open = true;
      continue;
    }
    if (turn(right, r) >= 0) {  // the right side moves in
      if (turn(left, r) > 0) return Bend{left_step, true};
      right = r;
      right_step = i;
    }
    if (turn(left, l) <= 0) {
      if (turn(right, l) < 0) return Bend{right_step, false};
      left = l;
      left_step = i;
    }
  }
  return std::nullopt;
}

Index vertex_of(const Mesh& mesh, const Sleeve& sleeve, const Unfolding& flat, const Bend& bend) {
  const Index out = sleeve.steps[bend.step].out;
  return flat.portals()[bend.step].left_is_from == bend.left ? mesh.from(out) : mesh.to(out);
}

std::array<double, 3> weights_on(Index h, const Crossing& at) {
  std::array<double, 3> w{0, 0, 0};
  w[h % 3] = at.from;
  w[Mesh::next(h) % 3] = at.to;
  return w;
}

// Where the line from the origin to `end` crosses an edge.
Crossing crossing_of(const Unfolding::Portal& portal, WideVec2 end) {
  const DoubleDouble l = cross(end, portal.left), r = cross(end, portal.right);
  double at_left = 1, at_right = 0;
  if (l.high > 0 && r.high < 0) {
    at_left = (r / (r - l)).high;
    at_right = (l / (l - r)).high;
  } else if (std::abs(l.high) > std::abs(r.high)) {
    std::swap(at_left, at_right);  // the line runs over the right end, or by rounding beyond it
  }
  return portal.left_is_from ? Crossing{at_left, at_right} : Crossing{at_right, at_left};
}

// Splits the sleeve at a vertex of the edge of step `i`: the part before (returned) and the part after (left in
// `sleeve`).
Sleeve split_off(const Mesh& mesh, Sleeve& sleeve, std::size_t i, Index vertex) {
  Sleeve before;
  before.begin = sleeve.begin;
  before.first_face = sleeve.first_face;
  before.steps.assign(sleeve.steps.begin(), sleeve.steps.begin() + static_cast<std::ptrdiff_t>(i));
  before.end = at_vertex(mesh, vertex, Mesh::face_of(sleeve.steps[i].out));
  sleeve.first_face = Mesh::face_of(sleeve.steps[i].in);
  sleeve.begin = at_vertex(mesh, vertex, sleeve.first_face);
  sleeve.steps.erase(sleeve.steps.begin(), sleeve.steps.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  tidy(mesh, before);
  tidy(mesh, sleeve);
  return before;
}

// The first step whose edge the line crosses at a vertex: so near to it, for someone at either end, that going through
// it makes no bend that can be told from straight.
std::optional<Bend> first_touch(const std::vector<Unfolding::Portal>& portals, WideVec2 end) {
  const double length = norm(end).high;
  const auto touches = [&](const WideVec2& p) {
    const double far = std::abs(p.x.high) + std::abs(p.y.high);
    if (std::abs(turn(end, p)) > 2 * kTouch * far * length) return false;  // most: twice what could touch
    const double along = dot(end, p).high / length, aside = std::abs(cross(end, p).high) / length;
    return aside <= kTouch * std::min(along, length - along);
  };
  for (std::size_t i = 0; length > 0 && i < portals.size(); ++i) {
    if (touches(portals[i].left)) return Bend{i, true};
    if (touches(portals[i].right)) return Bend{i, false};
  }
  return std::nullopt;
}

// Over an edge without length there is no "straight": the path goes through one of its vertices.
std::optional<std::size_t> zero_length_step(const Mesh& mesh, const Sleeve& sleeve) {
  const std::span<const double> lengths = mesh.lengths();
  for (std::size_t i = 0; i < sleeve.steps.size(); ++i) {
    if (lengths[sleeve.steps[i].out] == 0) return i;
  }
  return std::nullopt;
}

}  // namespace

const WideFrame& FrameCache::of(Index h) {
  const auto [at, is_new] = frames_.try_emplace(h);
  if (is_new) at->second = wide_frame(mesh_, h);
  return at->second;
}

void tidy(const Mesh& mesh, Sleeve& sleeve) {
  std::vector<Step> kept;
  for (const Step& step : sleeve.steps) {
    if (kept.empty() || kept.back().in != step.out) {
      kept.push_back(step);
    } else if (kept.back().out == step.in) {
      kept.pop_back();  // over the edge and back
    } else {
      kept.back().in = step.in;  // over an edge of several faces and at once on to the third
    }
  }
  std::size_t first = 0, last = kept.size();
  while (first < last && lies_in(mesh, sleeve.begin, Mesh::face_of(kept[first].in))) {
    sleeve.first_face = Mesh::face_of(kept[first++].in);
  }
  while (last > first && lies_in(mesh, sleeve.end, Mesh::face_of(kept[last - 1].out))) --last;
  sleeve.steps.assign(kept.begin() + static_cast<std::ptrdiff_t>(first),
                      kept.begin() + static_cast<std::ptrdiff_t>(last));
}

std::vector<StraightPiece> shortest_in_sleeve(const Mesh& mesh, Sleeve sleeve, FrameCache& frames) {
  std::vector<StraightPiece> pieces;
  std::vector<Sleeve> waiting;  // the last one comes first
  tidy(mesh, sleeve);
  waiting.push_back(std::move(sleeve));
  while (!waiting.empty()) {
    Sleeve now = std::move(waiting.back());
    waiting.pop_back();
    std::optional<std::pair<std::size_t, Index>> split;
    if (const auto step = zero_length_step(mesh, now)) {
      split = {*step, mesh.from(now.steps[*step].out)};
    } else {
      Unfolding flat(mesh, now, frames);
      std::optional<Bend> bend = first_bend(flat);
      if (!bend) bend = first_touch(flat.portals(), flat.end());
      if (bend) {
        split = {bend->step, vertex_of(mesh, now, flat, *bend)};
      } else {
        const WideVec2 end = flat.end();
        StraightPiece& straight = pieces.emplace_back();
        straight.length = norm(end);
        if (!now.steps.empty()) {
          straight.first = crossing_of(flat.portals().front(), end);
          straight.last = crossing_of(flat.portals().back(), end);
        }
        straight.sleeve = std::move(now);
      }
    }
    if (split) {
      Sleeve before = split_off(mesh, now, split->first, split->second);
      waiting.push_back(std::move(now));
      waiting.push_back(std::move(before));
    }
  }
  return pieces;
}

void append_points(const Mesh& mesh, const StraightPiece& straight, FrameCache& frames,
                   std::vector<SurfacePoint>& points) {
  const auto append = [&](SurfacePoint p) {
    if (!points.empty()) {
      const PointLocation a = locate(mesh, points.back(), 0), b = locate(mesh, p, 0);
      if (const auto w = weights_in(mesh, a, b.face); w && *w == b.weights) return;
    }
    points.push_back(p);
  };
  append({straight.sleeve.begin.face, straight.sleeve.begin.weights});
  Unfolding flat(mesh, straight.sleeve, frames);
  const std::size_t count = straight.sleeve.steps.size();
  if (count > 0) flat.portal(count - 1);
  const WideVec2 end = flat.end();
  for (std::size_t i = 0; i < count; ++i) {
    const Index h = straight.sleeve.steps[i].out;
    append({Mesh::face_of(h), weights_on(h, crossing_of(flat.portals()[i], end))});
  }
  append({straight.sleeve.end.face, straight.sleeve.end.weights});
}

std::array<double, 3> point_after_begin(const Mesh& mesh, const StraightPiece& straight) {
  if (straight.sleeve.steps.empty()) return *weights_in(mesh, straight.sleeve.end, straight.sleeve.first_face);
  return weights_on(straight.sleeve.steps.front().out, straight.first);
}

std::array<double, 3> point_before_end(const Mesh& mesh, const StraightPiece& straight) {
  if (straight.sleeve.steps.empty()) return *weights_in(mesh, straight.sleeve.begin, straight.sleeve.first_face);
  const Step& last = straight.sleeve.steps.back();
  const Crossing& at = straight.last;
  return weights_on(last.in, mesh.from(last.in) == mesh.from(last.out) ? at : Crossing{at.to, at.from});
}

}  // namespace brushfire::detail
