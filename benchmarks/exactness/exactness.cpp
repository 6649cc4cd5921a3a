// One table: how far Method::Exact is from every truth there is.
//
//   exactness [truth] [shared] [demo] [zoo] [metric] [--data DIRECTORY] [--demo FILE.tar.gz] [--limit VERTICES]
//
// Without names, all parts. Truth: the known distances of the shared data directory. Shared, demo: the shared meshes
// and the meshes of the Debian package libcgal-demo against the long-double oracle from a vertex, an edge and a face
// point; those with more than `limit` vertices within the radius that holds as many; up to 6000 vertices CGAL is asked
// too. Zoo: hand-built and random complexes, domains with holes. Metric: symmetry on 1035 pairs of points of every
// mesh, the triangle inequality on all their triples, several sources with offsets against the least of the single
// fields. Exit code 1 where anything deviates by more than 1e-12.
#include "oracle/deviation.h"
#include "oracle/planar_domain.h"
#include "oracle/zoo.h"
#include "third_opinion.h"

#include <brushfire/core/error.h>
#include <brushfire/io/npy.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/shapes.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

namespace brushfire::benchmark {
namespace {

using namespace brushfire::oracle;
namespace fs = std::filesystem;

constexpr double kPromise = 1e-12;

struct Settings {
  std::set<std::string> parts;
  fs::path data = BRUSHFIRE_SHARED_DIR;
  fs::path demo = "/usr/share/doc/libcgal-dev/data.tar.gz";
  Index limit = 12'000;
  bool wants(const std::string& part) const { return parts.empty() || parts.count(part) > 0; }
};

class Table {
 public:
  void head(const char* title) {
    std::printf("\n%s\n%-34s %8s %9s %12s %6s  %s\n", title, "case", "vertices", "compared", "deviation", "wrong",
                "remarks");
    std::fflush(stdout);
  }
  void row(const std::string& name, Index vertices, std::size_t compared, const Deviation& d,
           const std::string& remarks = "") {
    ++rows_;
    worst_ = std::max(worst_, d.relative);
    if (!d.within(kPromise)) ++failed_;
    std::printf("%-34s %8u %9zu %12.2e %6u  %s%s\n", name.c_str(), vertices, compared, d.relative, d.wrong_reach,
                remarks.c_str(), d.within(kPromise) ? "" : (" FAILED: " + d.text()).c_str());
    std::fflush(stdout);
  }
  int finish() const {
    std::printf("\n%d rows, %d beyond %g, largest deviation %.2e\n", rows_, failed_, kPromise, worst_);
    return failed_ ? 1 : 0;
  }

 private:
  int rows_ = 0, failed_ = 0;
  double worst_ = 0;
};

struct Named {
  std::string name;
  Mesh mesh;
};

std::vector<Named> read_all(const fs::path& folder, const std::set<std::string>& endings) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && endings.count(entry.path().extension().string())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<Named> all;
  for (const fs::path& file : files) {
    try {
      Mesh mesh = read_mesh(file.string()).mesh;
      if (mesh.face_count() > 0) all.push_back({file.filename().string(), std::move(mesh)});
    } catch (const Error& e) {
      std::printf("left out: %s\n", e.what());
    }
  }
  return all;
}

// The radius within which there are `count` vertices, by a first run of the solver that is being tested (which decides
// about the size of the comparison, not about its outcome).
double radius_of(const Mesh& mesh, const Source& source, Index count) {
  if (mesh.vertex_count() <= count) return kInfinity;
  std::vector<double> d = distance(mesh, std::span(&source, 1), exact_options()).distance;
  std::nth_element(d.begin(), d.begin() + count, d.end());
  return d[count] * (1 + 1e-9);  // not at a vertex: rounding would decide on which side that one is
}

std::string opinion_on(const Mesh& mesh, const Source& source, const std::vector<Real>& truth) {
  const Opinion opinion = third_opinion(mesh, source.point);
  if (opinion.distance.empty()) return opinion.verdict;
  const Deviation theirs = deviation(opinion.distance, truth);
  char text[80];
  std::snprintf(text, sizeof text, "%.1e%s", theirs.relative, theirs.wrong_reach ? " and wrong reach" : "");
  return text;
}

void against_oracle(const Named& m, const Settings& settings, Table& table) {
  constexpr Index kCgalLimit = 6000;
  std::mt19937 random(7);
  const std::vector<Source> sources{{random_vertex(m.mesh, random), 0},
                                    {random_edge_point(m.mesh, random), 0},
                                    {random_face_point(m.mesh, random), 0}};
  Deviation worst;
  std::size_t compared = 0;
  std::string cgal;
  double radius = kInfinity;
  for (const Source& source : sources) {
    radius = radius_of(m.mesh, source, settings.limit);
    const Truth truth = polyhedral_distance(m.mesh, std::span(&source, 1), radius);
    worst.add(deviation(distance(m.mesh, std::span(&source, 1), exact_options(radius)).distance, truth.distance));
    for (const Real d : truth.distance) compared += d < kFar;
    if (m.mesh.vertex_count() <= kCgalLimit)
      cgal += (cgal.empty() ? "" : ", ") + opinion_on(m.mesh, source, truth.distance);
  }
  table.row(m.name, m.mesh.vertex_count(), compared, worst,
            (radius < kInfinity ? "by radius"
             : cgal.empty()     ? ""
                                : "CGAL from the oracle: " + cgal));
}

void truth_part(const Settings& settings, Table& table) {
  table.head("Known distances (consensus of other exact programs)");
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(settings.data / "truth")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    const std::string stem = file.stem().string(), name = stem.substr(0, stem.rfind('.'));
    const Mesh mesh = read_mesh((settings.data / "meshes" / (name + ".ply")).string()).mesh;
    const Source source{vertex_point(mesh, static_cast<Index>(std::stoul(stem.substr(stem.rfind('.') + 1)))), 0};
    const std::vector<double> known = read_npy(file.string()).values;
    const auto d = distance(mesh, std::span(&source, 1), exact_options()).distance;
    const Deviation ours = deviation(d, std::vector<Real>(known.begin(), known.end()));
    table.row(stem, mesh.vertex_count(), known.size(), ours);
  }
}

