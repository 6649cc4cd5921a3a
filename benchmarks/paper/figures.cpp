// Draws figures 6, 7 and 8 of the paper with this library.
//
//   figures FOLDER SCAN ...     writes FOLDER/figure-6.png, figure-7.png and figure-8-NAME.png
#include <brushfire/core/error.h>
#include <brushfire/figure/render.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/io/write_bytes.h>
#include <brushfire/mesh/delaunay.h>
#include <brushfire/solvers/distance.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace {

using namespace brushfire;

std::vector<double> distances(const Mesh& mesh, Index seed, Method method) {
  DistanceOptions options;
  options.method = method;
  options.precision = Precision::Double;  // what is exact on the plane is to be seen as exact
  const Source source{vertex_point(mesh, seed)};
  return distance(mesh, std::span(&source, 1), options).distance;
}

// The flat mesh raised by `height`, coloured by `scalar`, with a dot at the seed.
Panel raised(const Mesh& flat, const std::vector<double>& height, const std::vector<double>& scalar, Index seed,
             const std::string& title) {
  std::vector<Vec3> positions(flat.positions().begin(), flat.positions().end());
  for (std::size_t v = 0; v < positions.size(); ++v) positions[v].z = height[v];
  Panel panel;
  panel.mesh = Mesh(positions, flat.faces());
  panel.scalar = scalar;
  panel.title = title;
  panel.dots = {positions[seed]};
  return panel;
}

RenderOptions height_field_view() {
  RenderOptions options;
  options.width = 560;
  options.height = 440;
  options.camera.up = Axis::Z;
  options.camera.azimuth = 25;
  options.camera.elevation = 24;
  options.wireframe = true;
  return options;
}

// The vertex nearest to the middle of the square, as in docs/paper.md.
Index middle_of(const Mesh& square) {
  const auto from_middle = [](const Vec3& p) { return norm(p - Vec3{0.5, 0.5, 0}); };
  const auto positions = square.positions();
  const auto best = std::min_element(positions.begin(), positions.end(),
                                     [&](const Vec3& a, const Vec3& b) { return from_middle(a) < from_middle(b); });
  return static_cast<Index>(best - positions.begin());
}

void save(const std::filesystem::path& file, std::span<const Panel> panels, const RenderOptions& options) {
  write_bytes(file.string(), encode_png(render(panels, options)));
  std::fprintf(stderr, "%s\n", file.c_str());
}

void draw_squares(const std::filesystem::path& folder) {
  const Mesh square = shapes::paper_square().mesh();
  const Index seed = middle_of(square);
  const std::vector<double> circular = distances(square, seed, Method::NovotniKlein);
  const std::vector<double> planar = distances(square, seed, Method::KimmelSethian);
  std::vector<double> error(planar.size()), magnified(planar.size());
  constexpr double kMagnified = 10;
  for (std::size_t v = 0; v < planar.size(); ++v) {
    error[v] = planar[v] - norm(square.positions()[v] - square.positions()[seed]);
    magnified[v] = kMagnified * error[v];
  }
  RenderOptions options = height_field_view();
  options.scales[0].unit = "distance";
  const Panel cone = raised(square, circular, circular, seed, "Figure 6: novotni-klein, every vertex on the cone");
  save(folder / "figure-6.png", std::span(&cone, 1), options);
  options.scales[0].unit = "distance minus Euclid's";
  options.scales[0].colormap = Colormap::Magma;
  const std::vector<Panel> seven{
      raised(square, planar, error, seed, "Figure 7: kimmel-sethian, raised by distance, coloured by error"),
      raised(square, magnified, error, seed, "raised by its error, ten times, same colours")};
  save(folder / "figure-7.png", seven, options);
}

// Colours end here: a few vertices beside the seed are farther off, as the bar says.
constexpr double kMostError = 3;  // percent

// By how many percent of the distance a panel's values are off.
Panel error_of(const Panel& panel, const std::vector<double>& exact) {
  constexpr double kPercent = 100;
  Panel error;
  error.mesh = panel.mesh;
  error.scale = 1;
  error.dots = panel.dots;
  error.title = "error of " + panel.title;
  for (std::size_t v = 0; v < exact.size(); ++v) {
    error.scalar.push_back(exact[v] > 0 ? kPercent * std::abs(panel.scalar[v] - exact[v]) / exact[v] : 0);
  }
  return error;
}

void draw_scan(const std::filesystem::path& folder, const std::string& file) {
  const Mesh mesh = read_mesh(file).mesh;
  std::vector<Panel> panels;
  double far = 0;
  for (const Method method : {Method::KimmelSethian, Method::NovotniKlein}) {
    Panel& panel = panels.emplace_back();
    panel.mesh = mesh;
    panel.scalar = distances(mesh, 0, method);
    panel.title = name_of(method);
    panel.dots = {mesh.positions()[0]};
    for (const double d : panel.scalar) far = d < kInfinity ? std::max(far, d) : far;
  }
  constexpr int kBands = 60;
  for (Panel& panel : panels) {
    for (int i = 1; i < kBands; ++i) panel.isolines.push_back(far * i / kBands);
  }
  const std::vector<double> exact = distances(mesh, 0, Method::Exact);
  for (int i = 0; i < 2; ++i) panels.push_back(error_of(panels[i], exact));
  RenderOptions options;
  options.width = 440;
  options.height = 420;
  options.fill = Fill::Bands;
  options.scales[0].unit = "distance";
  options.scales.push_back({.colormap = Colormap::Magma, .low = 0, .high = kMostError, .unit = "error, %"});
  // Towards the seed, so that the bands around it are seen.
  const Vec3 seed = mesh.positions()[0];
  Vec3 centre;
  for (const Vec3& p : mesh.positions()) centre = centre + (1.0 / mesh.vertex_count()) * p;
  options.camera.azimuth = std::atan2(seed.x - centre.x, seed.z - centre.z) * 180 / kPi + 20;
  options.camera.elevation = 15;
  save(folder / ("figure-8-" + std::filesystem::path(file).stem().string() + ".png"), panels, options);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: figures FOLDER SCAN ...\n");
    return 2;
  }
  try {
    std::filesystem::create_directories(argv[1]);
    draw_squares(argv[1]);
    for (int i = 2; i < argc; ++i) draw_scan(argv[1], argv[i]);
  } catch (const Error& e) {
    std::fprintf(stderr, "figures: %s\n", e.what());
    return 1;
  }
  return 0;
}
