// Builds the blocks: unfolds obtuse corners, then writes every vertex's sides and triangles once, in the internal
// order.
#include <brushfire/solvers/fast_marching/ring_blocks.h>

#include <brushfire/core/planar.h>
#include <brushfire/solvers/fast_marching/bend.h>
#include <brushfire/solvers/fast_marching/lane_writer.h>
#include <brushfire/solvers/fast_marching/obtuse_corners.h>
#include <brushfire/solvers/fast_marching/plain_fan.h>
#include <brushfire/solvers/fast_marching/unfold.h>
#include <brushfire/solvers/fast_marching/vector_target.h>

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>
#include <utility>

namespace brushfire::detail {
namespace {

// Items in pieces of a size that allocators keep at hand: memory that is touched for the first time is slow.
template <class Item>
class Pieces {
 public:
  std::size_t size() const { return size_; }
  Item& operator[](std::size_t i) { return pieces_[i / kPiece][i % kPiece]; }
  void push_back(const Item& item) {
    if (size_ == pieces_.size() * kPiece) pieces_.emplace_back(kPiece);
    (*this)[size_++] = item;
  }

 private:
  static constexpr std::size_t kPiece = 1024;
  std::vector<UninitializedArray<Item>> pieces_;
  std::size_t size_ = 0;
};

template <class T>
class RingBuilder {
 public:
  RingBuilder(const Mesh& mesh, Index part_size, Variant variant)
      : mesh_(mesh),
        variant_(variant),
        faces_(mesh.faces()),
        fans_{mesh.positions(),
              mesh.faces(),
              mesh.corner_offsets(),
              mesh.all_corners(),
              1 / mesh.unit(),
              mesh.vertex_count(),
              mesh.has_positions() && !mesh.has_slits()},
        part_shift_(part_shift(part_size)) {}

  Rings<T> build() {
    unfold_obtuse_corners();
    fill();
    bend_fronts();
    for (const Index h : unsplit_) mark_unsplit(h);
    separate_parts();
    return std::move(rings_);
  }

 private:
  void unfold_obtuse_corners() {
    const Unfolder unfolder(mesh_, variant_);
    constexpr std::size_t kAtOnce = 2048;  // faces that stay in a cache
    std::array<Index, kAtOnce + 1> obtuse;
    for (std::size_t begin = 0; begin < faces_.size(); begin += kAtOnce) {
      const std::size_t count = find_obtuse(begin, std::min(begin + kAtOnce, faces_.size()), obtuse.data());
      for (const Index h : std::span(obtuse).first(count)) unfold(unfolder, h);
    }
    first_of_.assign(mesh_.vertex_count(), kNoIndex);
    for (Index e = static_cast<Index>(2 * unfolded_.size()); e-- > 0;) {
      Unfolded& t = unfolded_[e / 2];
      t.next[e % 2] = std::exchange(first_of_[t.end[e % 2]], e);
    }
  }

  // What the ends of an unfolded triangle's edge need of it, and lists by vertex: every triangle is in two, as 2t in
  // that of its first end, as 2t + 1 in that of the second.
  struct Unfolded {
    Index corner;                  // the vertex whose corner was unfolded
    std::array<Index, 2> end;      // the others
    std::array<Index, 2> next;     // in the list of each; kNoIndex: none
    std::array<T, 2> length, dot;  // from each end to the corner; that side times the edge
    T between, cross;              // the length of the edge; twice the area
  };

  static Unfolded measured(const UnfoldedTriangle& t) {
    const Vec2 along = t.at_second - t.at_first;
    return {t.corner_vertex,
            {t.first, t.second},
            {},
            {static_cast<T>(norm(t.at_first)), static_cast<T>(norm(t.at_second))},
            {static_cast<T>(brushfire::dot(t.at_first, t.at_first - t.at_second)),
             static_cast<T>(brushfire::dot(t.at_second, along))},
            static_cast<T>(norm(along)),
            static_cast<T>(std::abs(brushfire::cross(t.at_first, t.at_second)))};
  }

  void unfold(const Unfolder& unfolder, Index h) {
    if (!mesh_.is_face_usable(Mesh::face_of(h))) return;
    triangles_.clear();
    const Unfolding result = unfolder.unfold(h, triangles_);
    rings_.layout.longest_unfolding = std::max(rings_.layout.longest_unfolding, result.crossed);
    if (!result.split) unsplit_.push_back(h);
    for (const UnfoldedTriangle& t : triangles_) unfolded_.push_back(measured(t));
  }

