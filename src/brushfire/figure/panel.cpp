// From faces to pixels, one band of rows at a time.
#include <brushfire/core/cancel.h>
#include <brushfire/figure/detail/panel.h>

#include <brushfire/core/parallel.h>
#include <brushfire/figure/detail/overlay.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace brushfire::detail {
namespace {

constexpr int kBandPixels = 24;  // rows of pixels done at once: a band's samples fit the second-level cache

class PanelPainter {
 public:
  PanelPainter(const Surface& surface, const Projection& projection, std::span<const Capsule> capsules, Rectangle at,
               Image& picture, std::span<float> depth)
      : surface_(surface),
        projection_(projection),
        capsules_(capsules),
        at_(at),
        picture_(picture),
        depth_(depth),
        samples_(surface.options().samples),
        bands_(sort_into_bands(surface.mesh().faces(), surface.vertices(), at.height * samples_, kBandPixels * samples_,
                               samples_)) {}

  std::size_t band_count() const { return bands_.offset.size() - 1; }

  // Bands write to rows of their own, so they may be painted in any order and from several threads.
  void paint_band(std::size_t band) {
    const int first_pixel = static_cast<int>(band) * kBandPixels;
    const int pixels = std::min(kBandPixels, at_.height - first_pixel);
    // One more row of pixels on either side, for silhouettes.
    Strip strip(at_.width * samples_, (first_pixel - 1) * samples_, (pixels + 2) * samples_);
    draw(surface_.mesh().faces(), surface_.vertices(),
         std::span(bands_.face).subspan(bands_.offset[band], bands_.offset[band + 1] - bands_.offset[band]), strip);
    std::vector<Color> colors(strip.depth.size());
    shade(strip, colors);
    draw(capsules_, strip, colors);
    resolve(strip, colors, first_pixel, pixels);
  }

 private:
  void shade(const Strip& strip, std::vector<Color>& colors) const {
    SurfaceShader shader(surface_);
    for (int row = strip.first_row + samples_; row < strip.first_row + strip.rows - samples_; ++row) {
      stop_if_cancelled();
      for (int column = 0; column < strip.columns; ++column) {
        const std::size_t i = strip.at(column, row);
        if (strip.face[i] == kNoIndex) continue;
        colors[i] = shader.color_at(strip.face[i], column, row);
        if (surface_.options().silhouettes && on_silhouette(strip, shader, column, row)) {
          constexpr Color kSilhouette{0.10F, 0.10F, 0.12F};
          constexpr float kOpacity = 0.75F;
          colors[i] = mix(colors[i], kSilhouette, kOpacity);
        }
      }
    }
  }

  // Whether the surface ends, or falls back by more than a hundredth of the picture's depth, within half a pixel.
  bool on_silhouette(const Strip& strip, const SurfaceShader& shader, int column, int row) const {
    constexpr double kStep = 0.02;  // of the radius of what is shown
    const int reach = std::max(1, samples_ / 2 + 1);
    const std::size_t i = strip.at(column, row);
    const float depth = strip.depth[i];
    const float threshold =
        static_cast<float>(kStep * projection_.radius() * projection_.depth_per_unit(static_cast<double>(depth)));
    constexpr std::array<std::array<int, 2>, 4> kSides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (const auto& side : kSides) {
      const int c = column + reach * side[0], r = row + reach * side[1];
      if (c < 0 || c >= strip.columns || r < strip.first_row || r >= strip.first_row + strip.rows) continue;
      const std::size_t j = strip.at(c, r);
      if (strip.face[j] == kNoIndex) return true;
      if (strip.face[j] == strip.face[i]) continue;
      // A steep face goes on falling: only what is deeper than its plane counts.
      const float expected = depth + std::min(0.0F, shader.depth_step(reach * side[0], reach * side[1]));
      if (strip.depth[j] < expected - threshold) return true;
    }
    return false;
  }

  void resolve(const Strip& strip, const std::vector<Color>& colors, int first_pixel, int pixels) const {
    const float share = 1.0F / static_cast<float>(samples_ * samples_);
    for (int y = first_pixel; y < first_pixel + pixels; ++y) {
      stop_if_cancelled();
      for (int x = 0; x < at_.width; ++x) {
        Color sum;
        int covered = 0;
        float nearest = -std::numeric_limits<float>::infinity();
        for (int row = y * samples_; row < (y + 1) * samples_; ++row) {
          for (int column = x * samples_; column < (x + 1) * samples_; ++column) {
            const std::size_t i = strip.at(column, row);
            if (!(strip.depth[i] > -std::numeric_limits<float>::infinity())) continue;
            ++covered;
            sum = {sum.r + colors[i].r, sum.g + colors[i].g, sum.b + colors[i].b};
            nearest = std::max(nearest, strip.depth[i]);
          }
        }
        if (!depth_.empty()) depth_[static_cast<std::size_t>(y) * at_.width + x] = nearest;
        if (covered == 0) continue;
        blend_over(picture_.pixel(at_.x + x, at_.y + y), scaled(sum, 1.0F / static_cast<float>(covered)),
                   static_cast<float>(covered) * share);
      }
    }
  }

  const Surface& surface_;
  const Projection& projection_;
  std::span<const Capsule> capsules_;
  Rectangle at_;
  Image& picture_;
  std::span<float> depth_;
  int samples_;
  FaceBands bands_;
};

}  // namespace

Projection projection_of(const Panel& panel, const RenderOptions& options) {
  // Vertices in no face are not seen and do not move the camera.
  std::vector<Vec3> shown;
  shown.reserve(panel.mesh.vertex_count());
  for (Index v = 0; v < panel.mesh.vertex_count(); ++v) {
    if (!panel.mesh.corners(v).empty()) shown.push_back(panel.mesh.positions()[v]);
  }
  return Projection(options.camera, shown, 0, 0, options.width, options.height);
}

void paint_panel(const Panel& panel, const RenderOptions& options, ScalarRange range, Rectangle at, bool overlays,
                 Image& picture, std::span<float> depth) {
  const Projection projection = projection_of(panel, options);
  const Surface surface(panel, options, projection, range);
  const std::vector<Capsule> capsules =
      overlays ? overlay_capsules(panel, options, projection) : std::vector<Capsule>{};
  PanelPainter painter(surface, projection, capsules, at, picture, depth);
  parallel_for(
      painter.band_count(), options.threads, [&](unsigned, std::size_t band) { painter.paint_band(band); },
      current_cancel_token());
}

}  // namespace brushfire::detail
