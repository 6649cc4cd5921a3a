// Wedges of straight ways out of a point are followed from face to face, each laid flat over the edge just crossed,
// until one holds a vertex or a source from which the point's value is explained.
//
// All places are relative to the point, in 106 bits: a face 1e12 times smaller than its distance keeps its shape. What
// a wedge may hold is decided by the field: no way through an edge is shorter than the way there and the least value
// that the values at the edge's ends allow on it.
#include <brushfire/solvers/windows/paths/leg_search.h>

#include <brushfire/mesh/detail/wide_face.h>
#include <brushfire/solvers/windows/paths/leg_origins.h>
#include <brushfire/solvers/windows/paths/leg_sources.h>
#include <brushfire/solvers/windows/paths/seen_wedges.h>
#include <brushfire/solvers/windows/paths/wedge.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <vector>

namespace brushfire::windows {
namespace {

using On = PointLocation::On;
using detail::WideFrame, detail::wide_corners, detail::wide_frame, detail::wide_point;

// A way is looked back over so many faces: none winds round more of them in a circle for long.
constexpr int kMostBack = 64;
// Once the value is explained, so many more wedges are looked into for the pseudo-source that the field names itself.
constexpr int kPatience = 256;
// Shares of an edge are doubles: what they place, and the values that follow from it, is known to two roundings of the
// edge's length each. (Beside a vertex of an edge 1e16 long that is much.)
constexpr double kShares = 4 * std::numeric_limits<double>::epsilon();
// A pass ends after so many wedges. Along the hint a leg needs few for each face that it crosses, or it is going
// astray.
constexpr std::size_t kMostWedges = 1 << 15, kFewWedges = 1 << 12, kWedgesPerFace = 4;

class LegSearch {
 public:
  explicit LegSearch(const LegQuestion& question)
      : ask_(question),
        mesh_(question.mesh),
        value_(question.value),
        room_(question.room),
        origins_(question.mesh, question.at, question.value),
        sources_(question.mesh, question.sources) {}

  WindowField::Leg operator()() {
    // Along the hint, as long as the value allows. Where the value itself does not hold, by length alone; where values
    // around are too large and hide the way, without them.
    WindowField::Leg leg;
    double total = kInfinity;
    for (const Pass pass : {Pass::AlongHint, Pass::ByLength, Pass::WithoutValues}) {
      look(pass);
      if (best_.total < total) leg = leg_to(best_);
      total = std::min(total, best_.total);
      if (is_explained()) break;
    }
    return leg;
  }

 private:
  enum class Pass { AlongHint, ByLength, WithoutValues };
  struct Open {
    Index wedge;
    double key;
    double reach;  // of equal keys the farthest first
    bool operator<(const Open& o) const { return key > o.key || (key == o.key && reach < o.reach); }
  };
  double value_of(Index v) const { return ask_.vertex_value(v); }
  double start_of(Index source) const { return ask_.sources[source].offset + ask_.shift; }

  // ---- one pass

  void look(Pass pass) {
    pass_ = pass;
    wedges_.clear();
    on_hint_ = first_wedges_ = 0;
    seen_.clear();
    open_ = {};
    done_ = false;
    best_ = {};
    int patience = kPatience;
    for (Index i = 0; i < origins_.size() && !done_; ++i) start_from(i);
    first_wedges_ = wedges_.size() - on_hint_;
    while (!open_.empty() && !done_ && !is_astray()) {
      const Open next = open_.top();
      open_.pop();
      if (by_length() ? next.key >= best_.total : is_explained() && --patience < 0) return;
      enter_faces(next.wedge);
    }
  }
  // Every wedge at a vertex of a million faces may be the one, and a leg may cross a million faces along the hint.
  bool is_astray() const {
    const std::size_t faces = mesh_.face_count(), looked_at = wedges_.size() - first_wedges_ - on_hint_;
    const std::size_t most = by_length() ? kMostWedges : std::min(kMostWedges, kFewWedges + kWedgesPerFace * faces);
    return looked_at >= most || on_hint_ >= std::max(most, faces);
  }
  bool by_length() const { return pass_ == Pass::ByLength; }
  bool is_explained() const { return best_.total <= value_ + room_of(best_); }
  double room_of(const LegGoal& goal) const {
    if (goal.source == kNoIndex) return room_;
    const LegOrigin& origin = origins_[goal.origin];
    const double same = std::min(room_, kAgreement * (goal.length + origin.before) + ask_.rounding);
    return origin.before > 0 ? std::max(same, origins_.rounding()) : same;
  }

