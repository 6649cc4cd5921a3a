// Weights are looked at once, before anything is built from them.
#include <brushfire/solvers/steiner/weights.h>

#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace brushfire {
namespace {

void check_faces(const Mesh& mesh, const std::vector<double>& weights) {
  if (weights.empty()) return;
  if (weights.size() != mesh.face_count()) {
    throw Error(ErrorCode::InvalidArgument, std::to_string(weights.size()) + " weights for " +
                                                std::to_string(mesh.face_count()) + " faces: one per face is needed");
  }
  for (std::size_t f = 0; f < weights.size(); ++f) {
    if (weights[f] > 0) continue;
    throw Error(ErrorCode::InvalidArgument,
                "weight " + number_as_text(weights[f]) + " of face " + std::to_string(f) + " is not > 0" +
                    (weights[f] == 0 ? ": where going costs next to nothing, give a small weight" : ""));
  }
}

void check_grain(const Mesh& mesh, const Weights& weights) {
  const std::vector<Grain>& grain = weights.grain;
  if (grain.empty()) return;
  const auto fail = [](const std::string& what) { throw Error(ErrorCode::InvalidArgument, what); };
  if (grain.size() != mesh.face_count()) {
    fail("a grain for " + std::to_string(grain.size()) + " faces of " + std::to_string(mesh.face_count()) +
         ": one per face is needed");
  }
  if (!mesh.has_positions()) fail("a grain needs positions, and this mesh has lengths only");
  if (weights.pace) fail("a grain and slopes do not go together");
  for (std::size_t f = 0; f < grain.size(); ++f) {
    const auto& [x, y, z] = grain[f].direction;
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
      fail("the grain of face " + std::to_string(f) + " has no finite direction");
    }
    if (!(grain[f].across > 0 && grain[f].across < kInfinity)) {
      fail("the cost across the grain of face " + std::to_string(f) + ", " + number_as_text(grain[f].across) +
           ", is not > 0 and finite");
    }
  }
}

std::string name_of(const EdgeCost& edge) {
  return "edge " + std::to_string(edge.vertices[0]) + " - " + std::to_string(edge.vertices[1]);
}

void check_edge(const Mesh& mesh, const EdgeCost& edge, const std::vector<double>& faces) {
  for (const Index v : edge.vertices) {
    if (v < mesh.vertex_count()) continue;
    throw Error(ErrorCode::IndexOutOfRange, name_of(edge) + ": vertex " + std::to_string(v) +
                                                " does not exist: the mesh has " + std::to_string(mesh.vertex_count()));
  }
  if (!(edge.along > 0)) {
    throw Error(ErrorCode::InvalidArgument,
                name_of(edge) + ": the cost along it, " + number_as_text(edge.along) + ", is not > 0");
  }
  if (!(edge.crossing >= 0)) {
    throw Error(ErrorCode::InvalidArgument,
                name_of(edge) + ": the cost to cross it, " + number_as_text(edge.crossing) + ", is not >= 0");
  }
  const std::vector<Index> sides = halfedges_between(mesh, edge.vertices[0], edge.vertices[1]);
  if (edge.vertices[0] == edge.vertices[1] || sides.empty()) {
    throw Error(ErrorCode::InvalidArgument, name_of(edge) + ": no edge of the mesh joins these two vertices");
  }
  const auto is_wall = [&](Index h) { return !faces.empty() && faces[Mesh::face_of(h)] == kInfinity; };
  if (edge.along < kInfinity && std::all_of(sides.begin(), sides.end(), is_wall)) {
    throw Error(ErrorCode::InvalidArgument, name_of(edge) +
                                                ": a road between faces of weight inf, which are cut out: for a road "
                                                "through a wall give the wall a large weight, 1e9, instead");
  }
}

}  // namespace

double Weights::uniform() const {
  if (!edges.empty() || !is_isotropic()) return 0;
  if (face.empty()) return 1;
  const bool same =
      face.front() < kInfinity && std::all_of(face.begin(), face.end(), [&](double w) { return w == face.front(); });
  return same ? face.front() : 0;
}

void check(const Mesh& mesh, const Weights& weights) {
  check_faces(mesh, weights.face);
  if (weights.pace && !mesh.has_positions()) {
    throw Error(ErrorCode::InvalidArgument, "slopes need positions, and this mesh has lengths only");
  }
  check_grain(mesh, weights);
  for (const EdgeCost& edge : weights.edges) check_edge(mesh, edge, weights.face);
}

std::vector<Index> halfedges_between(const Mesh& mesh, Index a, Index b) {
  std::vector<Index> found;
  for (const Index corner : mesh.corners(a)) {
    if (mesh.to(corner) == b) found.push_back(corner);
    if (mesh.from(Mesh::previous(corner)) == b) found.push_back(Mesh::previous(corner));
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace brushfire
