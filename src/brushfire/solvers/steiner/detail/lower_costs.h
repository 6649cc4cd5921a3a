// Costs between points on edges such that shortest paths in their graph never cost more than those on the surface.
//
// Let L be a function on the edges that is linear between neighbouring points. It is nowhere above the distance d if it
// is not at the sources, and L(y) <= L(x) + w |x - y| for all x and y on two edges of a face of weight w (and along
// each edge): from one crossing of a shortest path to the next it then grows no more than d does. Take x and y in an
// interval each, and let X and Y be ends of these intervals at random, independent, with means x and y. What is linear
// is its own mean, so with L(q) <= L(p) + w c(p, q) for points p and q it is enough that the mean of c(X, Y) is at most
// |x - y|:
//
//   - c = share * |p - q|, since the mean of |X - Y| is at most sqrt(|x - y|^2 + var X + var Y) (the square root is
//     concave): share = 1 / sqrt(1 + v + v'), where v is the most that var X / |x - y|^2 can be. A variance is at most
//     a quarter of the interval's square, and |x - y| at least the distance of the two intervals; or at least the
//     height of x over the other edge, which is proportional to the distance from the common vertex, as is that of y.
//   - c = sin(angle / 2) * (t + t') for the two intervals at the common vertex of the edges, where a is 0: t and t' are
//     the distances from that vertex. |x - y| is at least its component along e - e', the edges' directions, which is
//     that and linear.
//
// A pair of points serves up to four pairs of intervals and takes the least of what they allow. Along an edge c is the
// distance, exactly. L is then the distance in a graph with costs >= 0: any search that finds shortest paths in it
// finds L.
#pragma once

#include <brushfire/solvers/steiner/detail/relax.h>

namespace brushfire::steiner {

// A row as one of two that meet in a vertex: its points, at which of its ends the vertex is.
struct MeetingRow {
  const double* at = nullptr;
  Index count = 0;
  bool at_last = false;
};

// The terms of both rows, whose edges meet at the angle with this sine (0 at 0 and pi) and cosine. The vectors must
// hold at least `room` numbers each, a multiple of the lanes.
void lower_terms(const MeetingRow& a, const MeetingRow& b, double sine, double cosine, LowerTerms& of_a,
                 LowerTerms& of_b);

// The cost to point i of a row, over which a point at (x, y) in the frame of the edge lies, y >= 0: the mean over the
// ends of any interval is nowhere above the distance. `rounding` as above.
double lower_cost(const double* at, Index count, Index i, double x, double y, double rounding);

}  // namespace brushfire::steiner
