// The second variation of a straight path's length: of each leg, how it turns, and the faces beside it.
#include <brushfire/queries/path_length.h>

#include <brushfire/core/detail/sort.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/queries/detail/tangent_fan.h>
#include <brushfire/queries/detail/way_around.h>
#include <brushfire/queries/path.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace brushfire {
namespace {

using On = PointLocation::On;

[[noreturn]] void refuse(const std::string& why) { throw Error(ErrorCode::InvalidArgument, why); }

Vec3 across(Vec3 v, Vec3 direction) { return v - dot(v, direction) * direction; }

// What rounding makes of pi where the path goes straight on: an angle that differs by less is told to be straight.
constexpr double kStraight = 1e-7;

// Whether one of the two sides of a path through a vertex is a straight angle.
bool goes_straight_on(const Mesh& mesh, const PointLocation& before, Index vertex, const PointLocation& after) {
  if (mesh.links()[vertex] != Link::Circle && mesh.links()[vertex] != Link::Arc) return true;
  const detail::TangentFan fan = detail::tangent_fan(mesh, vertex);
  const PointLocation at = locate(mesh, vertex_point(mesh, vertex));
  const auto angle = [&](const PointLocation& there) {
    const Index f = common_face(mesh, at, there, there.face);
    const detail::Direction way = detail::direction_towards(mesh, vertex, f, *weights_in(mesh, there, f));
    return fan.around(way.corner, way.angle);
  };
  const double side = std::abs(angle(after) - angle(before));
  return std::abs(side - kPi) < kStraight || (fan.closed && std::abs(fan.total - side - kPi) < kStraight);
}

}  // namespace

PathLength::PathLength(const Mesh& mesh, std::span<const SurfacePoint> points) {
  if (!mesh.has_positions()) refuse("derivatives by positions need a mesh that has some");
  std::vector<PointLocation> at;
  for (const SurfacePoint& p : points) at.push_back(locate(mesh, p, 0));
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    add_piece(mesh, at[i], at[i + 1], points[i + 1].face);
    if (i == 0) continue;
    if (at[i].on == On::Interior) refuse("point " + std::to_string(i) + " of the path lies within a face");
    if (at[i].on == On::Edge) {
      cross_edge(mesh, at[i]);
    } else if (goes_straight_on(mesh, at[i - 1], at[i].vertex, at[i + 1])) {
      one_sided_ = true;
    }
  }
  number_vertices();
  add_up();
}

// The shares sum to 0: from one corner, short pieces keep their digits.
Vec3 PathLength::moved(const Piece& piece, std::span<const Vec3> x) {
  Vec3 sum;
  for (std::size_t k = 1; k < 3; ++k) sum = sum + piece.share[k] * (x[piece.corner[k]] - x[piece.corner[0]]);
  return sum;
}

void PathLength::add_piece(const Mesh& mesh, const PointLocation& a, const PointLocation& b, Index preferred) {
  const Index f = common_face(mesh, a, b, preferred);
  if (f == kNoIndex) refuse("points " + std::to_string(pieces_.size()) + " and the next of the path share no face");
  Piece piece;
  piece.corner = mesh.faces()[f];
  piece.share = weight_difference(*weights_in(mesh, a, f), *weights_in(mesh, b, f));
  while (piece.share[0] == 0 && (piece.share[1] != 0 || piece.share[2] != 0)) {
    std::rotate(piece.corner.begin(), piece.corner.begin() + 1, piece.corner.end());
    std::rotate(piece.share.begin(), piece.share.begin() + 1, piece.share.end());
  }
  for (std::size_t k = 1; k < 3; ++k) piece.corner[k] = piece.corner[piece.share[k] != 0 ? k : 0];
  const Vec3 way = moved(piece, mesh.positions());
  piece.length = norm(way);
  if (!(piece.length > 0))
    refuse("a piece of the path, behind point " + std::to_string(pieces_.size()) + ", has no length");
  piece.direction = (1 / piece.length) * way;
  pieces_.push_back(piece);
  crossings_.emplace_back();
}

// Between the last two pieces.
void PathLength::cross_edge(const Mesh& mesh, const PointLocation& at) {
  Piece &before = pieces_[pieces_.size() - 2], &after = pieces_.back();
  Crossing& crossing = crossings_.back();
  crossing = {mesh.from(at.halfedge), mesh.to(at.halfedge), 0, before.direction - after.direction};
  const Vec3 edge = mesh.positions()[crossing.to] - mesh.positions()[crossing.from];
  const Vec3 here = across(edge, before.direction), there = across(edge, after.direction);
  const double width = norm(here);
  if (!(width > 0) || !(norm(there) > 0)) refuse("the path runs along an edge that it should cross");
  // A leg's first crossing says which side is which.
  const bool is_first = crossings_[crossings_.size() - 2].from == kNoIndex;
  const double sign = is_first || dot(before.aside, here) > 0 ? 1 : -1;
  if (is_first) before.aside = (1 / width) * here;
  after.aside = (sign / norm(there)) * there;
  crossing.width = sign * (width + norm(there)) / 2;
}

