// A ray is followed backwards from face to face, each laid flat over the edge just crossed, until its root is found.
#include <brushfire/solvers/windows/detail/trace.h>

#include <brushfire/mesh/flat_face.h>
#include <brushfire/solvers/windows/detail/face.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

namespace brushfire::detail::BRUSHFIRE_NUMBERS {
namespace {

// A ray that crosses an edge this near (share of the edge) to an end passes through the vertex there, if the vertex'
// value says so as well, to kAgreement of the value.
constexpr Real kThroughVertex = 1e-9;
constexpr Real kAgreement = 1e-9;
// The root found must lie where the ray ends, to this share of the leg's length: far more than unfolding rounds, far
// less than what tells apart the sheets over a non-manifold edge.
constexpr Real kAtRoot = 1e-7;

// Two points of a leg are one where no more than this share of the value lies between them.
constexpr Real kSamePlace = 1e-12;

struct Position {
  Index halfedge;  // the next edge to cross, from inside of its face
  Vec2 source;     // the ray's root, in the halfedge's frame: below
  Vec2 point;      // where the ray is: above, or on the edge
  Real length;     // so far
};

class Tracer {
 public:
  // Vertices are on the way only where their values are `below`. (One at the same place has the same value.)
  Tracer(const WindowFieldData& data, const Ray& ray, Real value, Real below)
      : data_(data), mesh_(data.mesh), ray_(ray), value_(value), below_(below) {}

  bool run(const FaceWeights& at, WindowField::Leg& leg) {
    const Frame frame = frame_at(ray_.halfedge);
    leg.points.push_back({at.face, at.weights});
    Position start{ray_.halfedge, ray_.source, in_frame(frame, ray_.halfedge % 3, at.weights), 0};
    if (ends_in_face(start, leg)) return true;
    open_.push_back({start, leg.points.size()});
    // A ray crosses a face a few times at most; over edges of many faces it may have to try many sheets.
    std::size_t budget = 16 + 64 * static_cast<std::size_t>(mesh_.face_count());
    while (!open_.empty() && budget-- > 0) {
      const auto [position, count] = open_.back();
      open_.pop_back();
      leg.points.resize(count);
      if (step(position, leg)) return true;
    }
    return false;
  }

 private:
  Frame frame_at(Index h) const {
    const auto l = mesh_.lengths();
    const Real length = l[h], left = l[Mesh::previous(h)], right = l[Mesh::next(h)];
    return {length, left, right, apex_over_edge(length, left, right, mesh_.double_areas()[h / 3])};
  }

  Real value_of(Index v) const { return data_.vertices[v].value; }

  // A run that stopped early does not know the values of all vertices along a path: those are NaN and exclude nothing.
  bool is_above(Index v, Real bound) const { return value_of(v) > bound; }

  // Over position.halfedge into every other face there; true where the leg's start was found.
  bool step(const Position& at, WindowField::Leg& leg) {
    const Index h = at.halfedge;
    const Real length = mesh_.lengths()[h];
    const Real across = at.source.x * at.point.y - at.source.y * at.point.x, along = at.point.y - at.source.y;
    if (!(along >= 0) || !(length > 0)) return false;
    // Past its root: this was not the sheet.
    if (at.source.y > kAtRoot * value_) return false;
    // A root on the edge itself is where the ray crosses: in a face without area all may lie on one line.
    const bool root_is_here = abs(at.source.y) <= kSamePlace * value_;
    const Real straight = root_is_here || along == 0 ? at.source.x : across / along;
    const Real x = std::clamp(straight, Real{0}, length);
    const Real so_far = at.length + length_of(at.point.x - x, at.point.y);
    const auto ends_at_end = [&](Index v, Index corner, Real place) {
      return ends_at_vertex(v, corner, h, at.length, at.length + length_of(at.point.x - place, at.point.y), leg);
    };
    if (x <= kThroughVertex * length && ends_at_end(mesh_.from(h), h % 3, 0)) return true;
    if (x >= (1 - kThroughVertex) * length && ends_at_end(mesh_.to(h), next3(h % 3), length)) return true;
    if (abs(straight - x) > kAtRoot * value_) return false;
    // On a shortest path the value here is what is left of it, which bounds the values at the edge's ends: this tells
    // the right sheet over a non-manifold edge from the others within a few faces.
    const Real left = value_ - so_far + kAgreement * value_;
    if (is_above(mesh_.from(h), left + x) || is_above(mesh_.to(h), left + length - x)) return false;
    const bool may_come_again = so_far - at.length <= kSamePlace * value_ || branched_;
    if (may_come_again && has_passed(h, x, at.source, so_far)) return false;
    SurfacePoint crossing{Mesh::face_of(h), {0, 0, 0}};
    crossing.weights[next3(h % 3)] = x / length;
    crossing.weights[h % 3] = 1 - x / length;
    // Also where the ray leaves a face at the place where it came in (near a corner, or through a face without area):
    // the next point shares a face with this one only.
    leg.points.push_back(crossing);
    // A root on the edge itself is kept there: faces without area beyond need to know.
    const Real above = root_is_here ? 0 : -at.source.y;
    const auto opposite = mesh_.opposite();
    branched_ = branched_ || opposite[opposite[h]] != h;
    for (Index g = opposite[h]; g != h; g = opposite[g]) {
      const bool turned = mesh_.from(g) == mesh_.to(h);
      Position next{g, {turned ? length - at.source.x : at.source.x, above}, {turned ? length - x : x, 0}, so_far};
      if (ends_in_face(next, leg)) return true;
      const Frame frame = frame_at(g);
      const Real side = cross(frame.apex - next.point, next.source - next.point);
      // Along a line that holds the apex as well either may be the edge.
      if (side >= 0) open_.push_back({leave(next, frame, true), leg.points.size()});
      if (side <= 0) open_.push_back({leave(next, frame, false), leg.points.size()});
    }
    return false;
  }

