// Nearest surface point: a packed R-tree over the faces' boxes (Boost.Geometry), then the exact point of each triangle.
#include <brushfire/mesh/nearest_point.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

namespace brushfire {
namespace {

namespace bg = boost::geometry;
using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<TreePoint>;
using TreeItem = std::pair<TreeBox, Index>;
using Tree = bg::index::rtree<TreeItem, bg::index::rstar<16>>;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// The largest coordinate becomes 2^200, so that the fourth powers of lengths neither overflow nor, for faces 1e100
// times smaller, vanish; positions are taken up to 2^200 times farther out.
constexpr double kLargest = 0x1p200;
constexpr double kFarthest = 0x1p400;

struct Candidate {
  std::array<double, 3> weights{1, 0, 0};
  Vec3 point;
  double distance = kInfinity;
};

Vec3 blend(const std::array<Vec3, 3>& corner, const std::array<double, 3>& w) {
  // From the heaviest corner, which keeps the digits of a point next to a corner.
  const std::size_t k = static_cast<std::size_t>(std::max_element(w.begin(), w.end()) - w.begin());
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  return corner[k] + (w[i] * (corner[i] - corner[k]) + w[j] * (corner[j] - corner[k]));
}

void offer(Candidate& best, Vec3 p, const std::array<Vec3, 3>& corner, const std::array<double, 3>& weights) {
  const Vec3 q = blend(corner, weights);
  const double d = norm(p - q);
  if (d < best.distance) best = {weights, q, d};
}

// The share of the way along the segment from a to b that is nearest to p; measured from the nearer end.
double nearest_share(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 e = b - a;
  const double ee = dot(e, e);
  if (!(ee > 0)) return 0;
  const double from_a = dot(p - a, e) / ee;
  return std::clamp(from_a > 0.5 ? 1 - dot(b - p, e) / ee : from_a, 0.0, 1.0);
}

// Corners, edges and inside are all offered, and whatever is nearest wins: for a face without area the inside is
// nowhere or just another point of the face, so no case needs to be told apart.
Candidate nearest_in_triangle(Vec3 p, const std::array<Vec3, 3>& corner) {
  Candidate best;
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<double, 3> weights{0, 0, 0};
    weights[k] = 1;
    offer(best, p, corner, weights);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const double t = nearest_share(p, corner[k], corner[next]);
    std::array<double, 3> weights{0, 0, 0};
    weights[k] = 1 - t;
    weights[next] = t;
    if (t > 0 && t < 1) offer(best, p, corner, weights);
  }
  const Vec3 normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double nn = dot(normal, normal);
  if (!(nn > 0)) return best;
  std::array<double, 3> weights{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 a = corner[(k + 1) % 3], b = corner[(k + 2) % 3];
    weights[k] = dot(cross(b - a, p - a), normal) / nn;
    if (!(weights[k] > 0)) return best;
  }
  const double sum = weights[0] + weights[1] + weights[2];
  for (double& w : weights) w /= sum;
  offer(best, p, corner, weights);
  return best;
}

// Moves a point to a corner or an edge that is as near as coordinates are rounded.
std::array<double, 3> snapped(const Candidate& c, Vec3 p, const std::array<Vec3, 3>& corner) {
  double size = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  for (const Vec3& q : corner) size = std::max({size, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
  const double rounding = 8 * kEpsilon * size;
  for (std::size_t k = 0; k < 3; ++k) {
    if (norm(c.point - corner[k]) > rounding) continue;
    std::array<double, 3> weights{0, 0, 0};
    weights[k] = 1;
    return weights;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const double t = nearest_share(c.point, corner[k], corner[next]);
    std::array<double, 3> weights{0, 0, 0};
    weights[k] = 1 - t;
    weights[next] = t;
    if (norm(c.point - blend(corner, weights)) <= rounding) return weights;
  }
  return c.weights;
}

// Never below 2^-1000, where numbers begin to lose bits.
double unit_for(double largest) {
  return largest > 0 ? std::max(0x1p-1000, std::ldexp(1 / kLargest, std::ilogb(largest) + 1)) : 1.0;
}

}  // namespace

struct NearestPointFinder::Data {
  Mesh mesh;
  double size = 1;  // a power of two: the largest coordinate of a face over kLargest; the tree is in its units
  Tree tree;

  std::array<Vec3, 3> corners(Index f) const {
    std::array<Vec3, 3> result;
    for (std::size_t k = 0; k < 3; ++k) result[k] = scaled(mesh.positions()[mesh.faces()[f][k]]);
    return result;
  }
  Vec3 scaled(Vec3 p) const { return {p.x / size, p.y / size, p.z / size}; }
};

NearestPointFinder::NearestPointFinder(const Mesh& mesh) {
  if (!mesh.has_positions() || mesh.face_count() == 0) {
    throw Error(ErrorCode::InvalidArgument, mesh.face_count() == 0 ? "a mesh without faces has no nearest point"
                                                                   : "a mesh from lengths has no place in space");
  }
  auto data = std::make_shared<Data>();
  data->mesh = mesh;
  double largest = 0;
  for (const Face& t : mesh.faces()) {
    for (const Index v : t) {
      const Vec3 p = mesh.positions()[v];
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
  }
  data->size = unit_for(largest);
  std::vector<TreeItem> items;
  items.reserve(mesh.face_count());
  Poll poll;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    poll();
    const auto [a, b, c] = data->corners(f);
    items.emplace_back(TreeBox({std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
                               {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}),
                       f);
  }
  stop_if_cancelled();
  data->tree = Tree(items.begin(), items.end());
  data_ = std::move(data);
}

NearestPoint NearestPointFinder::operator()(Vec3 position) const {
  const Vec3 p = data_->scaled(position);
  const bool near_enough = std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest && std::abs(p.z) < kFarthest;
  if (!near_enough) {
    throw Error(ErrorCode::InvalidArgument, "position (" + number_as_text(position.x) + ", " +
                                                number_as_text(position.y) + ", " + number_as_text(position.z) +
                                                ") is not finite, or more than 1e60 times as far out as the mesh");
  }
  const TreePoint at(p.x, p.y, p.z);
  Candidate best;
  Index best_face = kNoIndex;
  // The faces of the nearest boxes, more and more of them, until the farthest of these boxes is farther than the best
  // point, rounding aside. (The library's iterator, which would give them one by one, takes quadratic time.)
  std::vector<TreeItem> near;
  for (std::size_t count = 8;; count *= 8) {
    near.clear();
    const unsigned asked = static_cast<unsigned>(std::min(count, data_->tree.size()));
    data_->tree.query(bg::index::nearest(at, asked), std::back_inserter(near));
    double farthest = 0;
    for (const auto& [box, face] : near) {
      farthest = std::max(farthest, bg::comparable_distance(at, box));
      const Candidate c = nearest_in_triangle(p, data_->corners(face));
      if (std::pair(c.distance, face) < std::pair(best.distance, best_face)) {
        best = c;
        best_face = face;
      }
    }
    if (asked == data_->tree.size() || farthest > best.distance * best.distance * (1 + 8 * kEpsilon)) break;
  }
  return {{best_face, snapped(best, p, data_->corners(best_face))}, best.distance * data_->size};
}

std::vector<NearestPoint> NearestPointFinder::operator()(std::span<const Vec3> positions) const {
  std::vector<NearestPoint> result;
  result.reserve(positions.size());
  Poll poll(64);
  for (const Vec3& p : positions) {
    poll();
    result.push_back((*this)(p));
  }
  return result;
}

}  // namespace brushfire
