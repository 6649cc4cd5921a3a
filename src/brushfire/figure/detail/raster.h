// The z-buffer: which face is seen at which sample of a strip of the picture.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/figure/detail/projection.h>

#include <span>
#include <vector>

namespace brushfire::detail {

// A rectangle of samples: rows [first_row, first_row + rows) of a picture that is `columns` samples wide.
struct Strip {
  int columns = 0, first_row = 0, rows = 0;
  std::vector<float> depth;  // [rows * columns], -inf: nothing
  std::vector<Index> face;   // kNoIndex: nothing

  Strip(int width, int first, int height);  // in samples
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row - first_row) * static_cast<std::size_t>(columns) + column;
  }
};

// A projected vertex in fixed point (a 256th of a sample), so that two faces that share an edge agree about it exactly:
// no sample on the edge is missed.
struct ScreenVertex {
  std::int32_t x = 0, y = 0;
  float depth = 0;   // greater is nearer
  float weight = 1;  // for perspective-correct interpolation
};
inline constexpr int kSubsample = 256;

// Positions [vertex_count] on the screen, at `samples` samples a pixel.
std::vector<ScreenVertex> project(std::span<const Vec3> positions, const Projection& projection, int samples);

// A projected triangle's barycentric weights as linear functions of the sample.
class ScreenTriangle {
 public:
  ScreenTriangle(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c);
  bool empty() const { return double_area_ == 0; }
  std::int64_t double_area() const { return double_area_; }
  const ScreenVertex& corner(std::size_t k) const { return corner_[k]; }
  // At the centre of the sample; weights sum to one.
  std::array<float, 3> weights(int column, int row) const;
  // Change of the three weights per sample to the right and per sample down.
  std::array<float, 3> weights_dx() const;
  std::array<float, 3> weights_dy() const;

 private:
  friend class TriangleScan;
  std::array<ScreenVertex, 3> corner_;
  std::int64_t double_area_ = 0;  // signed, in squares of the fixed-point grid
};

// The faces that touch each band of `band_rows` sample rows: face numbers of band i are
// faces[offset[i] .. offset[i+1]), ascending.
struct FaceBands {
  std::vector<std::size_t> offset;
  std::vector<Index> face;
};
FaceBands sort_into_bands(std::span<const Face> faces, std::span<const ScreenVertex> vertices, int rows, int band_rows,
                          int overlap_rows);

// Draws the listed faces; where depths are equal the lower face number wins, so that order does not show.
void draw(std::span<const Face> faces, std::span<const ScreenVertex> vertices, std::span<const Index> listed,
          Strip& strip);

}  // namespace brushfire::detail
