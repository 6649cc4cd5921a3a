// Values and legs of shortest paths at vertices, targets and, where all windows were kept, everywhere.
#include <brushfire/solvers/window_field.h>

#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/solvers/detail/curve_feet.h>
#include <brushfire/solvers/detail/sheets.h>
#include <brushfire/solvers/windows/algebra/frame.h>
#include <brushfire/solvers/windows/paths/leg_search.h>
#include <brushfire/solvers/windows/paths/record.h>
#include <brushfire/solvers/windows/paths/trace.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace brushfire {
namespace {

using windows::FaceWeights;
using windows::PointRecord;
using windows::Ray;

Error not_a_target(Index face) {
  return Error(ErrorCode::InvalidArgument, "a point in face " + std::to_string(face) +
                                               " was not a target of the run: give it as one, or set keep_windows");
}

struct Found {
  FaceWeights at;
  PointRecord record;
};

class Look {
 public:
  explicit Look(const windows::WindowFieldData& data) : data_(data), mesh_(data.mesh) {}

  Found vertex(Index v) const {
    const PointRecord& record = data_.vertices[v];
    Found found{{kNoIndex, {0, 0, 0}}, record};
    // In the face over which the ray came; the vertex is opposite of the ray's halfedge.
    const Index h = record.ray.halfedge;
    if (h != kNoIndex) {
      found.at.face = Mesh::face_of(h);
      found.at.weights[Mesh::previous(h) % 3] = 1;
    } else if (!mesh_.corners(v).empty()) {
      const SurfacePoint p = vertex_point(mesh_, v);
      found.at = {p.face, p.weights};
    }
    return found;
  }

  Found point(const PointLocation& at) const {
    if (at.on == PointLocation::On::Vertex) return vertex(at.vertex);
    Found found = on_the_surface(at);
    const detail::CurveValue in_region = detail::from_regions(mesh_, data_.sources, at);
    if (in_region.label != kNoIndex && in_region.distance + data_.shift <= found.record.value) {
      found = {{at.face, at.weights}, {in_region.distance + data_.shift, in_region.label, {}}};
      found.record.ray.pseudo_source = mesh_.vertex_count() + in_region.label;
    }
    return found;
  }

 private:
  // As the front sees it.
  Found on_the_surface(const PointLocation& at) const {
    if (data_.all_points) return evaluate(at);
    for (std::size_t i = 0; i < data_.targets.size(); ++i) {
      const PointLocation& target = data_.targets[i];
      if (target.face == at.face && target.weights == at.weights) {
        const PointRecord& record = data_.target[i];
        for (const FaceWeights& f : windows::faces_around(mesh_, at)) {
          if (record.ray.halfedge != kNoIndex && f.face == Mesh::face_of(record.ray.halfedge)) return {f, record};
        }
        return {{at.face, at.weights}, record};
      }
    }
    throw not_a_target(at.face);
  }

  Found evaluate(const PointLocation& at) const {
    const windows::PointValue p = data_.all_points->at(at);
    return {{p.face, p.weights}, {p.value, p.label, windows::ray_of(p.ray)}};
  }

