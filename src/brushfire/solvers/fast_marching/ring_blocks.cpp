// Builds the blocks: writes the sides and triangles around one vertex after the other, unfolds the obtuse corners that
// are found on the way, and adds what comes of that to the vertices around.
#include <brushfire/core/detail/sort.h>
#include <brushfire/solvers/fast_marching/detail/ring_blocks.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/planar.h>
#include <brushfire/core/detail/prefault.h>
#include <brushfire/core/detail/prefetch.h>
#include <brushfire/solvers/fast_marching/detail/corner_unfolder.h>
#include <brushfire/solvers/fast_marching/detail/curvature_correction.h>
#include <brushfire/solvers/fast_marching/detail/lane_writer.h>
#include <brushfire/solvers/fast_marching/detail/regular_ring.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>

namespace brushfire::fast_marching {
namespace {

template <class T>
class RingBuilder {
 public:
  RingBuilder(const Mesh& mesh, Index part_size, Variant variant, const FaceCosts& costs)
      : mesh_(mesh),
        costs_(costs),
        variant_(variant),
        faces_(mesh.faces()),
        shape_{mesh.positions(),
               mesh.faces(),
               mesh.corner_offsets(),
               mesh.all_corners(),
               1 / mesh.unit(),
               mesh.vertex_count(),
               mesh.has_positions() && !mesh.has_slits() && !costs.any()},
        part_shift_(partition::part_shift(part_size)),
        lanes_(mesh.vertex_count()),
        unfolded_(mesh, variant, costs) {}

  Rings<T> build() {
    fill();
    correct_curvature();
    rings_.layout.longest_unfolding = unfolded_.most_crossed();
    for (const Index h : unfolded_.unsplit()) mark_unsplit(h);
    mark_crowded();
    separate_parts();
    return std::move(rings_);
  }

 private:
  void fill() {
    deficits_.resize(mesh_.vertex_count() + 1);
    prefault(deficits_);
    deficits_.back() = {};
    regular_sides_.resize(mesh_.vertex_count());
    fill_rings();
    lanes_.take(rings_);
    if (!(sum_of_lengths_ > 0)) return;
    rings_.layout.mean_edge = costs_.mean() * sum_of_lengths_ / static_cast<double>(mesh_.halfedge_count());
  }

  void fill_rings() {
    RegularRings<T> regular;
    for (Index first = 0; first < shape_.none; first = begun_) {
      poll_();
      begun_ = std::min(first + kRingsAtOnce, shape_.none);
      lanes_.make_room(begun_);
      BRUSHFIRE_ON_TARGET(variant_, fill_regular_rings(shape_, first, begun_ - first, lanes_.first_block(first),
                                                       lanes_.first_links(first), regular));
      note(first, begun_ - first, regular);
      obtuse_.insert(obtuse_.end(), regular.obtuse, regular.obtuse + regular.obtuse_count);
      for (Index v = first; v < begun_; ++v) {
        lanes_.begin(v);
        if (!regular.regular[v - first]) fill_any(v);
      }
      if (part_shift_ != partition::kWholeMesh) note_border(first, begun_);
      if (obtuse_.size() >= kUnfoldAtOnce) unfold_obtuse_corners();
    }
    unfold_obtuse_corners();
    for (const Late& t : late_) {
      poll_();
      lanes_.add_unfolded(t.at, t.corner);
    }
  }

  // So few that what they need is still in a cache.
  static constexpr std::size_t kUnfoldAtOnce = 512;

  void unfold_obtuse_corners() {
    unfolded_.unfold(obtuse_, *this);
    obtuse_.clear();
  }

  // For CornerUnfolder.
  friend class CornerUnfolder<T>;
  void prefetch(Index v) const { lanes_.prefetch_ring(v); }
  BRUSHFIRE_INLINE void add_unfolded(Index v, const Corner& corner) {
    poll_();
    if (((corner.a ^ v) | (corner.b ^ v)) >> part_shift_ != 0) at_border_.push_back(v);
    if (v < begun_) {
      lanes_.add_unfolded(v, corner);
    } else {
      late_.push_back({v, corner});
    }
  }

