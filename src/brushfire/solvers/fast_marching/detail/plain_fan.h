// The triangles around an ordinary inner vertex, eight at a time: in loops that compilers turn into vector instructions
// as far as these go, or in registers. Both give the same bits.
#pragma once

#include <brushfire/core/detail/planar.h>
#include <brushfire/core/detail/prefetch.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/fast_marching/detail/bend.h>
#include <brushfire/solvers/fast_marching/detail/double8.h>
#include <brushfire/solvers/fast_marching/detail/float8.h>
#include <brushfire/solvers/fast_marching/detail/ring_blocks.h>
#include <brushfire/solvers/fast_marching/detail/vector_target.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>

namespace brushfire::fast_marching {

// What of a mesh it takes. Plain: with positions, and without slits.
struct FanMesh {
  std::span<const Vec3> positions;
  std::span<const Face> faces;
  std::span<const Index> corner_offsets, corners;
  double scale = 1;  // 1 / unit
  Index none = 0;    // the end of sides that are not there
  bool plain = false;
};

// Vertices are taken some at a time: what one of them waits for, another one computes meanwhile.
inline constexpr Index kFans = 16;

// The fans of vertices that follow each other; what is said of a vertex that is not the middle of such a fan is void.
template <class T>
struct PlainFans {
  // Of the triangles, the sums: their angles at the vertex, twice their areas, their first sides. 0 where not plain.
  T angle[kFans], area[kFans], length[kFans];
  bool plain[kFans];
  // The corners whose angle is more than a right one, or seems to be.
  Index obtuse[(kFans + 1) * kLanes];  // whole registers are written
  Index obtuse_count = 0;
};

// Not so small that squares and fourth powers lose their digits.
template <class T>
inline constexpr T kSmallestSquare = std::is_same_v<T, float> ? T(0x1p-60) : T(0x1p-400);

// In loops.
template <class T>
class FanInLoops {
 public:
  // The fans of vertices first .. first + count - 1; count <= kFans. Block i becomes that of vertex first + i.
  BRUSHFIRE_INLINE static void fill(const FanMesh& mesh, Index first, Index count, RingBlock<T>* blocks,
                                    LaneLinks* links, PlainFans<T>& fans) {
    fans.obtuse_count = 0;
    for (Index i = 0; i < count; ++i) {
      fans.angle[i] = fans.area[i] = fans.length[i] = 0;
      fans.plain[i] = fill_one(mesh, first + i, i, blocks[i], links[i], fans);
    }
  }

 private:
  BRUSHFIRE_INLINE static bool fill_one(const FanMesh& mesh, Index v, Index i, RingBlock<T>& block, LaneLinks& links,
                                        PlainFans<T>& fans) {
    Fan fan;
    if (!find(mesh, v, fan)) return false;
    Sides sides;
    measure_sides(mesh, v, fan, sides);
    Geometry g;
    if (!measure(sides, fan, g)) return false;
    constexpr T kNever = std::numeric_limits<T>::infinity(), kNone = std::numeric_limits<T>::quiet_NaN();
    for (Index k = 0; k < kLanes; ++k) {
      const bool used = k < fan.count;
      block.end[k] = used ? fan.a[k] : mesh.none;
      block.length[k] = used ? g.length[k] : kNever;
      block.dot[k] = used ? g.dot[k] : kNone;
      block.cross[k] = g.cross[k];
      links.links[k] = static_cast<std::uint8_t>(fan.second[k] | fan.back[k] << 4);
    }
    for (Index k = 0; k < fan.count; ++k) {
      fans.obtuse[fans.obtuse_count] = mesh.corners[mesh.corner_offsets[v] + k];
      fans.obtuse_count += g.dot[k] < 0 ? 1u : 0u;
    }
    for (Index k = 0; k < kLanes; ++k) {  // 0 in unused lanes
      fans.angle[i] += g.angle[k];
      fans.area[i] += g.cross[k];
      fans.length[i] += g.length[k];
    }
    return true;
  }

  // Corner k lies between the ends a[k] and b[k] of its sides; b[k] is a[second[k]], and a[k] is b[back[k]].
  struct Fan {
    alignas(32) Index a[kLanes];
    alignas(32) Index b[kLanes];
    alignas(32) Index second[kLanes];
    alignas(32) Index back[kLanes];
    Index count = 0;
  };

