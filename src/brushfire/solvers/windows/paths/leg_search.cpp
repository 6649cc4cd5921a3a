// Wedges of straight ways out of a point are followed from face to face, each laid flat over the edge just crossed,
// until one holds a vertex or a source from which the point's value is explained.
//
// All places are relative to the point, in 106 bits: a face 1e12 times smaller than its distance keeps its shape. What
// a wedge may hold is decided by the field: no way through an edge is shorter than the way there and the least value
// that the values at the edge's ends allow on it.
#include <brushfire/solvers/windows/paths/leg_search.h>

#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/mesh/detail/wide_face.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <unordered_map>
#include <vector>

namespace brushfire::windows {
namespace {

using On = PointLocation::On;
using detail::DoubleDouble, detail::WideFrame, detail::WideVec2, detail::wide_corners, detail::wide_frame,
    detail::wide_point;

// Vertices that are nearer than this share of the value have the same value as the point, as far as anyone knows: the
// leg may start from any of them.
constexpr double kNoDistance = 64 * std::numeric_limits<double>::epsilon();
// And those that are nearer than this share of the longest edge of a face of both: the weights of a point do not tell
// them apart.
constexpr double kNoPlace = 2 * std::numeric_limits<double>::epsilon();
// What a turn of two arrows is rounded by at most, as a share of the product of their lengths: some hundred operations
// of 2^-104 each, with room for places that are far larger than what they are compared with.
constexpr double kNoTurn = 1e-26;
// Two wedges over one edge are one where their places and limits agree to this share of the value.
constexpr double kSamePlace = 1e-15;
// Wedges that are one come soon after each other: only so many are looked at.
constexpr std::ptrdiff_t kRecent = 32;
// And so many faces of a way: no way winds round more of them in a circle for long.
constexpr int kMostBack = 64;
// Once the value is explained, so many more wedges are looked into for the root that the field names itself.
constexpr int kPatience = 256;
// A pass ends after so many wedges. Along the hint a leg needs few for each face that it crosses, or it is going
// astray.
constexpr std::size_t kMostWedges = 1 << 15, kFewWedges = 1 << 12, kWedgesPerFace = 4;

constexpr Index kStart = kNoIndex;  // the wedge before the first one

// What is seen of an edge from the point, which lies in the origin: the edge goes from right to left.
struct Wedge {
  Index halfedge = kNoIndex;  // of the face that is left through the edge
  Index right_vertex = kNoIndex, left_vertex = kNoIndex;
  WideVec2 right, left;              // ends of the edge
  WideVec2 right_limit, left_limit;  // vertices that bound the wedge
  Index before = kStart;             // the wedge that it is a part of
  Index origin = 0;                  // the start whose place is the origin
  Vec2 guide;                        // where the hint points; 0: nowhere
};

// The point itself, or a vertex at no distance from it.
struct Origin {
  PointLocation at;
  double before = 0;        // the way from the point
  Index previous = kStart;  // over which other one
};

// Where a leg may start.
struct Goal {
  double total = kInfinity;  // value there and length of the leg
  double length = 0;         // of the straight part
  Index vertex = kNoIndex, source = kNoIndex;
  Index face = kNoIndex;  // that holds it, and the weights there
  std::array<double, 3> weights{0, 0, 0};
  WideVec2 place;
  Index wedge = kStart;
  Index origin = 0;
};

Vec2 rounded(WideVec2 a) { return {a.x.high, a.y.high}; }
double length_of(WideVec2 a) { return norm(a).high; }

// > 0: b lies to the left of a; 0 where that cannot be told.
int turn(WideVec2 a, WideVec2 b) {
  const double t = cross(a, b).high;
  const double room = kNoTurn * norm(rounded(a)) * norm(rounded(b));
  return t > room ? 1 : t < -room ? -1 : 0;
}

// The same within a half-plane, one limit of which may be opposite of the other.
bool is_left_of(WideVec2 a, WideVec2 b) {
  const int t = turn(a, b);
  return t > 0 || (t == 0 && dot(a, b).high < 0);
}

double angle_between(Vec2 a, Vec2 b) { return std::atan2(std::abs(cross(a, b)), dot(a, b)); }

std::array<double, 3> corner_weights(Index k) {
  std::array<double, 3> weights{0, 0, 0};
  weights[k] = 1;
  return weights;
}

class LegSearch {
 public:
  explicit LegSearch(const LegQuestion& question)
      : ask_(question), mesh_(question.mesh), value_(question.value), room_(question.room) {
    for (Index s = 0; s < ask_.sources.size(); ++s) {
      const PointLocation& place = ask_.sources[s].at;
      if (place.on == On::Vertex) {
        source_at_.emplace(place.vertex, s);
        continue;
      }
      for (const Named& f : names_of(place)) sources_in_.emplace(f.face, Inside{s, f.weights});
    }
    find_origins(ask_.at);
  }

