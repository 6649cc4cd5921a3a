// Sheets that lie on each other: random complexes doubled, tripled, partly doubled, and with isometric copies of their
// surfaces glued on along random vertices and edges, against the oracle.
#include "oracle/deviation.h"
#include "oracle/zoo.h"
#include "support/good_paths.h"

#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/window_field.h>
#include <brushfire/solvers/windows/engine.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace brushfire::oracle {
namespace {

constexpr double kPromise = 1e-12;

double share(std::mt19937& random) { return std::uniform_real_distribution<double>()(random); }
Index below(std::mt19937& random, std::size_t n) { return static_cast<Index>(random() % n); }

// A face with the lengths of its halfedges.
struct Piece {
  Face corners;
  std::array<double, 3> lengths;

  Piece turned() const { return {{corners[1], corners[2], corners[0]}, {lengths[1], lengths[2], lengths[0]}}; }
  Piece flipped() const { return {{corners[0], corners[2], corners[1]}, {lengths[2], lengths[1], lengths[0]}}; }
};

// One sheet.
Mesh base(std::uint32_t seed) {
  switch (seed % 6) {
    case 0:
      return shapes::noise_terrain(3, 3, 0.7, seed).mesh();
    case 1:
      return shapes::cylinder(1, 4 + seed % 2, 1, 2 + seed % 3).mesh();
    case 2:
      return random_soup(seed, 6 + seed % 3, 6 + seed % 6, 1000);
    case 3:
      return random_intrinsic(seed, 7, 8 + seed % 6);
    case 4:
      return shapes::cube(1).mesh();
    default:
      return fan(5 + seed % 6, seed % 4 < 2, 0.5, 2);
  }
}

// With copies of it, or of some of its faces. A copy has the vertices of the first sheet where it is glued on, and its
// own, at the same places in space (or nowhere, for a mesh from lengths), elsewhere.
Mesh with_copies(const Mesh& mesh, std::mt19937& random) {
  constexpr std::array<double, 6> kGlued{0.15, 0.3, 0.5, 0.7, 0.9, 1};
  const double glued = kGlued[below(random, kGlued.size())], copied = random() % 3 == 0 ? 0.5 : 1;
  std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
  std::vector<Piece> pieces;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    Piece& p = pieces.emplace_back(Piece{mesh.faces()[f], {}});
    for (Index k = 0; k < 3; ++k) p.lengths[k] = mesh.lengths()[3 * f + k] * mesh.unit();
  }
  const std::vector<Piece> sheet = pieces;
  Index vertices = mesh.vertex_count();
  // The oracle, too, is slow on sheets.
  const Index most = mesh.face_count() <= 10 ? 2 : 1;
  for (Index copies = 1 + below(random, most); copies > 0; --copies) {
    std::vector<Index> number(mesh.vertex_count());
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      number[v] = share(random) < glued ? v : vertices++;
      if (number[v] != v && mesh.has_positions()) positions.push_back(positions[v]);
    }
    for (Piece p : sheet) {
      if (share(random) > copied) continue;
      for (Index& v : p.corners) v = number[v];
      for (Index turns = below(random, 3); turns > 0; --turns) p = p.turned();
      pieces.push_back(random() % 2 == 0 ? p.flipped() : p);
    }
  }
  if (random() % 2 == 0) std::shuffle(pieces.begin(), pieces.end(), random);
  std::vector<Face> faces;
  std::vector<std::array<double, 3>> lengths;
  for (const Piece& p : pieces) {
    faces.push_back(p.corners);
    lengths.push_back(p.lengths);
  }
  return mesh.has_positions() && random() % 2 == 0 ? Mesh(positions, faces)
                                                   : Mesh::from_lengths(vertices, faces, lengths);
}

struct Case {
  Mesh mesh;
  std::vector<Source> sources;
  std::vector<SurfacePoint> targets;
};

// Sources and targets of every kind; also in one face, and in faces over the same vertices.
Case random_case(std::uint32_t seed) {
  std::mt19937 random(seed);
  Case c{with_copies(base(seed), random), {}, {}};
  const Mesh& mesh = c.mesh;
  const SurfacePoint inside = random_face_point(mesh, random);
  c.sources = {{random_vertex(mesh, random), 0}, {random_edge_point(mesh, random), 0}, {inside, 0}};
  c.targets = {random_vertex(mesh, random), random_edge_point(mesh, random), random_face_point(mesh, random),
               random_face_point(mesh, random)};
  Face own = mesh.faces()[inside.face];
  std::sort(own.begin(), own.end());
  for (Index f = 0; f < mesh.face_count() && c.targets.size() < 8; ++f) {
    Face t = mesh.faces()[f];
    std::sort(t.begin(), t.end());
    if (t == own) c.targets.push_back({f, {0.2, 0.5, 0.3}});
  }
  return c;
}