  Index faces_at(Index v) const { return shape_.corner_offsets[v + 1] - shape_.corner_offsets[v]; }

  // Remembers vertices one of whose sides ends in another part.
  void note_border(Index first, Index end) {
    for (Index v = first; v < end; ++v) {
      const RingBlock<T>& block = *lanes_.first_block(v);
      Index differ = 0;
      for (Index k = 0; k < kLanes; ++k) differ |= block.end[k] == shape_.none ? 0 : block.end[k] ^ v;
      if (differ >> part_shift_ != 0) at_border_.push_back(v);
    }
  }

  void note(Index first, Index count, const RegularRings<T>& rings) {
    for (Index i = 0; i < count; ++i) {
      const double deficit = 2 * kPi - static_cast<double>(rings.angle[i]);
      const float own = std::abs(deficit) < kFlat<T> ? 0.0f : static_cast<float>(deficit);
      deficits_[first + i] = {own, static_cast<float>(rings.area[i] / 6)};
      regular_sides_[first + i] = static_cast<std::uint8_t>(faces_at(first + i));
      sum_of_lengths_ += static_cast<double>(rings.length[i]);
    }
  }

  // Any vertex: boundaries, more faces than lanes, faces that are mirrored, doubled or degenerate, lengths only.
  void fill_any(Index v) {
    poll_();
    double deficit = 2 * kPi, around = 0;
    lanes_.begin_empty(v);
    loose_.clear();
    ends_.clear();
    Index differ = 0;
    for (const Index h : mesh_.corners(v)) {
      const Index f = Mesh::face_of(h), next = Mesh::next(h), previous = Mesh::previous(h);
      const Face& t = faces_[f];
      const Index a = t[next % 3], b = t[previous % 3];
      const auto [length, double_area] = unfolded_.unfolder().geometry(f);
      const double w = costs_.of(f), la = w * length[h % 3], lb = w * length[previous % 3], lab = w * length[next % 3];
      const double area = w * w * double_area;
      sum_of_lengths_ += length[h % 3];
      differ |= (a ^ v) | (b ^ v);
      if (a == b || a == v || b == v) {
        lanes_.add_edge(v, a, la);
        lanes_.add_edge(v, b, lb);
        continue;
      }
      const double shorter = std::min(la, lb), longer = std::max(la, lb);
      const double dot = 0.5 * (shorter * shorter + (longer - lab) * (longer + lab));  // keeps digits in needles
      loose_.push_back({a, b, la, lb, dot, area});
      ends_.insert(ends_.end(), {a, b});
      if (dot < 0) obtuse_.push_back(h);
      deficit -= portable::quick_angle(dot, area);
      around += double_area / 6;
    }
    const bool inner = is_inner(v), flat = !inner || std::abs(deficit) < kFlat<T>;
    deficits_[v] = {flat ? 0.0f : static_cast<float>(deficit), static_cast<float>(around)};
    regular_sides_[v] = 0;
    if (differ >> part_shift_ != 0) at_border_.push_back(v);
    add_fans(v, inner && !costs_.any());
  }

  // Whether every edge at v has two faces.
  bool is_inner(Index v) const {
    if (mesh_.has_slits() || loose_.size() > kMany) {
      static_cast<void>(mesh_.opposite());  // all of them: many will be asked for
      const std::span<const Index> corners = mesh_.corners(v);
      return std::all_of(corners.begin(), corners.end(), [&](Index h) {
        return !mesh_.is_face_usable(Mesh::face_of(h)) || (has_two_faces(h) && has_two_faces(Mesh::previous(h)));
      });
    }
    return std::all_of(ends_.begin(), ends_.end(),
                       [&](Index end) { return std::count(ends_.begin(), ends_.end(), end) == 2; });
  }

  static constexpr std::size_t kMany = 64;  // corners: the searches are quadratic

  // Strings the loose corners together to fans, turning them over where needed.
  void add_fans(Index v, bool inner) {
    if (loose_.size() > kMany) {
      for (const Corner& c : loose_) lanes_.add_fan(v, {&c, 1}, false);
      return;
    }
    while (!loose_.empty()) {
      fan_.clear();
      take(inner ? 0 : first_of_fan());
      while (continue_fan()) {
      }
      const bool closed = fan_.size() > 2 && goes_on(fan_.back(), fan_.front());
      lanes_.add_fan(v, fan_, closed);
    }
  }

