// Landmark multidimensional scaling, and what it does to lengths, angles and distances.
#include <brushfire/queries/flatten.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/cut.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/queries/sampling.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace brushfire {
namespace {

// A symmetric matrix, and its eigenvectors by Jacobi's rotations: a hundred rows take some ten milliseconds.
class Symmetric {
 public:
  explicit Symmetric(std::size_t n) : n_(n), a_(n * n, 0), v_(n * n, 0) {
    for (std::size_t i = 0; i < n; ++i) v_[i * n + i] = 1;
  }
  double& at(std::size_t i, std::size_t j) { return a_[i * n_ + j]; }

  void diagonalise() {
    constexpr int kSweeps = 60;  // six to ten are needed: convergence is quadratic
    for (int sweep = 0; sweep < kSweeps && off_diagonal() > std::numeric_limits<double>::epsilon() * norm(); ++sweep) {
      for (std::size_t p = 0; p < n_; ++p) {
        for (std::size_t q = p + 1; q < n_; ++q) rotate(p, q);
      }
    }
  }
  double value(std::size_t i) { return at(i, i); }
  double vector(std::size_t i, std::size_t row) const { return v_[row * n_ + i]; }

 private:
  double norm() const { return std::sqrt(std::inner_product(a_.begin(), a_.end(), a_.begin(), 0.0)); }
  double off_diagonal() {
    double sum = 0;
    for (std::size_t p = 0; p < n_; ++p) {
      for (std::size_t q = p + 1; q < n_; ++q) sum += 2 * at(p, q) * at(p, q);
    }
    return std::sqrt(sum);
  }
  void rotate(std::size_t p, std::size_t q) {
    if (at(p, q) == 0) return;
    const double theta = (at(q, q) - at(p, p)) / (2 * at(p, q));
    const double t = std::copysign(1 / (std::abs(theta) + std::hypot(1, theta)), theta);
    const double c = 1 / std::hypot(1, t), s = t * c;
    const auto turn = [&](double& x, double& y) {
      const double old = x;
      x = c * old - s * y;
      y = s * old + c * y;
    };
    for (std::size_t k = 0; k < n_; ++k) turn(at(k, p), at(k, q));
    for (std::size_t k = 0; k < n_; ++k) turn(at(p, k), at(q, k));
    for (std::size_t k = 0; k < n_; ++k) turn(v_[k * n_ + p], v_[k * n_ + q]);
  }

  std::size_t n_;
  std::vector<double> a_, v_;
};

using Rows = std::vector<std::vector<double>>;

// Distances from every landmark to every vertex, in mesh.unit(), whose squares are numbers.
Rows fields_of(const Mesh& mesh, std::span<const Index> landmarks, const DistanceOptions& options) {
  DistanceSolver solver(mesh);
  Rows rows;
  for (const Index l : landmarks) {
    const Source source{vertex_point(mesh, l)};
    rows.push_back(solver.distance(std::span(&source, 1), options).distance);
    for (double& d : rows.back()) d /= mesh.unit();
  }
  return rows;
}

std::vector<std::array<double, 2>> scaled(const Mesh& mesh, std::span<const Index> landmarks, const Rows& distance) {
  const std::size_t k = landmarks.size();
  std::vector<double> mean(k, 0);  // of squares, by landmark
  const auto square = [&](std::size_t i, Index v) { return distance[i][v] * distance[i][v]; };
  Symmetric gram(k);
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t j = 0; j < k; ++j) mean[i] += (square(i, landmarks[j]) + square(j, landmarks[i])) / 2;
    mean[i] /= static_cast<double>(k);
  }
  const double all = std::accumulate(mean.begin(), mean.end(), 0.0) / static_cast<double>(k);
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t j = 0; j < k; ++j) {
      const double both = (square(i, landmarks[j]) + square(j, landmarks[i])) / 2;
      gram.at(i, j) = -(both - mean[i] - mean[j] + all) / 2;
    }
  }
  gram.diagonalise();
  std::vector<std::size_t> order(k);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return gram.value(a) > gram.value(b); });
  std::vector<std::array<double, 2>> uv(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    if (mesh.corners(v).empty()) uv[v] = {kNone, kNone};
  }
  // Coordinates are of the size of the root of their axis' value, and rounded by what k terms of the first one's are,
  // over that root: of a lesser value there is nothing but rounding.
  const double rounding = static_cast<double>(k) * std::numeric_limits<double>::epsilon() * gram.value(order[0]);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double value = gram.value(order[axis]);
    if (!(value > std::max(0.0, rounding))) continue;  // on a line
    // The sign that makes the coordinate of the first landmark that has one positive: the same picture every time.
    std::size_t first = 0;
    while (first + 1 < k && std::abs(gram.vector(order[axis], first)) < 1e-9) ++first;
    const double factor = std::copysign(-0.5 / std::sqrt(value), gram.vector(order[axis], first));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (std::isnan(uv[v][axis])) continue;
      for (std::size_t i = 0; i < k; ++i) {
        uv[v][axis] += factor * gram.vector(order[axis], i) * (square(i, v) - mean[i]);
      }
    }
  }
  return uv;
}

