// The last piece of every path, beside the segments where it ends.
#include <brushfire/queries/curve_sides.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/queries/detail/leaving_angles.h>
#include <brushfire/queries/straightest.h>
#include <brushfire/solvers/detail/walls.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace brushfire {
namespace {

// A path that ends this near (as a share of a segment) to where the segment ends, ends at the place.
constexpr double kAtPlace = 1e-9;

// Segments that are shorter than this share of their face's longest edge are rounding of their ends, and so is their
// direction: that of what comes behind counts.
constexpr double kNoDirection = 1e-12;

double longest_edge(const Mesh& mesh, Index f) {
  return std::max({mesh.length(3 * f), mesh.length(3 * f + 1), mesh.length(3 * f + 2)});
}

// The place towards which a curve leaves another one, forwards or backwards; kNoIndex: it ends there.
Index next_place(const Mesh& mesh, const LocatedCurve& curve, Index place, bool forwards) {
  Index at = place, first = kNoIndex;
  for (std::size_t steps = 0; steps < curve.segments.size(); ++steps) {
    const Index i = forwards ? curve.places[at].after : curve.places[at].before;
    if (i == kNoIndex) break;
    const CurveSegment& s = curve.segments[i];
    at = forwards ? s.to_place : s.from_place;
    if (first == kNoIndex) first = at;
    if (s.length > kNoDirection * longest_edge(mesh, s.face) * mesh.unit()) {
      return common_face(mesh, curve.places[place].at, curve.places[at].at) != kNoIndex ? at : first;
    }
  }
  return kNoIndex;
}

double wrapped(double angle, double turn) {
  const double a = std::fmod(angle, turn);
  return a < 0 ? a + turn : a;
}

// The directions in which the segments at one place of a curve leave it; it has several numbers where the curve comes
// there again.
class Star {
 public:
  Star(const Mesh& mesh, const LocatedCurve& curve, std::span<const Index> places)
      : angles_(mesh, point_of(curve.places[places.front()])),
        is_arc_(is_open(mesh, curve.places[places.front()])),
        // The sector outside of a boundary is some angle more.
        turn_(angles_.total() + (is_arc_ ? 1 : 0)),
        grows_left_(is_counter_clockwise(mesh, point_of(curve.places[places.front()]))) {
    for (const Index p : places) {
      add(mesh, curve, p, false);
      add(mesh, curve, p, true);
    }
  }

  // Of a path that comes from a point in a face at the place.
  CurveSide side_of(const SurfacePoint& from) const {
    if (arms_.empty()) return CurveSide::None;
    const double angle = angles_.towards(from);
    // Counter-clockwise from an arm to the path.
    const auto from_arm = [&](const Arm& a) { return grows_left_ ? angle - a.angle : a.angle - angle; };
    const auto behind = [&](const Arm& a) { return wrapped(from_arm(a), turn_); };
    if (arms_.size() == 1) {
      return is_in_first_half(from_arm(arms_[0])) == arms_[0].goes_out ? CurveSide::Left : CurveSide::Right;
    }
    const auto nearer = [&](const Arm& a, const Arm& b) { return behind(a) < behind(b); };
    return std::min_element(arms_.begin(), arms_.end(), nearer)->goes_out ? CurveSide::Left : CurveSide::Right;
  }

 private:
  struct Arm {
    double angle;
    bool goes_out;
  };

  // Of the two that an arm and the line straight on make of the directions. On an arc the latter may lie outside.
  bool is_in_first_half(double from_arm) const {
    if (is_arc_) return (from_arm >= 0) == (std::abs(from_arm) <= kPi);
    return wrapped(from_arm, turn_) <= 0.5 * turn_;
  }

  static SurfacePoint point_of(const CurvePlace& p) { return {p.at.face, p.at.weights}; }
  static bool is_open(const Mesh& mesh, const CurvePlace& p) {
    return p.at.on == PointLocation::On::Vertex && mesh.links()[p.at.vertex] == Link::Arc;
  }
  void add(const Mesh& mesh, const LocatedCurve& curve, Index place, bool goes_out) {
    const Index next = next_place(mesh, curve, place, goes_out);
    if (next != kNoIndex) arms_.push_back({angles_.towards(point_of(curve.places[next])), goes_out});
  }

