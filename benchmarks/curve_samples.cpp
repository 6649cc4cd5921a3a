// Whether a curve is what dense points along it converge to: exact distances from both, at every vertex.
//
//   curve_samples [--limit VERTICES] MESH|FOLDER...
//
// One line per mesh: a curve of straight geodesics, as itself and as 4, 8, 16 and 32 points on each of its segments.
// Points are never nearer than the curve (violations, by more than both fields' bounds), at most half their spacing
// farther (the largest excess as a share of that), and away from the curve the mean excess falls by four with every
// halving: order 2. Away are the vertices whose paths leave the curve straight for more than four of the coarsest
// spacings; a path that bends sooner misses more. Where the nearest places fall between points is chance: all of it is
// for points that begin at six places of their spacing. The exit code says whether it holds. Meshes of fewer than
// 100 and more than VERTICES (60000) are left out, and so are files of a folder that cannot be read.
#include <brushfire/core/error.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/window_field.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "curves/random_curves.h"
#include "curves/samples.h"
#include "measure.h"
#include "mesh_files.h"

namespace brushfire::benchmark {
namespace {

namespace fs = std::filesystem;

constexpr std::array kPieces{4, 8, 16, 32};
constexpr std::size_t kMostPlaces = 60;
constexpr int kPhases = 6;
constexpr Index kFewest = 100;  // vertices that a mean says something of
// The order that a mesh may measure: some vertices are near enough for the next one to show.
constexpr double kLeastOrder = 1.65, kMostOrder = 2.35;

struct Excess {
  double mean = 0;           // away from the curve, as a share of the mean distance there
  double largest_share = 0;  // anywhere, of half the spacing
  std::size_t violations = 0;
};

// The places, and `pieces` points on each segment, the first one `phase` of their spacing from its beginning.
std::vector<Source> points_along(const Mesh& mesh, const CurveSource& curve, int pieces, double phase) {
  std::vector<Source> points;
  for (const SurfacePoint& p : curve.places) points.push_back({p});
  for (const CurveSegment& s : locate(mesh, curve).segments) {
    for (int i = 0; i < pieces; ++i) {
      const double t = (i + phase) / pieces;
      SurfacePoint& p = points.emplace_back(Source{{s.face, {0, 0, 0}}}).point;
      for (std::size_t k = 0; k < 3; ++k) p.weights[k] = (1 - t) * s.from[k] + t * s.to[k];
    }
  }
  return points;
}

// How long the piece of each vertex's path is that begins at the curve; 0 where there is none.
std::vector<double> first_legs(const WindowField& paths) {
  std::vector<double> length(paths.mesh().vertex_count(), -1);
  std::vector<Index> chain;
  for (Index v = 0; v < length.size(); ++v) {
    chain.clear();
    double found = 0;
    for (Index at = v; at != kNoIndex;) {
      if (length[at] >= 0) {
        found = length[at];
        break;
      }
      chain.push_back(at);
      const WindowField::Leg leg = paths.last_leg(at);
      found = leg.length;
      at = leg.vertex;
    }
    for (const Index u : chain) length[u] = found;
  }
  return length;
}

Excess excess(DistanceSolver& solver, const CurveSource& curve, const DistanceField& field, int pieces, double phase,
              std::span<const char> is_away) {
  const Mesh& mesh = solver.mesh();
  const DistanceField sampled = solver.distance(points_along(mesh, curve, pieces, phase), {.method = Method::Exact});
  const double half_spacing = 0.5 * test::longest_segment(mesh, curve) / pieces;
  Excess e;
  double sum = 0, distance = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double d = field.distance[v], more = sampled.distance[v] - d;
    if (d == kInfinity && sampled.distance[v] == kInfinity) continue;
    const double rounding = field.error_bound[v] + sampled.error_bound[v];
    if (!(more >= -rounding) || !(more <= half_spacing + rounding)) ++e.violations;
    e.largest_share = std::max(e.largest_share, more / half_spacing);
    if (!is_away[v]) continue;
    sum += more;
    distance += d;
  }
  e.mean = distance > 0 ? sum / distance : 0;
  return e;
}

// Two straight sides, from a face in the middle of the list, as far as kMostPlaces go.
CurveSource curve_on(const Mesh& mesh) {
  std::mt19937 random(1);
  const double size = norm(mesh.bounds().high - mesh.bounds().low);
  CurveSource curve;
  for (int tries = 0; tries < 100 && curve.places.size() < 8; ++tries) {
    curve.places = test::random_polygon(mesh, 2, 0.3 * size, random);
  }
  curve.places.resize(std::min(curve.places.size(), kMostPlaces));
  return curve;
}

// Whether all is as it should be.
bool row_of(const std::string& name, const Mesh& mesh) {
  DistanceSolver solver(mesh);
  const CurveSource curve = curve_on(mesh);
  const DistanceField field =
      solver.distance(std::vector{source_along(curve)}, {.method = Method::Exact, .keep_paths = true});
  const double far = 4 * test::longest_segment(mesh, curve) / kPieces.front();
  std::vector<char> is_away;
  for (const double length : first_legs(*field.windows)) is_away.push_back(length > far);
  std::array<double, kPieces.size()> mean{};
  std::size_t violations = 0;
  double largest_share = 0;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    for (int k = 0; k < kPhases; ++k) {
      const Excess e = excess(solver, curve, field, kPieces[i], (k + 0.5) / kPhases, is_away);
      mean[i] += e.mean / kPhases;
      violations += e.violations;
      largest_share = std::max(largest_share, e.largest_share);
    }
  }
  const double order = std::log2(mean[mean.size() - 2] / mean.back());  // of the last halving
  std::printf("| %s | %u | %zu |", name.c_str(), mesh.vertex_count(), curve.places.size() - 1);
  for (const double m : mean) std::printf(" %.2e |", m);
  std::printf(" %.2f | %.2f | %zu |\n", order, largest_share, violations);
  std::fflush(stdout);
  return violations == 0 && order >= kLeastOrder && order <= kMostOrder;
}

bool has_usable_faces(const Mesh& mesh) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (mesh.is_face_usable(f)) return true;
  }
  return false;
}

int run(int count, char** arguments) {
  const auto [limit, files] = MeshArguments(count, arguments, 60'000);
  std::printf(
      "| mesh | vertices | segments | mean excess: 4 | 8 | 16 | 32 points | order | largest / half spacing |"
      " violations |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  int meshes = 0, wrong = 0;
  const auto add = [&](const std::string& name, const Mesh& mesh) {
    ++meshes;
    wrong += !row_of(name, mesh);
  };
  add("folded sphere (made)", shapes::folded_sphere(5).mesh());
  add("noise terrain (made)", shapes::noise_terrain(100, 100, 0.3).mesh());
  for (const fs::path& file : files) {
    try {
      const Mesh mesh = read_mesh(file.string()).mesh;
      if (mesh.vertex_count() < kFewest || mesh.vertex_count() > limit || !has_usable_faces(mesh)) continue;
      add(file.stem().string(), mesh);
    } catch (const Error& e) {
      std::fprintf(stderr, "%s: %s\n", file.c_str(), e.what());
    }
  }
  std::printf("\n%d meshes, %d of them not as they should be\n", meshes, wrong);
  return wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace brushfire::benchmark

int main(int count, char** arguments) {
  return brushfire::benchmark::guarded("curve_samples", brushfire::benchmark::run, count, arguments);
}
