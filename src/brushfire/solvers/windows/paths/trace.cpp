// A ray is followed backwards from face to face, each laid flat over the edge just crossed, until its pseudo-source is
// found. Only where that is beyond doubt: over edges of two faces, past vertices at a distance that can be told.
#include <brushfire/solvers/windows/paths/trace.h>

#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/solvers/windows/algebra/frame.h>
#include <brushfire/solvers/windows/algebra/line_source.h>
#include <brushfire/solvers/windows/paths/leg_search.h>

#include <algorithm>
#include <cmath>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

struct Position {
  Index halfedge;  // the next edge to cross, from inside of its face
  Vec2 source;     // the ray's pseudo-source, in the halfedge's frame: below; of parallel light the direction there
  Vec2 point;      // where the ray is: above, or on the edge
  bool mirrored = false;
};

class Tracer {
 public:
  Tracer(const WindowFieldData& data, const PointRecord& record, const CrossingListener& knows_the_rest)
      : data_(data),
        mesh_(data.mesh),
        faces_(mesh_.faces()),
        lengths_(mesh_.lengths()),
        opposite_(mesh_.opposite()),
        ray_(record.ray),
        value_(record.value),
        room_(data.room_for(record)),
        start_(ray_.pseudo_source < mesh_.vertex_count() ? value_of(ray_.pseudo_source) : 0),
        knows_the_rest_(knows_the_rest) {}

  WindowField::Leg run(const FaceWeights& at) {
    leg_.points.reserve(16);
    leg_.points.push_back({at.face, at.weights});
    Position here{ray_.halfedge, ray_.source, in_frame(frame_at(ray_.halfedge), ray_.halfedge % 3, at.weights)};
    bool found = ends_in_face(here);
    // A ray crosses a face a few times at most.
    std::size_t budget = 16 + 3 * static_cast<std::size_t>(mesh_.face_count());
    while (!found && budget-- > 0) {
      const Step step = over_edge(here);
      if (step == Step::Lost) return {};
      if (step == Step::On && knows_the_rest_ &&
          knows_the_rest_({here.halfedge, here.source, here.point, here.mirrored}))
        return {};
      found = step == Step::Found || ends_in_face(here);
      if (!found) leave(here);
    }
    return found && is_explained() ? leg_ : WindowField::Leg{};
  }

 private:
  enum class Step { On, Found, Lost };

  Frame frame_at(Index h) const { return frame_of(shape_of(mesh_, h / 3), h % 3); }
  Real value_of(Index v) const { return data_.vertices[v].value; }
  Index from(Index h) const { return faces_[h / 3][h % 3]; }
  Index to(Index h) const { return from(Mesh::next(h)); }

  // A real path of this length is there; is it the one that the value means?
  bool is_explained() const {
    const Real start = leg_.vertex != kNoIndex ? value_of(leg_.vertex) : start_of_source_;
    const Real room = ends_on_curve_ ? room_at_source() : room_;
    return abs(start + leg_.length - value_) <= room && (!ends_on_curve_ || is_straight());
  }

  // A ray that ends at a point has met it; one that ends somewhere on a curve may have been led astray by frames, which
  // in needles are turned by much. Then the way that was found is longer than it was thought to be.
  bool is_straight() const {
    Real length = 0;
    PointLocation here = locate(mesh_, leg_.points.front(), 0);
    for (std::size_t i = 1; i < leg_.points.size(); ++i) {
      const PointLocation next = locate(mesh_, leg_.points[i], 0);
      length += distance_within(mesh_, leg_.points[i].face, here, next);
      here = next;
    }
    return abs(length - leg_.length) <= room_at_source();
  }

  Real room_at_source() const { return std::min(room_, WindowFieldData::room_for(value_, leg_.length)); }

