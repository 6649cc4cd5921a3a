#include <brushfire/solvers/vector_heat.h>

#include <brushfire/core/error.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/heat/connection.h>
#include <brushfire/solvers/heat/system.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace brushfire {

using heat::Complex;

struct VectorHeatSolver::State {
  State(const Mesh& given, const HeatOptions& how)
      : mesh(given), options(how), system(given, how.delaunay, how.time_factor, how.time) {}

  Mesh mesh;
  HeatOptions options;
  heat::VectorSystem system;
  std::optional<DistanceSolver> radius;  // for LogMapStrategy::VectorHeat

  void check(std::span<const Index> vertices, std::size_t values) const;
  std::vector<double> warmth(std::span<const Index> vertices, std::span<const double> values);
  std::vector<Complex> carried(std::span<const Index> vertices, std::span<const Complex> vectors);
  std::vector<Complex> affine(Index source, bool adaptive);
  std::vector<Complex> polar(Index source);
};

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

HeatOptions checked(const HeatOptions& options) {
  heat::check(options);
  return options;
}

// Of length 1; NaN for what has none.
Complex unit(Complex z) {
  const double length = std::abs(z);
  return length > 0 ? z / length : Complex(kNone, kNone);
}

}  // namespace

VectorHeatSolver::VectorHeatSolver(const Mesh& mesh, const HeatOptions& options)
    : state_(std::make_unique<State>(mesh, checked(options))) {}
VectorHeatSolver::~VectorHeatSolver() = default;
VectorHeatSolver::VectorHeatSolver(VectorHeatSolver&&) noexcept = default;
VectorHeatSolver& VectorHeatSolver::operator=(VectorHeatSolver&&) noexcept = default;

double VectorHeatSolver::time() const { return state_->system.time() * state_->mesh.unit() * state_->mesh.unit(); }

void VectorHeatSolver::State::check(std::span<const Index> vertices, std::size_t values) const {
  if (vertices.empty()) throw Error(ErrorCode::InvalidArgument, "no vertex given to start from");
  if (vertices.size() != values) {
    throw Error(ErrorCode::InvalidArgument,
                std::to_string(vertices.size()) + " vertices and " + std::to_string(values) + " values: one each");
  }
  for (const Index v : vertices) vertex_point(mesh, v);  // throws for one that cannot be
}

std::vector<double> VectorHeatSolver::State::warmth(std::span<const Index> vertices, std::span<const double> values) {
  std::vector<double> u(mesh.vertex_count(), 0.0);
  for (std::size_t i = 0; i < vertices.size(); ++i) u[vertices[i]] += values[i];
  system.scalar_heat().solve(0, 1, u);
  return u;
}

std::vector<double> VectorHeatSolver::extend(std::span<const Index> vertices, std::span<const double> values) {
  state_->check(vertices, values.size());
  for (const double value : values) {
    if (!std::isfinite(value)) throw Error(ErrorCode::InvalidArgument, "a value to extend is not finite");
  }
  // The values over their least, in proportion to their range, keep all sums positive.
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double range = *high - *low;
  std::vector<double> scaled;
  for (const double value : values) scaled.push_back(range > 0 ? (value - *low) / range : 0);
  const std::vector<double> ones(vertices.size(), 1.0);
  std::vector<double> result = state_->warmth(vertices, scaled);
  const std::vector<double> all = state_->warmth(vertices, ones);
  for (std::size_t v = 0; v < result.size(); ++v) {
    result[v] = all[v] > 0 ? *low + range * std::clamp(result[v] / all[v], 0.0, 1.0) : kNone;
  }
  return result;
}

std::vector<Complex> VectorHeatSolver::State::carried(std::span<const Index> vertices,
                                                      std::span<const Complex> vectors) {
  std::vector<Complex> x(mesh.vertex_count());
  for (std::size_t i = 0; i < vertices.size(); ++i) x[vertices[i]] += vectors[i];
  system.vector_heat().solve(0, 1, x);
  return x;
}

std::vector<Complex> VectorHeatSolver::transport(std::span<const Index> vertices, std::span<const Complex> vectors) {
  state_->check(vertices, vectors.size());
  std::vector<Complex> directions;
  std::vector<double> lengths;
  for (const Complex& z : vectors) {
    lengths.push_back(std::abs(z));
    directions.push_back(lengths.back() > 0 ? z / lengths.back() : Complex());
  }
  std::vector<Complex> x = state_->carried(vertices, directions);
  const std::vector<double> length = extend(vertices, lengths);
  for (std::size_t v = 0; v < x.size(); ++v) x[v] = length[v] == 0 ? Complex() : length[v] * unit(x[v]);
  return x;
}

