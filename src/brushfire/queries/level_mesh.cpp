// Face by face, until no neighbour halves an edge any more.
#include <brushfire/queries/detail/level_mesh.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/memory.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/core/detail/text.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/queries/detail/level_triangle.h>
#include <brushfire/solvers/windows/paths/face_fronts.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace brushfire::detail {
namespace {

using Weights = std::array<double, 3>;

Vec2 place_of(const std::array<Vec2, 3>& corners, const Weights& w) {
  return corners[0] + flat_difference(corners, {1, 0, 0}, w);
}

}  // namespace

LevelMesh::LevelMesh(const WindowField& field, std::span<const double> levels, double chord_error)
    : field_(field),
      mesh_(field.mesh()),
      finest_(chord_error / mesh_.unit()),
      place_(mesh_.face_count(), kNoIndex),
      known_(mesh_.vertex_count(), kNoIndex) {
  for (const double level : levels) levels_.push_back(level / mesh_.unit());
  detail::sort(levels_.begin(), levels_.end());
  above_ = levels_.empty() ? 1 : levels_.back() + std::max(1.0, std::abs(levels_.back()));
  for (Index face = 0; face < mesh_.face_count(); ++face) {
    stop_if_cancelled();
    if (!may_cross(face)) continue;
    place_[face] = static_cast<Index>(faces_.size());
    waiting_.push_back(place_[face]);
    FaceTriangles f{face, finest_in(face), {}, {}};
    Triangle whole;
    for (std::size_t k = 0; k < 3; ++k) {
      whole.vertices[k] = vertex_of(mesh_.faces()[face][k]);
      whole.weights[k] = {0, 0, 0};
      whole.weights[k][k] = 1;
    }
    f.triangles.push_back(whole);
    faces_.push_back(std::move(f));
  }
  while (!waiting_.empty()) {
    FaceTriangles& f = faces_[waiting_.back()];
    waiting_.pop_back();
    f.waits = false;
    refine(f);
  }
  finish();
}

// A level may cross a face if it lies between the corners' values, or beyond them by less than the face is large: the
// distance changes at most as fast as one walks. A corner that is farther than the run went says nothing.
bool LevelMesh::may_cross(Index face) const {
  if (!mesh_.is_face_usable(face)) return false;
  double low = kInfinity, high = -kInfinity, longest = 0;
  for (Index k = 0; k < 3; ++k) {
    SurfacePoint p{face, {0, 0, 0}};
    p.weights[k] = 1;
    const double d = field_.value(p).distance / mesh_.unit();
    low = std::min(low, d);
    if (d < kInfinity) high = std::max(high, d);
    longest = std::max(longest, mesh_.lengths()[3 * face + k]);
  }
  if (low == kInfinity) return !windows::face_fronts(field_, face).empty();
  const auto first = std::lower_bound(levels_.begin(), levels_.end(), low - longest);
  return first != levels_.end() && *first <= high + longest;
}

// Never coarser than an eighth of the face, nor finer than what rounding leaves of its places.
double LevelMesh::finest_in(Index face) const {
  constexpr double kCoarsest = 1.0 / 8, kFinest = 1e-12;
  double longest = 0;
  for (Index k = 0; k < 3; ++k) longest = std::max(longest, mesh_.lengths()[3 * face + k]);
  return longest * std::clamp(finest_ / longest, kFinest, kCoarsest);
}

// Until no triangle has a side that another one halved.
void LevelMesh::refine(FaceTriangles& f) {
  const std::array<Vec2, 3> corners = flat_corners(mesh_, f.face);
  bool has_changed = true;
  while (has_changed) {
    has_changed = false;
    // Those that are added come to their turn, too.
    for (std::size_t i = 0; i < f.triangles.size(); ++i) {
      stop_if_cancelled();
      while (const std::optional<std::size_t> side = side_to_halve(f, f.triangles[i], corners)) {
        halve(f, i, *side);
        has_changed = true;
      }
    }
  }
}

std::optional<std::size_t> LevelMesh::side_to_halve(FaceTriangles& f, Triangle& t,
                                                    const std::array<Vec2, 3>& corners) const {
  bool is_halved = false;
  std::size_t longest = 0;
  double length = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    is_halved = is_halved || middles_.contains(side_of(f.face, t, k));
    const double l = norm(flat_difference(corners, t.weights[k], t.weights[(k + 1) % 3]));
    if (l > length) longest = k, length = l;
  }
  if (!is_halved && !t.is_told) t.is_told = !(length > f.finest) || is_told(f, t, corners);
  if (!is_halved && t.is_told) return std::nullopt;
  return longest;
}

// In mesh.unit(); infinity where nothing is known.
double LevelMesh::known_value(Index v) const { return is_known_[v] ? values_[v] / mesh_.unit() : kInfinity; }

