// Values and legs of shortest paths at vertices, targets and, where all windows were kept, everywhere.
#include <brushfire/solvers/windows/detail/field_reader.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/flat_face.h>
#include <brushfire/solvers/detail/sheets.h>
#include <brushfire/solvers/windows/detail/face.h>
#include <brushfire/solvers/windows/detail/record.h>
#include <brushfire/solvers/windows/detail/trace.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace brushfire::detail::BRUSHFIRE_NUMBERS {
namespace {

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
  explicit Look(const WindowFieldData& data) : data_(data), mesh_(data.mesh) {}

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
      found.at = {p.face, weights_from(p.weights)};
    }
    return found;
  }

  Found point(const PointLocation& at) const {
    if (at.on == PointLocation::On::Vertex) return vertex(at.vertex);
    if (data_.all_points) return evaluate(at);
    for (std::size_t i = 0; i < data_.targets.size(); ++i) {
      const PointLocation& target = data_.targets[i];
      if (target.face == at.face && target.weights == at.weights) {
        const PointRecord& record = data_.target[i];
        for (const FaceWeights& f : faces_around(mesh_, at)) {
          if (record.ray.halfedge != kNoIndex && f.face == Mesh::face_of(record.ray.halfedge)) return {f, record};
        }
        return {{at.face, weights_from(at.weights)}, record};
      }
    }
    throw not_a_target(at.face);
  }

 private:
  // The least of: straight from a source in the face, around its corners, along its windows.
  Found evaluate(const PointLocation& at) const {
    Found best{{at.face, weights_from(at.weights)}, {}};
    const auto offer = [&](const FaceWeights& f, Real value, const Ray& ray, Index label) {
      if (value < best.record.value || (value == best.record.value && label < best.record.label)) {
        best = {f, {value, label, ray}};
      }
    };
    const Index n = mesh_.vertex_count();
    const auto label_of = [&](Index root) { return root >= n ? root - n : data_.vertices[root].label; };
    for (const FaceWeights& f : faces_around(mesh_, at)) {
      const std::array<Real, 3> d = corner_distances_in(shape_of(mesh_, f.face), f.weights);
      for (Index k = 0; k < 3; ++k) {
        const Index v = mesh_.faces()[f.face][k];
        offer(f, data_.vertices[v].value + d[k], {{}, kNoIndex, v, {}}, data_.vertices[v].label);
      }
      if (!mesh_.is_face_usable(f.face)) continue;
      for (Index k = 0; k < 3; ++k) {
        const Index h = 3 * f.face + k;
        if (!(mesh_.lengths()[h] > 0)) continue;
        const Frame frame = data_.frame_of_halfedge(h);
        const Vec2 p = in_frame(frame, k, f.weights);
        for (std::size_t i = data_.first_kept[h]; i < data_.first_kept[h + 1]; ++i) {
          const Window& w = data_.kept[i];
          offer(f, arrival(w, p).value, {w.source, h, w.root, w.kind}, label_of(w.root));
        }
        for (std::size_t s = 0; k == 0 && s < data_.sources.size(); ++s) {
          if (data_.sources[s].at.on == PointLocation::On::Vertex) continue;
          for (const FaceWeights& g : faces_around(mesh_, data_.sources[s].at)) {
            if (g.face != f.face) continue;
            const Vec2 q = in_frame(frame, k, g.weights);
            offer(f, data_.sources[s].offset + data_.shift + length_of(p.x - q.x, p.y - q.y),
                  {q, h, n + static_cast<Index>(s), {}}, static_cast<Index>(s));
          }
        }
      }
    }
    return best;
  }

  const WindowFieldData& data_;
  const Mesh& mesh_;
};

