// Complex: a triangle complex as the oracle sees it. Built from the faces and coordinates alone, in the arithmetic R,
// so that nothing is shared with the library but the input.
#pragma once

#include <brushfire/mesh/mesh.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace brushfire::oracle {

using Real = long double;
using std::sqrt;  // of the built-in types; others bring their own
inline constexpr Real kFar = std::numeric_limits<Real>::infinity();
inline constexpr Real kHalfTurn = 3.141592653589793238462643383279502884L;

template <class R>
struct Point {
  R x = 0, y = 0;
  friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
  friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
  friend Point operator*(R s, Point a) { return {s * a.x, s * a.y}; }
  friend R dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
  friend R cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
  friend R norm(Point a) { return sqrt(dot(a, a)); }  // the exponents of R have room for squares of doubles
};

// One halfedge of a usable face (three distinct vertices), and the corner it starts from. Its frame: `from` in the
// origin, `to` at (length, 0), the face's third vertex (the apex) at (apex.x, apex.y >= 0).
template <class R>
struct Corner {
  Index from = kNoIndex, to = kNoIndex, apex_vertex = kNoIndex;
  Index edge = kNoIndex;
  R length = 0;
  Point<R> apex;
  R apex_to_end = 0;  // length - apex.x, without the cancellation where the apex is near the end
  R angle = 0;        // at `from`
  Index ahead = 0;    // the place of `to`, and of the apex, among the neighbours of `from`: the nodes of its link
  Index behind = 0;
};

struct Neighbour {
  Index vertex = kNoIndex;
  Index edge = kNoIndex;
};

template <class R>
struct Edge {
  Index a = kNoIndex, b = kNoIndex;  // a < b
  R length = 0;
  std::vector<Index> halfedges;  // of usable faces, any number, either direction
};

template <class R>
struct Complex {
  explicit Complex(const Mesh& mesh);

  Index edge_between(Index a, Index b) const;  // kNoIndex: none
  bool usable(Index face) const { return corner[3 * static_cast<std::size_t>(face)].from != kNoIndex; }

  std::vector<Corner<R>> corner;                   // [3 * faces]; unset (kNoIndex) for faces with a repeated vertex
  std::vector<Edge<R>> edge;                       // every pair of distinct vertices that a face joins
  std::vector<std::vector<Neighbour>> neighbours;  // [vertices]
  std::vector<std::vector<Index>> corners_at;      // [vertices] corners of usable faces
  std::vector<bool> pinched;                       // [vertices] an end of an edge of length zero
};

}  // namespace brushfire::oracle