bool LevelMesh::is_told(FaceTriangles& f, const Triangle& t, const std::array<Vec2, 3>& corners) const {
  LevelTriangle triangle{};
  double low = kInfinity, high = -kInfinity, size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    triangle.corners[k] = place_of(corners, t.weights[k]);
    triangle.values[k] = known_value(t.vertices[k]);
    low = std::min(low, triangle.values[k]);
    high = std::max(high, triangle.values[k]);
  }
  for (std::size_t k = 0; k < 3; ++k) size = std::max(size, norm(triangle.corners[(k + 1) % 3] - triangle.corners[k]));
  if (low == kInfinity) low = -kInfinity;  // the run may have come to no corner and yet to what is between
  const auto first = std::lower_bound(levels_.begin(), levels_.end(), low - size);
  const auto last = std::upper_bound(levels_.begin(), levels_.end(), high + size);
  if (first < last && f.fronts.empty()) f.fronts = windows::face_fronts(field_, f.face);
  constexpr double kRoom = 1.0 / 16;  // of what is not looked into any more
  return std::all_of(first, std::max(first, last),
                     [&](double level) { return corners_tell(triangle, level, f.fronts, kRoom * f.finest); });
}

// Over a side, into one triangle in its place and one at the end.
void LevelMesh::halve(FaceTriangles& f, std::size_t triangle, std::size_t side) {
  const Index middle = middle_of(f, f.triangles[triangle], side);
  Triangle first = f.triangles[triangle], second = first;
  const std::size_t a = side, b = (side + 1) % 3;
  Weights w{};
  for (std::size_t k = 0; k < 3; ++k) w[k] = 0.5 * (first.weights[a][k] + first.weights[b][k]);
  first.vertices[b] = second.vertices[a] = middle;
  first.weights[b] = second.weights[a] = w;
  first.is_told = second.is_told = false;
  f.triangles[triangle] = first;
  f.triangles.push_back(second);
}

Index LevelMesh::middle_of(const FaceTriangles& f, const Triangle& t, std::size_t side) {
  const auto [at, is_new] = middles_.try_emplace(side_of(f.face, t, side), 0);
  if (!is_new) return at->second;
  SurfacePoint p{f.face, {}};
  for (std::size_t k = 0; k < 3; ++k) p.weights[k] = 0.5 * (t.weights[side][k] + t.weights[(side + 1) % 3][k]);
  at->second = add_vertex(p);
  const Index middle = at->second;
  const Index edge = edge_of(f.face, t, side);
  if (edge != kNoIndex) wake_neighbours(edge);
  return middle;
}

// The halfedge of the face on which the side lies.
Index LevelMesh::edge_of(Index face, const Triangle& t, std::size_t side) const {
  const Weights &a = t.weights[side], &b = t.weights[(side + 1) % 3];
  for (Index k = 0; k < 3; ++k) {
    if (a[(k + 2) % 3] == 0 && b[(k + 2) % 3] == 0) return 3 * face + k;
  }
  return kNoIndex;
}

LevelMesh::Side LevelMesh::side_of(Index face, const Triangle& t, std::size_t side) const {
  const Index a = t.vertices[side], b = t.vertices[(side + 1) % 3], edge = edge_of(face, t, side);
  Index home = mesh_.halfedge_count() + face;
  if (edge != kNoIndex) {
    home = edge;
    for (Index h = mesh_.opposite()[edge]; h != edge; h = mesh_.opposite()[h]) home = std::min(home, h);
  }
  return {std::min(a, b), std::max(a, b), home};
}

void LevelMesh::wake_neighbours(Index halfedge) {
  for (Index h = mesh_.opposite()[halfedge]; h != halfedge; h = mesh_.opposite()[h]) {
    const Index place = place_[Mesh::face_of(h)];
    if (place == kNoIndex || faces_[place].waits) continue;
    faces_[place].waits = true;
    waiting_.push_back(place);
  }
}

Index LevelMesh::vertex_of(Index v) {
  if (known_[v] == kNoIndex) known_[v] = add_vertex(vertex_point(mesh_, v));
  return known_[v];
}

Index LevelMesh::add_vertex(const SurfacePoint& p) {
  // How fine the mesh becomes shows only when it is made.
  constexpr std::size_t kLook = std::size_t{1} << 17, kBytes = 400;
  if (origin_.size() % kLook == kLook - 1) {
    require_memory(kBytes * kLook, 0,
                   "isolines that have to be looked for at " + std::to_string(origin_.size()) + " places",
                   "ask for a larger chord error, or for fewer levels");
  }
  const double value = field_.value(p).distance;
  origin_.push_back(p);
  is_known_.push_back(value < kInfinity);
  values_.push_back(value < kInfinity ? value : above_ * mesh_.unit());
  return static_cast<Index>(origin_.size() - 1);
}

void LevelMesh::finish() {
  std::vector<Face> faces;
  for (const FaceTriangles& f : faces_) {
    for (const Triangle& t : f.triangles) {
      faces.push_back(t.vertices);
      parent_.push_back(f.face);
    }
  }
  fine_ = Mesh(std::vector<Vec3>(origin_.size()), std::move(faces));
}

}  // namespace brushfire::detail
