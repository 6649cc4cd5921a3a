// Regular one-rings, eight triangles at a time.
namespace brushfire::fast_marching::BRUSHFIRE_TARGET {
using namespace lanes::BRUSHFIRE_TARGET;

// The ends of the sides of corners: of the first side, and of the second one.
struct SideEnds {
  Numbers8 a, b;
};

// Of the corners of halfedges h; `vertices`: of the faces, three each.
BRUSHFIRE_INLINE SideEnds ends_at(const Index* vertices, Numbers8 h) {
  const Numbers8 corner = h - 3 * quotient<3>(h);
  alignas(32) Index next[kLanes], previous[kLanes];
  store(next, select(corner == 2, h - 2, h + 1));
  store(previous, select(corner == 0, h + 2, h - 1));
  return {gather<Numbers8>(vertices, next), gather<Numbers8>(vertices, previous)};
}

template <class T>
class RegularRing {
  using V = Lanes<T, kLanes>;
  using Points = Vector3<V>;

 public:
  // False where the ring is not regular. Stage by stage, for all vertices each, and from one to the next through
  // memory: what compilers keep in registers they take apart lane by lane.
  BRUSHFIRE_INLINE bool find_corners(const RingMesh& mesh, Index v) {
    const Index begin = mesh.corner_offsets[v];
    count_ = mesh.corner_offsets[v + 1] - begin;
    if (count_ > kLanes || count_ < 3 || !mesh.plain) return false;
    corners_ = load_first<Numbers8>(mesh.corners.data() + begin, count_);
    return true;
  }

  // No vertices, and different ones, in lanes that are not used.
  BRUSHFIRE_INLINE void find_ends(const RingMesh& mesh, Index v) {
    const SideEnds ends = ends_at(mesh.vertices(), corners_);
    const auto used = first_lanes<kLanes>(count_);
    a_.set(select(used, ends.a, Numbers8(kNoIndex)));
    b_.set(select(used, ends.b, Numbers8(kNoIndex - 1)));
    store(at_, select(used, ends.a, Numbers8(v)));
  }

  // False where not every side is the first of one corner and the second of another one.
  BRUSHFIRE_INLINE bool find_links(Index v) {
    const Numbers8 a = a_.turned_by(0), b = b_.turned_by(0), lane = lane_numbers<Numbers8>();
    const auto used = first_lanes<kLanes>(count_);
    // Sums of 16 + k over the k-th ones, counted from the own one on, where b is some a, and where a is some b.
    Numbers8 firsts(0), seconds(0);
    for (Index k = 0; k < kLanes; ++k) {
      firsts = firsts + select(b == a_.turned_by(k), Numbers8(16 + k), Numbers8(0));
      seconds = seconds + select(a == b_.turned_by(k), Numbers8(16 + k), Numbers8(0));
    }
    const auto one = ((firsts >> 4) == 1) & ((seconds >> 4) == 1);
    const auto apart = ~((a == v) | (b == v) | (a == b));
    second_ = select(used, (lane + firsts) & 7, lane);
    back_ = select(used, (lane + seconds) & 7, lane);
    return !any(used & ~(one & apart));
  }

  // Counter-clockwise, from the first corner on: each lane's second side is the next one's first. False where that does
  // not come by all of them. For what follows, but not for write().
  BRUSHFIRE_INLINE bool put_in_order() {
    alignas(32) Index second[kLanes], corner[kLanes], end[kLanes], ordered[kLanes] = {};
    store(second, second_);
    store(corner, corners_);
    std::copy_n(at_, kLanes, end);
    Index at = 0;
    for (Index i = 0; i < count_; ++i) {
      ordered[i] = corner[at], at_[i] = end[at];
      at = second[at];
      if (at == 0 && i + 1 < count_) return false;
    }
    corners_ = load<Numbers8>(ordered);
    const Numbers8 next = lane_numbers<Numbers8>() + 1;
    second_ = select(next == count_, Numbers8(0), next);
    return true;
  }

  // Of length 0 in lanes that are not used.
  BRUSHFIRE_INLINE void measure_sides(const RingMesh& mesh, Index v) {
    using Wide = Lanes<double, kLanes>;
    const Vec3 from = mesh.positions[v];
    const auto [x, y, z] = gather_points<Wide>(mesh.coordinates(), at_);
    side_ = {converted<T>(mesh.scale * (x - from.x)), converted<T>(mesh.scale * (y - from.y)),
             converted<T>(mesh.scale * (z - from.z))};
  }

  // False where squares may have vanished. Infinite differences are not in order either.
  BRUSHFIRE_INLINE bool measure() {
    const Permutation<sizeof(T), kLanes> second(second_);
    const Points e = side_, f{permuted(e.x, second), permuted(e.y, second), permuted(e.z, second)}, g = f - e;
    const V aa = dot(e, e), bb = permuted(aa, second), cc = dot(g, g);
    length_ = square_root(aa);
    dot_ = dot(e, f);
    // Of the two shorter edges: rounding of a cross product grows with the product of the lengths.
    const auto third_longest = (aa <= cc) & (bb <= cc), first_before = bb <= aa;  // longest, but for the third
    const Points area = cross(select(third_longest, e, select(first_before, f, e)), select(third_longest, f, g));
    cross_ = square_root(dot(area, area));
    const auto fine = (kSmallestSquare<T> <= aa) & (aa <= V(std::numeric_limits<T>::max()));
    return (bits(first_lanes<kLanes>(count_)) & ~bits(fine)) == 0;
  }

