// Values and legs of shortest paths at vertices, targets and, where all windows were kept, everywhere.
#include <brushfire/solvers/window_field.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/flat_face.h>
#include <brushfire/solvers/windows/detail/face.h>
#include <brushfire/solvers/windows/detail/record.h>
#include <brushfire/solvers/windows/detail/trace.h>

#include <string>

namespace brushfire {
namespace {

using detail::FaceWeights;
using detail::PointRecord;
using detail::Ray;

struct Found {
  FaceWeights at;
  PointRecord record;
};

class Look {
 public:
  explicit Look(const detail::WindowFieldData& data) : data_(data), mesh_(data.mesh) {}

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

  Found point(const SurfacePoint& p) const {
    const PointLocation at = locate(mesh_, p);
    if (at.on == PointLocation::On::Vertex) return vertex(at.vertex);
    if (data_.all_points) return evaluate(at);
    for (std::size_t i = 0; i < data_.targets.size(); ++i) {
      const PointLocation& target = data_.targets[i];
      if (target.face == at.face && target.weights == at.weights) {
        const PointRecord& record = data_.target[i];
        for (const FaceWeights& f : detail::faces_around(mesh_, at)) {
          if (record.ray.halfedge != kNoIndex && f.face == Mesh::face_of(record.ray.halfedge)) return {f, record};
        }
        return {{at.face, at.weights}, record};
      }
    }
    throw Error(ErrorCode::InvalidArgument, "a point in face " + std::to_string(p.face) +
                                                " was not a target of the run: give it as one, or set keep_windows");
  }

 private:
  // The least of: straight from a source in the face, around its corners, along its windows.
  Found evaluate(const PointLocation& at) const {
    Found best{{at.face, at.weights}, {}};
    const auto offer = [&](const FaceWeights& f, Real value, const Ray& ray, Index label) {
      if (value < best.record.value || (value == best.record.value && label < best.record.label)) {
        best = {f, {value, label, ray}};
      }
    };
    const Index n = mesh_.vertex_count();
    const auto label_of = [&](Index root) { return root >= n ? root - n : data_.vertices[root].label; };
    for (const FaceWeights& f : detail::faces_around(mesh_, at)) {
      PointLocation here;
      here.face = f.face;
      here.weights = f.weights;
      const std::array<Real, 3> d = corner_distances(mesh_, here);
      for (Index k = 0; k < 3; ++k) {
        const Index v = mesh_.faces()[f.face][k];
        offer(f, data_.vertices[v].value + d[k], {{}, kNoIndex, v, {}}, data_.vertices[v].label);
      }
      if (!mesh_.is_face_usable(f.face)) continue;
      for (Index k = 0; k < 3; ++k) {
        const Index h = 3 * f.face + k;
        if (!(mesh_.lengths()[h] > 0)) continue;
        const detail::Frame frame{mesh_.lengths()[h], mesh_.lengths()[Mesh::previous(h)],
                                  mesh_.lengths()[Mesh::next(h)],
                                  apex_over_edge(mesh_.lengths()[h], mesh_.lengths()[Mesh::previous(h)],
                                                 mesh_.lengths()[Mesh::next(h)], mesh_.double_areas()[f.face])};
        const Vec2 p = detail::in_frame(frame, k, f.weights);
        for (std::size_t i = data_.first_kept[h]; i < data_.first_kept[h + 1]; ++i) {
          const detail::Window& w = data_.kept[i];
          offer(f, arrival(w, p).value, {w.source, h, w.root, w.kind}, label_of(w.root));
        }
        for (std::size_t s = 0; k == 0 && s < data_.sources.size(); ++s) {
          if (data_.sources[s].at.on == PointLocation::On::Vertex) continue;
          for (const FaceWeights& g : detail::faces_around(mesh_, data_.sources[s].at)) {
            if (g.face != f.face) continue;
            const Vec2 q = detail::in_frame(frame, k, g.weights);
            offer(f, data_.sources[s].offset + data_.shift + detail::length_of(p.x - q.x, p.y - q.y),
                  {q, h, n + static_cast<Index>(s), {}}, static_cast<Index>(s));
          }
        }
      }
    }
    return best;
  }

  const detail::WindowFieldData& data_;
  const Mesh& mesh_;
};

// Straight to a root that is a corner of the point's face, or along an edge of a face with a repeated vertex.
WindowField::Leg leg_without_ray(const detail::WindowFieldData& data, const Found& found, Index vertex) {
  const Mesh& mesh = data.mesh;
  const Index root = found.record.ray.root, n = mesh.vertex_count();
  WindowField::Leg leg;
  if (root >= n) {
    const PointLocation& source = data.sources[root - n].at;
    leg.source = root - n;
    leg.length = mesh.unit() * (found.record.value - data.shift - data.sources[root - n].offset);
    leg.points.push_back({found.at.face, found.at.weights});
    const bool same = source.on == PointLocation::On::Vertex && source.vertex == vertex;
    if (!same) leg.points.push_back({source.face, source.weights});
    return leg;
  }
  leg.vertex = root;
  leg.length = mesh.unit() * (found.record.value - data.vertices[root].value);
  // Both are points of one face: for a point of an edge not always the one that it was given by.
  const PointLocation here =
      locate(mesh, vertex != kNoIndex ? vertex_point(mesh, vertex) : SurfacePoint{found.at.face, found.at.weights});
  const PointLocation there = locate(mesh, vertex_point(mesh, root));
  const Index face = common_face(mesh, here, there, here.face);
  leg.points = {{face, *weights_in(mesh, here, face)}, {face, *weights_in(mesh, there, face)}};
  return leg;
}

WindowField::Leg last_leg_of(const detail::WindowFieldData& data, const Found& found, Index vertex) {
  if (!data.exact) {
    throw Error(ErrorCode::InvalidArgument, "windows were merged: paths need the method exact");
  }
  if (!(found.record.value < kInfinity)) return {};
  if (found.record.ray.halfedge == kNoIndex) return leg_without_ray(data, found, vertex);
  WindowField::Leg leg = detail::trace_leg(data, found.at, found.record.ray, found.record.value);
  leg.length *= data.mesh.unit();
  return leg;
}

}  // namespace

WindowField::WindowField(std::shared_ptr<const detail::WindowFieldData> data) : data_(std::move(data)) {}

const Mesh& WindowField::mesh() const noexcept { return data_->mesh; }

WindowField::Value WindowField::value(const SurfacePoint& point) const {
  if (point.is_nowhere()) return {};
  const PointRecord record = Look(*data_).point(point).record;
  if (!(record.value < kInfinity)) return {};
  const Real base = data_->bases.empty() ? 0 : data_->bases[record.label];
  return {base + data_->mesh.unit() * (record.value - data_->shift), record.label};
}

WindowField::Leg WindowField::last_leg(Index vertex) const {
  if (vertex >= data_->vertices.size()) {
    throw Error(ErrorCode::IndexOutOfRange, "vertex " + std::to_string(vertex) + " does not exist: the mesh has " +
                                                std::to_string(data_->vertices.size()) + " vertices");
  }
  return last_leg_of(*data_, Look(*data_).vertex(vertex), vertex);
}

WindowField::Leg WindowField::last_leg(const SurfacePoint& point) const {
  if (point.is_nowhere()) return {};
  const PointLocation at = locate(data_->mesh, point);
  if (at.on == PointLocation::On::Vertex) return last_leg(at.vertex);
  return last_leg_of(*data_, Look(*data_).point(point), kNoIndex);
}

}  // namespace brushfire
