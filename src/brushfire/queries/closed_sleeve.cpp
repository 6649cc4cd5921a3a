// The ring is cut open at an edge, the shortest way through the sleeve straightened, and the cut moved where it is
// shortest.
#include <brushfire/queries/detail/closed_sleeve.h>

#include <brushfire/core/cancel.h>
#include <brushfire/mesh/detail/flat_face.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace brushfire::detail {
namespace {

using On = PointLocation::On;

PointLocation on_halfedge(const Mesh& mesh, Index h, double t) {
  SurfacePoint p{Mesh::face_of(h), {0, 0, 0}};
  p.weights[h % 3] = 1 - t;
  p.weights[Mesh::next(h) % 3] = t;
  return locate(mesh, p);
}

// The ring cut at its first edge, from the point at share t of that edge (along `out`) to the same point.
Sleeve cut_open(const Mesh& mesh, const std::vector<Step>& ring, double t) {
  const Step& first = ring.front();
  Sleeve sleeve;
  sleeve.begin = on_halfedge(mesh, first.in, mesh.from(first.in) == mesh.from(first.out) ? t : 1 - t);
  sleeve.end = on_halfedge(mesh, first.out, t);
  sleeve.first_face = Mesh::face_of(first.in);
  sleeve.steps.assign(ring.begin() + 1, ring.end());
  return sleeve;
}

// Cancels steps over an edge and back, around the ring.
void reduce(std::vector<Step>& ring) {
  std::vector<Step> kept;
  for (Step step : ring) {
    if (!kept.empty() && kept.back().in == step.out) {
      step.out = kept.back().out;  // over an edge of several faces and at once on to the third, or back
      kept.pop_back();
    }
    if (step.out != step.in) kept.push_back(step);
  }
  std::size_t first = 0;
  while (kept.size() - first > 1 && kept.back().in == kept[first].out) {  // the last one leads to the first
    kept[first].out = kept.back().out;
    kept.pop_back();
    if (kept[first].out == kept[first].in) ++first;
  }
  ring.assign(kept.begin() + static_cast<std::ptrdiff_t>(first), kept.end());
}

// The cosine of the angle between halfedge h, or the same edge in face f, and the way from one point of f to another.
double cosine(const Mesh& mesh, Index h, Index f, const std::array<double, 3>& from, const std::array<double, 3>& to) {
  const std::array<Vec2, 3> corners = flat_corners(mesh, f);
  const Index own = halfedge_in(mesh, h, f);
  const Vec2 edge = corners[Mesh::next(own) % 3] - corners[own % 3], way = flat_difference(corners, from, to);
  const double value = dot(edge, way) / (norm(edge) * norm(way));
  if (!(std::abs(value) <= 2)) return 0;  // no length, no direction
  return mesh.from(own) == mesh.from(h) ? value : -value;
}

// How fast the shortest way through the ring that is cut at `t` of edge h becomes longer with t, in units of the edge:
// what its end gains less what its beginning does.
double slope(const Mesh& mesh, const std::vector<Step>& ring, FrameCache& frames, double t) {
  const Index h = ring.front().out;
  const std::vector<StraightPiece> way = shortest_in_sleeve(mesh, cut_open(mesh, ring, t), frames);
  const StraightPiece &first = way.front(), &last = way.back();
  const Index into = first.sleeve.first_face, out = last.sleeve.last_face();
  const auto begin = *weights_in(mesh, first.sleeve.begin, into), end = *weights_in(mesh, last.sleeve.end, out);
  return -cosine(mesh, h, into, begin, point_after_begin(mesh, first)) -
         cosine(mesh, h, out, end, point_before_end(mesh, last));
}

// Where to cut the ring's first edge. The length is convex and has no corners within the edge, so this is where its
// slope vanishes, to the rounding of cosines, or an end of the edge.
double best_cut(const Mesh& mesh, const std::vector<Step>& ring, FrameCache& frames) {
  constexpr double kEnd = 1e-9;     // what the length gains between here and the end of the edge is the square of that
  constexpr double kLevel = 1e-12;  // well above what cosines are rounded by; the bend that is left costs its square
  double low = kEnd, high = 1 - kEnd;
  const double at_low = slope(mesh, ring, frames, low);
  if (at_low >= 0) return 0;
  const double at_high = slope(mesh, ring, frames, high);
  if (at_high <= 0) return 1;
  // False position; an end that stays twice is halved in weight (Dowell and Jarratt 1971, "Illinois"), and every fourth
  // time the bracket itself, for slopes that change in a small part of it.
  double weight_low = at_low, weight_high = at_high, before = 0, t = 0.5;
  for (int i = 1; high - low > 2 * std::numeric_limits<double>::epsilon(); ++i) {
    t = i % 4 == 0 ? 0.5 * (low + high) : low + (high - low) * (weight_low / (weight_low - weight_high));
    if (!(t > low && t < high)) t = 0.5 * (low + high);
    stop_if_cancelled();
    const double here = slope(mesh, ring, frames, t);
    if (std::abs(here) <= kLevel) break;
    if (here < 0) {
      low = t;
      weight_low = here;
      if (before < 0) weight_high *= 0.5;
    } else {
      high = t;
      weight_high = here;
      if (before > 0) weight_low *= 0.5;
    }
    before = here;
  }
  return t;
}

}  // namespace

