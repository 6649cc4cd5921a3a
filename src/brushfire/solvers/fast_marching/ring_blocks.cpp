// Builds the blocks: unfolds obtuse corners, counts lanes, then writes every vertex's lanes once.
#include <brushfire/solvers/fast_marching/ring_blocks.h>

#include <brushfire/core/planar.h>
#include <brushfire/mesh/locality_order.h>
#include <brushfire/solvers/fast_marching/bend.h>
#include <brushfire/solvers/fast_marching/unfold.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace brushfire::detail {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Collects the lanes of one vertex and stores them by whole blocks, from `to` on.
template <class T>
class LaneWriter {
 public:
  LaneWriter(RingBlock<T>* to, Index none) : to_(to), none_(none) {}

  void add(Index a, Index b, double length_a, double length_b, double dot, double cross) {
    if (count_ == kLanes) store();
    set(count_++, a, b, length_a, length_b, dot, cross);
  }
  void add_edge(Index a, double length) { add(a, none_, length, kInfinity, kNan, 0); }

  void finish() {
    if (count_ == 0) return;
    while (count_ < kLanes) set(count_++, none_, none_, kInfinity, kInfinity, kNan, kNan);
    store();
  }

 private:
  void set(Index k, Index a, Index b, double length_a, double length_b, double dot, double cross) {
    block_.a[k] = a;
    block_.b[k] = b;
    block_.length_a[k] = static_cast<T>(length_a);
    block_.length_b[k] = static_cast<T>(length_b);
    block_.dot[k] = static_cast<T>(dot);
    block_.cross[k] = static_cast<T>(cross);
  }
  void store() {
    *to_++ = block_;
    count_ = 0;
  }

  RingBlock<T>* to_;
  Index none_, count_ = 0;
  RingBlock<T> block_;
};

template <class T>
class RingBuilder {
 public:
  explicit RingBuilder(const Mesh& mesh)
      : mesh_(mesh),
        faces_(mesh.faces()),
        opposite_(mesh.opposite()),
        lengths_(mesh.lengths()),
        double_areas_(mesh.double_areas()) {}

  Rings<T> build() {
    order_vertices();
    unfold_obtuse_corners();
    lay_out();
    patches_.resize(static_cast<std::size_t>(mesh_.vertex_count()) + 1);  // the last one: of no vertex
    for (Index i = 0; i < mesh_.vertex_count(); ++i) fill_vertex(i);
    bend_fronts();
    for (const Index h : unsplit_) mark_unsplit(h);
    return std::move(rings_);
  }

 private:
  void order_vertices() {
    RingLayout& layout = rings_.layout;
    layout.vertex = vertex_locality_order(mesh_);
    layout.place.resize(layout.vertex.size());
    for (Index i = 0; i < mesh_.vertex_count(); ++i) layout.place[layout.vertex[i]] = i;
    double sum = 0;
    for (const double l : lengths_) sum += l;
    if (sum > 0) layout.mean_edge = sum / static_cast<double>(mesh_.halfedge_count());
  }