  // The obtuse corners of some faces; returns how many.
  std::size_t find_obtuse(std::size_t begin, std::size_t end, Index* obtuse) const {
    if (mesh_.has_positions()) {
#ifdef BRUSHFIRE_HAS_AVX2_VARIANT
      if (in_registers()) return find_obtuse4(fans_.positions, faces_, fans_.scale, begin, end, obtuse);
#endif
      return detail::find_obtuse(fans_.positions, faces_, fans_.scale, begin, end, obtuse);
    }
    std::size_t count = 0;
    for (std::size_t f = begin; f < end; ++f) {
      const auto [a, b, c] = mesh_.face_geometry(static_cast<Index>(f)).lengths;
      obtuse[count] = obtuse_corner({a * a, b * b, c * c}, static_cast<Index>(f));
      count += obtuse[count] != kNoIndex;
    }
    return count;
  }

  void fill() {
    const std::size_t count = mesh_.vertex_count();
    rings_.layout.block_offset.resize(count + 1);
    patches_.resize(count + 1);
    patches_[count] = {};
    plain_sides_.resize(count);
    LaneWriter<T> lanes(fans_.none, count + count / 2);  // what is not written costs nothing
#ifdef BRUSHFIRE_HAS_AVX2_VARIANT
    if (in_registers()) {
      fill<FanInRegisters<T>>(lanes);
    } else {
      fill<FanInLoops<T>>(lanes);
    }
#else
    fill<FanInLoops<T>>(lanes);
#endif
    rings_.layout.block_offset[count] = lanes.blocks_done();
    lanes.take(rings_.blocks, rings_.layout.links);
    if (sum_of_lengths_ > 0) rings_.layout.mean_edge = sum_of_lengths_ / static_cast<double>(mesh_.halfedge_count());
  }

#ifdef BRUSHFIRE_HAS_AVX2_VARIANT
  bool in_registers() const { return variant_ == Variant::Best && has_avx2(); }
#endif

  template <class Fan>
  void fill(LaneWriter<T>& lanes) {
    PlainFans<T> fans;
    for (Index first = 0; first < fans_.none; first += kFans) {
      const Index count = std::min(kFans, fans_.none - first);
      Fan::fill(fans_, first, count, fans);
      for (Index i = 0; i < count; ++i) {
        const Index v = first + i;
        prefetch_unfolded(v + kUnfoldedAhead);
        rings_.layout.block_offset[v] = lanes.blocks_done();
        if (fans.plain[i]) {
          lanes.add_block(fans.block[i], fans.links[i], faces_at(v));
          note_plain(v, fans.angle[i], fans.area[i], fans.length[i]);
        } else {
          fill_any(v, lanes);
        }
        for (Index e = first_of_[v]; e != kNoIndex;) {
          const Unfolded& t = unfolded_[e / 2];
          const Index own = e % 2;
          lanes.add_unfolded({t.corner, t.end[1 - own], t.length[own], t.between, t.dot[own], t.cross});
          e = t.next[own];
        }
        lanes.finish();
        if (names_other_parts(v, lanes)) at_border_.push_back(v);
      }
    }
  }

  static constexpr Index kUnfoldedAhead = 8;
  void prefetch_unfolded(Index v) {
    if (v < fans_.none && first_of_[v] != kNoIndex) prefetch(&unfolded_[first_of_[v] / 2]);
  }

  Index faces_at(Index v) const { return fans_.corner_offsets[v + 1] - fans_.corner_offsets[v]; }

  BRUSHFIRE_INLINE bool names_other_parts(Index v, const LaneWriter<T>& lanes) const {
    Index differ = 0;
    for (Index i = rings_.layout.block_offset[v]; i < lanes.blocks_done(); ++i) {
      const RingBlock<T>& block = lanes.block(i);
      for (Index k = 0; k < kLanes; ++k) differ |= block.end[k] == fans_.none ? 0 : block.end[k] ^ v;
    }
    return differ >> part_shift_ != 0;
  }

