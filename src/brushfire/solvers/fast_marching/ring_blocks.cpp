// Builds the blocks: counts lanes, fills real triangles, then unfolded ones.
#include <brushfire/solvers/fast_marching/ring_blocks.h>

#include <brushfire/mesh/locality_order.h>
#include <brushfire/solvers/fast_marching/bend.h>
#include <brushfire/solvers/fast_marching/unfold.h>

#include <algorithm>
#include <limits>

namespace brushfire::detail {
namespace {

template <class T>
class RingBuilder {
 public:
  explicit RingBuilder(const Mesh& mesh) : mesh_(mesh) {}

  Rings<T> build() {
    order_vertices();
    for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
      if (!is_obtuse(mesh_, h)) continue;
      const Unfolding result = unfold_obtuse_corner(mesh_, h, unfolded_);
      rings_.layout.longest_unfolding = std::max(rings_.layout.longest_unfolding, result.crossed);
      if (!result.split) unsplit_.push_back(h);
    }
    lay_out();
    for (Index i = 0; i < mesh_.vertex_count(); ++i) fill_vertex(i);
    const std::vector<double> bend = front_bend(mesh_);
    rings_.bend.resize(bend.size());
    for (Index v = 0; v < bend.size(); ++v) rings_.bend[place(v)] = static_cast<T>(bend[v]);
    for (const Index h : unsplit_) mark_unsplit(h);
    for (const UnfoldedTriangle& t : unfolded_) add_unfolded(t);
    return std::move(rings_);
  }

 private:
  void order_vertices() {
    RingLayout& layout = rings_.layout;
    LocalityOrder order = locality_order(mesh_);
    layout.vertex = std::move(order.vertices);
    layout.place = std::move(order.vertex_rank);
    double sum = 0;
    for (const double l : mesh_.lengths()) sum += l;
    if (sum > 0) layout.mean_edge = sum / static_cast<double>(mesh_.halfedge_count());
  }

  // A face is one lane at each corner; a face with a repeated vertex is two edges.
  Index lanes_of(Index h) const { return mesh_.is_face_usable(Mesh::face_of(h)) ? 1 : 2; }

  void lay_out() {
    const RingLayout& layout = rings_.layout;
    std::vector<Index> lanes(mesh_.vertex_count(), 0);
    for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
      lanes[layout.place[mesh_.from(h)]] += lanes_of(h);
    }
    for (const UnfoldedTriangle& t : unfolded_) {
      ++lanes[layout.place[t.first]];
      ++lanes[layout.place[t.second]];
    }
    std::vector<Index>& offset = rings_.layout.block_offset;
    offset.resize(static_cast<std::size_t>(mesh_.vertex_count()) + 1);
    offset[0] = 0;
    for (Index i = 0; i < mesh_.vertex_count(); ++i) offset[i + 1] = offset[i] + (lanes[i] + kLanes - 1) / kLanes;
    rings_.blocks.resize(offset.back());
    filled_.assign(mesh_.vertex_count(), 0);
    const Index none = mesh_.vertex_count();
    constexpr T kInf = std::numeric_limits<T>::infinity(), kNan = std::numeric_limits<T>::quiet_NaN();
    for (RingBlock<T>& block : rings_.blocks) {
      for (Index k = 0; k < kLanes; ++k) {
        block.a[k] = block.b[k] = none;
        block.length_a[k] = block.length_b[k] = kInf;
        block.dot[k] = block.cross[k] = kNan;
      }
    }
  }

  void fill_vertex(Index i) {
    const Index v = rings_.layout.vertex[i];
    const auto lengths = mesh_.lengths();
    for (const Index h : mesh_.corners(v)) {
      const Index previous = Mesh::previous(h);
      const Index a = mesh_.to(h), b = mesh_.from(previous);
      if (mesh_.is_face_usable(Mesh::face_of(h))) {
        const double la = lengths[h], lb = lengths[previous], lab = lengths[Mesh::next(h)];
        const double shorter = std::min(la, lb), longer = std::max(la, lb);
        const double dot = 0.5 * (shorter * shorter + (longer - lab) * (longer + lab));  // keeps digits in needles
        add(i, place(a), place(b), la, lb, dot, mesh_.double_areas()[Mesh::face_of(h)]);
      } else {
        add_edge(i, place(a), lengths[h]);
        add_edge(i, place(b), lengths[previous]);
      }
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

  void add_unfolded(const UnfoldedTriangle& t) {
    const Vec2 edge = t.at_second - t.at_first;
    const double area = std::abs(brushfire::cross(t.at_first, t.at_second));
    const double length = norm(edge);
    add(place(t.first), place(t.corner_vertex), place(t.second), norm(t.at_first), length,
        -brushfire::dot(t.at_first, edge), area);
    add(place(t.second), place(t.corner_vertex), place(t.first), norm(t.at_second), length,
        brushfire::dot(t.at_second, edge), area);
  }

  Index place(Index v) const { return rings_.layout.place[v]; }

  void add_edge(Index i, Index a, double length) {
    add(i, a, mesh_.vertex_count(), length, kInfinity, std::numeric_limits<double>::quiet_NaN(), 0);
  }

  void add(Index i, Index a, Index b, double length_a, double length_b, double dot, double cross) {
    const Index lane = filled_[i]++;
    RingBlock<T>& block = rings_.blocks[rings_.layout.block_offset[i] + lane / kLanes];
    const Index k = lane % kLanes;
    block.a[k] = a;
    block.b[k] = b;
    block.length_a[k] = static_cast<T>(length_a);
    block.length_b[k] = static_cast<T>(length_b);
    block.dot[k] = static_cast<T>(dot);
    block.cross[k] = static_cast<T>(cross);
  }

  const Mesh& mesh_;
  Rings<T> rings_;
  std::vector<UnfoldedTriangle> unfolded_;
  std::vector<Index> unsplit_;  // corners whose unfolding ended early
  std::vector<Index> filled_;   // lanes, by place
};

}  // namespace

template <class T>
Rings<T> build_rings(const Mesh& mesh) {
  return RingBuilder<T>(mesh).build();
}

template Rings<float> build_rings<float>(const Mesh& mesh);
template Rings<double> build_rings<double>(const Mesh& mesh);

}  // namespace brushfire::detail
