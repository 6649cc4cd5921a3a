// The point's faces, and what lies at no distance from it.
#include <brushfire/solvers/windows/paths/leg_origins.h>

#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/mesh/detail/wide_face.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace brushfire::windows {
namespace {

using On = PointLocation::On;
using detail::DoubleDouble, detail::WideVec2, detail::wide_corners, detail::wide_point;

// Vertices that are nearer than this share of the value have the same value as the point, as far as anyone knows: the
// leg may start from any of them.
constexpr double kNoDistance = 64 * std::numeric_limits<double>::epsilon();
// And those that are nearer than this share of the longest edge of a face of both: the weights of a point do not tell
// them apart.
constexpr double kNoPlace = 2 * std::numeric_limits<double>::epsilon();
// And what ways of 106 bits are rounded by, as a share of that edge: the foot of a vertex on an edge that it lies on.
constexpr double kNoWay = 0x1p-98;

double longest_edge(const Mesh& mesh, Index face) {
  const auto l = mesh.lengths().subspan(3 * std::size_t{face}, 3);
  return std::max({l[0], l[1], l[2]});
}

}  // namespace

std::array<double, 3> corner_weights(Index k) {
  std::array<double, 3> weights{0, 0, 0};
  weights[k] = 1;
  return weights;
}

std::vector<PointInFace> names_of(const Mesh& mesh, const PointLocation& at) {
  std::vector<PointInFace> names;
  if (at.on == On::Vertex) {
    for (const Index h : mesh.corners(at.vertex)) names.push_back({Mesh::face_of(h), corner_weights(h % 3)});
  } else {
    for (const Index f : faces_at(mesh, at)) names.push_back({f, *weights_in(mesh, at, f)});
  }
  return names;
}

LegOrigins::LegOrigins(const Mesh& mesh, const PointLocation& at, double value) : mesh_(mesh), value_(value) {
  offer({at, 0, kNoIndex, 0});
  // Nearest first: where offsets are large, vertices that are far apart count, and the way between them with them.
  while (!open_.empty()) {
    const auto [before, i] = open_.top();
    open_.pop();
    if (before == origins_[i].before) spread(i);
  }
}

void LegOrigins::spread(Index i) {
  const LegOrigin from = origins_[i];
  for (const PointInFace& f : names_of(mesh_, from.at)) {
    rounding_ = std::max(rounding_, kNoWay * longest_edge(mesh_, f.face));
    PointLocation here;
    here.face = f.face;
    here.weights = f.weights;
    const std::array<double, 3> d = corner_distances(mesh_, here);
    for (Index k = 0; k < 3; ++k) {
      const double way = from.before + d[k], rounded = from.at.on == On::Vertex ? from.rounded : from.rounded + d[k];
      if (way <= no_distance(from, f.face)) offer({at_corner(3 * f.face + k), way, i, rounded});
    }
    for (Index k = 0; k < 3; ++k) offer_across(f, 3 * f.face + k, i);
  }
}

// Values beside a source may be rounded to less than nothing.
double LegOrigins::no_distance() const { return std::max(kNoDistance * value_, rounding_); }

// How long a way may be that goes on from there into the face. A point of an edge is known to an epsilon of the edge,
// whatever the value; a vertex is where it is.
double LegOrigins::no_distance(const LegOrigin& from, Index face) const {
  if (from.at.on == On::Vertex) return from.rounded + no_distance();
  return from.rounded + std::max(no_distance(), kNoPlace * longest_edge(mesh_, face));
}

void LegOrigins::offer(const LegOrigin& origin) {
  Index i = size();
  if (origin.at.on != On::Interior) {
    const bool is_vertex = origin.at.on == On::Vertex;
    auto& known = is_vertex ? at_vertex_ : on_edge_;
    const auto [it, is_new] = known.try_emplace(is_vertex ? origin.at.vertex : edge_of(origin.at.halfedge), i);
    i = it->second;
    if (!is_new && !(origin.before < origins_[i].before)) return;
  }
  if (i == size()) origins_.emplace_back();
  origins_[i] = origin;
  open_.emplace(origin.before, i);
}

PointLocation LegOrigins::at_corner(Index corner) const {
  PointLocation at;
  at.on = On::Vertex;
  at.vertex = mesh_.from(corner);
  at.face = Mesh::face_of(corner);
  at.weights = corner_weights(corner % 3);
  return at;
}

bool LegOrigins::has_value_of(Index v) const {
  const auto it = at_vertex_.find(v);
  return it != at_vertex_.end() && origins_[it->second].before <= no_distance();
}

// The foot of the point on an edge at no distance: other corners of faces without area may lie there.
void LegOrigins::offer_across(const PointInFace& f, Index h, Index previous) {
  const double weight = f.weights[Mesh::previous(h) % 3], length = mesh_.length(h);
  const double room = no_distance(origins_[previous], f.face);
  if (weight == 0 || !(length > 0) || mesh_.opposite()[h] == h) return;
  if (!(weight * mesh_.double_areas()[f.face] <= 2 * room * length)) return;
  const std::array<WideVec2, 3> corners = wide_corners(mesh_, f.face, h % 3);
  const WideVec2 here = wide_point(corners, f.weights);
  const DoubleDouble share = (here.x - corners[h % 3].x) / (corners[Mesh::next(h) % 3].x - corners[h % 3].x);
  const double way = origins_[previous].before + std::abs((here.y - corners[h % 3].y).high);
  if (!(share > 0 && share < 1 && way <= room)) return;
  PointLocation at;
  at.on = On::Edge;
  at.halfedge = h;
  at.face = f.face;
  at.weights[h % 3] = (DoubleDouble(1) - share).high;
  at.weights[Mesh::next(h) % 3] = share.high;
  offer({at, way, previous, origins_[previous].rounded});
}

// The least of its halfedges.
Index LegOrigins::edge_of(Index h) const {
  Index least = h;
  for (Index g = mesh_.opposite()[h]; g != h; g = mesh_.opposite()[g]) least = std::min(least, g);
  return least;
}

}  // namespace brushfire::windows
