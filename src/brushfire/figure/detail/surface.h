// The colour of a mesh's surface at a sample: map, bands, isolines, wireframe, light.
#pragma once

#include <brushfire/figure/detail/raster.h>
#include <brushfire/figure/render.h>

#include <span>
#include <vector>

namespace brushfire::detail {

struct ScalarRange {
  double low = 0, high = 1;
};

// Faces that have no value, as they cannot be reached, and places that have no label.
inline constexpr Color kNoValueColor{0.72F, 0.72F, 0.72F};

// The colour of a value: of the map, or of its band between two of the ascending `levels`.
Color value_color(double value, ScalarRange range, Colormap colormap, Fill fill, std::span<const double> levels);

// Everything about one panel's surface that does not depend on the sample. Keeps references to its arguments.
class Surface {
 public:
  Surface(const Panel& panel, const RenderOptions& options, const Projection& projection, ScalarRange range);

  const Mesh& mesh() const { return panel_.mesh; }
  std::span<const ScreenVertex> vertices() const { return vertices_; }
  const RenderOptions& options() const { return options_; }

 private:
  friend class SurfaceShader;
  const Panel& panel_;
  const RenderOptions& options_;
  ScalarRange range_;
  std::vector<ScreenVertex> vertices_;
  std::vector<std::array<float, 3>> corner_normals_;  // [halfedge_count], in the camera's axes
};

// Shades samples, remembering what belongs to the current face: cheap where neighbours share their face.
class SurfaceShader {
 public:
  explicit SurfaceShader(const Surface& surface) : surface_(surface) {}
  Color color_at(Index face, int column, int row);
  // Depth that the current face has at an offset from the last sample.
  float depth_step(int columns, int rows) const;

 private:
  void enter(Index face);
  Color base_color(double value, std::array<float, 3> w) const;
  Index nearest_label(std::array<float, 3> w) const;
  Color with_isoline(Color c, double value, double gradient) const;
  Color with_wireframe(Color c, std::array<float, 3> screen_weights) const;
  float light(std::array<float, 3> w) const;
  float daylight(std::array<float, 3> w) const;

  const Surface& surface_;
  Index face_ = kNoIndex;
  std::array<ScreenVertex, 3> corner_;
  std::optional<ScreenTriangle> triangle_;
  std::array<float, 3> dx_{}, dy_{};
  std::array<double, 3> value_{};
  const SharedFace* shared_ = nullptr;  // what several labels share of the current face
  std::array<float, 3> open_{1, 1, 1};
  bool has_value_ = false;
};

}  // namespace brushfire::detail
