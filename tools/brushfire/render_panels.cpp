// The panels of brushfire render.
#include "render_panels.h"

#include "cell_colors.h"
#include "fields.h"
#include "interrupt.h"
#include "weights.h"

#include <brushfire/figure/ambient_occlusion.h>
#include <brushfire/io/read_field.h>
#include <brushfire/queries/curve_sides.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/voronoi.h>
#include <brushfire/queries/weighted_path.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace brushfire::tool {
namespace {

// A dot, or a tube along a curve and dots for its pieces that are single places.
void add_source(const Source& source, Panel& panel) {
  if (!source.curve) {
    panel.dots.push_back(position(panel.mesh, source.point));
    return;
  }
  Polyline piece;
  const auto end_piece = [&] {
    if (piece.points.size() == 1) panel.dots.push_back(piece.points.front());
    piece.closed = source.curve->closed;
    if (piece.points.size() > 1) panel.paths.push_back(piece);
    piece = {};
  };
  for (const SurfacePoint& p : source.curve->places) {
    p.is_nowhere() ? end_piece() : piece.points.push_back(position(panel.mesh, p));
  }
  end_piece();
}

// How far, in percent of it, `field` is from `exact`; +inf where there is nothing to compare.
std::vector<double> percent_off(const std::vector<double>& field, const std::vector<double>& exact) {
  constexpr double kPercent = 100;
  std::vector<double> error(field.size());
  for (std::size_t v = 0; v < field.size(); ++v) {
    error[v] = field[v] == exact[v] ? 0 : kPercent * std::abs(field[v] - exact[v]) / exact[v];
    if (!std::isfinite(field[v]) || !std::isfinite(exact[v])) error[v] = kInfinity;
  }
  return error;
}

// A few vertices next to a source are often far worse than all others: colours that ran up to them would show nothing
// else. So they run up to the error that 99 % of the vertices stay under, and the title says how large it gets.
double usual(std::vector<double> errors) {
  errors.erase(std::remove_if(errors.begin(), errors.end(), [](double e) { return !std::isfinite(e); }), errors.end());
  if (errors.empty()) return 0;
  const auto place = errors.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(errors.size() - 1));
  std::nth_element(errors.begin(), place, errors.end());
  return *place;
}

}  // namespace

std::vector<Index> labels_of(const std::string& file, const Surface& surface, Panel& panel) {
  const LoadedField field = read_field(file);
  std::vector<Index> labels;
  for (const double x : surface.on_mesh(values_on_vertices(field, surface.file().mesh.vertex_count(), -1), file)) {
    if (x != std::floor(x) || x >= kNoIndex) refuse(file + ": " + exact(x) + " is not a label (a whole number)");
    labels.push_back(x < 0 ? kNoIndex : static_cast<Index>(x));
  }
  constexpr std::int64_t kMostNames = 100000;
  for (const LoadedField::Label& label : field.label_names) {
    if (label.key < 0 || label.key >= kMostNames) continue;
    const auto key = static_cast<std::size_t>(label.key);
    if (panel.label_names.size() <= key) panel.label_names.resize(key + 1);
    panel.label_names[key] = label.name;
  }
  return labels;
}

void find_paths(const Surface& surface, PlaceFinder& places, const DistanceOptions& how, Shown& shown) {
  if (shown.ends.empty()) return;
  const Mesh& mesh = surface.mesh();
  std::vector<SurfacePoint> targets;
  for (const Where& w : shown.ends) targets.push_back(places.target(surface.place(w)));
  std::vector<std::vector<SurfacePoint>> found;
  if (how.weighting) {
    WeightedSolver solver = how.weighting->solver();
    WeightedOptions options;
    options.tolerance = how.weighting->options().tolerance;
    options.towards = how.weighting->options().towards;
    options.lower = false;
    options.max_distance = how.max_distance;
    for (WeightedPath& p : weighted_paths(solver, shown.sources, targets, options))
      found.push_back(std::move(p.points));
  } else {
    DistanceSolver solver(surface.domain());
    for (SourcePath& p : paths_to(solver, shown.sources, targets, how)) found.push_back(std::move(p.points));
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].empty()) throw Unreachable(shown.ends[i].text, how.max_distance < kInfinity);
    Polyline& line = shown.paths.emplace_back();
    for (const SurfacePoint& p : found[i]) line.points.push_back(position(mesh, p));
  }
}

Vec3 outward_at(const Mesh& mesh, const Source& source) {
  const SurfacePoint& at = source.curve && !source.curve->places.empty() ? source.curve->places.front() : source.point;
  if (at.is_nowhere()) return {};
  Vec3 low{kInfinity, kInfinity, kInfinity}, high = -1.0 * low;
  for (const Vec3& p : mesh.positions()) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const auto [a, b, c] = mesh.faces()[at.face];
  const Vec3 corner = mesh.positions()[a];
  const Vec3 normal = cross(mesh.positions()[b] - corner, mesh.positions()[c] - corner);
  const Vec3 from_middle = position(mesh, at) - 0.5 * (low + high);
  const auto unit = [](const Vec3& v) { return norm(v) > 0 ? (1 / norm(v)) * v : Vec3{}; };
  constexpr double kNormal = 0.7;  // less than the place counts: faces may be turned the wrong way round
  return unit(from_middle) + kNormal * unit(normal);
}

Panel solved_panel(const Domain& domain, const Shown& shown, DistanceOptions options, const Talk& talk) {
  Panel panel;
  panel.mesh = domain.mesh();
  for (const Source& source : shown.sources) add_source(source, panel);
  options.progress = talk.progress("distance");
  const DistanceField field = distance(domain, shown.sources, options);
  talk.end_progress();
  panel.scalar = options.keep_paths ? signed_distance(domain, field, shown.sources) : field.distance;
  panel.paths.insert(panel.paths.end(), shown.paths.begin(), shown.paths.end());
  return panel;
}

void add_cells(const Surface& surface, const Shown& shown, const DistanceOptions& how, std::vector<Panel>& panels) {
  const VoronoiDiagram cells = voronoi(surface.domain(), shown.sources, how);
  const std::vector<Index> colors = colors_of(cells, shown.sources.size());
  for (Panel& panel : panels) {
    panel.labels = cells.source;
    panel.label_borders = cells.shared_faces;
    panel.label_colors = colors;
  }
}

double add_errors(std::vector<Panel>& panels) {
  double high = 0;
  const std::size_t reference = panels.size() - 1;
  for (std::size_t i = 0; i < reference; ++i) {
    Panel error = panels[i];
    error.scalar = percent_off(panels[i].scalar, panels[reference].scalar);
    error.scale = kErrors;
    error.labels.clear();
    double worst = 0;
    for (const double e : error.scalar) worst = std::isfinite(e) ? std::max(worst, e) : worst;
    high = std::max(high, usual(error.scalar));
    char at_most[48];
    std::snprintf(at_most, sizeof at_most, ", at most %.2g %%", worst);
    error.title = "error of " + panels[i].title + at_most;
    panels.push_back(std::move(error));
  }
  return high;
}

void add_ambient_occlusion(const Mesh& mesh, const Talk& talk, std::vector<Panel>& panels) {
  AmbientOcclusionOptions options;
  options.progress = talk.progress("light");
  options.cancel = &cancel_token();
  const auto openness = ambient_occlusion(mesh, options);
  talk.end_progress();
  for (Panel& panel : panels) panel.openness = openness;
}

}  // namespace brushfire::tool
