// Recursive bisection of the surface, along edges.
#include <brushfire/solvers/carried_source/detail/source_groups.h>

#include <brushfire/core/cancel.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace brushfire::carried_source {
namespace {

constexpr Index kGroup = kGroupLanes;
constexpr float kNowhere = 1e30f;
// In edges as they are there. Sources farther from each other disagree about the order around them for too long: a
// group of scattered ones takes 20 to 30 turns a vertex instead of 1.1.
constexpr double kWidest = 8;
// What is smaller and lies apart in a piece is an island that a cut left over: it stays where it is as long as it can.
constexpr Index kComponent = 4 * kGroup;
constexpr int kTries = 8;
constexpr float kLonger = 1.15f;
// A little more than 1. On grids whole regions are nearer to one end by the same.
constexpr float kBefore = 1 + 1.0f / 64;

}  // namespace

SourceGrouping::SourceGrouping(const Mesh& mesh, std::vector<bool> excluded)
    : mesh_(mesh),
      piece_(mesh.vertex_count(), kNoIndex),
      from_(mesh.vertex_count(), kNowhere),
      to_(mesh.vertex_count(), kNowhere) {
  list_neighbours();
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.corners(v).empty() || (!excluded.empty() && excluded[v])) continue;
    order_.push_back(v);
    piece_[v] = pieces_;
  }
}

std::span<const SourceGrouping::Neighbour> SourceGrouping::neighbours(Index v) const {
  return std::span(neighbours_).subspan(start_[v], start_[v + 1] - start_[v]);
}

void SourceGrouping::list_neighbours() {
  start_.reserve(mesh_.vertex_count() + std::size_t{1});
  neighbours_.reserve(mesh_.halfedge_count() + std::size_t{mesh_.halfedge_count() / 16});
  double sum = 0;
  const auto add = [&](Index w, Index h) {
    const double length = mesh_.length(h);
    neighbours_.push_back({w, static_cast<float>(length)});
    sum += length;
  };
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    start_.push_back(neighbours_.size());
    for (const Index h : mesh_.corners(v)) {
      add(mesh_.to(h), h);
      // The other edge of this corner, unless it leaves v in the next face.
      const Index back = Mesh::previous(h), next = mesh_.opposite(back);
      if (next == back || mesh_.from(next) != v) add(mesh_.from(back), back);
    }
  }
  start_.push_back(neighbours_.size());
  if (!neighbours_.empty()) mean_edge_ = static_cast<float>(sum / static_cast<double>(neighbours_.size()));
}

