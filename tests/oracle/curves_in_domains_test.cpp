// Curves among polygonal holes of the plane beside the visibility graph: holes that are not there, and holes as walls.
#include "oracle/planar_domain.h"

#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace brushfire::oracle {
namespace {

// Distances are thousands; a centroid is named by three thirds, which are none.
constexpr double kRelative = 1e-12, kPlaces = 1e-12;

struct DrawnCurve {
  std::vector<LatticePoint> at;
  CurveSource on;
};

DrawnCurve random_curve(const PlanarDomain& domain, const Mesh& mesh, std::mt19937& random) {
  DrawnCurve curve;
  const auto add = [&](const DomainPoint& p) {
    curve.at.push_back(p.at);
    curve.on.places.push_back(p.on);
  };
  add(random_point(domain, random));
  for (unsigned steps = 1 + random() % 8; steps > 0; --steps) {
    const std::vector<Index> faces = faces_at(mesh, locate(mesh, curve.on.places.back()));
    add(random_point(domain, faces[random() % faces.size()], random));
  }
  if (random() % 3 == 0) {  // there and back: closed
    for (std::size_t i = curve.at.size() - 1; i-- > 0;) add({curve.at[i], curve.on.places[i]});
  }
  return curve;
}

void expect_same(const DistanceField& field, const std::vector<long double>& truth, const std::string& where) {
  for (std::size_t v = 0; v < truth.size(); ++v) {
    const auto expected = static_cast<double>(truth[v]);
    if (!std::isfinite(expected)) {
      EXPECT_EQ(field.distance[v], kInfinity) << where << ", vertex " << v;
    } else {
      EXPECT_NEAR(field.distance[v], expected, kRelative * expected + kPlaces) << where << ", vertex " << v;
    }
  }
}

TEST(CurvesAmongHoles, AreAsFarAsTheVisibilityGraphSays) {
  int walled_domains = 0;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    std::mt19937 random(seed);
    const PlanarDomain domain = random_domain(random, 2 + static_cast<int>(seed % 2), 3, seed % 5 == 0);
    const Mesh mesh = domain.mesh();
    const DrawnCurve curve = random_curve(domain, mesh, random);
    const std::vector<Source> sources{source_along(curve.on)};
    const std::vector<long double> truth = visibility_distances(domain, curve.at);
    expect_same(distance(mesh, sources, {.method = Method::Exact}), truth, "seed " + std::to_string(seed));
    // The holes' faces behind the domain's, closed: the same numbers.
    PlanarDomain whole = domain;
    whole.faces.insert(whole.faces.end(), domain.removed.begin(), domain.removed.end());
    std::vector<Index> holes(domain.removed.size());
    std::iota(holes.begin(), holes.end(), static_cast<Index>(domain.faces.size()));
    const Domain walled(whole.mesh(), {.faces = holes});
    // Where holes touch in a vertex only, walls are tight there, and the graph goes through.
    if (walled.open().vertex_count() > mesh.vertex_count()) continue;
    ++walled_domains;
    expect_same(distance(walled, sources, {.method = Method::Exact}), truth, "walls, seed " + std::to_string(seed));
  }
  EXPECT_GE(walled_domains, 500);
}

}  // namespace
}  // namespace brushfire::oracle
