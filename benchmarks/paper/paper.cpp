// Measures what the paper shows (figures 6 to 8, table 1) and fills the numbers into docs/paper.md.
//
//   paper TEMPLATE SCAN... > docs/paper.md
//
// TEMPLATE is the page with {{places}} for numbers and tables; SCANs are mesh files for figure 8 and table 1. Without
// scans, or without CGAL, the places say what is missing.
#include <brushfire/brushfire.h>
#include <brushfire/core/error.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/delaunay.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "../measure.h"
#include "cgal_exact.h"

namespace brushfire::benchmark {
namespace {

constexpr std::array kMethods{Method::NovotniKlein, Method::KimmelSethian, Method::NovotniKlein2002};

// What stands in the page's {{places}}.
using Places = std::map<std::string, std::string>;

[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
  std::array<char, 400> buffer{};
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
  va_end(arguments);
  return buffer.data();
}

// Two digits; nothing but rounding reads 0.
std::string percent(double share) {
  const double value = 100 * share;
  return value < 1e-8 ? "0 %" : text(value >= 10 ? "%.0f %%" : "%.2g %%", value);
}

// In double unless asked otherwise: what is exact on the plane is to be seen as exact.
std::vector<double> solve(DistanceSolver& solver, Index vertex, Method method,
                          Precision precision = Precision::Double) {
  const Source source{vertex_point(solver.mesh(), vertex)};
  DistanceOptions options;
  options.method = method;
  options.precision = precision;
  return solver.distance({&source, 1}, options).distance;
}

std::vector<double> straight_distances(std::span<const Vec3> positions, Index seed) {
  std::vector<double> result;
  for (const Vec3& p : positions) result.push_back(norm(p - positions[seed]));
  return result;
}

Index vertex_nearest(std::span<const Vec3> positions, Vec3 place) {
  Index best = 0;
  for (Index v = 1; v < positions.size(); ++v) {
    if (norm(positions[v] - place) < norm(positions[best] - place)) best = v;
  }
  return best;
}

double mean_edge(const Mesh& mesh) {
  double sum = 0;
  for (const double length : mesh.lengths()) sum += length;
  return sum * mesh.unit() / mesh.halfedge_count();
}

// At every vertex the least angle, in degrees, between its edges and the straight line to the seed.
std::vector<double> angles_to_edges(const Mesh& mesh, Vec3 seed) {
  const auto positions = mesh.positions();
  std::vector<double> result(mesh.vertex_count(), 180);
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    for (const auto& [at, other] : {std::pair(mesh.from(h), mesh.to(h)), std::pair(mesh.to(h), mesh.from(h))}) {
      const Vec3 along = positions[other] - positions[at], back = seed - positions[at];
      if (norm(back) == 0) continue;
      const double cosine = dot(along, back) / (norm(along) * norm(back));
      result[at] = std::min(result[at], std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / kPi);
    }
  }
  return result;
}

// A table of the errors of `field`, its vertices sorted into bands by `key`. Vertices whose distance is exact because
// the seed sees them (its ring) are in no band.
std::string bands(const char* title, std::span<const double> key, std::span<const double> bounds,
                  std::span<const double> field, std::span<const double> truth) {
  std::string table = text("| %s | vertices | mean error | largest error |\n|---|---|---|---|\n", title);
  for (std::size_t band = 0; band + 1 < bounds.size(); ++band) {
    std::vector<double> chosen(truth.size(), 0);  // 0: left out
    std::size_t count = 0;
    for (std::size_t v = 0; v < truth.size(); ++v) {
      const bool started_exact = std::abs(field[v] - truth[v]) <= 1e-12 * truth[v];
      if (started_exact || key[v] < bounds[band] || key[v] >= bounds[band + 1]) continue;
      chosen[v] = truth[v];
      ++count;
    }
    if (count == 0) continue;
    const RelativeError e = relative_error(field, chosen);
    table += text("| %g to %g | %zu | %s | %s |\n", bounds[band], bounds[band + 1], count, percent(e.mean).c_str(),
                  percent(e.maximum).c_str());
  }
  return table;
}

// Figures 6 and 7: the square, whose true distances are straight lines.
void square(Places& places) {
  const Shape shape = shapes::paper_square();
  DistanceSolver solver(shape.mesh());
  const std::span<const Vec3> positions = shape.positions;
  const Index centre = vertex_nearest(positions, {0.5, 0.5, 0});
  const std::vector<double> truth = straight_distances(positions, centre);

  double deviation = 0, relative = 0;
  const std::vector<double> cone = solve(solver, centre, Method::NovotniKlein);
  for (Index v = 0; v < positions.size(); ++v) deviation = std::max(deviation, std::abs(cone[v] - truth[v]));
  for (Index seed = 0; seed < positions.size(); ++seed) {
    const RelativeError e =
        relative_error(solve(solver, seed, Method::NovotniKlein), straight_distances(positions, seed));
    relative = std::max(relative, e.maximum);
  }
  places["square vertices"] = text("%zu", positions.size());
  places["square seed"] = text("%u at (%.3f, %.3f)", centre, positions[centre].x, positions[centre].y);
  places["cone deviation"] = text("%.2g", deviation);
  places["cone all seeds"] = text("%.2g", relative);

  std::string table = "| method | mean error | largest error | largest below the true distance |\n|---|---|---|---|\n";
  for (const Method method : kMethods) {
    const RelativeError e = relative_error(solve(solver, centre, method), truth);
    table +=
        text("| `%s` | %.2g | %.2g | %.2g |\n", std::string(name_of(method)).c_str(), e.mean, e.maximum, e.shortest);
  }
  places["square errors"] = table;

  // Where the planar front's error sits: by distance from the seed, and by how near an edge runs to the gradient.
  const double edge = mean_edge(solver.mesh());
  const std::vector<double> planar = solve(solver, centre, Method::KimmelSethian);
  std::vector<double> in_edges(truth);
  for (double& d : in_edges) d /= edge;
  places["square bands"] =
      bands("mean edges from the seed", in_edges, std::array{0.0, 1.5, 3.0, 6.0, 9.0, 30.0}, planar, truth);
  std::vector<double> angles = angles_to_edges(solver.mesh(), positions[centre]);
  for (Index v = 0; v < positions.size(); ++v) {
    if (in_edges[v] > 6) angles[v] = -1;  // in no band
  }
  places["square angles"] = bands("degrees between the gradient and the nearest edge", angles,
                                  std::array{0.0, 10.0, 20.0, 30.0, 90.0}, planar, truth);
  const RelativeError e = relative_error(planar, truth);
  places["planar mean"] = percent(e.mean);
  places["planar largest"] = percent(e.maximum);
  places["planar worst place"] = text("(%.3f, %.3f), %.1f mean edges from the seed", positions[e.worst].x,
                                      positions[e.worst].y, truth[e.worst] / edge);
}

struct Scan {
  std::string name;
  Mesh mesh;
};

std::vector<Scan> read_scans(std::span<char*> files) {
  std::vector<Scan> scans;
  for (const char* file : files) scans.push_back({std::filesystem::path(file).stem().string(), read_mesh(file).mesh});
  return scans;
}

// Figure 8: curved scans, against exact distances from a program that is not ours. Three seeds each.
void curved(std::span<const Scan> scans, Places& places) {
  std::string table =
      "| scan | vertices | method | mean error | largest error | shorter than the shortest path | by at most |\n"
      "|---|---|---|---|---|---|---|\n";
  std::size_t compared = 0;
  for (const Scan& scan : scans) {
    DistanceSolver solver(scan.mesh);
    const Index n = scan.mesh.vertex_count();
    struct Sum {
      RelativeError worst;
      double mean = 0, shorter = 0;
    };
    std::array<Sum, kMethods.size()> sums;
    const std::array<Index, 3> seeds{0, n / 3, 2 * (n / 3)};
    for (const Index seed : seeds) {
      const auto truth = cgal_exact(scan.mesh.positions(), scan.mesh.faces(), seed);
      if (!truth) break;
      ++compared;
      for (std::size_t m = 0; m < kMethods.size(); ++m) {
        const std::vector<double> field = solve(solver, seed, kMethods[m]);
        const RelativeError e = relative_error(field, *truth);
        Sum& sum = sums[m];
        sum.mean += e.mean / seeds.size();
        sum.worst.maximum = std::max(sum.worst.maximum, e.maximum);
        sum.worst.shortest = std::min(sum.worst.shortest, e.shortest);
        for (Index v = 0; v < n; ++v) {
          if (field[v] < (1 - 1e-9) * (*truth)[v]) sum.shorter += 1.0 / (static_cast<double>(n) * seeds.size());
        }
      }
    }
    for (std::size_t m = 0; m < kMethods.size() && compared > 0; ++m) {
      table += text("| %s | %u | `%s` | %s | %s | %s of the vertices | %s |\n", scan.name.c_str(), n,
                    std::string(name_of(kMethods[m])).c_str(), percent(sums[m].mean).c_str(),
                    percent(sums[m].worst.maximum).c_str(), percent(sums[m].shorter).c_str(),
                    percent(-sums[m].worst.shortest).c_str());
    }
  }
  places["curved"] = compared > 0 ? table : "*(Not measured: this needs Debian's libcgal-dev and libcgal-demo.)*\n";
}

// Milliseconds of a solve with everything built, and of what is built before, the median of several.
std::array<double, 2> milliseconds(const Mesh& mesh, Method method) {
  std::vector<double> solves, set_ups;
  const int rounds = mesh.vertex_count() < 1000 ? 101 : 11;
  for (int round = 0; round < rounds; ++round) {
    const double begin = cpu_seconds();
    DistanceSolver solver{Mesh(mesh.positions(), mesh.faces())};
    solve(solver, 0, method, DistanceOptions{}.precision);
    const double first = cpu_seconds();
    solve(solver, 0, method, DistanceOptions{}.precision);
    const double end = cpu_seconds();
    solves.push_back(1e3 * (end - first));
    set_ups.push_back(1e3 * (first - begin) - solves.back());
  }
  return {median(solves), median(set_ups)};
}

// Table 1: times, beside the paper's.
void times(std::span<const Scan> scans, Places& places) {
  std::string table =
      "| model | vertices | novotni-klein: set-up, solve | kimmel-sethian: set-up, solve | in the paper | its vertices "
      "| "
      "new update | Kimmel and Sethian's |\n|---|---|---|---|---|---|---|---|\n";
  struct Then {
    const char* name;
    double vertices, ours, kimmel;
  };
  constexpr std::array kThen{Then{"Square", 604, 20.4, 20.06}, Then{"Hippo", 15446, 558.3, 553.8},
                             Then{"Foot", 21817, 755.1, 747.1}};
  std::vector<Scan> models{{"square", shapes::paper_square().mesh()}};
  models.insert(models.end(), scans.begin(), scans.end());
  for (const Scan& model : models) {
    const double n = model.mesh.vertex_count();
    const Then& then = *std::min_element(kThen.begin(), kThen.end(), [n](const Then& a, const Then& b) {
      return std::abs(a.vertices - n) < std::abs(b.vertices - n);
    });
    const auto [circular, circular_set_up] = milliseconds(model.mesh, Method::NovotniKlein);
    const auto [planar, planar_set_up] = milliseconds(model.mesh, Method::KimmelSethian);
    table +=
        text("| %s | %.0f | %.2f, %.2f ms | %.2f, %.2f ms | %s | %.0f | %.1f ms | %.1f ms |\n", model.name.c_str(), n,
             circular_set_up, circular, planar_set_up, planar, then.name, then.vertices, then.ours, then.kimmel);
  }
  places["times"] = table;
}

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "an unknown processor";
}

