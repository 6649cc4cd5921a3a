// Best-first window tree without lists: propagation, the four pruning rules, emission from vertices.
#include "oracle/polyhedral.h"

#include "oracle/arithmetic.h"

#include <algorithm>
#include <optional>
#include <queue>
#include <utility>

namespace brushfire::oracle {
namespace {

// Long double carries 64 bits. After thousands of unfoldings a virtual source is some 1e-16 of its distance off, in
// the worst case met; what has to be decided with doubt is decided towards more windows. In units of the arithmetic's
// epsilon, so 1e-15, 1e-15 and 1e-18 in long double:
constexpr double kMargin = 1e4;  // of the distance: what is worse by less counts as equal and is kept
constexpr double kAngle = 1e4;   // radians: a vertex that far outside a wedge counts as seen (an error of its square)
constexpr double kLateral = 10;  // of the lengths at hand: the same where the vertex is next to the source
// Too much light does no harm, whatever the arithmetic: a path that bends in a vertex is a real path.
constexpr double kShadow = 1e-11;   // radians: shadows are widened by that much
constexpr double kSameWay = 1e-12;  // radians: arrivals that are nearer than that cast the same shadow

constexpr std::uint32_t kRoot = 0xffffffff;

// Rays that enter the face of `halfedge` across it, in the frame of that corner, between two limit rays; smaller x is
// left. Those of a point all come from `source` (below or on the x axis). Those of a segment are `parallel`: both limit
// rays have one direction, and the value at `source` is sigma and grows along it. `back` is the vertex opposite to the
// edge in the face that the rays come from, and back_at its place.
template <class R>
struct Window {
  R key = 0;  // least distance on the edge
  R sigma = 0;
  Point<R> source, left, right, back_at;  // left and right: unit directions
  Point<R> left_from, right_from;         // a place of either limit ray, not above the x axis
  Index halfedge = kNoIndex;
  Index back = kNoIndex;
  std::uint32_t parent = kRoot;
  bool parallel = false;
  R least = 0;  // of parallel light: what its values begin with
};

// How a front comes to a vertex: over an edge, inside a corner (angle from the corner's halfedge), or from nowhere
// (the vertex is a source or lies where directions mean nothing).
template <class R>
struct Arrival {
  enum class By : std::uint8_t { Start, Edge, Corner };
  R distance = 0;
  Index vertex = kNoIndex;
  By by = By::Start;
  Index at = 0;  // neighbour number or corner
  R angle = 0;
};

template <class T>
struct Later {
  template <class R>
  static const R& key(const Window<R>& w) {
    return w.key;
  }
  template <class R>
  static const R& key(const Arrival<R>& a) {
    return a.distance;
  }
  bool operator()(const T& a, const T& b) const { return key(a) > key(b); }
};
template <class T>
using Queue = std::priority_queue<T, std::vector<T>, Later<T>>;

template <class R>
Point<R> unit(Point<R> a) {
  return R(1 / norm(a)) * a;
}
template <class R>
Point<R> mirrored(Point<R> a, R length) {
  return {length - a.x, a.y};
}
template <class R>
Point<R> mirrored(Point<R> direction) {
  return {-direction.x, direction.y};
}

// Where within a corner light comes from. In a face without area that is one side or the other: rounding may put it a
// little outside, and beyond the side of an angle of pi atan2 would say -pi.
template <class R>
R angle_in(R corner, Point<R> side, Point<R> back) {
  return std::min(R(atan2(abs(cross(side, back)), dot(side, back))), corner);
}

template <class R>
class Solver {
  using Point = oracle::Point<R>;
  using Corner = oracle::Corner<R>;
  using Edge = oracle::Edge<R>;
  using Window = oracle::Window<R>;
  using Arrival = oracle::Arrival<R>;

 public:
  Solver(const Mesh& mesh, std::span<const Source> sources, R radius, std::span<const SurfacePoint> targets)
      : mesh_(mesh), complex_(mesh), radius_(radius), shadows_(mesh.vertex_count()) {
    distance_.assign(mesh.vertex_count(), far<R>());
    target_.assign(targets.size(), far<R>());
    targets_in_.resize(mesh.face_count());
    for (const Source& s : sources) scale_ = std::max(scale_, R(abs(R(s.offset))));
    for (Index i = 0; i < targets.size(); ++i) place_target(i, locate(mesh, targets[i]));
    for (const Source& s : sources) {
      if (s.curve == nullptr)
        start(locate(mesh, s.point), s.offset);
      else
        start(locate(mesh, *s.curve), s.offset);
    }
  }

