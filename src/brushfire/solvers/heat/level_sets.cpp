// A Poisson equation with constraints: solved without them, then corrected by a dense system as large as they are many.
#include <brushfire/solvers/heat/level_sets.h>

#include <brushfire/core/error.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace brushfire::heat {
namespace {

// Twice this of the largest entry of the constraints' matrix is added to its diagonal: points that say the same (three
// on one line in a face) leave it singular.
constexpr double kRedundant = 1e-10;

// The difference of the function at two points, as weights of vertices: they sum to 0, so that the right-hand sides of
// the Poisson equation do.
using Difference = std::vector<std::pair<Index, double>>;

Index component_at(const Mesh& mesh, const detail::Components& components, const PointLocation& p) {
  return components.of_vertex[mesh.faces()[p.face][0]];
}

std::vector<Difference> differences(const Mesh& mesh, const detail::Components& components,
                                    const std::vector<std::vector<PointLocation>>& groups, bool across_groups) {
  std::vector<Difference> all;
  std::map<std::pair<std::size_t, Index>, const PointLocation*> first;  // of each group and component
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const PointLocation& p : groups[g]) {
      const std::pair key{across_groups ? std::size_t{0} : g, component_at(mesh, components, p)};
      const auto [found, is_first] = first.try_emplace(key, &p);
      if (is_first) continue;
      std::map<Index, double> weights;
      for (int k = 0; k < 3; ++k) {
        weights[mesh.faces()[p.face][k]] += p.weights[k];
        weights[mesh.faces()[found->second->face][k]] -= found->second->weights[k];
      }
      Difference& d = all.emplace_back();
      for (const auto& [v, w] : weights) {
        if (w != 0) d.emplace_back(v, w);
      }
      if (d.empty()) all.pop_back();  // the end of a closed curve
    }
  }
  if (all.size() > SignedHeatSolver::kMostConstraints) {
    throw Error(ErrorCode::TooLarge, std::to_string(all.size()) + " points with a constraint; at most " +
                                         std::to_string(SignedHeatSolver::kMostConstraints) +
                                         " are taken: LevelSetConstraint::None takes any number");
  }
  return all;
}

double read(const Difference& d, std::span<const double> f, std::size_t width = 1, std::size_t column = 0) {
  double sum = 0;
  for (const auto& [v, w] : d) sum += w * f[width * v + column];
  return sum;
}

// Subtracts from f what makes all differences 0 (or small, softly) at the least cost in its gradient.
void constrain(const Factors<double>& poisson, const std::vector<Difference>& all, double soft_weight,
               std::vector<double>& f) {
  const std::size_t n = f.size(), count = all.size();
  if (count == 0) return;
  constexpr std::size_t kWidth = 8;
  std::vector<double> matrix(count * count), responses(n * kWidth), lambda(count);
  for (std::size_t first = 0; first < count; first += kWidth) {
    const std::size_t now = std::min(kWidth, count - first);
    std::fill(responses.begin(), responses.end(), 0.0);
    for (std::size_t j = 0; j < now; ++j) {
      for (const auto& [v, w] : all[first + j]) responses[now * v + j] += w;
    }
    poisson.solve(0, now, std::span(responses).first(n * now));
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < now; ++j) matrix[count * i + first + j] = read(all[i], responses, now, j);
    }
  }
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, matrix[count * i + i]);
  for (std::size_t i = 0; i < count; ++i) {
    matrix[count * i + i] += soft_weight > 0 ? 1 / soft_weight : 2 * kRedundant * largest;
    lambda[i] = read(all[i], f);
  }
  solve_dense(matrix, lambda);
  std::vector<double> b(n, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    for (const auto& [v, w] : all[i]) b[v] += w * lambda[i];
  }
  poisson.solve(0, 1, b);
  for (std::size_t v = 0; v < n; ++v) f[v] -= b[v];
}

}  // namespace

LevelSets::LevelSets(const Operators& operators, const detail::Components& components) : components_(components) {
  std::vector<double> matrix = operators.laplacian;
  std::vector<bool> held(components.count, false);
  for (std::size_t v = 0; v < components.of_vertex.size(); ++v) {
    double& diagonal = matrix[operators.pattern.start[v]];
    const Index c = components.of_vertex[v];
    if (c == kNoIndex) diagonal = 1;
    if (c == kNoIndex || held[c]) continue;
    held[c] = true;
    diagonal = diagonal > 0 ? 2 * diagonal : 1;
  }
  poisson_.emplace(operators.pattern, std::span(&matrix, 1));
}

std::vector<double> LevelSets::integrate(const Mesh& mesh, std::vector<double> b,
                                         const std::vector<std::vector<PointLocation>>& groups,
                                         const SignedHeatOptions& options) const {
  std::vector<double> f = std::move(b);
  poisson_->solve(0, 1, f);
  if (options.constraint != LevelSetConstraint::None) {
    const bool all_alike = options.constraint == LevelSetConstraint::ZeroSet;
    constrain(*poisson_, differences(mesh, components_, groups, all_alike), options.soft_weight, f);
  }
  std::vector<double> sum(components_.count, 0.0), count(components_.count, 0.0);
  for (const std::vector<PointLocation>& group : groups) {
    for (const PointLocation& p : group) {
      const Index c = component_at(mesh, components_, p);
      for (int k = 0; k < 3; ++k) sum[c] += p.weights[k] * f[mesh.faces()[p.face][k]];
      ++count[c];
    }
  }
  for (std::size_t v = 0; v < f.size(); ++v) {
    const Index c = components_.of_vertex[v];
    f[v] = c != kNoIndex && count[c] > 0 ? (f[v] - sum[c] / count[c]) * mesh.unit() : kInfinity;
  }
  return f;
}

}  // namespace brushfire::heat
