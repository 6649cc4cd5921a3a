// Weights by inner numbers.
#include <brushfire/solvers/refraction/detail/medium.h>
#include <brushfire/solvers/refraction/detail/refract.h>

#include <algorithm>
#include <limits>

namespace brushfire::refraction {
namespace {

constexpr unsigned kOnePart = 31;
// Where lengths are known worse than this, as a share of the shortest edge, doubles do not do.
constexpr double kDoubtAllowed = 1e-6;
// What refractions along a path may add up to: roundings of either sign grow with the root of their number.
constexpr double kRefractions = 64;

}  // namespace

Medium::Medium(const steiner::WeightedMesh& weighted) : structure(weighted.mesh(), kOnePart) {
  const auto faces = static_cast<Index>(structure.faces.size());
  weight.resize(faces);
  along.resize(std::size_t{3} * faces);
  is_border.assign(std::size_t{3} * faces, 0);
  is_pivot.assign(structure.vertex_count(), 0);
  double least = kInfinity, most = 0;
  for (Index f = 0; f < faces; ++f) {
    const Index outer = structure.outer_face(f);
    weight[f] = weighted.face_weight(outer);
    least = std::min(least, weight[f]);
    most = std::max(most, weight[f]);
    for (Index k = 0; k < 3; ++k) along[3 * f + k] = weighted.edge_weight(weighted.edges().edge(3 * outer + k));
  }
  for (Index h = 0; h < 3 * faces; ++h) {
    const windows::WindowFace& f = structure.faces[h / 3];
    bool border = along[h] < weight[h / 3];
    for (Index g = f.opposite[h % 3]; g != h; g = structure.faces[g / 3].opposite[g % 3]) {
      border = border || weight[g / 3] != weight[h / 3];
    }
    is_border[h] = border;
    if (border) is_pivot[f.vertex[h % 3]] = is_pivot[f.vertex[windows::next3(h % 3)]] = 1;
  }
  bucket_width = structure.bucket_width * weighted.mean_weight();
  rounding = windows::rounding_of(structure.unevenness);
  rounding.absolute *= most;
  if (least > 0) rounding.density /= least;  // faces by cost: where the cheapest is paid, a path is the longest
  rounding.relative +=
      kRefractions * std::numeric_limits<double>::epsilon() * farthest_source(most > 0 ? least / most : 1);
  followable = faces > 0 && weighted.all_bridges().empty() && weighted.is_isotropic() && most < kInfinity &&
               rounding.doubt <= kDoubtAllowed;
}

}  // namespace brushfire::refraction