  void take(std::size_t at) {
    fan_.push_back(loose_[at]);
    loose_.erase(loose_.begin() + static_cast<std::ptrdiff_t>(at));
  }

  // Whether the next one begins on the side where the first one ends.
  bool goes_on(const Corner& first, const Corner& next) const {
    return next.a == first.b && (!costs_.any() || next.length_a == first.length_b);
  }

  // One with a side that no other one has, if there is any.
  std::size_t first_of_fan() {
    for (std::size_t i = 0; i < loose_.size(); ++i) {
      Index at_a = 0, at_b = 0;
      for (const Corner& c : loose_) {
        const Corner& own = loose_[i];
        at_a += goes_on(own.mirrored(), c) + goes_on(own.mirrored(), c.mirrored());
        at_b += goes_on(own, c) + goes_on(own, c.mirrored());
      }
      if (at_a > 1 && at_b > 1) continue;
      if (at_a > 1) loose_[i] = loose_[i].mirrored();
      return i;
    }
    return 0;
  }

  bool continue_fan() {
    for (std::size_t i = 0; i < loose_.size(); ++i) {
      const bool as_is = goes_on(fan_.back(), loose_[i]);
      if (!as_is && !goes_on(fan_.back(), loose_[i].mirrored())) continue;
      if (!as_is) loose_[i] = loose_[i].mirrored();
      take(i);
      return true;
    }
    return false;
  }

  bool has_two_faces(Index h) const { return mesh_.neighbour(h) != h; }

  // AngleDeficites are smoothed once, over the other ends of each vertex's halfedges.
  void correct_curvature() {
    constexpr Index kAhead = 12;
    for (Index v = 0; v < shape_.none; ++v) {
      poll_();
      if (v + kAhead < shape_.none) brushfire::prefetch(&rings_.blocks[v + kAhead]);
      const AngleDeficit around = regular_sides_[v] > 0 ? regular_sum(v) : any_sum(v);
      const double w = costs_.around(v);  // what bends fronts where weights differ is not the surface alone
      rings_.heads[v].correction = w > 0 ? static_cast<T>(curvature_correction(deficits_[v], around) / w) : T(0);
    }
  }

  AngleDeficit any_sum(Index v) const {
    AngleDeficit sum = deficits_[v];
    for (const Index h : mesh_.corners(v)) sum += deficits_[mesh_.to(h)];
    return sum;
  }

  // All lanes, as there is no telling how many are used: no side ends in no patch.
  AngleDeficit regular_sum(Index v) const {
    const Index* const end = rings_.blocks[v].end;
    const Index sides = regular_sides_[v];
    Index other[kLanes];
    for (Index k = 0; k < kLanes; ++k) other[k] = k < sides ? end[k] : shape_.none;
    AngleDeficit sum = deficits_[v];
    for (const Index w : other) sum += deficits_[w];
    return sum;
  }

  // Puts ghosts in place of vertices of other parts.
  void separate_parts() {
    RingLayout& layout = rings_.layout;
    partition::VertexPartitionBuilder builder(shape_.none, part_shift_);
    detail::sort(at_border_.begin(), at_border_.end());
    at_border_.erase(std::unique(at_border_.begin(), at_border_.end()), at_border_.end());
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
    rings_.heads.resize(layout.parts.places());
    rings_.heads[shape_.none] = {};
    for (std::size_t g = 0; g < layout.parts.owner.size(); ++g) {
      rings_.heads[layout.parts.first_ghost() + g] = {rings_.heads[layout.parts.owner[g]].correction, 0};
    }
  }

  template <class Act>
  void for_each_foreign_end(std::span<const Index> vertices, const Act& act) {
    for (const Index v : vertices) {
      for_each_block(v, [&](Index i) {
        for (Index& end : rings_.blocks[i].end) {
          if (end < shape_.none && (end ^ v) >> part_shift_ != 0) act(v, end);
        }
      });
    }
  }

  template <class Act>
  void for_each_block(Index v, const Act& act) const {
    Index i = v;
    do act(i);
    while ((i = rings_.next_block(v, i)) != 0);
  }

