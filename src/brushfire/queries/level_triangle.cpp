// First what is far from the level, then what is in the disc of one front, then where all fronts agree which way is up.
#include <brushfire/queries/detail/level_triangle.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace brushfire::detail {
namespace {

using windows::FaceFront;

// Rounding of places in a face, whose lengths are near one or less.
constexpr double kPlaces = 1e-13;

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 side = b - a;
  const double length2 = dot(side, side);
  const double t = length2 > 0 ? std::clamp(dot(p - a, side) / length2, 0.0, 1.0) : 0;
  return norm(p - (a + t * side));
}

class Triangle {
 public:
  Triangle(const LevelTriangle& triangle, double level, std::span<const FaceFront> fronts, double room)
      : p_(triangle.corners), v_(triangle.values), level_(level), room_(room) {
    for (const FaceFront& front : fronts) {
      if (comes_to(front) && least(front) < level_) near_.push_back({&front, lights_all(front)});
    }
    drop_dominated();
  }

  bool corners_tell() const {
    if (near_.empty()) return true;  // the whole triangle is above the level
    const bool all_below = std::all_of(v_.begin(), v_.end(), [&](double v) { return v < level_; });
    if (all_below && std::any_of(near_.begin(), near_.end(), [&](const Near& n) { return covers(n); })) return true;
    if (!has_no_loop()) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!side_is_told(k, (k + 1) % 3)) return false;
    }
    return true;
  }

 private:
  // A front that may bring values below the level to the triangle.
  struct Near {
    const FaceFront* front;
    bool lights_all;  // comes to every point of it
  };

  // Each border is a line: the triangle lies on one side of it if its corners do.
  bool comes_to(const FaceFront& f) const {
    for (int i = 0; i < f.border_count; ++i) {
      if (std::all_of(p_.begin(), p_.end(), [&](Vec2 p) { return beyond(f.borders[i], p) < -kPlaces; })) return false;
    }
    return true;
  }
  bool lights_all(const FaceFront& f) const {
    return std::all_of(p_.begin(), p_.end(), [&](Vec2 p) { return lights(f, p); });
  }
  static bool lights(const FaceFront& f, Vec2 p) {
    for (int i = 0; i < f.border_count; ++i) {
      if (beyond(f.borders[i], p) < -kPlaces) return false;
    }
    return true;
  }
  static double beyond(const FaceFront::Border& b, Vec2 p) { return dot(p - b.point, b.inward); }

  // The least value of a front that comes from anywhere: in the triangle, on one of its sides.
  double least(const FaceFront& f) const {
    if (f.parallel) return std::min({f.value(p_[0]), f.value(p_[1]), f.value(p_[2])});
    if (holds(f.source)) return f.sigma;
    return std::min({least_on(f, 0, 1), least_on(f, 1, 2), least_on(f, 2, 0)});
  }
  double least_on(const FaceFront& f, std::size_t a, std::size_t b) const {
    if (f.parallel) return std::min(f.value(p_[a]), f.value(p_[b]));
    return f.sigma + distance_to_segment(f.source, p_[a], p_[b]);
  }
  bool holds(Vec2 q) const {
    const double a = cross(p_[1] - p_[0], q - p_[0]), b = cross(p_[2] - p_[1], q - p_[1]),
                 c = cross(p_[0] - p_[2], q - p_[2]);
    return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
  }

  // A point source that another front comes to as early as it begins is later than that one everywhere: walking on from
  // it is one way among others.
  void drop_dominated() {
    const auto is_dominated = [&](const Near& late) {
      if (late.front->parallel) return false;
      return std::any_of(near_.begin(), near_.end(), [&](const Near& early) {
        if (early.front == late.front || !early.lights_all) return false;
        const double there = early.front->value(late.front->source);
        if (there > late.front->sigma + room_) return false;
        // Of two that are the same but for rounding the first stays.
        const bool mutual = late.lights_all && !early.front->parallel &&
                            late.front->value(early.front->source) <= early.front->sigma + room_;
        return !mutual || early.front < late.front;
      });
    };
    std::vector<Near> left;
    for (const Near& n : near_) {
      if (!is_dominated(n)) left.push_back(n);
    }
    near_ = std::move(left);
  }

  // One disc that holds all three corners, which light comes to, holds what is between.
  bool covers(const Near& n) const {
    return n.lights_all && std::all_of(p_.begin(), p_.end(), [&](Vec2 p) { return n.front->value(p) < level_; });
  }

  // A closed curve would need a place inside where the value is least or largest: not where it grows in one direction
  // everywhere, and not where the only disc has its middle elsewhere.
  bool has_no_loop() const {
    if (near_.size() == 1) {
      const FaceFront& f = *near_.front().front;
      return f.parallel || !holds(f.source);
    }
    const Vec2 middle = (1.0 / 3) * (p_[0] + p_[1] + p_[2]);
    Vec2 up{0, 0};
    for (const Near& n : near_) {
      const Vec2 way = n.front->way(middle);
      const double length = norm(way);
      if (!(length > 0)) return false;
      up = up + (1 / length) * way;
    }
    return std::all_of(near_.begin(), near_.end(), [&](const Near& n) {
      return std::all_of(p_.begin(), p_.end(), [&](Vec2 p) { return dot(n.front->way(p), up) > 0; });
    });
  }

  bool side_is_told(std::size_t a, std::size_t b) const {
    if (grows_along(a, b, 1) || grows_along(a, b, -1)) return true;
    const bool a_below = v_[a] < level_, b_below = v_[b] < level_;
    if (a_below != b_below) return near_.size() == 1;  // the interval of one disc
    if (!a_below) {
      return std::all_of(near_.begin(), near_.end(),
                         [&](const Near& n) { return least_on(*n.front, a, b) >= level_ - room_; });
    }
    return std::any_of(near_.begin(), near_.end(), [&](const Near& n) {
      const FaceFront& f = *n.front;
      return lights(f, p_[a]) && lights(f, p_[b]) && f.value(p_[a]) < level_ && f.value(p_[b]) < level_;
    });
  }
  bool grows_along(std::size_t a, std::size_t b, double sense) const {
    const Vec2 side = sense * (p_[b] - p_[a]);
    return std::all_of(near_.begin(), near_.end(), [&](const Near& n) {
      return dot(n.front->way(p_[a]), side) >= 0 && dot(n.front->way(p_[b]), side) >= 0;
    });
  }

  const std::array<Vec2, 3>& p_;
  const std::array<double, 3>& v_;
  double level_, room_;
  std::vector<Near> near_;
};

}  // namespace

bool corners_tell(const LevelTriangle& triangle, double level, std::span<const FaceFront> fronts, double room) {
  const auto& p = triangle.corners;
  const auto& v = triangle.values;
  const double longest = std::max({norm(p[1] - p[0]), norm(p[2] - p[1]), norm(p[0] - p[2])});
  double low = kInfinity, high = -kInfinity;
  for (const double value : v) {
    if (!std::isfinite(value)) continue;  // farther than the run went
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (high - longest >= level || low + longest < level) return true;  // the value changes at most by the distance
  return Triangle(triangle, level, fronts, room).corners_tell();
}

}  // namespace brushfire::detail
