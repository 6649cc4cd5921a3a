// Bases of offsets, by component.
#include <brushfire/solvers/detail/offsets.h>

#include <brushfire/mesh/detail/disjoint_sets.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace brushfire::detail {
// Faces that name a vertex twice conduct too.
void Offsets::look_at(const Mesh& mesh) {
  DisjointSets sets(mesh.vertex_count());
  for (const Face& t : mesh.faces()) {
    sets.unite(t[0], t[1]);
    sets.unite(t[1], t[2]);
  }
  component_.resize(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) component_[v] = sets.find(v);
  // No way is longer than all edges together; four times that is beyond what any method makes of a way there and back.
  double sum = 0;
  for (const double length : mesh.lengths()) sum += length;
  // (Where all edges have length 0, anything is.)
  constexpr double kLargest = 0x1p1000;  // sums of a few of these are finite
  beyond_all_ = sum > 0 ? std::min(4 * sum, kLargest) : 1;
}

void Offsets::split(const Mesh& mesh, std::span<const Source> sources, std::span<LocatedSource> located) {
  bases_.clear();
  const double unit = mesh.unit();
  const auto is_tame = [&](const Source& s) { return std::abs(s.offset) <= kTame * unit; };
  if (std::all_of(sources.begin(), sources.end(), is_tame)) {
    for (std::size_t i = 0; i < sources.size(); ++i) located[i].offset = sources[i].offset / unit;
    return;
  }
  if (sources.size() == 1) {
    bases_.push_back(sources[0].offset);
    located[0].offset = 0;
    return;
  }
  if (component_.empty()) look_at(mesh);
  const auto component = [&](std::size_t i) { return component_[mesh.faces()[located[i].at.face][0]]; };
  std::map<Index, double> least;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    double& base = least.try_emplace(component(i), kInfinity).first->second;
    base = std::min(base, sources[i].offset);
  }
  for (std::size_t i = 0; i < sources.size(); ++i) {
    bases_.push_back(least[component(i)]);
    located[i].offset = std::min(beyond_all_, (sources[i].offset - bases_[i]) / unit);  // the difference may be +inf
  }
}

double Offsets::bound(double engine_bound, double value, double unit) const {
  const double of_sum = bases_.empty() ? 0 : std::numeric_limits<double>::epsilon() * std::abs(value);
  return engine_bound * unit + of_sum;
}

double Offsets::radius(double max_distance, double unit) const {
  if (bases_.empty()) return max_distance / unit;
  const double lowest = *std::min_element(bases_.begin(), bases_.end());
  return std::max(0.0, (max_distance - lowest) / unit);
}

}  // namespace brushfire::detail