// Straight to a root that is a corner of the point's face, or along an edge of a face with a repeated vertex.
WindowField::Leg leg_without_ray(const WindowFieldData& data, const Found& found, Index vertex) {
  const Mesh& mesh = data.mesh;
  const Index root = found.record.ray.root, n = mesh.vertex_count();
  WindowField::Leg leg;
  if (root >= n) {
    const PointLocation& source = data.sources[root - n].at;
    leg.source = root - n;
    leg.length = mesh.unit() * static_cast<double>(found.record.value - data.shift - data.sources[root - n].offset);
    leg.points.push_back(surface_point(found.at));
    const bool same = source.on == PointLocation::On::Vertex && source.vertex == vertex;
    if (!same) leg.points.push_back({source.face, source.weights});
    return leg;
  }
  leg.vertex = root;
  leg.length = mesh.unit() * static_cast<double>(found.record.value - data.vertices[root].value);
  // Both are points of one face: for a point of an edge not always the one that it was given by.
  const PointLocation here = locate(mesh, vertex != kNoIndex ? vertex_point(mesh, vertex) : surface_point(found.at));
  const PointLocation there = locate(mesh, vertex_point(mesh, root));
  const Index face = common_face(mesh, here, there, here.face);
  leg.points = {{face, *weights_in(mesh, here, face)}, {face, *weights_in(mesh, there, face)}};
  return leg;
}

WindowField::Leg last_leg_of(const WindowFieldData& data, const Found& found, Index vertex) {
  if (!data.exact) {
    throw Error(ErrorCode::InvalidArgument, "windows were merged: paths need the method exact");
  }
  if (!(found.record.value < kInfinity)) return {};
  if (found.record.ray.halfedge == kNoIndex) return leg_without_ray(data, found, vertex);
  WindowField::Leg leg = trace_leg(data, found.at, found.record.ray, found.record.value);
  leg.length *= data.mesh.unit();
  return leg;
}

// A point of the caller's mesh, in the mesh of the run.
PointLocation located(const WindowFieldData& data, const SurfacePoint& point) {
  if (!data.view) return locate(data.mesh, point);
  const Sheets& sheets = *data.view->sheets;
  const PointLocation at = locate(sheets.mesh(), point);
  const auto is_same = [&](const PointLocation& t) { return t.face == at.face && t.weights == at.weights; };
  const std::vector<PointLocation>& targets = data.view->targets;
  // Another copy of the face may have a target there.
  if (!data.all_points && sheets.is_inside_copy(at) && std::none_of(targets.begin(), targets.end(), is_same)) {
    throw not_a_target(point.face);
  }
  return sheets.to_single(at);
}

// The faces of the caller's mesh; and sources where they were given, maybe inside of a copy.
WindowField::Leg in_callers_numbers(const WindowFieldData& data, WindowField::Leg leg) {
  if (!data.view) return leg;
  for (SurfacePoint& p : leg.points) p = data.view->sheets->from_single(p);
  if (leg.source != kNoIndex) {
    const PointLocation& source = data.view->sources[leg.source];
    leg.points.back() = {source.face, source.weights};
  }
  return leg;
}

class Reader final : public WindowFieldReader {
 public:
  explicit Reader(std::shared_ptr<const WindowFieldData> data) : data_(std::move(data)) {}

  const Mesh& mesh() const noexcept override { return data_->view ? data_->view->sheets->mesh() : data_->mesh; }

  WindowField::Value value(const SurfacePoint& point) const override {
    const PointRecord record = Look(*data_).point(located(*data_, point)).record;
    if (!(record.value < kInfinity)) return {};
    return {data_->mesh.unit() * static_cast<double>(record.value - data_->shift), record.label};
  }

  WindowField::Leg last_leg(Index vertex) const override {
    if (vertex >= data_->vertices.size()) {
      throw Error(ErrorCode::IndexOutOfRange, "vertex " + std::to_string(vertex) + " does not exist: the mesh has " +
                                                  std::to_string(data_->vertices.size()) + " vertices");
    }
    return in_callers_numbers(*data_, last_leg_of(*data_, Look(*data_).vertex(vertex), vertex));
  }

  WindowField::Leg last_leg(const SurfacePoint& point) const override {
    const PointLocation at = located(*data_, point);
    if (at.on == PointLocation::On::Vertex) return last_leg(at.vertex);
    WindowField::Leg leg = in_callers_numbers(*data_, last_leg_of(*data_, Look(*data_).point(at), kNoIndex));
    // It may be inside of a copy of the face.
    if (data_->view && !leg.points.empty()) leg.points.front() = point;
    return leg;
  }

 private:
  std::shared_ptr<const WindowFieldData> data_;
};

}  // namespace

std::shared_ptr<const WindowFieldReader> make_reader(std::shared_ptr<const WindowFieldData> data) {
  return std::make_shared<Reader>(std::move(data));
}

}  // namespace brushfire::detail::BRUSHFIRE_NUMBERS