  void note_plain(Index v, T angle, T area, T length) {
    sum_of_lengths_ += static_cast<double>(length);
    const double deficit = 2 * kPi - static_cast<double>(angle);
    patches_[v] = {std::abs(deficit) < kFlat<T> ? 0.0f : static_cast<float>(deficit), static_cast<float>(area / 6)};
    plain_sides_[v] = static_cast<std::uint8_t>(faces_at(v));
  }

  // Any vertex: boundaries, more faces than lanes, faces that are mirrored, doubled or degenerate, lengths only.
  void fill_any(Index v, LaneWriter<T>& lanes) {
    double deficit = 2 * kPi, around = 0;
    bool inner = true;  // every edge has two faces
    loose_.clear();
    for (const Index h : mesh_.corners(v)) {
      const Index f = Mesh::face_of(h), next = Mesh::next(h), previous = Mesh::previous(h);
      const Face& t = faces_[f];
      const Index a = t[next % 3], b = t[previous % 3];
      const auto [length, area] = mesh_.face_geometry(f);
      const double la = length[h % 3], lb = length[previous % 3], lab = length[next % 3];
      sum_of_lengths_ += la;
      if (a == b || a == v || b == v) {
        lanes.add_edge(a, la);
        lanes.add_edge(b, lb);
        continue;
      }
      const double shorter = std::min(la, lb), longer = std::max(la, lb);
      const double dot = 0.5 * (shorter * shorter + (longer - lab) * (longer + lab));  // keeps digits in needles
      loose_.push_back({a, b, la, lb, dot, area});
      deficit -= quick_angle(dot, area);
      around += area / 6;
      inner = inner && has_two_faces(h) && has_two_faces(previous);
    }
    add_fans(lanes);
    const bool flat = !inner || std::abs(deficit) < kFlat<T>;
    patches_[v] = {flat ? 0.0f : static_cast<float>(deficit), static_cast<float>(around)};
    plain_sides_[v] = 0;
  }

  // Strings the loose corners together to fans, turning them over where needed.
  void add_fans(LaneWriter<T>& lanes) {
    constexpr std::size_t kMany = 64;  // the search is quadratic
    if (loose_.size() > kMany) {
      for (const Corner& c : loose_) lanes.add_fan({&c, 1}, false);
      return;
    }
    while (!loose_.empty()) {
      fan_.clear();
      take(first_of_fan());
      while (continue_fan()) {
      }
      const bool closed = fan_.size() > 2 && fan_.back().b == fan_.front().a;
      lanes.add_fan(fan_, closed);
    }
  }

  void take(std::size_t at) {
    fan_.push_back(loose_[at]);
    loose_.erase(loose_.begin() + static_cast<std::ptrdiff_t>(at));
  }

  // One with a side that no other one has, if there is any.
  std::size_t first_of_fan() {
    for (std::size_t i = 0; i < loose_.size(); ++i) {
      Index at_a = 0, at_b = 0;
      for (const Corner& c : loose_) {
        at_a += (c.a == loose_[i].a) + (c.b == loose_[i].a);
        at_b += (c.a == loose_[i].b) + (c.b == loose_[i].b);
      }
      if (at_a > 1 && at_b > 1) continue;
      if (at_a > 1) loose_[i] = loose_[i].mirrored();
      return i;
    }
    return 0;
  }

  bool continue_fan() {
    for (std::size_t i = 0; i < loose_.size(); ++i) {
      if (loose_[i].a != fan_.back().b && loose_[i].b != fan_.back().b) continue;
      if (loose_[i].a != fan_.back().b) loose_[i] = loose_[i].mirrored();
      take(i);
      return true;
    }
    return false;
  }

  bool has_two_faces(Index h) const { return mesh_.neighbour(h) != h; }

  // Patches are smoothed once, over the other ends of each vertex's halfedges.
  void bend_fronts() {
    rings_.bend.resize(mesh_.vertex_count());
    constexpr Index kAhead = 12;
    for (Index i = 0; i < fans_.none; ++i) {
      if (i + kAhead < fans_.none) prefetch(&rings_.blocks[rings_.layout.block_offset[i + kAhead]]);
      Patch around = patches_[i];
      const auto add = [&](const Patch& other) { around.deficit += other.deficit, around.area += other.area; };
      if (plain_sides_[i] > 0) {
        // All lanes, as there is no telling how many are used: no side ends in no patch.
        const Index* const end = rings_.blocks[rings_.layout.block_offset[i]].end;
        for (Index k = 0; k < kLanes; ++k) add(patches_[plain_sides_[i] > k ? end[k] : fans_.none]);
      } else {
        for (const Index h : mesh_.corners(i)) add(patches_[mesh_.to(h)]);
      }
      rings_.bend[i] = static_cast<T>(front_bend(patches_[i], around));
    }
  }

