// Triangulations from meshes: the gluing of the cover.
#include <brushfire/solvers/heat/triangulation.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/planar.h>
#include <brushfire/core/error.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string>
#include <utility>

namespace brushfire::heat {
namespace {

// Every face once.
Triangulation single(const Mesh& mesh) {
  Triangulation t;
  t.vertex_count = mesh.vertex_count();
  const std::span<const Index> opposite = mesh.opposite();
  const std::span<const double> lengths = mesh.lengths();
  t.length.assign(lengths.begin(), lengths.end());
  t.tail.reserve(mesh.halfedge_count());
  t.twin.reserve(mesh.halfedge_count());
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    t.tail.push_back(mesh.from(h));
    t.twin.push_back(opposite[h] == h ? kNoIndex : opposite[h]);
  }
  return t;
}

// The back of face f is face n + f, its corners the other way round: halfedge k of the front lies under halfedge 2 - k.
Index back_of(Index h, Index halfedge_count) { return halfedge_count + h - h % 3 + (2 - h % 3); }

// The directions of the faces around an edge, seen along it: the halfedges of its ring in that order.
void sort_around(const Mesh& mesh, std::vector<Index>& ring) {
  const std::span<const Vec3> p = mesh.positions();
  const Index low = std::min(mesh.from(ring[0]), mesh.to(ring[0]));
  const Vec3 axis = p[std::max(mesh.from(ring[0]), mesh.to(ring[0]))] - p[low];
  const double square = dot(axis, axis);
  const auto across = [&](Index h) {
    const Vec3 arm = p[mesh.from(Mesh::previous(h))] - p[low];
    return arm - (square > 0 ? dot(arm, axis) / square : 0) * axis;
  };
  const Vec3 first = across(ring[0]), second = cross(axis, first);
  const double scale = std::sqrt(square);
  std::vector<std::pair<double, Index>> order;
  for (const Index h : ring) {
    const Vec3 arm = across(h);
    order.emplace_back(std::atan2(dot(arm, second), scale * dot(arm, first)), h);
  }
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = order[i].second;
}

// The side of each face whose halfedge runs up the edge meets, in the next face around, the side that runs down.
void glue_around(const Mesh& mesh, const std::vector<Index>& ring, Triangulation& t) {
  const Index low = std::min(mesh.from(ring[0]), mesh.to(ring[0]));
  const auto side = [&](Index h, bool up) {
    return (mesh.from(h) == low) == up ? h : back_of(h, mesh.halfedge_count());
  };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Index a = side(ring[i], true), b = side(ring[i + 1 == ring.size() ? 0 : i + 1], false);
    t.twin[a] = b;
    t.twin[b] = a;
  }
}

Triangulation tufted(const Mesh& mesh) {
  const Index n = mesh.halfedge_count();
  if (n > kNoIndex / 2) throw Error(ErrorCode::TooLarge, "too many faces for the heat method on two sheets");
  Triangulation t;
  t.vertex_count = mesh.vertex_count();
  t.sheets = 2;
  t.tail.resize(std::size_t{2} * n);
  t.length.resize(std::size_t{2} * n);
  t.twin.assign(std::size_t{2} * n, kNoIndex);
  const std::span<const double> lengths = mesh.lengths();
  for (Index h = 0; h < n; ++h) {
    const Index back = back_of(h, n);
    t.tail[h] = mesh.from(h);
    t.tail[back] = mesh.to(h);
    t.length[h] = t.length[back] = lengths[h];
  }
  const std::span<const Index> opposite = mesh.opposite();
  std::vector<Index> ring;
  Poll poll;
  for (Index h = 0; h < n; ++h) {
    poll();
    if (t.twin[h] != kNoIndex) continue;
    ring.clear();
    Index around = h;
    do {
      ring.push_back(around);
      around = opposite[around];
    } while (around != h);
    if (ring.size() > 2 && mesh.has_positions()) sort_around(mesh, ring);
    glue_around(mesh, ring, t);
  }
  return t;
}

bool is_closed(const Mesh& mesh) {
  const std::span<const Index> opposite = mesh.opposite();
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    if (opposite[h] == h) return false;
  }
  return true;
}

}  // namespace

namespace {

// What keeps a mesh from being an oriented surface; empty where nothing does.
std::string fault_of(const Mesh& mesh) {
  const std::span<const Index> opposite = mesh.opposite();
  const auto text = [](Index i) { return std::to_string(i); };
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const Index f = Mesh::face_of(h), o = opposite[h];
    if (!mesh.is_face_usable(f)) return "face " + text(f) + " has a vertex twice";
    if (o == h) continue;
    const auto edge = [&] { return "the edge between vertices " + text(mesh.from(h)) + " and " + text(mesh.to(h)); };
    if (opposite[o] != h) return edge() + " has more than two faces";
    if (mesh.from(o) == mesh.from(h)) {
      return "faces " + text(f) + " and " + text(Mesh::face_of(o)) + " run the same way along " + edge();
    }
  }
  return {};
}

}  // namespace

bool is_oriented_manifold(const Mesh& mesh) { return fault_of(mesh).empty(); }

Triangulation triangulation_of(const Mesh& mesh, Cover cover) {
  if (cover == Cover::Single) {
    if (const std::string fault = fault_of(mesh); !fault.empty()) {
      throw Error(
          ErrorCode::InvalidArgument,
          "vectors need a surface whose faces lie the same way round and whose edges have one or two of them: " +
              fault + " (distances by heat take any mesh)");
    }
    return single(mesh);
  }
  const bool once = cover == Cover::AsItIs && is_closed(mesh) && is_oriented_manifold(mesh);
  return once ? single(mesh) : tufted(mesh);
}

double mean_edge_length(const Triangulation& t) {
  double sum = 0;
  std::size_t count = 0;
  for (Index h = 0; h < t.tail.size(); ++h) {
    if (t.twin[h] < h) continue;
    sum += t.length[h];
    ++count;
  }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

FlatTriangle lay_flat(const Triangulation& t, std::size_t face) {
  const double a = t.length[3 * face], b = t.length[3 * face + 1], c = t.length[3 * face + 2];
  const double double_area = 0.5 * std::sqrt(std::max(heron_sorted(a, b, c), 0.0));
  return {a, apex_over_edge(a, c, b, double_area)};
}

double half_cotangent(const Triangulation& t, Index h) {
  return half_cotangent(t, h, lay_flat(t, h / 3).double_area());
}

double half_cotangent(const Triangulation& t, Index h, double double_area) {
  const double a = t.length[h], b = t.length[Mesh::next(h)], c = t.length[Mesh::previous(h)];
  return double_area > 0 ? (b * b + c * c - a * a) / (4 * double_area) : 0;
}

}  // namespace brushfire::heat
