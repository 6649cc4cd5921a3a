// Walks along edges of one face, round the vertices between them.
#include <brushfire/mesh/boundaries.h>

#include <brushfire/core/detail/sort.h>
#include <brushfire/core/error.h>

#include <algorithm>
#include <string>

namespace brushfire {
namespace {

class Walk {
 public:
  explicit Walk(const Mesh& mesh) : mesh_(mesh), opposite_(mesh.opposite()), used_(mesh.halfedge_count(), 0) {}

  std::vector<Boundary> all() {
    std::vector<Boundary> found;
    for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
      if (is_boundary(h) && !used_[h]) found.push_back(from(h));
    }
    return found;
  }

 private:
  bool is_boundary(Index h) const { return opposite_[h] == h && mesh_.is_face_usable(Mesh::face_of(h)); }

  // The boundary edge that follows h at vertex v, one of its ends: around the faces there. kNoIndex: none does.
  Index next(Index h, Index v) const {
    const std::size_t most = mesh_.corners(v).size();
    for (std::size_t step = 0; step <= most; ++step) {
      // The other edge of the face at v.
      const Index other = mesh_.from(h) == v ? Mesh::previous(h) : Mesh::next(h);
      if (is_boundary(other)) return other;
      const Index across = opposite_[other];
      if (opposite_[across] != other) return kNoIndex;  // three faces: which way is on?
      h = across;
    }
    return kNoIndex;
  }

  double length(Index h) const { return mesh_.length(h) * mesh_.unit(); }

  // From h's end on; where that does not come back, from its start backwards, too.
  Boundary from(Index h) {
    Boundary b{{mesh_.from(h)}, 0, false};
    Index last = follow(h, mesh_.to(h), b);
    b.closed = last != kNoIndex;
    if (!b.closed) {
      std::reverse(b.vertices.begin(), b.vertices.end());
      const Index before = next(h, mesh_.from(h));
      if (before != kNoIndex && !used_[before]) {
        follow(before, mesh_.from(before) == mesh_.from(h) ? mesh_.to(before) : mesh_.from(before), b);
      }
      std::reverse(b.vertices.begin(), b.vertices.end());
      return b;
    }
    const auto lowest = std::min_element(b.vertices.begin(), b.vertices.end());
    std::rotate(b.vertices.begin(), lowest, b.vertices.end());
    return b;
  }

  // Along h, which ends at v, and on. What comes back to where it began: the first edge; kNoIndex: it ended.
  Index follow(Index h, Index v, Boundary& b) {
    const Index first = h;
    while (true) {
      used_[h] = 1;
      b.length += length(h);
      const Index on = next(h, v);
      if (on == first && b.vertices.front() == v) return first;
      b.vertices.push_back(v);
      if (on == kNoIndex || used_[on]) return kNoIndex;
      v = mesh_.from(on) == v ? mesh_.to(on) : mesh_.from(on);
      h = on;
    }
  }

  const Mesh& mesh_;
  std::span<const Index> opposite_;
  std::vector<char> used_;
};

}  // namespace

std::vector<Boundary> boundaries(const Mesh& mesh) {
  std::vector<Boundary> found = Walk(mesh).all();
  detail::stable_sort(found.begin(), found.end(), [](const Boundary& a, const Boundary& b) {
    if (a.length != b.length) return a.length > b.length;
    return *std::min_element(a.vertices.begin(), a.vertices.end()) <
           *std::min_element(b.vertices.begin(), b.vertices.end());
  });
  return found;
}

std::vector<Boundary> boundaries_of(const Mesh& mesh, std::span<const Index> faces) {
  for (const Index f : faces) {
    if (f >= mesh.face_count()) {
      throw Error(ErrorCode::IndexOutOfRange,
                  "face " + std::to_string(f) + " does not exist: the mesh has " + std::to_string(mesh.face_count()));
    }
  }
  return boundaries(mesh.with_faces(faces));
}

}  // namespace brushfire
