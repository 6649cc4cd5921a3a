// Blocked faces go, blocked edges become slits, vertices are copied per sector.
#include <brushfire/mesh/cut.h>

#include <brushfire/core/error.h>

#include <algorithm>
#include <string>
#include <utility>

namespace brushfire {
namespace {

// What is blocked, per face and per halfedge.
struct Blocked {
  std::vector<char> face, halfedge, vertex_touched;
};

void check_index(Index i, Index count, const char* what) {
  if (i >= count) {
    throw Error(ErrorCode::IndexOutOfRange, std::string("blocked ") + what + " " + std::to_string(i) +
                                                " does not exist: the mesh has " + std::to_string(count));
  }
}

void block_edge(const Mesh& mesh, std::array<Index, 2> edge, Blocked& blocked) {
  const auto [a, b] = edge;
  for (const Index v : edge) check_index(v, mesh.vertex_count(), "vertex");
  bool found = false;
  for (const Index corner : mesh.corners(a)) {
    for (const Index h : {corner, Mesh::previous(corner)}) {
      if ((mesh.from(h) == a && mesh.to(h) == b) || (mesh.from(h) == b && mesh.to(h) == a)) {
        blocked.halfedge[h] = true;
        found = true;
      }
    }
  }
  if (!found || a == b) {
    throw Error(ErrorCode::InvalidArgument,
                "no edge joins vertices " + std::to_string(a) + " and " + std::to_string(b) + ": it cannot be blocked");
  }
  blocked.vertex_touched[a] = blocked.vertex_touched[b] = true;
}

Blocked mark(const Mesh& mesh, const Barriers& barriers) {
  Blocked blocked{std::vector<char>(mesh.face_count(), false), std::vector<char>(mesh.halfedge_count(), false),
                  std::vector<char>(mesh.vertex_count(), false)};
  for (const Index v : barriers.vertices) {
    check_index(v, mesh.vertex_count(), "vertex");
    for (const Index h : mesh.corners(v)) blocked.face[Mesh::face_of(h)] = true;
  }
  for (const Index f : barriers.faces) {
    check_index(f, mesh.face_count(), "face");
    blocked.face[f] = true;
  }
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (!blocked.face[f]) continue;
    for (const Index v : mesh.faces()[f]) blocked.vertex_touched[v] = true;
  }
  for (const auto& edge : barriers.edges) block_edge(mesh, edge, blocked);
  return blocked;
}

// The corners at one vertex, gathered into fans over the edges that meet there.
class Fans {
 public:
  // Joins the faces for which `face` holds over the edges (halfedges) for which `edge` holds.
  template <class FacePassable, class EdgePassable>
  Fans(const Mesh& mesh, Index v, std::span<Index> place_of_face, FacePassable&& face, EdgePassable&& edge)
      : corners_(mesh.corners(v)) {
    parent_.resize(corners_.size());
    for (Index i = 0; i < corners_.size(); ++i) {
      parent_[i] = i;
      place_of_face[Mesh::face_of(corners_[i])] = i;
      // Two corners of one face at one vertex: they stay together.
      if (i > 0 && Mesh::face_of(corners_[i - 1]) == Mesh::face_of(corners_[i])) join(i - 1, i);
    }
    const auto opposite = mesh.opposite();
    for (Index i = 0; i < corners_.size(); ++i) {
      if (!face(Mesh::face_of(corners_[i]))) continue;
      for (const Index h : {corners_[i], Mesh::previous(corners_[i])}) {
        if (!edge(h)) continue;
        // Only to the next such face of the ring: that one joins the one after it.
        Index g = opposite[h];
        while (g != h && !face(Mesh::face_of(g))) g = opposite[g];
        join(i, place_of_face[Mesh::face_of(g)]);
      }
    }
  }

  Index of(Index place) {
    while (parent_[place] != place) place = parent_[place] = parent_[parent_[place]];
    return place;
  }

