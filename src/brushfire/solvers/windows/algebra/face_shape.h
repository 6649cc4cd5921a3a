// Lengths and area of a face, as the room's number.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/windows/algebra/real.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// Where the foot of the apex lies on each halfedge, from the halfedge's start: of wider numbers only. In doubles it is
// found from the three lengths, which is off by up to epsilon * longest^2 / shortest; from the positions it is right to
// epsilon * longest.
template <bool kKept>
struct Feet {
  void set_foot(std::size_t, Real) {}
  void set_feet(const Feet&) {}
};
template <>
struct Feet<true> {
  std::array<Real, 3> foot;
  void set_foot(std::size_t k, Real at) { foot[k] = at; }
  void set_feet(const Feet& other) { foot = other.foot; }
};

// In mesh.unit().
struct FaceShape : Feet<kWide> {
  std::array<Real, 3> length;  // of halfedge k
  Real double_area;
};

// The foot of the apex of halfedge k of a FaceShape or WindowFace, from the halfedge's start, and from its end; the
// halfedge has a length.
template <class F>
[[gnu::always_inline]] inline Real foot_of(const F& f, std::size_t k) {
  const std::size_t next = k == 2 ? 0 : k + 1, last = k == 0 ? 2 : k - 1;
  if constexpr (kWide) {
    return f.foot[k];
  } else {
    return 0.5 * (f.length[k] + (f.length[last] - f.length[next]) * (f.length[last] + f.length[next]) / f.length[k]);
  }
}

// In doubles what the mesh itself knows, to the bit; in wider numbers from the positions again, where there are any.
FaceShape shape_of(const Mesh& mesh, Index f);

// From a point of a face, by its weights, to the face's corners: see corner_distances().
template <class F>
std::array<Real, 3> corner_distances_in(const F& shape, const std::array<Real, 3>& weights) {
  std::array<Real, 3> result;
  for (std::size_t k = 0; k < 3; ++k) {
    const Real wa = weights[(k + 1) % 3], wb = weights[(k + 2) % 3];
    const Real la = shape.length[k], lb = shape.length[(k + 2) % 3];
    if (la == 0 || lb == 0) {
      result[k] = la == 0 ? wb * lb : wa * la;
      continue;
    }
    const Vec2 b{foot_of(shape, k), shape.double_area / la};
    result[k] = hypot(wa * la + wb * b.x, wb * b.y);
  }
  return result;
}

// By how much the weights of one point of a face differ from those of another. They sum to zero, and the two that are
// not the heaviest keep their digits.
inline std::array<Real, 3> step_between(const std::array<Real, 3>& from, const std::array<Real, 3>& to) {
  const auto heaviest = static_cast<std::size_t>(std::max_element(from.begin(), from.end()) - from.begin());
  const std::size_t i = (heaviest + 1) % 3, j = (heaviest + 2) % 3;
  std::array<Real, 3> step;
  step[i] = to[i] - from[i];
  step[j] = to[j] - from[j];
  step[heaviest] = -(step[i] + step[j]);
  return step;
}

// Between two points of a face.
Real distance_in(const FaceShape& shape, const std::array<Real, 3>& from, const std::array<Real, 3>& to);

// Barycentric weights as they are used in here: wider numbers make their sum one again, which in doubles it is to
// rounding only, so that a point of an edge is the same point from all faces there.
std::array<Real, 3> weights_from(const std::array<double, 3>& weights);

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
