// From what an engine wrote to what a caller gets.
#include <brushfire/core/detail/sort.h>
#include <brushfire/solvers/detail/finish.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace brushfire::detail {
namespace {

// A target at a vertex reads what the field reads there, to the bit. Makes room for those that are nowhere.
void finish_targets(double unit, std::span<const PointLocation> targets, const Offsets& offsets,
                    const DistanceOptions& options, DistanceField& field) {
  for (std::size_t i = 0; i < field.target_distance.size(); ++i) {
    double& d = field.target_distance[i];
    Index& source = field.target_source[i];
    if (targets[i].on == PointLocation::On::Vertex) {
      d = field.distance[targets[i].vertex];
      source = field.source[targets[i].vertex];
    }
    d = offsets.value(d, source, unit, options.bound);
    if (d == kInfinity || d > options.max_distance) {
      d = kInfinity;
      source = kNoIndex;
    }
  }
  for (std::size_t i = 0; i < options.targets.size() && targets.size() < options.targets.size(); ++i) {
    if (!options.targets[i].is_nowhere()) continue;
    const auto place = static_cast<std::ptrdiff_t>(i);
    field.target_distance.insert(field.target_distance.begin() + place, kInfinity);
    field.target_source.insert(field.target_source.begin() + place, kNoIndex);
  }
}

}  // namespace

void finish(const Mesh& mesh, std::span<const PointLocation> targets, const Offsets& offsets,
            const DistanceOptions& options, DistanceField& field) {
  const double unit = mesh.unit();
  finish_targets(unit, targets, offsets, options, field);
  field.method = options.method;
  field.reached = 0;
  for (std::size_t v = 0; v < field.distance.size(); ++v) {
    double& d = field.distance[v];
    if (d == kInfinity) continue;
    const double in_units = d;
    d = offsets.value(d, field.source[v], unit, options.bound);
    if (d == kInfinity || d > options.max_distance) {
      d = kInfinity;
      field.source[v] = kNoIndex;
      if (!field.error_bound.empty()) field.error_bound[v] = kInfinity;
      ++field.beyond_radius;
    } else {
      if (!field.error_bound.empty()) field.error_bound[v] = offsets.bound(field.error_bound[v], in_units, d, unit);
      ++field.reached;
    }
  }
  field.unreachable = mesh.vertex_count() - field.reached - field.beyond_radius;
}

void collect(double unit, std::span<const PointLocation> targets, const Offsets& offsets,
             const DistanceOptions& options, DistanceField& field, std::vector<Index>& touched, SparseField& result) {
  constexpr std::size_t kScanShare = 16;  // looking at this many vertices costs about as much as sorting in one
  if (touched.size() > field.distance.size() / kScanShare) {
    touched.clear();
    for (Index v = 0; v < field.distance.size(); ++v) {
      if (field.distance[v] != kInfinity || field.source[v] != kNoIndex) touched.push_back(v);
    }
  } else {
    detail::sort(touched.begin(), touched.end());
  }
  result.vertex.resize(touched.size());
  result.distance.resize(touched.size());
  result.source.resize(touched.size());
  std::size_t count = 0;
  for (const Index v : touched) {
    const double d = offsets.value(field.distance[v], field.source[v], unit, options.bound);
    if (d == kInfinity || d > options.max_distance) continue;
    result.vertex[count] = v;
    result.distance[count] = d;
    result.source[count++] = field.source[v];
  }
  result.vertex.resize(count);
  result.distance.resize(count);
  result.source.resize(count);
  finish_targets(unit, targets, offsets, options, field);
  result.target_distance.swap(field.target_distance);
  result.target_source.swap(field.target_source);
  result.windows = std::move(field.windows);
}

}  // namespace brushfire::detail