  void start_from(Index origin) {
    const PointLocation& at = origins_[origin].at;
    offer_source_at(origin);
    std::vector<PointInFace> names = names_of(mesh_, at);
    std::stable_partition(names.begin(), names.end(),
                          [&](const PointInFace& f) { return is_corner(ask_.pseudo_source, f.face); });
    for (const PointInFace& f : names) {
      if (done_) return;
      // The frame: that of the hint, or of the longest edge.
      const Index hinted = !by_length() && origin == 0 ? hinted_halfedge(f) : kNoIndex;
      Index k = hinted % 3;
      for (Index i = 0; hinted == kNoIndex && i < 3; ++i) {
        if (i == 0 || mesh_.length(3 * f.face + i) > mesh_.length(3 * f.face + k)) k = i;
      }
      std::array<WideVec2, 3> corners = wide_corners(mesh_, f.face, k);
      const WideVec2 here = wide_point(corners, f.weights);
      for (WideVec2& c : corners) c = c - here;
      LegGoal goal;
      goal.face = f.face;
      goal.origin = origin;
      offer_sources(goal, corners);
      for (Index i = 0; i < 3; ++i) offer_corner(goal, i, corners[i]);
      if (!mesh_.is_face_usable(f.face)) continue;
      const Vec2 guide = hinted == kNoIndex ? Vec2{0, 0}
                         : ask_.parallel    ? hinted_from(hinted)
                                            : hinted_from(hinted) - rounded(here);
      for (Index i = 0; i < 3; ++i) {
        if (f.weights[(i + 2) % 3] == 0) continue;  // the point is on this edge
        const Index j = (i + 1) % 3, h = 3 * f.face + i;
        add({h, mesh_.from(h), mesh_.to(h), corners[i], corners[j], corners[i], corners[j], kStart, origin, guide});
      }
    }
  }

  bool is_corner(Index v, Index face) const {
    const Face& corners = mesh_.faces()[face];
    return std::find(corners.begin(), corners.end(), v) != corners.end();
  }

  // The halfedge of the face over which the hint comes, where it does: a point on that edge itself is reached through
  // the faces beyond.
  Index hinted_halfedge(const PointInFace& f) const {
    const Index h = ask_.halfedge;
    if (h == kNoIndex || !(mesh_.length(h) > 0)) return kNoIndex;
    const auto is_on = [&](Index g) { return f.weights[Mesh::previous(g) % 3] == 0; };
    if (Mesh::face_of(h) == f.face) return is_on(h) ? kNoIndex : h;
    for (Index g = mesh_.opposite()[h]; g != h; g = mesh_.opposite()[g]) {
      if (Mesh::face_of(g) == f.face && is_on(g)) return g;
    }
    return kNoIndex;
  }
  Vec2 hinted_from(Index g) const {
    const Vec2 p = ask_.from;
    if (g == ask_.halfedge) return p;
    const double turned = ask_.parallel ? -p.x : mesh_.length(g) - p.x;
    return {mesh_.from(g) == mesh_.from(ask_.halfedge) ? p.x : turned, -p.y};
  }

  // Through the wedge's edge into every other face there.
  void enter_faces(Index number) {
    const auto opposite = [&](Index h) { return mesh_.opposite()[h]; };
    const Index h = wedges_[number].halfedge;
    for (Index g = opposite(h); g != h && !done_; g = opposite(g)) enter(number, g);
  }

  // A shortest way crosses a face once: between two visits it could go straight (L11 of docs/tolerance.md). Ways that
  // wind between few faces for ever are found by looking back a little.
  bool has_crossed(Index number, Index face) const {
    if (!(mesh_.double_areas()[face] > 0)) return false;
    for (int back = 0; number != kStart && back < kMostBack; ++back) {
      if (Mesh::face_of(wedges_[number].halfedge) == face) return true;
      number = wedges_[number].before;
    }
    return false;
  }

  void enter(Index number, Index g) {
    if (has_crossed(number, Mesh::face_of(g))) return;
    const Wedge w = wedges_[number];
    const WideFrame frame = wide_frame(mesh_, g);
    const WideVec2 edge = w.left - w.right;
    const WideVec2 along = (DoubleDouble(1) / norm(edge)) * edge, beyond{along.y, -along.x};
    const bool from_right = mesh_.from(g) == w.right_vertex;
    const WideVec2 apex =
        (from_right ? w.right + frame.apex.x * along : w.left - frame.apex.x * along) + frame.apex.y * beyond;
    const Index face = Mesh::face_of(g), top = Mesh::previous(g), top_vertex = mesh_.from(top);
    std::array<WideVec2, 3> corners;
    corners[g % 3] = from_right ? w.right : w.left;
    corners[Mesh::next(g) % 3] = from_right ? w.left : w.right;
    corners[top % 3] = apex;
    LegGoal goal;
    goal.face = face;
    goal.wedge = number;
    goal.origin = w.origin;
    offer_sources(goal, corners);
    if (in_wedge(w, apex)) offer_corner(goal, top % 3, apex);
    const Index right_side = from_right ? Mesh::previous(g) : Mesh::next(g);
    const Index left_side = from_right ? Mesh::next(g) : Mesh::previous(g);
    const bool has_right = is_left_of(w.right_limit, apex), has_left = is_left_of(apex, w.left_limit);
    const WideVec2 left_limit = has_left ? apex : w.left_limit, right_limit = has_right ? apex : w.right_limit;
    if (has_right)
      add({right_side, w.right_vertex, top_vertex, w.right, apex, w.right_limit, left_limit, number, w.origin,
           w.guide});
    if (has_left)
      add({left_side, top_vertex, w.left_vertex, apex, w.left, right_limit, w.left_limit, number, w.origin, w.guide});
  }

