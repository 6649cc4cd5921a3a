// Shading of surface samples.
#include <brushfire/figure/detail/surface.h>

#include <brushfire/figure/detail/corner_normals.h>

#include <algorithm>
#include <cmath>

namespace brushfire::detail {
namespace {

constexpr Color kPlain{0.80F, 0.82F, 0.85F};  // nothing to show but the shape
constexpr Color kLineColor{0.08F, 0.08F, 0.10F};

// The corners' normals in the camera's axes.
std::vector<std::array<float, 3>> normals_seen(const Mesh& mesh, const Projection& projection) {
  std::vector<std::array<float, 3>> normals = corner_normals(mesh);
  for (auto& n : normals) {
    const Vec3 seen = projection.direction({n[0], n[1], n[2]});
    n = {static_cast<float>(seen.x), static_cast<float>(seen.y), static_cast<float>(seen.z)};
  }
  return normals;
}

}  // namespace

Color value_color(double value, ScalarRange range, Colormap colormap, Fill fill, std::span<const double> levels) {
  const double span = range.high - range.low;
  const Color c = color_of(colormap, span > 0 ? (value - range.low) / span : 0);
  if (fill == Fill::Smooth || levels.empty()) return c;
  const auto band = std::upper_bound(levels.begin(), levels.end(), value) - levels.begin();
  constexpr float kDarkBand = 0.45F, kLightBand = 0.55F;
  return band % 2 == 0 ? scaled(c, kDarkBand) : mix(c, {1, 1, 1}, kLightBand);
}

Surface::Surface(const Panel& panel, const RenderOptions& options, const Projection& projection, ScalarRange range)
    : panel_(panel),
      options_(options),
      range_(range),
      vertices_(project(panel.mesh.positions(), projection, options.samples)),
      corner_normals_(normals_seen(panel.mesh, projection)) {}

void SurfaceShader::enter(Index face) {
  face_ = face;
  const Face& t = surface_.mesh().faces()[face];
  for (std::size_t k = 0; k < 3; ++k) corner_[k] = surface_.vertices_[t[k]];
  triangle_.emplace(corner_[0], corner_[1], corner_[2]);
  dx_ = triangle_->weights_dx();
  dy_ = triangle_->weights_dy();
  has_value_ = !surface_.panel_.scalar.empty();
  for (std::size_t k = 0; k < 3 && has_value_; ++k) {
    value_[k] = surface_.panel_.scalar[t[k]];
    has_value_ = std::isfinite(value_[k]);
  }
  const std::vector<SharedFace>& shared = surface_.panel_.label_borders;
  const auto found = std::lower_bound(shared.begin(), shared.end(), face,
                                      [](const SharedFace& shared_face, Index f) { return shared_face.face < f; });
  shared_ = found != shared.end() && found->face == face ? &*found : nullptr;
  // Seen from the front where its corners run counter-clockwise; y runs down on the screen.
  const std::size_t side = triangle_->double_area() < 0 ? 0 : 1;
  const auto& openness = surface_.panel_.openness;
  for (std::size_t k = 0; k < 3 && !openness.empty(); ++k) open_[k] = openness[3 * std::size_t{face} + k][side];
}

Color SurfaceShader::color_at(Index face, int column, int row) {
  if (face != face_) enter(face);
  const std::array<float, 3> screen = triangle_->weights(column, row);
  std::array<float, 3> w = screen;
  float sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += w[k] *= corner_[k].weight;
  for (float& x : w) x /= sum;

  double value = 0, gx = 0, gy = 0;
  if (has_value_) {
    for (std::size_t k = 0; k < 3; ++k) value += static_cast<double>(w[k]) * value_[k];
    // d(A/B) = (dA - value dB)/B with A = sum of w value, B = sum of w, both linear on the screen.
    for (std::size_t k = 0; k < 3; ++k) {
      const double part = static_cast<double>(corner_[k].weight / sum) * (value_[k] - value);
      gx += static_cast<double>(dx_[k]) * part;
      gy += static_cast<double>(dy_[k]) * part;
    }
  }
  Color c = scaled(base_color(value, w), light(w) * daylight(w));
  if (surface_.options_.wireframe) c = with_wireframe(c, screen);
  const double per_pixel = std::sqrt(gx * gx + gy * gy) * surface_.options_.samples;
  if (has_value_ && !surface_.panel_.isolines.empty()) c = with_isoline(c, value, per_pixel);
  return c;
}

float SurfaceShader::depth_step(int columns, int rows) const {
  float step = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    step += corner_[k].depth * (dx_[k] * static_cast<float>(columns) + dy_[k] * static_cast<float>(rows));
  }
  return step;
}

