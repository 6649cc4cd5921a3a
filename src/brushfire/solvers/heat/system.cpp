// Factors of both equations, and a field by way of them.
#include <brushfire/solvers/heat/system.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/components.h>
#include <brushfire/solvers/heat/scales.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace brushfire::heat {
void check(const HeatOptions& options) {
  const auto refuse = [](const std::string& name, double value, const std::string& range) {
    throw Error(ErrorCode::InvalidArgument, "heat: " + name + " " + number_as_text(value) + " is not in " + range);
  };
  if (!(options.time_factor >= kLeastFactor && options.time_factor <= kLargestFactor)) {
    refuse("time_factor", options.time_factor, "[1e-12, 1e6]");
  }
  if (!(options.time >= 0 && options.time < kInfinity)) refuse("time", options.time, "[0, infinity)");
  if (!(options.poisson_shift >= 0 && options.poisson_shift <= 1)) {
    refuse("poisson_shift", options.poisson_shift, "[0, 1]");
  }
}

System::System(const Mesh& mesh, const HeatOptions& options) : options_(options) {
  require_factorization();
  check(options);
  Triangulation t = triangulation_of(mesh, Cover::AsItIs);
  const detail::Components components = detail::components_of(mesh);
  component_ = components.of_vertex;
  component_count_ = components.count;
  is_point_ = points_among(t, components);
  mollify(t, components);
  if (options.delaunay) flip_to_delaunay(t);
  per_sheet_ = 1.0 / t.sheets;
  mean_edges_ = mean_edge_lengths(t, components);
  mean_edge_length_ = heat::mean_edge_length(t);
  times_ = times_of(t, components, options.time_factor, options.time / mesh.unit() / mesh.unit());
  if (options.boundary != HeatBoundary::Neumann) find_border(mesh);
  operators_ = operators_of(t);
  faces_.reserve(t.face_count());
  for (std::size_t f = 0; f < t.face_count(); ++f) {
    const FlatTriangle flat = lay_flat(t, f);
    faces_.push_back({{t.tail[3 * f], t.tail[3 * f + 1], t.tail[3 * f + 2]}, flat.length, flat.apex});
  }
  if (options.boundary != HeatBoundary::Dirichlet) heat_.push_back(heat_matrix(false));
  if (options.boundary != HeatBoundary::Neumann) heat_.push_back(heat_matrix(true));
  std::vector<std::vector<double>> matrices{poisson_matrix()};
  matrices.insert(matrices.end(), heat_.begin(), heat_.end());
  factors_.emplace(operators_.pattern, matrices);
}

void System::find_border(const Mesh& mesh) {
  border_.assign(mesh.vertex_count(), 0);
  const std::span<const Index> opposite = mesh.opposite();
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    if (opposite[h] != h || !mesh.is_face_usable(Mesh::face_of(h))) continue;
    border_[mesh.from(h)] = border_[mesh.to(h)] = 1;
  }
}

// A vertex of each component is held at 0. With right-hand sides that sum to 0 that changes nothing else.
std::vector<double> System::poisson_matrix() const {
  std::vector<double> matrix = operators_.laplacian;
  std::vector<bool> held(component_count_, false);
  for (Index v = 0; v < vertex_count(); ++v) {
    double& diagonal = matrix[operators_.pattern.start[v]];
    if (component_[v] == kNoIndex) {
      diagonal = 1;
    } else if (options_.poisson_shift > 0) {
      diagonal += options_.poisson_shift;
    } else if (!held[component_[v]]) {
      held[component_[v]] = true;
      diagonal = diagonal > 0 ? 2 * diagonal : 1;
    }
  }
  return matrix;
}

std::vector<double> System::heat_matrix(bool cold_border) const {
  const Pattern& p = operators_.pattern;
  std::vector<double> matrix = operators_.laplacian;
  for (Index v = 0; v < vertex_count(); ++v) {
    const double time = component_[v] == kNoIndex ? 1 : times_.of[component_[v]];
    for (int e = p.start[v]; e < p.start[v + 1]; ++e) matrix[e] *= time;
    double& diagonal = matrix[p.start[v]];
    diagonal += operators_.mass[v];
    const bool cold = cold_border && is_on_border(v);
    if (component_[v] == kNoIndex || cold) diagonal = 1;
    for (int e = p.start[v] + 1; e < p.start[v + 1]; ++e) {
      if (cold || (cold_border && is_on_border(static_cast<Index>(p.row[e])))) matrix[e] = 0;
    }
  }
  return matrix;
}

