// Linear isolines of a finer mesh whose vertices have exact values and tell how the level sets run; then every node
// moved onto its level, and arcs between them.
#include <brushfire/queries/curved_isolines.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/memory.h>
#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/queries/detail/level_mesh.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace brushfire {
namespace {

// A place in one face of the coarse mesh.
struct Place {
  Index face = kNoIndex;
  std::array<double, 3> weights{0, 0, 0};
};

std::array<double, 3> between(const std::array<double, 3>& a, const std::array<double, 3>& b, double t) {
  return {(1 - t) * a[0] + t * b[0], (1 - t) * a[1] + t * b[1], (1 - t) * a[2] + t * b[2]};
}

class CurveBuilder {
 public:
  CurveBuilder(const WindowField& field, const detail::LevelMesh& fine, double chord_error)
      : field_(field), mesh_(field.mesh()), fine_(fine), chord_error_(chord_error) {}

  // The fine mesh's isoline, its nodes on the level and arcs between them.
  Isoline refined(const Isoline& coarse) {
    level_ = coarse.level;
    std::vector<SurfacePoint> nodes;
    for (const SurfacePoint& p : coarse.line.points) {
      stop_if_cancelled();
      nodes.push_back(on_level(p));
    }
    Isoline out = coarse;
    out.line.points.clear();
    const std::size_t n = nodes.size();
    for (std::size_t i = 0; i < n; ++i) {
      append(out.line.points, nodes[i]);
      const bool last = i + 1 == n;
      if (last && !coarse.line.closed) break;
      const std::size_t j = (i + 1) % n;
      const Index face = parent_of(coarse.line.points[i], coarse.line.points[j]);
      bend(Place{face, weights_of(nodes[i], face)}, Place{face, weights_of(nodes[j], face)}, 0, out.line.points);
    }
    if (out.line.closed && out.line.points.size() > 1 && same(out.line.points.front(), out.line.points.back())) {
      out.line.points.pop_back();
    }
    out.line.length = length_of(mesh_, out.line.points, out.line.closed);
    finished_ += out.line.points.size();
    return out;
  }

 private:
  double value(const Place& p) const { return field_.value({p.face, p.weights}).distance; }

  std::array<double, 3> weights_of(const SurfacePoint& p, Index face) const {
    return *weights_in(mesh_, locate(mesh_, p), face);
  }

  // Nodes of isolines() lie on edges of the fine mesh: along it, to where the exact value is the level.
  SurfacePoint on_level(const SurfacePoint& fine_point) const {
    const Face& t = fine_.mesh().faces()[fine_point.face];
    std::array<Index, 3> end{};
    std::size_t ends = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (fine_point.weights[k] > 0) end[ends++] = t[k];
    }
    if (ends < 2) return fine_.origin(end[0]);
    const Index face = fine_.parent(fine_point.face);
    const std::array<double, 3> a = weights_of(fine_.origin(end[0]), face), b = weights_of(fine_.origin(end[1]), face);
    const double t_level = root([&](double s) { return value({face, between(a, b, s)}) - level_; },
                                fine_.values()[end[0]] - level_, fine_.values()[end[1]] - level_);
    return {face, between(a, b, t_level)};
  }

  // Where f changes sign in [0, 1]: false position that halves a stuck end (Illinois).
  template <class F>
  static double root(F&& f, double at_0, double at_1) {
    double a = 0, b = 1;
    if (at_0 == 0) return 0;
    if (at_1 == 0 || (at_0 < 0) == (at_1 < 0)) return 1;
    constexpr int kSteps = 60;
    for (int i = 0; i < kSteps && b - a > 1e-15; ++i) {
      const double c = std::clamp(a + (b - a) * at_0 / (at_0 - at_1), a, b);
      const double at = f(c), at_c = at < kInfinity ? at : std::max(std::abs(at_0), std::abs(at_1));
      if (at_c == 0) return c;
      if ((at_c < 0) == (at_1 < 0)) {
        if (c == b) return c;
        b = c;
        at_1 = at_c;
        at_0 *= 0.5;
      } else {
        if (c == a) return c;
        a = c;
        at_0 = at_c;
        at_1 *= 0.5;
      }
    }
    return 0.5 * (a + b);
  }

  Index parent_of(const SurfacePoint& p, const SurfacePoint& q) const {
    return fine_.parent(common_face(fine_.mesh(), locate(fine_.mesh(), p), locate(fine_.mesh(), q), p.face));
  }

  // A place whose value differs from the level by less than this share of it is on it: the value is known no better.
  static constexpr double kOnLevel = 1e-14;