Color SurfaceShader::base_color(double value, std::array<float, 3> w) const {
  const Panel& panel = surface_.panel_;
  if (!panel.labels.empty()) {
    const Index label = nearest_label(w);
    if (label == kNoIndex) return kNoValueColor;
    return label_color(label < panel.label_colors.size() ? panel.label_colors[label] : label);
  }
  if (panel.scalar.empty()) return kPlain;
  if (!has_value_) return kNoValueColor;
  if (value > panel.front) return kPlain;
  const RenderOptions& options = surface_.options_;
  return value_color(value, surface_.range_, options.scales[panel.scale].colormap, options.fill, panel.isolines);
}

// That of the nearest corner, or of the nearest cell where that is known.
Index SurfaceShader::nearest_label(std::array<float, 3> w) const {
  if (!shared_) {
    const auto k = static_cast<std::size_t>(std::max_element(w.begin(), w.end()) - w.begin());
    return surface_.panel_.labels[surface_.mesh().faces()[face_][k]];
  }
  std::array<double, 3> distance{};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    for (std::size_t k = 0; k < 3; ++k) distance[k] += static_cast<double>(w[corner]) * shared_->distance[corner][k];
  }
  return shared_
      ->label[static_cast<std::size_t>(std::min_element(distance.begin(), distance.end()) - distance.begin())];
}

Color SurfaceShader::with_isoline(Color c, double value, double gradient) const {
  const std::vector<double>& levels = surface_.panel_.isolines;
  if (surface_.options_.fill == Fill::Bands || !(gradient > 0)) return c;
  const auto above = std::lower_bound(levels.begin(), levels.end(), value);
  double nearest = kInfinity, spacing = kInfinity;
  if (above != levels.end()) nearest = *above - value;
  if (above != levels.begin()) {
    nearest = std::min(nearest, value - *(above - 1));
    if (above != levels.end()) spacing = *above - *(above - 1);
  }
  const double half_width = 0.5 * surface_.options_.line_width;
  if (nearest > half_width * gradient) return c;
  // Lines closer together than a few pixels fade out, else steep places would turn black.
  constexpr double kDense = 2, kLoose = 5;  // line widths
  const double room = spacing / gradient / surface_.options_.line_width;
  return mix(c, kLineColor, static_cast<float>(std::clamp((room - kDense) / (kLoose - kDense), 0.0, 1.0)));
}

Color SurfaceShader::with_wireframe(Color c, std::array<float, 3> screen_weights) const {
  constexpr float kWireWidth = 0.5F;  // half, pixels
  constexpr float kWireOpacity = 0.55F;
  for (std::size_t k = 0; k < 3; ++k) {
    const float per_pixel = std::hypot(dx_[k], dy_[k]) * static_cast<float>(surface_.options_.samples);
    if (screen_weights[k] < kWireWidth * per_pixel) return mix(c, kLineColor, kWireOpacity);
  }
  return c;
}

// A lamp over the viewer's left shoulder, some light from everywhere; both sides of a face are alike.
float SurfaceShader::light(std::array<float, 3> w) const {
  std::array<float, 3> n{0, 0, 0};
  for (Index k = 0; k < 3; ++k) {
    std::array<float, 3> corner = surface_.corner_normals_[3 * face_ + k];
    // Corners of faces on a fold may look the other way: bring them to the viewer's side one by one.
    const float side = corner[2] < 0 ? -w[k] : w[k];
    for (std::size_t i = 0; i < 3; ++i) n[i] += side * corner[i];
  }
  const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(length > 0)) return 1;
  constexpr std::array<float, 3> kLamp{-0.36F, 0.48F, 0.80F};  // length 1
  const float cosine = (n[0] * kLamp[0] + n[1] * kLamp[1] + n[2] * kLamp[2]) / length;
  constexpr float kAmbient = 0.48F, kDiffuse = 0.57F;
  return kAmbient + kDiffuse * std::max(0.0F, cosine);
}

// What ambient occlusion leaves of the light; never so little that the colour cannot be read.
float SurfaceShader::daylight(std::array<float, 3> w) const {
  constexpr float kDeepest = 0.25F;
  float open = 0;
  for (std::size_t k = 0; k < 3; ++k) open += w[k] * open_[k];
  return kDeepest + (1 - kDeepest) * open;
}

}  // namespace brushfire::detail