// Columns side by side.
std::vector<double> System::heat_by(std::size_t matrix, std::size_t width, std::span<const Sparks> columns) const {
  const bool cold = options_.boundary == HeatBoundary::Dirichlet || matrix == 1;
  std::vector<double> u(width * vertex_count(), 0.0);
  for (std::size_t j = 0; j < width; ++j) {
    for (const Spark& s : columns[j]) {
      if (!cold || !is_on_border(s.vertex)) u[width * s.vertex + j] += s.weight * std::exp(-s.delay);
    }
  }
  factors_->solve(matrix + 1, width, u);
  return u;
}

std::vector<double> System::heat_of(std::size_t width, std::span<const Sparks> columns) const {
  std::vector<double> u = heat_by(0, width, columns);
  if (heat_.size() == 1) return u;
  const std::vector<double> cold = heat_by(1, width, columns);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = 0.5 * (u[i] + cold[i]);
  return u;
}

template <std::size_t kWidth>
void System::add_divergence(std::span<const double> u, std::span<double> b) const {
  using Row = std::array<double, kWidth>;
  Poll poll;
  for (const FlatFace& f : faces_) {
    poll();
    const double* const u0 = &u[kWidth * f.vertex[0]];
    const double* const u1 = &u[kWidth * f.vertex[1]];
    const double* const u2 = &u[kWidth * f.vertex[2]];
    Row to_1, to_2;
    for (std::size_t w = 0; w < kWidth; ++w) {
      const double largest = std::max({std::abs(u0[w]), std::abs(u1[w]), std::abs(u2[w])});
      const double scale = largest > 0 ? 1 / largest : 0;
      const double d1 = (u1[w] - u0[w]) * scale, d2 = (u2[w] - u0[w]) * scale;
      const double x = d1 * f.apex.y, y = d2 * f.length - d1 * f.apex.x;
      const double square = x * x + y * y;
      const double down = square > 0 ? -0.5 * per_sheet_ / std::sqrt(square) : 0;
      to_1[w] = down * (x * f.apex.y - y * f.apex.x);
      to_2[w] = down * y * f.length;
    }
    for (std::size_t w = 0; w < kWidth; ++w) {
      b[kWidth * f.vertex[0] + w] -= to_1[w] + to_2[w];
      b[kWidth * f.vertex[1] + w] += to_1[w];
      b[kWidth * f.vertex[2] + w] += to_2[w];
    }
  }
}

std::vector<double> System::potentials(std::span<const Sparks> columns) const {
  const std::size_t width = columns.size();
  std::vector<double> all(width * vertex_count(), 0.0), b;
  for (std::size_t first = 0; first < width;) {
    const std::size_t left = width - first;
    const std::size_t now = left >= 8 ? 8 : left >= 4 ? 4 : left >= 2 ? 2 : 1;
    const std::vector<double> u = heat_of(now, columns.subspan(first, now));
    b.assign(now * vertex_count(), 0.0);
    if (now == 8) add_divergence<8>(u, b);
    if (now == 4) add_divergence<4>(u, b);
    if (now == 2) add_divergence<2>(u, b);
    if (now == 1) add_divergence<1>(u, b);
    for (std::size_t j = 0; j < now; ++j) {
      if (!starves(lit_by(columns[first + j]), std::span(u).subspan(j), now)) continue;
      for (Index v = 0; v < vertex_count(); ++v) b[now * v + j] = 0;
      add_divergence(diffuse(columns[first + j]), now, j, b);
    }
    factors_->solve(0, now, b);
    for (Index v = 0; v < vertex_count(); ++v) {
      std::copy_n(b.begin() + static_cast<std::ptrdiff_t>(now * v), now,
                  all.begin() + static_cast<std::ptrdiff_t>(width * v + first));
    }
    first += now;
  }
  return all;
}

}  // namespace brushfire::heat
