// Hilbert order by radix sort; breadth-first order for meshes without positions.
//
// Based on: Hamilton, Rau-Chaplin, "Compact Hilbert Indices", 2008 (the curve as a machine of 24 states).
#include <brushfire/mesh/detail/locality_order.h>

#include <brushfire/core/detail/prefault.h>
#include <brushfire/core/detail/uninitialized.h>
#include <brushfire/mesh/detail/hilbert.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

namespace brushfire {
namespace {

using detail::kHilbertBits;

// The curve through a cube visits its eight octants in the order of a Gray code that is reflected by `entry` and turned
// by `direction`, and every octant is such a cube again. One step: the octant (a bit per axis) to its place in the
// order, and to the state inside it.
struct Step {
  std::uint8_t place;
  std::uint8_t next_state;
};

constexpr unsigned rotate_right(unsigned bits, unsigned by) { return ((bits >> by) | (bits << (3 - by))) & 7; }
constexpr unsigned rotate_left(unsigned bits, unsigned by) { return rotate_right(bits, (3 - by) % 3); }

constexpr Step step_of(unsigned entry, unsigned direction, unsigned octant) {
  const unsigned turn = (direction + 1) % 3;
  const unsigned gray = rotate_right(octant ^ entry, turn);
  const unsigned place = gray ^ (gray >> 1) ^ (gray >> 2);
  // Where the curve enters the octant at this place, and along which axis it leaves.
  const unsigned even = place == 0 ? 0 : (place - 1) & ~1u;
  const unsigned inner_entry = even ^ (even >> 1);
  const unsigned odd = place == 0 ? 0 : place % 2 == 0 ? place - 1 : place;
  const unsigned inner_direction = place == 0 ? 0 : static_cast<unsigned>(std::countr_one(odd)) % 3;
  const unsigned next_entry = entry ^ rotate_left(inner_entry, turn);
  const unsigned next_direction = (direction + inner_direction + 1) % 3;
  return {static_cast<std::uint8_t>(place), static_cast<std::uint8_t>(next_entry * 3 + next_direction)};
}

constexpr std::array<Step, 24 * 8> kSteps = [] {
  std::array<Step, 24 * 8> steps{};
  for (unsigned entry = 0; entry < 8; ++entry) {
    for (unsigned direction = 0; direction < 3; ++direction) {
      for (unsigned octant = 0; octant < 8; ++octant) {
        steps[(entry * 3 + direction) * 8 + octant] = step_of(entry, direction, octant);
      }
    }
  }
  return steps;
}();

// Two steps at once, from two octants to two places.
struct TwoSteps {
  std::uint8_t places;
  std::uint8_t next_state;
};

constexpr std::array<TwoSteps, 24 * 64> kTwoSteps = [] {
  std::array<TwoSteps, 24 * 64> steps{};
  for (unsigned state = 0; state < 24; ++state) {
    for (unsigned octants = 0; octants < 64; ++octants) {
      const Step first = kSteps[state * 8 + octants / 8];
      const Step second = kSteps[first.next_state * 8u + octants % 8];
      steps[state * 64 + octants] = {static_cast<std::uint8_t>(first.place * 8u + second.place), second.next_state};
    }
  }
  return steps;
}();

// Cells along one axis with their bits three apart.
constexpr std::array<std::uint32_t, 1 << kHilbertBits> kSpread = [] {
  std::array<std::uint32_t, 1 << kHilbertBits> spread{};
  for (std::uint32_t x = 0; x < spread.size(); ++x) {
    for (int bit = 0; bit < kHilbertBits; ++bit) spread[x] |= (x >> bit & 1u) << 3 * bit;
  }
  return spread;
}();

// In a cube of 2^kBits cells a side.
template <int kBits>
std::uint64_t place_on_curve(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  static_assert(kBits % 2 == 0 && kBits <= kHilbertBits);
  const std::uint32_t octants_of_all = kSpread[x] | kSpread[y] << 1 | kSpread[z] << 2;
  std::uint64_t place = 0;
  unsigned state = 0;
  for (int bit = 3 * (kBits - 2); bit >= 0; bit -= 6) {
    const unsigned octants = octants_of_all >> bit & 63u;
    const TwoSteps step = kTwoSteps[state * 64 + octants];
    place = place << 6 | step.places;
    state = step.next_state;
  }
  return place;
}

// A place on the curve and a vertex there, as one number that sorts by the place.
using Keyed = std::uint64_t;

// How the places are sorted: by digits.
struct Digits {
  int cube_bits;       // cells along one axis: two to this
  int count, of_bits;  // of a place
};
constexpr Digits kFine{kHilbertBits, 3, 10}, kCoarse{8, 2, 12};
static_assert(kFine.count * kFine.of_bits == 3 * kFine.cube_bits && 3 * kFine.cube_bits <= 32);
static_assert(kCoarse.count * kCoarse.of_bits == 3 * kCoarse.cube_bits);

// The vertices by their keys, equal ones in the order given. `items` is used up.
template <Digits kDigits>
VertexOrder radix_sorted(UninitializedArray<Keyed>& items) {
  constexpr int kCount = kDigits.count, kBits = kDigits.of_bits;
  const auto digit = [](Keyed k, int i) {
    return static_cast<std::size_t>((k >> (32 + i * kBits)) & ((1 << kBits) - 1));
  };
  std::array<std::array<Index, 1 << kBits>, kCount> start{};
  for (const Keyed k : items) {
    for (int i = 0; i < kCount; ++i) ++start[static_cast<std::size_t>(i)][digit(k, i)];
  }
  UninitializedArray<Keyed> other(items.size());
  prefault(other);
  VertexOrder order;
  order.vertices.resize(items.size());
  order.vertex_rank.resize(items.size());
  prefault(order.vertices);
  prefault(order.vertex_rank);
  for (int i = 0; i < kCount; ++i) {
    auto& place = start[static_cast<std::size_t>(i)];
    Index sum = 0;
    for (Index& s : place) sum += std::exchange(s, sum);
    if (i + 1 < kCount) {
      for (const Keyed k : items) other[place[digit(k, i)]++] = k;
      items.swap(other);
    } else {
      for (const Keyed k : items) {
        const Index v = static_cast<Index>(k), at = place[digit(k, i)]++;
        order.vertices[at] = v;
        order.vertex_rank[v] = at;
      }
    }
  }
  return order;
}

template <Digits kDigits>
VertexOrder hilbert_order(std::span<const Vec3> positions, const Box& bounds) {
  const auto [low, high] = bounds;
  // Halves, so that the extent of coordinates near the largest double stays finite.
  const Vec3 half = 0.5 * high - 0.5 * low;
  const double extent = std::max({half.x, half.y, half.z});
  constexpr double kCells = (1 << kDigits.cube_bits) - 1;
  // First to the unit cube, as the inverse of a tiny extent may be infinite.
  const double unit = extent > 0 ? std::clamp(std::ldexp(1.0, std::ilogb(extent)), 0x1p-1000, 0x1p1000) : 1.0;
  const double up = 1 / unit, cells = extent > 0 ? kCells / (extent * up) : 0;
  const auto cell = [=](double x, double lowest) {
    return static_cast<std::uint32_t>(std::min((0.5 * x - 0.5 * lowest) * up * cells, kCells));
  };
  UninitializedArray<Keyed> items(positions.size());
  prefault(items);
  for (Index v = 0; v < items.size(); ++v) {
    const Vec3 p = positions[v];
    const auto place = place_on_curve<kDigits.cube_bits>(cell(p.x, low.x), cell(p.y, low.y), cell(p.z, low.z));
    items[v] = place << 32 | v;
  }
  return radix_sorted<kDigits>(items);
}

// Fewer cells than vertices are no harm as long as they stay few in a cell.
VertexOrder hilbert_order(std::span<const Vec3> positions, const Box& bounds) {
  constexpr std::size_t kFew = std::size_t{1} << 17;
  return positions.size() < kFew ? hilbert_order<kCoarse>(positions, bounds) : hilbert_order<kFine>(positions, bounds);
}

VertexOrder breadth_first_order(const Mesh& mesh) {
  VertexOrder result;
  UninitializedArray<Index>& order = result.vertices;
  order.reserve(mesh.vertex_count());
  result.vertex_rank.assign(mesh.vertex_count(), kNoIndex);
  const auto visit = [&](Index v) {
    if (result.vertex_rank[v] != kNoIndex) return;
    result.vertex_rank[v] = static_cast<Index>(order.size());
    order.push_back(v);
  };
  std::size_t next = 0;
  for (Index first = 0; first < mesh.vertex_count(); ++first) {
    visit(first);
    for (; next < order.size(); ++next) {
      for (const Index h : mesh.corners(order[next])) {
        visit(mesh.to(h));
        visit(mesh.from(Mesh::previous(h)));
      }
    }
  }
  return result;
}

}  // namespace

std::uint64_t detail::hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return place_on_curve<kHilbertBits>(x, y, z);
}

