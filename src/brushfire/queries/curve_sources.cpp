// Pieces of curves, parted by places that are nowhere.
#include <brushfire/queries/curve_sources.h>

#include <brushfire/core/error.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace brushfire {
namespace {

using Edge = std::array<Index, 2>;  // the lower vertex first

// A curve of several pieces.
class Pieces {
 public:
  explicit Pieces(const Mesh& mesh) : mesh_(mesh), is_on_(mesh.vertex_count(), 0) {}

  void add(std::span<const Index> chain) {
    if (!source_.places.empty()) source_.places.emplace_back();
    for (const Index v : chain) {
      is_on_[v] = 1;
      source_.places.push_back(vertex_point(mesh_, v));
    }
  }
  // Unless a piece passes through it.
  void add_vertex(Index v) {
    if (is_on_[v] == 0) add(std::span(&v, 1));
  }

  CurveSource done(const char* none) && {
    if (source_.places.empty()) throw Error(ErrorCode::InvalidArgument, none);
    return std::move(source_);
  }

 private:
  const Mesh& mesh_;
  CurveSource source_;
  std::vector<std::uint8_t> is_on_;
};

// Edges, each once, as trails: in as few pieces as there are pairs of ends, and one for each closed part.
class Trails {
 public:
  Trails(const Mesh& mesh, std::vector<Edge> edges) : edges_(std::move(edges)), start_(mesh.vertex_count() + 1, 0) {
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    used_.assign(edges_.size(), 0);
    for (const Edge& e : edges_) {
      for (const Index v : e) ++start_[v + 1];
    }
    for (std::size_t v = 1; v < start_.size(); ++v) start_[v] += start_[v - 1];
    at_.resize(2 * edges_.size());
    std::vector<Index> next(start_.begin(), start_.end() - 1);
    for (Index e = 0; e < edges_.size(); ++e) {
      for (const Index v : edges_[e]) at_[next[v]++] = e;
    }
    next_.assign(start_.begin(), start_.end() - 1);
  }

  void add_to(Pieces& pieces) {
    for (Index v = 0; v + 1 < start_.size(); ++v) {
      if ((start_[v + 1] - start_[v]) % 2 == 1) add_from(v, pieces);
    }
    for (const Edge& e : edges_) add_from(e[0], pieces);
  }

 private:
  void add_from(Index v, Pieces& pieces) {
    std::vector<Index> chain{v};
    for (Index e; (e = unused_at(chain.back())) != kNoIndex;) {
      used_[e] = 1;
      chain.push_back(edges_[e][0] == chain.back() ? edges_[e][1] : edges_[e][0]);
    }
    if (chain.size() > 1) pieces.add(chain);
  }

  Index unused_at(Index v) {
    while (next_[v] < start_[v + 1] && used_[at_[next_[v]]] != 0) ++next_[v];
    return next_[v] < start_[v + 1] ? at_[next_[v]] : kNoIndex;
  }

  std::vector<Edge> edges_;
  std::vector<Index> start_, at_, next_;  // edges at_[start_[v]], ... have an end in v; those before next_[v] are used
  std::vector<std::uint8_t> used_;
};

// What is in a region: whole faces, edges by themselves, vertices.
struct Region {
  const Mesh& mesh;
  std::vector<std::uint8_t> faces;
  std::vector<Edge> edges;
  std::vector<Index> vertices;

  // An edge at which the region ends: of the boundary, or with a face beyond that is not in it.
  bool ends_at(Index halfedge) const {
    const std::span<const Index> opposite = mesh.opposite();
    Index h = opposite[halfedge];
    if (h == halfedge) return true;
    for (; h != halfedge; h = opposite[h]) {
      if (faces[Mesh::face_of(h)] == 0) return true;
    }
    return false;
  }

  CurveSource source() && {
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
      if (faces[Mesh::face_of(h)] != 0 && ends_at(h)) add_edge(mesh.from(h), mesh.to(h));
    }
    Pieces pieces(mesh);
    Trails(mesh, std::move(edges)).add_to(pieces);
    for (const Index v : vertices) pieces.add_vertex(v);
    CurveSource source = std::move(pieces).done("an empty region: no distance starts from it");
    for (Index f = 0; f < faces.size(); ++f) {
      if (faces[f] != 0) source.inside.push_back(f);
    }
    return source;
  }

  void add_edge(Index a, Index b) {
    if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
  }
};

}  // namespace

CurveSource curve_source(const SurfacePath& path) {
  if (path.points.empty()) {
    throw Error(ErrorCode::InvalidArgument, "a path without points, where no way leads: no distance starts from it");
  }
  return {.places = path.points, .closed = path.closed};
}

CurveSource curve_source(const Mesh& mesh, std::span<const Boundary> curves) {
  Pieces pieces(mesh);
  for (const Boundary& b : curves) {
    std::vector<Index> chain = b.vertices;
    if (b.closed) chain.push_back(chain.front());
    pieces.add(chain);
  }
  return std::move(pieces).done("this mesh has no boundary: no distance starts from it");
}

CurveSource region_of_faces(const Mesh& mesh, std::span<const Index> faces) {
  Region region{mesh, std::vector<std::uint8_t>(mesh.face_count(), 0), {}, {}};
  for (const Index f : faces) {
    if (f >= mesh.face_count()) {
      throw Error(ErrorCode::IndexOutOfRange,
                  "face " + std::to_string(f) + " of a region: the mesh has " + std::to_string(mesh.face_count()));
    }
    region.faces[f] = 1;
    const auto& corners = mesh.faces()[f];
    region.vertices.insert(region.vertices.end(), corners.begin(), corners.end());
  }
  return std::move(region).source();
}

CurveSource region_of_vertices(const Mesh& mesh, std::span<const std::uint8_t> vertices) {
  if (vertices.size() != mesh.vertex_count()) {
    throw Error(ErrorCode::InvalidArgument, std::to_string(vertices.size()) + " entries for a mesh of " +
                                                std::to_string(mesh.vertex_count()) + " vertices");
  }
  Region region{mesh, std::vector<std::uint8_t>(mesh.face_count(), 0), {}, {}};
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto& c = mesh.faces()[f];
    const auto in = [&](Index v) { return vertices[v] != 0; };
    region.faces[f] = in(c[0]) && in(c[1]) && in(c[2]);
    if (region.faces[f] != 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      if (in(c[k]) && in(c[(k + 1) % 3])) region.add_edge(c[k], c[(k + 1) % 3]);
    }
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (vertices[v] != 0 && !mesh.corners(v).empty()) region.vertices.push_back(v);
  }
  return std::move(region).source();
}

}  // namespace brushfire
