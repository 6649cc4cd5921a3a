// Which vertices a source is beside.
#include <brushfire/solvers/windows/propagation/circled_faces.h>

#include <brushfire/solvers/windows/propagation/targets.h>

#include <algorithm>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// As a share of the longest edge at the vertex. A face that is not thin turns the source about the vertex by 1e-3 or
// more and rounds its place by two epsilons of that edge, so from 4e-13 on it comes to lie behind an edge sooner or
// later; the rest is for what several roundings add up to, and so that light goes round a needle's tip some thousand
// times at most.
constexpr double kBeside = 1e-9;

}  // namespace

void CircledFaces::mark(std::span<const detail::LocatedSource> sources, WindowStructure& structure) {
  clear(structure);
  for (const detail::LocatedSource& s : sources) {
    if (!s.curve) {
      mark(s.at, structure);
      continue;
    }
    for (const CurvePlace& p : s.curve->places) mark(p.at, structure);
  }
}

void CircledFaces::clear(WindowStructure& structure) {
  for (const Index f : faces_) structure.faces[f].thin = false;
  faces_.clear();
}

void CircledFaces::mark(const PointLocation& at, WindowStructure& structure) {
  if (kWide || at.on == PointLocation::On::Vertex) return;  // wide windows remember all faces
  for_each_face_around(structure.mesh, at, [&](const FaceWeights& f) {
    const Index face = structure.inner_face(f.face);
    const std::array<Real, 3> distance = corner_distances_of(structure, {face, f.weights});
    for (Index k = 0; k < 3; ++k) {
      if (distance[k] < kBeside * structure.unevenness.longest())
        mark(structure.faces[face].vertex[k], distance[k], structure);
    }
  });
}

void CircledFaces::mark(Index v, Real distance, WindowStructure& structure) {
  const std::span<const Index> corners = structure.corners_of(v, corners_);
  Real longest = 0;
  for (const Index h : corners) {
    const WindowFace& f = structure.faces[h / 3];
    longest = std::max({longest, f.length[0], f.length[1], f.length[2]});
  }
  if (!(distance < kBeside * longest)) return;
  for (const Index h : corners) {
    WindowFace& f = structure.faces[h / 3];
    if (!f.thin) faces_.push_back(h / 3);
    f.thin = true;
  }
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
