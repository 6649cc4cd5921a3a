// Recursive bisection of the surface, along edges.
#include <brushfire/solvers/carried_source/detail/source_groups.h>

#include <brushfire/core/cancel.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace brushfire::carried_source {
namespace {

constexpr Index kGroup = kGroupLanes;
constexpr float kNowhere = 1e30f;
// In edges as they are there. Sources farther from each other disagree about the order around them for too long: a
// group of scattered ones takes 20 to 30 turns a vertex instead of 1.1.
constexpr double kWidest = 8;
// What is smaller and lies apart in a piece is an island that a cut left over: it stays with its neighbours as long as
// it can.
constexpr Index kComponent = 4 * kGroup;

// body(vertex, length) for each edge at v, those of two faces twice.
template <class Body>
void for_neighbours(const Mesh& mesh, Index v, const Body& body) {
  for (const Index h : mesh.corners(v)) {
    const Index back = Mesh::previous(h);
    body(mesh.to(h), static_cast<float>(mesh.length(h)));
    body(mesh.from(back), static_cast<float>(mesh.length(back)));
  }
}

}  // namespace

SourceGrouping::SourceGrouping(const Mesh& mesh, std::vector<bool> excluded)
    : mesh_(mesh), piece_(mesh.vertex_count(), 0), from_(mesh.vertex_count()), to_(mesh.vertex_count(), kNowhere) {
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.corners(v).empty() && (excluded.empty() || !excluded[v])) order_.push_back(v);
  }
}

std::vector<SourceGroup> SourceGrouping::of(const std::vector<bool>& asked) {
  std::vector<SourceGroup> groups;
  std::vector<Range> open{{0, static_cast<Index>(order_.size())}};
  while (!open.empty()) {
    const Range range = open.back();
    open.pop_back();
    if (!any_asked(range, asked)) continue;
    stop_if_cancelled();
    if (range.second - range.first <= kGroup) {
      take_apart(range, asked, groups);
      continue;
    }
    const Index middle = cut(range);
    open.emplace_back(middle, range.second);
    open.emplace_back(range.first, middle);
  }
  return groups;
}

bool SourceGrouping::any_asked(Range range, const std::vector<bool>& asked) const {
  return std::any_of(order_.begin() + range.first, order_.begin() + range.second, [&](Index v) { return asked[v]; });
}

// At a multiple of the size of a group, so that only the last one is not full.
Index SourceGrouping::cut(Range range) {
  const auto [begin, end] = range;
  ++pieces_;
  for (Index i = begin; i < end; ++i) piece_[order_[i]] = pieces_;
  const Index a = farthest(order_[begin], range, from_);
  // Components come apart as a whole.
  const auto first = order_.begin() + begin, last = order_.begin() + end;
  const auto hangs_together = [&](Index v) { return from_[v] < kNowhere; };
  const auto together = static_cast<Index>(std::count_if(first, last, hangs_together));
  if (together >= kComponent && end - begin - together >= kComponent) {
    std::stable_partition(first, last, hangs_together);
    return begin + together;
  }
  const Index b = farthest(a, range, from_);
  farthest(b, range, to_);
  const Index middle = begin + std::max<Index>(1, (end - begin) / kGroup / 2) * kGroup;
  sides_.clear();
  for (Index i = begin; i < end; ++i) sides_.emplace_back(from_[order_[i]] - to_[order_[i]], order_[i]);
  const auto pivot = sides_.begin() + (middle - begin);
  std::nth_element(sides_.begin(), pivot, sides_.end());
  const std::pair<float, Index> first_beyond = *pivot;
  std::stable_partition(first, last, [&](Index v) { return std::pair(from_[v] - to_[v], v) < first_beyond; });
  for (Index i = begin; i < end; ++i) to_[order_[i]] = kNowhere;
  return middle;
}

// Along edges within the piece; vertices that are not reached are the farthest.
Index SourceGrouping::farthest(Index start, Range range, std::vector<float>& distance) {
  for (Index i = range.first; i < range.second; ++i) distance[order_[i]] = kNowhere;
  heap_.assign(1, {0.0f, start});
  distance[start] = 0;
  Index last = start, reached = 0;
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const auto [d, v] = heap_.back();
    heap_.pop_back();
    if (d > distance[v]) continue;
    last = v, ++reached;
    for_neighbours(mesh_, v, [&](Index w, float length) {
      // NOLINTNEXTLINE(clang-analyzer-core.NullDereference): numbers of vertices are below its size
      if (piece_[w] != pieces_ || !(d + length < distance[w])) return;
      distance[w] = d + length;
      heap_.emplace_back(d + length, w);
      std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    });
  }
  if (reached == range.second - range.first) return last;
  const auto is_away = [&](Index v) { return distance[v] == kNowhere; };
  return *std::find_if(order_.begin() + range.first, order_.begin() + range.second, is_away);
}

void SourceGrouping::take_apart(Range range, const std::vector<bool>& asked, std::vector<SourceGroup>& groups) {
  std::vector<Index> left(order_.begin() + range.first, order_.begin() + range.second);
  while (!left.empty()) {
    SourceGroup group;
    group.vertices = cluster(left, group.spread);
    if (std::any_of(group.vertices.begin(), group.vertices.end(), [&](Index v) { return asked[v]; })) {
      groups.push_back(std::move(group));
    }
  }
}

// How far a vertex may be for a group.
double SourceGrouping::close_by(Index vertex) const {
  double sum = 0, count = 0;
  for_neighbours(mesh_, vertex, [&](Index, float length) { sum += length, ++count; });
  return kWidest * sum / count;
}

// Takes the first one and what is close to it. (Searched in all of the mesh.)
std::vector<Index> SourceGrouping::cluster(std::vector<Index>& left, double& spread) {
  const Index first = left.front();
  const auto limit = static_cast<float>(close_by(first));
  std::vector<Index> seen{first};
  std::size_t missing = left.size() - 1;
  heap_.assign(1, {0.0f, first});
  to_[first] = 0;
  float farthest_found = 0;
  while (!heap_.empty() && missing > 0) {
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const auto [d, v] = heap_.back();
    heap_.pop_back();
    if (d > to_[v]) continue;
    if (v != first && std::binary_search(left.begin(), left.end(), v)) --missing, farthest_found = d;
    for_neighbours(mesh_, v, [&](Index w, float length) {
      // NOLINTNEXTLINE(clang-analyzer-core.NullDereference): numbers of vertices are below its size
      if (d + length > limit || !(d + length < to_[w])) return;
      if (to_[w] == kNowhere) seen.push_back(w);
      to_[w] = d + length;
      heap_.emplace_back(d + length, w);
      std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    });
  }
  // What was popped is not farther than the last of them.
  std::vector<Index> close;
  const auto beyond =
      std::stable_partition(left.begin(), left.end(), [&](Index v) { return to_[v] <= farthest_found; });
  close.assign(left.begin(), beyond);
  left.erase(left.begin(), beyond);
  for (const Index v : seen) to_[v] = kNowhere;
  spread = 2 * static_cast<double>(farthest_found);
  return close;
}

}  // namespace brushfire::carried_source
