// Shortest ways in the link of a vertex.
#include <brushfire/solvers/windows/propagation/links.h>

#include <brushfire/core/detail/sort.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// Angles along a link are sums of arc tangents, and doubles whatever the room's number: shadows are taken to be wider
// by this.
constexpr double kAngleMargin = 1e-12;
// A shadow that is narrower is rounding (kFlat); in wider numbers, which could tell, it counts all the same.
constexpr double kNarrow = kWide ? -1e-14 : kFlat;

double angle_of(const Real& cosine, const Real& sine) {
  return std::atan2(to_double(std::max(Real{0}, sine)), to_double(cosine));
}

}  // namespace

// The sides of one edge, which form a ring, are one node.
void LinkShadow::find_nodes(const WindowStructure& mesh, std::span<const Index> corners) {
  sides_.clear();
  arcs_.clear();
  for (const Index h : corners) {
    sides_.emplace_back(h, kNoIndex);
    sides_.emplace_back(3 * (h / 3) + previous3(h % 3), kNoIndex);
  }
  detail::sort(sides_.begin(), sides_.end());
  const auto side = [&](Index h) {
    return std::lower_bound(sides_.begin(), sides_.end(), h, [](const auto& s, Index x) { return s.first < x; });
  };
  Index nodes = 0;
  for (auto& [halfedge, node] : sides_) {
    if (node != kNoIndex) continue;
    Index h = halfedge;
    do {
      side(h)->second = nodes;
      h = mesh.faces[h / 3].opposite[h % 3];
    } while (h != halfedge);
    ++nodes;
  }
  way_.assign(nodes, kPi);
  if (arcs_at_.size() < nodes) arcs_at_.resize(nodes);
  for (Index n = 0; n < nodes; ++n) arcs_at_[n].clear();
  for (const Index h : corners) {
    const Arc arc{h, side(h)->second, side(3 * (h / 3) + previous3(h % 3))->second, angle_at(mesh.faces[h / 3], h % 3)};
    for (const Index node : {arc.from, arc.to}) arcs_at_[node].push_back(static_cast<Index>(arcs_.size()));
    arcs_.push_back(arc);
  }
}

void LinkShadow::measure_from(const WindowStructure& mesh, const CrossedAt& arrival) {
  const Index face = arrival.halfedge / 3, corner = 3 * face + previous3(arrival.halfedge % 3);
  const Frame frame = frame_of(mesh.faces[face], arrival.halfedge % 3);
  // From the vertex: where the light came from, and the halfedge's two ends.
  const Vec2 back = Vec2{arrival.place, 0} - frame.apex;
  const Vec2 first = Vec2{} - frame.apex, second = Vec2{frame.length, 0} - frame.apex;
  queue_.clear();
  const auto offer = [&](Index node, double way) {
    if (!(way < way_[node])) return;
    way_[node] = way;
    queue_.emplace_back(way, node);
    std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
  };
  for (const Arc& arc : arcs_) {
    if (arc.halfedge != corner) continue;
    offer(arc.from, angle_of(dot(first, back), cross(first, back)));
    offer(arc.to, angle_of(dot(back, second), cross(back, second)));
  }
  while (!queue_.empty()) {
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    const auto [way, node] = queue_.back();
    queue_.pop_back();
    if (way > way_[node]) continue;
    for (const Index a : arcs_at_[node]) {
      offer(arcs_[a].from == node ? arcs_[a].to : arcs_[a].from, way + arcs_[a].angle);
    }
  }
}

std::span<const Sector> LinkShadow::operator()(const WindowStructure& mesh, std::span<const Index> corners,
                                               const CrossedAt& arrival) {
  find_nodes(mesh, corners);
  measure_from(mesh, arrival);
  sectors_.clear();
  for (const Arc& arc : arcs_) {
    if (arc.halfedge / 3 == arrival.halfedge / 3) continue;  // all of it is less than pi away
    const double low = kPi - way_[arc.from], high = arc.angle - (kPi - way_[arc.to]);
    if (high - low <= kNarrow) continue;
    const auto direction = [](double angle) { return Vec2{std::cos(angle), std::sin(angle)}; };
    Sector sector = whole_sector(mesh.faces[arc.halfedge / 3], arc.halfedge / 3, arc.halfedge % 3);
    if (low - kAngleMargin > 0) sector.from = direction(low - kAngleMargin);
    if (high + kAngleMargin < arc.angle) sector.to = direction(high + kAngleMargin);
    sectors_.push_back(sector);
  }
  return sectors_;
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
