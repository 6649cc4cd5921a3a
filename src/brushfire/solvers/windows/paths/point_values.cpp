// The least of: straight from a source in the face, around its corners, along its windows.
#include <brushfire/solvers/windows/paths/point_values.h>

#include <brushfire/core/detail/sort.h>
#include <brushfire/solvers/windows/algebra/frame.h>
#include <brushfire/solvers/windows/algebra/line_source.h>
#include <brushfire/solvers/windows/paths/results.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// Of equal values that of the lowest label.
class KeptWindows::Least {
 public:
  explicit Least(const PointLocation& at) { found_.face = at.face, found_.weights = at.weights; }

  void offer(const FaceWeights& at, Real value, Index label, const Ray& ray) {
    if (!(value < value_ || (value == value_ && label < found_.label))) return;
    value_ = value;
    found_.face = at.face;
    for (std::size_t k = 0; k < 3; ++k) found_.weights[k] = to_double(at.weights[k]);
    found_.label = label;
    found_.ray = {{to_double(ray.source.x), to_double(ray.source.y)},
                  ray.halfedge,
                  ray.pseudo_source,
                  ray.kind == WindowKind::Linear};
  }
  PointValue found() const {
    PointValue rounded = found_;
    rounded.value = to_double(value_);
    return rounded;
  }

 private:
  PointValue found_;
  Real value_ = kInfinity;
};

KeptWindows::KeptWindows(const Mesh& mesh, std::span<const detail::LocatedSource> sources, Real shift,
                         std::vector<Vertex> vertices, std::span<const KeptWindow> windows)
    : mesh_(mesh),
      sources_(sources.begin(), sources.end()),
      curves_(mesh, sources),
      shift_(shift),
      vertices_(std::move(vertices)) {
  const std::size_t halfedges = mesh.halfedge_count();
  first_.assign(halfedges + 1, 0);
  for (const KeptWindow& k : windows) ++first_[k.halfedge + 1];
  for (std::size_t h = 0; h < halfedges; ++h) first_[h + 1] += first_[h];
  std::vector<std::size_t> fill(first_.begin(), first_.end() - 1);
  windows_.resize(windows.size());
  for (const KeptWindow& k : windows) windows_[fill[k.halfedge]++] = k.window;
  for (Index s = 0; s < sources_.size(); ++s) {
    if (sources_[s].at.on == PointLocation::On::Vertex || sources_[s].curve) continue;
    for_each_face_around(mesh_, sources_[s].at, [&](const FaceWeights& f) { point_sources_.push_back({f, s}); });
  }
  detail::stable_sort(point_sources_.begin(), point_sources_.end(),
                      [](const PointSource& a, const PointSource& b) { return a.at.face < b.at.face; });
}

std::span<const KeptWindows::PointSource> KeptWindows::point_sources_in(Index face) const {
  const auto first = std::partition_point(point_sources_.begin(), point_sources_.end(),
                                          [&](const PointSource& s) { return s.at.face < face; });
  const auto last = std::find_if(first, point_sources_.end(), [&](const PointSource& s) { return s.at.face != face; });
  return {first, last};
}

PointValue KeptWindows::at(const PointLocation& point) const {
  Least least(point);
  for (const FaceWeights& f : faces_around(mesh_, point)) {
    offer_corners(f, least);
    offer_sources(f, least);
    if (mesh_.is_face_usable(f.face)) offer_windows(f, least);
  }
  return least.found();
}

void KeptWindows::offer_corners(const FaceWeights& at, Least& least) const {
  const std::array<Real, 3> d = corner_distances_in(shape_of(mesh_, at.face), at.weights);
  for (Index k = 0; k < 3; ++k) {
    const Index v = mesh_.faces()[at.face][k];
    least.offer(at, vertices_[v].value + d[k], vertices_[v].label, {{}, kNoIndex, v, {}});
  }
}