  Truth run() {
    while (!windows_.empty() || !arrivals_.empty()) {
      const bool window_first =
          arrivals_.empty() || (!windows_.empty() && windows_.top().key < arrivals_.top().distance);
      const R now = window_first ? windows_.top().key : arrivals_.top().distance;
      if (now > radius_ || (arrivals_.empty() && now > farthest_target())) break;
      if (window_first) {
        Window w = windows_.top();
        windows_.pop();
        ++windows_taken_;
        if (prune(w)) propagate(w);
      } else {
        const Arrival a = arrivals_.top();
        arrivals_.pop();
        settle(a);
      }
    }
    return {rounded(distance_), rounded(target_), windows_taken_};
  }

 private:
  R margin(R d) const { return kMargin * epsilon<R>() * (abs(d) + scale_); }

  // ---- what is known of vertices and targets; only lengths of real paths get here

  void reach(const Arrival& a) {
    R& known = distance_[a.vertex];
    if (a.distance > known + margin(known)) return;
    known = std::min(known, a.distance);
    arrivals_.push(a);
  }

  void reach_target(Index i, R d) { target_[i] = std::min(target_[i], d); }

  // Every vertex that can be reached is reached along edges, so when no arrival is left all vertices are settled, and
  // only targets can still gain: from windows that start nearer than they are.
  R farthest_target() const {
    R farthest = -far<R>();
    for (const R& d : target_) farthest = std::max(farthest, d < far<R>() ? d : R(-far<R>()));
    return farthest;
  }

  // ---- sources and targets

  // Weights need not sum to one to the last bit: the point is their centre of mass.
  Point in_frame(Index h, const std::array<double, 3>& weights) const {
    const Corner& c = complex_.corner[h];
    const R sum = R(weights[0]) + weights[1] + weights[2];
    const R b = weights[(h + 1) % 3] / sum, a = weights[(h + 2) % 3] / sum;
    return Point{b * c.length, 0} + a * c.apex;
  }

  // The share of the way from vertex `first` along the edge that the point lies on.
  R share_from(const PointLocation& at, Index first) const {
    const auto k = static_cast<std::size_t>(at.halfedge % 3);
    const R near = at.weights[k], far_end = at.weights[(k + 1) % 3];
    return (mesh_.from(at.halfedge) == first ? far_end : near) / (near + far_end);
  }

  // The frames, one per face, in which a point of an edge or a face can be seen: halfedge and place.
  std::vector<std::pair<Index, Point>> frames_of(const PointLocation& at) const {
    std::vector<std::pair<Index, Point>> frames;
    if (at.on == PointLocation::On::Interior) {
      frames.emplace_back(3 * at.face, in_frame(3 * at.face, at.weights));
    } else if (at.on == PointLocation::On::Edge) {
      for (const Index h : complex_.edge[edge_of(at)].halfedges) {
        const Corner& c = complex_.corner[h];
        frames.emplace_back(h, Point{share_from(at, c.from) * c.length, 0});
      }
    }
    return frames;
  }
  Index edge_of(const PointLocation& at) const {
    return complex_.edge_between(mesh_.from(at.halfedge), mesh_.to(at.halfedge));
  }

  void place_target(Index i, const PointLocation& at) {
    target_at_.push_back(at);
    for (const auto& [h, p] : frames_of(at)) targets_in_[h / 3].push_back({i, at, h, p});
  }

  // The place of a target in the frame of any halfedge h of its face.
  struct Target {
    Index index;
    PointLocation at;
    Index halfedge;
    Point place;
  };
  Point place_in(Index h, const Target& t) const {
    if (t.halfedge == h) return t.place;
    const Corner& c = complex_.corner[t.halfedge];
    const Corner& goal = complex_.corner[h];
    std::array<Point, 3> corners{Point{0, 0}, Point{goal.length, 0}, goal.apex};
    const auto corner_of = [&](Index v) { return v == goal.from ? 0U : v == goal.to ? 1U : 2U; };
    if (t.at.on == PointLocation::On::Edge) {
      const R share = c.length > 0 ? t.place.x / c.length : 0;
      return (1 - share) * corners[corner_of(c.from)] + share * corners[corner_of(c.to)];
    }
    return in_frame(h, t.at.weights);
  }

