// Every sleeve is straightened, then vertices are gone round on the shorter side.
#include <brushfire/queries/shorten.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/queries/detail/closed_sleeve.h>
#include <brushfire/queries/detail/way_around.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace brushfire {
namespace {

using detail::DoubleDouble;
using detail::FrameCache;
using detail::Sleeve;
using detail::Step;
using detail::StraightPiece;
using On = PointLocation::On;

// From points to sleeves between vertices: points within faces and edges only tell which faces are crossed.
class SleeveBuilder {
 public:
  SleeveBuilder(const Mesh& mesh, const PointLocation& begin) : mesh_(mesh) { sleeve_.begin = begin; }

  void enter(const PointLocation& at, Index face) {
    if (sleeve_.first_face == kNoIndex) {
      sleeve_.first_face = face;
    } else if (at.on == On::Vertex) {
      finish(at);
      sleeve_.begin = at;
      sleeve_.first_face = face;
    } else if (face != sleeve_.last_face()) {
      const Index out = detail::halfedge_in(mesh_, at.halfedge, sleeve_.last_face());
      sleeve_.steps.push_back({out, detail::halfedge_in(mesh_, at.halfedge, face)});
    }
  }
  void finish(const PointLocation& at) {
    sleeve_.end = at;
    sleeves_.push_back(std::move(sleeve_));
    sleeve_ = {};
  }
  std::vector<Sleeve> take() { return std::move(sleeves_); }

 private:
  const Mesh& mesh_;
  Sleeve sleeve_;
  std::vector<Sleeve> sleeves_;
};

std::vector<Sleeve> sleeves_of(const Mesh& mesh, const std::vector<PointLocation>& at) {
  SleeveBuilder builder(mesh, at.front());
  Index face = kNoIndex;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    face = common_face(mesh, at[i], at[i + 1], face);
    if (face == kNoIndex) {
      throw Error(ErrorCode::InvalidArgument,
                  "points " + std::to_string(i) + " and " + std::to_string(i + 1) + " of a path share no face");
    }
    builder.enter(at[i], face);
  }
  builder.finish(at.back());
  return builder.take();
}

bool same_vertex(const PointLocation& a, const PointLocation& b) {
  return a.on == On::Vertex && b.on == On::Vertex && a.vertex == b.vertex;
}

DoubleDouble total_length(const std::vector<StraightPiece>& pieces) {
  DoubleDouble sum;
  for (const StraightPiece& p : pieces) sum = sum + p.length;
  return sum;
}

// A path as a chain of straight pieces, closed into a ring or not, and the corners that it can be shortened at, those
// of the smallest angles first.
class Shortener {
 public:
  Shortener(const Mesh& mesh, FrameCache& frames, bool closed) : mesh_(mesh), frames_(frames), closed_(closed) {}