void KeptWindows::offer_windows(const FaceWeights& at, Least& least) const {
  const Index n = mesh_.vertex_count();
  const FaceShape shape = shape_of(mesh_, at.face);
  for (Index k = 0; k < 3; ++k) {
    const Index h = 3 * at.face + k;
    if (first_[h] == first_[h + 1]) continue;
    const Vec2 p = in_frame(frame_of(shape, k), k, at.weights);
    for (std::size_t i = first_[h]; i < first_[h + 1]; ++i) {
      const Window& w = windows_[i];
      const Index label = w.pseudo_source >= n ? w.pseudo_source - n : vertices_[w.pseudo_source].label;
      least.offer(at, arrival(w, p).value, label, {w.source, h, w.pseudo_source, w.kind});
    }
  }
}

// No ray leads through a face with a repeated vertex, but a way along its edge.
void KeptWindows::offer_sources(const FaceWeights& at, Least& least) const {
  const FaceShape shape = shape_of(mesh_, at.face);
  Index k = 0;  // the frame: any halfedge with a length
  while (k < 3 && !(shape.length[k] > 0)) ++k;
  if (k < 3) offer_curves(at, k, least);
  if (k == 3) return;
  for (const auto& [place, s] : point_sources_in(at.face)) {
    Ray ray{{}, kNoIndex, mesh_.vertex_count() + s, {}};
    if (mesh_.is_face_usable(at.face)) {
      ray.source = in_frame(frame_of(shape, k), k, place.weights);
      ray.halfedge = 3 * at.face + k;
    }
    least.offer(at, sources_[s].offset + shift_ + distance_in(shape, place.weights, at.weights), s, ray);
  }
}

void KeptWindows::offer_curves(const FaceWeights& at, Index k, Least& least) const {
  const FaceShape shape = shape_of(mesh_, at.face);
  for (const CurveInFace& c : curves_.in(at.face)) {
    const LocatedCurve& curve = *sources_[c.source].curve;
    const Real start = sources_[c.source].offset + shift_;
    Ray ray{{}, kNoIndex, mesh_.vertex_count() + c.source, {}};
    if (mesh_.is_face_usable(at.face)) ray.halfedge = 3 * at.face + k;
    if (c.segment == kNoIndex) {
      const FaceWeights place = place_in_face(mesh_, curve, c.place, at.face);
      if (ray.halfedge != kNoIndex) ray.source = in_frame(frame_of(shape, k), k, place.weights);
      const Real way = distance_in(shape, place.weights, at.weights);
      least.offer(at, start + curve.places[c.place].offset + way, c.source, ray);
    } else if (ray.halfedge != kNoIndex) {
      const Frame frame = frame_of(shape, k);
      const SegmentInFace segment = *segment_in_face(mesh_, curve, c.segment, at.face, start);
      const LineSource::Sight sight = line_source_in(frame, k, segment).sight_of(in_frame(frame, k, at.weights));
      ray.source = sight.source;
      ray.kind = sight.kind;
      least.offer(at, sight.value, c.source, ray);
    }
  }
}

std::shared_ptr<const PointValues> Results::point_values() {
  if (!run_.problem->options->keep_windows) return nullptr;
  KeptWindows::Vertex unknown;
  if (run_.radius < kInfinity) unknown.value = std::numeric_limits<double>::quiet_NaN();
  std::vector<KeptWindows::Vertex> vertices(run_.structure.mesh.vertex_count(), unknown);
  std::vector<KeptWindow> windows;
  for (Part& part : parts_) {
    part.vertices().for_each_touched([&](Index v) {
      if (run_.values[v].lower > run_.radius || !is_owner(v)) return;
      vertices[run_.structure.outer_vertex(v)] = {run_.values[v].lower, label_of(v)};
    });
    for (const KeptWindow& k : part.kept()) {
      windows.push_back(k);
      windows.back().window.pseudo_source = outer_pseudo_source(k.window.pseudo_source);
    }
  }
  return std::make_shared<KeptWindows>(run_.structure.mesh, run_.problem->sources, run_.shift, std::move(vertices),
                                       windows);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