  WindowField::Leg operator()() {
    // Along the hint, as long as the value allows. Where the value itself does not hold, by length alone; where values
    // around are too large and hide the way, without them.
    WindowField::Leg leg;
    double total = kInfinity;
    for (const Pass pass : {Pass::AlongHint, Pass::ByLength, Pass::WithoutValues}) {
      look(pass);
      if (best_.total < total) leg = leg_to(best_);
      total = std::min(total, best_.total);
      if (total <= value_ + room_) break;
    }
    return leg;
  }

 private:
  enum class Pass { AlongHint, ByLength, WithoutValues };
  struct Inside {
    Index source;
    std::array<double, 3> weights;
  };
  // A point by its faces. A face that has a vertex twice names it once for every corner.
  struct Named {
    Index face;
    std::array<double, 3> weights;
  };
  struct Open {
    Index wedge;
    double key;
    double reach;  // of equal keys the farthest first
    bool operator<(const Open& o) const { return key > o.key || (key == o.key && reach < o.reach); }
  };
  struct Seen {
    Vec2 place;  // of the point, in the frame of the edge
    double first, last;
  };

  double value_of(Index v) const { return ask_.vertex_value(v); }

  // ---- where to look from

  void find_origins(const PointLocation& at) {
    origins_.push_back({at, 0, kStart});
    for (Index i = 0; i < origins_.size(); ++i) {
      const Origin from = origins_[i];
      for (const Named& f : names_of(from.at)) {
        PointLocation here;
        here.face = f.face;
        here.weights = f.weights;
        const std::array<double, 3> d = corner_distances(mesh_, here);
        for (Index k = 0; k < 3; ++k) {
          const double way = from.before + d[k];
          if (way <= no_distance(f.face)) add_origin(mesh_.faces()[f.face][k], 3 * f.face + k, way, i);
        }
        for (Index k = 0; k < 3; ++k) add_origin_across(f, 3 * f.face + k, i);
      }
    }
  }
  // A point of an edge is known to an epsilon of the edge, whatever the value.
  double no_distance(Index face) const {
    const auto l = mesh_.lengths().subspan(3 * std::size_t{face}, 3);
    return std::max(kNoDistance * value_, kNoPlace * std::max({l[0], l[1], l[2]}));
  }
  void add_origin(Index v, Index corner, double way, Index previous) {
    if (is_origin(v)) return;
    PointLocation at;
    at.on = On::Vertex;
    at.vertex = v;
    at.face = Mesh::face_of(corner);
    at.weights = corner_weights(corner % 3);
    origins_.push_back({at, way, previous});
  }
  bool is_origin(Index v) const {
    return std::any_of(origins_.begin(), origins_.end(),
                       [&](const Origin& o) { return o.at.on == On::Vertex && o.at.vertex == v; });
  }
  // The foot of the point on an edge at no distance: other corners of faces without area may lie there.
  void add_origin_across(const Named& f, Index h, Index previous) {
    const double weight = f.weights[Mesh::previous(h) % 3], length = mesh_.length(h), room = no_distance(f.face);
    if (weight == 0 || !(length > 0) || mesh_.opposite()[h] == h || is_origin_on_edge(h)) return;
    if (!(weight * mesh_.double_areas()[f.face] <= 2 * room * length)) return;
    const std::array<WideVec2, 3> corners = wide_corners(mesh_, f.face, h % 3);
    const WideVec2 here = wide_point(corners, f.weights);
    const DoubleDouble share = (here.x - corners[h % 3].x) / (corners[Mesh::next(h) % 3].x - corners[h % 3].x);
    const double way = origins_[previous].before + std::abs((here.y - corners[h % 3].y).high);
    if (!(share > 0 && share < 1 && way <= room)) return;
    PointLocation at;
    at.on = On::Edge;
    at.halfedge = h;
    at.face = f.face;
    at.weights[h % 3] = (DoubleDouble(1) - share).high;
    at.weights[Mesh::next(h) % 3] = share.high;
    origins_.push_back({at, way, previous});
  }
  bool is_origin_on_edge(Index h) const {
    const auto is_on = [&](const Origin& o) {
      if (o.at.on != On::Edge) return false;
      Index g = o.at.halfedge;
      do {
        if (g == h) return true;
        g = mesh_.opposite()[g];
      } while (g != o.at.halfedge);
      return false;
    };
    return std::any_of(origins_.begin(), origins_.end(), is_on);
  }

