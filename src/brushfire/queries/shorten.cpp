// Rounds of "straighten every sleeve, go round vertices on the shorter side".
#include <brushfire/queries/shorten.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/queries/detail/sleeve.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace brushfire {
namespace {

using detail::Sleeve;
using detail::Step;
using detail::StraightPiece;
using On = PointLocation::On;

// The halfedge of face f over the same edge as h.
Index halfedge_in(const Mesh& mesh, Index h, Index f) {
  Index g = h;
  while (Mesh::face_of(g) != f) {
    g = mesh.opposite()[g];
    if (g == h) return kNoIndex;
  }
  return g;
}

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
      const Index out = halfedge_in(mesh_, at.halfedge, sleeve_.last_face());
      sleeve_.steps.push_back({out, halfedge_in(mesh_, at.halfedge, face)});
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

detail::DoubleDouble total_length(const std::vector<StraightPiece>& pieces) {
  detail::DoubleDouble sum;
  for (const StraightPiece& p : pieces) sum = sum + p.length;
  return sum;
}

// Two sleeves that meet, joined by the steps between them.
Sleeve joined(const Sleeve& a, const std::vector<Step>& between, const Sleeve& b) {
  Sleeve sleeve = a;
  sleeve.end = b.end;
  sleeve.steps.insert(sleeve.steps.end(), between.begin(), between.end());
  sleeve.steps.insert(sleeve.steps.end(), b.steps.begin(), b.steps.end());
  return sleeve;
}

class Shortener {
 public:
  Shortener(const Mesh& mesh, bool closed) : mesh_(mesh), closed_(closed) {}

  std::vector<StraightPiece> run(const std::vector<Sleeve>& sleeves) {
    std::vector<StraightPiece> best = straighten(sleeves);
    if (closed_) best = without_free_corner(std::move(best));
    while (true) {
      auto [next, changed] = go_round_vertices(best);
      if (!changed) return best;
      std::vector<StraightPiece> shorter = straighten(next);
      if (closed_) shorter = without_free_corner(std::move(shorter));
      // Every round replaces corners by shorter ways; less than rounding means that the rest is rounding: of 106 bits,
      // so that the smallest corner counts, or, where a closed curve is cut at a point that is known to half the digits
      // of a double, of 53.
      const double progress = closed_ ? 4 * std::numeric_limits<double>::epsilon() : 1e-28;
      if (!(total_length(shorter) < total_length(best) * (detail::DoubleDouble(1) - detail::DoubleDouble(progress))))
        return best;
      best = std::move(shorter);
    }
  }

 private:
  std::vector<StraightPiece> straighten(const std::vector<Sleeve>& sleeves) const {
    std::vector<StraightPiece> pieces;
    for (const Sleeve& sleeve : sleeves) {
      stop_if_cancelled();
      for (StraightPiece& p : detail::shortest_in_sleeve(mesh_, sleeve)) {
        // From a vertex to itself without leaving its faces: nothing.
        if (p.length.high == 0 && p.sleeve.steps.empty() && same_vertex(p.sleeve.begin, p.sleeve.end)) continue;
        pieces.push_back(std::move(p));
      }
    }
    return pieces;
  }

  // One round: vertices between two pieces are passed on their shortest side, those of the smallest angles first and no
  // piece twice.
  std::pair<std::vector<Sleeve>, bool> go_round_vertices(const std::vector<StraightPiece>& pieces) const {
    std::vector<std::optional<detail::WayAround>> ways = chosen_ways(pieces);
    std::vector<Sleeve> sleeves;
    bool changed = false;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (ways[i]) {
        sleeves.push_back(joined(pieces[i].sleeve, ways[i]->steps, pieces[i + 1].sleeve));
        changed = true;
        ++i;
      } else {
        sleeves.push_back(pieces[i].sleeve);
      }
    }
    if (closed_ && !changed && !pieces.empty()) {
      // The corner where the list closes; it is looked at last, so that no piece is used twice.
      if (const auto way = shorter_way(pieces.back(), pieces.front())) {
        const bool single = pieces.size() == 1;
        // It crosses nothing, as along the edges of a face that names a vertex twice: it pulls together.
        if (single && pieces.front().sleeve.steps.empty() && way->steps.empty()) return {{}, true};
        Sleeve sleeve = single ? rotated(pieces.front().sleeve, way->steps)
                               : joined(pieces.back().sleeve, way->steps, pieces.front().sleeve);
        sleeves.erase(sleeves.begin());
        if (!single) sleeves.pop_back();
        sleeves.push_back(std::move(sleeve));
        changed = true;
      }
    }
    return {std::move(sleeves), changed};
  }