  // Over the position's edge into the face beyond, or to a vertex in the way.
  Step over_edge(Position& at) {
    const Index h = at.halfedge, g = opposite_[h];
    const Real length = lengths_[h];
    const Real across = at.source.x * at.point.y - at.source.y * at.point.x;
    const Real along = origin_weight(ray_.kind) * at.point.y - at.source.y;
    if (!(at.source.y < 0) || !(along > 0) || !(length > 0)) return Step::Lost;
    const Real x = across / along, rest = length - x;
    const auto ends_at_end = [&](Index v, Index corner, Real place, Real miss) {
      if (abs(miss) > 2 * kThrough * value_) return false;  // no leg is that long
      return ends_at_vertex(v, {Mesh::face_of(h), corner}, {at.point.x - place, at.point.y},
                            {at.source.x - origin_weight(ray_.kind) * place, at.source.y}, abs(miss));
    };
    if (ends_at_end(from(h), h % 3, 0, x)) return Step::Found;
    if (ends_at_end(to(h), next3(h % 3), length, rest)) return Step::Found;
    const Real way = length_of(at.point.x - x, at.point.y);
    const SurfacePoint& first = leg_.points.front();
    const bool begins_here =
        leg_.points.size() == 1 && first.face == Mesh::face_of(h) && first.weights[previous3(h % 3)] == 0;
    const bool is_sure =
        x > kTooShort * length && rest > kTooShort * length && (begins_here || way > kTooShort * length);
    if (!is_sure || g == h || opposite_[g] != h) return Step::Lost;
    SurfacePoint crossing{Mesh::face_of(h), {0, 0, 0}};
    crossing.weights[next3(h % 3)] = x / length;
    crossing.weights[h % 3] = rest / length;
    if (!begins_here) leg_.points.push_back(crossing);
    leg_.length += way;
    const bool turned = from(g) == to(h);
    const double origin = origin_weight(ray_.kind);
    at = {g,
          {turned ? origin * length - at.source.x : at.source.x, -at.source.y},
          {turned ? rest : x, 0},
          at.mirrored != !turned};
    return Step::On;
  }

  // From a position on an edge of a face (the ray's pseudo-source above, beyond the face) to the edge through which it
  // leaves: the one to the left of the apex or the other.
  void leave(Position& at) const {
    const Frame frame = frame_at(at.halfedge);
    const double from_origin = origin_weight(ray_.kind);  // arrows from there to a point, and directions as they are
    const bool left = cross(frame.apex - at.point, at.source - from_origin * at.point) > 0;
    const Index h = left ? Mesh::previous(at.halfedge) : Mesh::next(at.halfedge);
    const Real side = left ? frame.left : frame.right;
    const Vec2 origin = left ? frame.apex : Vec2{frame.length, 0};
    const Vec2 end = left ? Vec2{0, 0} : frame.apex;
    const Vec2 u = (1 / side) * (end - origin);
    const auto turn = [&](Vec2 p) { return Vec2{dot(u, p - origin), cross(u, p - origin)}; };
    const Vec2 source = from_origin == 0 ? turn(at.source + origin) : turn(at.source);
    at = {h, source, turn(at.point), at.mirrored};
  }

  struct Corner {
    Index face, corner;
  };

  // Whether the ray goes through vertex v, as far as anyone can see from either end, and v's value says so as well;
  // `before` and `after`: the arrows from v to where the ray was and to its pseudo-source.
  bool ends_at_vertex(Index v, Corner at, Vec2 before, Vec2 after, Real miss) {
    const Real way = length_of(before.x, before.y);
    const bool is_far = ray_.kind == WindowKind::Linear;  // then only the way from here is known
    const Real nearer = is_far ? leg_.length + way : std::min(leg_.length + way, length_of(after.x, after.y));
    if (!(miss <= kThrough * nearer)) return false;
    if (!(value_of(v) < value_) || !(abs(value_of(v) + leg_.length + way - value_) <= room_)) return false;
    std::array<Real, 3> weights{0, 0, 0};
    weights[at.corner] = 1;
    leg_.vertex = v;
    finish(at.face, weights, way);
    return true;
  }

