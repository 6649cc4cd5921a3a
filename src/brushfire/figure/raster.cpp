// Scan conversion with integer edge functions.
//
// Based on: Pineda, "A parallel algorithm for polygon rasterization", 1988.
#include <brushfire/core/cancel.h>
#include <brushfire/figure/detail/raster.h>

#include <algorithm>
#include <cmath>

namespace brushfire::detail {
namespace {

// Farther off the picture than this, coordinates are clamped: products of differences stay below 2^62, and no face of
// a mesh that fits its picture comes near it.
constexpr double kFarOff = 1 << 28;

std::int32_t to_grid(double samples) {
  return static_cast<std::int32_t>(std::lround(std::clamp(samples * kSubsample, -kFarOff, kFarOff)));
}

constexpr std::int64_t centre_of(int sample) { return static_cast<std::int64_t>(sample) * kSubsample + kSubsample / 2; }

// The first sample whose centre is at or beyond the coordinate, and the last that is not beyond it.
int first_sample(std::int32_t x) { return (x + kSubsample / 2 - 1) >> 8; }
int last_sample(std::int32_t x) { return (x - kSubsample / 2) >> 8; }
static_assert(kSubsample == 256, "the shifts above divide by it");

// Positive to the left of a -> b in a picture whose y runs down, zero on the line.
std::int64_t edge_function(const ScreenVertex& a, const ScreenVertex& b, std::int64_t x, std::int64_t y) {
  return (static_cast<std::int64_t>(b.x) - a.x) * (y - a.y) - (static_cast<std::int64_t>(b.y) - a.y) * (x - a.x);
}

}  // namespace

Strip::Strip(int width, int first, int height)
    : columns(width),
      first_row(first),
      rows(height),
      depth(static_cast<std::size_t>(width) * height, -std::numeric_limits<float>::infinity()),
      face(static_cast<std::size_t>(width) * height, kNoIndex) {}

std::vector<ScreenVertex> project(std::span<const Vec3> positions, const Projection& projection, int samples) {
  std::vector<ScreenVertex> out(positions.size());
  Poll poll;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    poll();
    const Projection::Screen s = projection(positions[v]);
    out[v] = {to_grid(s.x * samples), to_grid(s.y * samples), static_cast<float>(s.depth),
              static_cast<float>(s.weight)};
  }
  return out;
}

ScreenTriangle::ScreenTriangle(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c)
    : corner_{a, b, c}, double_area_(edge_function(a, b, c.x, c.y)) {}

std::array<float, 3> ScreenTriangle::weights(int column, int row) const {
  const std::int64_t x = centre_of(column), y = centre_of(row);
  const double inverse = 1 / static_cast<double>(double_area_);
  std::array<float, 3> w;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto e = edge_function(corner_[(k + 1) % 3], corner_[(k + 2) % 3], x, y);
    w[k] = static_cast<float>(static_cast<double>(e) * inverse);
  }
  return w;
}

std::array<float, 3> ScreenTriangle::weights_dx() const {
  std::array<float, 3> w;
  for (std::size_t k = 0; k < 3; ++k) {
    const double rise = static_cast<double>(corner_[(k + 2) % 3].y) - corner_[(k + 1) % 3].y;
    w[k] = static_cast<float>(-rise * kSubsample / static_cast<double>(double_area_));
  }
  return w;
}

std::array<float, 3> ScreenTriangle::weights_dy() const {
  std::array<float, 3> w;
  for (std::size_t k = 0; k < 3; ++k) {
    const double run = static_cast<double>(corner_[(k + 2) % 3].x) - corner_[(k + 1) % 3].x;
    w[k] = static_cast<float>(run * kSubsample / static_cast<double>(double_area_));
  }
  return w;
}

// The samples of one triangle within a strip.
class TriangleScan {
 public:
  TriangleScan(const ScreenTriangle& t, const Strip& strip) : t_(t), flip_(t.double_area_ < 0 ? -1 : 1) {
    const auto [left, right] = std::minmax({t.corner_[0].x, t.corner_[1].x, t.corner_[2].x});
    const auto [top, bottom] = std::minmax({t.corner_[0].y, t.corner_[1].y, t.corner_[2].y});
    left_ = std::max(first_sample(left), 0);
    right_ = std::min(last_sample(right), strip.columns - 1);
    top_ = std::max(first_sample(top), strip.first_row);
    bottom_ = std::min(last_sample(bottom), strip.first_row + strip.rows - 1);
  }

