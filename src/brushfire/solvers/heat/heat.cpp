// HeatSolver: sets of sources as right-hand sides, eight at a time.
#include <brushfire/solvers/heat.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/solvers/detail/offsets.h>
#include <brushfire/solvers/detail/walls.h>
#include <brushfire/solvers/heat/fronts.h>
#include <brushfire/solvers/heat/system.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace brushfire {

struct HeatSolver::State {
  Domain domain;
  heat::System system;  // of domain.open()
};

HeatSolver::HeatSolver(const Domain& domain, const HeatOptions& options)
    : state_(new State{domain, heat::System(domain.open(), options)}) {}
HeatSolver::~HeatSolver() = default;
HeatSolver::HeatSolver(HeatSolver&&) noexcept = default;
HeatSolver& HeatSolver::operator=(HeatSolver&&) noexcept = default;

double HeatSolver::time() const {
  return state_->system.time() * state_->domain.open().unit() * state_->domain.open().unit();
}
double HeatSolver::mean_edge_length() const { return state_->system.mean_edge_length() * state_->domain.open().unit(); }
const Mesh& HeatSolver::mesh() const { return state_->domain.mesh(); }

namespace {

// A set of sources, and what distance() does around an engine.
struct Row {
  Row(const Domain& domain, const heat::System& system, std::span<const Source> given) {
    if (given.empty()) throw Error(ErrorCode::InvalidArgument, "no source given: a distance needs at least one");
    for (std::size_t i = 0; i < given.size(); ++i) {
      if (!std::isfinite(given[i].offset)) {
        throw Error(ErrorCode::InvalidArgument, "the offset of source " + std::to_string(i) + " is not finite");
      }
      if (given[i].curve) {
        throw Error(ErrorCode::InvalidArgument,
                    "source " + std::to_string(i) + " is a curve, and heat starts at points: see SignedHeatSolver");
      }
    }
    const Mesh& mesh = domain.open();
    std::vector<detail::LocatedSource> located;
    const detail::WalledRun run(domain, given, {});
    for (std::size_t i = 0; i < run.sources().size(); ++i) {
      located.push_back({locate(mesh, run.sources()[i].point), run.sources()[i].offset, static_cast<Index>(i)});
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
  const Domain& domain = state_->domain;
  const Mesh& mesh = domain.open();
  const std::size_t n = mesh.vertex_count(), of_row = domain.mesh().vertex_count();
  std::vector<double> rows(sets.size() * of_row, kInfinity), distance(n);
  constexpr std::size_t kAtOnce = 8;
  for (std::size_t first = 0; first < sets.size(); first += kAtOnce) {
    stop_if_cancelled();
    const std::size_t now = std::min(kAtOnce, sets.size() - first);
    std::vector<Row> group;
    std::vector<heat::Sparks> columns;
    for (std::size_t j = 0; j < now; ++j) {
      columns.push_back(group.emplace_back(domain, state_->system, sets[first + j]).sparks);
    }
    const std::vector<double> potentials = state_->system.potentials(columns);
    std::vector<Index> source(n);
    for (std::size_t j = 0; j < now; ++j) {
      std::fill(distance.begin(), distance.end(), kInfinity);
      std::fill(source.begin(), source.end(), kNoIndex);
      read_off(mesh, state_->system, group[j].origins, std::span(potentials).subspan(j), now, distance, source);
      const std::span<double> row = std::span(rows).subspan((first + j) * of_row, of_row);
      for (Index v = 0; v < n; ++v) {
        double& least = row[domain.vertex(v)];
        least = std::min(least, group[j].offsets.value(distance[v], source[v], mesh.unit()));
      }
    }
  }
  return rows;
}

std::vector<double> HeatSolver::distance(std::span<const Source> sources) const {
  const std::vector<Source> set(sources.begin(), sources.end());
  return distances({&set, 1});
}

}  // namespace brushfire