  void add(const Wedge& w) {
    if (!is_left_of(w.right_limit, w.left_limit)) return;  // too narrow to hold more than the way to a vertex
    if (!(mesh_.length(w.halfedge) > 0)) return;           // its ends are one place, which is a vertex
    const VisiblePart part = visible_part(w);
    const double least = least_total(w, part);
    if (!(least <= (by_length() ? best_.total : value_ + room_))) return;
    if (!seen_.is_new(mesh_, w, part, kSamePlace * value_)) return;
    wedges_.push_back(w);
    const auto number = static_cast<Index>(wedges_.size() - 1);
    if (by_length()) {
      open_.push({number, least, 0});
    } else {
      const double angle = miss(w);
      if (angle == 0) ++on_hint_;
      open_.push({number, angle, reach(w)});
    }
  }

  // The least that a way through the wedge can come to. The value on the edge differs from those at its ends by no more
  // than the way to them. Going left, the way from the point falls by no more than the bound by the right end does and
  // rises by no more than that by the left end does, so the least is where the two bounds meet. Nor is it less than the
  // way alone, which beside a vertex of an edge 1e16 long is all that is known.
  double least_total(const Wedge& w, const VisiblePart& part) const {
    const WideVec2 edge = w.left - w.right;
    const DoubleDouble foot = std::clamp(-dot(w.right, edge) / dot(edge, edge), part.first, part.last);
    const double alone = length_of(w.right + foot * edge);
    if (pass_ == Pass::WithoutValues) return origins_[w.origin].before + alone;
    const double length = mesh_.length(w.halfedge);
    const double right = known(w.right_vertex), left = known(w.left_vertex);
    const double meet = std::clamp((right - left + length) / (2 * length), part.first.high, part.last.high);
    const double way = norm(rounded(w.right + DoubleDouble(meet) * edge));
    const double value = std::max(right - meet * length, left - (1 - meet) * length);
    return origins_[w.origin].before + std::max(alone, way + value - kShares * length);
  }
  // A run that stopped early does not know values that are larger than where it stopped: those are NaN.
  double known(Index v) const { return value_of(v) >= 0 ? value_of(v) : value_; }

  // ---- goals

  // A source at a vertex that is at no distance.
  void offer_source_at(Index origin) {
    const PointLocation& at = origins_[origin].at;
    if (at.on != On::Vertex) return;
    LegGoal goal;
    goal.face = at.face;
    goal.weights = at.weights;
    goal.origin = origin;
    offer_sources_at(goal, at.vertex);
  }
  void offer_sources_at(LegGoal goal, Index vertex) {
    const auto [begin, end] = sources_.at(vertex);
    for (auto s = begin; s != end; ++s) {
      goal.source = s->second.source;
      offer(goal, start_of(goal.source) + s->second.offset);
    }
  }

  // Those within the face that a way of the wedge has entered.
  void offer_sources(LegGoal goal, const std::array<WideVec2, 3>& corners) {
    const auto [begin, end] = sources_.in(goal.face);
    for (auto s = begin; s != end; ++s) {
      goal.place = wide_point(corners, s->second.weights);
      if (goal.wedge != kStart && !in_wedge(wedges_[goal.wedge], goal.place)) continue;
      goal.source = s->second.source;
      goal.weights = s->second.weights;
      goal.length = length_of(goal.place);
      offer(goal, start_of(goal.source));
    }
    for (const CurveInFace& c : ask_.curves.in(goal.face)) offer_curve(goal, c, corners);
  }

