// Measures rings, and lays out the vertices that have none.
#include <brushfire/solvers/carried_source/detail/sides.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/prefault.h>
#include <brushfire/core/detail/sort.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

namespace brushfire::carried_source {
namespace {

constexpr double kTurnRounding = 1e-9;   // of angles, by far
constexpr double kQuickRounding = 1e-6;  // of quick ones
constexpr float kLeastSum = 1e-2f;       // of a ring's angles: directions are turned by it until they lie within

// Whether the angles of a ring sum to more than a full turn: where they seem to sum to one, their vector tells.
bool bends(const Ring& ring) {
  constexpr float kNear = 1e-3f, kTurn = static_cast<float>(2 * kPi);
  const float sum = ring.angle[ring.count];
  return std::abs(sum - kTurn) > kNear ? sum > kTurn : ring.s[ring.count] > kTurnRounding;
}

}  // namespace

template <class T>
Sides<T>::Sides(const Mesh& mesh)
    : mesh_(mesh),
      sides_(mesh.halfedge_count()),
      around_(mesh.vertex_count()),
      sums_(mesh.vertex_count()),
      alone_of_(mesh.vertex_count(), kNoIndex),
      fans_(mesh) {
  prefault(sides_);
  const RingMesh shape{mesh.positions(), mesh.faces(),        mesh.corner_offsets(), mesh.all_corners(),
                       1 / mesh.unit(),  mesh.vertex_count(), mesh.has_positions()};
  Ring rings[kRingsAtOnce];
  Poll poll{256};
  for (Index first = 0; first < shape.none; first += kRingsAtOnce) {
    poll();
    const Index count = std::min(kRingsAtOnce, shape.none - first);
    BRUSHFIRE_ON_TARGET(Variant::Best, measure_rings(shape, first, count, rings));
    for (Index i = 0; i < count; ++i) {
      if (rings[i].is_regular && rings[i].angle[rings[i].count] > kLeastSum && !is_slit(rings[i])) {
        take(first + i, rings[i]);
      } else {
        lay_out_alone(first + i);
      }
    }
  }
  // Their order is that of unrolled sides, which decides ties.
  detail::sort(obtuse_.begin(), obtuse_.end(),
               [](const ObtuseCorner& a, const ObtuseCorner& b) { return a.corner < b.corner; });
}

// Whether one of the ring's edges is a slit.
template <class T>
bool Sides<T>::is_slit(const Ring& ring) const {
  if (!mesh_.has_slits()) return false;
  Index before = ring.corner[ring.count - 1];
  for (Index i = 0; i < ring.count; ++i) {
    if (mesh_.opposite(ring.corner[i]) != Mesh::previous(before)) return true;
    before = ring.corner[i];
  }
  return false;
}

template <class T>
void Sides<T>::take(Index v, const Ring& ring) {
  const bool is_bending = bends(ring);
  for (Index i = 0; i < ring.count; ++i) {
    RingSide<T>& side = sides_[ring.corner[i]];
    side.c = static_cast<T>(ring.c[i]), side.s = static_cast<T>(ring.s[i]);
    side.length = static_cast<T>(ring.length[i]);
    sum_of_lengths_ += ring.length[i];
    side.angle = ring.angle[i];
    side.sets = ring.sets[i];
    side.number = static_cast<std::uint8_t>(i), side.count = static_cast<std::uint8_t>(ring.count);
    side.bends = is_bending, side.is_alone = false, side.is_split = false;
  }
  around_[v] = {static_cast<T>(ring.c[ring.count]), static_cast<T>(ring.s[ring.count])};
  sums_[v] = ring.angle[ring.count];
  for (std::uint32_t set = ring.obtuse; set != 0; set &= set - 1) {
    const auto i = static_cast<Index>(std::countr_zero(set));
    const Index behind = Mesh::previous(ring.corner[i == 0 ? ring.count - 1 : i - 1]);
    obtuse_.push_back({Mesh::previous(ring.corner[i]), behind});
  }
}

template <class T>
void Sides<T>::lay_out_alone(Index v) {
  alone_of_[v] = static_cast<Index>(alone_.size());
  alone_.emplace_back(mesh_, v, fans_.at(v), lenses_);
  const Fans& fans = alone_.back().fans();
  const std::span<const Sector> sectors = fans.sectors();
  const double around = sectors.empty() || fans.is_odd() ? kInfinity : sectors.front().around;
  if (around < kInfinity) around_[v] = {static_cast<T>(std::cos(around)), static_cast<T>(std::sin(around))};
  for (const Index h : mesh_.corners(v)) {
    RingSide<T>& side = sides_[h];
    side = {};
    side.is_alone = true;
    side.bends = fans.bends_light();
    sum_of_lengths_ += mesh_.length(h);
    const Index f = Mesh::face_of(h);
    if (!mesh_.is_face_usable(f)) continue;
    // The corner at the end of the second side.
    const Mesh::FaceGeometry face = mesh_.face_geometry(f);
    const Index k = h % 3;
    const double across = face.lengths[k], a = face.lengths[(k + 1) % 3], b = face.lengths[(k + 2) % 3];
    if (!(a > 0 && b > 0 && a * a + b * b < across * across * (1 - kRightAngle))) continue;
    const Index g = mesh_.neighbour(h);
    obtuse_.push_back({Mesh::previous(h), g == h ? kNoIndex : g});
  }
}

template <class T>
bool Sides<T>::bends_light(Index v) const {
  const std::span<const Index> corners = mesh_.corners(v);
  return !corners.empty() && sides_[corners.front()].bends;
}

template <class T>
bool Sides<T>::is_seam(Index corner, bool own) const {
  const RingSide<T>& side = sides_[corner];
  if (!side.is_alone) return !own && side.next() == 0;
  const Fans& fans = alone(mesh_.from(corner)).fans();
  return fans.is_seam(fans.direction(corner, own));
}

template <class T>
Optic Sides<T>::optic(Index corner, bool own) const {
  if (sides_[corner].is_alone) {
    const VertexOptics& optics = alone(mesh_.from(corner));
    return optics.side(optics.fans().side(corner, own));
  }
  const RingSide<T>& named = sides_[corner];
  const RingSide<T>& side = own ? named : sides_[ring_corner(mesh_.from(corner), named.next())];
  Optic o;
  o.angle = static_cast<double>(side.angle), o.c = static_cast<double>(side.c), o.s = static_cast<double>(side.s);
  o.sector = side.number;
  o.sets = side.sets;
  return o;
}

template <class T>
Heading Sides<T>::first_side(Index corner) const {
  const RingSide<T>& side = sides_[corner];
  if (!side.is_alone) {
    return {{static_cast<double>(side.c), static_cast<double>(side.s)}, static_cast<double>(side.angle), 0};
  }
  const FanCorner& c = alone(mesh_.from(corner)).fans().corner(corner);
  return {{std::cos(c.low), std::sin(c.low)}, c.low, c.fan};
}

template <class T>
Optic Sides<T>::optic(Index v, const Heading& heading) {
  if (is_alone(v)) {
    const VertexOptics& optics = alone(v);
    return optics.in_direction(within(optics.fans().sectors(), heading.fan, heading.angle), lenses_);
  }
  alignas(32) float angle[2 * kLanes];
  std::fill_n(angle, 2 * kLanes, std::numeric_limits<float>::infinity());
  const std::span<const Index> corners = mesh_.corners(v);
  const auto count = static_cast<Index>(corners.size());
  for (const Index h : corners) angle[sides_[h].number] = sides_[h].angle;
  const float sum = sums_[v];
  angle[count] = sum;
  // As within(), with the vector, too.
  double turns = 0, rest = heading.angle;
  for (; rest < -kQuickRounding; --turns) rest += static_cast<double>(sum);
  for (; rest > static_cast<double>(sum) - kQuickRounding; ++turns) rest -= static_cast<double>(sum);
  const auto at = static_cast<float>(std::max(0.0, rest));
  Optic o;
  o.angle = static_cast<double>(at);
  o.sector = portable::sector_at(at, angle, count);
  o.sets = portable::sets_inside(o.sector, at, angle, count);
  o.c = heading.unit.x, o.s = heading.unit.y;
  const double c = static_cast<double>(around_[v].c), s = static_cast<double>(around_[v].s);
  for (double k = 0; k < std::abs(turns); ++k) {
    const double sine = turns > 0 ? -s : s, x = o.c;
    o.c = x * c - o.s * sine, o.s = x * sine + o.s * c;
  }
  return o;
}

template class Sides<float>;
template class Sides<double>;

}  // namespace brushfire::carried_source