  void start(const PointLocation& at, R offset) {
    if (at.on == PointLocation::On::Vertex) {
      reach({offset, at.vertex, Arrival::By::Start, 0, 0});
      return;
    }
    if (at.on == PointLocation::On::Edge) start_along_edge(at, offset);
    for (const auto& [h, p] : frames_of(at)) start_in_face(h, p, offset);
  }

  void start_along_edge(const PointLocation& at, R offset) {
    const Edge& e = complex_.edge[edge_of(at)];
    const R t = share_from(at, e.a);
    reach({offset + t * e.length, e.a, Arrival::By::Edge, number(e.a, e.b), 0});
    reach({offset + share_from(at, e.b) * e.length, e.b, Arrival::By::Edge, number(e.b, e.a), 0});
    for (Index i = 0; i < target_at_.size(); ++i) {
      const PointLocation& goal = target_at_[i];
      if (goal.on != PointLocation::On::Edge || edge_of(goal) != edge_of(at)) continue;
      const R u = share_from(goal, e.a);
      reach_target(i, offset + abs(t - u) * e.length);
    }
  }

  // A point inside a face, or on its first edge: straight to the corners and targets, and out over the edges that do
  // not hold it.
  void start_in_face(Index h, Point p, R offset) {
    for (const Target& t : targets_in_[h / 3]) reach_target(t.index, offset + norm(place_in(h, t) - p));
    const bool on_edge = p.y == 0 && complex_.corner[h].apex.y > 0;
    Index g = h;
    Point q = p;
    for (int k = 0; k < 3; ++k) {
      const Corner& c = complex_.corner[g];
      if (!(on_edge && k < 2)) {  // the ends of the edge are reached along the edge
        const Point to_point = q, to_end{c.length, 0};
        reach({offset + norm(q), c.from, Arrival::By::Corner, g, angle_in(c.angle, to_end, to_point)});
      }
      if (!(on_edge && k == 0)) leave(g, q, offset);
      q = next_frame(c, q);
      g = Mesh::next(g);
    }
  }

  // From the frame of a corner to that of the next corner of the same face.
  Point next_frame(const Corner& c, Point q) const {
    const Corner& n = complex_.corner[c_next(c)];
    const Point d{q.x - c.length, q.y};
    if (n.length == 0) return {0, norm(d)};
    const Point ahead = (1 / n.length) * Point{-c.apex_to_end, c.apex.y};
    return {dot(ahead, d), std::max(R{0}, cross(ahead, d))};
  }
  Index c_next(const Corner& c) const { return Mesh::next(static_cast<Index>(&c - complex_.corner.data())); }

  // ---- curves

  // Each of its places as a point, and parallel light on both sides of its segments.
  void start(const LocatedCurve& curve, R offset) {
    for (const CurvePlace& place : curve.places) {
      scale_ = std::max(scale_, R(abs(offset + place.offset)));
      start(place.at, offset + place.offset);
    }
    for (const CurveSegment& s : curve.segments) {
      if (!s.along_edge) {
        if (complex_.usable(s.face)) {
          const Index h = 3 * s.face;
          start_segment(h, {in_frame(h, s.from), in_frame(h, s.to), offset + s.from_offset, offset + s.to_offset});
        }
        continue;
      }
      std::size_t k = 0;  // the edge's first corner: the one without weights is the last
      while (s.from[(k + 2) % 3] != 0 || s.to[(k + 2) % 3] != 0) ++k;
      const Face& t = mesh_.faces()[s.face];
      for (const Index h : complex_.edge[complex_.edge_between(t[k], t[(k + 1) % 3])].halfedges) {
        const Corner& c = complex_.corner[h];
        const std::size_t far_end = c.to == t[k] ? k : (k + 1) % 3, near = c.to == t[k] ? (k + 1) % 3 : k;
        const auto on_edge = [&](const std::array<double, 3>& weights) {
          return Point{R(weights[far_end]) / (R(weights[near]) + weights[far_end]) * c.length, 0};
        };
        start_segment(h, {on_edge(s.from), on_edge(s.to), offset + s.from_offset, offset + s.to_offset});
      }
    }
  }

  // In the frame of a corner, with its values at both ends.
  struct Segment {
    Point from, to;
    R from_value, to_value;

