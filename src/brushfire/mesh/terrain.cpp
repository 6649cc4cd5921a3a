// Two triangles for every cell.
#include <brushfire/mesh/terrain.h>

#include <brushfire/core/error.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace brushfire {
namespace {

void check(std::size_t heights, Index columns, Index rows, const GridPlacement& p) {
  if (columns < 2 || rows < 2 || heights != std::size_t{columns} * rows) {
    throw Error(ErrorCode::InvalidArgument, std::to_string(heights) + " heights are no grid of " +
                                                std::to_string(columns) + " columns and " + std::to_string(rows) +
                                                " rows, of each of which there must be two at least");
  }
  const double area = p.right[0] * p.down[1] - p.right[1] * p.down[0];
  if (!std::isfinite(p.origin[0] + p.origin[1] + area) || area == 0) {
    throw Error(ErrorCode::InvalidArgument, "the grid is not placed: its axes are parallel, or not finite");
  }
}

// The triangles of a cell with corners a b above, d c below.
void triangulate(const std::array<Index, 4>& corners, std::span<const double> heights,
                 const std::vector<bool>& has_height, std::vector<Face>& faces) {
  const auto [a, b, c, d] = corners;
  std::array<bool, 4> has{};
  for (std::size_t k = 0; k < 4; ++k) has[k] = has_height[corners[k]];
  const auto missing = std::count(has.begin(), has.end(), false);
  if (missing > 1) return;
  if (missing == 1) {
    const auto k = static_cast<std::size_t>(std::find(has.begin(), has.end(), false) - has.begin());
    faces.push_back({corners[(k + 1) % 4], corners[(k + 2) % 4], corners[(k + 3) % 4]});
  } else if (std::abs(heights[a] - heights[c]) <= std::abs(heights[b] - heights[d])) {
    faces.push_back({a, b, c});
    faces.push_back({a, c, d});
  } else {
    faces.push_back({a, b, d});
    faces.push_back({b, c, d});
  }
}

}  // namespace

Terrain::Terrain(std::span<const double> heights, Index columns, Index rows, const GridPlacement& placement,
                 double no_data)
    : columns_(columns), rows_(rows), placement_(placement) {
  check(heights.size(), columns, rows, placement);
  std::vector<Vec3> positions;
  positions.reserve(heights.size());
  std::vector<bool> has_height(heights.size());
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const auto column = static_cast<double>(i % columns), row = static_cast<double>(i / columns);
    has_height[i] = std::isfinite(heights[i]) && heights[i] != no_data;
    positions.push_back({placement.origin[0] + column * placement.right[0] + row * placement.down[0],
                         placement.origin[1] + column * placement.right[1] + row * placement.down[1],
                         has_height[i] ? heights[i] : 0});
  }
  // Counter-clockwise seen from above, whichever way the rows run.
  const bool turns_left = placement.right[0] * placement.down[1] - placement.right[1] * placement.down[0] > 0;
  std::vector<Face> faces;
  faces.reserve(2 * heights.size());
  for (Index r = 0; r + 1 < rows; ++r) {
    for (Index c = 0; c + 1 < columns; ++c) {
      first_face_.push_back(static_cast<Index>(faces.size()));
      const Index a = r * columns + c;
      triangulate({a, a + 1, a + columns + 1, a + columns}, heights, has_height, faces);
    }
  }
  first_face_.push_back(static_cast<Index>(faces.size()));
  if (!turns_left) {
    for (Face& f : faces) std::swap(f[1], f[2]);
  }
  mesh_ = Mesh(std::move(positions), std::move(faces));
}

SurfacePoint Terrain::below(double x, double y) const {
  const auto& [origin, right, down] = placement_;
  const double area = right[0] * down[1] - right[1] * down[0], dx = x - origin[0], dy = y - origin[1];
  const double column = (dx * down[1] - dy * down[0]) / area, row = (right[0] * dy - right[1] * dx) / area;
  if (!(column >= 0 && row >= 0 && column <= columns_ - 1 && row <= rows_ - 1)) return {};
  const Index c = std::min(static_cast<Index>(column), columns_ - 2), r = std::min(static_cast<Index>(row), rows_ - 2);
  const std::size_t cell = std::size_t{r} * (columns_ - 1) + c;
  const Vec2 at{column, row};
  for (Index f = first_face_[cell]; f < first_face_[cell + 1]; ++f) {
    std::array<Vec2, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = mesh_.faces()[f][k];
      corners[k] = {static_cast<double>(v % columns_), static_cast<double>(v / columns_)};
    }
    const double whole = cross(corners[1] - corners[0], corners[2] - corners[0]);  // 1 or -1
    std::array<double, 3> weights{};
    for (std::size_t k = 0; k < 3; ++k) {
      weights[k] = cross(corners[(k + 1) % 3] - at, corners[(k + 2) % 3] - at) / whole;
    }
    if (*std::min_element(weights.begin(), weights.end()) < -kWeightSnap) continue;
    for (double& w : weights) w = std::clamp(w, 0.0, 1.0);
    const double sum = weights[0] + weights[1] + weights[2];
    for (double& w : weights) w /= sum;
    return {f, weights};
  }
  return {};
}

}  // namespace brushfire