  // The sides as vectors.
  struct Sides {
    alignas(64) T x[kLanes], y[kLanes], z[kLanes];
  };

  // By lane: lengths, products, angles at the vertex.
  struct Geometry {
    alignas(64) T length[kLanes], dot[kLanes], cross[kLanes], angle[kLanes];
  };

  BRUSHFIRE_INLINE static bool find(const FanMesh& mesh, Index v, Fan& fan) {
    const Index begin = mesh.corner_offsets[v], count = mesh.corner_offsets[v + 1] - begin;
    fan.count = count;
    if (count > kLanes || count < 3 || !mesh.plain) return false;
    for (Index k = 0; k < kLanes; ++k) fan.a[k] = kNoIndex, fan.b[k] = kNoIndex - 1;
    for (Index k = 0; k < count; ++k) {
      const Index h = mesh.corners[begin + k], f = h / 3;
      fan.a[k] = mesh.faces[f][h - 3 * f == 2 ? 0 : h - 3 * f + 1];
      fan.b[k] = mesh.faces[f][h - 3 * f == 0 ? 2 : h - 3 * f - 1];
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

  // Of length 0 in lanes that are not used.
  BRUSHFIRE_INLINE static void measure_sides(const FanMesh& mesh, Index v, const Fan& fan, Sides& sides) {
    const Vec3 at = mesh.positions[v];
    for (Index k = 0; k < kLanes; ++k) {
      const Vec3 side = mesh.scale * (mesh.positions[k < fan.count ? fan.a[k] : v] - at);
      sides.x[k] = static_cast<T>(side.x), sides.y[k] = static_cast<T>(side.y), sides.z[k] = static_cast<T>(side.z);
    }
  }

  // False where squares may have vanished.
  BRUSHFIRE_INLINE static bool measure(const Sides& e, const Fan& fan, Geometry& g) {
    Sides f;
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
    // Infinite differences are not in order either.
    Index wrong = 0;
    for (Index k = 0; k < kLanes; ++k) {
      const bool fine = (squared[k] >= kSmallestSquare<T>)&(squared[k] <= std::numeric_limits<T>::max());
      wrong |= (k < fan.count) & !fine ? 1u : 0u;
    }
    return wrong == 0;
  }
};

#ifdef BRUSHFIRE_HAS_AVX2_VARIANT

// In registers: the same operations in the same order.
template <class T>
class FanInRegisters {
  using V = Lanes<T>;

 public:
  BRUSHFIRE_AVX2 static void fill(const FanMesh& mesh, Index first, Index count, RingBlock<T>* blocks, LaneLinks* links,
                                  PlainFans<T>& fans) {
    // Stage by stage, and from one to the next through memory: what compilers keep in registers they take apart lane
    // by lane.
    Work work[kFans];
    fans.obtuse_count = 0;
    prefetch_after(mesh, first + count);
    for (Index i = 0; i < count; ++i) fans.plain[i] = find_faces(mesh, first + i, work[i]);
    for (Index i = 0; i < count; ++i) {
      if (fans.plain[i]) find_ends(mesh, first + i, work[i]);
    }
    for (Index i = 0; i < count; ++i) {
      if (fans.plain[i]) fans.plain[i] = find_links(first + i, work[i]);
    }
    for (Index i = 0; i < count; ++i) {
      if (fans.plain[i]) measure_sides(mesh, first + i, work[i]);
    }
    for (Index i = 0; i < count; ++i) {
      if (fans.plain[i]) fans.plain[i] = measure(work[i]);
    }
    for (Index i = 0; i < count; ++i) {
      if (fans.plain[i]) {
        finish(mesh, work[i], blocks[i], links[i]);
        sum(mesh, first + i, work[i], i, fans);
      } else {
        fans.angle[i] = fans.area[i] = fans.length[i] = 0;
      }
    }
  }

 private:
  // Eight numbers, twice: what is loaded from the k-th on are the eight turned by k.
  struct Ring {
    alignas(32) Index item[2 * kLanes];
    BRUSHFIRE_AVX2_INLINE void set(__m256i eight) {
      _mm256_store_si256(reinterpret_cast<__m256i*>(item), eight);
      _mm256_store_si256(reinterpret_cast<__m256i*>(item + kLanes), eight);
    }
    BRUSHFIRE_AVX2_INLINE __m256i turned_by(Index k) const {
      return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(item + k));
    }
  };

  // What is known of one fan in between. Corner k lies between the ends a and b of its sides.
  struct Work {
    alignas(32) Index first[kLanes];    // the first number of the corner's face
    alignas(32) Index shuffle[kLanes];  // where the shuffle of the corner's number begins
    alignas(32) Index at[kLanes];       // a; the vertex itself in lanes that are not used
    Ring a, b;
    Index count;
    __m256i second, back;
    V x, y, z, length, dot, cross;
  };

  BRUSHFIRE_AVX2_INLINE static __m256i used_lanes(Index count) {
    const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    return _mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(count)), lane);
  }