  BRUSHFIRE_INLINE void write(const RingMesh& mesh, RingBlock<T>& block, LaneLinks& links) const {
    const auto used = first_lanes<kLanes>(count_);
    const auto in_use = mask_cast<T>(used);
    store(block.end, select(used, a_.turned_by(0), Numbers8(mesh.none)));
    store(block.length, select(in_use, length_, V(std::numeric_limits<T>::infinity())));
    store(block.dot, select(in_use, dot_, V(std::numeric_limits<T>::quiet_NaN())));
    store(block.cross, cross_);
    store_bytes(links.links, second_ | back_ << 4);
  }

  // By lane. Void in lanes that are not used.
  struct Measures {
    Index count;
    Numbers8 corners;
    V length, next_length, dot, cross;
  };
  BRUSHFIRE_INLINE Measures measures() const {
    return {count_, corners_, length_, permuted(length_, Permutation<sizeof(T), kLanes>(second_)), dot_, cross_};
  }

  // Adds up as number i of the rings.
  BRUSHFIRE_INLINE void sum(Index i, RegularRings<T>& rings) const {
    alignas(64) T angle[kLanes], area[kLanes], length[kLanes];  // 0 in lanes that are not used
    store(angle, quick_angle(dot_, cross_));
    store(area, cross_);
    store(length, length_);
    T angles = 0, areas = 0, lengths = 0;
    for (Index k = 0; k < kLanes; ++k) angles += angle[k], areas += area[k], lengths += length[k];
    rings.angle[i] = angles, rings.area[i] = areas, rings.length[i] = lengths;
    const std::uint32_t obtuse = bits(dot_ < V(0));
    store_packed(rings.obtuse + rings.obtuse_count, obtuse, corners_);
    rings.obtuse_count += static_cast<Index>(std::popcount(obtuse));
  }

 private:
  // Eight numbers, twice: what is loaded from the k-th on are the eight turned by k.
  struct Ring {
    alignas(32) Index item[2 * kLanes];
    BRUSHFIRE_INLINE void set(Numbers8 eight) {
      store(item, eight);
      store(item + kLanes, eight);
    }
    BRUSHFIRE_INLINE Numbers8 turned_by(Index k) const { return load<Numbers8>(item + k); }
  };

  Index count_;
  Numbers8 corners_;              // 0 in lanes that are not used
  Ring a_, b_;                    // the ends of their sides
  alignas(32) Index at_[kLanes];  // a; the vertex itself in lanes that are not used
  Numbers8 second_, back_;        // b is a of lane second; a is b of lane back
  Points side_;                   // from the vertex to a
  V length_, dot_, cross_;
};

// What vertices soon will need: where they are, and the last one of their faces. The others have been needed before.
inline void prefetch_rings_after(const RingMesh& mesh, Index v) {
  constexpr Index kAhead = 3 * kRingsAtOnce;
  if (mesh.none < v + kAhead + kRingsAtOnce) return;
  for (Index i = v + kAhead; i < v + kAhead + kRingsAtOnce; ++i) {
    prefetch(&mesh.positions[i]);
    if (mesh.corner_offsets[i + 1] > 0) prefetch(&mesh.faces[mesh.corners[mesh.corner_offsets[i + 1] - 1] / 3]);
  }
}

// The rings of vertices first .. first + count - 1; count <= kRingsAtOnce. Block i becomes that of vertex first + i.
template <class T>
void fill_regular_rings(const RingMesh& mesh, Index first, Index count, RingBlock<T>* blocks, LaneLinks* links,
                        RegularRings<T>& rings) {
  RegularRing<T> ring[kRingsAtOnce];
  bool(&regular)[kRingsAtOnce] = rings.regular;
  rings.obtuse_count = 0;
  prefetch_rings_after(mesh, first + count);
  for (Index i = 0; i < count; ++i) regular[i] = ring[i].find_corners(mesh, first + i);
  for (Index i = 0; i < count; ++i) {
    if (regular[i]) ring[i].find_ends(mesh, first + i);
  }
  for (Index i = 0; i < count; ++i) {
    if (regular[i]) regular[i] = ring[i].find_links(first + i);
  }
  for (Index i = 0; i < count; ++i) {
    if (regular[i]) ring[i].measure_sides(mesh, first + i);
  }
  for (Index i = 0; i < count; ++i) {
    if (regular[i]) regular[i] = ring[i].measure();
  }
  for (Index i = 0; i < count; ++i) {
    rings.angle[i] = rings.area[i] = rings.length[i] = 0;
    if (!regular[i]) continue;
    ring[i].write(mesh, blocks[i], links[i]);
    ring[i].sum(i, rings);
  }
}

}  // namespace brushfire::fast_marching::BRUSHFIRE_TARGET
