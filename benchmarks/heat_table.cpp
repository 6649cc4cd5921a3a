// What docs/heat.md says in numbers: how far the heat method is from the exact distance and from the smooth truth, what
// it makes of several sources, and what it costs.
//
//     build/benchmark/benchmarks/heat_table [MESH ...]
#include <brushfire/brushfire.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <random>
#include <string>

namespace {

using namespace brushfire;

// Of this process, so that what else runs on the machine does not count.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Errors {
  double mean = 0, most = 0;  // relative to the truth, and to its largest value
};

Errors errors_of(const std::vector<double>& values, const std::vector<double>& truth) {
  Errors e;
  double count = 0, largest = 0;
  for (std::size_t v = 0; v < truth.size(); ++v) {
    if (!(truth[v] > 0 && truth[v] < kInfinity)) continue;
    e.mean += std::abs(values[v] - truth[v]) / truth[v];
    e.most = std::max(e.most, std::abs(values[v] - truth[v]));
    largest = std::max(largest, truth[v]);
    ++count;
  }
  return {count > 0 ? e.mean / count : 0, largest > 0 ? e.most / largest : 0};
}

std::vector<double> field(const Mesh& mesh, const std::vector<Source>& sources, Method method, double factor = 1) {
  DistanceOptions options;
  options.method = method;
  options.heat.time_factor = factor;
  return distance(mesh, sources, options).distance;
}

void against_the_sphere() {
  std::printf(
      "| vertices | mean edge | exact on the faces | heat, t = h^2 | 4 h^2 | 16 h^2 |\n|---|---|---|---|---|---|\n");
  for (const Index levels : {3u, 4u, 5u, 6u}) {
    const Mesh mesh = shapes::icosphere(levels).mesh();
    const Index from = 7;
    const Vec3 pole = mesh.positions()[from];
    std::vector<double> truth;
    for (const Vec3& p : mesh.positions()) truth.push_back(std::atan2(norm(cross(p, pole)), dot(p, pole)));
    const std::vector<Source> source{{vertex_point(mesh, from)}};
    std::printf("| %u | %.3f | %.2g %% ", mesh.vertex_count(), mesh.report().mean_edge_length,
                100 * errors_of(field(mesh, source, Method::Exact), truth).mean);
    for (const double factor : {1.0, 4.0, 16.0}) {
      std::printf("| %.2g %% ", 100 * errors_of(field(mesh, source, Method::Heat, factor), truth).mean);
    }
    std::printf("|\n");
  }
}

void against_exact(const std::string& name, const Mesh& mesh) {
  const std::vector<Source> source{{vertex_point(mesh, 0)}};
  const std::vector<double> truth = field(mesh, source, Method::Exact);
  std::printf("| %s | %u ", name.c_str(), mesh.vertex_count());
  const Errors marched = errors_of(field(mesh, source, Method::NovotniKlein), truth);
  std::printf("| %.2g %%, %.2g %% ", 100 * marched.mean, 100 * marched.most);
  for (const double factor : {1.0, 4.0, 16.0}) {
    const Errors e = errors_of(field(mesh, source, Method::Heat, factor), truth);
    std::printf("| %.2g %%, %.2g %% ", 100 * e.mean, 100 * e.most);
  }
  std::mt19937 random(3);
  std::vector<Source> many;
  for (int i = 0; i < 100; ++i) {
    const Face t = mesh.faces()[std::uniform_int_distribution<Index>(0, mesh.face_count() - 1)(random)];
    many.push_back({vertex_point(mesh, t[0])});
  }
  std::printf("| %.2g %% ", 100 * errors_of(field(mesh, many, Method::Heat), field(mesh, many, Method::Exact)).mean);

  double begin = processor_seconds();
  const HeatSolver solver(Mesh(mesh.positions(), mesh.faces()));
  const double set_up = processor_seconds() - begin;
  std::vector<std::vector<Source>> sets(64, source);
  begin = processor_seconds();
  for (int i = 0; i < 16; ++i) solver.distance(source);
  const double one = (processor_seconds() - begin) / 16;
  begin = processor_seconds();
  solver.distances(sets);
  const double eight = (processor_seconds() - begin) / 64;
  std::printf("| %.0f | %.1f | %.1f |\n", 1e3 * set_up, 1e3 * one, 1e3 * eight);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    against_the_sphere();
    std::printf(
        "\n| mesh | vertices | novotni-klein | heat, t = h^2 | 4 h^2 | 16 h^2 | 100 sources | set-up, ms | one field "
        "| of eight |\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 1; i < argc; ++i) {
      const std::string path = argv[i];
      against_exact(path.substr(path.find_last_of('/') + 1), read_mesh(path).mesh);
    }
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "heat_table: %s\n", e.what());
    return 1;
  }
}