  detail::LeavingAngles angles_;
  bool is_arc_;
  double turn_;
  bool grows_left_;
  std::vector<Arm> arms_;
};

// One curve, by the faces and vertices where paths may arrive at it.
class Shore {
 public:
  Shore(const Mesh& mesh, const CurveSource& curve) : mesh_(mesh), curve_(locate(mesh, curve)) {
    for (Index i = 0; i < curve_.segments.size(); ++i) {
      const CurveSegment& s = curve_.segments[i];
      for (const Index f : faces_at(mesh, curve_.places[s.from_place].at)) {
        if (s.along_edge ? ends_in(s, f).has_value() : f == s.face) segments_.emplace(f, i);
      }
    }
    for (Index i = 0; i < curve_.places.size(); ++i) {
      const PointLocation& at = curve_.places[i].at;
      if (at.on == PointLocation::On::Vertex) {
        at_vertex_[at.vertex].push_back(i);
      } else {
        for (const Index f : faces_at(mesh, at)) places_.emplace(f, i);
      }
    }
  }

  bool has_vertex(Index v) const { return at_vertex_.contains(v); }

  CurveArrival on_vertex(Index v) const { return at_place(at_vertex_.at(v).front()); }
  CurveArrival at_vertex(Index v, const SurfacePoint& from) {
    const std::vector<Index>& places = at_vertex_.at(v);
    CurveArrival arrival = at_place(places.front());
    arrival.side = star(places).side_of(from);
    return arrival;
  }

  // Of the straight way from a point to one on the curve, which share a face.
  CurveArrival at_point(const SurfacePoint& end, const SurfacePoint& from) {
    const PointLocation there = locate(mesh_, end, 0), before = locate(mesh_, from, 0);
    double least = kInfinity;
    Found found;
    for (const Index f : faces_at(mesh_, there)) {
      if (!weights_in(mesh_, before, f)) continue;
      const auto segments = segments_.equal_range(f);
      for (auto s = segments.first; s != segments.second; ++s) look_at_segment(s->second, f, there, least, found);
      const auto places = places_.equal_range(f);
      for (auto p = places.first; p != places.second; ++p) look_at_place(p->second, f, there, least, found);
    }
    return found.place != kNoIndex ? beside_place(found.place, from) : beside_segment(found, before);
  }

 private:
  using Ends = std::pair<std::array<double, 3>, std::array<double, 3>>;

  std::optional<Ends> ends_in(const CurveSegment& s, Index face) const {
    if (face == s.face) return Ends{s.from, s.to};
    const auto from = weights_in(mesh_, curve_.places[s.from_place].at, face);
    const auto to = weights_in(mesh_, curve_.places[s.to_place].at, face);
    if (!from || !to) return std::nullopt;
    return Ends{*from, *to};
  }

  // A place by its number, or by that of the segment that ends there where none begins.
  CurveArrival at_place(Index i) const {
    CurveArrival arrival;
    const CurvePlace& place = curve_.places[i];
    arrival.place = place.number;
    if (place.after == kNoIndex && place.before != kNoIndex) {
      arrival.place = curve_.places[curve_.segments[place.before].from_place].number;
      arrival.share = 1;
    }
    return arrival;
  }

  const Star& star(std::vector<Index> places) {
    std::unique_ptr<Star>& known = stars_[places.front()];
    if (!known) known = std::make_unique<Star>(mesh_, curve_, places);
    return *known;
  }