std::vector<SourceGroup> SourceGrouping::of(const std::vector<bool>& asked) {
  std::vector<SourceGroup> groups;
  std::vector<Range> open = components();
  std::reverse(open.begin(), open.end());
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

// Each with its distances from a pole at one of its ends.
std::vector<SourceGrouping::Range> SourceGrouping::components() {
  std::vector<Index> number(mesh_.vertex_count(), kNoIndex), count;
  for (const Index first : order_) {
    if (number[first] != kNoIndex) continue;
    const auto own = static_cast<Index>(count.size());
    count.push_back(0);
    right_.assign(1, first);
    number[first] = own;
    while (!right_.empty()) {
      const Index v = right_.back();
      right_.pop_back();
      ++count[own];
      for (const auto& [w, length] : neighbours(v)) {
        if (piece_[w] == kNoIndex || number[w] != kNoIndex) continue;
        number[w] = own;
        right_.push_back(w);
      }
    }
  }
  std::vector<Range> ranges;
  Index begin = 0;
  for (const Index c : count) ranges.emplace_back(begin, begin), begin += c;
  const std::vector<Index> ascending = order_;
  for (const Index v : ascending) order_[ranges[number[v]].second++] = v;
  for (const Range& range : ranges) {
    if (range.second - range.first <= kGroup) continue;
    reach(order_[range.first], mean_edge_, from_);
    const Index pole = farthest_reached(range);
    forget(range, from_);
    reach(pole, mean_edge_, from_);
  }
  return ranges;
}

bool SourceGrouping::any_asked(Range range, const std::vector<bool>& asked) const {
  return std::any_of(order_.begin() + range.first, order_.begin() + range.second, [&](Index v) { return asked[v]; });
}

// At a multiple of the size of a group, so that only the last one is not full.
Index SourceGrouping::cut(Range range) {
  const auto [begin, end] = range;
  const Index size = end - begin, reached = reach_other_end(range);
  // What rounding left apart from the rest, and is no island, becomes a piece of its own.
  const bool apart = reached >= kComponent && size - reached >= kComponent;
  const Index middle = begin + (apart ? size - reached : std::max<Index>(1, size / kGroup / 2) * kGroup);
  // Nearer to the pole by this; of two that are as near the one that lies before.
  const auto side_of = [this](Index v) {
    if (!(std::max(from_[v], to_[v]) < kNowhere)) return kNowhere;
    return from_[v] * kBefore - to_[v];
  };
  sides_.clear();
  for (Index i = begin; i < end && !apart; ++i) sides_.emplace_back(side_of(order_[i]), order_[i]);
  if (!apart) std::nth_element(sides_.begin(), sides_.begin() + (middle - begin), sides_.end());
  const std::pair<float, Index> first_beyond = apart ? std::pair(kNowhere, Index{0}) : sides_[middle - begin];
  right_.clear();
  Index left = begin;
  for (Index i = begin; i < end; ++i) {
    const Index v = order_[i];
    if (apart ? to_[v] == kNowhere : std::pair(side_of(v), v) < first_beyond) {
      order_[left++] = v;
    } else {
      right_.push_back(v);
      from_[v] = to_[v];
    }
    to_[v] = kNowhere;
  }
  std::copy(right_.begin(), right_.end(), order_.begin() + middle);
  return middle;
}

// Of buckets: a vertex or so for each of them along the way, however long edges are here.
float SourceGrouping::width_of(Range range, float length) const {
  if (!(length < kNowhere)) return mean_edge_;
  return length / std::sqrt(static_cast<float>(range.second - range.first));
}

// Distances from what is far from the pole, and of how many vertices they are.
Index SourceGrouping::reach_other_end(Range range) {
  ++pieces_;
  for (Index i = range.first; i < range.second; ++i) piece_[order_[i]] = pieces_;
  Index reached = 0;
  for (int tries = 0; tries < kTries; ++tries) {
    const Index other = farthest_reached(range);
    const float length = from_[other];
    reach(other, width_of(range, length), to_);
    const auto is_reached = [this](Index v) { return to_[v] < kNowhere; };
    reached =
        static_cast<Index>(std::count_if(order_.begin() + range.first, order_.begin() + range.second, is_reached));
    if (reached >= kComponent || 2 * reached >= range.second - range.first) {
      stretch(range, length);
      break;
    }
    // An island: the next one.
    for (Index i = range.first; i < range.second; ++i) {
      if (to_[order_[i]] < kNowhere) from_[order_[i]] = to_[order_[i]] = kNowhere;
    }
  }
  return reached;
}

// Where the piece is longer from its other end on than it is from the pole, the pole moves there.
void SourceGrouping::stretch(Range range, float length) {
  Index pole = kNoIndex;
  float most = kLonger * length;
  for (Index i = range.first; i < range.second; ++i) {
    const Index v = order_[i];
    if (to_[v] < kNowhere && to_[v] > most) pole = v, most = to_[v];
  }
  if (pole == kNoIndex) return;
  forget(range, from_);
  reach(pole, width_of(range, most), from_);
}

// From the pole; the first vertex where the pole reaches none.
Index SourceGrouping::farthest_reached(Range range) const {
  Index farthest = order_[range.first];
  float most = -1;
  for (Index i = range.first; i < range.second; ++i) {
    const float d = from_[order_[i]];
    if (d < kNowhere && d > most) farthest = order_[i], most = d;
  }
  return farthest;
}

void SourceGrouping::forget(Range range, std::vector<float>& distance) const {
  for (Index i = range.first; i < range.second; ++i) distance[order_[i]] = kNowhere;
}

// Distances along edges within the piece that `start` is in; buckets are `width` wide. Which of them a vertex waits in
// decides how often it is looked at, and not what comes out: the least sum.
void SourceGrouping::reach(Index start, float width, std::vector<float>& distance) {
  const float inverse = 1 / width, per_unit = std::isfinite(inverse) ? inverse : 0.0f;
  const auto bucket_of = [=](float d) { return static_cast<BucketQueue::Bucket>(d * per_unit); };
  const Index piece = piece_[start];
  distance[start] = 0;
  queue_.reset();
  queue_.push(start, 0);
  do {
    for (std::size_t i = 0; i < queue_.current().size(); ++i) {
      const Index v = queue_.current()[i];
      const float d = distance[v];
      if (bucket_of(d) < queue_.cursor()) continue;  // it had its turn
      for (const auto& [w, length] : neighbours(v)) {
        if (piece_[w] != piece || !(d + length < distance[w])) continue;
        distance[w] = d + length;
        queue_.push(w, bucket_of(d + length));
      }
    }
    queue_.clear_current();
  } while (queue_.advance());
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
  for (const auto& [w, length] : neighbours(vertex)) sum += length, ++count;
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
    for (const auto& [w, length] : neighbours(v)) {
      if (d + length > limit || !(d + length < to_[w])) continue;
      if (to_[w] == kNowhere) seen.push_back(w);
      to_[w] = d + length;
      heap_.emplace_back(d + length, w);
      std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    }
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