 private:
  void join(Index a, Index b) {
    a = of(a);
    b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  std::span<const Index> corners_;
  std::vector<Index> parent_;
};

// Gives the sectors around v their copies: new_vertex[h] for every corner h of a face that stays.
void split_vertex(const Mesh& mesh, Index v, const Blocked& blocked, std::span<Index> place_of_face,
                  std::vector<Index>& new_vertex, std::vector<Index>& original_vertex) {
  const auto corners = mesh.corners(v);
  const auto any_face = [](Index) { return true; };
  const auto free_face = [&](Index f) { return !blocked.face[f]; };
  const auto free_edge = [&](Index h) { return !blocked.halfedge[h]; };
  Fans before(mesh, v, place_of_face, any_face, any_face);
  Fans after(mesh, v, place_of_face, free_face, free_edge);
  // Whether some fan has fallen into several sectors: the first sector of each fan is remembered.
  std::vector<Index> sector_of_fan(corners.size(), kNoIndex), copy_of_sector(corners.size(), kNoIndex);
  bool parted = false;
  for (Index i = 0; i < corners.size(); ++i) {
    if (blocked.face[Mesh::face_of(corners[i])]) continue;
    Index& first = sector_of_fan[before.of(i)];
    if (first == kNoIndex) first = after.of(i);
    parted = parted || first != after.of(i);
  }
  if (!parted) return;
  bool original_taken = false;
  for (Index i = 0; i < corners.size(); ++i) {
    if (blocked.face[Mesh::face_of(corners[i])]) continue;
    Index& copy = copy_of_sector[after.of(i)];
    if (copy == kNoIndex && !std::exchange(original_taken, true)) copy = v;
    if (copy == kNoIndex) {
      copy = static_cast<Index>(original_vertex.size());
      original_vertex.push_back(v);
    }
    new_vertex[corners[i]] = copy;
  }
}

Index lowest_of_ring(const Mesh& mesh, Index h) {
  Index lowest = h;
  for (Index g = mesh.opposite()[h]; g != h; g = mesh.opposite()[g]) lowest = std::min(lowest, g);
  return lowest;
}

}  // namespace

CutMesh cut(const Mesh& mesh, const Barriers& barriers) {
  const Blocked blocked = mark(mesh, barriers);
  CutMesh result;
  result.original_vertex.resize(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) result.original_vertex[v] = v;
  std::vector<Index> new_vertex(mesh.halfedge_count());
  for (Index h = 0; h < mesh.halfedge_count(); ++h) new_vertex[h] = mesh.from(h);
  std::vector<Index> place_of_face(mesh.face_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (blocked.vertex_touched[v]) {
      split_vertex(mesh, v, blocked, place_of_face, new_vertex, result.original_vertex);
    }
  }

  std::vector<Face> faces;
  std::vector<std::array<double, 3>> lengths;
  std::vector<Index> slits;
  result.cut_face.assign(mesh.face_count(), kNoIndex);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (blocked.face[f]) continue;
    result.cut_face[f] = static_cast<Index>(faces.size());
    result.original_face.push_back(f);
    faces.push_back({new_vertex[3 * f], new_vertex[3 * f + 1], new_vertex[3 * f + 2]});
    for (Index k = 0; k < 3; ++k) {
      if (blocked.halfedge[3 * f + k]) slits.push_back(3 * result.cut_face[f] + k);
    }
    if (mesh.has_positions()) continue;
    std::array<double, 3> l;
    for (Index k = 0; k < 3; ++k) l[k] = mesh.lengths()[3 * f + k] * mesh.unit();
    lengths.push_back(l);
  }
  if (mesh.has_positions()) {
    std::vector<Vec3> positions;
    positions.reserve(result.original_vertex.size());
    for (const Index v : result.original_vertex) positions.push_back(mesh.positions()[v]);
    result.mesh = Mesh(std::move(positions), std::move(faces));
  } else {
    result.mesh = Mesh::from_lengths(static_cast<Index>(result.original_vertex.size()), faces, lengths);
  }
  // A slit of one edge leaves both its ends whole: its sides have the same vertices and are told apart by this.
  if (!slits.empty()) result.mesh = result.mesh.with_slits(slits);
  return result;
}

std::vector<double> CutMesh::to_original(std::span<const double> values) const {
  if (values.size() != original_vertex.size()) {
    throw Error(ErrorCode::InvalidArgument,
                std::to_string(values.size()) + " values for " + std::to_string(original_vertex.size()) + " vertices");
  }
  std::vector<double> result;
  for (Index v = 0; v < values.size(); ++v) {
    if (original_vertex[v] == v) {
      result.push_back(values[v]);
    } else {
      double& least = result[original_vertex[v]];
      least = std::min(least, values[v]);
    }
  }
  return result;
}

void CutMesh::to_original(std::span<const double> distance, std::span<const Index> source,
                          std::vector<double>& original_distance, std::vector<Index>& original_source) const {
  original_distance = to_original(distance);
  if (source.size() != distance.size()) {
    throw Error(ErrorCode::InvalidArgument,
                std::to_string(source.size()) + " sources for " + std::to_string(distance.size()) + " distances");
  }
  original_source.assign(original_distance.size(), kNoIndex);
  for (Index v = 0; v < distance.size(); ++v) {
    const Index o = original_vertex[v];
    if (distance[v] == original_distance[o]) original_source[o] = std::min(original_source[o], source[v]);
  }
}

SurfacePoint CutMesh::to_original(const SurfacePoint& point) const {
  locate(mesh, point);
  return {original_face[point.face], point.weights};
}

std::vector<SurfacePoint> CutMesh::from_original(const Mesh& original, const SurfacePoint& point) const {
  const PointLocation at = locate(original, point);
  std::vector<SurfacePoint> result;
  // Of the names of one place (a vertex, or an edge by its lowest halfedge) in the cut mesh, the first is enough.
  std::vector<Index> seen;
  const auto offer = [&](Index cut_number, const std::array<double, 3>& weights, Index place) {
    if (std::find(seen.begin(), seen.end(), place) != seen.end()) return;
    seen.push_back(place);
    result.push_back({cut_number, weights});
  };
  if (at.on == PointLocation::On::Interior) {
    if (cut_face[at.face] != kNoIndex) offer(cut_face[at.face], at.weights, 0);
  } else if (at.on == PointLocation::On::Vertex) {
    for (const Index h : original.corners(at.vertex)) {
      const Index f = cut_face[Mesh::face_of(h)];
      std::array<double, 3> weights{0, 0, 0};
      weights[h % 3] = 1;
      if (f != kNoIndex) offer(f, weights, mesh.faces()[f][h % 3]);
    }
  } else {
    Index h = at.halfedge;
    do {
      const Index f = cut_face[Mesh::face_of(h)];
      const bool same_way = original.from(h) == original.from(at.halfedge);
      std::array<double, 3> weights{0, 0, 0};
      weights[h % 3] = same_way ? 1 - at.t : at.t;
      weights[Mesh::next(h) % 3] = same_way ? at.t : 1 - at.t;
      if (f != kNoIndex) offer(f, weights, lowest_of_ring(mesh, 3 * f + h % 3));
      h = original.opposite()[h];
    } while (h != at.halfedge);
  }
  return result;
}

}  // namespace brushfire
