// Weights are handed on from vertices to their pseudo-sources, and go along the last leg of each; what crosses an edge
// pulls at its two ends.
#include <brushfire/queries/distance_gradient.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/mesh/detail/locality_order.h>
#include <brushfire/solvers/detail/walls.h>
#include <brushfire/solvers/windows/paths/field_rays.h>
#include <brushfire/solvers/windows/paths/ray_walk.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <string>
#include <utility>

namespace brushfire {
namespace {

using On = PointLocation::On;
using windows::FieldRays;

Vec3 direction(Vec3 v) {
  const double length = norm(v);
  return length > 0 ? (1 / length) * v : Vec3{};
}

// The frame of a halfedge in space.
struct Axes {
  Vec3 along, inward;
};

// Rays that are followed at once: enough for none to wait for memory, few enough for their crossings to stay near.
constexpr std::size_t kTogether = 8;

class Sweep {
 public:
  // value: of every vertex of the mesh.
  Sweep(const Mesh& mesh, const WindowField& field, std::span<const Source> sources, std::span<const double> value)
      : mesh_(mesh),
        field_(field),
        rays_(field),
        walk_(field),
        value_(value),
        pull_(mesh.halfedge_count()),
        stray_(mesh.vertex_count(), 0),
        gradient_{std::vector<Vec3>(mesh.vertex_count()), std::vector<Vec3>(sources.size()),
                  std::vector<double>(sources.size(), 0)} {
    for (const Source& s : sources) sources_.push_back(locate(mesh, s.point));
  }

  // weights: of every vertex.
  DistanceGradient run(std::vector<double> weights) {
    add_up(weights);
    Poll poll(64);
    // Rays of neighbours run through the same faces.
    std::size_t waiting = 0;
    for (const Index v : vertex_locality_order(mesh_).vertices) {
      poll();
      if (weights[v] == 0) continue;
      if (const std::optional<FieldRays::Arrival> arrival = rays_.arrival(v)) {
        together_[waiting].vertex = v;
        together_[waiting++].arrival = *arrival;
        if (waiting == together_.size()) follow(std::exchange(waiting, 0), weights);
      } else {
        check_start(v, leg(v, weights[v]), weights[v]);
      }
    }
    follow(waiting, weights);
    while (!strays_.empty()) {
      poll();
      const Index v = strays_.top().second;
      strays_.pop();
      if (const double weight = std::exchange(stray_[v], 0); weight != 0) send_on(leg(v, weight), weight);
    }
    for (Index h = 0; h < mesh_.halfedge_count(); ++h) turn(h);
    return std::move(gradient_);
  }

 private:
  // What goes along the path of a vertex goes along that of its pseudo-source, too: from the farthest to the nearest.
  void add_up(std::vector<double>& weights) {
    std::vector<Index> farthest_first;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (value_[v] < kInfinity) {
        farthest_first.push_back(v);
      } else {
        weights[v] = 0;
      }
    }
    std::sort(farthest_first.begin(), farthest_first.end(),
              [&](Index a, Index b) { return value_[a] != value_[b] ? value_[a] > value_[b] : a < b; });
    for (const Index v : farthest_first) {
      if (weights[v] == 0) continue;
      const Index from = parent(v);
      if (from >= mesh_.vertex_count()) {
        if (from != kNoIndex) gradient_.offsets[from - mesh_.vertex_count()] += weights[v];
      } else {
        weights[from] += weights[v];
      }
    }
  }

  // Where the last leg of a vertex should start; kNoIndex: not known before it is traced.
  Index parent(Index v) const {
    const Index from = rays_.pseudo_source(v);
    return from >= mesh_.vertex_count() || value_[from] < value_[v] ? from : kNoIndex;
  }

  Axes axes(Index h) const {
    const std::span<const Vec3> at = mesh_.positions();
    const Vec3 a = at[mesh_.from(h)], b = at[mesh_.to(h)], c = at[mesh_.from(Mesh::previous(h))];
    const Vec3 along = direction(b - a);
    return {along, direction(cross(cross(along, c - a), along))};
  }
  static Vec3 in_space(const Axes& axes, Vec2 v) { return v.x * axes.along + v.y * axes.inward; }

