// One-to-four subdivision.
#include <brushfire/mesh/subdivide.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/random.h>
#include <brushfire/core/error.h>

#include <vector>

namespace brushfire {
namespace {

Vec3 new_vertex(const Mesh& mesh, Index h, const SubdivisionOptions& options, Random& random) {
  const auto p = mesh.positions();
  const Vec3 a = p[mesh.from(h)], b = p[mesh.to(h)];
  const Index g = mesh.opposite()[h];
  Vec3 q = 0.5 * a + 0.5 * b;
  if (options.rule == SubdivisionRule::LoopOdd && g != h && mesh.opposite()[g] == h) {
    const Vec3 c = p[mesh.from(Mesh::previous(h))], d = p[mesh.from(Mesh::previous(g))];
    q = 0.375 * (a + b) + 0.125 * (c + d);
  }
  if (options.noise != 0) {
    const double reach = options.noise * norm(b - a);
    q = q + Vec3{random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
  }
  return q;
}

}  // namespace

Shape subdivided(const Mesh& mesh, const SubdivisionOptions& options) {
  if (!mesh.has_positions()) throw Error(ErrorCode::InvalidArgument, "a mesh without positions cannot be subdivided");
  if (mesh.face_count() > kNoIndex / 12 || mesh.vertex_count() > kNoIndex - mesh.halfedge_count() - 1) {
    throw Error(ErrorCode::TooLarge, "the subdivided mesh does not fit into 32-bit indices");
  }
  Shape s;
  s.positions.assign(mesh.positions().begin(), mesh.positions().end());
  s.faces.reserve(4 * std::size_t{mesh.face_count()});
  std::vector<Index> middle(mesh.halfedge_count(), kNoIndex);
  Random random(options.seed);
  Poll poll;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    poll();
    if (middle[h] != kNoIndex || !mesh.is_face_usable(Mesh::face_of(h))) continue;
    const Index v = static_cast<Index>(s.positions.size());
    s.positions.push_back(new_vertex(mesh, h, options, random));
    for (Index g = h; middle[g] == kNoIndex; g = mesh.opposite()[g]) middle[g] = v;
  }
  for (Index f = 0; f < mesh.face_count(); ++f) {
    poll();
    const Face& t = mesh.faces()[f];
    if (!mesh.is_face_usable(f)) {
      s.faces.push_back(t);
      continue;
    }
    const Index ab = middle[3 * f], bc = middle[3 * f + 1], ca = middle[3 * f + 2];
    s.faces.insert(s.faces.end(), {{ab, bc, ca}, {t[0], ab, ca}, {t[1], bc, ab}, {t[2], ca, bc}});
  }
  return s;
}

}  // namespace brushfire