  // Of each piece the way around the vertex at its end that is to be taken in this round.
  std::vector<std::optional<detail::WayAround>> chosen_ways(const std::vector<StraightPiece>& pieces) const {
    std::vector<std::optional<detail::WayAround>> ways(pieces.size());
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
      ways[i] = shorter_way(pieces[i], pieces[i + 1]);
      if (ways[i]) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return ways[a]->angle < ways[b]->angle; });
    std::vector<bool> used(pieces.size(), false);
    for (const std::size_t i : order) {
      if (used[i] || used[i + 1]) {
        ways[i].reset();
      } else {
        used[i] = used[i + 1] = true;
      }
    }
    return ways;
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

  // A closed curve that hangs on one vertex only and leaves it: it is cut open on an edge instead.
  Sleeve rotated(const Sleeve& sleeve, const std::vector<Step>& way) const {
    std::vector<Step> cycle = sleeve.steps;
    cycle.insert(cycle.end(), way.begin(), way.end());
    return cut_open(cycle, 0.5);
  }

  // The cyclic sleeve `cycle`, cut at its first edge, from the point at share t of that edge to the same point.
  Sleeve cut_open(const std::vector<Step>& cycle, double t) const {
    Sleeve sleeve;
    sleeve.begin = on_halfedge(cycle.front().in, along_in(cycle.front(), t));
    sleeve.end = on_halfedge(cycle.front().out, t);
    sleeve.first_face = Mesh::face_of(cycle.front().in);
    sleeve.steps.assign(cycle.begin() + 1, cycle.end());
    return sleeve;
  }

  double along_in(const Step& step, double t) const { return mesh_.from(step.in) == mesh_.from(step.out) ? t : 1 - t; }

  PointLocation on_halfedge(Index h, double t) const {
    SurfacePoint p{Mesh::face_of(h), {0, 0, 0}};
    p.weights[h % 3] = 1 - t;
    p.weights[Mesh::next(h) % 3] = t;
    return locate(mesh_, p);
  }

  // A closed curve begins and ends somewhere, and nothing holds it there unless that is a vertex.
  std::vector<StraightPiece> without_free_corner(std::vector<StraightPiece> pieces) const {
    for (int guard = 0; !pieces.empty() && pieces.front().sleeve.begin.on != On::Vertex; ++guard) {
      if (pieces.size() > 1) {
        // Some piece ends at a vertex: let the list begin there.
        const StraightPiece& last = pieces.back();
        std::vector<Sleeve> sleeves;
        for (std::size_t i = 1; i + 1 < pieces.size(); ++i) sleeves.push_back(pieces[i].sleeve);
        sleeves.push_back(joined(last.sleeve, bridge(last.sleeve, pieces.front().sleeve), pieces.front().sleeve));
        return straighten(sleeves);
      }
      std::vector<Step> cycle = pieces.front().sleeve.steps;
      const std::vector<Step> closing = bridge(pieces.front().sleeve, pieces.front().sleeve);
      cycle.insert(cycle.end(), closing.begin(), closing.end());
      reduce(cycle);
      if (cycle.empty()) return {};  // all in one face: it pulls together
      const Sleeve sleeve = cut_open(cycle, best_cut(cycle));
      pieces = straighten({sleeve});
      const bool at_vertex = sleeve.begin.on == On::Vertex;
      if (at_vertex || pieces.size() <= 1 || guard > 2) return pieces;
    }
    return pieces;
  }

  // From the last face of a into the first of b, which hold the same point: nothing, or over the edge it lies on.
  std::vector<Step> bridge(const Sleeve& a, const Sleeve& b) const {
    const Index from = a.last_face(), to = b.first_face;
    if (from == to || a.end.on != On::Edge) return {};
    return {{halfedge_in(mesh_, a.end.halfedge, from), halfedge_in(mesh_, a.end.halfedge, to)}};
  }

  // Cancels steps over an edge and back, around the cycle.
  void reduce(std::vector<Step>& cycle) const {
    bool again = true;
    while (again && !cycle.empty()) {
      stop_if_cancelled();
      again = false;
      for (std::size_t i = 0; i < cycle.size(); ++i) {
        const std::size_t j = (i + 1) % cycle.size();
        if (i == j || cycle[i].in != cycle[j].out) continue;
        if (cycle[i].out == cycle[j].in) {
          cycle.erase(cycle.begin() + static_cast<std::ptrdiff_t>(std::max(i, j)));
          cycle.erase(cycle.begin() + static_cast<std::ptrdiff_t>(std::min(i, j)));
        } else {
          cycle[i].in = cycle[j].in;
          cycle.erase(cycle.begin() + static_cast<std::ptrdiff_t>(j));
        }
        again = true;
        break;
      }
    }
  }

  // The length of the shortest closed curve through a cyclic sleeve is a convex function of where it crosses one edge;
  // golden section finds its least value to half the digits in t, which is all of them in the length.
  double best_cut(const std::vector<Step>& cycle) const {
    const auto length = [&](double t) { return total_length(straighten({cut_open(cycle, t)})).high; };
    constexpr double kGolden = 0.6180339887498949;
    double low = 0, high = 1, a = 1 - kGolden, b = kGolden, at_a = length(a), at_b = length(b);
    for (int i = 0; i < 60; ++i) {
      if (at_a <= at_b) {
        high = b;
        b = a;
        at_b = at_a;
        a = high - kGolden * (high - low);
        at_a = length(a);
      } else {
        low = a;
        a = b;
        at_a = at_b;
        b = low + kGolden * (high - low);
        at_b = length(b);
      }
    }
    const double t = 0.5 * (low + high);
    const double at_t = length(t);
    if (length(0) <= at_t) return 0;
    if (length(1) <= at_t) return 1;
    return t;
  }

  const Mesh& mesh_;
  bool closed_;
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
  if (at.size() > 1) pieces = Shortener(mesh, closed).run(sleeves_of(mesh, at));
  for (const StraightPiece& p : pieces) detail::append_points(mesh, p, path.points);
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