  // visit(column, row, weights of corners 0 and 1 times the double area, double area, all positive)
  template <class Visit>
  void run(Visit&& visit) const {
    if (left_ > right_ || top_ > bottom_) return;
    std::array<std::int64_t, 3> step{}, start{};
    const std::int64_t x0 = centre_of(left_);
    for (std::size_t k = 0; k < 3; ++k) {
      step[k] = -flip_ * (static_cast<std::int64_t>(corner(k + 2).y) - corner(k + 1).y) * kSubsample;
    }
    for (int row = top_; row <= bottom_; ++row) {
      for (std::size_t k = 0; k < 3; ++k) {
        start[k] = flip_ * edge_function(corner(k + 1), corner(k + 2), x0, centre_of(row));
      }
      std::array<std::int64_t, 3> e = start;
      for (int column = left_; column <= right_; ++column) {
        if ((e[0] | e[1] | e[2]) >= 0) visit(column, row, e[0], e[1]);
        for (std::size_t k = 0; k < 3; ++k) e[k] += step[k];
      }
    }
  }

 private:
  const ScreenVertex& corner(std::size_t k) const { return t_.corner_[k % 3]; }
  const ScreenTriangle& t_;
  std::int64_t flip_;
  int left_ = 0, right_ = 0, top_ = 0, bottom_ = 0;
};

FaceBands sort_into_bands(std::span<const Face> faces, std::span<const ScreenVertex> vertices, int rows, int band_rows,
                          int overlap_rows) {
  const int bands = (rows + band_rows - 1) / band_rows;
  const auto range = [&](const Face& t) {
    const auto [top, bottom] = std::minmax({vertices[t[0]].y, vertices[t[1]].y, vertices[t[2]].y});
    const int first = std::max(0, first_sample(top) - overlap_rows), last = last_sample(bottom) + overlap_rows;
    return std::pair(first / band_rows, std::min(last < 0 ? -1 : last / band_rows, bands - 1));
  };
  FaceBands result;
  result.offset.assign(static_cast<std::size_t>(bands) + 1, 0);
  for (const Face& t : faces) {
    const auto [first, last] = range(t);
    for (int b = first; b <= last; ++b) ++result.offset[static_cast<std::size_t>(b) + 1];
  }
  for (std::size_t b = 0; b < static_cast<std::size_t>(bands); ++b) result.offset[b + 1] += result.offset[b];
  result.face.resize(result.offset.back());
  std::vector<std::size_t> fill(result.offset.begin(), result.offset.end() - 1);
  for (Index f = 0; f < faces.size(); ++f) {
    const auto [first, last] = range(faces[f]);
    for (int b = first; b <= last; ++b) result.face[fill[static_cast<std::size_t>(b)]++] = f;
  }
  return result;
}

void draw(std::span<const Face> faces, std::span<const ScreenVertex> vertices, std::span<const Index> listed,
          Strip& strip) {
  Poll poll(16);  // a face may cover a whole strip
  for (const Index f : listed) {
    poll();
    const Face& t = faces[f];
    const ScreenTriangle triangle(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
    if (triangle.empty()) continue;
    const float d2 = triangle.corner(2).depth;
    const float d0 = triangle.corner(0).depth - d2, d1 = triangle.corner(1).depth - d2;
    const float inverse = 1 / std::abs(static_cast<float>(triangle.double_area()));
    TriangleScan(triangle, strip).run([&](int column, int row, std::int64_t w0, std::int64_t w1) {
      const float depth = d2 + inverse * (static_cast<float>(w0) * d0 + static_cast<float>(w1) * d1);
      const std::size_t i = strip.at(column, row);
      if (depth > strip.depth[i]) {
        strip.depth[i] = depth;
        strip.face[i] = f;
      }
    });
  }
}

}  // namespace brushfire::detail