  // What vertices soon will need: where they are, and the last one of their faces. The others have been needed before.
  BRUSHFIRE_AVX2_INLINE static void prefetch_after(const FanMesh& mesh, Index v) {
    constexpr Index kAhead = 3 * kFans;
    if (mesh.none < v + kAhead + kFans) return;
    for (Index i = v + kAhead; i < v + kAhead + kFans; ++i) {
      prefetch(&mesh.positions[i]);
      if (mesh.corner_offsets[i + 1] > 0) prefetch(&mesh.faces[mesh.corners[mesh.corner_offsets[i + 1] - 1] / 3]);
    }
  }

  BRUSHFIRE_AVX2_INLINE static bool find_faces(const FanMesh& mesh, Index v, Work& work) {
    const Index begin = mesh.corner_offsets[v], count = mesh.corner_offsets[v + 1] - begin;
    if (count > kLanes || count < 3 || !mesh.plain) return false;
    work.count = count;
    const auto* const corners = reinterpret_cast<const int*>(mesh.corners.data() + begin);
    const __m256i h = _mm256_maskload_epi32(corners, used_lanes(count));
    // h / 3, of the even lanes and of the odd ones.
    const __m256i inverse = _mm256_set1_epi64x(0xaaaaaaab);
    const __m256i even = _mm256_srli_epi64(_mm256_mul_epu32(h, inverse), 33);
    const __m256i odd = _mm256_srli_epi64(_mm256_mul_epu32(_mm256_srli_epi64(h, 32), inverse), 33);
    const __m256i face = _mm256_or_si256(even, _mm256_slli_epi64(odd, 32));
    const __m256i first = _mm256_add_epi32(face, _mm256_slli_epi32(face, 1));
    _mm256_store_si256(reinterpret_cast<__m256i*>(work.first), first);
    const __m256i corner = _mm256_sub_epi32(h, first);
    _mm256_store_si256(reinterpret_cast<__m256i*>(work.shuffle), _mm256_slli_epi32(corner, 4));
    return true;
  }

  BRUSHFIRE_AVX2_INLINE static void finish(const FanMesh& mesh, const Work& work, RingBlock<T>& block,
                                           LaneLinks& links) {
    const __m256i used = used_lanes(work.count), none = _mm256_set1_epi32(static_cast<int>(mesh.none));
    const __m256i a = work.a.turned_by(0);
    const V in_use = wide_mask(V{}, used);
    _mm256_store_si256(reinterpret_cast<__m256i*>(block.end), _mm256_blendv_epi8(none, a, used));
    store(block.length, select(in_use, work.length, all(std::numeric_limits<T>::infinity())));
    store(block.dot, select(in_use, work.dot, all(std::numeric_limits<T>::quiet_NaN())));
    store(block.cross, work.cross);
    store_links(work.second, work.back, links);
  }

  BRUSHFIRE_AVX2_INLINE static void sum(const FanMesh& mesh, Index v, const Work& work, Index i, PlainFans<T>& fans) {
    const std::array<T, 4> sums = sums_of(angle_of(work.dot, work.cross), work.cross, work.length);
    fans.angle[i] = sums[0], fans.area[i] = sums[1], fans.length[i] = sums[2];
    const std::uint32_t obtuse = bits(work.dot < all(T(0)));  // 0 in lanes that are not used
    const auto* const corners = reinterpret_cast<const int*>(mesh.corners.data() + mesh.corner_offsets[v]);
    const __m256i h = _mm256_maskload_epi32(corners, used_lanes(work.count));
    auto* const to = reinterpret_cast<__m256i*>(fans.obtuse + fans.obtuse_count);
    _mm256_storeu_si256(to, _mm256_permutevar8x32_epi32(h, packing(obtuse)));
    fans.obtuse_count += static_cast<Index>(std::popcount(obtuse));
  }