VertexOrder vertex_locality_order(const Mesh& mesh) {
  return mesh.has_positions() ? hilbert_order(mesh.positions(), mesh.bounds()) : breadth_first_order(mesh);
}

// By the least place of a face's vertices: a counting sort.
UninitializedArray<Index> face_ranks(std::span<const Face> faces, std::span<const Index> vertex_rank) {
  UninitializedArray<Index> rank(faces.size());  // first the key, then what becomes of it
  prefault(rank);
  std::vector<Index> start(vertex_rank.size() + 1, 0);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Face& t = faces[f];
    rank[f] = std::min({vertex_rank[t[0]], vertex_rank[t[1]], vertex_rank[t[2]]});
    ++start[rank[f] + 1];
  }
  for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  for (Index& r : rank) r = start[r]++;
  return rank;
}

bool is_local(const Mesh& mesh) {
  constexpr Index kNear = 4096, kSample = 4096;
  const std::span<const Face> faces = mesh.faces();
  const std::size_t stride = std::max<std::size_t>(1, faces.size() / kSample);
  std::size_t near = 0, all = 0;
  for (std::size_t f = 0; f + 1 < faces.size(); f += stride, ++all) {
    const auto [low, high] =
        std::minmax({faces[f][0], faces[f][1], faces[f][2], faces[f + 1][0], faces[f + 1][1], faces[f + 1][2]});
    near += high - low < kNear;
  }
  constexpr std::size_t kMost = 8;  // all but one in so many
  return near >= all - all / kMost;
}

LocalityOrder locality_order(const Mesh& mesh) {
  LocalityOrder result{vertex_locality_order(mesh), {}};
  const UninitializedArray<Index> rank = face_ranks(mesh.faces(), result.vertex_rank);
  result.faces.resize(rank.size());
  for (Index f = 0; f < rank.size(); ++f) result.faces[rank[f]] = f;
  return result;
}

}  // namespace brushfire
