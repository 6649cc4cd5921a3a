// Bases of offsets, by component.
#include <brushfire/solvers/detail/offsets.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/disjoint_sets.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace brushfire::detail {
namespace {

// Pieces of one curve may lie in several components, which then have one base: no source there is surely dominated.
class Joined {
 public:
  Joined(const Mesh& mesh, std::span<const Index> component, std::span<const LocatedSource> sources)
      : mesh_(mesh), component_(component) {
    for (const LocatedSource& s : sources) {
      if (!s.curve) continue;
      const Index first = component_of(s.at);
      for (const CurvePlace& p : s.curve->places) {
        const Index other = component_of(p.at);
        if (root(other) != root(first)) to_[root(other)] = root(first);
      }
    }
  }
  bool any() const { return !to_.empty(); }
  Index component(const LocatedSource& s) const { return root(component_of(s.at)); }

 private:
  Index component_of(const PointLocation& at) const { return component_[mesh_.faces()[at.face][0]]; }
  Index root(Index c) const {
    for (auto next = to_.find(c); next != to_.end(); next = to_.find(c)) c = next->second;
    return c;
  }

  const Mesh& mesh_;
  std::span<const Index> component_;
  std::map<Index, Index> to_;
};

}  // namespace

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

void Offsets::split(const Mesh& mesh, std::span<LocatedSource> located) {
  bases_.clear();
  const double unit = mesh.unit();
  const auto is_tame = [&](const LocatedSource& s) { return std::abs(s.offset) <= kTame * unit; };
  if (std::all_of(located.begin(), located.end(), is_tame)) {
    for (LocatedSource& s : located) s.offset /= unit;
    return;
  }
  if (located.size() == 1) {
    bases_.push_back(located[0].offset);
    located[0].offset = 0;
    return;
  }
  if (component_.empty()) look_at(mesh);
  const Joined joined(mesh, component_, located);
  std::map<Index, double> least;
  for (const LocatedSource& s : located) {
    double& base = least.try_emplace(joined.component(s), kInfinity).first->second;
    base = std::min(base, s.offset);
  }
  for (LocatedSource& s : located) {
    bases_.push_back(least[joined.component(s)]);
    const double above = (s.offset - bases_.back()) / unit;  // it may be +inf
    s.offset = joined.any() ? above : std::min(beyond_all_, above);
    if (s.offset == kInfinity) {
      throw Error(ErrorCode::InvalidArgument, "offsets differ by more than there are numbers for");
    }
  }
}

double Offsets::bound(double engine_bound, double engine_value, double value, double unit) const {
  const double of_sum = bases_.empty() ? 0 : std::numeric_limits<double>::epsilon() * std::abs(value);
  using Limits = std::numeric_limits<double>;
  const double of_small = engine_value > 0 && engine_value * unit < Limits::min() ? Limits::denorm_min() : 0;
  return engine_bound * unit + of_sum + of_small;
}

double Offsets::radius(double max_distance, double unit) const {
  if (bases_.empty()) return max_distance / unit;
  const double lowest = *std::min_element(bases_.begin(), bases_.end());
  return std::max(0.0, (max_distance - lowest) / unit);
}

}  // namespace brushfire::detail
