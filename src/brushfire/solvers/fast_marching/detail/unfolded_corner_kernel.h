// Finds the faces behind obtuse corners, and unfolds four corners at a time.
namespace brushfire::fast_marching::BRUSHFIRE_TARGET {
using namespace lanes::BRUSHFIRE_TARGET;

// What FacePairs needs of a mesh.
struct FacePairMesh {
  const Mesh& mesh;
  const Unfolder& unfolder;
  std::span<const Face> faces;
  std::span<const Index> corner_offsets, corners;

  explicit FacePairMesh(const Mesh& m, const Unfolder& u)
      : mesh(m), unfolder(u), faces(m.faces()), corner_offsets(m.corner_offsets()), corners(m.all_corners()) {}

  // Of the edge across from the corner of halfedge h.
  BRUSHFIRE_INLINE Index first_end(Index h) const {
    const Index f = h / 3, k = h - 3 * f;
    return faces[f][k == 2 ? 0 : k + 1];
  }
  // Those at a vertex, which may be in two cache lines.
  BRUSHFIRE_INLINE void prefetch_corners(Index v) const {
    prefetch(&corners[corner_offsets[v]]);
    prefetch(&corners[corner_offsets[v + 1] - 1]);
  }
};

// The face pair of the corner of halfedge h, looked up among up to eight faces at one end of the edge across. False
// where that does not tell.
BRUSHFIRE_INLINE bool find_quickly(const FacePairMesh& mesh, Index h, FacePair& pair) {
  const Index own = h / 3, k = h - 3 * own;
  const Face& t = mesh.faces[own];
  const Index corner = t[k], end0 = t[k == 2 ? 0 : k + 1], end1 = t[k == 0 ? 2 : k - 1];
  const Index begin = mesh.corner_offsets[end0], count = mesh.corner_offsets[end0 + 1] - begin;
  if (count > kLanes) return false;
  const Numbers8 corners = load_first<Numbers8>(mesh.corners.data() + begin, count);
  const auto [a, b] = ends_at(reinterpret_cast<const Index*>(mesh.faces.data()), corners);
  const auto others = first_lanes<kLanes>(count) & ((a == end1) | (b == end1)) & ~(quotient<3>(corners) == own);
  const std::uint32_t set = bits(others);
  if (std::popcount(set) != 1) return false;
  alignas(32) Index behind[kLanes];
  store(behind, a + b - end1);
  pair = {{end0, end1}, corner, behind[std::countr_zero(set)]};
  return pair.behind != corner && pair.behind != end0 && pair.behind != end1;
}

// pair[i]: of the corner of obtuse[i].
inline void find_face_pairs(const Mesh& of, const Unfolder& unfolder, std::span<const Index> obtuse, FacePair* pair) {
  constexpr std::size_t kSoon = 16, kLater = 32;
  const FacePairMesh mesh(of, unfolder);
  for (std::size_t i = 0; i < obtuse.size() + kLater; ++i) {
    if (i < obtuse.size()) prefetch(&mesh.corner_offsets[mesh.first_end(obtuse[i])]);
    if (i >= kSoon && i - kSoon < obtuse.size()) mesh.prefetch_corners(mesh.first_end(obtuse[i - kSoon]));
    if (i < kLater) continue;
    const Index h = obtuse[i - kLater];
    if (!find_quickly(mesh, h, pair[i - kLater])) pair[i - kLater] = face_pair(of, unfolder, h);
  }
}

BRUSHFIRE_INLINE Mask<8, kCorners> fine_squares(Lanes<double, kCorners> square) {
  return (kLeastSquare <= square) & (square <= kMostSquare);
}

// Unfolds the faces behind into the planes of their corners. What is said of corners that are not split is void.
template <class T>
CornerSets unfold_corners(std::span<const Vec3> positions, double scale, const FacePair* pair,
                          UnfoldedCorners<T>& unfolded) {
  using V = Lanes<double, kCorners>;
  using Points = Vector3<V>;
  Index at[4][kCorners];
  for (Index k = 0; k < kCorners; ++k) {
    at[0][k] = pair[k].corner, at[1][k] = pair[k].behind, at[2][k] = pair[k].end[0], at[3][k] = pair[k].end[1];
  }
  const auto* const from = reinterpret_cast<const double*>(positions.data());
  const Points at_corner = gather_points<V>(from, at[0]), at_behind = gather_points<V>(from, at[1]);
  const Points at0 = gather_points<V>(from, at[2]), at1 = gather_points<V>(from, at[3]);
  const V scales(scale);
  const Points corner0 = scales * (at_corner - at0), corner1 = scales * (at_corner - at1);
  const Points behind0 = scales * (at_behind - at0), behind1 = scales * (at_behind - at1);
  const Points edge = scales * (at1 - at0), over = scales * (at_corner - at_behind);
  const V cc0 = dot(corner0, corner0), cc1 = dot(corner1, corner1);
  const V bb0 = dot(behind0, behind0), bb1 = dot(behind1, behind1), ee = dot(edge, edge);
  // In the plane, in the frame of the edge and times its length: along it from either end, and away from it. Areas from
  // the two shorter edges, as rounding of a cross product grows with the product of the lengths.
  const V c0 = dot(corner0, edge), c1 = -dot(corner1, edge);
  const V b0 = dot(behind0, edge), b1 = -dot(behind1, edge), along = dot(over, edge);
  const auto edge_longest = (bb0 <= ee) & (bb1 <= ee), first_shorter = bb0 <= bb1;
  const Points u = select(edge_longest | first_shorter, behind0, behind1), w = select(edge_longest, behind1, edge);
  const Points corner_area = cross(corner0, corner1), behind_area = cross(u, w);
  const V cy = square_root(dot(corner_area, corner_area)), by = square_root(dot(behind_area, behind_area));
  const V away = cy + by, inverse = 1 / ee;
  const V cross0 = (c0 * by + cy * b0) * inverse, cross1 = (c1 * by + cy * b1) * inverse;
  const auto acute = (V(0) < c0 * along + cy * away) & (V(0) < cy * away - c1 * along);
  const auto within = (V(0) < cross0) & (V(0) < cross1);
  auto& [side0, side1] = unfolded.side;
  store(side0.length, converted<T>(square_root(cc0)));
  store(side1.length, converted<T>(square_root(cc1)));
  store(side0.between, converted<T>(square_root(bb0)));
  store(side1.between, converted<T>(square_root(bb1)));
  store(side0.dot_end, converted<T>((c0 * b0 - cy * by) * inverse));
  store(side1.dot_end, converted<T>((c1 * b1 - cy * by) * inverse));
  store(side0.dot_behind, converted<T>((by * away - b0 * along) * inverse));
  store(side1.dot_behind, converted<T>((by * away + b1 * along) * inverse));
  store(side0.cross, converted<T>(cross0));
  store(side1.cross, converted<T>(cross1));
  store(unfolded.length, converted<T>(square_root((along * along + away * away) * inverse)));
  const auto good =
      acute & within & fine_squares(cc0) & fine_squares(cc1) & fine_squares(bb0) & fine_squares(bb1) & fine_squares(ee);
  const auto obtuse = cc0 + cc1 < ee * (1 - kRightAngle);
  return {bits(obtuse), bits(obtuse & good)};
}

}  // namespace brushfire::fast_marching::BRUSHFIRE_TARGET
