// Directions at the vertices that a path passes, and the shortest way around them in their links.
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/queries/detail/sleeve.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <queue>
#include <tuple>
#include <utility>

namespace brushfire::detail {
namespace {

// From coordinates: sides of one vertex keep all digits, however thin the face, which lengths do not.
Vec3 side_of(const Mesh& mesh, Index from, Index to) {
  return (1 / mesh.unit()) * (mesh.positions()[to] - mesh.positions()[from]);
}
double angle_between(Vec3 a, Vec3 b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }
double corner_angle(const Mesh& mesh, Index corner) {
  if (!mesh.has_positions()) return mesh.corner_angle(corner);
  const Index v = mesh.from(corner);
  return angle_between(side_of(mesh, v, mesh.to(corner)), side_of(mesh, v, mesh.from(Mesh::previous(corner))));
}

}  // namespace

Direction direction_towards(const Mesh& mesh, Index vertex, Index f, const std::array<double, 3>& point) {
  const Face& t = mesh.faces()[f];
  const auto k = static_cast<std::size_t>(std::find(t.begin(), t.end(), vertex) - t.begin());
  std::array<double, 3> own{0, 0, 0};
  own[k] = 1;
  const Index corner = 3 * f + static_cast<Index>(k);
  const double full = corner_angle(mesh, corner);
  if (mesh.has_positions()) {
    const Vec3 ahead = side_of(mesh, vertex, t[(k + 1) % 3]), behind = side_of(mesh, vertex, t[(k + 2) % 3]);
    const Vec3 d = point[(k + 1) % 3] * ahead + point[(k + 2) % 3] * behind;
    return {corner, std::min(angle_between(ahead, d), full)};
  }
  const std::array<Vec2, 3> corners = flat_corners(mesh, f);
  const Vec2 d = flat_difference(corners, own, point), side = corners[(k + 1) % 3] - corners[k];
  return {corner, std::clamp(std::atan2(cross(side, d), dot(side, d)), 0.0, full)};
}

namespace {

std::array<double, 3> weights_on(Index h, const Crossing& at) {
  std::array<double, 3> w{0, 0, 0};
  w[h % 3] = at.from;
  w[Mesh::next(h) % 3] = at.to;
  return w;
}

}  // namespace

Direction direction_at_begin(const Mesh& mesh, const StraightPiece& straight) {
  const Index f = straight.sleeve.first_face;
  const auto ahead = straight.sleeve.steps.empty()
                         ? *weights_in(mesh, straight.sleeve.end, f)
                         : weights_on(straight.sleeve.steps.front().out, straight.crossing.front());
  return direction_towards(mesh, straight.sleeve.begin.vertex, f, ahead);
}

Direction direction_at_end(const Mesh& mesh, const StraightPiece& straight) {
  const Index f = straight.sleeve.last_face();
  if (straight.sleeve.steps.empty()) {
    return direction_towards(mesh, straight.sleeve.end.vertex, f, *weights_in(mesh, straight.sleeve.begin, f));
  }
  const Step& last = straight.sleeve.steps.back();
  const bool same_start = mesh.from(last.in) == mesh.from(last.out);
  const Crossing& at = straight.crossing.back();
  return direction_towards(mesh, straight.sleeve.end.vertex, f,
                           weights_on(last.in, same_start ? at : Crossing{at.to, at.from}));
}

namespace {

// Shortest ways in the link of a vertex, whose nodes are the edges there (named by their other ends) and whose arcs are
// the corners, as long as their angles: Dijkstra's algorithm, from inside a corner to inside another.
class LinkSearch {
 public:
  LinkSearch(const Mesh& mesh, Index vertex) : mesh_(mesh) {
    // At a vertex of a million faces every edge asks for its own faces, and no others.
    for (const Index corner : mesh.corners(vertex)) {
      if (!mesh.is_face_usable(Mesh::face_of(corner))) continue;
      corner_at_.emplace_back(ahead(corner), corner);
      if (behind(corner) != ahead(corner)) corner_at_.emplace_back(behind(corner), corner);
    }
    std::sort(corner_at_.begin(), corner_at_.end());
  }

  WayAround run(const Direction& from, const Direction& to) {
    offer(ahead(from.corner), from.angle, from.corner, kNoIndex);
    offer(behind(from.corner), corner_angle(mesh_, from.corner) - from.angle, from.corner, kNoIndex);
    if (from.corner == to.corner) best_.angle = std::abs(from.angle - to.angle);
    while (!queue_.empty()) {
      const auto [angle, edge] = queue_.top();
      queue_.pop();
      Node& node = nodes_[edge];
      if (node.done || angle >= best_.angle) continue;
      node.done = true;
      cross_corners(edge, angle, node.through, to);
    }
    return way_back(to.corner);
  }

 private:
  struct Node {
    double angle = kInfinity;
    Index through = kNoIndex;  // the corner through which it was reached
    Index before = kNoIndex;   // the edge before, kNoIndex: the beginning
    bool done = false;
  };
  using Entry = std::tuple<double, Index>;

  Index ahead(Index corner) const { return mesh_.to(corner); }                     // the edge that `corner` runs along
  Index behind(Index corner) const { return mesh_.from(Mesh::previous(corner)); }  // the corner's other edge

  void offer(Index edge, double angle, Index through, Index before) {
    Node& n = nodes_[edge];
    if (angle < n.angle) {
      n.angle = angle;
      n.through = through;
      n.before = before;
      queue_.emplace(angle, edge);
    }
  }

  // From an edge through its corners to their other edges, and to where `to` is.
  void cross_corners(Index edge, double angle, Index through, const Direction& to) {
    const auto first = std::lower_bound(corner_at_.begin(), corner_at_.end(), std::pair{edge, Index{0}});
    for (auto it = first; it != corner_at_.end() && it->first == edge; ++it) {
      const Index corner = it->second;
      if (corner == through) continue;
      const bool is_ahead = ahead(corner) == edge;
      const double full = corner_angle(mesh_, corner);
      if (corner == to.corner) {
        const double total = angle + (is_ahead ? to.angle : full - to.angle);
        if (total < best_.angle) {
          best_.angle = total;
          best_edge_ = edge;
        }
      }
      offer(is_ahead ? behind(corner) : ahead(corner), angle + full, corner, edge);
    }
  }

  // Back along the edges: each is crossed from the corner that reached it into the one beyond.
  WayAround way_back(Index into) {
    for (Index edge = best_edge_; edge != kNoIndex; edge = nodes_[edge].before) {
      const Index out = nodes_[edge].through;
      const auto halfedge = [&](Index corner) { return ahead(corner) == edge ? corner : Mesh::previous(corner); };
      best_.steps.push_back({halfedge(out), halfedge(into)});
      into = out;
    }
    std::reverse(best_.steps.begin(), best_.steps.end());
    return std::move(best_);
  }

  const Mesh& mesh_;
  std::vector<std::pair<Index, Index>> corner_at_;  // an edge and a corner that has it
  std::map<Index, Node> nodes_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
  WayAround best_;
  Index best_edge_ = kNoIndex;
};

}  // namespace

WayAround shortest_way_around(const Mesh& mesh, Index vertex, const Direction& from, const Direction& to) {
  return LinkSearch(mesh, vertex).run(from, to);
}

}  // namespace brushfire::detail
