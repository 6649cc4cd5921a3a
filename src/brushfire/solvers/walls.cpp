// Copies of a place are all sources, or all targets; of what is found at copies of a vertex the least counts.
#include <brushfire/core/detail/sort.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/solvers/detail/walls.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

namespace brushfire::detail {
namespace {

Error behind_walls(std::size_t source) {
  return {ErrorCode::InvalidArgument,
          "source " + std::to_string(source) + " lies behind a wall: nothing can be reached from there"};
}

// A curve's segments where the mesh is open: along a wall on each side of it, each one a piece of its own, since walls
// may part what meets in a place.
std::shared_ptr<const CurveSource> open_part_of(const Domain& domain, const CurveSource& curve, std::size_t source) {
  const Mesh& mesh = domain.mesh();
  const std::vector<Index>& open_face = domain.cut()->cut_face;
  const LocatedCurve located = locate(mesh, curve);
  CurveSource open;
  const auto add = [&](const SurfacePoint& p, double offset) {
    open.places.push_back(p);
    open.offsets.push_back(offset);
  };
  const auto add_segment = [&](Index face, const std::array<double, 3>& from, const std::array<double, 3>& to,
                               const CurveSegment& s) {
    if (open_face[face] == kNoIndex) return;
    add({open_face[face], from}, s.from_offset);
    add({open_face[face], to}, s.to_offset);
    add({}, 0);
  };
  for (const CurveSegment& s : located.segments) {
    if (!s.along_edge) {
      add_segment(s.face, s.from, s.to, s);
      continue;
    }
    const PointLocation& from = located.places[s.from_place].at;
    const PointLocation& to = located.places[s.to_place].at;
    for (const Index f : faces_at(mesh, from)) {
      const auto a = weights_in(mesh, from, f), b = weights_in(mesh, to, f);
      if (a && b) add_segment(f, *a, *b, s);
    }
  }
  for (const CurvePlace& p : located.places) {
    for (const SurfacePoint& side : domain.on_open({p.at.face, p.at.weights})) {
      add(side, p.offset);
      add({}, 0);
    }
  }
  for (const Index f : located.inside) {
    if (open_face[f] != kNoIndex) open.inside.push_back(open_face[f]);
  }
  if (open.places.empty()) throw behind_walls(source);
  return std::make_shared<const CurveSource>(std::move(open));
}

}  // namespace

WalledRun::WalledRun(const Domain& domain, std::span<const Source> sources, const DistanceOptions& options)
    : domain_(domain), options_(options) {
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (sources[i].curve) {
      sources_.push_back(
          {{}, sources[i].offset, domain.has_walls() ? open_part_of(domain, *sources[i].curve, i) : sources[i].curve});
      origin_.push_back(static_cast<Index>(i));
      continue;
    }
    const std::vector<SurfacePoint> sides = domain.on_open(sources[i].point);
    if (sides.empty()) throw behind_walls(i);
    for (const SurfacePoint& p : sides) {
      sources_.push_back({p, sources[i].offset});
      origin_.push_back(static_cast<Index>(i));
    }
  }
  options_.targets.clear();
  target_start_.push_back(0);
  for (const SurfacePoint& t : options.targets) {
    const std::vector<SurfacePoint> sides = domain.on_open(t);
    options_.targets.insert(options_.targets.end(), sides.begin(), sides.end());
    // One that is nowhere stays so: a run without targets would be one for all vertices.
    if (sides.empty()) options_.targets.emplace_back();
    target_start_.push_back(options_.targets.size());
  }
}

std::span<const Source> WalledRun::sides_of(std::size_t source) const {
  const auto [first, last] = std::equal_range(origin_.begin(), origin_.end(), static_cast<Index>(source));
  return {sources_.data() + (first - origin_.begin()), static_cast<std::size_t>(last - first)};
}

void WalledRun::bring_targets_back(std::vector<double>& distance, std::vector<Index>& source) const {
  std::vector<double> least;
  std::vector<Index> from;
  for (std::size_t t = 0; t + 1 < target_start_.size(); ++t) {
    std::pair<double, Index> best{kInfinity, kNoIndex};
    for (std::size_t i = target_start_[t]; i < target_start_[t + 1]; ++i) {
      best = std::min(best, {distance[i], origin(source[i])});
    }
    least.push_back(best.first);
    from.push_back(best.second);
  }
  distance = std::move(least);
  source = std::move(from);
}

void WalledRun::bring_back(DistanceField& field) const {
  const Index count = domain_.mesh().vertex_count();
  const std::vector<double> bound = std::exchange(field.error_bound, {});
  const std::vector<Index> source = std::exchange(field.source, {});
  field.side_distance = std::exchange(field.distance, {});
  const std::vector<double>& distance = field.side_distance;
  field.distance.assign(distance.begin(), distance.begin() + count);
  field.source.assign(count, kNoIndex);
  for (Index v = count; v < distance.size(); ++v) {
    double& least = field.distance[domain_.vertex(v)];
    least = std::min(least, distance[v]);
  }
  for (Index v = 0; v < distance.size(); ++v) {
    const Index o = domain_.vertex(v);
    if (distance[v] == field.distance[o]) field.source[o] = std::min(field.source[o], origin(source[v]));
  }
  if (!bound.empty()) {
    // The truth is between the least of the lower and the least of the upper bounds of the copies.
    std::vector<double> upper(count, kInfinity), below(count, 0);
    for (Index v = 0; v < distance.size(); ++v) {
      if (distance[v] == kInfinity) continue;
      const Index o = domain_.vertex(v);
      upper[o] = std::min(upper[o], (distance[v] - field.distance[o]) + bound[v]);
      below[o] = std::max(below[o], bound[v] - (distance[v] - field.distance[o]));
    }
    field.error_bound.resize(count);
    for (Index v = 0; v < count; ++v) field.error_bound[v] = std::max(upper[v], below[v]);
  }
  bring_targets_back(field.target_distance, field.target_source);
  field.reached = static_cast<Index>(
      std::count_if(field.distance.begin(), field.distance.end(), [](double d) { return d != kInfinity; }));
  // How many of the copies the front saw is known, and not which.
  field.beyond_radius = std::min(field.beyond_radius, count - field.reached);
  field.unreachable = count - field.reached - field.beyond_radius;
}

void WalledRun::bring_back(SparseField& field) const {
  for (Index& s : field.source) s = origin(s);
  bring_targets_back(field.target_distance, field.target_source);
  if (field.vertex.empty() || field.vertex.back() < domain_.mesh().vertex_count()) return;  // no copy among them
  std::vector<std::tuple<Index, double, Index>> found;
  for (std::size_t i = 0; i < field.vertex.size(); ++i) {
    found.emplace_back(domain_.vertex(field.vertex[i]), field.distance[i], field.source[i]);
  }
  detail::sort(found.begin(), found.end());
  field.vertex.clear();
  field.distance.clear();
  field.source.clear();
  for (const auto& [vertex, distance, source] : found) {
    if (!field.vertex.empty() && field.vertex.back() == vertex) continue;
    field.vertex.push_back(vertex);
    field.distance.push_back(distance);
    field.source.push_back(source);
  }
}

}  // namespace brushfire::detail