// In mesh.unit(), both.
double stress_of(std::span<const Index> landmarks, const Rows& distance, std::span<const std::array<double, 2>> uv) {
  double missed = 0, all = 0;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const std::array<double, 2>& from = uv[landmarks[i]];
    for (std::size_t v = 0; v < uv.size(); ++v) {
      if (std::isnan(uv[v][0])) continue;
      const double flat = std::hypot(uv[v][0] - from[0], uv[v][1] - from[1]), d = distance[i][v];
      missed += (flat - d) * (flat - d);
      all += d * d;
    }
  }
  return all > 0 ? std::sqrt(missed / all) : 0;
}

Vec2 as_vector(const std::array<double, 2>& a) { return {a[0], a[1]}; }

void require_one_piece(const Mesh& mesh, const Rows& distance) {
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.corners(v).empty() || distance.front()[v] < kInfinity) continue;
    throw Error(ErrorCode::InvalidArgument, "the mesh is in several pieces (nothing leads to vertex " +
                                                std::to_string(v) + "): flatten them one at a time");
  }
}

Flattening laid_flat(Flattening flat, const FlattenOptions& options) {
  const Mesh& mesh = flat.mesh;
  DistanceOptions how = options.distance;
  how.targets.clear();
  how.keep_paths = how.keep_windows = false;
  const auto used =
      static_cast<Index>(std::count_if(flat.original_vertex.begin(), flat.original_vertex.end(),
                                       [&, v = Index{0}](Index) mutable { return !mesh.corners(v++).empty(); }));
  flat.landmarks = farthest_points(mesh, std::min(options.landmarks, used), {}, how).vertices;
  const Rows distance = fields_of(mesh, flat.landmarks, how);
  require_one_piece(mesh, distance);
  flat.uv = scaled(mesh, flat.landmarks, distance);
  const double stress = stress_of(flat.landmarks, distance, flat.uv);
  for (std::array<double, 2>& p : flat.uv) p = {p[0] * mesh.unit(), p[1] * mesh.unit()};
  flat.distortion = distortion_of(mesh, flat.uv);
  flat.distortion.stress = stress;
  return flat;
}

void check(const Mesh& mesh, const FlattenOptions& options) {
  if (options.landmarks < 3) throw Error(ErrorCode::InvalidArgument, "flattening needs at least 3 landmarks");
  if (mesh.face_count() == 0) throw Error(ErrorCode::InvalidArgument, "flattening needs a mesh with faces");
  if (!mesh.has_positions()) throw Error(ErrorCode::InvalidArgument, "flattening needs a mesh with positions");
}

}  // namespace

