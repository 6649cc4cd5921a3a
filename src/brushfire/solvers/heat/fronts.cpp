// Which source a vertex belongs to, and the value that its source gives it.
#include <brushfire/solvers/heat/fronts.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>

#include <algorithm>
#include <functional>
#include <queue>
#include <string>
#include <tuple>
#include <utility>

namespace brushfire::heat {
namespace {

struct Reading {
  const Mesh& mesh;
  std::span<const double> potential;
  std::size_t width;

  double at(Index v) const { return potential[width * v]; }
  // What the function is at the source, by what its neighbours read and how far from it they are.
  double at(const Origin& o) const {
    double sum = 0, weights = 0;
    for (int k = 0; k < o.count; ++k) {
      sum += o.corners[k].weight * (at(o.corners[k].vertex) - o.corners[k].distance);
      weights += o.corners[k].weight;
    }
    return sum / weights;
  }
};

// In each component the sources whose fronts start: all that the front of the first one reaches no sooner.
std::vector<bool> starting(const System& system, std::span<const Origin> origins, const Reading& reading) {
  std::vector<const Origin*> first(system.component_count(), nullptr);
  for (const Origin& o : origins) {
    const Origin*& best = first[system.component(o.corners[0].vertex)];
    if (!best || o.offset < best->offset) best = &o;
  }
  std::vector<bool> starts;
  for (const Origin& o : origins) {
    const Origin& best = *first[system.component(o.corners[0].vertex)];
    const double when_reached = best.offset + reading.at(o) - reading.at(best);
    // The function is that much off at sources themselves, whose tips it rounds.
    starts.push_back(o.offset == best.offset ||
                     o.offset < when_reached + system.mean_edge_in(system.component(o.corners[0].vertex)));
  }
  return starts;
}

// Which of the starting origins each vertex belongs to: the function's lowest ways up.
std::vector<Index> flooded(const Mesh& mesh, std::span<const Origin> origins, const std::vector<bool>& starts,
                           const Reading& reading) {
  std::vector<Index> owner(mesh.vertex_count(), kNoIndex);
  using Entry = std::tuple<double, Index, Index>;  // height, owner, vertex
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto take = [&](Index v, Index by) {
    if (owner[v] != kNoIndex) return;
    owner[v] = by;
    queue.emplace(reading.at(v), by, v);
  };
  for (Index i = 0; i < origins.size(); ++i) {  // those at vertices first: nobody else's corner is to take them
    if (starts[i] && origins[i].count == 1) take(origins[i].corners[0].vertex, i);
  }
  for (Index i = 0; i < origins.size(); ++i) {
    for (int k = 0; starts[i] && k < origins[i].count; ++k) take(origins[i].corners[k].vertex, i);
  }
  Poll poll;
  while (!queue.empty()) {
    poll();
    const auto [height, by, v] = queue.top();
    queue.pop();
    for (const Index h : mesh.corners(v)) {
      take(mesh.to(h), by);
      take(mesh.from(Mesh::previous(h)), by);
    }
  }
  return owner;
}

}  // namespace

std::vector<Origin> origins_of(const Mesh& mesh, const System& system, std::span<const detail::LocatedSource> sources) {
  std::vector<Origin> origins;
  for (const detail::LocatedSource& s : sources) {
    Origin& o = origins.emplace_back();
    o.offset = s.offset;
    o.label = s.label;
    if (s.at.on == PointLocation::On::Vertex) {
      o.corners[o.count++] = {s.at.vertex, 1, 0};
    } else {
      const std::array<double, 3> away = corner_distances(mesh, s.at);
      for (int k = 0; k < 3; ++k) {
        if (s.at.weights[k] > 0) o.corners[o.count++] = {mesh.faces()[s.at.face][k], s.at.weights[k], away[k]};
      }
    }
    const auto takes = [&](const Origin::Corner& c) { return system.takes_heat(c.vertex); };
    if (std::none_of(o.corners.begin(), o.corners.begin() + o.count, takes)) {
      throw Error(ErrorCode::InvalidArgument, "heat: source " + std::to_string(s.label) +
                                                  " lies on the border, which boundary 'dirichlet' keeps cold: take "
                                                  "'neumann' or 'averaged'");
    }
  }
  return origins;
}

Sparks sparks_of(const System& system, std::span<const Origin> origins) {
  std::vector<double> least(system.component_count(), kInfinity);
  for (const Origin& o : origins) {
    double& offset = least[system.component(o.corners[0].vertex)];
    offset = std::min(offset, o.offset);
  }
  Sparks sparks;
  for (const Origin& o : origins) {
    const Index component = system.component(o.corners[0].vertex);
    const double delay = (o.offset - least[component]) / std::sqrt(system.time_in(component));
    for (int k = 0; k < o.count; ++k) sparks.push_back({o.corners[k].vertex, o.corners[k].weight, delay});
  }
  return sparks;
}

void read_off(const Mesh& mesh, const System& system, std::span<const Origin> origins,
              std::span<const double> potential, std::size_t width, std::span<double> distance,
              std::span<Index> source) {
  const Reading reading{mesh, potential, width};
  constexpr Index kSeveral = kNoIndex - 1;
  std::vector<Index> only(system.component_count(), kNoIndex);  // the origin of a component that has one
  bool any_several = false;
  const auto rank = [&](Index i) { return std::pair(origins[i].offset, origins[i].label); };
  for (Index i = 0; i < origins.size(); ++i) {
    const Index component = system.component(origins[i].corners[0].vertex);
    Index& o = only[component];
    if (o == kNoIndex) {
      o = i;
    } else if (system.is_point(component)) {
      if (rank(i) < rank(o)) o = i;
    } else {
      any_several = true;
      o = kSeveral;
    }
  }
  std::vector<double> own;
  for (const Origin& o : origins) own.push_back(reading.at(o));
  std::vector<Index> owner;
  if (any_several) owner = flooded(mesh, origins, starting(system, origins, reading), reading);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (system.component(v) == kNoIndex) continue;
    Index by = only[system.component(v)];
    if (by == kNoIndex) continue;
    if (by == kSeveral) by = owner[v];
    if (by == kNoIndex) continue;
    const double offset = origins[by].offset;
    // The offset last: one that is far below the readings would be lost in them, and the source not read it.
    distance[v] = system.is_point(system.component(v)) ? offset : offset + std::max(0.0, reading.at(v) - own[by]);
    source[v] = origins[by].label;
  }
}

}  // namespace brushfire::heat