  void pull(Index v, Vec3 force) { gradient_.vertices[v] = gradient_.vertices[v] + force; }
  void pull(const SurfacePoint& p, Vec3 force) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (p.weights[k] != 0) pull(mesh_.faces()[p.face][k], p.weights[k] * force);
    }
  }

  // More weight for the path to a vertex (or a source); what comes together goes on together, the farthest first.
  void send_on(Index at, double weight) {
    if (at >= mesh_.vertex_count()) {
      gradient_.offsets[at - mesh_.vertex_count()] += weight;
      return;
    }
    stray_[at] += weight;
    strays_.emplace(value_[at], at);
  }

  // The last leg of a vertex, with all the weight that goes along it; where it starts.
  Index leg(Index v, double weight) {
    if (const std::optional<FieldRays::Arrival> arrival = rays_.arrival(v)) {
      if (const std::optional<Index> start = rays_.trace(v, crossings_)) {
        along_ray(v, *arrival, weight, *start);
        return *start;
      }
    }
    return along_points(v, weight);
  }

  void along_ray(Index v, const FieldRays::Arrival& arrival, double weight, Index start) {
    const Vec3 arrow = weight * in_space(axes(arrival.halfedge), arrival.arrow);
    pull(v, arrow);
    if (crossings_.empty()) return begin(start, Mesh::face_of(arrival.halfedge), arrow);
    Vec2 u;
    for (const windows::RayCrossing& c : crossings_) {
      const Vec2 way = c.point - c.source;
      u = (weight / norm(way)) * way;
      Pull& p = pull_[c.halfedge];
      p.across += u.y;
      p.moment += cross(c.source, u);
    }
    begin(start, Mesh::face_of(crossings_.back().halfedge), in_space(axes(crossings_.back().halfedge), u));
  }

  // The last legs of some vertices at once.
  void follow(std::size_t count, const std::vector<double>& weights) {
    const std::span<windows::RayWalk::Ray> rays = std::span(together_).first(count);
    walk_.follow(rays);
    for (const windows::RayWalk::Ray& ray : rays) {
      const double weight = weights[ray.vertex];
      if (!ray.start) {
        check_start(ray.vertex, leg(ray.vertex, weight), weight);
        continue;
      }
      pull(ray.vertex, weight * in_space(axes(ray.arrival.halfedge), ray.arrival.arrow));
      for (const windows::RayWalk::Crossing& c : ray.crossings) {
        pull_[c.halfedge].across += weight * c.across;
        pull_[c.halfedge].moment += weight * c.moment;
      }
      const Index last = ray.crossings.back().halfedge;
      begin(*ray.start, Mesh::face_of(last), weight * in_space(axes(last), ray.u));
      check_start(ray.vertex, *ray.start, weight);
    }
  }

  // A leg that starts elsewhere than was thought: it passes through a vertex, or is another one as short.
  void check_start(Index v, Index start, double weight) {
    const Index thought = parent(v);
    if (start == thought) return;
    send_on(start, weight);
    if (thought != kNoIndex) send_on(thought, -weight);
  }

  // The same by the leg's points, from its end to its beginning.
  Index along_points(Index v, double weight) {
    const WindowField::Leg leg = field_.last_leg(v);
    if (leg.points.empty()) throw Error(ErrorCode::Internal, "a leg was lost: please report the mesh and the sources");
    const Index start = leg.vertex != kNoIndex ? leg.vertex : mesh_.vertex_count() + leg.source;
    for (std::size_t i = 0; i + 1 < leg.points.size(); ++i) {
      const SurfacePoint &here = leg.points[i], &before = leg.points[i + 1];
      const Vec3 arrow = weight * direction(position(mesh_, here) - position(mesh_, before));
      pull(here, arrow);
      if (i + 2 < leg.points.size()) {
        pull(before, -1 * arrow);
      } else {
        begin(start, common_face(mesh_, locate(mesh_, here, 0), locate(mesh_, before, 0), before.face), arrow);
      }
    }
    return start;
  }

  // What has crossed an edge pulls at its ends: in each of its two faces with the part at a right angle to it.
  void turn(Index h) {
    const Pull& p = pull_[h];
    if (p.across == 0 && p.moment == 0) return;
    const double to = p.moment / mesh_.lengths()[h], from = p.across - to;
    const Vec3 fold = axes(h).inward + axes(mesh_.opposite()[h]).inward;
    pull(mesh_.from(h), from * fold);
    pull(mesh_.to(h), to * fold);
  }

  // An arrow that leaves a vertex or source into a face.
  void begin(Index start, Index face, Vec3 arrow) {
    const Vec3 back = -1 * arrow;
    if (start < mesh_.vertex_count()) return pull(start, back);
    const PointLocation& source = sources_[start - mesh_.vertex_count()];
    pull(SurfacePoint{source.face, source.weights}, back);
    Vec3& place = gradient_.places[start - mesh_.vertex_count()];
    place = place + (face == source.face || source.on != On::Edge ? back : over_edge(source, face, back));
  }

  // From another face at a source's edge into the plane of the source's own.
  Vec3 over_edge(const PointLocation& source, Index face, Vec3 arrow) const {
    Index h = mesh_.opposite()[source.halfedge];
    while (Mesh::face_of(h) != face && h != source.halfedge) h = mesh_.opposite()[h];
    const Axes own = axes(source.halfedge);
    return dot(arrow, own.along) * own.along - dot(arrow, axes(h).inward) * own.inward;
  }

  // Of all arrows u that cross a halfedge, from s in its frame: the sums of u.y, which pulls at the edge at a right
  // angle, and of s x u, its moment about the halfedge's start: how much of it is at the other end.
  struct Pull {
    double across = 0, moment = 0;
  };

  const Mesh& mesh_;
  const WindowField& field_;
  FieldRays rays_;
  windows::RayWalk walk_;
  std::span<const double> value_;
  std::vector<PointLocation> sources_;
  std::vector<Pull> pull_;                                // [halfedge_count]
  std::vector<double> stray_;                             // [vertex_count] weight that still has to go on from there
  std::priority_queue<std::pair<double, Index>> strays_;  // by value: where there is some
  std::array<windows::RayWalk::Ray, kTogether> together_;
  std::vector<windows::RayCrossing> crossings_;  // of the ray at hand
  DistanceGradient gradient_;
};

