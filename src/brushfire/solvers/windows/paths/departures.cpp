// Rays are traced back until they meet one that was.
#include <brushfire/solvers/windows/paths/departures.h>

#include <brushfire/solvers/windows/algebra/frame.h>
#include <brushfire/solvers/windows/paths/leg_search.h>

#include <bit>
#include <cmath>
#include <utility>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// Two ways back that have no curvature between them see the pseudo-source in one place but for rounding, a few epsilons
// of the way for each face. Taken for such: a vertex between them that moves the pseudo-source by less than this share
// of the way.
constexpr double kSamePlace = 1e-12;

constexpr std::size_t kCrossings = 8;  // of a ray on scans, before it comes to where another one was

double angle_between(Vec2 a, Vec2 b) { return std::atan2(cross(a, b), dot(a, b)); }

// Whether the straight line from the pseudo-source is as long as the value says.
bool is_explained(const WindowFieldData& data, const PointRecord& record) {
  const Index h = record.ray.halfedge, pseudo_source = record.ray.pseudo_source, n = data.mesh.vertex_count();
  const double start =
      pseudo_source < n ? data.vertices[pseudo_source].value : data.sources[pseudo_source - n].offset + data.shift;
  const Vec2 apex = frame_of(shape_of(data.mesh, h / 3), h % 3).apex;
  return start < record.value &&
         std::abs(start + norm(apex - record.ray.source) - record.value) <= data.room_for(record);
}

}  // namespace

TracedRays::TracedRays(std::size_t vertices) : slots_(std::bit_ceil(2 * kCrossings * (vertices + 1)), 0) {
  entries_.reserve(kCrossings * vertices);
}

std::size_t TracedRays::slot_of(Index halfedge, Index pseudo_source) const {
  constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15;  // as in VertexRecords
  const std::uint64_t both = (std::uint64_t{pseudo_source} << 32 | halfedge) * kGolden;
  return static_cast<std::size_t>((both ^ (both >> 29)) * kGolden >> 32) & (slots_.size() - 1);
}

std::optional<TracedRays::Angle> TracedRays::find(const RayCrossing& crossing, Index pseudo_source) const {
  const Vec2 direction = crossing.point - crossing.source;
  const double allowed = kSamePlace * norm(direction);
  for (std::size_t s = slot_of(crossing.halfedge, pseudo_source); slots_[s] != 0; s = (s + 1) & (slots_.size() - 1)) {
    const Entry& entry = entries_[slots_[s] - 1];
    if (entry.halfedge != crossing.halfedge || entry.pseudo_source != pseudo_source) continue;
    if (!(norm(entry.source - crossing.source) <= allowed)) continue;
    const auto [angle, sense] = entry.angle;
    return Angle{angle + sense * angle_between(entry.direction, direction), sense};
  }
  return std::nullopt;
}

void TracedRays::add(std::span<const RayCrossing> trail, Index pseudo_source, Angle angle) {
  if (trail.empty()) return;
  add_before_known(trail, pseudo_source, angle);
  const RayCrossing& last = trail.back();
  add({last.halfedge, pseudo_source, last.source, last.point - last.source, angle});
}

void TracedRays::add_before_known(std::span<const RayCrossing> trail, Index pseudo_source, Angle angle) {
  for (const RayCrossing& c : trail.first(trail.size() - 1)) {
    const double sense = c.mirrored == trail.back().mirrored ? angle.sense : -angle.sense;
    add({c.halfedge, pseudo_source, c.source, c.point - c.source, {angle.angle, sense}});
  }
}

void TracedRays::add(const Entry& entry) {
  const auto put = [&](const Entry& e, std::uint32_t position) {
    std::size_t s = slot_of(e.halfedge, e.pseudo_source);
    while (slots_[s] != 0) s = (s + 1) & (slots_.size() - 1);
    slots_[s] = position + 1;
  };
  if (2 * (entries_.size() + 1) > slots_.size()) {
    slots_.assign(2 * slots_.size(), 0);
    for (std::uint32_t i = 0; i < entries_.size(); ++i) put(entries_[i], i);
  }
  put(entry, static_cast<std::uint32_t>(entries_.size()));
  entries_.push_back(entry);
}

Departures::Departures(const WindowField& field, std::size_t vertices, AngleOf angle_of)
    : field_(field), angle_of_(std::move(angle_of)), rays_(vertices) {}

Departures::Departure Departures::of(Index vertex) {
  if (const std::optional<Departure> departure = follow(vertex)) return *departure;
  const WindowField::Leg leg = field_.last_leg(vertex);
  return {leg.vertex, angle_of_(leg).angle};
}

// Where the ray that was kept leads to its pseudo-source beyond doubt, or to where another one did.
std::optional<Departures::Departure> Departures::follow(Index vertex) {
  const WindowFieldData& data = *field_.data_;
  const PointRecord& record = data.vertices[vertex];
  const Ray& ray = record.ray;
  if (data.view || ray.halfedge == kNoIndex || !(record.value < kInfinity)) return std::nullopt;
  trail_.clear();
  std::optional<TracedRays::Angle> known;
  FaceWeights at{Mesh::face_of(ray.halfedge), {0, 0, 0}};
  at.weights[Mesh::previous(ray.halfedge) % 3] = 1;
  const WindowField::Leg leg = trace_leg(data, at, record, [&](const RayCrossing& crossing) {
    trail_.push_back(crossing);
    known = rays_.find(crossing, ray.pseudo_source);
    return known.has_value();
  });
  const bool from_vertex = ray.pseudo_source < data.mesh.vertex_count();
  if (known) {
    if (!is_explained(data, record)) return std::nullopt;
    rays_.add_before_known(trail_, ray.pseudo_source, *known);
    return Departure{from_vertex ? ray.pseudo_source : kNoIndex, known->angle};
  }
  if (leg.points.empty()) return std::nullopt;
  const TracedRays::Angle angle = angle_of_(leg);
  const bool at_root = leg.vertex == (from_vertex ? ray.pseudo_source : kNoIndex);
  if (at_root) rays_.add(trail_, ray.pseudo_source, angle);
  return Departure{leg.vertex, angle.angle};
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