    R length() const { return norm(to - from); }
    Point along() const { return unit(to - from); }
    R slope() const { return std::clamp(R((to_value - from_value) / length()), R(-1), R(1)); }
    // How fast the value grows away from the segment's line, and the direction in which it grows fastest on its left
    // (side 1) or right (-1).
    R rise() const { return sqrt((1 - slope()) * (1 + slope())); }
    Point light(int side) const {
      const Point a = along();
      return slope() * a + R(side * rise()) * Point{-a.y, a.x};
    }
    // Where parallel light meets p: its value and side; none where no such ray does.
    struct Sight {
      R value;
      int side;
      R aside;  // how far from the line
    };
    std::optional<Sight> sight_of(Point p) const {
      const R ahead = dot(along(), p - from), aside = cross(along(), p - from),
              foot = rise() * ahead - abs(aside) * slope();
      if (!(foot > 0 && foot < rise() * length())) return {};
      return Sight{from_value + slope() * ahead + abs(aside) * rise(), aside < 0 ? -1 : 1, R(abs(aside))};
    }
  };

  // Within its face: to the corners and targets that its parallel light meets, and out over the edges.
  void start_segment(Index h, Segment s) {
    if (s.length() == 0) return;
    for (const Target& t : targets_in_[h / 3]) {
      if (const auto seen = s.sight_of(place_in(h, t))) reach_target(t.index, seen->value);
    }
    Index g = h;
    for (int k = 0; k < 3; ++k) {
      const Corner& c = complex_.corner[g];
      const auto seen = s.sight_of({0, 0});
      if (seen && seen->aside <= kMargin * epsilon<R>() * s.length()) {
        // In a face without area: the vertex is on the curve, which lights all faces around it.
        reach({seen->value, c.from, Arrival::By::Start, 0, 0});
      } else if (seen) {
        const Point back = Point{0, 0} - s.light(seen->side);
        reach({seen->value, c.from, Arrival::By::Corner, g, angle_in(c.angle, Point{1, 0}, back)});
      }
      for (const int side : {1, -1}) leave(g, s, side);
      s.from = next_frame(c, s.from);
      s.to = next_frame(c, s.to);
      if (s.length() == 0) return;
      g = Mesh::next(g);
    }
  }

  // The parallel light of one side over the edge of corner g, the segment in the frame of g.
  void leave(Index g, const Segment& s, int side) {
    const Corner& c = complex_.corner[g];
    if (c.length == 0 || !(s.light(side).y < 0)) return;
    Window w;
    w.parallel = true;
    w.sigma = s.from_value;
    w.least = std::min(s.from_value, s.to_value);
    w.left = w.right = Point{0, 0} - s.light(side);  // seen from the other side
    w.source = w.left_from = {c.length - s.from.x, -s.from.y};
    w.right_from = {c.length - s.to.x, -s.to.y};
    if (cross(w.right, w.left_from - w.right_from) < 0) std::swap(w.left_from, w.right_from);
    const auto beyond = [&](Point p) { return p.x - p.y * (w.left.x / w.left.y); };
    if (beyond(w.left_from) < 0) w.left_from = {0, 0};
    if (beyond(w.right_from) > c.length) w.right_from = {c.length, 0};
    cross_edge(g, w);
  }

  // All rays from a point q of the face over the edge of corner g, q in the frame of g.
  void leave(Index g, Point q, R offset) {
    const Corner& c = complex_.corner[g];
    if (c.length == 0) return;
    Window w;
    w.sigma = offset;
    w.source = {c.length - q.x, -q.y};  // the frame seen from the other side: x from the end of the halfedge
    w.left_from = w.right_from = w.source;
    w.left = w.source.y == 0 && w.source.x <= 0 ? Point{1, 0} : unit(Point{0, 0} - w.source);
    w.right = w.source.y == 0 && w.source.x >= c.length ? Point{-1, 0} : unit(Point{c.length, 0} - w.source);
    cross_edge(g, w);  // without a vertex behind: rule 3 wants rays that cross the whole face
  }

  // ---- windows

  // Hands a wedge that leaves a face over its halfedge h to every other face of the edge. The wedge is given in the
  // frame whose origin is the left end of the edge as the rays see it (the end of h).
  void cross_edge(Index h, const Window& w) {
    const Corner& from = complex_.corner[h];
    for (const Index g : complex_.edge[from.edge].halfedges) {
      if (g == h) continue;
      Window child = w;
      child.halfedge = g;
      if (complex_.corner[g].from == from.from) {  // the neighbour lies the other way round
        child.source = mirrored(w.source, from.length);
        child.back_at = mirrored(w.back_at, from.length);
        child.left_from = mirrored(w.right_from, from.length);
        child.right_from = mirrored(w.left_from, from.length);
        child.left = mirrored(w.right);
        child.right = mirrored(w.left);
      }
      if (!child.parallel) child.source.y = std::min(child.source.y, R{0});
      for (Point* p : {&child.left_from, &child.right_from}) p->y = std::min(p->y, R{0});
      if (returns(child) || !prune(child)) continue;
      windows_.push(child);
    }
  }

