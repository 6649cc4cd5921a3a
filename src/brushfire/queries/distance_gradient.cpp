// Vertices from the farthest to the nearest hand their weight on along their last legs; what crosses an edge pulls at
// its two ends.
#include <brushfire/queries/distance_gradient.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/solvers/detail/walls.h>
#include <brushfire/solvers/windows/paths/ray_forest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace brushfire {
namespace {

using On = PointLocation::On;
using windows::RayForest;

Vec3 direction(Vec3 v) {
  const double length = norm(v);
  return length > 0 ? (1 / length) * v : Vec3{};
}

// The frame of a halfedge in space.
struct Axes {
  Vec3 along, inward;
};

class Sweep {
 public:
  Sweep(const Mesh& mesh, const WindowField& field, std::span<const Source> sources)
      : mesh_(mesh),
        field_(field),
        forest_(field),
        waiting_(mesh.vertex_count(), 0),
        gradient_{std::vector<Vec3>(mesh.vertex_count()), std::vector<Vec3>(sources.size()),
                  std::vector<double>(sources.size(), 0)} {
    for (const Source& s : sources) sources_.push_back(locate(mesh, s.point));
  }

  void add_weight(Index v, double weight) { waiting_[v] += weight; }

  // Of all vertices, the farthest first: what comes to a vertex that has been asked already goes on at once.
  DistanceGradient run(std::span<const Index> farthest_first) {
    Poll poll(64);
    std::vector<bool> asked(mesh_.vertex_count(), false);
    for (const Index v : farthest_first) {
      asked[v] = true;
      for (Index at = v; at < mesh_.vertex_count() && asked[at] && waiting_[at] != 0;) {
        poll();
        at = hand_on(at);
      }
    }
    for (const RayForest::Crossing& c : forest_.sums()) cross(c);
    return std::move(gradient_);
  }

 private:
  Axes axes(Index h) const {
    const std::span<const Vec3> at = mesh_.positions();
    const Vec3 a = at[mesh_.from(h)], b = at[mesh_.to(h)], c = at[mesh_.from(Mesh::previous(h))];
    const Vec3 along = direction(b - a);
    return {along, direction(brushfire::cross(brushfire::cross(along, c - a), along))};
  }
  static Vec3 in_space(const Axes& axes, Vec2 v) { return v.x * axes.along + v.y * axes.inward; }

  void pull(Index v, Vec3 force) { gradient_.vertices[v] = gradient_.vertices[v] + force; }
  void pull(const SurfacePoint& p, Vec3 force) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (p.weights[k] != 0) pull(mesh_.faces()[p.face][k], p.weights[k] * force);
    }
  }

  // The weight of a vertex along its last leg, which may begin at another vertex: that one.
  Index hand_on(Index v) {
    const double weight = waiting_[v];
    waiting_[v] = 0;
    if (const std::optional<RayForest::Arrival> arrival = forest_.add(v, weight)) {
      const Vec3 arrow = in_space(axes(arrival->halfedge), arrival->arrow);
      pull(v, weight * arrow);
      if (!arrival->crosses) begin(arrival->start, Mesh::face_of(arrival->halfedge), weight * arrow);
      return start_of(arrival->start, weight);
    }
    const WindowField::Leg leg = field_.last_leg(v);
    if (leg.points.empty()) throw Error(ErrorCode::Internal, "a leg was lost: please report the mesh and the sources");
    const Index start = leg.vertex != kNoIndex ? leg.vertex : mesh_.vertex_count() + leg.source;
    along_points(leg, weight, start);
    return start_of(start, weight);
  }

  // Whoever is at the beginning has the weight, too.
  Index start_of(Index start, double weight) {
    if (start < mesh_.vertex_count()) {
      waiting_[start] += weight;
    } else {
      gradient_.offsets[start - mesh_.vertex_count()] += weight;
    }
    return start;
  }

  // A leg by its points, from its end to its beginning.
  void along_points(const WindowField::Leg& leg, double weight, Index start) {
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
  }

  // What crosses an edge pulls at its ends: for each of the two faces with what goes through it at a right angle.
  void cross(const RayForest::Crossing& c) {
    const Index h = c.halfedge, over = mesh_.opposite()[h];
    const Axes here = axes(h), beyond = axes(over);
    const double to = brushfire::cross(c.source, c.arrow) / mesh_.lengths()[h], from = c.arrow.y - to;
    const Vec3 turn = here.inward + beyond.inward;
    pull(mesh_.from(h), from * turn);
    pull(mesh_.to(h), to * turn);
    if (c.start != kNoIndex) begin(c.start, Mesh::face_of(h), in_space(here, c.arrow));
  }

  // Arrows that leave a vertex or source into a face.
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

  const Mesh& mesh_;
  const WindowField& field_;
  RayForest forest_;
  std::vector<PointLocation> sources_;
  std::vector<double> waiting_;  // [vertex_count] weight that has come to a vertex and has not gone on
  DistanceGradient gradient_;
};

void check(const Domain& domain, const DistanceField& field, std::size_t weights) {
  const auto refuse = [](const std::string& why) { throw Error(ErrorCode::InvalidArgument, why); };
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
  check(domain, field, weights.size());
  const Mesh& open = domain.open();
  const DistanceOptions options;
  const detail::WalledRun walled(domain, sources, options);
  const std::span<const double> value = domain.has_walls() ? field.side_distance : field.distance;
  Sweep sweep(open, *field.windows, walled.sources());
  std::vector<bool> is_placed(domain.mesh().vertex_count(), false);
  std::vector<Index> farthest_first;
  for (Index v = 0; v < open.vertex_count(); ++v) {
    if (value[v] < kInfinity) farthest_first.push_back(v);
    const Index w = domain.vertex(v);
    if (!std::isfinite(weights[w])) {
      throw Error(ErrorCode::InvalidArgument, "the weight of vertex " + std::to_string(w) + " is not finite");
    }
    // Of the sides of a wall, the one that has the vertex's distance.
    if (!is_placed[w] && value[v] < kInfinity && value[v] == field.distance[w]) {
      is_placed[w] = true;
      sweep.add_weight(v, weights[w]);
    }
  }
  std::sort(farthest_first.begin(), farthest_first.end(),
            [&](Index a, Index b) { return value[a] != value[b] ? value[a] > value[b] : a < b; });

  const DistanceGradient found = sweep.run(farthest_first);
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
