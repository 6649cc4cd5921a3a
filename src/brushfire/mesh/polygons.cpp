// Ear clipping, with a k-d tree over the corners that can be in the way.
#include <brushfire/mesh/polygons.h>

#include <brushfire/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace brushfire {
namespace {

// The outline seen along the axis nearest to its mean (Newell) normal, counter-clockwise. Dropping a coordinate instead
// of rotating keeps the others exact, so that corners on a line stay on it; scaled so that products stay finite.
std::vector<Vec2> flattened(std::span<const Vec3> positions, std::span<const Index> polygon) {
  double largest = 0;
  for (const Index v : polygon) {
    const Vec3 e = 0.5 * positions[v] - 0.5 * positions[polygon[0]];
    largest = std::max({largest, std::abs(e.x), std::abs(e.y), std::abs(e.z)});
  }
  // No smaller than the smallest normal number's inverse allows.
  const double scale = std::ldexp(1.0, largest > 0 ? std::min(1000, -std::ilogb(largest)) : 0);
  std::vector<Vec3> corners;
  corners.reserve(polygon.size());
  for (const Index v : polygon) corners.push_back(scale * (0.5 * positions[v] - 0.5 * positions[polygon[0]]));
  Vec3 normal;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    normal = normal + cross(corners[i], corners[(i + 1) % corners.size()]);
  }
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  std::vector<Vec2> flat;
  flat.reserve(corners.size());
  for (const Vec3& p : corners) {
    if (z >= x && z >= y) {
      flat.push_back(normal.z >= 0 ? Vec2{p.x, p.y} : Vec2{p.y, p.x});
    } else if (x >= y) {
      flat.push_back(normal.x >= 0 ? Vec2{p.y, p.z} : Vec2{p.z, p.y});
    } else {
      flat.push_back(normal.y >= 0 ? Vec2{p.z, p.x} : Vec2{p.x, p.z});
    }
  }
  return flat;
}

// Positive where a, b, c turn left.
double turn(Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a); }

// A triangle that turns left, as the three lines that it lies to the left of.
struct Ear {
  std::array<Vec2, 3> corner;

  bool contains(Vec2 p) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (turn(corner[k], corner[(k + 1) % 3], p) < 0) return false;
    }
    return true;
  }

  // Whether the box lies to the right of one of the lines, or beside the triangle.
  bool misses(Vec2 low, Vec2 high) const {
    const auto [x0, x1] = std::minmax({corner[0].x, corner[1].x, corner[2].x});
    const auto [y0, y1] = std::minmax({corner[0].y, corner[1].y, corner[2].y});
    if (high.x < x0 || low.x > x1 || high.y < y0 || low.y > y1) return true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 a = corner[k], b = corner[(k + 1) % 3];
      // The corner of the box that lies farthest to the left.
      const Vec2 p{b.y > a.y ? low.x : high.x, b.x > a.x ? high.y : low.y};
      if (turn(a, b, p) < 0) return true;
    }
    return false;
  }
};

// A k-d tree over points that are switched on and off: "is one that is on inside this triangle?" The node of the items
// [begin, end) sits at their middle; subtrees without a point that is on, or whose box misses the triangle, are
// skipped.
class PointTree {
 public:
  explicit PointTree(std::span<const Vec2> points)
      : points_(points), items_(points.size()), place_(points.size()), nodes_(points.size()), on_(points.size(), 0) {
    std::iota(items_.begin(), items_.end(), Index{0});
    build(0, size(), false);
    for (Index i = 0; i < size(); ++i) place_[items_[i]] = i;
  }

  bool is_on(Index item) const { return on_[item] != 0; }

  void set(Index item, bool on) {
    if (is_on(item) == on) return;
    on_[item] = on;
    const Index place = place_[item];
    for (Index begin = 0, end = size();;) {
      const Index middle = begin + (end - begin) / 2;
      nodes_[middle].on += on ? 1 : -1;
      if (place == middle) return;
      (place < middle ? end : begin) = place < middle ? middle : middle + 1;
    }
  }

  // An item that is on and inside the triangle or on its border, its corners aside: a point there is the outline
  // touching itself, as in a bridge to a hole. kNoIndex: none.
  Index find(const Ear& ear) const { return find(0, size(), ear); }

 private:
  struct Node {
    Vec2 low, high;  // of its items
    int on = 0;      // how many of them are on
  };

  Index size() const { return static_cast<Index>(items_.size()); }

