// Tubes and balls by the distance of a sample from a line segment on the screen.
#include <brushfire/figure/detail/overlay.h>

#include <algorithm>
#include <cmath>

namespace brushfire::detail {
namespace {

// Red, and a white seam on either side: without it the red is lost on green for those who cannot tell them apart.
constexpr Color kPathColor{0.93F, 0.26F, 0.16F};
constexpr Color kSeamColor{1.0F, 1.0F, 1.0F};
constexpr float kPathShare = 0.66F;  // of the width; the seam is the rest
constexpr Color kDotColor{1.0F, 1.0F, 1.0F};
constexpr Color kDotRim{0.10F, 0.10F, 0.12F};
constexpr float kDotRimShare = 0.28F;

Capsule capsule(const Projection::Screen& a, const Projection::Screen& b, double pixels, const Projection& projection,
                int samples) {
  Capsule c{};
  c.x0 = static_cast<float>(a.x * samples);
  c.y0 = static_cast<float>(a.y * samples);
  c.x1 = static_cast<float>(b.x * samples);
  c.y1 = static_cast<float>(b.y * samples);
  c.depth0 = static_cast<float>(a.depth);
  c.depth1 = static_cast<float>(b.depth);
  c.radius = static_cast<float>(0.5 * pixels * samples);
  // Twice its radius: a curve that runs along the chords of a curved surface dips below it by less than that.
  const double units = pixels / projection.pixels_per_unit();
  c.lift = static_cast<float>(units * projection.depth_per_unit(std::max(a.depth, b.depth)));
  return c;
}

// Calls visit(sample, t, nx, ny) for the samples of the strip within the capsule's reach: t is the share of the way
// along it, (nx, ny) the offset from its axis in radii.
template <class Visit>
void for_samples(const Capsule& c, const Strip& strip, const Visit& visit) {
  const float reach = c.radius + 1;
  const int left = std::max(0, static_cast<int>(std::floor(std::min(c.x0, c.x1) - reach)));
  const int right = std::min(strip.columns - 1, static_cast<int>(std::ceil(std::max(c.x0, c.x1) + reach)));
  const int top = std::max(strip.first_row, static_cast<int>(std::floor(std::min(c.y0, c.y1) - reach)));
  const int bottom =
      std::min(strip.first_row + strip.rows - 1, static_cast<int>(std::ceil(std::max(c.y0, c.y1) + reach)));
  const float dx = c.x1 - c.x0, dy = c.y1 - c.y0, squared = dx * dx + dy * dy;
  for (int row = top; row <= bottom; ++row) {
    for (int column = left; column <= right; ++column) {
      const float px = static_cast<float>(column) + 0.5F - c.x0, py = static_cast<float>(row) + 0.5F - c.y0;
      const float t = squared > 0 ? std::clamp((px * dx + py * dy) / squared, 0.0F, 1.0F) : 0.0F;
      const float nx = (px - t * dx) / c.radius, ny = (py - t * dy) / c.radius;
      if (nx * nx + ny * ny <= 1) visit(strip.at(column, row), t, nx, ny);
    }
  }
}

// Shades samples of one capsule that lie in the strip.
void draw_one(const Capsule& c, Strip& strip, std::span<Color> colors) {
  for_samples(c, strip, [&](std::size_t i, float t, float nx, float ny) {
    const float off = nx * nx + ny * ny;
    const float nz = std::sqrt(1 - off);
    const float depth = c.depth0 + t * (c.depth1 - c.depth0) + c.lift * nz;
    if (depth < strip.depth[i]) return;
    strip.depth[i] = depth;
    strip.face[i] = kNoIndex;
    const float light = 0.55F + 0.45F * std::max(0.0F, -0.36F * nx - 0.48F * ny + 0.80F * nz);
    const bool on_rim = off > (1 - c.rim) * (1 - c.rim);
    colors[i] = on_rim && c.rim > 0 ? c.rim_color : scaled(c.color, light);
  });
}

// Dashes where the surface is in front; a sample that two pieces cover is mixed once.
void draw_hidden(std::span<const Capsule> capsules, const Strip& strip, std::span<Color> colors) {
  constexpr float kOpacity = 0.6F, kShareOfRadius = 0.5F;
  std::vector<char> drawn(colors.size(), 0);
  for (Capsule c : capsules) {
    if (!(c.dash > 0)) continue;
    c.radius *= kShareOfRadius;
    const float length = std::hypot(c.x1 - c.x0, c.y1 - c.y0);
    for_samples(c, strip, [&](std::size_t i, float t, float, float) {
      const float depth = c.depth0 + t * (c.depth1 - c.depth0) + c.lift;
      const bool in_gap = std::fmod((c.begin + t * length) / c.dash, 2.0F) >= 1;
      if (depth >= strip.depth[i] || drawn[i] || in_gap) return;
      drawn[i] = 1;
      colors[i] = mix(colors[i], c.color, kOpacity);
    });
  }
}

}  // namespace

std::vector<Capsule> overlay_capsules(const Panel& panel, const RenderOptions& options, const Projection& projection) {
  std::vector<Capsule> out;
  for (const Polyline& path : panel.paths) {
    const std::size_t n = path.points.size();
    float begin = 0;
    for (std::size_t i = 0; i + (path.closed ? 0 : 1) < n; ++i) {
      Capsule c = capsule(projection(path.points[i]), projection(path.points[(i + 1) % n]), options.path_width,
                          projection, options.samples);
      c.color = kSeamColor;
      out.push_back(c);
      // The red lies higher, lest the seam of a piece that comes nearer covers the one before it.
      c.color = kPathColor;
      c.radius *= kPathShare;
      c.depth0 += c.lift;
      c.depth1 += c.lift;
      c.begin = begin;
      c.dash = options.hidden_paths ? static_cast<float>(kDashes * options.path_width * options.samples) : 0;
      begin += std::hypot(c.x1 - c.x0, c.y1 - c.y0);
      out.push_back(c);
    }
  }
  for (const Vec3& p : panel.dots) {
    Capsule c = capsule(projection(p), projection(p), options.dot_size, projection, options.samples);
    c.color = kDotColor;
    c.rim_color = kDotRim;
    c.rim = kDotRimShare;
    out.push_back(c);
  }
  return out;
}

void draw(std::span<const Capsule> capsules, Strip& strip, std::span<Color> colors) {
  draw_hidden(capsules, strip, colors);
  for (const Capsule& c : capsules) draw_one(c, strip, colors);
}

}  // namespace brushfire::detail