  // The corner at h is a target from the two other vertices of its face.
  void mark_unsplit(Index h) {
    poll_();
    const Index target = mesh_.from(h), next = mesh_.to(h);
    const Index previous = mesh_.from(Mesh::previous(h));
    mark_unsplit({next, target, previous});
    mark_unsplit({previous, target, next});
  }

  // A corner that is seen from a vertex, and the third vertex of its face.
  struct Unsplit {
    Index at, target, other;
  };

  void mark_unsplit(const Unsplit& u) {
    if (faces_at(u.at) > kMany) {
      crowded_.push_back(u);  // one pass over the ring is for all
      return;
    }
    for_each_block(u.at, [&](Index i) {
      for (Index k = 0; k < kLanes; ++k) mark_lane(i, k, u.target, u.other);
    });
  }

  void mark_lane(Index i, Index k, Index target, Index other) {
    const RingBlock<T>& block = rings_.blocks[i];
    LaneLinks& lanes = rings_.layout.links[i];
    const Index a = block.end[k], b = block.end[lanes.second(k)];
    if (a == target && b == other) lanes.links[k] |= LaneLinks::kAnyOrderFirst;
    if (a == other && b == target) lanes.links[k] |= LaneLinks::kAnyOrderSecond;
  }

  void mark_crowded() {
    const auto by_ends = [](const Unsplit& u, const Unsplit& w) {
      return std::tie(u.at, u.target, u.other) < std::tie(w.at, w.target, w.other);
    };
    detail::sort(crowded_.begin(), crowded_.end(), by_ends);
    for (std::size_t begin = 0, end = 0; begin < crowded_.size(); begin = end) {
      const Index at = crowded_[begin].at;
      while (end < crowded_.size() && crowded_[end].at == at) ++end;
      const std::span<const Unsplit> its(crowded_.data() + begin, end - begin);
      for_each_block(at, [&](Index i) {
        for (Index k = 0; k < kLanes; ++k) {
          const Index a = rings_.blocks[i].end[k], b = rings_.blocks[i].end[rings_.layout.links[i].second(k)];
          if (std::binary_search(its.begin(), its.end(), Unsplit{at, a, b}, by_ends)) mark_lane(i, k, a, b);
          if (std::binary_search(its.begin(), its.end(), Unsplit{at, b, a}, by_ends)) mark_lane(i, k, b, a);
        }
      });
    }
  }

  const Mesh& mesh_;
  FaceCosts costs_;
  Variant variant_;
  std::span<const Face> faces_;
  Poll poll_{256};  // a step may be a vertex of many faces
  RingMesh shape_;
  int part_shift_;
  double sum_of_lengths_ = 0;
  Rings<T> rings_;
  LaneWriter<T> lanes_;
  Index begun_ = 0;            // vertices whose rings have been begun
  std::vector<Index> obtuse_;  // corners to be unfolded
  CornerUnfolder<T> unfolded_;
  struct Late {
    Index at;
    Corner corner;
  };
  std::vector<Late> late_;                          // unfolded triangles at vertices whose rings had not been begun
  UninitializedArray<AngleDeficit> deficits_;       // [vertex_count]
  UninitializedArray<std::uint8_t> regular_sides_;  // [vertex_count] of a regular ring; 0 for any other vertex
  std::vector<Corner> loose_, fan_;                 // of one vertex
  std::vector<Index> ends_;                         // of the sides of its loose corners
  std::vector<Unsplit> crowded_;                    // at vertices of many faces
  std::vector<Index> at_border_;                    // vertices whose blocks name vertices of other parts
};

}  // namespace

template <class T>
Rings<T> build_rings(const Mesh& mesh, Index part_size, Variant variant, const FaceCosts& costs) {
  return RingBuilder<T>(mesh, part_size, variant, costs).build();
}

template Rings<float> build_rings<float>(const Mesh& mesh, Index part_size, Variant variant, const FaceCosts& costs);
template Rings<double> build_rings<double>(const Mesh& mesh, Index part_size, Variant variant, const FaceCosts& costs);

}  // namespace brushfire::fast_marching
