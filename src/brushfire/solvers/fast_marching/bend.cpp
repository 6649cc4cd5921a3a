// Angle deficits and areas around vertices, smoothed once.
#include <brushfire/solvers/fast_marching/bend.h>

#include <algorithm>
#include <cmath>

namespace brushfire::detail {
namespace {

// atan2(y, x) for y >= 0 to 2e-8. Based on: Abramowitz, Stegun (1964), Handbook of Mathematical Functions, 4.4.49.
double quick_angle(double x, double y) {
  const double ax = std::abs(x);
  const double larger = std::max(ax, y), smaller = std::min(ax, y);
  const double t = larger > 0 ? smaller / larger : 0, u = t * t;
  double p = 0.0028662257;
  for (const double c :
       {-0.0161657367, 0.0429096138, -0.0752896400, 0.1065626393, -0.1420889944, 0.1999355085, -0.3333314528, 1.0}) {
    p = p * u + c;
  }
  double angle = p * t;
  if (y > ax) angle = 0.5 * kPi - angle;
  return x < 0 ? kPi - angle : angle;
}

struct Patch {
  double deficit = 0, area = 0;
};

}  // namespace

std::vector<double> front_bend(const Mesh& mesh) {
  const auto lengths = mesh.lengths();
  const auto faces = mesh.faces();
  const auto links = mesh.links();
  std::vector<Patch> own(mesh.vertex_count());
  for (Patch& p : own) p.deficit = 2 * kPi;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const double a = lengths[3 * f], b = lengths[3 * f + 1], c = lengths[3 * f + 2];
    const double aa = a * a, bb = b * b, cc = c * c, area = mesh.double_areas()[f];
    const std::array<double, 3> cosine{0.5 * (aa + cc - bb), 0.5 * (aa + bb - cc), 0.5 * (bb + cc - aa)};
    for (std::size_t k = 0; k < 3; ++k) {
      own[faces[f][k]].deficit -= quick_angle(cosine[k], area);
      own[faces[f][k]].area += area / 6;
    }
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (links[v] != Link::Circle || std::abs(own[v].deficit) < kFlat) own[v].deficit = 0;
  }
  std::vector<Patch> around = own;
  for (const Face& t : faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      around[t[k]].deficit += own[t[(k + 1) % 3]].deficit;
      around[t[k]].area += own[t[(k + 1) % 3]].area;
    }
  }
  // From one vertex to the next a front makes half an altitude in the mean: of the square root of a vertex's area.
  constexpr double kStep = 0.4;
  std::vector<double> bend(mesh.vertex_count(), 0.0);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (around[v].area > 0) bend[v] = kStep * around[v].deficit / around[v].area * std::sqrt(own[v].area);
  }
  return bend;
}

}  // namespace brushfire::detail