  void build(Index begin, Index end, bool by_y) {
    if (begin == end) return;
    const Index middle = begin + (end - begin) / 2;
    std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end, [&](Index i, Index j) {
      return by_y ? points_[i].y < points_[j].y : points_[i].x < points_[j].x;
    });
    Node& node = nodes_[middle];
    node.low = node.high = points_[items_[middle]];
    for (const auto& [child_begin, child_end] : {std::pair{begin, middle}, std::pair{middle + 1, end}}) {
      if (child_begin == child_end) continue;
      build(child_begin, child_end, !by_y);
      const Node& child = nodes_[child_begin + (child_end - child_begin) / 2];
      node.low = {std::min(node.low.x, child.low.x), std::min(node.low.y, child.low.y)};
      node.high = {std::max(node.high.x, child.high.x), std::max(node.high.y, child.high.y)};
    }
  }

  Index find(Index begin, Index end, const Ear& ear) const {
    if (begin == end) return kNoIndex;
    const Index middle = begin + (end - begin) / 2, item = items_[middle];
    const Node& node = nodes_[middle];
    if (node.on == 0 || ear.misses(node.low, node.high)) return kNoIndex;
    const Vec2 p = points_[item];
    const bool is_corner = p == ear.corner[0] || p == ear.corner[1] || p == ear.corner[2];
    if (is_on(item) && !is_corner && ear.contains(p)) return item;
    const Index found = find(begin, middle, ear);
    return found != kNoIndex ? found : find(middle + 1, end, ear);
  }

  std::span<const Vec2> points_;
  std::vector<Index> items_, place_;  // inverse of each other
  std::vector<Node> nodes_;
  std::vector<char> on_;
};

// Cuts one polygon: from the ring of corners ears (corners whose triangle holds no other corner) are taken until three
// are left. A corner that is no ear because another one is in its way waits for that one, so nothing is tried in vain.
class EarClipper {
 public:
  explicit EarClipper(std::vector<Vec2> points)
      : points_(std::move(points)), left_(static_cast<Index>(points_.size())), blocks_(points_) {
    next_.resize(left_);
    previous_.resize(left_);
    for (Index i = 0; i < left_; ++i) {
      next_[i] = i + 1 < left_ ? i + 1 : 0;
      previous_[i] = i > 0 ? i - 1 : left_ - 1;
    }
    waiting_.assign(left_, kNoIndex);
    cut_in_round_.assign(left_, 0);
    in_list_.assign(left_, false);
    for (Index i = 0; i < left_; ++i) {
      update(i);
      enlist(i);
    }
  }

  // Calls emit(i, j, k) for n - 2 triangles.
  template <class Emit>
  void clip(Emit&& emit) {
    for (Index round = 1; left_ >= 3; ++round) {
      std::vector<Index> candidates;
      candidates.swap(list_);
      for (const Index i : candidates) in_list_[i] = false;
      bool stuck = true;
      for (const Index i : candidates) {
        if (left_ < 3) break;
        if (is_cut(i)) continue;
        if (cut_in_round_[previous_[i]] == round || cut_in_round_[next_[i]] == round || cut_in_round_[i] == round) {
          // Not next to a cut of the same round, or a convex outline would fall into one fan of slivers.
          enlist(i);
          stuck = false;
        } else if (is_ear(i)) {
          cut(i, round, emit);
          stuck = false;
        }
      }
      // The outline touches or crosses itself, or has no area: then any cut will do, a turn to the left rather.
      if (stuck && left_ >= 3) cut(any_corner(), round, emit);
    }
  }

 private:
  bool is_cut(Index i) const { return next_[i] == kNoIndex; }

  void enlist(Index i) {
    if (!in_list_[i]) list_.push_back(i);
    in_list_[i] = true;
  }

  template <class Emit>
  void cut(Index i, Index round, Emit&& emit) {
    const Index before = previous_[i], after = next_[i];
    emit(before, i, after);
    next_[before] = after;
    previous_[after] = before;
    next_[i] = kNoIndex;
    --left_;
    blocks_.set(i, false);
    release(i);
    for (const Index neighbour : {before, after}) {
      update(neighbour);
      cut_in_round_[neighbour] = round;
      enlist(neighbour);
    }
    some_corner_ = before;
  }

  // Corners that do not turn left can lie inside an ear; those that do cannot, unless another one does, too.
  void update(Index i) {
    const bool blocked = blocks_.is_on(i);
    blocks_.set(i, !(turn(points_[previous_[i]], points_[i], points_[next_[i]]) > 0));
    if (blocked && !blocks_.is_on(i)) release(i);
  }