  std::vector<Named> names_of(const PointLocation& at) const {
    std::vector<Named> names;
    if (at.on == On::Vertex) {
      for (const Index h : mesh_.corners(at.vertex)) names.push_back({Mesh::face_of(h), corner_weights(h % 3)});
    } else {
      for (const Index f : faces_at(mesh_, at)) names.push_back({f, *weights_in(mesh_, at, f)});
    }
    return names;
  }

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
  bool is_explained() const { return best_.total <= value_ + room_; }

  void start_from(Index origin) {
    const PointLocation& at = origins_[origin].at;
    offer_source_at(origin);
    std::vector<Named> names = names_of(at);
    std::stable_partition(names.begin(), names.end(), [&](const Named& f) { return is_corner(ask_.root, f.face); });
    for (const Named& f : names) {
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
      Goal goal;
      goal.face = f.face;
      goal.origin = origin;
      offer_sources(goal, corners);
      for (Index i = 0; i < 3; ++i) offer_corner(goal, i, corners[i]);
      if (!mesh_.is_face_usable(f.face)) continue;
      const Vec2 guide = hinted != kNoIndex ? hinted_from(hinted) - rounded(here) : Vec2{0, 0};
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
  Index hinted_halfedge(const Named& f) const {
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
    return {mesh_.from(g) == mesh_.from(ask_.halfedge) ? p.x : mesh_.length(g) - p.x, -p.y};
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
    Goal goal;
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

  static bool in_wedge(const Wedge& w, WideVec2 p) { return turn(w.right_limit, p) >= 0 && turn(p, w.left_limit) >= 0; }

  void add(const Wedge& w) {
    if (!is_left_of(w.right_limit, w.left_limit)) return;  // too narrow to hold more than the way to a vertex
    if (!(mesh_.length(w.halfedge) > 0)) return;           // its ends are one place, which is a vertex
    const Vec2 span = visible(w);
    const double least = least_total(w, span);
    if (!(least <= (by_length() ? best_.total : value_ + room_))) return;
    if (has_been_seen(w, span)) return;
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

  // The part of the wedge's edge that lies in the wedge, from right to left, as shares of the edge.
  static Vec2 visible(const Wedge& w) {
    const auto share = [&](WideVec2 limit) {
      const double r = -cross(limit, w.right).high, l = cross(limit, w.left).high;
      return r + l > 0 ? std::clamp(r / (r + l), 0.0, 1.0) : kInfinity;
    };
    const double first = share(w.right_limit), last = share(w.left_limit);
    return {first < kInfinity ? first : 0, last < kInfinity ? last : 1};
  }

  // The least that a way through the wedge can come to. The value on the edge differs from those at its ends by no more
  // than the way to them. Going left, the way from the point falls by no more than the bound by the right end does and
  // rises by no more than that by the left end does, so the least is where the two bounds meet. Nor is it less than the
  // way alone.
  double least_total(const Wedge& w, Vec2 span) const {
    const double length = mesh_.length(w.halfedge);
    const double right = known(w.right_vertex), left = known(w.left_vertex);
    const auto way_to = [&](double share) { return norm(rounded(w.right + share * (w.left - w.right))); };
    const double meet = std::clamp((right - left + length) / (2 * length), span.x, span.y);
    const Vec2 edge = rounded(w.left - w.right);
    const double foot = std::clamp(-dot(rounded(w.right), edge) / dot(edge, edge), span.x, span.y);
    const double value = std::max(right - meet * length, left - (1 - meet) * length);
    const double least = pass_ == Pass::WithoutValues ? way_to(foot) : std::max(way_to(meet) + value, way_to(foot));
    return origins_[w.origin].before + least;
  }
  // A run that stopped early does not know values that are larger than where it stopped: those are NaN.
  double known(Index v) const { return value_of(v) >= 0 ? value_of(v) : value_; }

  // How far away the edge is, in the direction of the wedge that is nearest to the hint. Who is far has got somewhere:
  // between thin faces over one edge a way may go to and fro for as long as it likes.
  static double reach(const Wedge& w) {
    const Vec2 right = rounded(w.right), edge = rounded(w.left - w.right), first = rounded(w.right_limit),
               last = rounded(w.left_limit);
    const bool is_right = cross(first, w.guide) < 0, is_left = cross(w.guide, last) < 0;
    const Vec2 along = !is_right && !is_left ? w.guide : is_right ? first : last;
    const double turn = cross(along, edge);
    return turn > 0 ? cross(right, edge) / turn * norm(along) : norm(right);
  }

  // By what angle the hint misses the wedge.
  static double miss(const Wedge& w) {
    if (w.guide == Vec2{0, 0}) return kPi;
    const Vec2 right = rounded(w.right_limit), left = rounded(w.left_limit);
    if (cross(right, w.guide) >= 0 && cross(w.guide, left) >= 0) return 0;
    return std::min(angle_between(right, w.guide), angle_between(left, w.guide));
  }

  // Over edges of many faces one place is reached on many ways, twice as many at each such edge.
  bool has_been_seen(const Wedge& w, Vec2 span) {
    Index first = w.halfedge;
    for (Index g = mesh_.opposite()[first]; g != w.halfedge; g = mesh_.opposite()[g]) first = std::min(first, g);
    const double length = mesh_.length(w.halfedge);
    const Vec2 edge = (1 / length) * rounded(w.left - w.right), right = rounded(w.right);
    const double along = -dot(edge, right), across = std::abs(cross(edge, right));
    const bool forward = w.right_vertex < w.left_vertex;
    const Seen now{
        {forward ? along : length - along, across}, forward ? span.x : 1 - span.y, forward ? span.y : 1 - span.x};
    const double room = kSamePlace * value_;
    std::vector<Seen>& others = seen_[first];
    const auto recent = others.end() - std::min<std::ptrdiff_t>(std::ssize(others), kRecent);
    const bool seen = std::any_of(recent, others.end(), [&](const Seen& s) {
      return std::abs(s.place.x - now.place.x) <= room && std::abs(s.place.y - now.place.y) <= room &&
             (s.first - now.first) * length <= room && (now.last - s.last) * length <= room;
    });
    if (!seen) others.push_back(now);
    return seen;
  }

  // ---- goals

  // A source at a vertex that is at no distance.
  void offer_source_at(Index origin) {
    const PointLocation& at = origins_[origin].at;
    if (at.on != On::Vertex) return;
    const auto [begin, end] = source_at_.equal_range(at.vertex);
    for (auto s = begin; s != end; ++s) {
      Goal goal;
      goal.face = at.face;
      goal.weights = at.weights;
      goal.origin = origin;
      goal.source = s->second;
      offer(goal, ask_.sources[s->second].offset + ask_.shift);
    }
  }

  // Those within the face that a way of the wedge has entered.
  void offer_sources(Goal goal, const std::array<WideVec2, 3>& corners) {
    const auto [begin, end] = sources_in_.equal_range(goal.face);
    for (auto s = begin; s != end; ++s) {
      goal.place = wide_point(corners, s->second.weights);
      if (goal.wedge != kStart && !in_wedge(wedges_[goal.wedge], goal.place)) continue;
      goal.source = s->second.source;
      goal.weights = s->second.weights;
      goal.length = length_of(goal.place);
      offer(goal, ask_.sources[goal.source].offset + ask_.shift);
    }
  }

  void offer_corner(Goal goal, Index k, WideVec2 place) {
    goal.vertex = mesh_.faces()[goal.face][k];
    if (!(value_of(goal.vertex) < value_) || is_origin(goal.vertex)) return;
    goal.place = place;
    goal.length = length_of(place);
    goal.weights = corner_weights(k);
    offer(goal, value_of(goal.vertex));
  }

  void offer(Goal& goal, double start) {
    goal.total = start + goal.length + origins_[goal.origin].before;
    const bool named = ask_.root == (goal.source != kNoIndex ? goal.source + mesh_.vertex_count() : goal.vertex);
    if (!by_length() && named && goal.total <= value_ + room_) {
      done_ = true;
    } else if (!(goal.total < best_.total)) {
      return;
    }
    best_ = goal;
  }

  // ---- the leg

  WindowField::Leg leg_to(const Goal& goal) const {
    WindowField::Leg leg;
    std::vector<Index> way;
    for (Index o = goal.origin; o != kStart; o = origins_[o].previous) way.push_back(o);
    for (auto o = way.rbegin(); o != way.rend(); ++o)
      leg.points.push_back({origins_[*o].at.face, origins_[*o].at.weights});
    std::vector<Index> chain;
    for (Index w = goal.wedge; w != kStart; w = wedges_[w].before) chain.push_back(w);
    std::reverse(chain.begin(), chain.end());
    for (const Index w : chain) {
      if (end_at_vertex(goal, wedges_[w], leg)) return leg;
      leg.points.push_back(crossing(goal, wedges_[w]));
    }
    leg.length = origins_[goal.origin].before + goal.length;
    leg.vertex = goal.vertex;
    leg.source = goal.source;
    if (goal.length > 0 || goal.vertex != kNoIndex) leg.points.push_back({goal.face, goal.weights});
    return leg;
  }

  // Where the straight way passes through a vertex of the wedge's edge, as far as anyone can see.
  bool end_at_vertex(const Goal& goal, const Wedge& w, WindowField::Leg& leg) const {
    const auto try_end = [&](Index v, Index corner, WideVec2 place) {
      if (v == goal.vertex || is_origin(v) || !(value_of(v) < value_)) return false;
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

  SurfacePoint crossing(const Goal& goal, const Wedge& w) const {
    const DoubleDouble r = -cross(goal.place, w.right), l = cross(goal.place, w.left), sum = r + l;
    double right = 0, left = 0;  // weights
    if (sum.high > kNoTurn * goal.length * norm(rounded(w.left - w.right))) {
      left = std::clamp((r / sum).high, 0.0, 1.0);
      right = std::clamp((l / sum).high, 0.0, 1.0);
    } else {
      // Along the edge: where the way begins.
      const WideVec2 edge = w.left - w.right;
      left = std::clamp((-dot(w.right, edge) / dot(edge, edge)).high, 0.0, 1.0);
      right = 1 - left;
    }
    const bool forward = mesh_.from(w.halfedge) == w.right_vertex;
    SurfacePoint p{Mesh::face_of(w.halfedge), {0, 0, 0}};
    p.weights[w.halfedge % 3] = forward ? right : left;
    p.weights[Mesh::next(w.halfedge) % 3] = forward ? left : right;
    return p;
  }

  const LegQuestion& ask_;
  const Mesh& mesh_;
  const double value_, room_;
  std::unordered_multimap<Index, Inside> sources_in_;  // by face
  std::unordered_multimap<Index, Index> source_at_;    // by vertex
  std::vector<Origin> origins_;
  std::vector<Wedge> wedges_;
  std::size_t first_wedges_ = 0, on_hint_ = 0;  // so many of them: where the pass began, aside; along the hint
  std::priority_queue<Open> open_;
  std::unordered_map<Index, std::vector<Seen>> seen_;  // by the lowest halfedge of the edge
  Goal best_;
  Pass pass_ = Pass::AlongHint;
  bool done_ = false;
};

}  // namespace

WindowField::Leg find_leg(const LegQuestion& question) { return LegSearch(question)(); }

}  // namespace brushfire::windows
