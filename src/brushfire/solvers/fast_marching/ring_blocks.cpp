// Builds the blocks: unfolds obtuse corners, then writes every vertex's sides and triangles once, in the internal
// order.
#include <brushfire/solvers/fast_marching/ring_blocks.h>

#include <brushfire/core/planar.h>
#include <brushfire/solvers/fast_marching/bend.h>
#include <brushfire/solvers/fast_marching/lane_writer.h>
#include <brushfire/solvers/fast_marching/unfold.h>
#include <brushfire/solvers/fast_marching/vector_target.h>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace brushfire::detail {
namespace {

// The corners of an inner vertex of few faces that all lie the same way round: corner k lies between the ends a[k] and
// b[k] of its sides; b[k] is a[second[k]], and a[k] is b[back[k]].
struct PlainFan {
  alignas(32) Index a[kLanes];
  alignas(32) Index b[kLanes];
  alignas(32) Index second[kLanes];
  alignas(32) Index back[kLanes];
  Index count = 0;
};

// The sides of a fan as vectors.
template <class T>
struct Sides {
  alignas(64) T x[kLanes], y[kLanes], z[kLanes];
};

// By lane: lengths, products, angles at the vertex.
template <class T>
struct FanGeometry {
  alignas(64) T length[kLanes], dot[kLanes], cross[kLanes], angle[kLanes];
};

// The halfedges of the obtuse corners of all faces.
BRUSHFIRE_INLINE std::size_t find_obtuse(std::span<const Vec3> positions, std::span<const Face> faces, double scale,
                                         UninitializedArray<Index>& obtuse) {
  std::size_t count = 0;
  for (Index f = 0; f < faces.size(); ++f) {
    const Face& t = faces[f];
    const Vec3 a = positions[t[0]], b = positions[t[1]], c = positions[t[2]];
    const Vec3 ab = scale * (b - a), bc = scale * (c - b), ca = scale * (a - c);
    const Index h = obtuse_corner({dot(ab, ab), dot(bc, bc), dot(ca, ca)}, f);
    obtuse[count] = h;  // written always, kept where wanted: there is no telling which faces are
    count += h != kNoIndex;
  }
  return count;
}

// The corners of a face that follow each of its corners.
constexpr std::array<std::array<std::uint8_t, 2>, 3> kOthers{{{1, 2}, {2, 0}, {0, 1}}};

template <class T>
class RingBuilder {
 public:
  explicit RingBuilder(const Mesh& mesh)
      : mesh_(mesh),
        faces_(mesh.faces()),
        positions_(mesh.positions()),
        corner_offsets_(mesh.corner_offsets()),
        corners_(mesh.all_corners()),
        scale_(1 / mesh.unit()),
        may_be_plain_(mesh.has_positions() && !mesh.has_slits()),
        none_(mesh.vertex_count()) {}

  Rings<T> build() {
    unfold_obtuse_corners();
    fill();
    bend_fronts();
    for (const Index h : unsplit_) mark_unsplit(h);
    return std::move(rings_);
  }