  // Through faces without area a ray may come round to where it was without any progress; over edges of many faces it
  // comes to the same place on many ways, twice as many at each such edge.
  bool has_passed(Index h, Real x, Vec2 source, Real so_far) {
    const auto same = [&](Real a, Real b) { return abs(a - b) <= kSamePlace * value_; };
    const auto [begin, end] = passed_.equal_range(h);
    const bool passed = std::any_of(begin, end, [&](const auto& p) {
      return same(p.second.so_far, so_far) && same(p.second.x, x) && same(p.second.source.x, source.x) &&
             same(p.second.source.y, source.y);
    });
    if (!passed) passed_.insert({h, {x, source, so_far}});
    return passed;
  }

  // From a position on an edge of a face (the ray's root above, beyond the face) to the edge through which it leaves:
  // the one to the left of the apex or the other.
  static Position leave(const Position& at, const Frame& frame, bool left) {
    const Index h = left ? Mesh::previous(at.halfedge) : Mesh::next(at.halfedge);
    const Real side = left ? frame.left : frame.right;
    const Vec2 origin = left ? frame.apex : Vec2{frame.length, 0};
    const Vec2 end = left ? Vec2{0, 0} : frame.apex;
    if (!(side > 0)) return {h, {0, 0}, {0, 0}, at.length};  // no such edge: step() gives up on it
    const Vec2 u = (1 / side) * (end - origin);
    const auto turn = [&](Vec2 p) { return Vec2{dot(u, p - origin), cross(u, p - origin)}; };
    return {h, turn(at.source), turn(at.point), at.length};
  }

  bool ends_at_vertex(Index v, Index corner, Index h, Real so_far, Real length, WindowField::Leg& leg) const {
    // The root too must be as far as the value says: over non-manifold edges another sheet may lead there, by a detour.
    const bool unknown = isnan(value_of(v));
    const bool consistent = abs(value_of(v) + length - value_) <= kAgreement * value_ && value_of(v) < below_;
    if (unknown ? v != ray_.root : !consistent) return false;
    SurfacePoint p{Mesh::face_of(h), {0, 0, 0}};
    p.weights[corner] = 1;
    add_last(p, length - so_far, leg);
    leg.length = length;
    leg.vertex = v;
    return true;
  }

  // The root, in place of the crossing before it where both are at one place and the point before that can do without.
  void add_last(const SurfacePoint& p, Real step, WindowField::Leg& leg) const {
    const std::size_t n = leg.points.size();
    const bool replaces = step <= kSamePlace * value_ && n > 1 &&
                          common_face(mesh_, locate(mesh_, leg.points[n - 2]), locate(mesh_, p)) != kNoIndex;
    if (replaces) leg.points.pop_back();
    leg.points.push_back(p);
  }