  // Puts ghosts in place of vertices of other parts.
  void separate_parts() {
    RingLayout& layout = rings_.layout;
    PartsBuilder builder(fans_.none, part_shift_);
    for (std::size_t begin = 0, end = 0; begin < at_border_.size(); begin = end) {
      const Index part = at_border_[begin] >> part_shift_;
      while (end < at_border_.size() && at_border_[end] >> part_shift_ == part) ++end;
      const std::span<const Index> border(at_border_.data() + begin, end - begin);
      for_each_foreign_end(border, [&](Index v, Index& named) { builder.add(v, named); });
      const std::span<const Index> ghosts = builder.finish_part(part);
      std::size_t i = 0;
      for_each_foreign_end(border, [&](Index, Index& named) { named = ghosts[i++]; });
    }
    layout.parts = builder.take();
    layout.block_offset.resize(layout.parts.places() + 1, layout.block_offset.back());
    rings_.bend.resize(layout.parts.places());
    rings_.bend[fans_.none] = 0;
    for (std::size_t g = 0; g < layout.parts.owner.size(); ++g) {
      rings_.bend[layout.parts.first_ghost() + g] = rings_.bend[layout.parts.owner[g]];
    }
  }

  template <class Act>
  void for_each_foreign_end(std::span<const Index> vertices, const Act& act) {
    for (const Index v : vertices) {
      for (Index i = rings_.layout.block_offset[v]; i < rings_.layout.block_offset[v + 1]; ++i) {
        for (Index& end : rings_.blocks[i].end) {
          if (end < fans_.none && (end ^ v) >> part_shift_ != 0) act(v, end);
        }
      }
    }
  }

  // The corner at h is a target from the two other vertices of its face.
  void mark_unsplit(Index h) {
    const Index target = mesh_.from(h), next = mesh_.to(h);
    const Index previous = mesh_.from(Mesh::previous(h));
    mark_unsplit(next, target, previous);
    mark_unsplit(previous, target, next);
  }

  void mark_unsplit(Index at, Index target, Index other) {
    for (Index i = rings_.layout.block_offset[at]; i < rings_.layout.block_offset[at + 1]; ++i) {
      const RingBlock<T>& block = rings_.blocks[i];
      LaneLinks& lanes = rings_.layout.links[i];
      for (Index k = 0; k < kLanes; ++k) {
        const Index a = block.end[k], b = block.end[lanes.second(k)];
        if (a == target && b == other) lanes.links[k] |= LaneLinks::kAnyOrderFirst;
        if (a == other && b == target) lanes.links[k] |= LaneLinks::kAnyOrderSecond;
      }
    }
  }

  const Mesh& mesh_;
  Variant variant_;
  std::span<const Face> faces_;
  FanMesh fans_;
  int part_shift_;
  double sum_of_lengths_ = 0;
  Rings<T> rings_;
  std::vector<UnfoldedTriangle> triangles_;  // of one corner
  Pieces<Unfolded> unfolded_;
  std::vector<Index> unsplit_;                    // corners whose unfolding ended early
  std::vector<Index> first_of_;                   // [vertex_count] lists of unfolded triangles
  UninitializedArray<Patch> patches_;             // [vertex_count]
  UninitializedArray<std::uint8_t> plain_sides_;  // [vertex_count] of a plain fan; 0 for any other vertex
  std::vector<Corner> loose_, fan_;               // of one vertex
  std::vector<Index> at_border_;                  // vertices whose blocks name vertices of other parts, ascending
};

}  // namespace

template <class T>
Rings<T> build_rings(const Mesh& mesh, Index part_size, Variant variant) {
  return RingBuilder<T>(mesh, part_size, variant).build();
}

template Rings<float> build_rings<float>(const Mesh& mesh, Index part_size, Variant variant);
template Rings<double> build_rings<double>(const Mesh& mesh, Index part_size, Variant variant);

}  // namespace brushfire::detail