 private:
  void unfold_obtuse_corners() {
    for (const Index h : obtuse_corners()) {
      if (!mesh_.is_face_usable(Mesh::face_of(h))) continue;
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

  UninitializedArray<Index> obtuse_corners() const {
    UninitializedArray<Index> obtuse(mesh_.face_count() + std::size_t{1});
    std::size_t count = 0;
    if (mesh_.has_positions()) {
      count = find_obtuse(positions_, faces_, scale_, obtuse);
    } else {
      for (Index f = 0; f < mesh_.face_count(); ++f) {
        const auto [a, b, c] = mesh_.face_geometry(f).lengths;
        obtuse[count] = obtuse_corner({a * a, b * b, c * c}, f);
        count += obtuse[count] != kNoIndex;
      }
    }
    obtuse.resize(count);
    return obtuse;
  }

  void fill() {
    const std::size_t count = mesh_.vertex_count();
    rings_.layout.block_offset.resize(count + 1);
    patches_.resize(count);
    plain_sides_.resize(count);
    LaneWriter<T> lanes(none_, count + count / 2);  // what is not written costs nothing
#ifdef BRUSHFIRE_HAS_AVX2_VARIANT
    __builtin_cpu_supports("avx2") ? fill_avx2(lanes) : fill_all(lanes);
#else
    fill_all(lanes);
#endif
    rings_.layout.block_offset[count] = lanes.blocks_done();
    lanes.take(rings_.blocks, rings_.layout.links);
    if (sum_of_lengths_ > 0) rings_.layout.mean_edge = sum_of_lengths_ / static_cast<double>(mesh_.halfedge_count());
  }

#ifdef BRUSHFIRE_HAS_AVX2_VARIANT
  [[gnu::target("avx2,bmi,lzcnt")]] void fill_avx2(LaneWriter<T>& lanes) { fill_all(lanes); }
#endif

  BRUSHFIRE_INLINE void fill_all(LaneWriter<T>& lanes) {
    for (Index v = 0; v < none_; ++v) {
      rings_.layout.block_offset[v] = lanes.blocks_done();
      if (!fill_plain(v, lanes)) fill_any(v, lanes);
      for (Index e = first_of_[v]; e != kNoIndex; e = next_of_[e]) lanes.add_unfolded(unfolded_corner(e));
      lanes.finish();
    }
  }

  // The common case, all lanes at once. False where this vertex is none.
  BRUSHFIRE_INLINE bool fill_plain(Index v, LaneWriter<T>& lanes) {
    PlainFan fan;
    if (!find_plain_fan(v, fan)) return false;
    Sides<T> sides;
    measure_sides(v, fan, sides);
    FanGeometry<T> geometry;
    if (!measure_fan(sides, fan, geometry)) return false;

    constexpr T kNever = std::numeric_limits<T>::infinity(), kNone = std::numeric_limits<T>::quiet_NaN();
    RingBlock<T>& block = lanes.block();
    T angle = 0, area = 0, length = 0;
    for (Index k = 0; k < kLanes; ++k) {
      const bool used = k < fan.count;
      block.end[k] = used ? fan.a[k] : none_;
      block.length[k] = used ? geometry.length[k] : kNever;
      block.dot[k] = used ? geometry.dot[k] : kNone;
      block.cross[k] = geometry.cross[k];
    }
    for (Index k = 0; k < kLanes; ++k) {  // 0 in unused lanes
      angle += geometry.angle[k];
      area += geometry.cross[k];
      length += geometry.length[k];
    }
    lanes.filled(fan.count, fan.second, fan.back);
    sum_of_lengths_ += static_cast<double>(length);
    const double deficit = 2 * kPi - static_cast<double>(angle);
    patches_[v] = {std::abs(deficit) < kFlat<T> ? 0.0f : static_cast<float>(deficit), static_cast<float>(area / 6)};
    plain_sides_[v] = static_cast<std::uint8_t>(fan.count);
    return true;
  }

  // False where v is not the middle of such a fan.
  BRUSHFIRE_INLINE bool find_plain_fan(Index v, PlainFan& fan) const {
    const Index begin = corner_offsets_[v], count = corner_offsets_[v + 1] - begin;
    fan.count = count;
    if (count > kLanes || count < 3 || !may_be_plain_) return false;
    for (Index k = 0; k < kLanes; ++k) fan.a[k] = kNoIndex, fan.b[k] = kNoIndex - 1;
    for (Index k = 0; k < count; ++k) {
      const Index h = corners_[begin + k], f = h / 3;
      const std::array<std::uint8_t, 2> others = kOthers[h - 3 * f];
      fan.a[k] = faces_[f][others[0]];
      fan.b[k] = faces_[f][others[1]];
    }
    // Every side is the first of one corner and the second of another one.
    alignas(32) Index second[kLanes]{}, back[kLanes]{}, found[kLanes]{};
    for (Index j = 0; j < kLanes; ++j) {
      for (Index k = 0; k < kLanes; ++k) {
        second[k] += fan.a[j] == fan.b[k] ? j : 0u;
        found[k] += fan.a[j] == fan.b[k] ? 1u : 0u;
        back[k] += fan.a[k] == fan.b[j] ? j : 0u;
        found[k] += fan.a[k] == fan.b[j] ? 16u : 0u;
      }
    }
    Index wrong = 0;
    for (Index k = 0; k < kLanes; ++k) {
      wrong |= found[k] ^ (k < count ? 17u : 0u);
      wrong |= (fan.a[k] == v) | (fan.b[k] == v) | (fan.a[k] == fan.b[k]) ? 1u : 0u;
    }
    for (Index k = 0; k < kLanes; ++k) fan.second[k] = k < count ? second[k] : k;
    for (Index k = 0; k < kLanes; ++k) fan.back[k] = k < count ? back[k] : k;
    return wrong == 0;
  }

  // Sides of length 0 in lanes that are not used.
  BRUSHFIRE_INLINE void measure_sides(Index v, const PlainFan& fan, Sides<T>& sides) const {
    const Vec3 at = positions_[v];
    for (Index k = 0; k < kLanes; ++k) {
      const Vec3 side = scale_ * (positions_[k < fan.count ? fan.a[k] : v] - at);
      sides.x[k] = static_cast<T>(side.x), sides.y[k] = static_cast<T>(side.y), sides.z[k] = static_cast<T>(side.z);
    }
  }

  // False where squares may have vanished.
  BRUSHFIRE_INLINE static bool measure_fan(const Sides<T>& e, const PlainFan& fan, FanGeometry<T>& g) {
    Sides<T> f;
    alignas(64) T squared[kLanes], squared_b[kLanes];
    for (Index k = 0; k < kLanes; ++k) squared[k] = e.x[k] * e.x[k] + e.y[k] * e.y[k] + e.z[k] * e.z[k];
    for (Index k = 0; k < kLanes; ++k) {
      const Index b = fan.second[k];
      f.x[k] = e.x[b], f.y[k] = e.y[b], f.z[k] = e.z[b];
      squared_b[k] = squared[b];
    }
    for (Index k = 0; k < kLanes; ++k) {
      const T gx = f.x[k] - e.x[k], gy = f.y[k] - e.y[k], gz = f.z[k] - e.z[k];
      const T aa = squared[k], bb = squared_b[k], cc = gx * gx + gy * gy + gz * gz;
      g.length[k] = std::sqrt(aa);
      g.dot[k] = e.x[k] * f.x[k] + e.y[k] * f.y[k] + e.z[k] * f.z[k];
      // Of the two shorter edges: rounding of a cross product grows with the product of the lengths.
      const bool third_longest = (cc >= aa) & (cc >= bb), first_longest = !third_longest & (aa >= bb);
      const T ux = first_longest ? f.x[k] : e.x[k], wx = third_longest ? f.x[k] : gx;
      const T uy = first_longest ? f.y[k] : e.y[k], wy = third_longest ? f.y[k] : gy;
      const T uz = first_longest ? f.z[k] : e.z[k], wz = third_longest ? f.z[k] : gz;
      const T cx = uy * wz - uz * wy, cy = uz * wx - ux * wz, cz = ux * wy - uy * wx;
      g.cross[k] = std::sqrt(cx * cx + cy * cy + cz * cz);
    }
    for (Index k = 0; k < kLanes; ++k) g.angle[k] = quick_angle(g.dot[k], g.cross[k]);
    // Not so small that squares and fourth powers lose their digits; infinite differences are not in order either.
    constexpr T kSmallest = std::is_same_v<T, float> ? T(0x1p-60) : T(0x1p-400);
    Index wrong = 0;
    for (Index k = 0; k < kLanes; ++k) {
      const bool fine = (squared[k] >= kSmallest) & (squared[k] <= std::numeric_limits<T>::max());
      wrong |= (k < fan.count) & !fine ? 1u : 0u;
    }
    return wrong == 0;
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

  Corner unfolded_corner(Index e) const {
    const UnfoldedTriangle& t = unfolded_[e / 2];
    const bool at_first = e % 2 == 0;
    const Vec2 own = at_first ? t.at_first : t.at_second, other = at_first ? t.at_second : t.at_first;
    return {t.corner_vertex,   at_first ? t.second : t.first,    norm(own),
            norm(other - own), brushfire::dot(own, own - other), std::abs(brushfire::cross(t.at_first, t.at_second))};
  }

  // Patches are smoothed once, over the other ends of each vertex's halfedges.
  void bend_fronts() {
    rings_.bend.resize(mesh_.vertex_count());
    for (Index i = 0; i < mesh_.vertex_count(); ++i) {
      Patch around = patches_[i];
      const auto add = [&](const Patch& other) { around.deficit += other.deficit, around.area += other.area; };
      if (plain_sides_[i] > 0) {
        const RingBlock<T>& block = rings_.blocks[rings_.layout.block_offset[i]];
        for (Index k = 0; k < plain_sides_[i]; ++k) add(patches_[block.end[k]]);
      } else {
        for (const Index h : mesh_.corners(i)) add(patches_[mesh_.to(h)]);
      }
      rings_.bend[i] = static_cast<T>(front_bend(patches_[i], around));
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
  std::span<const Face> faces_;
  std::span<const Vec3> positions_;
  std::span<const Index> corner_offsets_, corners_;
  double scale_;
  bool may_be_plain_;
  Index none_;  // the end of sides that are not there
  double sum_of_lengths_ = 0;
  Rings<T> rings_;
  std::vector<UnfoldedTriangle> unfolded_;
  std::vector<Index> unsplit_;                    // corners whose unfolding ended early
  std::vector<Index> first_of_, next_of_;         // lists of unfolded triangles by vertex
  UninitializedArray<Patch> patches_;             // [vertex_count]
  UninitializedArray<std::uint8_t> plain_sides_;  // [vertex_count] of a plain fan; 0 for any other vertex
  std::vector<Corner> loose_, fan_;               // of one vertex
};

}  // namespace

template <class T>
Rings<T> build_rings(const Mesh& mesh) {
  return RingBuilder<T>(mesh).build();
}

template Rings<float> build_rings<float>(const Mesh& mesh);
template Rings<double> build_rings<double>(const Mesh& mesh);

}  // namespace brushfire::detail