Index halfedge_in(const Mesh& mesh, Index h, Index f) {
  Index g = h;
  while (Mesh::face_of(g) != f) {
    g = mesh.opposite()[g];
    if (g == h) return kNoIndex;
  }
  return g;
}

Sleeve joined(const Sleeve& a, const std::vector<Step>& between, const Sleeve& b) {
  Sleeve sleeve = a;
  sleeve.end = b.end;
  sleeve.steps.insert(sleeve.steps.end(), between.begin(), between.end());
  sleeve.steps.insert(sleeve.steps.end(), b.steps.begin(), b.steps.end());
  return sleeve;
}

std::vector<StraightPiece> without_free_end(const Mesh& mesh, std::vector<StraightPiece> pieces, FrameCache& frames) {
  if (pieces.empty() || pieces.front().sleeve.begin.on == On::Vertex) return pieces;
  Sleeve &first = pieces.front().sleeve, &last = pieces.back().sleeve;
  // From the last face into the first, which hold the same point: nothing, or over the edge it lies on.
  std::vector<Step> bridge;
  if (last.last_face() != first.first_face && last.end.on == On::Edge) {
    bridge.push_back({halfedge_in(mesh, last.end.halfedge, last.last_face()),
                      halfedge_in(mesh, last.end.halfedge, first.first_face)});
  }
  if (pieces.size() == 1) {
    bridge.insert(bridge.begin(), first.steps.begin(), first.steps.end());
    return shortest_in_ring(mesh, std::move(bridge), frames);
  }
  // Some piece ends at a vertex: the list begins there.
  std::vector<StraightPiece> seam = shortest_in_sleeve(mesh, joined(last, bridge, first), frames);
  std::vector<StraightPiece> held(std::make_move_iterator(pieces.begin() + 1),
                                  std::make_move_iterator(pieces.end() - 1));
  held.insert(held.end(), std::make_move_iterator(seam.begin()), std::make_move_iterator(seam.end()));
  return held;
}

std::vector<StraightPiece> shortest_in_ring(const Mesh& mesh, std::vector<Step> ring, FrameCache& frames) {
  stop_if_cancelled();
  reduce(ring);
  if (ring.empty()) return {};
  std::vector<StraightPiece> pieces =
      shortest_in_sleeve(mesh, cut_open(mesh, ring, best_cut(mesh, ring, frames)), frames);
  return pieces.size() == 1 ? pieces : without_free_end(mesh, std::move(pieces), frames);
}

}  // namespace brushfire::detail
