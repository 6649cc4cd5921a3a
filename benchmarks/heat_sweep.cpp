// Everything that is done by heat on every mesh named: distances, values, vectors, logarithmic maps, signed distances.
// None may be NaN, or infinite where a path leads; a surface that vectors cannot lie on is refused. One line a mesh;
// ends with 1 where one fails.
//
//     build/benchmark/benchmarks/heat_sweep MESH ...
#include <brushfire/brushfire.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace {

using namespace brushfire;

std::vector<double> field(const Mesh& mesh, const std::vector<Source>& sources, Method method) {
  DistanceOptions options;
  options.method = method;
  return distance(mesh, sources, options).distance;
}

struct Verdict {
  std::size_t wrong = 0;  // values
  double mean = 0;        // relative error of one field
};

// Against paths along edges: finite where these are, no error looked for.
std::size_t not_finite(const std::vector<double>& values, const std::vector<double>& reached) {
  std::size_t wrong = 0;
  for (std::size_t v = 0; v < values.size(); ++v) {
    const bool is_right = reached[v] < kInfinity ? std::isfinite(values[v]) : values[v] == kInfinity;
    if (!is_right) ++wrong;
  }
  return wrong;
}

std::vector<Index> vertices_of(const Mesh& mesh) {
  std::vector<Index> used;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.corners(v).empty()) used.push_back(v);
  }
  return used;
}

Verdict distances_on(const Mesh& mesh, const std::vector<Index>& used) {
  Verdict verdict;
  const auto at = [&](std::size_t k) { return Source{vertex_point(mesh, used[k * (used.size() - 1) / 3])}; };
  for (const std::vector<Source>& sources :
       {std::vector{at(0)}, std::vector{at(2)}, std::vector{at(0), at(1), at(3)}}) {
    const std::vector<double> heat = field(mesh, sources, Method::Heat);
    const std::vector<double> reached = field(mesh, sources, Method::Dijkstra);
    verdict.wrong += not_finite(heat, reached);
    for (const Source& s : sources) {
      const Index v = mesh.faces()[s.point.face][s.point.weights[0] == 1 ? 0 : s.point.weights[1] == 1 ? 1 : 2];
      if (heat[v] != 0) ++verdict.wrong;
    }
  }
  const std::vector<double> heat = field(mesh, {at(0)}, Method::Heat), truth = field(mesh, {at(0)}, Method::Exact);
  double count = 0;
  for (std::size_t v = 0; v < truth.size(); ++v) {
    if (!(truth[v] > 0 && truth[v] < kInfinity)) continue;
    verdict.mean += std::abs(heat[v] - truth[v]) / truth[v];
    ++count;
  }
  if (count > 0) verdict.mean /= count;
  return verdict;
}

std::size_t vectors_on(const Mesh& mesh, const std::vector<Index>& used) {
  const Index from = used[used.size() / 2];
  const std::vector<double> reached = field(mesh, {Source{vertex_point(mesh, from)}}, Method::Dijkstra);
  std::size_t wrong = 0;
  const auto look = [&](const std::vector<std::complex<double>>& z) {
    for (std::size_t v = 0; v < z.size(); ++v) {
      if (reached[v] < kInfinity && !std::isfinite(std::abs(z[v]))) ++wrong;
    }
  };
  VectorHeatSolver vectors(mesh);
  const std::vector<Index> sources{from, used.front() == from ? used.back() : from};
  look(vectors.transport(sources, std::vector<std::complex<double>>{{1, 0}, {0, 2}}));
  const std::vector<double> values = vectors.extend(sources, std::vector<double>{1, 3});
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (reached[v] < kInfinity && !(values[v] >= 1 && values[v] <= 3)) ++wrong;
  }
  for (const LogMapStrategy strategy :
       {LogMapStrategy::VectorHeat, LogMapStrategy::AffineLocal, LogMapStrategy::AffineAdaptive}) {
    look(vectors.log_map(from, strategy));
  }
  SignedHeatSolver curves(mesh);
  const Index other = mesh.to(mesh.corners(from).front());
  const std::vector<SignedCurve> edge{{{vertex_point(mesh, from), vertex_point(mesh, other)}}};
  wrong += not_finite(curves.distance(edge), reached);
  return wrong;
}

bool is_fine(const std::string& name) {
  const Mesh mesh = read_mesh(name).mesh;
  const std::vector<Index> used = vertices_of(mesh);
  if (used.empty()) return true;
  const Verdict distances = distances_on(mesh, used);
  std::string vectors;
  std::size_t wrong = distances.wrong;
  try {
    const std::size_t bad = vectors_on(mesh, used);
    vectors = bad == 0 ? "finite" : std::to_string(bad) + " WRONG";
    wrong += bad;
  } catch (const Error& error) {
    vectors = std::string("refused: ") + error.what();
  }
  std::printf("%s: %u vertices, distances %s (%.2g %% off), vectors %s\n", name.c_str(), mesh.vertex_count(),
              distances.wrong == 0 ? "finite" : (std::to_string(distances.wrong) + " WRONG").c_str(),
              100 * distances.mean, vectors.c_str());
  std::fflush(stdout);
  return wrong == 0;
}

}  // namespace

int main(int count, char** names) {
  int failed = 0, tried = 0;
  for (int i = 1; i < count; ++i) {
    try {
      ++tried;
      if (!is_fine(names[i])) ++failed;
    } catch (const std::exception& error) {
      std::printf("%s: %s\n", names[i], error.what());
    }
  }
  std::printf("%d meshes, %d with a value that is not finite\n", tried, failed);
  return failed == 0 ? 0 : 1;
}