  // Where the ray from a place in direction d meets the edge.
  static R meets(Point from, Point d, R length) {
    if (from.y == 0 || d.y <= 0) {
      return std::clamp(from.y == 0 ? from.x : d.x > 0 ? length : R{0}, R{0}, length);
    }
    return std::clamp(from.x - from.y * (d.x / d.y), R{0}, length);
  }

  // Rule 1, no face twice. A shortest path that meets a face twice can be straightened inside the face, so of all
  // shortest paths to a point the one that crosses the fewest faces meets every face once. A window on whose branch
  // its face has already been holds no such path. (Looked for only as far back as the face is large: that is where
  // flat faces glued to each other would go round for ever.)
  bool returns(const Window& w) const {
    const Corner& c = complex_.corner[w.halfedge];
    const R size = c.length + norm(c.apex);
    for (std::uint32_t p = w.parent; p != kRoot && branch_[p].key >= least(w) - size; p = branch_[p].parent) {
      if (branch_[p].face == w.halfedge / 3) return true;
    }
    return false;
  }

  R least(const Window& w) const {
    const R length = complex_.corner[w.halfedge].length;
    const R a = meets(w.left_from, w.left, length), b = std::max(a, meets(w.right_from, w.right, length));
    return least_between(w, a, b);
  }
  static R least_between(const Window& w, R a, R b) {
    if (w.parallel) return std::min(along(w, a), along(w, b));
    return along(w, std::clamp(w.source.x, a, b));
  }

  static R along(const Window& w, R x) {
    const Point way = Point{x, 0} - w.source;
    return w.parallel ? std::max(w.least, R(w.sigma + dot(w.left, way))) : R(w.sigma + norm(way));
  }

  // Cuts off what cannot be part of a shortest path and sets the key; false where nothing remains. Prefixes of shortest
  // paths are shortest: a ray that reaches the edge later than another real path does is on none.
  //
  // Rule 2, the ends of the edge. From the end A at x = 0 the path along the edge reaches x at U(A) + x. The ray
  // reaches it at d(x), and d(x) - x never increases with x: so what is worse than through A is a part next to A, and
  // where it ends at b, everything. Mirrored for B.
  // Rule 3, the vertex behind (Xin and Wang 2009, Theorem 3.2). `back` is the third vertex V of the face that the rays
  // have just crossed. Let it be left of the leftmost ray, and U(V) + |V b| < d(b). Inside that face the segment V b
  // crosses every ray of the window, at some q before the edge: U(V) + |V q| + |q b| < d(b) <= d(q) + |q b|, so V
  // reaches q before the ray does. Mirrored for the right.
  bool prune(Window& w) {
    const Corner& c = complex_.corner[w.halfedge];
    if (c.length == 0) return false;  // its two ends are one point, and emit into every corner (settle)
    if (grazes(w, c.length)) return false;
    if (is_empty(w)) return false;
    const R end_a = distance_[c.from], end_b = distance_[c.to];
    R a = meets(w.left_from, w.left, c.length), b = std::max(a, meets(w.right_from, w.right, c.length));
    if (along(w, b) - b > end_a + margin(end_a)) return false;
    if (along(w, a) - (c.length - a) > end_b + margin(end_b)) return false;
    if (const R x = first_useful(w, w.source.x, w.left.x, end_a - w.sigma); x > a && x < b) {
      if (along(w, x) - x > end_a + margin(end_a) / 2) cut(w, w.left, w.left_from, a, x);
    }
    if (const R x = c.length - first_useful(w, c.length - w.source.x, -w.left.x, end_b - w.sigma); x > a && x < b) {
      if (along(w, x) - (c.length - x) > end_b + margin(end_b) / 2) cut(w, w.right, w.right_from, b, x);
    }
    if (a > b) return false;
    if (w.back != kNoIndex) {
      const R behind = distance_[w.back];
      // Without doubt: a source on the edge behind lies in line with V and a limit ray.
      const R side_left = cross(w.left, w.back_at - w.left_from) - doubt(w.left_from, w.back_at);
      const R side_right = cross(w.right, w.back_at - w.right_from) + doubt(w.right_from, w.back_at);
      const Point at_b{b, 0}, at_a{a, 0};
      if (side_left > 0 && behind + norm(at_b - w.back_at) + margin(behind) < along(w, b)) return false;
      if (side_right < 0 && behind + norm(at_a - w.back_at) + margin(behind) < along(w, a)) return false;
    }
    w.key = least_between(w, a, b);
    return w.key <= radius_;
  }

