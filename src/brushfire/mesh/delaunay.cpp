// Delaunay triangulations as the dual of Boost.Polygon's Voronoi diagram.
#include <brushfire/mesh/delaunay.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/random.h>
#include <brushfire/core/error.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <boost/polygon/voronoi.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace brushfire {
namespace {

using GridPoint = boost::polygon::point_data<std::int32_t>;

// 28 bits a coordinate: the in-circle determinant then fits into 128 bits.
constexpr int kGridBits = 28;

// The points on their grid, and the way back.
struct Grid {
  double step = 1;
  Vec2 origin;
  std::vector<GridPoint> points;

  Vec3 position(std::size_t i) const { return {origin.x + step * points[i].x(), origin.y + step * points[i].y(), 0}; }
};

Grid snap(std::span<const Vec2> points) {
  Grid grid;
  if (points.empty()) return grid;
  Vec2 low = points[0], high = points[0];
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 p = points[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
      throw Error(ErrorCode::InvalidArgument, "point " + std::to_string(i) + " has a coordinate that is not finite");
    }
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double extent = std::max(high.x - low.x, high.y - low.y);
  // A power of two, so that going back is exact wherever the coordinates have bits for it.
  if (extent > 0) grid.step = std::ldexp(1.0, std::ilogb(extent) + 1 - kGridBits);
  grid.origin = {std::floor(low.x / grid.step) * grid.step, std::floor(low.y / grid.step) * grid.step};
  grid.points.reserve(points.size());
  for (const Vec2 p : points) {
    grid.points.emplace_back(static_cast<std::int32_t>(std::llround((p.x - grid.origin.x) / grid.step)),
                             static_cast<std::int32_t>(std::llround((p.y - grid.origin.y) / grid.step)));
  }
  return grid;
}

// Positive where a, b, c turn left.
std::int64_t turn_of(GridPoint a, GridPoint b, GridPoint c) {
  const std::int64_t bx = b.x() - a.x(), by = b.y() - a.y(), cx = c.x() - a.x(), cy = c.y() - a.y();
  return bx * cy - by * cx;
}

// Whether d lies inside the circle through a, b, c, which turn left.
bool in_circle(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  using Wide = boost::multiprecision::int128_t;
  const auto lifted = [d](GridPoint p) {
    const std::int64_t x = p.x() - d.x(), y = p.y() - d.y();
    return std::array<std::int64_t, 3>{x, y, x * x + y * y};
  };
  const auto [ax, ay, aa] = lifted(a);
  const auto [bx, by, bb] = lifted(b);
  const auto [cx, cy, cc] = lifted(c);
  const Wide determinant =
      Wide(aa) * (bx * cy - by * cx) + Wide(bb) * (cx * ay - cy * ax) + Wide(cc) * (ax * by - ay * bx);
  return determinant > 0;
}

// The Delaunay triangulation of a convex polygon whose corners lie (nearly) on a circle: the diagram gives one Voronoi
// vertex to all points whose circles differ by rounding only, so which diagonals are right is decided here, exactly.
void triangulate_cell(const Grid& grid, std::span<const Index> polygon, std::vector<Face>& faces) {
  if (polygon.size() < 3) return;
  const Index first = polygon.front(), last = polygon.back();
  std::size_t best = 1;
  for (std::size_t i = 2; i + 1 < polygon.size(); ++i) {
    const GridPoint a = grid.points[first], b = grid.points[polygon[best]], c = grid.points[last];
    if (turn_of(a, b, c) <= 0 || in_circle(a, b, c, grid.points[polygon[i]])) best = i;
  }
  if (turn_of(grid.points[first], grid.points[polygon[best]], grid.points[last]) > 0) {
    faces.push_back({first, polygon[best], last});
  }
  triangulate_cell(grid, polygon.subspan(0, best + 1), faces);
  triangulate_cell(grid, polygon.subspan(best), faces);
}

}  // namespace

Shape delaunay(std::span<const Vec2> points) {
  if (points.size() > kNoIndex / 6) {
    throw Error(ErrorCode::TooLarge, std::to_string(points.size()) + " points do not fit into 32-bit indices");
  }
  const Grid grid = snap(points);
  Shape s;
  for (std::size_t i = 0; i < points.size(); ++i) s.positions.push_back(grid.position(i));
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(grid.points.begin(), grid.points.end(), &diagram);
  std::vector<Index> around;
  Poll poll;
  for (const auto& vertex : diagram.vertices()) {
    poll();
    around.clear();
    const auto* edge = vertex.incident_edge();
    do {
      around.push_back(static_cast<Index>(edge->cell()->source_index()));
      edge = edge->rot_next();
    } while (edge != vertex.incident_edge());
    triangulate_cell(grid, around, s.faces);
  }
  return s;
}

namespace shapes {

Shape delaunay_square(Index per_side, Index interior, std::uint64_t seed) {
  if (per_side == 0) throw Error(ErrorCode::InvalidArgument, "a square needs at least one step per side");
  std::vector<Vec2> points;
  for (Index side = 0; side < 4; ++side) {
    for (Index i = 0; i < per_side; ++i) {
      const double t = static_cast<double>(i) / per_side;
      points.push_back(side == 0 ? Vec2{t, 0} : side == 1 ? Vec2{1, t} : side == 2 ? Vec2{1 - t, 1} : Vec2{0, 1 - t});
    }
  }
  // Martin Roberts' R2 sequence: steps of the inverse powers of the plastic number (g^3 = g + 1) fill the square
  // evenly for every count; a shake of a third of the spacing takes the regularity out.
  constexpr double kPlastic = 1.32471795724474602596;
  const double spacing = 1 / std::sqrt(std::max(1.0, static_cast<double>(interior)));
  const double margin = std::min(0.25, 0.7 * spacing), reach = spacing / 3;
  Random random(seed);
  const auto place = [&](double u) {
    const double x = margin + (1 - 2 * margin) * (u - std::floor(u)) + random.uniform(-reach, reach);
    return std::clamp(x, 0.5 * margin, 1 - 0.5 * margin);
  };
  Poll poll;
  for (Index i = 1; i <= interior; ++i) {
    poll();
    const double x = place(0.5 + i / kPlastic);
    points.push_back({x, place(0.5 + i / (kPlastic * kPlastic))});
  }
  return delaunay(points);
}

Shape paper_square() { return delaunay_square(20, 524); }

Shape delaunay_disc(Index points, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec2> inside;
  Poll poll;
  while (inside.size() < points) {
    poll();
    const double x = random.uniform(-1, 1);
    const Vec2 p{x, random.uniform(-1, 1)};
    if (dot(p, p) <= 1) inside.push_back(p);
  }
  return delaunay(inside);
}

}  // namespace shapes
}  // namespace brushfire