  // All that lie where one does, which is not a vertex: a curve may come there again, or be in pieces.
  std::vector<Index> places_with(Index place) const {
    const PointLocation& at = curve_.places[place].at;
    const double near = kNoDirection * longest_edge(mesh_, at.face);
    std::vector<Index> found;
    const auto [first, last] = places_.equal_range(at.face);
    for (auto p = first; p != last; ++p) {
      const PointLocation& other = curve_.places[p->second].at;
      if (other.on == at.on && distance_within(mesh_, at.face, at, other) <= near) found.push_back(p->second);
    }
    detail::sort(found.begin(), found.end());
    return found;
  }

  // What a path ends at: a place, or a segment in a face, and where on it.
  struct Found {
    Index place = kNoIndex, segment = kNoIndex, face = kNoIndex;
    double share = 0;
  };

  void look_at_segment(Index i, Index face, const PointLocation& end, double& least, Found& found) const {
    const CurveSegment& s = curve_.segments[i];
    const auto ends = ends_in(s, face);
    const std::array<Vec2, 3> corners = flat_corners(mesh_, face);
    const Vec2 along = flat_difference(corners, ends->first, ends->second);
    const Vec2 way = flat_difference(corners, ends->first, *weights_in(mesh_, end, face));
    const double share = std::clamp(dot(way, along) / dot(along, along), 0.0, 1.0);
    const double away = norm(way - share * along);
    if (!(away < least)) return;
    least = away;
    const bool has_direction = norm(along) > kNoDirection * longest_edge(mesh_, face);
    const bool at_place = share <= kAtPlace || share >= 1 - kAtPlace || !has_direction;
    found = {at_place ? share < 0.5 ? s.from_place : s.to_place : kNoIndex, i, face, share};
  }

  // Light of a place may be in faces that none of its segments is in.
  void look_at_place(Index i, Index face, const PointLocation& end, double& least, Found& found) const {
    const double away = distance_within(mesh_, face, curve_.places[i].at, end);
    if (!(away < least)) return;
    least = away;
    found = {i, kNoIndex, face, 0};
  }

  CurveArrival beside_place(Index place, const SurfacePoint& from) {
    const PointLocation& at = curve_.places[place].at;
    if (at.on == PointLocation::On::Vertex) return at_vertex(at.vertex, from);
    CurveArrival arrival = at_place(place);
    arrival.side = star(places_with(place)).side_of(from);
    return arrival;
  }

  CurveArrival beside_segment(const Found& found, const PointLocation& from) const {
    CurveArrival arrival;
    if (found.segment == kNoIndex) return arrival;
    const CurveSegment& s = curve_.segments[found.segment];
    const auto ends = ends_in(s, found.face);
    const std::array<Vec2, 3> corners = flat_corners(mesh_, found.face);
    const Vec2 along = flat_difference(corners, ends->first, ends->second);
    const Vec2 to_from = flat_difference(corners, ends->first, *weights_in(mesh_, from, found.face));
    const double turn = cross(along, to_from);
    arrival.place = curve_.places[s.from_place].number;
    arrival.share = found.share;
    arrival.side = turn > 0 ? CurveSide::Left : turn < 0 ? CurveSide::Right : CurveSide::None;
    return arrival;
  }

  const Mesh& mesh_;
  LocatedCurve curve_;
  std::unordered_multimap<Index, Index> segments_, places_;  // by face
  std::unordered_map<Index, std::vector<Index>> at_vertex_;
  std::map<Index, std::unique_ptr<Star>> stars_;  // by the first of their places
};

// What a run's sources are in the caller's list.
using Origin = std::function<Index(Index)>;

// Legs are those of the open mesh; sides are told on the whole one, where walls part no curve.
class Arrivals {
 public:
  Arrivals(const Domain& domain, const WindowField& field, std::span<const Source> sources, Origin origin)
      : field_(field), domain_(domain), origin_(std::move(origin)) {
    for (const Source& s : sources) {
      shores_.push_back(s.curve ? std::make_unique<Shore>(domain.mesh(), *s.curve) : nullptr);
    }
    known_.assign(domain.open().vertex_count(), false);
    result_.resize(known_.size());
  }

