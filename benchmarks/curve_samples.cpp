// Whether a curve is what dense points along it converge to: exact distances from both, at every vertex.
//
//   curve_samples [--limit VERTICES] MESH|FOLDER...
//
// One line per mesh: a curve of straight geodesics, as itself and as points that part each of its segments into 2, 4, 8
// and 16. Points are never nearer than the curve (violations, by more than both fields' bounds), at most half their
// spacing farther (the largest excess as a share of that), and away from the curve, at more than four of the coarsest
// spacings, the mean excess falls by four with every halving: order 2. The exit code says whether all of that holds.
// Meshes of more than VERTICES (60000) are left out, and so are files of a folder that cannot be read.
#include <brushfire/core/error.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/distance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>

#include "curves/random_curves.h"
#include "curves/samples.h"
#include "mesh_files.h"

namespace brushfire::benchmark {
namespace {

namespace fs = std::filesystem;

constexpr std::array kPieces{2, 4, 8, 16};
constexpr std::size_t kMostPlaces = 60;
// The order that a mesh may measure: where the nearest points fall between the samples is chance.
constexpr double kLeastOrder = 1.8, kMostOrder = 2.2;

struct Excess {
  double mean = 0;           // away from the curve, as a share of the mean distance there
  double largest_share = 0;  // anywhere, of half the spacing
  std::size_t violations = 0;
};

Excess excess(DistanceSolver& solver, const CurveSource& curve, const DistanceField& field, int pieces, double far) {
  const Mesh& mesh = solver.mesh();
  const DistanceField sampled = solver.distance(test::samples(mesh, curve, pieces), {.method = Method::Exact});
  const double half_spacing = 0.5 * test::longest_segment(mesh, curve) / pieces;
  Excess e;
  double sum = 0, distance = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double d = field.distance[v], more = sampled.distance[v] - d;
    if (d == kInfinity && sampled.distance[v] == kInfinity) continue;
    const double rounding = field.error_bound[v] + sampled.error_bound[v];
    if (!(more >= -rounding) || !(more <= half_spacing + rounding)) ++e.violations;
    e.largest_share = std::max(e.largest_share, more / half_spacing);
    if (!(d > far)) continue;
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
  const DistanceField field = solver.distance(std::vector{source_along(curve)}, {.method = Method::Exact});
  const double far = 4 * test::longest_segment(mesh, curve) / kPieces.front();
  std::array<Excess, kPieces.size()> all;
  std::size_t violations = 0;
  double largest_share = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = excess(solver, curve, field, kPieces[i], far);
    violations += all[i].violations;
    largest_share = std::max(largest_share, all[i].largest_share);
  }
  const double order = std::log2(all.front().mean / all.back().mean) / static_cast<double>(all.size() - 1);
  std::printf("| %s | %u | %zu |", name.c_str(), mesh.vertex_count(), curve.places.size() - 1);
  for (const Excess& e : all) std::printf(" %.2e |", e.mean);
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
  Index limit = 60'000;
  std::vector<fs::path> files;
  for (int i = 1; i < count; ++i) {
    if (std::string(arguments[i]) == "--limit" && i + 1 < count) {
      limit = static_cast<Index>(std::stoul(arguments[++i]));
      continue;
    }
    for (fs::path& file : files_of(arguments[i])) files.push_back(std::move(file));
  }
  std::printf(
      "| mesh | vertices | segments | mean excess: 2 | 4 | 8 | 16 pieces | order | largest / half spacing |"
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
      if (mesh.vertex_count() > limit || !has_usable_faces(mesh)) continue;
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
  try {
    return brushfire::benchmark::run(count, arguments);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "curve_samples: %s\n", e.what());
    return 2;
  }
}
