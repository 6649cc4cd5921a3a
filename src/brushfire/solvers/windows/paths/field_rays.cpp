// Rays by their records.
#include <brushfire/solvers/windows/paths/field_rays.h>

#include <brushfire/solvers/windows/algebra/frame.h>
#include <brushfire/solvers/windows/paths/departures.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

FieldRays::FieldRays(const WindowField& field) : data_(Departures::data_of(field)) {}

std::optional<FieldRays::Arrival> FieldRays::arrival(Index vertex) const {
  const PointRecord& record = data_.vertices[vertex];
  const Index h = record.ray.halfedge;
  if (data_.view || h == kNoIndex || !(record.value < kInfinity)) return std::nullopt;
  const Vec2 apex = frame_of(shape_of(data_.mesh, Mesh::face_of(h)), h % 3).apex;
  const double length = norm(apex - record.ray.source);
  if (!(length > 0)) return std::nullopt;
  return Arrival{h, apex, (1 / length) * (apex - record.ray.source), length * data_.mesh.unit()};
}

std::optional<Index> FieldRays::trace(Index vertex, std::vector<RayCrossing>& crossings) const {
  crossings.clear();
  const PointRecord& record = data_.vertices[vertex];
  FaceWeights at{Mesh::face_of(record.ray.halfedge), {0, 0, 0}};
  at.weights[Mesh::previous(record.ray.halfedge) % 3] = 1;
  const WindowField::Leg leg = trace_leg(data_, at, record, [&](const RayCrossing& crossing) {
    crossings.push_back(crossing);
    return false;
  });
  if (leg.points.empty()) return std::nullopt;
  return leg.vertex != kNoIndex ? leg.vertex : data_.mesh.vertex_count() + leg.source;
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