// The coordinates of the source's own place, 0, carried along with the heat: in passing an edge from j to i they turn
// with the frames, and grow by the edge.
std::vector<Complex> VectorHeatSolver::State::affine(Index source, bool adaptive) {
  const heat::Triangulation& t = system.triangulation();
  const std::vector<double> one{1.0};
  const std::vector<double> heat = warmth({&source, 1}, one);
  const Complex axis = 1;
  std::vector<Complex> parallel = carried({&source, 1}, {&axis, 1});
  for (Complex& z : parallel) z = unit(z);
  std::vector<Complex> x(mesh.vertex_count());
  for (Index h = 0; h < t.tail.size(); ++h) {
    const Index a = t.tail[h], b = t.tail[Mesh::next(h)];
    const double weight = system.time() * heat::half_cotangent(t, h) * t.length[h];
    const auto in_frame = [&](Complex z, Index v) {
      return adaptive && !std::isnan(parallel[v].real()) ? z / parallel[v] : z;
    };
    x[a] -= weight * heat[b] * in_frame(heat::direction(t, system.spaces(), h), a);
    x[b] -= weight * heat[a] * in_frame(heat::direction_back(t, system.spaces(), h), b);
  }
  if (adaptive) {
    std::vector<double> columns(2 * x.size());
    for (std::size_t v = 0; v < x.size(); ++v) {
      columns[2 * v] = x[v].real();
      columns[2 * v + 1] = x[v].imag();
    }
    system.scalar_heat().solve(0, 2, columns);
    for (std::size_t v = 0; v < x.size(); ++v) x[v] = {columns[2 * v], columns[2 * v + 1]};
  } else {
    system.vector_heat().solve(0, 1, x);
  }
  for (std::size_t v = 0; v < x.size(); ++v) {
    x[v] = heat[v] > 0 ? x[v] / heat[v] / (adaptive ? Complex(1) : parallel[v]) : Complex(kNone, kNone);
  }
  return x;
}

std::vector<Complex> VectorHeatSolver::State::polar(Index source) {
  const heat::Triangulation& t = system.triangulation();
  const Complex axis = 1;
  const std::vector<Complex> parallel = carried({&source, 1}, {&axis, 1});
  // Outwards from the source. With these weights, edge vectors around a flat vertex sum to 0: what does not cancel
  // would outlast the rest on its way.
  std::vector<Index> neighbours;
  std::vector<Complex> outward;
  for (Index h = 0; h < t.tail.size(); ++h) {
    const Index a = t.tail[h], b = t.tail[Mesh::next(h)];
    if (a == b || (a != source && b != source)) continue;
    const double weight = heat::half_cotangent(t, h) * t.length[h];
    neighbours.push_back(a == source ? b : a);
    outward.push_back(
        -weight * (a == source ? heat::direction_back(t, system.spaces(), h) : heat::direction(t, system.spaces(), h)));
  }
  const std::vector<Complex> radial = carried(neighbours, outward);
  if (!radius) radius.emplace(mesh);
  DistanceOptions how;
  how.method = Method::Heat;
  how.heat = {options.time_factor, options.time, HeatBoundary::Neumann, options.delaunay};
  const Source from{vertex_point(mesh, source)};
  const std::vector<double> distance = radius->distance({&from, 1}, how).distance;
  std::vector<Complex> x(mesh.vertex_count());
  for (std::size_t v = 0; v < x.size(); ++v) {
    x[v] = distance[v] < kInfinity ? distance[v] / mesh.unit() * unit(radial[v] / unit(parallel[v]))
                                   : Complex(kNone, kNone);
  }
  return x;
}

std::vector<Complex> VectorHeatSolver::log_map(Index source, LogMapStrategy strategy) {
  vertex_point(state_->mesh, source);
  std::vector<Complex> x = strategy == LogMapStrategy::VectorHeat
                               ? state_->polar(source)
                               : state_->affine(source, strategy == LogMapStrategy::AffineAdaptive);
  const Complex origin = strategy == LogMapStrategy::VectorHeat ? Complex() : x[source];
  for (Complex& z : x) z = (z - origin) * state_->mesh.unit();
  x[source] = 0;
  return x;
}

VectorHeatSolver::Frames VectorHeatSolver::tangent_frames() const {
  const Mesh& mesh = state_->mesh;
  if (!mesh.has_positions()) throw Error(ErrorCode::InvalidArgument, "a mesh without positions has no frames in space");
  const std::span<const Vec3> p = mesh.positions();
  const auto normalized = [](Vec3 a) { return norm(a) > 0 ? (1 / norm(a)) * a : Vec3{}; };
  const std::size_t n = mesh.vertex_count();
  Frames frames{std::vector<Vec3>(n), std::vector<Vec3>(n), std::vector<Vec3>(n)};
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const Vec3 a = p[mesh.to(h)] - p[mesh.from(h)], b = p[mesh.from(Mesh::previous(h))] - p[mesh.from(h)];
    frames.normal[mesh.from(h)] = frames.normal[mesh.from(h)] + mesh.corner_angle(h) * normalized(cross(a, b));
  }
  for (Vec3& a : frames.normal) a = normalized(a);
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    if (state_->system.mesh_bearings()[h] != 0) continue;  // the first edge
    const Index v = mesh.from(h);
    const Vec3 edge = p[mesh.to(h)] - p[v], normal = frames.normal[v];
    frames.x[v] = normalized(edge - dot(edge, normal) * normal);
    frames.y[v] = cross(normal, frames.x[v]);
  }
  return frames;
}

VectorHeatSolver::SparseComplex VectorHeatSolver::connection_laplacian() const {
  const heat::Pattern& p = state_->system.operators().pattern;
  const std::vector<Complex>& lower = state_->system.laplacian_of_vectors();
  SparseComplex all;
  const auto add = [&](int row, int column, Complex value) {
    all.row.push_back(static_cast<Index>(row));
    all.column.push_back(static_cast<Index>(column));
    all.value.push_back(value);
  };
  for (int column = 0; column < p.columns(); ++column) {
    for (int e = p.start[column]; e < p.start[column + 1]; ++e) {
      add(p.row[e], column, lower[e]);
      if (p.row[e] != column) add(column, p.row[e], std::conj(lower[e]));
    }
  }
  return all;
}

}  // namespace brushfire