void PathLength::number_vertices() {
  vertices_.clear();
  for (const Piece& p : pieces_) {
    vertices_.insert(vertices_.end(), p.corner.begin(), p.corner.end());
  }
  for (const Crossing& c : crossings_) {
    if (c.from != kNoIndex) vertices_.insert(vertices_.end(), {c.from, c.to});
  }
  detail::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  const auto position = [&](Index v) {
    const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), v);
    return static_cast<Index>(found - vertices_.begin());
  };
  for (Piece& p : pieces_) {
    for (Index& v : p.corner) v = position(v);
  }
  for (Crossing& c : crossings_) {
    if (c.from != kNoIndex) c = {position(c.from), position(c.to), c.width, c.fold};
  }
}

void PathLength::add_up() {
  gradient_.assign(vertices_.size(), {});
  length_ = 0;
  for (const Piece& p : pieces_) {
    length_ += p.length;
    for (std::size_t k = 0; k < 3; ++k) gradient_[p.corner[k]] = gradient_[p.corner[k]] + p.share[k] * p.direction;
  }
}

std::vector<Vec3> PathLength::hessian_times(std::span<const Vec3> moves) const {
  if (moves.size() != vertices_.size()) {
    refuse(std::to_string(moves.size()) + " moves for " + std::to_string(vertices_.size()) + " vertices");
  }
  std::vector<Vec3> change(vertices_.size());
  for (std::size_t first = 0; first < pieces_.size();) {
    std::size_t last = first + 1;
    while (last < pieces_.size() && crossings_[last].from != kNoIndex) ++last;
    move_leg(first, last, moves, change);
    first = last;
  }
  return change;
}

// A leg of pieces [first, last). With the crossings held, piece i is moved by m_i. In the plane of its face it turns by
// z_i in all, so that it is its length times z_i that its end goes aside by more than its start does: m_i's part of
// that, and what the crossings do. Straight stays straight where z changes from one face to the next by nothing but the
// edge's own turn, fold * (change of edge) / width; and the leg's ends do not slide, so that the sum of length * z is
// that of what the moves do alone.
void PathLength::move_leg(std::size_t first, std::size_t last, std::span<const Vec3> moves,
                          std::span<Vec3> change) const {
  const auto edge_turn = [&](const Crossing& c) { return dot(moves[c.to] - moves[c.from], c.fold) / c.width; };
  double length = 0, aside = 0, turned = 0;
  for (std::size_t i = first; i < last; ++i) {
    if (i > first) turned += edge_turn(crossings_[i]);
    length += pieces_[i].length;
    aside += dot(moved(pieces_[i], moves), pieces_[i].aside) - pieces_[i].length * turned;
  }
  double turn = aside / length, slid = 0;  // slid: how far aside the crossing has moved along its edge
  for (std::size_t i = first; i < last; ++i) {
    const Piece& p = pieces_[i];
    if (i > first) {
      const Crossing& c = crossings_[i];
      turn += edge_turn(c);
      const Vec3 pull = (slid / c.width) * c.fold;
      change[c.from] = change[c.from] - pull;
      change[c.to] = change[c.to] + pull;
    }
    const Vec3 move = moved(p, moves);
    const Vec3 out = across(move, p.direction) - dot(move, p.aside) * p.aside;
    const Vec3 turning = turn * p.aside + (1 / p.length) * out;
    for (std::size_t k = 0; k < 3; ++k) change[p.corner[k]] = change[p.corner[k]] + p.share[k] * turning;
    slid += p.length * turn - dot(move, p.aside);
  }
}

std::vector<double> PathLength::hessian() const {
  const std::size_t size = 3 * vertices_.size();
  std::vector<double> matrix;
  matrix.reserve(size * size);
  std::vector<Vec3> moves(vertices_.size());
  for (std::size_t row = 0; row < size; ++row) {
    moves[row / 3] = {row % 3 == 0 ? 1.0 : 0.0, row % 3 == 1 ? 1.0 : 0.0, row % 3 == 2 ? 1.0 : 0.0};
    for (const Vec3& v : hessian_times(moves)) matrix.insert(matrix.end(), {v.x, v.y, v.z});
    moves[row / 3] = {};
  }
  return matrix;
}

PathLength PathLength::renumbered(std::span<const Index> number) const {
  PathLength result = *this;
  const auto named = [&](Index& position) { position = number[vertices_[position]]; };
  for (Piece& p : result.pieces_) std::for_each(p.corner.begin(), p.corner.end(), named);
  for (Crossing& c : result.crossings_) {
    if (c.from == kNoIndex) continue;
    named(c.from);
    named(c.to);
  }
  result.number_vertices();
  result.add_up();
  return result;
}

PathLength path_length(const Domain& domain, const DistanceField& field, Index target) {
  const Mesh& open = domain.open();
  if (!field.windows) refuse("a path's length needs the paths of the field: run method exact with keep_paths");
  if (field.windows->mesh().vertex_count() != open.vertex_count() ||
      field.distance.size() != domain.mesh().vertex_count()) {
    refuse("the field is of another mesh");
  }
  if (target >= field.distance.size() || !(field.distance[target] < kInfinity)) {
    refuse("no path leads to vertex " + std::to_string(target));
  }
  const std::vector<SurfacePoint> sides = domain.on_open(vertex_point(domain.mesh(), target));
  SurfacePath best;
  for (const SurfacePoint& side : sides) {
    SurfacePath path = path_to(*field.windows, side);
    if (best.points.empty() || path.length < best.length) best = std::move(path);
  }
  PathLength found(open, best.points);
  if (!domain.has_walls()) return found;
  return found.renumbered(domain.cut()->original_vertex);
}

}  // namespace brushfire