  // Of every vertex of the open mesh.
  std::vector<CurveArrival> operator()() {
    Poll poll(256);
    for (Index v = 0; v < result_.size(); ++v) {
      poll();
      find(v);
    }
    return std::move(result_);
  }

 private:
  // From leg to leg, and back with what the last one says.
  void find(Index v) {
    chain_.clear();
    CurveArrival arrival;
    while (true) {
      if (known_[v]) {
        arrival = result_[v];
        break;
      }
      chain_.push_back(v);
      WindowField::Leg leg = field_.last_leg(v);
      if (leg.points.empty()) break;  // unreachable
      domain_.to_mesh(leg.points);
      if (ends(v, leg, arrival)) break;
      v = leg.vertex;
    }
    for (const Index u : chain_) {
      known_[u] = true;
      result_[u] = arrival;
    }
  }

  // Whether the leg of v begins on a curve or at a point.
  bool ends(Index v, const WindowField::Leg& leg, CurveArrival& arrival) {
    const Index source = leg.source != kNoIndex ? origin_(leg.source) : source_at(leg.vertex);
    if (source == kNoIndex) return false;
    if (Shore* const shore = shores_[source].get()) {
      if (leg.points.size() < 2) {
        arrival = shore->has_vertex(domain_.vertex(v)) ? shore->on_vertex(domain_.vertex(v)) : CurveArrival{};
      } else if (leg.vertex != kNoIndex) {
        arrival = shore->at_vertex(domain_.vertex(leg.vertex), leg.points[leg.points.size() - 2]);
      } else {
        arrival = shore->at_point(leg.points.back(), leg.points[leg.points.size() - 2]);
      }
    }
    arrival.source = source;
    return true;
  }

  // The source that a vertex is a place of, as its own leg says; kNoIndex: none.
  Index source_at(Index vertex) const {
    const bool is_place = std::any_of(shores_.begin(), shores_.end(), [&](const auto& shore) {
      return shore && shore->has_vertex(domain_.vertex(vertex));
    });
    if (!is_place) return kNoIndex;
    const WindowField::Leg own = field_.last_leg(vertex);
    return own.points.size() == 1 && own.source != kNoIndex ? origin_(own.source) : kNoIndex;
  }

  const WindowField& field_;
  const Domain& domain_;
  Origin origin_;
  std::vector<std::unique_ptr<Shore>> shores_;
  std::vector<char> known_;
  std::vector<Index> chain_;
  std::vector<CurveArrival> result_;
};

// Of the sides of each vertex the nearest; of those that are equally near the one of the lowest source, and not the
// left.
std::vector<CurveArrival> nearest_side(const Domain& domain, std::span<const double> distance,
                                       std::vector<CurveArrival> on_open) {
  const Index count = domain.mesh().vertex_count();
  const auto rank = [&](Index v) {
    return std::tuple(distance[v], on_open[v].source, on_open[v].side == CurveSide::Left);
  };
  std::vector<Index> best(count);
  std::iota(best.begin(), best.end(), 0u);
  for (Index v = count; v < on_open.size(); ++v) {
    Index& b = best[domain.vertex(v)];
    if (rank(v) < rank(b)) b = v;
  }
  std::vector<CurveArrival> result;
  for (const Index b : best) result.push_back(on_open[b]);
  return result;
}

}  // namespace

std::vector<CurveArrival> arrivals(const WindowField& field, std::span<const Source> sources) {
  return Arrivals(field.mesh(), field, sources, [](Index source) { return source; })();
}

std::vector<CurveArrival> arrivals(const Domain& domain, const DistanceField& field, std::span<const Source> sources) {
  if (!field.windows) throw Error(ErrorCode::InvalidArgument, "arrivals need the paths of the field: keep_paths");
  if (!domain.has_walls()) return arrivals(*field.windows, sources);
  const detail::WalledRun run(domain, sources, {});
  Arrivals on_open(domain, *field.windows, sources, [&](Index source) { return run.origin(source); });
  return nearest_side(domain, field.side_distance, on_open());
}

}  // namespace brushfire