  std::vector<StraightPiece> run(const std::vector<Sleeve>& sleeves) {
    std::vector<StraightPiece> pieces;
    for (const Sleeve& sleeve : sleeves) {
      for (StraightPiece& p : straight(sleeve)) pieces.push_back(std::move(p));
    }
    if (closed_) pieces = detail::without_free_end(mesh_, std::move(pieces), frames_);
    insert(kNone, std::move(pieces), kNone);
    while (!corners_.empty()) {
      stop_if_cancelled();
      std::pop_heap(corners_.begin(), corners_.end());
      const Corner corner = std::move(corners_.back());
      corners_.pop_back();
      if (!nodes_[corner.before].gone && !nodes_[corner.after].gone) go_round(corner);
    }
    return remaining();
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  struct Node {
    StraightPiece piece;
    std::size_t before = kNone, after = kNone;
    bool gone = false;
  };
  struct Corner {
    std::size_t before, after;  // the pieces that meet here
    detail::WayAround way;      // on its shorter side
    bool operator<(const Corner& other) const {
      return std::tie(other.way.angle, other.before) < std::tie(way.angle, before);
    }
  };

  std::vector<StraightPiece> straight(const Sleeve& sleeve) {
    stop_if_cancelled();
    std::vector<StraightPiece> pieces = detail::shortest_in_sleeve(mesh_, sleeve, frames_);
    // From a vertex to itself without leaving its faces: nothing.
    std::erase_if(pieces, [](const StraightPiece& p) {
      return p.length.high == 0 && p.sleeve.steps.empty() && same_vertex(p.sleeve.begin, p.sleeve.end);
    });
    return pieces;
  }

  void go_round(const Corner& corner) {
    const StraightPiece &a = nodes_[corner.before].piece, &b = nodes_[corner.after].piece;
    const bool whole = corner.before == corner.after;  // a closed curve that hangs on this vertex only and leaves it
    std::vector<StraightPiece> pieces =
        whole ? free_ring(a.sleeve, corner.way.steps) : straight(detail::joined(a.sleeve, corner.way.steps, b.sleeve));
    // Going round shortens; less than rounding means that the rest is rounding: of 106 bits, so that the smallest
    // corner counts, or, where a closed curve is cut at a point whose place is a double, of 53.
    const double progress = whole ? 4 * std::numeric_limits<double>::epsilon() : 1e-28;
    const DoubleDouble before = whole ? a.length : a.length + b.length;
    if (!(total_length(pieces) < before * (DoubleDouble(1) - DoubleDouble(progress)))) return;
    const bool last_two = nodes_[corner.after].after == corner.before;
    std::size_t from = nodes_[corner.before].before, to = nodes_[corner.after].after;
    if (whole || last_two) from = to = kNone;
    for (const std::size_t i : {corner.before, corner.after}) nodes_[i] = {{}, kNone, kNone, true};
    insert(from, std::move(pieces), to);
  }

  std::vector<StraightPiece> free_ring(const Sleeve& sleeve, const std::vector<Step>& way) {
    std::vector<Step> ring = sleeve.steps;
    ring.insert(ring.end(), way.begin(), way.end());
    return detail::shortest_in_ring(mesh_, std::move(ring), frames_);
  }

  // Links pieces in between two others; where there are none (kNone), they are the whole path.
  void insert(std::size_t from, std::vector<StraightPiece> pieces, std::size_t to) {
    const bool all = from == kNone && to == kNone;
    const std::size_t begin = nodes_.size(), end = begin + pieces.size();
    for (StraightPiece& p : pieces) nodes_.push_back({std::move(p), kNone, kNone, false});
    std::size_t previous = from;
    for (std::size_t i = begin; i < end; ++i) previous = link(previous, i);
    if (!all) {
      link(previous, to);
    } else if (closed_ && begin < end) {
      link(previous, begin);
    }
  }

  std::size_t link(std::size_t a, std::size_t b) {
    if (a != kNone) nodes_[a].after = b;
    if (b != kNone) nodes_[b].before = a;
    if (a != kNone && b != kNone) {
      if (auto way = shorter_way(nodes_[a].piece, nodes_[b].piece)) {
        corners_.push_back({a, b, *std::move(way)});
        std::push_heap(corners_.begin(), corners_.end());
      }
    }
    return b;
  }

  // Around the vertex between two pieces, where the angle there is less than pi.
  std::optional<detail::WayAround> shorter_way(const StraightPiece& a, const StraightPiece& b) const {
    if (!same_vertex(a.sleeve.end, b.sleeve.begin)) return std::nullopt;
    if (a.length.high == 0 || b.length.high == 0) return std::nullopt;  // no direction, so no angle
    detail::WayAround way = detail::shortest_way_around(mesh_, a.sleeve.end.vertex, detail::direction_at_end(mesh_, a),
                                                        detail::direction_at_begin(mesh_, b));
    if (!(way.angle < kPi - detail::kStraightAngle)) return std::nullopt;
    return way;
  }

  std::vector<StraightPiece> remaining() {
    std::vector<StraightPiece> pieces;
    const auto is_first = [&](const Node& n) { return !n.gone && (closed_ || n.before == kNone); };
    const auto first = std::find_if(nodes_.begin(), nodes_.end(), is_first);
    if (first == nodes_.end()) return pieces;
    const auto begin = static_cast<std::size_t>(first - nodes_.begin());
    std::size_t i = begin;
    do {
      pieces.push_back(std::move(nodes_[i].piece));
      i = nodes_[i].after;
    } while (i != kNone && i != begin);
    return pieces;
  }

  const Mesh& mesh_;
  FrameCache& frames_;
  bool closed_;
  std::vector<Node> nodes_;
  std::vector<Corner> corners_;  // a heap
};

}  // namespace