  const windows::WindowFieldData& data_;
  const Mesh& mesh_;
};

// Whether the source is at a vertex, and what paths begin with there explains the value: a curve may pass it with
// another one.
bool is_at_vertex(const windows::WindowFieldData& data, const PointRecord& record, Index source, Index vertex) {
  const detail::LocatedSource& s = data.sources[source];
  const auto is_it = [&](const PointLocation& at) { return at.on == PointLocation::On::Vertex && at.vertex == vertex; };
  if (!s.curve) return is_it(s.at);
  const double most = record.value - s.offset - data.shift + data.room_for(record);
  return std::any_of(s.curve->places.begin(), s.curve->places.end(),
                     [&](const CurvePlace& p) { return is_it(p.at) && p.offset <= most; });
}

// Where no ray came: the point is a source at a vertex, or the pseudo-source is at the other end of an edge.
WindowField::Leg leg_without_ray(const windows::WindowFieldData& data, const Found& found, Index vertex) {
  const Mesh& mesh = data.mesh;
  const Index pseudo_source = found.record.ray.pseudo_source, n = mesh.vertex_count();
  WindowField::Leg leg;
  if (pseudo_source == kNoIndex) return leg;
  if (pseudo_source >= n) {
    const detail::LocatedSource& source = data.sources[pseudo_source - n];
    const auto is_inside = [&] {
      return source.curve && source.curve->holds(mesh, locate(mesh, {found.at.face, found.at.weights}));
    };
    if (!is_at_vertex(data, found.record, pseudo_source - n, vertex) && !is_inside()) return {};
    leg.source = pseudo_source - n;
    leg.points.push_back({found.at.face, found.at.weights});
    return leg;
  }
  return leg;
}

// A point in a face is where its weights say, to the rounding of three products and two sums in each of two
// coordinates; so is the other end of the leg, in its face: twenty roundings of lengths of the face, which is many
// times the leg's own where that is short.
double room_of_places(const Mesh& mesh, Index face) {
  constexpr double kPlaces = 20 * std::numeric_limits<double>::epsilon();
  return kPlaces * std::max({mesh.length(3 * face), mesh.length(3 * face + 1), mesh.length(3 * face + 2)});
}

// The best that was found may explain the value no better than by chance: a longer way, or one from another source.
// That is a fault of ours, and no path.
void hold_to_value(const windows::WindowFieldData& data, const Found& found, const WindowField::Leg& leg) {
  const PointRecord& record = found.record;
  const double start =
      leg.vertex != kNoIndex ? data.vertices[leg.vertex].value : data.sources[leg.source].offset + data.shift;
  const double room = data.most_room_for(record) + std::max(room_of_places(data.mesh, found.at.face),
                                                            room_of_places(data.mesh, leg.points.back().face));
  if (!(start + leg.length > record.value + room)) return;
  const double unit = data.mesh.unit();
  throw Error(ErrorCode::Internal, "the path was lost: the shortest way that was found comes to " +
                                       number_as_text(unit * (start + leg.length - data.shift)) + ", the field says " +
                                       number_as_text(unit * (record.value - data.shift)) +
                                       ": please report the mesh and the points");
}

WindowField::Leg last_leg_of(const windows::WindowFieldData& data, const Found& found, Index vertex) {
  if (!data.exact) {
    throw Error(ErrorCode::InvalidArgument, "windows were merged: paths need the method exact");
  }
  if (!(found.record.value < kInfinity)) return {};
  const Ray& ray = found.record.ray;
  WindowField::Leg leg;
  if (ray.halfedge == kNoIndex) leg = leg_without_ray(data, found, vertex);
  if (ray.halfedge != kNoIndex) leg = windows::trace_leg(data, found.at, found.record);
  if (leg.points.empty()) {
    const std::function<double(Index)> vertex_value = [&](Index v) { return data.vertices[v].value; };
    const PointLocation at = locate(data.mesh, {found.at.face, found.at.weights});
    leg = windows::find_leg({data.mesh, data.sources, data.curves, data.shift, vertex_value, at, found.record.value,
                             data.room_for(found.record), windows::WindowFieldData::room_for(found.record.value, 0),
                             ray.pseudo_source, ray.halfedge, ray.source, ray.kind == windows::WindowKind::Linear});
    if (!leg.points.empty()) hold_to_value(data, found, leg);
  }
  leg.length *= data.mesh.unit();
  return leg;
}

// A point of the caller's mesh, in the mesh of the run.
PointLocation located(const windows::WindowFieldData& data, const SurfacePoint& point) {
  if (!data.view) return locate(data.mesh, point);
  const detail::Sheets& sheets = *data.view->sheets;
  const PointLocation at = locate(sheets.mesh(), point);
  const auto is_same = [&](const PointLocation& t) { return t.face == at.face && t.weights == at.weights; };
  const std::vector<PointLocation>& targets = data.view->targets;
  // Another copy of the face may have a target there.
  if (!data.all_points && sheets.is_inside_copy(at) && std::none_of(targets.begin(), targets.end(), is_same)) {
    throw not_a_target(point.face);
  }
  return sheets.to_single(at);
}

// The faces of the caller's mesh; and sources where they were given, maybe inside of a copy. (A source at no distance
// from a vertex has that at the leg's end, in whose faces it need not be.)
WindowField::Leg in_callers_numbers(const windows::WindowFieldData& data, WindowField::Leg leg) {
  if (!data.view) return leg;
  for (SurfacePoint& p : leg.points) p = data.view->sheets->from_single(p);
  if (leg.source != kNoIndex && !data.sources[leg.source].curve) {
    const PointLocation& source = data.view->sources[leg.source];
    const std::array<double, 3>& last = leg.points.back().weights;
    const bool is_vertex = std::find(last.begin(), last.end(), 1) != last.end();
    if (source.on == PointLocation::On::Vertex || !is_vertex) leg.points.pop_back();
    leg.points.push_back({source.face, source.weights});
  }
  return leg;
}

}  // namespace

WindowField::WindowField(std::shared_ptr<const windows::WindowFieldData> data) : data_(std::move(data)) {}

const Mesh& WindowField::mesh() const noexcept { return data_->view ? data_->view->sheets->mesh() : data_->mesh; }

WindowField::Value WindowField::value(const SurfacePoint& point) const {
  if (point.is_nowhere()) return {};
  const PointRecord record = Look(*data_).point(located(*data_, point)).record;
  if (!(record.value < kInfinity)) return {};
  const double base = data_->bases.empty() ? 0 : data_->bases[record.label];
  return {base + data_->mesh.unit() * (record.value - data_->shift), record.label};
}

WindowField::Leg WindowField::last_leg(Index vertex) const {
  if (vertex >= data_->vertices.size()) {
    throw Error(ErrorCode::IndexOutOfRange, "vertex " + std::to_string(vertex) + " does not exist: the mesh has " +
                                                std::to_string(data_->vertices.size()) + " vertices");
  }
  return in_callers_numbers(*data_, last_leg_of(*data_, Look(*data_).vertex(vertex), vertex));
}

WindowField::Leg WindowField::last_leg(const SurfacePoint& point) const {
  if (point.is_nowhere()) return {};
  const PointLocation at = located(*data_, point);
  if (at.on == PointLocation::On::Vertex) return last_leg(at.vertex);
  Leg leg = in_callers_numbers(*data_, last_leg_of(*data_, Look(*data_).point(at), kNoIndex));
  // It may be inside of a copy of the face. (On an edge it may have been snapped, and the leg begins in another face.)
  if (data_->view && at.on == PointLocation::On::Interior && !leg.points.empty()) leg.points.front() = point;
  return leg;
}

}  // namespace brushfire