  // Tries again what waited for corner i.
  void release(Index i) {
    for (Index w = waiting_[i]; w != kNoIndex; w = waits_[w].next) {
      if (!is_cut(waits_[w].corner)) enlist(waits_[w].corner);
    }
    waiting_[i] = kNoIndex;
  }

  bool is_ear(Index i) {
    if (blocks_.is_on(i)) return false;
    const Index blocker = blocks_.find({{points_[previous_[i]], points_[i], points_[next_[i]]}});
    if (blocker == kNoIndex) return true;
    waits_.push_back({i, waiting_[blocker]});
    waiting_[blocker] = static_cast<Index>(waits_.size() - 1);
    return false;
  }

  Index any_corner() {
    for (; tried_ < waits_.size(); ++tried_) {
      const Index i = waits_[tried_].corner;
      if (!is_cut(i) && !blocks_.is_on(i)) return i;
    }
    return some_corner_;
  }

  struct Wait {
    Index corner;
    Index next;  // of those that wait for the same blocker
  };

  std::vector<Vec2> points_;
  Index left_, some_corner_ = 0;
  PointTree blocks_;
  std::vector<Index> next_, previous_;
  std::vector<Index> list_;  // corners to be tried in the next round
  std::vector<char> in_list_;
  std::vector<Index> cut_in_round_;  // the last round in which a neighbour was cut
  std::vector<Index> waiting_;       // per blocker the first of those that wait for it
  std::vector<Wait> waits_;
  std::size_t tried_ = 0;  // waits that any_corner() is done with
};

// The diagonal from corner 0, where it and not the other one is valid, or where it is the shorter one.
bool cut_from_first_corner(std::span<const Vec3> p, std::span<const Index> q) {
  const std::vector<Vec2> f = flattened(p, q);
  const bool first = turn(f[0], f[1], f[2]) > 0 && turn(f[0], f[2], f[3]) > 0;
  const bool second = turn(f[1], f[2], f[3]) > 0 && turn(f[1], f[3], f[0]) > 0;
  if (first != second) return first;
  return norm(0.5 * p[q[2]] - 0.5 * p[q[0]]) <= norm(0.5 * p[q[3]] - 0.5 * p[q[1]]);
}

void check(std::span<const Vec3> positions, std::span<const Index> offset, std::span<const Index> vertices) {
  if (offset.empty() || offset.front() != 0 || offset.back() != vertices.size()) {
    throw Error(ErrorCode::InvalidArgument,
                "polygon offsets must run from 0 to the number of corners, " + std::to_string(vertices.size()));
  }
  for (std::size_t p = 0; p + 1 < offset.size(); ++p) {
    if (offset[p] > offset[p + 1]) {
      throw Error(ErrorCode::InvalidArgument, "the offset of polygon " + std::to_string(p + 1) + " is too small");
    }
    for (Index i = offset[p]; i < offset[p + 1]; ++i) {
      if (vertices[i] >= positions.size()) {
        throw Error(ErrorCode::InvalidMesh, "polygon " + std::to_string(p) + " names vertex " +
                                                std::to_string(vertices[i]) + ", but there are " +
                                                std::to_string(positions.size()) + " vertices");
      }
    }
  }
}

}  // namespace

Triangulation triangulate_polygons(std::span<const Vec3> positions, std::span<const Index> polygon_offset,
                                   std::span<const Index> polygon_vertices) {
  check(positions, polygon_offset, polygon_vertices);
  Triangulation result;
  for (Index p = 0; p + 1 < polygon_offset.size(); ++p) {
    const auto q = polygon_vertices.subspan(polygon_offset[p], polygon_offset[p + 1] - polygon_offset[p]);
    const auto emit = [&](Index i, Index j, Index k) {
      result.faces.push_back({q[i], q[j], q[k]});
      result.origin.push_back(p);
    };
    if (q.size() == 3) {
      emit(0, 1, 2);
    } else if (q.size() == 4) {
      const Index first = cut_from_first_corner(positions, q) ? 0 : 1;
      emit(first, first + 1, first + 2);
      emit(first, first + 2, (first + 3) % 4);
    } else if (q.size() > 4) {
      EarClipper(flattened(positions, q)).clip(emit);
    }
  }
  return result;
}

}  // namespace brushfire
