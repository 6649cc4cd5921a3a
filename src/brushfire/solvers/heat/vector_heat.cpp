// Values, vectors and logarithmic maps, read off heat that carries them.
#include <brushfire/solvers/vector_heat.h>

#include <brushfire/core/error.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/heat/carrier.h>
#include <brushfire/solvers/heat/connection.h>
#include <brushfire/solvers/heat/sides.h>
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
  State(const Domain& given, const HeatOptions& how)
      : domain(given), mesh(given.open()), options(how), system(mesh, how.delaunay, how.time_factor, how.time) {}

  Domain domain;
  Mesh mesh;  // the open one
  HeatOptions options;
  heat::VectorSystem system;
  std::optional<DistanceSolver> radius;  // for LogMapStrategy::VectorHeat

  static void check(std::span<const Index> vertices, std::size_t values);
  std::vector<double> values(const heat::Carrier& carrier, std::span<const Index> vertices,
                             std::span<const double> given) const;
  std::vector<Complex> directions(const heat::Carrier& carrier, std::span<const Index> vertices,
                                  std::span<const Complex> vectors) const;
  std::vector<Complex> axes(const heat::Carrier& carrier, Index source) const;
  std::vector<Complex> affine(Index source, bool adaptive);
  std::vector<Complex> polar(Index source);
};

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

HeatOptions checked(const HeatOptions& options) {
  heat::check(options);
  return options;
}

// Of length 1; 0 for 0.
Complex unit(Complex z) {
  const double length = std::abs(z);
  return length > 0 ? z / length : Complex();
}

}  // namespace

VectorHeatSolver::VectorHeatSolver(const Domain& domain, const HeatOptions& options)
    : state_(std::make_unique<State>(domain, checked(options))) {}
VectorHeatSolver::~VectorHeatSolver() = default;
VectorHeatSolver::VectorHeatSolver(VectorHeatSolver&&) noexcept = default;
VectorHeatSolver& VectorHeatSolver::operator=(VectorHeatSolver&&) noexcept = default;

double VectorHeatSolver::time() const { return state_->system.time() * state_->mesh.unit() * state_->mesh.unit(); }

void VectorHeatSolver::State::check(std::span<const Index> vertices, std::size_t values) {
  if (vertices.empty()) throw Error(ErrorCode::InvalidArgument, "no vertex given to start from");
  if (vertices.size() != values) {
    throw Error(ErrorCode::InvalidArgument,
                std::to_string(vertices.size()) + " vertices and " + std::to_string(values) + " values: one each");
  }
}

// How far each is on the way from the least value to the largest: so all sums are positive.
std::vector<double> VectorHeatSolver::State::values(const heat::Carrier& carrier, std::span<const Index> vertices,
                                                    std::span<const double> given) const {
  const auto [low, high] = std::minmax_element(given.begin(), given.end());
  const double scale = std::isfinite(*high - *low) ? 1 : 0.5, range = scale * *high - scale * *low;
  std::vector<double> x(mesh.vertex_count(), 0.0);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    x[vertices[i]] += range > 0 ? (scale * given[i] - scale * *low) / range : 0;
  }
  carrier.carry(1, x);
  const std::vector<double>& heat = carrier.heat().value;
  for (std::size_t v = 0; v < x.size(); ++v) {
    const double way = x[v] / heat[v];
    x[v] = heat[v] > 0 ? std::clamp(*low * (1 - way) + *high * way, *low, *high) : kNone;
  }
  return x;
}

// Unit vectors; 0 where they cancel, NaN where no heat comes.
std::vector<Complex> VectorHeatSolver::State::directions(const heat::Carrier& carrier, std::span<const Index> vertices,
                                                         std::span<const Complex> vectors) const {
  std::vector<Complex> x(mesh.vertex_count());
  for (std::size_t i = 0; i < vertices.size(); ++i) x[vertices[i]] += vectors[i];
  carrier.carry(x);
  for (std::size_t v = 0; v < x.size(); ++v) {
    x[v] = carrier.heat().value[v] > 0 ? unit(x[v]) : Complex(kNone, kNone);
  }
  return x;
}

std::vector<double> VectorHeatSolver::extend(std::span<const Index> vertices, std::span<const double> values) {
  State& s = *state_;
  State::check(vertices, values.size());
  std::vector<Index> from;
  std::vector<double> of_side;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!std::isfinite(values[i])) throw Error(ErrorCode::InvalidArgument, "a value to extend is not finite");
    for (const Index side : heat::sides_of(s.domain, vertices[i])) {
      from.push_back(side);
      of_side.push_back(values[i]);
    }
  }
  const heat::Carrier carrier(s.system, from);
  const heat::Heat& heat = carrier.heat();
  return heat::of_nearest_sides(s.domain, s.values(carrier, from, of_side), [&](Index a, Index b) {
    if (!(heat.value[a] > 0 && heat.value[b] > 0)) return heat.value[a] > heat.value[b];
    return heat.level[a] != heat.level[b] ? heat.level[a] < heat.level[b] : heat.value[a] > heat.value[b];
  });
}