void check(const Domain& domain, std::span<const Source> sources, const DistanceField& field, std::size_t weights) {
  const auto refuse = [](const std::string& why) { throw Error(ErrorCode::InvalidArgument, why); };
  if (std::any_of(sources.begin(), sources.end(), [](const Source& s) { return s.curve != nullptr; })) {
    refuse("gradients are of distances from points: from curves there are none");
  }
  if (!field.windows) refuse("a gradient needs the paths of the field: run method exact with keep_paths");
  if (!domain.mesh().has_positions()) refuse("a gradient by positions needs a mesh that has some");
  if (field.windows->mesh().vertex_count() != domain.open().vertex_count() ||
      field.distance.size() != domain.mesh().vertex_count()) {
    refuse("the field is of another mesh");
  }
  if (weights != domain.mesh().vertex_count()) {
    refuse(std::to_string(weights) + " weights for " + std::to_string(domain.mesh().vertex_count()) + " vertices");
  }
}

}  // namespace

DistanceGradient distance_gradient_wrt_vertices(const Domain& domain, std::span<const Source> sources,
                                                const DistanceField& field, std::span<const double> weights) {
  check(domain, sources, field, weights.size());
  const Mesh& open = domain.open();
  const DistanceOptions options;
  const detail::WalledRun walled(domain, sources, options);
  const std::span<const double> value = domain.has_walls() ? field.side_distance : field.distance;
  std::vector<double> open_weights(open.vertex_count(), 0);
  std::vector<bool> is_placed(domain.mesh().vertex_count(), false);
  for (Index v = 0; v < open.vertex_count(); ++v) {
    const Index w = domain.vertex(v);
    if (!std::isfinite(weights[w])) {
      throw Error(ErrorCode::InvalidArgument, "the weight of vertex " + std::to_string(w) + " is not finite");
    }
    // Of the sides of a wall, the one that has the vertex's distance.
    if (is_placed[w] || value[v] == kInfinity || value[v] != field.distance[w]) continue;
    is_placed[w] = true;
    open_weights[v] = weights[w];
  }
  const DistanceGradient found = Sweep(open, *field.windows, walled.sources(), value).run(std::move(open_weights));
  DistanceGradient gradient{std::vector<Vec3>(domain.mesh().vertex_count()), std::vector<Vec3>(sources.size()),
                            std::vector<double>(sources.size(), 0)};
  for (Index v = 0; v < open.vertex_count(); ++v) {
    Vec3& sum = gradient.vertices[domain.vertex(v)];
    sum = sum + found.vertices[v];
  }
  for (Index s = 0; s < found.places.size(); ++s) {
    const Index origin = walled.origin(s);
    gradient.places[origin] = gradient.places[origin] + found.places[s];
    gradient.offsets[origin] += found.offsets[s];
  }
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t s = 0; s < sources.size(); ++s) {
    if (locate(domain.mesh(), sources[s].point).on == On::Vertex) gradient.places[s] = {kNone, kNone, kNone};
  }
  return gradient;
}

}  // namespace brushfire
