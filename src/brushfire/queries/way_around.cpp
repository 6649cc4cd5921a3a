// Angles are summed corner by corner, whichever way the faces are oriented and however many an edge has.
#include <brushfire/core/detail/sort.h>
#include <brushfire/queries/detail/way_around.h>

#include <brushfire/mesh/detail/flat_face.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

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

Direction direction_at_begin(const Mesh& mesh, const StraightPiece& straight) {
  return direction_towards(mesh, straight.sleeve.begin.vertex, straight.sleeve.first_face,
                           point_after_begin(mesh, straight));
}

Direction direction_at_end(const Mesh& mesh, const StraightPiece& straight) {
  return direction_towards(mesh, straight.sleeve.end.vertex, straight.sleeve.last_face(),
                           point_before_end(mesh, straight));
}

namespace {

// The edges at a vertex, by their other ends, and the corners between them: at a vertex of a million faces every edge
// finds its own corners, and no others.
class VertexLink {
 public:
  VertexLink(const Mesh& mesh, Index vertex, Index from) : mesh_(mesh) {
    arcs_ = {{ahead(from), kNoIndex}, {behind(from), kNoIndex}};  // its edges, whether or not its face is usable
    for (const Index corner : mesh.corners(vertex)) {
      if (!mesh.is_face_usable(Mesh::face_of(corner))) continue;
      arcs_.emplace_back(ahead(corner), corner);
      if (behind(corner) != ahead(corner)) arcs_.emplace_back(behind(corner), corner);
    }
    detail::sort(arcs_.begin(), arcs_.end());
  }

  Index ahead(Index corner) const { return mesh_.to(corner); }                     // the edge that `corner` runs along
  Index behind(Index corner) const { return mesh_.from(Mesh::previous(corner)); }  // the corner's other edge
  // Where the arcs of an edge begin.
  std::size_t first(Index edge) const {
    return static_cast<std::size_t>(std::lower_bound(arcs_.begin(), arcs_.end(), std::pair{edge, Index{0}}) -
                                    arcs_.begin());
  }
  // (edge, corner), by edge; kNoIndex for no corner
  const std::vector<std::pair<Index, Index>>& arcs() const { return arcs_; }

 private:
  const Mesh& mesh_;
  std::vector<std::pair<Index, Index>> arcs_;
};

}  // namespace

// Dijkstra on the link: its nodes are the edges at the vertex (named by the first of their arcs), its arcs the corners.
WayAround shortest_way_around(const Mesh& mesh, Index vertex, const Direction& from, const Direction& to) {
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  struct Node {
    double angle = kInfinity;
    Index through = kNoIndex;    // the corner through which it was reached
    std::size_t before = kNone;  // the edge before, kNone: the beginning
  };
  const VertexLink link(mesh, vertex, from.corner);
  std::vector<Node> nodes(link.arcs().size());
  using Entry = std::pair<double, std::size_t>;
  std::vector<Entry> queue;
  const auto offer = [&](Index edge, double angle, Index through, std::size_t before) {
    const std::size_t node = link.first(edge);
    if (!(angle < nodes[node].angle)) return;
    nodes[node] = {angle, through, before};
    queue.emplace_back(angle, node);
    std::push_heap(queue.begin(), queue.end(), std::greater<>());
  };
  offer(link.ahead(from.corner), from.angle, from.corner, kNone);
  offer(link.behind(from.corner), corner_angle(mesh, from.corner) - from.angle, from.corner, kNone);

  double least = kPi;
  std::size_t best = kNone;
  WayAround way;
  if (from.corner == to.corner) way.angle = least = std::min(least, std::abs(from.angle - to.angle));
  while (!queue.empty()) {
    std::pop_heap(queue.begin(), queue.end(), std::greater<>());
    const auto [angle, node] = queue.back();
    queue.pop_back();
    if (angle >= least) break;
    if (angle > nodes[node].angle) continue;
    const Index edge = link.arcs()[node].first;
    for (std::size_t i = node; i < link.arcs().size() && link.arcs()[i].first == edge; ++i) {
      const Index corner = link.arcs()[i].second;
      if (corner == nodes[node].through || corner == kNoIndex) continue;
      const bool is_ahead = link.ahead(corner) == edge;
      const double full = corner_angle(mesh, corner);
      const double total = angle + (is_ahead ? to.angle : full - to.angle);
      if (corner == to.corner && total < least) {
        way.angle = least = total;
        best = node;
      }
      offer(is_ahead ? link.behind(corner) : link.ahead(corner), angle + full, corner, node);
    }
  }
  // Back along the edges: each is crossed from the corner that reached it into the one beyond.
  Index into = to.corner;
  for (std::size_t node = best; node != kNone; node = nodes[node].before) {
    const Index out = nodes[node].through, edge = link.arcs()[node].first;
    const auto halfedge = [&](Index corner) { return link.ahead(corner) == edge ? corner : Mesh::previous(corner); };
    way.steps.push_back({halfedge(out), halfedge(into)});
    into = out;
  }
  std::reverse(way.steps.begin(), way.steps.end());
  return way;
}

}  // namespace brushfire::detail