  static bool is_empty(const Window& w) {
    if (w.parallel) return !(cross(w.right, w.left_from - w.right_from) > 0);
    const R opening = cross(w.right, w.left);
    return opening < 0 || (opening == 0 && dot(w.right, w.left) > 0);
  }

  // Along the edge from beyond one of its ends: all that this lights is lit by that end as well, straight on. (In a
  // face without area the other edges may lie between the source and this one.)
  static bool grazes(const Window& w, R length) {
    if (w.parallel) return w.left.y <= kLateral * epsilon<R>();
    const R doubtful = kLateral * epsilon<R>() * (abs(w.source.x) + length);
    return -w.source.y <= doubtful && (w.source.x <= 0 || w.source.x >= length);
  }

  // The x up to which `other` + x is less than |x - source| by the margin; whatever rounding makes of it, the caller
  // checks what it gets.
  R first_useful(const Window& w, R source_x, R slope, R other) const {
    const R value = other + margin(other + w.sigma), sum = value + source_x;
    if (!(value < far<R>())) return -1;
    if (w.parallel) return slope < 1 ? R((-w.left.y * w.source.y - slope * source_x - value) / (1 - slope)) : R(-1);
    if (sum == 0) return -1;
    return (source_x * source_x + w.source.y * w.source.y - value * value) / (2 * sum);
  }

  // Moves one end of the window to x. Next to the source x says little about the direction: then it is left alone.
  void cut(Window& w, Point& direction, Point& from, R& end, R x) const {
    if (w.parallel) {
      from = {x, 0};
    } else {
      const Point d = Point{x, 0} - w.source;
      if (norm(d) < 1e-6 * complex_.corner[w.halfedge].length) return;
      direction = unit(d);
    }
    end = x;
  }

  static bool left_of(Point d, Point ray) { return cross(ray, d) > 0 || (cross(ray, d) == 0 && dot(ray, d) > 0); }
  static bool right_of(Point d, Point ray) { return cross(ray, d) < 0 || (cross(ray, d) == 0 && dot(ray, d) > 0); }

  bool sees(const Window& w, Point p) const {
    const Point l = p - w.left_from, r = p - w.right_from;
    const R l_doubt = doubt(w.left_from, p), r_doubt = doubt(w.right_from, p);
    return cross(w.left, l) <= l_doubt && cross(w.right, r) >= -r_doubt &&
           (dot(w.left, l) >= -l_doubt || dot(w.right, r) >= -r_doubt);
  }

  // The way to a point that is seen, by where the ray meets the edge: on one line with the edge, in a face without
  // area, the point may lie on the source's side of it.
  R through_edge(const Window& w, Point p) const {
    const R length = complex_.corner[w.halfedge].length;
    const R x = w.parallel ? std::clamp(R(p.x - p.y * (w.left.x / w.left.y)), R{0}, length)
                           : meets(w.source, p - w.source, length);
    return along(w, x) + norm(p - Point{x, 0});
  }

  // How far (times 1, across a unit direction) rounding may have moved p against a ray from the source.
  static R doubt(Point from, Point p) {
    return epsilon<R>() * (kAngle * norm(p - from) + kLateral * (norm(from) + norm(p)));
  }

  // Through the face: to the apex, the targets inside and, split at the apex, to the two other edges.
  void propagate(const Window& w) {
    const Corner& c = complex_.corner[w.halfedge];
    const Index behind = Mesh::previous(w.halfedge), ahead = Mesh::next(w.halfedge);
    branch_.push_back({w.parent, w.halfedge / 3, w.key});
    const auto me = static_cast<std::uint32_t>(branch_.size() - 1);
    const Point to_apex = c.apex - w.source;
    if (sees(w, c.apex)) arrive_at_apex(w, w.parallel ? w.left : to_apex);
    for (const Target& t : targets_in_[w.halfedge / 3]) {
      const Point p = place_in(w.halfedge, t);
      if (sees(w, p)) reach_target(t.index, through_edge(w, p));
    }
    const Point split = w.parallel ? w.left : norm(to_apex) > 0 ? unit(to_apex) : Point{0, 1};
    const Point split_from = w.parallel ? c.apex : w.source;
    const bool beside_left = left_of(c.apex - w.left_from, w.left),
               beside_right = right_of(c.apex - w.right_from, w.right);
    const R left_length = complex_.corner[behind].length, right_length = complex_.corner[ahead].length;
    if (!beside_left && left_length > 0) {
      const Point along_edge = (1 / left_length) * c.apex;
      Window child = turned(w, {0, 0}, along_edge, {c.length, 0}, c.to, me);
      if (!beside_right) {
        child.right = turn(split, along_edge);
        child.right_from = turn(split_from, along_edge);
      }
      cross_edge(behind, child);
    }
    if (!beside_right && right_length > 0) {
      const Point along_edge = (1 / right_length) * Point{c.apex_to_end, -c.apex.y};
      Window child = turned(w, c.apex, along_edge, {0, 0}, c.from, me);
      if (!beside_left) {
        child.left = turn(split, along_edge);
        child.left_from = turn(split_from - c.apex, along_edge);
      }
      cross_edge(ahead, child);
    }
  }