// Runs one comparison per seed and prints the worst.
template <class Compare>
void sweep(const char* name, std::uint32_t count, Table& table, Compare&& compare) {
  Deviation worst;
  std::uint32_t worst_seed = 0;
  std::size_t compared = 0;
  for (std::uint32_t seed = 1; seed <= count; ++seed) {
    const double before = worst.relative + worst.wrong_reach;
    worst.add(compare(seed, compared));
    if (worst.relative + worst.wrong_reach > before) worst_seed = seed;
  }
  table.row(name, 0, compared, worst, std::to_string(count) + " seeds, worst " + std::to_string(worst_seed));
}

Deviation from_three(const Mesh& mesh, std::uint32_t seed, std::size_t& compared) {
  std::mt19937 random(seed);
  const std::vector<Source> sources{
      {random_vertex(mesh, random), 0}, {random_edge_point(mesh, random), 0}, {random_face_point(mesh, random), 0}};
  const std::vector<SurfacePoint> targets{random_edge_point(mesh, random), random_face_point(mesh, random)};
  Deviation worst;
  for (const Source& s : sources) worst.add(exact_against_oracle(mesh, std::span(&s, 1), kInfinity, targets));
  compared += 3 * (mesh.vertex_count() + targets.size());
  return worst;
}

void zoo_part(Table& table) {
  table.head("Hand-built and random complexes, from the oracle; domains, from the visibility graph");
  for (const Specimen& s : awkward_meshes()) {
    std::size_t compared = 0;
    Deviation worst;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) worst.add(from_three(s.mesh, seed, compared));
    table.row(s.name, s.mesh.vertex_count(), compared, worst);
  }
  sweep("random soups on a lattice", 3000, table, [](std::uint32_t seed, std::size_t& n) {
    return from_three(random_soup(seed, 5 + seed % 9, 4 + seed % 21, 3 + static_cast<int>(seed % 5)), seed, n);
  });
  sweep("random soups in general position", 3000, table, [](std::uint32_t seed, std::size_t& n) {
    return from_three(random_soup(seed, 5 + seed % 15, 4 + seed % 40, 100'000), seed, n);
  });
  sweep("random complexes of lengths", 3000, table, [](std::uint32_t seed, std::size_t& n) {
    return from_three(random_intrinsic(seed, 5 + seed % 13, 6 + seed % 40), seed, n);
  });
  sweep("needles of 1e-8", 100, table,
        [](std::uint32_t seed, std::size_t& n) { return from_three(needle_grid(seed, 10, 1e-8), seed, n); });
  sweep("cubes", 30, table,
        [](std::uint32_t seed, std::size_t& n) { return from_three(shapes::cube(1 + seed % 9).mesh(), seed, n); });
  sweep("planar domains with holes", 1000, table, [](std::uint32_t seed, std::size_t& n) {
    std::mt19937 random(seed);
    const PlanarDomain domain = random_domain(random, 5 + static_cast<int>(seed % 8), 12, seed % 3 == 0);
    const DomainPoint from = random_point(domain, random);
    const Source source{from.on, 0};
    n += domain.points.size();
    return deviation(distance(domain.mesh(), std::span(&source, 1), exact_options()).distance,
                     visibility_distances(domain, from.at));
  });
}

// ---- metric laws

std::vector<SurfacePoint> points_of_all_kinds(const Mesh& mesh, int count) {
  std::mt19937 random(11);
  std::vector<SurfacePoint> points;
  for (int k = 0; k < count; ++k) {
    points.push_back(k % 3 == 0   ? random_vertex(mesh, random)
                     : k % 3 == 1 ? random_edge_point(mesh, random)
                                  : random_face_point(mesh, random));
  }
  return points;
}

void metric_laws(const Named& m, Table& table) {
  constexpr int kPoints = 46;  // 1035 pairs
  const std::vector<SurfacePoint> points = points_of_all_kinds(m.mesh, kPoints);
  DistanceSolver solver(m.mesh);
  DistanceOptions options = exact_options();
  options.targets = points;
  std::vector<std::vector<double>> d;
  for (const SurfacePoint& p : points) {
    const Source source{p, 0};
    d.push_back(solver.distance(std::span(&source, 1), options).target_distance);
  }
  Deviation symmetry, triangle;
  for (Index a = 0; a < kPoints; ++a) {
    for (Index b = 0; b < kPoints; ++b) {
      if (b < a) symmetry.add(d[a][b], d[b][a], a * kPoints + b);
      double least = kInfinity;
      for (Index c = 0; c < kPoints; ++c) least = std::min(least, d[a][c] + d[c][b]);
      if (d[a][b] > least) triangle.add(d[a][b], least, a * kPoints + b);
    }
  }
  std::vector<Source> sources;
  for (Index k = 0; k < 6; ++k) sources.push_back({points[k * 5], 0.3 * (k % 3) * m.mesh.unit()});
  options.targets.clear();
  const std::vector<double> together = solver.distance(sources, options).distance;
  std::vector<Real> least(m.mesh.vertex_count(), kFar);
  for (const Source& s : sources) {
    const auto single = solver.distance(std::span(&s, 1), options).distance;
    for (std::size_t v = 0; v < least.size(); ++v) least[v] = std::min(least[v], Real{single[v]});
  }
  const Deviation several = deviation(together, least);
  Deviation all;
  all.add(symmetry);
  all.add(triangle);
  all.add(several);
  char text[120];
  std::snprintf(text, sizeof text, "symmetry %.1e, triangle %.1e, several sources %.1e", symmetry.relative,
                triangle.relative, several.relative);
  table.row(m.name, m.mesh.vertex_count(), kPoints * (kPoints - 1) / 2 + least.size(), all, text);
}

std::vector<Named> demo_meshes(const Settings& settings) {
  if (!fs::exists(settings.demo)) {
    std::printf("\nno demo meshes at %s (Debian package libcgal-demo)\n", settings.demo.c_str());
    return {};
  }
  const fs::path folder = fs::temp_directory_path() / ("exactness." + std::to_string(std::random_device{}()));
  fs::create_directories(folder);
  const std::string command = "tar -xzf '" + settings.demo.string() + "' -C '" + folder.string() + "'";
  std::vector<Named> all;
  if (std::system(command.c_str()) == 0) all = read_all(folder, {".off", ".ply", ".stl", ".obj"});
  fs::remove_all(folder);
  return all;
}

Settings read_settings(int count, char** arguments) {
  Settings settings;
  for (int i = 1; i < count; ++i) {
    const std::string word = arguments[i];
    if (word == "--data" && i + 1 < count) {
      settings.data = arguments[++i];
    } else if (word == "--demo" && i + 1 < count) {
      settings.demo = arguments[++i];
    } else if (word == "--limit" && i + 1 < count) {
      settings.limit = static_cast<Index>(std::stoul(arguments[++i]));
    } else {
      settings.parts.insert(word);
    }
  }
  return settings;
}

int run(int count, char** arguments) {
  const Settings settings = read_settings(count, arguments);
  Table table;
  const bool shared = fs::is_directory(settings.data / "meshes");
  if (!shared) std::printf("no shared data directory at %s\n", settings.data.c_str());
  if (settings.wants("truth") && shared) truth_part(settings, table);
  if (settings.wants("zoo")) zoo_part(table);
  std::vector<Named> meshes, demo;
  if (shared && (settings.wants("shared") || settings.wants("metric")))
    meshes = read_all(settings.data / "meshes", {".ply"});
  if (settings.wants("demo") || settings.wants("metric")) demo = demo_meshes(settings);
  if (settings.wants("shared") && shared) {
    table.head("Shared meshes, from the oracle: vertex, edge and face sources");
    for (const Named& m : meshes) against_oracle(m, settings, table);
  }
  if (settings.wants("demo")) {
    table.head("libcgal-demo meshes, from the oracle: vertex, edge and face sources");
    for (const Named& m : demo) against_oracle(m, settings, table);
  }
  if (settings.wants("metric")) {
    table.head("Metric laws: 1035 pairs, all triples, several sources");
    for (const Named& m : meshes) metric_laws(m, table);
    for (const Named& m : demo) metric_laws(m, table);
  }
  return table.finish();
}

}  // namespace
}  // namespace brushfire::benchmark

int main(int count, char** arguments) {
  try {
    return brushfire::benchmark::run(count, arguments);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "exactness: %s\n", e.what());
    return 2;
  }
}
