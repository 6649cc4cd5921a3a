// Rays are traced back until they meet one that was, and sums are taken from the leaves to the roots.
#include <brushfire/solvers/windows/paths/ray_forest.h>

#include <brushfire/solvers/windows/algebra/frame.h>
#include <brushfire/solvers/windows/paths/departures.h>

#include <algorithm>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

Vec2 direction_of(Vec2 v) { return (1 / norm(v)) * v; }

Vec2 direction_at(const RayCrossing& c) { return direction_of(c.point - c.source); }

}  // namespace

RayForest::RayForest(const WindowField& field)
    : data_(Departures::data_of(field)), first_(data_.mesh.halfedge_count(), kNoIndex) {
  constexpr std::size_t kCrossings = 4;  // of a ray on scans, before it meets another one
  nodes_.reserve(kCrossings * data_.mesh.vertex_count());
}

Index RayForest::find(const RayCrossing& crossing, Index pseudo_source) const {
  const double allowed = kSamePlace * norm(crossing.point - crossing.source);
  for (Index i = first_[crossing.halfedge]; i != kNoIndex; i = nodes_[i].next) {
    if (nodes_[i].pseudo_source == pseudo_source && norm(nodes_[i].source - crossing.source) <= allowed) return i;
  }
  return kNoIndex;
}

std::optional<RayForest::Ray> RayForest::arrival(Index vertex) const {
  const PointRecord& record = data_.vertices[vertex];
  const Index h = record.ray.halfedge;
  if (data_.view || h == kNoIndex || !(record.value < kInfinity)) return std::nullopt;
  const Vec2 apex = frame_of(shape_of(data_.mesh, Mesh::face_of(h)), h % 3).apex;
  const double length = norm(apex - record.ray.source);
  if (!(length > 0)) return std::nullopt;
  return Ray{h, (1 / length) * (apex - record.ray.source), apex, length * data_.mesh.unit()};
}

std::optional<RayForest::Arrival> RayForest::add(Index vertex, double weight) {
  const std::optional<Ray> came = arrival(vertex);
  if (!came) return std::nullopt;
  const PointRecord& record = data_.vertices[vertex];
  const windows::Ray& ray = record.ray;
  const Index n = data_.mesh.vertex_count();
  FaceWeights at{Mesh::face_of(ray.halfedge), {0, 0, 0}};
  at.weights[Mesh::previous(ray.halfedge) % 3] = 1;
  trail_.clear();
  Index root = kNoIndex;
  const WindowField::Leg leg = trace_leg(data_, at, record, [&](const RayCrossing& crossing) {
    trail_.push_back(crossing);
    root = find(crossing, ray.pseudo_source);
    return root != kNoIndex;
  });
  if (root != kNoIndex ? !is_explained(data_, record) : leg.points.empty()) return std::nullopt;

  Arrival arrival{ray.halfedge, came->arrow, ray.pseudo_source, !trail_.empty()};
  // Rays are shared only where they come from the pseudo-source itself.
  if (root == kNoIndex) arrival.start = leg.vertex != kNoIndex ? leg.vertex : n + leg.source;
  if (trail_.empty()) return arrival;
  const std::size_t count = trail_.size() - (root != kNoIndex ? 1 : 0);
  const Index leaf = add_trail(root, count, ray.pseudo_source, arrival.start, arrival.start == ray.pseudo_source);
  nodes_[leaf].arrow = nodes_[leaf].arrow + weight * direction_at(trail_.front());
  return arrival;
}

// Nodes for the first `count` crossings of the trail, the last of them below `root`; the one of the first.
Index RayForest::add_trail(Index root, std::size_t count, Index pseudo_source, Index start, bool can_be_shared) {
  Index parent = root;
  for (std::size_t k = count; k-- > 0;) {
    const RayCrossing& c = trail_[k];
    Node node;
    node.source = c.source;
    node.direction = direction_at(c);
    node.halfedge = c.halfedge;
    node.pseudo_source = pseudo_source;
    node.parent = parent;
    if (parent != kNoIndex) {
      node.parent_direction = direction_at(trail_[k + 1]);
      node.turned = c.mirrored != trail_[k + 1].mirrored;
    } else {
      node.start = start;
    }
    parent = static_cast<Index>(nodes_.size());
    if (can_be_shared) {
      node.next = first_[c.halfedge];
      first_[c.halfedge] = parent;
    }
    nodes_.push_back(node);
  }
  return parent;
}

std::vector<RayForest::Crossing> RayForest::sums() const {
  std::vector<Crossing> sums(nodes_.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i] = {nodes_[i].halfedge, nodes_[i].source, nodes_[i].arrow, nodes_[i].start};
  }
  for (std::size_t i = sums.size(); i-- > 0;) {
    const Node& node = nodes_[i];
    if (node.parent == kNoIndex) continue;
    // The same arrow in the parent's frame: what it has along the direction that both know, and across.
    const double along = dot(node.direction, sums[i].arrow), left = cross(node.direction, sums[i].arrow);
    const double across = node.turned ? -left : left;
    const Vec2 u = node.parent_direction;
    Vec2& sum = sums[node.parent].arrow;
    sum = sum + along * u + across * Vec2{-u.y, u.x};
  }
  return sums;
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