  // Nodes between a and b, which lie on the level in one face, until the pieces are near enough to the arc.
  void bend(const Place& a, const Place& b, int depth, std::vector<SurfacePoint>& points) const {
    constexpr int kDeepest = 12;
    const std::array<Vec2, 3> corners = flat_corners(mesh_, a.face);
    const Vec2 chord = flat_difference(corners, a.weights, b.weights);
    const double length = norm(chord);
    stop_if_cancelled();
    if (depth == kDeepest || !(length * mesh_.unit() > chord_error_)) return;
    Place middle{a.face, between(a.weights, b.weights, 0.5)};
    const double miss = value(middle) - level_;
    if (std::abs(miss) <= std::max(chord_error_, kOnLevel * std::abs(level_))) return;
    if (!slide_to_level(corners, (1 / length) * Vec2{chord.y, -chord.x}, miss, middle)) return;
    bend(a, middle, depth + 1, points);
    append(points, {middle.face, middle.weights});
    bend(middle, b, depth + 1, points);
  }

  // Across the chord, to where the value is the level; false where that is outside of the face.
  bool slide_to_level(const std::array<Vec2, 3>& corners, Vec2 across, double miss, Place& place) const {
    const std::array<double, 3> start = place.weights;
    const double area = cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (!(area > 0)) return false;
    const auto moved = [&](double s) {  // s in mesh.unit()
      const Vec2 d = s * across;
      const double w1 = cross(d, corners[2] - corners[0]) / area, w2 = cross(corners[1] - corners[0], d) / area;
      return Place{place.face, {start[0] - w1 - w2, start[1] + w1, start[2] + w2}};
    };
    const auto inside = [](const Place& p) {
      return std::all_of(p.weights.begin(), p.weights.end(), [](double w) { return w >= 0; });
    };
    // The value changes at most by the distance, and along the chord's normal nearly by it: on one of the two sides.
    for (const double side : {-1.0, 1.0}) {
      double s0 = 0, f0 = miss, s1 = side * miss / mesh_.unit();
      for (int i = 0; i < 12; ++i) {
        const Place p = moved(s1);
        if (!inside(p)) break;
        const double f1 = value(p) - level_;
        if (std::abs(f1) <= kOnLevel * std::abs(level_)) {
          place = p;
          return true;
        }
        if (f1 == f0 || (i == 0 && std::abs(f1) > std::abs(f0))) break;
        const double s2 = s1 - f1 * (s1 - s0) / (f1 - f0);
        s0 = s1;
        f0 = f1;
        s1 = s2;
        if (s1 == s0) {
          place = p;
          return true;
        }
      }
    }
    return false;
  }

  bool same(const SurfacePoint& p, const SurfacePoint& q) const {
    const auto w = weights_in(mesh_, locate(mesh_, p), q.face);
    if (!w) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::abs((*w)[k] - q.weights[k]) > kWeightSnap) return false;
    }
    return true;
  }

  void append(std::vector<SurfacePoint>& points, const SurfacePoint& p) const {
    if (points.empty() || !same(points.back(), p)) points.push_back(p);
    if (points.size() % kLookAtMemory == 0) check_size(finished_ + points.size());
  }

  // How many nodes arcs take shows only when they have been followed.
  void check_size(std::size_t nodes) const {
    if (nodes < kLookAtMemory) return;
    constexpr std::size_t kCopies = 2;  // a list that grows is in memory twice
    require_memory(
        kCopies * nodes * sizeof(SurfacePoint), memory_,
        "more than " + std::to_string(nodes) + " nodes within a chord error of " + number_as_text(chord_error_),
        "ask for a larger chord error");
  }

  const WindowField& field_;
  const Mesh& mesh_;
  const detail::LevelMesh& fine_;
  double chord_error_;
  double level_ = 0;
  std::size_t finished_ = 0;  // nodes of the lines so far

  static constexpr std::size_t kLookAtMemory = std::size_t{1} << 17;
  const std::uint64_t memory_ = available_memory();
};

}  // namespace

std::vector<Isoline> curved_isolines(const WindowField& field, std::span<const double> levels, double chord_error) {
  if (!(chord_error > 0)) {
    throw Error(ErrorCode::InvalidArgument, "chord error " + number_as_text(chord_error) + " is not > 0");
  }
  isolines(Mesh(), {}, levels);  // throws what it throws for levels
  const detail::LevelMesh fine(field, levels, chord_error);
  std::vector<Isoline> out;
  CurveBuilder builder(field, fine, chord_error);
  for (const Isoline& line : isolines(fine.mesh(), fine.values(), levels)) {
    Isoline curve = builder.refined(line);
    if (curve.line.points.size() > 1) out.push_back(std::move(curve));
  }
  return out;
}

}  // namespace brushfire