  // The two other corners of a face, from each of its corners on: where their bytes are.
  alignas(16) static constexpr std::array<std::uint8_t, 48> kOthers{
      4, 5, 6,  7,  8, 9, 10, 11, 0, 0, 0, 0, 0, 0, 0, 0,  //
      8, 9, 10, 11, 0, 1, 2,  3,  0, 0, 0, 0, 0, 0, 0, 0,  //
      0, 1, 2,  3,  4, 5, 6,  7};

  // No vertices, and different ones, in lanes that are not used.
  BRUSHFIRE_AVX2_INLINE static void find_ends(const FanMesh& mesh, Index v, Work& work) {
    const auto* const flat = reinterpret_cast<const int*>(mesh.faces.data());
    const __m128i three = _mm_setr_epi32(-1, -1, -1, 0);
    __m128i pair[kLanes];
    for (Index k = 0; k < kLanes; ++k) {
      const auto* const others = reinterpret_cast<const __m128i*>(kOthers.data() + work.shuffle[k]);
      pair[k] = _mm_shuffle_epi8(_mm_maskload_epi32(flat + work.first[k], three), _mm_load_si128(others));
    }
    const __m128i a01 = _mm_unpacklo_epi32(pair[0], pair[1]), a23 = _mm_unpacklo_epi32(pair[2], pair[3]);
    const __m128i a45 = _mm_unpacklo_epi32(pair[4], pair[5]), a67 = _mm_unpacklo_epi32(pair[6], pair[7]);
    const __m256i a = _mm256_set_m128i(_mm_unpacklo_epi64(a45, a67), _mm_unpacklo_epi64(a01, a23));
    const __m256i b = _mm256_set_m128i(_mm_unpackhi_epi64(a45, a67), _mm_unpackhi_epi64(a01, a23));
    const __m256i no_index = _mm256_set1_epi32(-1), neither = _mm256_set1_epi32(-2), used = used_lanes(work.count);
    work.a.set(_mm256_blendv_epi8(no_index, a, used));
    work.b.set(_mm256_blendv_epi8(neither, b, used));
    const __m256i here = _mm256_set1_epi32(static_cast<int>(v));
    _mm256_store_si256(reinterpret_cast<__m256i*>(work.at), _mm256_blendv_epi8(here, a, used));
  }