  void unfold_obtuse_corners() {
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const Index h = obtuse_corner(lengths_, f);
      if (h == kNoIndex || !mesh_.is_face_usable(f)) continue;
      const Unfolding result = unfold_obtuse_corner(mesh_, h, unfolded_);
      rings_.layout.longest_unfolding = std::max(rings_.layout.longest_unfolding, result.crossed);
      if (!result.split) unsplit_.push_back(h);
    }
    // Lists by vertex. Every triangle is in two: as 2t in that of `first`, as 2t + 1 in that of `second`.
    first_of_.assign(mesh_.vertex_count(), kNoIndex);
    next_of_.resize(2 * unfolded_.size());
    for (Index e = static_cast<Index>(next_of_.size()); e-- > 0;) {
      const UnfoldedTriangle& t = unfolded_[e / 2];
      next_of_[e] = std::exchange(first_of_[e % 2 == 0 ? t.first : t.second], e);
    }
  }

  // A face is one lane at each corner; a face with a repeated vertex is two edges.
  Index lanes_of(Index h) const { return mesh_.is_face_usable(Mesh::face_of(h)) ? 1 : 2; }

  void lay_out() {
    std::vector<Index> more(mesh_.vertex_count(), 0);  // lanes than corners
    for (const Face& t : faces_) {
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) continue;
      for (const Index v : t) ++more[v];
    }
    for (const UnfoldedTriangle& t : unfolded_) ++more[t.first], ++more[t.second];
    std::vector<Index>& offset = rings_.layout.block_offset;
    offset.resize(static_cast<std::size_t>(mesh_.vertex_count()) + 1);
    offset[0] = 0;
    for (Index i = 0; i < mesh_.vertex_count(); ++i) {
      const Index v = rings_.layout.vertex[i];
      const Index lanes = static_cast<Index>(mesh_.corners(v).size()) + more[v];
      offset[i + 1] = offset[i] + (lanes + kLanes - 1) / kLanes;
    }
    rings_.blocks.resize(offset.back());
  }

  void fill_vertex(Index i) {
    const Index v = rings_.layout.vertex[i];
    LaneWriter<T> lanes(rings_.blocks.data() + rings_.layout.block_offset[i], mesh_.vertex_count());
    Patch patch{2 * kPi, 0};
    bool inner = true;  // every edge has two faces
    for (const Index h : mesh_.corners(v)) {
      const Index f = Mesh::face_of(h), next = Mesh::next(h), previous = Mesh::previous(h);
      const Face& t = faces_[f];
      const Index a = t[next % 3], b = t[previous % 3];
      const double la = lengths_[h], lb = lengths_[previous], lab = lengths_[next], area = double_areas_[f];
      if (a == b || a == v || b == v) {
        lanes.add_edge(place(a), la);
        lanes.add_edge(place(b), lb);
        continue;
      }
      const double shorter = std::min(la, lb), longer = std::max(la, lb);
      const double dot = 0.5 * (shorter * shorter + (longer - lab) * (longer + lab));  // keeps digits in needles
      lanes.add(place(a), place(b), la, lb, dot, area);
      patch.deficit -= quick_angle(dot, area);
      patch.area += area / 6;
      inner = inner && has_two_faces(h) && has_two_faces(previous);
    }
    for (Index e = first_of_[v]; e != kNoIndex; e = next_of_[e]) add_unfolded(lanes, e);
    lanes.finish();
    if (!inner || std::abs(patch.deficit) < kFlat) patch.deficit = 0;
    patches_[i] = patch;
  }

  bool has_two_faces(Index h) const { return opposite_[h] != h && opposite_[opposite_[h]] == h; }

  void add_unfolded(LaneWriter<T>& lanes, Index e) const {
    const UnfoldedTriangle& t = unfolded_[e / 2];
    const bool at_first = e % 2 == 0;
    const Vec2 own = at_first ? t.at_first : t.at_second, other = at_first ? t.at_second : t.at_first;
    const double area = std::abs(brushfire::cross(t.at_first, t.at_second));
    lanes.add(place(t.corner_vertex), place(at_first ? t.second : t.first), norm(own), norm(other - own),
              brushfire::dot(own, own - other), area);
  }

  // Patches are smoothed once, over the other ends of each vertex's halfedges.
  void bend_fronts() {
    rings_.bend.resize(mesh_.vertex_count());
    for (Index i = 0; i < mesh_.vertex_count(); ++i) {
      Patch around = patches_[i];
      const RingBlock<T>* blocks = rings_.blocks.data() + rings_.layout.block_offset[i];
      const Index corners = static_cast<Index>(mesh_.corners(rings_.layout.vertex[i]).size());
      for (Index lane = 0; lane < corners; ++lane) {
        const Patch& other = patches_[blocks[lane / kLanes].a[lane % kLanes]];
        around.deficit += other.deficit;
        around.area += other.area;
      }
      rings_.bend[i] = static_cast<T>(front_bend(patches_[i], around));
    }
  }

  // The corner at h is a target from the two other vertices of its face.
  void mark_unsplit(Index h) {
    for (const Index from : {Mesh::next(h), Mesh::previous(h)}) {
      const auto corners = mesh_.corners(mesh_.from(from));
      Index lane = 0;  // as fill_vertex() has numbered them
      for (std::size_t i = 0; corners[i] != from; ++i) lane += lanes_of(corners[i]);
      const Index at = place(mesh_.from(from));
      RingBlock<T>& block = rings_.blocks[rings_.layout.block_offset[at] + lane / kLanes];
      T& side = from == Mesh::next(h) ? block.length_b[lane % kLanes] : block.length_a[lane % kLanes];
      side = -side;
    }
  }

  Index place(Index v) const { return rings_.layout.place[v]; }

  const Mesh& mesh_;
  std::span<const Face> faces_;
  std::span<const Index> opposite_;
  std::span<const double> lengths_, double_areas_;
  Rings<T> rings_;
  std::vector<UnfoldedTriangle> unfolded_;
  std::vector<Index> unsplit_;             // corners whose unfolding ended early
  std::vector<Index> first_of_, next_of_;  // lists of unfolded triangles by vertex
  UninitializedArray<Patch> patches_;      // [vertex_count + 1] by place
};

}  // namespace

template <class T>
Rings<T> build_rings(const Mesh& mesh) {
  return RingBuilder<T>(mesh).build();
}

template Rings<float> build_rings<float>(const Mesh& mesh);
template Rings<double> build_rings<double>(const Mesh& mesh);

}  // namespace brushfire::detail