  static Point turn(Point d, Point x_axis) { return {dot(x_axis, d), cross(x_axis, d)}; }

  static Window turned(const Window& w, Point origin, Point x_axis, Point back_at, Index back, std::uint32_t parent) {
    Window child = w;
    child.source = turn(w.source - origin, x_axis);
    child.left = turn(w.left, x_axis);
    child.right = turn(w.right, x_axis);
    child.left_from = turn(w.left_from - origin, x_axis);
    child.right_from = turn(w.right_from - origin, x_axis);
    child.back = back;
    child.back_at = turn(back_at - origin, x_axis);
    child.parent = parent;
    return child;
  }

  // `to_apex`: along the ray that reaches it.
  void arrive_at_apex(const Window& w, Point to_apex) {
    const Corner& c = complex_.corner[w.halfedge];
    const R d = through_edge(w, c.apex);
    const Index at = Mesh::previous(w.halfedge);  // the corner at the apex: its halfedge runs to `from`
    if (norm(to_apex) == 0 || complex_.corner[at].length == 0) {
      reach({d, c.apex_vertex, Arrival::By::Start, 0, 0});
      return;
    }
    const Point ahead = Point{0, 0} - c.apex, back = Point{0, 0} - to_apex;
    reach({d, c.apex_vertex, Arrival::By::Corner, at, angle_in(complex_.corner[at].angle, ahead, back)});
  }

  // ---- vertices

  Index number(Index v, Index neighbour) const {
    const auto& list = complex_.neighbours[v];
    return static_cast<Index>(
        std::find_if(list.begin(), list.end(), [&](const Neighbour& n) { return n.vertex == neighbour; }) -
        list.begin());
  }

  // In order of distance, so that the first arrival is final. Equal ones follow, each with its own shadow.
  void settle(const Arrival& a) {
    const R known = distance_[a.vertex];
    if (a.distance > known + margin(known)) return;
    Shadows& before = shadows_[a.vertex];
    if (before.everywhere) return;
    if (before.nodes.empty()) walk_edges(a.vertex, known);
    const std::size_t degree = complex_.neighbours[a.vertex].size();
    before.everywhere = a.by == Arrival::By::Start || complex_.pinched[a.vertex];
    const std::vector<R> link = before.everywhere ? std::vector<R>(degree, far<R>()) : link_distances(a);
    for (const std::vector<R>& other : before.nodes) {
      if (same_way(link, other)) return;
    }
    before.nodes.push_back(link);
    for (const Index h : complex_.corners_at[a.vertex]) cast_shadow(h, link, known);
  }

