// The virtual sources of a face: its corners, the sources and curves in it, and those that its windows see.
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/solvers/windows/algebra/frame.h>
#include <brushfire/solvers/windows/algebra/line_source.h>
#include <brushfire/solvers/windows/paths/point_values.h>

#include <array>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// Fronts of one face: found in the frame of one of its halfedges, kept in the plane of flat_corners().
class KeptWindows::Fronts {
 public:
  explicit Fronts(const Mesh& mesh, Index face) : corners_(flat_corners(mesh, face)) {}

  // The frame of the halfedge k of the face, in which what follows is told.
  void set_frame(Index k) {
    origin_ = corners_[k];
    const Plain edge = corners_[(k + 1) % 3] - origin_;
    along_ = (1 / norm(edge)) * edge;
  }

  void add_point(Vec2 source, Real sigma, Index label) {
    FaceFront front;
    front.source = place(source);
    front.sigma = to_double(sigma);
    front.label = label;
    if (front.sigma < kInfinity) found_.push_back(front);  // not: NaN, unknown
  }

  // What comes along parallel rays has the value `sigma` at `point`.
  void add_parallel(Vec2 back, Vec2 point, Real sigma, Index label) {
    FaceFront front;
    front.parallel = true;
    front.source = turned(back);
    front.sigma = to_double(sigma) + dot(place(point), front.source);
    front.label = label;
    found_.push_back(front);
  }

  // Of the front that was added last.
  void add_border(Vec2 point, Vec2 inward) {
    const Plain n = turned(inward);
    const double length = norm(n);
    if (!(length > 0)) return;
    FaceFront& front = found_.back();
    front.borders[front.border_count++] = {place(point), (1 / length) * n};
  }

  void add(const Window& w, Index label) {
    const bool circular = w.kind == WindowKind::Circular;
    if (circular) add_point(w.source, w.sigma, label);
    if (!circular) add_parallel(w.source, {0, 0}, w.sigma, label);
    const auto ray = [&](Real b) { return circular ? Vec2{b - w.source.x, -w.source.y} : Real{-1} * w.source; };
    const Vec2 first = ray(w.b0), last = ray(w.b1);
    add_border({w.b0, 0}, {first.y, Real{-1} * first.x});
    add_border({w.b1, 0}, {Real{-1} * last.y, last.x});
  }

  // The light of a segment on both of its sides, and of its ends.
  void add(const LineSource& line, Index label) {
    add_point(line.begin, line.sigma, label);
    add_point(line.end(), line.sigma + line.slope * line.length, label);
    const Vec2 left{Real{-1} * line.along.y, line.along.x};
    for (const int side : {1, -1}) {
      const Vec2 away = Real(side) * left, band = line.rise * line.along - line.slope * away;
      add_parallel(Real{-1} * line.light(side), line.begin, line.sigma, label);
      add_border(line.begin, away);
      add_border(line.begin, band);
      add_border(line.end(), Real{-1} * band);
    }
  }

  std::vector<FaceFront> take() { return std::move(found_); }

 private:
  using Plain = brushfire::Vec2;

  Plain turned(Vec2 v) const {
    const double x = to_double(v.x), y = to_double(v.y);
    return {x * along_.x - y * along_.y, x * along_.y + y * along_.x};
  }
  Plain place(Vec2 p) const { return origin_ + turned(p); }

  std::array<Plain, 3> corners_;
  Plain origin_, along_;
  std::vector<FaceFront> found_;
};

std::vector<FaceFront> KeptWindows::fronts_in(Index face) const {
  const Index n = mesh_.vertex_count();
  const FaceShape shape = shape_of(mesh_, face);
  Fronts fronts(mesh_, face);
  for (Index k = 0; k < 3; ++k) {
    fronts.set_frame(k);
    const KeptWindows::Vertex& corner = vertices_[mesh_.faces()[face][k]];
    fronts.add_point({0, 0}, corner.value, corner.label);
    for (std::size_t i = first_[3 * face + k]; i < first_[3 * face + k + 1]; ++i) {
      const Window& w = windows_[i];
      fronts.add(w, w.pseudo_source >= n ? w.pseudo_source - n : vertices_[w.pseudo_source].label);
    }
  }
  fronts.set_frame(0);
  const Frame frame = frame_of(shape, 0);
  for (const CurveInFace& c : curves_.in(face)) {
    const LocatedCurve& curve = *sources_[c.source].curve;
    const Real start = sources_[c.source].offset + shift_;
    if (c.segment == kNoIndex) {
      const Vec2 place = in_frame(frame, 0, place_in_face(mesh_, curve, c.place, face).weights);
      fronts.add_point(place, start + curve.places[c.place].offset, c.source);
    } else {
      fronts.add(line_source_in(frame, 0, *segment_in_face(mesh_, curve, c.segment, face, start)), c.source);
    }
  }
  for (const auto& [place, s] : point_sources_in(face)) {
    fronts.add_point(in_frame(frame, 0, place.weights), sources_[s].offset + shift_, s);
  }
  return fronts.take();
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