std::string filled(std::string page, const Places& places) {
  for (std::size_t begin; (begin = page.find("{{")) != std::string::npos;) {
    const std::size_t end = page.find("}}", begin);
    const std::string name = page.substr(begin + 2, end - begin - 2);
    const auto place = places.find(name);
    if (place == places.end()) throw Error(ErrorCode::InvalidArgument, "the template names an unknown place: " + name);
    page.replace(begin, end + 2 - begin, place->second);
  }
  return page;
}

int run(std::span<char*> arguments) {
  if (arguments.size() < 2) {
    std::fprintf(stderr, "usage: paper TEMPLATE SCAN... > docs/paper.md\n");
    return 2;
  }
  std::ostringstream page;
  page << std::ifstream(arguments[1]).rdbuf();
  const std::vector<Scan> scans = read_scans(arguments.subspan(2));
  Places places;
  places["processor"] = processor();
  places["scan count"] = text("%zu", scans.size());
  places["compiler"] = __VERSION__;
  square(places);
  curved(scans, places);
  times(scans, places);
  std::fputs(filled(page.str(), places).c_str(), stdout);
  return 0;
}

}  // namespace
}  // namespace brushfire::benchmark

int main(int count, char** arguments) {
  try {
    return brushfire::benchmark::run({arguments, static_cast<std::size_t>(count)});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "paper: %s\n", error.what());
    return 1;
  }
}