// Alone, and together with offsets.
std::vector<std::vector<Source>> runs_of(const Case& c) {
  std::vector<std::vector<Source>> runs;
  for (const Source& s : c.sources) runs.push_back({s});
  runs.push_back(c.sources);
  runs.back()[0].offset = 0.25 * c.mesh.unit();
  runs.back()[1].offset = -0.5 * c.mesh.unit();
  return runs;
}

TEST(Sheets, ExactEqualsTheOracle) {
  for (std::uint32_t seed = 1; seed <= 250; ++seed) {
    const Case c = random_case(seed);
    for (const std::vector<Source>& sources : runs_of(c)) {
      const Deviation d = exact_against_oracle(c.mesh, sources, kInfinity, c.targets);
      EXPECT_TRUE(d.within(kPromise)) << "seed " << seed << ": " << d.text();
    }
  }
}

TEST(Sheets, WindowsMergedAndInPartsOfFourFacesKeepTheirBounds) {
  DistanceOptions options;
  options.tolerance = 1e-3;
  for (std::uint32_t seed = 1; seed <= 150; ++seed) {
    const Case c = random_case(seed);
    const auto engine = windows::make_windows(c.mesh, 2, windows::Merging::Always);
    for (const std::vector<Source>& sources : runs_of(c)) {
      for (const Method method : {Method::Windows, Method::Exact}) {
        options.method = method;
        std::vector<detail::LocatedSource> located;
        for (const Source& s : sources) {
          located.push_back({locate(c.mesh, s.point), s.offset / c.mesh.unit(), static_cast<Index>(located.size())});
        }
        DistanceField field;
        field.distance.assign(c.mesh.vertex_count(), kInfinity);
        field.source.assign(c.mesh.vertex_count(), kNoIndex);
        engine->solve({located, {}, kInfinity, &options, nullptr}, field);
        const Truth truth = polyhedral_distance(c.mesh, sources);
        for (Index v = 0; v < c.mesh.vertex_count(); ++v) {
          const double d = field.distance[v] * c.mesh.unit();
          if (truth.distance[v] == kFar) {
            ASSERT_EQ(d, kInfinity) << "seed " << seed << " vertex " << v;
            continue;
          }
          const double start = sources[field.source[v]].offset;
          const double length = static_cast<double>(truth.distance[v]) - start;
          const double bound = field.error_bound[v] * c.mesh.unit() + 1e-14 * std::abs(start);
          const double off = std::abs(d - static_cast<double>(truth.distance[v]));
          ASSERT_LE(off, bound) << "seed " << seed << " vertex " << v;
          const double promise = method == Method::Exact ? 1e-10 : options.tolerance;  // of rounding on such faces
          ASSERT_LE(bound, 1.01 * promise * length + 1e-13 * c.mesh.unit()) << "seed " << seed << " vertex " << v;
        }
      }
    }
  }
}

TEST(Sheets, ValuesOfPointsInsideOfAnyFaceEqualTheOracle) {
  for (std::uint32_t seed = 1; seed <= 150; ++seed) {
    const Case c = random_case(seed);
    std::mt19937 random(seed + 5000);
    std::vector<SurfacePoint> points = c.targets;
    for (int i = 0; i < 12; ++i) points.push_back(random_face_point(c.mesh, random));
    DistanceOptions options = exact_options();
    options.keep_windows = true;
    for (const std::vector<Source>& sources : runs_of(c)) {
      const DistanceField field = distance(c.mesh, sources, options);
      const Truth truth = polyhedral_distance(c.mesh, sources, kFar, points);
      Deviation worst;
      for (Index i = 0; i < points.size(); ++i) {
        const WindowField::Value at = field.windows->value(points[i]);
        worst.add(Real{at.distance}, truth.target[i], i, c.mesh.unit());
        EXPECT_EQ(at.source == kNoIndex, truth.target[i] == kFar);
      }
      EXPECT_TRUE(worst.within(kPromise)) << "seed " << seed << ": " << worst.text();
    }
  }
}

TEST(Sheets, PathsAreGoodAndAsLongAsTheFieldSays) {
  for (std::uint32_t seed = 1; seed <= 150; ++seed) {
    test::expect_good_paths(random_case(seed).mesh, 10, seed, "sheets");
  }
}

}  // namespace
}  // namespace brushfire::oracle