  // Whether the root is in the face of the position's halfedge, where the ray says.
  bool ends_in_face(const Position& at, WindowField::Leg& leg) const {
    const Index h = at.halfedge, k = h % 3, face = Mesh::face_of(h), n = mesh_.vertex_count();
    const Real rest = length_of(at.source.x - at.point.x, at.source.y - at.point.y);
    const Real within = kAtRoot * (at.length + rest);
    const auto is_root = [&](const std::array<Real, 3>& weights) {
      const Vec2 p = in_frame(frame_at(h), k, weights);
      return length_of(p.x - at.source.x, p.y - at.source.y) <= within;
    };
    const auto finish = [&](const std::array<Real, 3>& weights) {
      add_last({face, weights}, rest, leg);
      leg.length = at.length + rest;
      return true;
    };
    if (ray_.root < n) {
      if (value_of(ray_.root) >= below_) return false;
      for (Index i = 0; i < 3; ++i) {
        std::array<Real, 3> weights{0, 0, 0};
        weights[i] = 1;
        if (mesh_.faces()[face][i] == ray_.root && is_root(weights)) {
          leg.vertex = ray_.root;
          return finish(weights);
        }
      }
      return false;
    }
    for (const FaceWeights& f : faces_around(mesh_, data_.sources[ray_.root - n].at)) {
      if (f.face == face && is_root(f.weights)) {
        leg.source = ray_.root - n;
        return finish(f.weights);
      }
    }
    return false;
  }

  const WindowFieldData& data_;
  const Mesh& mesh_;
  const Ray& ray_;
  const Real value_, below_;
  struct Open {
    Position position;
    std::size_t points;
  };
  struct Crossed {
    Real x;
    Vec2 source;
    Real so_far;
  };
  std::unordered_multimap<Index, Crossed> passed_;  // by halfedge: where a ray may come again
  bool branched_ = false;                           // over an edge of many faces
  std::vector<Open> open_;                          // sheets of non-manifold edges that are still to be tried
};

// A point in every face that holds it.
std::vector<FaceWeights> in_all_faces(const Mesh& mesh, const FaceWeights& at) {
  const PointLocation here = locate(mesh, {at.face, at.weights});
  if (here.on != PointLocation::On::Vertex) return faces_around(mesh, here);
  std::vector<FaceWeights> faces;
  for (const Index h : mesh.corners(here.vertex)) {
    FaceWeights& f = faces.emplace_back(FaceWeights{Mesh::face_of(h), {0, 0, 0}});
    f.weights[h % 3] = 1;
  }
  return faces;
}

// Straight to a corner of the face or to a source in it, if the value says that this may be; else no points. `best` is
// the best so far and `best_value` what it comes to.
void offer_leg_within_face(const WindowFieldData& data, const FaceWeights& at, Real value, Real& best_value,
                           WindowField::Leg& best) {
  PointLocation here;
  here.face = at.face;
  here.weights = at.weights;
  const auto offer = [&](const std::array<Real, 3>& weights, Real before, Real length, Index vertex, Index source) {
    if (!(before + length < best_value)) return;
    best_value = before + length;
    best = {{{at.face, at.weights}, {at.face, weights}}, length, vertex, source};
  };
  const std::array<Real, 3> d = corner_distances(data.mesh, here);
  for (Index i = 0; i < 3; ++i) {
    std::array<Real, 3> weights{0, 0, 0};
    weights[i] = 1;
    const Index v = data.mesh.faces()[at.face][i];
    if (data.vertices[v].value < value) offer(weights, data.vertices[v].value, d[i], v, kNoIndex);
  }
  for (Index s = 0; s < data.sources.size(); ++s) {
    const auto weights = weights_in(data.mesh, data.sources[s].at, at.face);
    if (!weights) continue;
    const Real length = distance_within(data.mesh, at.face, here, data.sources[s].at);
    offer(*weights, data.sources[s].offset + data.shift, length, kNoIndex, s);
  }
}

// The same in all faces that hold the point: where edges without length bring vertices to one place, light may have
// come round to it through others than those that lie on its straight way.
WindowField::Leg leg_within_a_face(const WindowFieldData& data, const FaceWeights& at, Real value) {
  WindowField::Leg best;
  Real best_value = value + kAtRoot * value;
  for (const FaceWeights& f : in_all_faces(data.mesh, at)) offer_leg_within_face(data, f, value, best_value, best);
  return best;
}

}  // namespace

WindowField::Leg trace_leg(const WindowFieldData& data, const FaceWeights& at, const Ray& ray, Real value) {
  WindowField::Leg leg;
  if (Tracer(data, ray, value, value).run(at, leg)) return leg;
  leg = leg_within_a_face(data, at, value);
  // Over an edge without length there may be another vertex in the way.
  if (leg.points.empty() && !Tracer(data, ray, value, kInfinity).run(at, leg)) leg = {};
  return leg;
}

}  // namespace brushfire::detail::BRUSHFIRE_NUMBERS