  // False where not every side is the first of one corner and the second of another one.
  BRUSHFIRE_AVX2_INLINE static bool find_links(Index v, Work& work) {
    const __m256i a = work.a.turned_by(0), b = work.b.turned_by(0), used = used_lanes(work.count);
    // Sets of lanes, a bit for each, counted from the own one on: where b is some a, and where a is some b.
    __m256i firsts = _mm256_setzero_si256(), seconds = firsts;
    for (Index k = 0; k < kLanes; ++k) {
      const __m256i bit = _mm256_set1_epi32(1 << k);
      firsts = _mm256_or_si256(firsts, _mm256_and_si256(_mm256_cmpeq_epi32(b, work.a.turned_by(k)), bit));
      seconds = _mm256_or_si256(seconds, _mm256_and_si256(_mm256_cmpeq_epi32(a, work.b.turned_by(k)), bit));
    }
    const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), at = _mm256_set1_epi32(static_cast<int>(v));
    __m256i wrong = _mm256_or_si256(_mm256_cmpeq_epi32(a, at), _mm256_cmpeq_epi32(b, at));
    wrong = _mm256_or_si256(wrong, _mm256_cmpeq_epi32(a, b));
    wrong = _mm256_or_si256(wrong, _mm256_or_si256(not_one(firsts), not_one(seconds)));
    const __m256i seven = _mm256_set1_epi32(7);
    const __m256i second = _mm256_and_si256(_mm256_add_epi32(lane, number_of(firsts)), seven);
    const __m256i back = _mm256_and_si256(_mm256_add_epi32(lane, number_of(seconds)), seven);
    work.second = _mm256_blendv_epi8(lane, second, used);
    work.back = _mm256_blendv_epi8(lane, back, used);
    return _mm256_testz_si256(wrong, used) != 0;
  }

  // Whether a set has no, or more than one member.
  BRUSHFIRE_AVX2_INLINE static __m256i not_one(__m256i set) {
    const __m256i zero = _mm256_setzero_si256(), less = _mm256_add_epi32(set, _mm256_set1_epi32(-1));
    const __m256i is_one = _mm256_cmpeq_epi32(_mm256_and_si256(set, less), zero);
    return _mm256_or_si256(_mm256_cmpeq_epi32(set, zero), _mm256_xor_si256(is_one, _mm256_set1_epi32(-1)));
  }

  // Of the one member: the exponent.
  BRUSHFIRE_AVX2_INLINE static __m256i number_of(__m256i set) {
    const __m256i exponent = _mm256_srli_epi32(_mm256_castps_si256(_mm256_cvtepi32_ps(set)), 23);
    return _mm256_sub_epi32(exponent, _mm256_set1_epi32(127));
  }

  BRUSHFIRE_AVX2_INLINE static void measure_sides(const FanMesh& mesh, Index v, Work& work) {
    const __m256i three = _mm256_setr_epi64x(-1, -1, -1, 0);
    const auto* positions = reinterpret_cast<const double*>(mesh.positions.data());
    const __m256d at = _mm256_maskload_pd(positions + 3 * std::size_t{v}, three), scale = _mm256_set1_pd(mesh.scale);
    __m256d side[kLanes];
    for (Index k = 0; k < kLanes; ++k) {
      const __m256d end = _mm256_maskload_pd(positions + 3 * std::size_t{work.at[k]}, three);
      side[k] = _mm256_mul_pd(scale, _mm256_sub_pd(end, at));
    }
    transpose(side, work.x, work.y, work.z);
  }

  // False where squares may have vanished.
  BRUSHFIRE_AVX2_INLINE static bool measure(Work& work) {
    const V x = work.x, y = work.y, z = work.z, squared = x * x + y * y + z * z;
    const auto second = index_for(V{}, work.second);
    const V fx = permuted(x, second), fy = permuted(y, second), fz = permuted(z, second);
    const V gx = fx - x, gy = fy - y, gz = fz - z;
    const V aa = squared, bb = permuted(squared, second), cc = gx * gx + gy * gy + gz * gz;
    work.length = square_root(aa);
    work.dot = x * fx + y * fy + z * fz;
    const V third_longest = (aa <= cc) & (bb <= cc), first_before = bb <= aa;  // longest, but for the third
    const V ux = select(third_longest, x, select(first_before, fx, x)), wx = select(third_longest, fx, gx);
    const V uy = select(third_longest, y, select(first_before, fy, y)), wy = select(third_longest, fy, gy);
    const V uz = select(third_longest, z, select(first_before, fz, z)), wz = select(third_longest, fz, gz);
    const V cx = uy * wz - uz * wy, cy = uz * wx - ux * wz, cz = ux * wy - uy * wx;
    work.cross = square_root(cx * cx + cy * cy + cz * cz);
    const V fine = (all(kSmallestSquare<T>) <= squared) & (squared <= all(std::numeric_limits<T>::max()));
    return (bits(wide_mask(V{}, used_lanes(work.count))) & ~bits(fine)) == 0;
  }

  // quick_angle().
  BRUSHFIRE_AVX2_INLINE static V angle_of(V x, V y) {
    const V ax = magnitude(x), zero = all(T(0)), one = all(T(1));
    const V larger = greater(ax, y), smaller = lesser(y, ax);
    const V t = smaller / select(zero < larger, larger, one), u = t * t;
    V p = all(static_cast<T>(kAngleSeries.front()));
    for (std::size_t i = 1; i < kAngleSeries.size(); ++i) p = p * u + all(static_cast<T>(kAngleSeries[i]));
    const V octant = p * t;
    const V quadrant = select(ax < y, all(T(0.5 * kPi)) - octant, octant);
    return select(x < zero, all(T(kPi)) - quadrant, quadrant);
  }

  BRUSHFIRE_AVX2_INLINE static void store_links(__m256i second, __m256i back, LaneLinks& links) {
    const __m256i both = _mm256_or_si256(second, _mm256_slli_epi32(back, 4));
    const __m128i words = _mm_packus_epi32(_mm256_castsi256_si128(both), _mm256_extracti128_si256(both, 1));
    _mm_storel_epi64(reinterpret_cast<__m128i*>(links.links), _mm_packus_epi16(words, words));
  }
};

#endif

}  // namespace brushfire::fast_marching