  // The best place on the segment as the point sees it; or the place.
  void offer_curve(LegGoal goal, const CurveInFace& c, const std::array<WideVec2, 3>& corners) {
    const LocatedCurve& curve = *ask_.sources[c.source].curve;
    double offset = 0;
    if (c.segment == kNoIndex) {
      goal.weights = place_in_face(mesh_, curve, c.place, c.face).weights;
      offset = curve.places[c.place].offset;
      goal.place = wide_point(corners, goal.weights);
    } else {
      const SegmentInFace s = *segment_in_face(mesh_, curve, c.segment, c.face, 0);
      const WideVec2 from = wide_point(corners, s.from), to = wide_point(corners, s.to);
      // All of it in 106 bits: beside the end of a segment 1e16 long, shares of one double are far apart.
      const DoubleDouble share = best_share(s, from, to), rest = DoubleDouble(1) - share;
      for (std::size_t k = 0; k < 3; ++k) goal.weights[k] = (rest * s.from[k] + share * s.to[k]).high;
      offset = (rest * s.from_value + share * s.to_value).high;
      goal.place = from + share * (to - from);
    }
    if (goal.wedge != kStart && !in_wedge(wedges_[goal.wedge], goal.place)) return;
    goal.source = c.source;
    goal.length = length_of(goal.place);
    offer(goal, start_of(c.source) + offset);
  }

  void offer_corner(LegGoal goal, Index k, WideVec2 place) {
    const Index vertex = mesh_.faces()[goal.face][k];
    goal.place = place;
    goal.length = length_of(place);
    goal.weights = corner_weights(k);
    if (origins_.has_value_of(vertex)) {
      // Straight to a source, which along edges may be farther; what is at one place is an origin itself.
      if (goal.length > 0) offer_sources_at(goal, vertex);
      return;
    }
    if (!(value_of(vertex) < value_)) return;
    goal.vertex = vertex;
    offer(goal, value_of(vertex));
  }

  void offer(LegGoal& goal, double start) {
    goal.total = start + goal.length + origins_[goal.origin].before;
    const bool named =
        ask_.pseudo_source == (goal.source != kNoIndex ? goal.source + mesh_.vertex_count() : goal.vertex);
    if (!by_length() && named && goal.total <= value_ + room_of(goal)) {
      done_ = true;
    } else if (!(goal.total < best_.total)) {
      return;
    }
    best_ = goal;
  }

  // ---- the leg

  WindowField::Leg leg_to(const LegGoal& goal) const {
    WindowField::Leg leg;
    std::vector<Index> way;
    for (Index o = goal.origin; o != kStart; o = origins_[o].previous) way.push_back(o);
    std::reverse(way.begin(), way.end());
    for (const Index o : way) leg.points.push_back({origins_[o].at.face, origins_[o].at.weights});
    std::vector<Index> chain;
    for (Index w = goal.wedge; w != kStart; w = wedges_[w].before) chain.push_back(w);
    std::reverse(chain.begin(), chain.end());
    for (const Index w : chain) {
      if (end_at_vertex(goal, wedges_[w], leg)) return leg;
      leg.points.push_back(crossing(mesh_, wedges_[w], goal.place, goal.length));
    }
    leg.length = origins_[goal.origin].before + goal.length;
    leg.vertex = goal.vertex;
    leg.source = goal.source;
    if (goal.length > 0 || goal.vertex != kNoIndex) leg.points.push_back({goal.face, goal.weights});
    return leg;
  }

  // Where the straight way passes through a vertex of the wedge's edge, as far as anyone can see.
  bool end_at_vertex(const LegGoal& goal, const Wedge& w, WindowField::Leg& leg) const {
    const auto try_end = [&](Index v, Index corner, WideVec2 place) {
      if (v == goal.vertex || origins_.has_value_of(v) || !(value_of(v) < value_)) return false;
      const double along = dot(goal.place, place).high / goal.length,
                   aside = std::abs(cross(goal.place, place).high) / goal.length;
      if (!(along > 0) || !(aside <= kThrough * std::min(along, goal.length - along))) return false;
      const double length = origins_[goal.origin].before + length_of(place);
      if (!(std::abs(value_of(v) + length - goal.total) <= room_)) return false;
      leg.points.push_back({Mesh::face_of(w.halfedge), corner_weights(corner % 3)});
      leg.length = length;
      leg.vertex = v;
      return true;
    };
    const bool forward = mesh_.from(w.halfedge) == w.right_vertex;
    const Index from = w.halfedge, to = Mesh::next(w.halfedge);
    return try_end(w.right_vertex, forward ? from : to, w.right) || try_end(w.left_vertex, forward ? to : from, w.left);
  }

  const LegQuestion& ask_;
  const Mesh& mesh_;
  const double value_, room_;
  const LegOrigins origins_;
  const LegSources sources_;
  std::vector<Wedge> wedges_;
  std::size_t first_wedges_ = 0, on_hint_ = 0;  // so many of them: where the pass began, aside; along the hint
  std::priority_queue<Open> open_;
  SeenWedges seen_;
  LegGoal best_;
  Pass pass_ = Pass::AlongHint;
  bool done_ = false;
};

}  // namespace

WindowField::Leg find_leg(const LegQuestion& question) { return LegSearch(question)(); }

}  // namespace brushfire::windows