std::vector<Complex> VectorHeatSolver::transport(std::span<const Index> vertices, std::span<const Complex> vectors) {
  State::check(vertices, vectors.size());
  std::vector<Index> from;
  for (const Index v : vertices) from.push_back(heat::only_side_of(state_->domain, v));
  std::vector<Complex> directions;
  std::vector<double> lengths;
  for (const Complex& z : vectors) {
    if (!std::isfinite(std::abs(z))) throw Error(ErrorCode::InvalidArgument, "a vector to transport is not finite");
    lengths.push_back(std::abs(z));
    directions.push_back(unit(z));
  }
  const heat::Carrier carrier(state_->system, from);
  std::vector<Complex> x = state_->directions(carrier, from, directions);
  const std::vector<double> length = state_->values(carrier, from, lengths);
  for (std::size_t v = 0; v < x.size(); ++v) x[v] *= length[v];
  return x;
}

// The coordinates of the source's own place, 0, carried along with the heat: in passing an edge from j to i they turn
// with the frames, and grow by the edge.
std::vector<Complex> VectorHeatSolver::State::affine(Index source, bool adaptive) {
  const heat::Triangulation& t = system.triangulation();
  const heat::Carrier carrier(system, {&source, 1});
  const heat::Heat& heat = carrier.heat();
  const std::vector<Complex> parallel = axes(carrier, source);
  std::vector<Complex> x(mesh.vertex_count());
  for (Index h = 0; h < t.tail.size(); ++h) {
    const Index a = t.tail[h], b = t.tail[Mesh::next(h)];
    if (!(heat.value[a] > 0 && heat.value[b] > 0)) continue;
    const double weight = system.time_at(a) * system.weights()[h] * t.length[h];
    const auto in_frame = [&](Complex z, Index v) { return adaptive ? z / parallel[v] : z; };
    x[a] -= weight * heat.value[b] * heat.unit(b, heat.level[a]) * in_frame(heat::direction(t, system.spaces(), h), a);
    x[b] -=
        weight * heat.value[a] * heat.unit(a, heat.level[b]) * in_frame(heat::direction_back(t, system.spaces(), h), b);
  }
  if (adaptive) {
    // A complex number is two columns side by side.
    carrier.carry(2, {reinterpret_cast<double*>(x.data()), 2 * x.size()});
  } else {
    carrier.carry(x);
  }
  for (std::size_t v = 0; v < x.size(); ++v) {
    x[v] = heat.value[v] > 0 ? x[v] / heat.value[v] / (adaptive ? Complex(1) : parallel[v]) : Complex(kNone, kNone);
  }
  return x;
}

// The source's first axis, carried to all; where nothing is left of it, any.
std::vector<Complex> VectorHeatSolver::State::axes(const heat::Carrier& carrier, Index source) const {
  const Complex axis = 1;
  std::vector<Complex> x = directions(carrier, {&source, 1}, {&axis, 1});
  std::replace(x.begin(), x.end(), Complex(), axis);
  return x;
}

std::vector<Complex> VectorHeatSolver::State::polar(Index source) {
  const heat::Triangulation& t = system.triangulation();
  const heat::Carrier carrier(system, {&source, 1});
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
  const std::vector<Complex> parallel = axes(carrier, source), radial = directions(carrier, neighbours, outward);
  if (!radius) radius.emplace(mesh);
  DistanceOptions how;
  how.method = Method::Heat;
  how.heat = {options.time_factor, options.time, HeatBoundary::Neumann, options.delaunay};
  const Source from{vertex_point(mesh, source)};
  const std::vector<double> distance = radius->distance({&from, 1}, how).distance;
  std::vector<Complex> x(mesh.vertex_count());
  for (std::size_t v = 0; v < x.size(); ++v) {
    // On the other side of the surface all directions may cancel: any of them is as right there.
    const Complex direction = radial[v] == Complex() ? Complex(1) : radial[v] / parallel[v];
    x[v] = distance[v] < kInfinity ? distance[v] / mesh.unit() * direction : Complex(kNone, kNone);
  }
  return x;
}

std::vector<Complex> VectorHeatSolver::log_map(Index source, LogMapStrategy strategy) {
  const Index side = heat::only_side_of(state_->domain, source);
  std::vector<Complex> x = strategy == LogMapStrategy::VectorHeat
                               ? state_->polar(side)
                               : state_->affine(side, strategy == LogMapStrategy::AffineAdaptive);
  const Complex origin = strategy == LogMapStrategy::VectorHeat ? Complex() : x[side];
  const double unit = state_->system.is_point(state_->system.components().of_vertex[side]) ? 0 : state_->mesh.unit();
  for (Complex& z : x) z = (z - origin) * unit;
  x[side] = 0;
  std::vector<double> radius;
  for (const Complex& z : x) radius.push_back(std::isfinite(std::abs(z)) ? std::abs(z) : kInfinity);
  return heat::of_nearest_sides(state_->domain, std::move(x), [&](Index a, Index b) { return radius[a] < radius[b]; });
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
  const std::vector<Complex> lower = state_->system.connection_laplacian();
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
