// HeatSolver: sets of sources as right-hand sides, eight at a time.
#include <brushfire/solvers/heat.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/solvers/detail/offsets.h>
#include <brushfire/solvers/heat/fronts.h>
#include <brushfire/solvers/heat/system.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace brushfire {

struct HeatSolver::State {
  Mesh mesh;
  heat::System system;
};

HeatSolver::HeatSolver(const Mesh& mesh, const HeatOptions& options)
    : state_(new State{mesh, heat::System(mesh, options)}) {}
HeatSolver::~HeatSolver() = default;
HeatSolver::HeatSolver(HeatSolver&&) noexcept = default;
HeatSolver& HeatSolver::operator=(HeatSolver&&) noexcept = default;

double HeatSolver::time() const { return state_->system.time() * state_->mesh.unit() * state_->mesh.unit(); }
double HeatSolver::mean_edge_length() const { return state_->system.mean_edge_length() * state_->mesh.unit(); }
const Mesh& HeatSolver::mesh() const { return state_->mesh; }

namespace {

// A set of sources, and what distance() does around an engine.
struct Row {
  Row(const Mesh& mesh, const heat::System& system, std::span<const Source> given) {
    if (given.empty()) throw Error(ErrorCode::InvalidArgument, "no source given: a distance needs at least one");
    std::vector<detail::LocatedSource> located;
    for (std::size_t i = 0; i < given.size(); ++i) {
      if (!std::isfinite(given[i].offset)) {
        throw Error(ErrorCode::InvalidArgument, "the offset of source " + std::to_string(i) + " is not finite");
      }
      if (given[i].curve) {
        throw Error(ErrorCode::InvalidArgument,
                    "source " + std::to_string(i) + " is a curve, and heat starts at points: see SignedHeatSolver");
      }
      located.push_back({locate(mesh, given[i].point), given[i].offset, static_cast<Index>(i)});
    }
    offsets.split(mesh, located);
    origins = heat::origins_of(mesh, system, located);
    sparks = heat::sparks_of(system, origins);
  }

  detail::Offsets offsets;
  std::vector<heat::Origin> origins;
  heat::Sparks sparks;
};

}  // namespace

std::vector<double> HeatSolver::distances(std::span<const std::vector<Source>> sets) const {
  const Mesh& mesh = state_->mesh;
  const std::size_t n = mesh.vertex_count();
  std::vector<double> rows(sets.size() * n, kInfinity);
  constexpr std::size_t kAtOnce = 8;
  for (std::size_t first = 0; first < sets.size(); first += kAtOnce) {
    stop_if_cancelled();
    const std::size_t now = std::min(kAtOnce, sets.size() - first);
    std::vector<Row> group;
    std::vector<heat::Sparks> columns;
    for (std::size_t j = 0; j < now; ++j) {
      columns.push_back(group.emplace_back(mesh, state_->system, sets[first + j]).sparks);
    }
    const std::vector<double> potentials = state_->system.potentials(columns);
    std::vector<Index> source(n);
    for (std::size_t j = 0; j < now; ++j) {
      const std::span<double> row = std::span(rows).subspan((first + j) * n, n);
      std::fill(source.begin(), source.end(), kNoIndex);
      read_off(mesh, state_->system, group[j].origins, std::span(potentials).subspan(j), now, row, source);
      for (std::size_t v = 0; v < n; ++v) row[v] = group[j].offsets.value(row[v], source[v], mesh.unit());
    }
  }
  return rows;
}

std::vector<double> HeatSolver::distance(std::span<const Source> sources) const {
  const std::vector<Source> set(sources.begin(), sources.end());
  return distances({&set, 1});
}

}  // namespace brushfire
