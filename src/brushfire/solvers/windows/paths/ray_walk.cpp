// The step from edge to edge, without a square root or a division.
#include <brushfire/solvers/windows/paths/ray_walk.h>

#include <brushfire/core/detail/prefetch.h>
#include <brushfire/solvers/windows/algebra/frame.h>
#include <brushfire/solvers/windows/paths/departures.h>
#include <brushfire/solvers/windows/paths/leg_search.h>

#include <algorithm>
#include <cmath>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

RayWalk::RayWalk(const WindowField& field) : data_(Departures::data_of(field)), faces_(data_.mesh.face_count()) {
  const Mesh& mesh = data_.mesh;
  const std::span<const Index> opposite = mesh.opposite();
  for (Index f = 0; f < mesh.face_count(); ++f) {
    Face& face = faces_[f];
    const std::array<double, 3>& l = face.length = shape_of(mesh, f).length;
    face.vertex = mesh.faces()[f];
    for (Index k = 0; k < 3; ++k) {
      // Where a side has no length these are no numbers, and no ray goes on.
      const double before = l[previous3(k)], product = l[k] * before;
      const double c = (l[k] * l[k] + (before - l[next3(k)]) * (before + l[next3(k)])) / (2 * product);
      const double s = mesh.double_areas()[f] / product;
      const double to_one = 1.5 - 0.5 * (c * c + s * s);  // a step of Newton's towards length 1
      face.cosine[k] = to_one * c;
      face.sine[k] = to_one * s;
      const Index h = 3 * f + k, g = opposite[h];
      const bool is_plain = g != h && opposite[g] == h && mesh.from(g) == mesh.to(h);
      face.across[k] = is_plain ? g : kNoIndex;
    }
  }
}

void RayWalk::follow(std::span<Ray> rays) const {
  std::vector<Step> steps;
  steps.reserve(rays.size());
  for (Ray& ray : rays) {
    Step step;
    step.ray = &ray;
    if (begin(step)) steps.push_back(step);
  }
  // A ray crosses a face a few times at most.
  for (std::size_t budget = 16 + 3 * faces_.size(); !steps.empty() && budget > 0; --budget) {
    for (std::size_t i = 0; i < steps.size();) {
      const Went went = on(steps[i]);
      if (went == Went::On) {
        ++i;
        continue;
      }
      Ray& ray = *steps[i].ray;
      ray.u = steps[i].u;
      if (went == Went::Home) ray.start = data_.vertices[ray.vertex].ray.pseudo_source;
      steps[i] = steps.back();
      steps.pop_back();
    }
  }
}

// Nothing of a source on an edge of three faces.
std::optional<RayWalk::Goal> RayWalk::goal_of(Index pseudo_source) const {
  Goal goal;
  if (pseudo_source < data_.mesh.vertex_count()) {
    goal.vertex = pseudo_source;
    goal.value = data_.vertices[pseudo_source].value;
    return goal;
  }
  const detail::LocatedSource& source = data_.sources[pseudo_source - data_.mesh.vertex_count()];
  goal.value = source.offset + data_.shift;
  if (source.at.on == PointLocation::On::Vertex) {
    goal.vertex = source.at.vertex;
    return goal;
  }
  std::size_t count = 0;
  for_each_face_around(data_.mesh, source.at, [&](const FaceWeights& f) {
    if (count < goal.places.size()) goal.places[count] = f;
    ++count;
  });
  return count <= goal.places.size() ? std::optional(goal) : std::nullopt;
}

// Over the first edge.
bool RayWalk::begin(Step& step) const {
  Ray& ray = *step.ray;
  ray.crossings.clear();
  ray.start.reset();
  const PointRecord& record = data_.vertices[ray.vertex];
  if (record.ray.kind != WindowKind::Circular) return false;
  const std::optional<Goal> goal = goal_of(record.ray.pseudo_source);
  if (!goal) return false;
  step.vertex = goal->vertex;
  step.face = goal->places[0].face;
  step.beyond = goal->places[1].face;
  const Vec2 apex = ray.arrival.apex, u = ray.arrival.arrow;
  const double length = norm(apex - record.ray.source);
  if (!(goal->value < record.value && std::abs(goal->value + length - record.value) <= data_.room_for(record))) {
    return false;
  }
  step.room = 2 * kThrough * length;
  const Face& face = faces_[Mesh::face_of(ray.arrival.halfedge)];
  const Index k = ray.arrival.halfedge % 3, beyond = face.across[k];
  const double l = face.length[k], moment = cross(apex, u), rest = l * u.y - moment;
  if (beyond == kNoIndex || !(std::min(moment, rest) > std::max(step.room, kTooShort * l * u.y))) return false;
  step.halfedge = beyond;
  step.u = -1 * u;
  step.moment = -rest;
  step.along = dot(apex, u) - length - l * u.x;
  ray.crossings.push_back({beyond, step.u.y, step.moment});
  return true;
}

// Whether the ray began in the face that it has come to, where it leads.
bool RayWalk::is_home(const Step& step) const {
  const Index f = Mesh::face_of(step.halfedge), k = step.halfedge % 3, after = next3(k), before = previous3(k);
  const Face& face = faces_[f];
  const Vec2 apex = face.length[before] * Vec2{face.cosine[k], face.sine[k]};
  Vec2 place = apex;
  if (face.vertex[before] != step.vertex) {
    const Goal goal = *goal_of(data_.vertices[step.ray->vertex].ray.pseudo_source);
    const std::array<Real, 3>& weights = goal.places[f == step.face ? 0 : 1].weights;
    place = Vec2{weights[after] * face.length[k], 0} + weights[before] * apex;
  }
  const double way = step.moment / step.u.y * step.u.x - step.along;
  return way > kTooShort * face.length[k] && std::abs(cross(place, step.u) - step.moment) <= kMissed * way &&
         std::abs(dot(place, step.u) - step.along) <= kMissed * way;
}

// Through the face, to the left or to the right of its apex.
RayWalk::Went RayWalk::on(Step& step) const {
  const Index f = Mesh::face_of(step.halfedge), k = step.halfedge % 3, after = next3(k), before = previous3(k);
  const Face& face = faces_[f];
  if (face.vertex[before] == step.vertex || f == step.face || f == step.beyond) {
    if (is_home(step)) return Went::Home;
  }
  const Vec2 u = step.u;
  const double c = face.cosine[k], s = face.sine[k], l = face.length[before];
  const double beside = l * (c * u.y - s * u.x) - step.moment, ahead = l * (c * u.x + s * u.y);
  const bool left = beside < 0;
  const double other = left ? -step.moment : step.moment - face.length[k] * u.y;
  const Index corner = left ? k : after, exit = left ? before : after;
  const double cosine = face.cosine[corner], sine = left ? -s : face.sine[after];
  step.u = {cosine * u.x - sine * u.y, sine * u.x + cosine * u.y};
  step.halfedge = face.across[exit];
  const double near = std::min(std::abs(beside), other);
  if (!(near > std::max(step.room, -kTooShort * face.length[exit] * step.u.y)) || step.halfedge == kNoIndex) {
    return Went::Astray;
  }
  prefetch(&faces_[Mesh::face_of(step.halfedge)]);
  prefetch(&faces_[Mesh::face_of(step.halfedge)].across);
  step.moment = left ? step.moment : -beside;
  step.along = left ? step.along : step.along - ahead;
  step.ray->crossings.push_back({step.halfedge, step.u.y, step.moment});
  return Went::On;
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