  static bool same_way(const std::vector<R>& a, const std::vector<R>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i] != b[i] && !(abs(a[i] - b[i]) <= kSameWay)) return false;
    }
    return true;
  }

  void walk_edges(Index v, R d) {
    for (const Neighbour& n : complex_.neighbours[v]) {
      reach({d + complex_.edge[n.edge].length, n.vertex, Arrival::By::Edge, number(n.vertex, v), 0});
    }
    for (const Index h : complex_.corners_at[v]) {
      for (const Target& t : targets_in_[h / 3]) reach_target(t.index, d + norm(place_in(h, t)));
    }
    for (Index i = 0; i < target_at_.size(); ++i) {
      const PointLocation& at = target_at_[i];
      if (at.on == PointLocation::On::Vertex && at.vertex == v) reach_target(i, d);
      if (at.on != PointLocation::On::Edge) continue;
      const Edge& e = complex_.edge[edge_of(at)];
      if (e.a == v || e.b == v) reach_target(i, d + share_from(at, v) * e.length);
    }
  }

  // The link of a vertex is a graph: a node per edge at the vertex, an arc per corner, as long as the corner's angle.
  // Distances in it from where the front comes from; infinity where the fan hangs together with it by the vertex only.
  std::vector<R> link_distances(const Arrival& a) const {
    std::vector<R> link(complex_.neighbours[a.vertex].size(), far<R>());
    if (a.by == Arrival::By::Edge) {
      link[a.at] = 0;
    } else {
      const Corner& c = complex_.corner[a.at];
      link[c.ahead] = a.angle;
      link[c.behind] = std::max(R{0}, c.angle - a.angle);
    }
    // Arcs are relaxed in turns until nothing changes: one or two turns in the order of a fan, and simple.
    for (bool changed = true; changed;) {
      changed = false;
      for (const Index h : complex_.corners_at[a.vertex]) {
        const Corner& c = complex_.corner[h];
        if (link[c.ahead] + c.angle < link[c.behind]) link[c.behind] = link[c.ahead] + c.angle, changed = true;
        if (link[c.behind] + c.angle < link[c.ahead]) link[c.ahead] = link[c.behind] + c.angle, changed = true;
      }
    }
    return link;
  }

  // Rule 4, the shadow. Near a vertex the complex is a cone over the link, and a path that comes to the apex of a cone
  // from one direction and leaves it in another is locally shortest exactly where the two are at least pi apart in the
  // link (otherwise the flat sector between them holds a shortcut). That holds for every link: circles, arcs, several
  // components, arcs that meet in threes. In one corner these directions are an interval.
  void cast_shadow(Index h, const std::vector<R>& link, R d) {
    const Corner& c = complex_.corner[h];
    const Corner& edge = complex_.corner[Mesh::next(h)];  // the edge opposite to the vertex
    if (edge.length == 0 || c.length == 0 || norm(c.apex) == 0) return;
    const R begin = std::max(R{0}, half_turn<R>() - link[c.ahead] - kShadow);
    const R end = std::min(c.angle, c.angle - (half_turn<R>() - link[c.behind]) + kShadow);
    if (!(begin < end)) return;
    Window w;
    w.sigma = d;
    w.source = {edge.length - edge.apex.x, -edge.apex.y};
    const Point to_first{edge.apex.x, edge.apex.y};
    w.right = unit(to_first);  // towards `to` of h, which is the right end as seen from the vertex
    w.left = unit(Point{0, 0} - w.source);
    w.left_from = w.right_from = w.source;
    if (end < c.angle) w.left = rotated(w.right, end);
    if (begin > 0) w.right = rotated(w.right, begin);
    w.back = c.from;
    w.back_at = w.source;
    cross_edge(Mesh::next(h), w);
  }

  static Point rotated(Point d, R angle) {
    const R c = cos(angle), s = sin(angle);
    return {c * d.x - s * d.y, s * d.x + c * d.y};
  }

  std::vector<Real> rounded(const std::vector<R>& values) const {
    std::vector<Real> result;
    for (const R& d : values) result.push_back(d > radius_ ? kFar : static_cast<Real>(d));
    return result;
  }

  struct Ancestor {
    std::uint32_t parent;
    Index face;
    R key;
  };
  struct Shadows {
    std::vector<std::vector<R>> nodes;  // the link distances of the arrivals so far
    bool everywhere = false;
  };

  const Mesh& mesh_;
  Complex<R> complex_;
  R radius_;
  R scale_ = 0;
  std::vector<R> distance_, target_;
  std::uint64_t windows_taken_ = 0;
  std::vector<PointLocation> target_at_;
  std::vector<std::vector<Target>> targets_in_;  // [faces]
  Queue<Window> windows_;
  Queue<Arrival> arrivals_;
  std::vector<Ancestor> branch_;
  std::vector<Shadows> shadows_;  // [vertices]
};

}  // namespace

Truth polyhedral_distance(const Mesh& mesh, std::span<const Source> sources, Real radius,
                          std::span<const SurfacePoint> targets, Arithmetic arithmetic) {
  switch (arithmetic) {
    case Arithmetic::Quad:
      return Solver<Quad>(mesh, sources, radius, targets).run();
    case Arithmetic::Octuple:
      return Solver<Octuple>(mesh, sources, radius, targets).run();
    case Arithmetic::LongDouble:
      break;
  }
  return Solver<Real>(mesh, sources, radius, targets).run();
}

}  // namespace brushfire::oracle