SurfacePath shorten(const Mesh& mesh, std::span<const SurfacePoint> points, bool closed) {
  if (points.empty()) throw Error(ErrorCode::InvalidArgument, "a path needs at least one point");
  std::vector<PointLocation> at;
  for (const SurfacePoint& p : points) at.push_back(locate(mesh, p, 0));
  if (closed) {
    // A vertex to begin at, where there is one: it holds the curve until it is shown not to.
    const auto vertex = std::find_if(at.begin(), at.end(), [](const PointLocation& p) { return p.on == On::Vertex; });
    if (vertex != at.end()) std::rotate(at.begin(), vertex, at.end());
    at.push_back(at.front());
  }
  SurfacePath path;
  path.closed = closed;
  std::vector<StraightPiece> pieces;
  FrameCache frames(mesh);
  if (at.size() > 1) pieces = Shortener(mesh, frames, closed).run(sleeves_of(mesh, at));
  for (const StraightPiece& p : pieces) detail::append_points(mesh, p, frames, path.points);
  if (path.points.empty()) path.points.push_back({at.front().face, at.front().weights});
  if (closed && path.points.size() > 1) path.points.pop_back();  // the first one again
  path.length = total_length(pieces).high * mesh.unit();
  return path;
}

namespace {

// One side of every point, so that consecutive ones share a face of the open mesh; empty where there are none such.
// `start`: the side of the first.
std::vector<SurfacePoint> sides_from(const Mesh& open, const std::vector<std::vector<SurfacePoint>>& sides,
                                     std::size_t start, bool closed) {
  constexpr std::size_t kNone = ~std::size_t{0};
  const auto share_face = [&](const SurfacePoint& a, const SurfacePoint& b) {
    return common_face(open, locate(open, a, 0), locate(open, b, 0)) != kNoIndex;
  };
  // before[i][s]: from which side of point i - 1 side s of point i is reached.
  std::vector<std::vector<std::size_t>> before{std::vector<std::size_t>(sides[0].size(), kNone)};
  before[0][start] = start;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    std::vector<std::size_t>& here = before.emplace_back(sides[i].size(), kNone);
    for (std::size_t s = 0; s < here.size(); ++s) {
      for (std::size_t p = 0; p < before[i - 1].size() && here[s] == kNone; ++p) {
        if (before[i - 1][p] != kNone && share_face(sides[i - 1][p], sides[i][s])) here[s] = p;
      }
    }
  }
  for (std::size_t s = 0; s < before.back().size(); ++s) {
    if (before.back()[s] == kNone || (closed && !share_face(sides.back()[s], sides[0][start]))) continue;
    std::vector<SurfacePoint> line(sides.size());
    for (std::size_t i = sides.size(), at = s; i-- > 0; at = before[i][at]) line[i] = sides[i][at];
    return line;
  }
  return {};
}

std::vector<SurfacePoint> on_open(const Domain& domain, std::span<const SurfacePoint> points, bool closed) {
  std::vector<std::vector<SurfacePoint>> sides;
  for (const SurfacePoint& p : points) sides.push_back(domain.on_open(p));
  for (std::size_t start = 0; !sides.empty() && start < sides[0].size(); ++start) {
    std::vector<SurfacePoint> line = sides_from(domain.open(), sides, start, closed);
    if (!line.empty()) return line;
  }
  throw Error(ErrorCode::InvalidArgument, "the polyline goes through a wall");
}

}  // namespace

SurfacePath shorten(const Domain& domain, std::span<const SurfacePoint> points, bool closed) {
  if (!domain.has_walls()) return shorten(domain.mesh(), points, closed);
  length_of(domain.mesh(), points, closed);  // throws where it is no polyline at all
  SurfacePath path = shorten(domain.open(), on_open(domain, points, closed), closed);
  domain.to_mesh(path.points);
  return path;
}

}  // namespace brushfire