Distortion distortion_of(const Mesh& mesh, std::span<const std::array<double, 2>> uv) {
  if (uv.size() != mesh.vertex_count()) {
    throw Error(ErrorCode::InvalidArgument,
                std::to_string(uv.size()) + " coordinates for " + std::to_string(mesh.vertex_count()) + " vertices");
  }
  Distortion d{0, 0, 0, kInfinity, 0, 0};
  double area = 0, turned_area = 0;
  Index turned = 0, faces = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const double double_area = mesh.double_areas()[f];  // in mesh.unit(), as all here
    if (!(double_area > 0)) continue;
    const Face& t = mesh.faces()[f];
    const std::array<Vec2, 3> flat = flat_corners(mesh, f);
    const Vec2 a = flat[1] - flat[0], b = flat[2] - flat[0];
    const auto edge = [&](Index to) { return (1 / mesh.unit()) * (as_vector(uv[t[to]]) - as_vector(uv[t[0]])); };
    const Vec2 p = edge(1), q = edge(2);
    // The map's matrix: takes a to p and b to q.
    const double det = cross(a, b);
    const Vec2 x = (1 / det) * (b.y * p - a.y * q), y = (1 / det) * (a.x * q - b.x * p);
    const double sum = dot(x, x) + dot(y, y), turn = cross(x, y);
    const double root = std::sqrt(std::max(0.0, sum * sum - 4 * turn * turn));
    const double s1 = std::sqrt((sum + root) / 2), s2 = s1 > 0 ? std::abs(turn) / s1 : 0;
    area += double_area;
    if (turn < 0) {
      ++turned;
      turned_area += double_area;
    }
    ++faces;
    d.stretch += double_area * sum / 2;
    d.angle += double_area * (s1 / s2 + s2 / s1) / 2;
    d.max_stretch = std::max(d.max_stretch, s1);
    d.min_stretch = std::min(d.min_stretch, s2);
  }
  if (faces == 0) return {};
  d.stretch = std::sqrt(d.stretch / area);
  d.angle /= area;
  d.flipped = turned_area > area / 2 ? faces - turned : turned;
  return d;
}

std::vector<std::array<double, 2>> in_unit_square(std::span<const std::array<double, 2>> uv) {
  std::array<double, 2> low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (const std::array<double, 2>& p : uv) {
    for (std::size_t k = 0; k < 2; ++k) {
      if (std::isnan(p[k])) continue;
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  const double extent = std::max(high[0] - low[0], high[1] - low[1]);
  const double scale = extent > 0 ? 1 / extent : 1;
  std::vector<std::array<double, 2>> result;
  for (const std::array<double, 2>& p : uv) {
    result.push_back({std::min(1.0, scale * (p[0] - low[0])), std::min(1.0, scale * (p[1] - low[1]))});
  }
  return result;
}

Flattening flatten(const Mesh& mesh, const FlattenOptions& options) {
  check(mesh, options);
  if (!options.cut) return flatten(Domain(mesh), options);
  Index first = 0;
  while (first + 1 < mesh.vertex_count() && mesh.corners(first).empty()) ++first;
  // From a place far out, so that seams run in from the rim.
  DistanceOptions how;
  const Index base = farthest_points(mesh, 2, std::span(&first, 1), how).vertices.back();
  const std::vector<std::array<Index, 2>> seams = cut_to_disc(mesh, base);
  return flatten(Domain(mesh, Barriers{{}, {}, seams}), options);
}

Flattening flatten(const Domain& domain, const FlattenOptions& options) {
  check(domain.mesh(), options);
  Flattening flat;
  flat.mesh = domain.open();
  for (Index v = 0; v < flat.mesh.vertex_count(); ++v) flat.original_vertex.push_back(domain.vertex(v));
  for (Index f = 0; f < flat.mesh.face_count(); ++f) flat.original_face.push_back(domain.face(f));
  return laid_flat(std::move(flat), options);
}

}  // namespace brushfire