  bool finish(Index face, const std::array<Real, 3>& weights, Real way) {
    leg_.points.push_back({face, weights});
    leg_.length += way;
    return true;
  }

  // Whether the pseudo-source is in the face of the position's halfedge, where the ray says.
  bool ends_in_face(const Position& at) {
    const Index h = at.halfedge, face = Mesh::face_of(h), n = mesh_.vertex_count();
    const auto is_source = [&](const std::array<Real, 3>& weights) {
      const Vec2 p = in_frame(frame_at(h), h % 3, weights);
      const Real way = length_of(p.x - at.point.x, p.y - at.point.y);
      if (!(length_of(p.x - at.source.x, p.y - at.source.y) <= kMissed * way)) return false;
      return way > kTooShort * lengths_[h] && finish(face, weights, way);
    };
    if (ray_.pseudo_source < n) {
      if (!(start_ < value_)) return false;
      leg_.vertex = ray_.pseudo_source;
      for (Index i = 0; i < 3; ++i) {
        if (from(3 * face + i) != ray_.pseudo_source) continue;
        std::array<Real, 3> weights{0, 0, 0};
        weights[i] = 1;
        if (is_source(weights)) return true;
      }
      leg_.vertex = kNoIndex;
      return false;
    }
    const Index label = ray_.pseudo_source - n;
    const detail::LocatedSource& source = data_.sources[label];
    bool found = false;
    start_of_source_ = source.offset + data_.shift;
    if (source.curve) {
      for (const CurveInFace& c : data_.curves.in(face)) found = found || (c.source == label && ends_on(c, at));
    } else {
      for_each_face_around(mesh_, source.at,
                           [&](const FaceWeights& f) { found = found || (f.face == face && is_source(f.weights)); });
    }
    if (found) leg_.source = label;
    return found;
  }

  // Whether what is left of the ray is the straight way to a curve in this face: the values say so.
  bool ends_on(const CurveInFace& c, const Position& at) {
    const Frame frame = frame_at(at.halfedge);
    const LocatedCurve& curve = *data_.sources[c.source].curve;
    const Real base = data_.sources[c.source].offset + data_.shift;
    std::array<Real, 3> weights;
    Real start;
    if (c.segment == kNoIndex) {
      weights = place_in_face(mesh_, curve, c.place, c.face).weights;
      start = base + curve.places[c.place].offset;
    } else {
      const SegmentInFace segment = *segment_in_face(mesh_, curve, c.segment, c.face, base);
      const LineSource line = line_source_in(frame, at.halfedge % 3, segment);
      const Real t = line.sight_of(at.point).t;
      weights = weights_along(segment, t / line.length);
      start = line.sigma + line.slope * t;
    }
    const Vec2 way = in_frame(frame, at.halfedge % 3, weights) - at.point;
    const Real length = length_of(way.x, way.y);
    if (!(length > 0) || !(abs(start + leg_.length + length - value_) <= room_)) return false;
    start_of_source_ = start;
    ends_on_curve_ = true;
    return finish(c.face, weights, length);
  }

  const WindowFieldData& data_;
  const Mesh& mesh_;
  const std::span<const Face> faces_;
  const std::span<const double> lengths_;
  const std::span<const Index> opposite_;
  const Ray& ray_;
  const Real value_, room_;
  const Real start_;  // the pseudo-source's value, where that is a vertex
  const CrossingListener& knows_the_rest_;
  WindowField::Leg leg_;
  bool ends_on_curve_ = false;
  Real start_of_source_ = 0;  // where the leg begins, if that is at a source
};

}  // namespace

WindowField::Leg trace_leg(const WindowFieldData& data, const FaceWeights& at, const PointRecord& record,
                           const CrossingListener& knows_the_rest) {
  return Tracer(data, record, knows_the_rest).run(at);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
