// The last piece of every path, beside the segments where it ends.
#include <brushfire/queries/curve_sides.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/queries/detail/curve_star.h>
#include <brushfire/queries/detail/retraced_segments.h>
#include <brushfire/solvers/detail/walls.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace brushfire {
namespace {

// A path that ends this near (as a share of a segment) to where the segment ends, ends at the place.
constexpr double kAtPlace = 1e-9;

using detail::CurveStar;
using detail::kNoDirection;
using detail::longest_edge;
using detail::point_of;

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
    retraced_ = detail::retraced_segments(mesh, curve_, segments_);
    if (std::find(retraced_.begin(), retraced_.end(), true) != retraced_.end()) part_beside_retraced();
  }

  bool has_vertex(Index v) const { return at_vertex_.contains(v); }

  CurveArrival on_vertex(Index v) const { return at_place(at_vertex_.at(v).front()); }
  CurveArrival at_vertex(Index v, const SurfacePoint& from) {
    const std::vector<Index>& places = at_vertex_.at(v);
    CurveArrival arrival = at_place(places.front());
    arrival.side = side_at(places, from);
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

  // What leaves a place, as far as it is seen from a point that shares a face with it.
  const CurveStar& star(const std::vector<Index>& places, const SurfacePoint& from) {
    const PointLocation& at = curve_.places[places.front()].at;
    return star_in(places, is_in_several_fans(at) ? common_face(mesh_, at, locate(mesh_, from, 0)) : kNoIndex);
  }
  const CurveStar& star_in(const std::vector<Index>& places, Index fan) {
    std::unique_ptr<CurveStar>& known = stars_[{places.front(), fan}];
    if (!known) known = std::make_unique<CurveStar>(mesh_, curve_, places, retraced_, fan);
    return *known;
  }

  bool is_in_several_fans(const PointLocation& at) const {
    return at.on == PointLocation::On::Vertex && mesh_.links()[at.vertex] == Link::Other;
  }

  CurveSide side_at(const std::vector<Index>& places, const SurfacePoint& from) {
    const CurveStar& here = star(places, from);
    if (!here.is_empty()) return here.side_of(from);
    const std::vector<std::pair<Index, Index>> passing = retraced_at(places);
    if (!passing.empty()) return retraced_side_[passing.front().first];
    const PointLocation& at = curve_.places[places.front()].at;
    return is_in_several_fans(at) ? side_beyond_borders(places, at.vertex, here) : CurveSide::None;
  }

  // Of a fan that the curve does not enter: that of its borders in the fans behind them, and so on.
  CurveSide side_beyond_borders(const std::vector<Index>& places, Index vertex, const CurveStar& fan) {
    const std::vector<Index> faces = faces_at(mesh_, curve_.places[places.front()].at);
    std::vector<Index> ends = fan.borders();
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const SurfacePoint border = vertex_point(mesh_, ends[i]);
      for (const Index f : faces) {
        if (!mesh_.is_face_usable(f) || !weights_in(mesh_, locate(mesh_, border), f)) continue;
        const CurveStar& other = star_in(places, f);
        if (!other.is_empty()) return other.side_of(border);
        for (const Index end : other.borders()) {
          if (std::find(ends.begin(), ends.end(), end) == ends.end()) ends.push_back(end);
        }
      }
    }
    throw Error(ErrorCode::InvalidArgument,
                "sides: the faces at vertex " + std::to_string(vertex) +
                    " form several fans, and a path arrives in one that the curve does not enter: lead it past there");
  }

  // Segments, and their other ends.
  std::vector<std::pair<Index, Index>> retraced_at(const std::vector<Index>& places) const {
    std::vector<std::pair<Index, Index>> found;
    for (const Index p : places) {
      const Index before = curve_.places[p].before, after = curve_.places[p].after;
      if (before != kNoIndex && retraced_[before]) found.emplace_back(before, curve_.segments[before].from_place);
      if (after != kNoIndex && retraced_[after]) found.emplace_back(after, curve_.segments[after].to_place);
    }
    return found;
  }

  // At a place, seen from the other end of a segment that leaves it.
  const CurveStar& star_before(Index place, Index end) { return star(places_at(place), point_of(curve_.places[end])); }

  // Retraced segments lie on the side of what their ends' other segments part; so do those that follow them as far as
  // there are no others.
  void part_beside_retraced() {
    retraced_side_.assign(retraced_.size(), CurveSide::None);
    std::vector<Index> parted;
    const auto part = [&](Index i, CurveSide side) {
      if (retraced_side_[i] != CurveSide::None || side == CurveSide::None) return;
      retraced_side_[i] = side;
      parted.push_back(i);
    };
    for (Index i = 0; i < retraced_.size(); ++i) {
      if (!retraced_[i]) continue;
      const Index from = curve_.segments[i].from_place, to = curve_.segments[i].to_place;
      part(i, star_before(from, to).side_of(point_of(curve_.places[to])));
      part(i, star_before(to, from).side_of(point_of(curve_.places[from])));
    }
    while (!parted.empty()) {
      const Index i = parted.back();
      parted.pop_back();
      for (const Index p : {curve_.segments[i].from_place, curve_.segments[i].to_place}) {
        for (const auto& [other, end] : retraced_at(places_at(p))) {
          if (star_before(p, end).is_empty()) part(other, retraced_side_[i]);
        }
      }
    }
  }

  // All that lie where one does: a curve may come there again, or be in pieces.
  std::vector<Index> places_at(Index place) const {
    const PointLocation& at = curve_.places[place].at;
    if (at.on == PointLocation::On::Vertex) return at_vertex_.at(at.vertex);
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
    arrival.side = side_at(places_at(place), from);
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
    if (retraced_[found.segment])
      arrival.side = retraced_side_[found.segment];
    else
      arrival.side = turn > 0 ? CurveSide::Left : turn < 0 ? CurveSide::Right : CurveSide::None;
    return arrival;
  }

  const Mesh& mesh_;
  LocatedCurve curve_;
  detail::SegmentsByFace segments_;
  std::unordered_multimap<Index, Index> places_;  // by face, those that are not vertices
  std::unordered_map<Index, std::vector<Index>> at_vertex_;
  std::vector<bool> retraced_;                                           // of segments
  std::vector<CurveSide> retraced_side_;                                 // of those; empty where there are none
  std::map<std::pair<Index, Index>, std::unique_ptr<CurveStar>> stars_;  // by the first of their places
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
