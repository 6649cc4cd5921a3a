// Where things are on the rows of points: frames of edges, the rows around a place, values between points.
#pragma once

#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/steiner/detail/point_layout.h>
#include <brushfire/solvers/steiner/detail/travel.h>

#include <cstdint>
#include <span>
#include <vector>

namespace brushfire::steiner {

// Of real paths, whose costs are nowhere below the distance; or lowered (lower_costs.h) to be nowhere above it.
enum class Costs : std::uint8_t { Real, Below };

// Where a value comes from: a point of the layout, or kFromSource + position in the list of sources.
inline constexpr Index kFromSource = Index{1} << 31;

// In mesh.unit() times weight, from the least offset of a source on. Copies of a vertex at the ends of rows agree.
struct Front {
  std::vector<double> value;  // [layout.size()]
  std::vector<Index> parent;  // [layout.size()] kNoIndex: not reached. At ends of rows that of vertex_parent counts
  std::vector<double> vertex_value;
  std::vector<Index> vertex_parent;
  double horizon = kInfinity;  // values up to this are final
  std::uint64_t rows_sent = 0;
};

struct ValueAt {
  double value = kInfinity;
  Index parent = kNoIndex;
};

// A face over an edge, in the frame of the edge: from its start at (0, 0) to its end at (length, 0).
struct FaceOver {
  Index edge = kNoIndex, face = kNoIndex;
  Index start = kNoIndex, end = kNoIndex;  // the edge's vertices
  double length = 0;
  // With a grain the face is laid out so that lengths in it, times `stretch`, are costs.
  Vec2 apex;
  double stretch = 1;
  Vec2 gradient;  // of the height, where slopes count
};

// Where a place is in the frame of an edge beside it, or under it.
struct RowBeside {
  Index edge = kNoIndex;
  double weight = 0;
  Vec2 place;
  Vec2 gradient;  // of the height
  bool under = false;
  double rounding = 0;  // of distances from it
};

class Places {
 public:
  Places(const WeightedMesh& mesh, const PointLayout& layout, Costs costs, const Travel& travel)
      : mesh_(mesh),
        layout_(layout),
        costs_(costs),
        travel_(travel),
        faces_(mesh.mesh().faces()),
        lengths_(mesh.mesh().lengths()),
        double_areas_(mesh.mesh().double_areas()) {}

  Index end_of(Index edge, bool last) const { return mesh_.edges().end(edge, last); }
  bool is_usable(Index f) const {  // three distinct vertices
    const Face& t = faces_[f];
    return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
  }
  // By how much an edge climbs per length, from its start on; 0 where slopes do not count.
  double gradient_along(Index edge) const;
  // The face of a halfedge over its edge.
  FaceOver over(Index h) const;
  // The rows of the faces that hold a place which is not a vertex; of an edge also its own.
  std::vector<RowBeside> beside(const PointLocation& place) const;
  // Between the place and point i of the row, from the place or to it, without the weight.
  double cost_from(const RowBeside& row, Index i) const { return cost_between(row, i, 1); }
  double cost_to(const RowBeside& row, Index i) const { return cost_between(row, i, -1); }
  // What a front says of any place. O(points on the rows around it).
  ValueAt value(const Front& front, std::span<const detail::LocatedSource> sources, const PointLocation& place) const;

 private:
  double cost_between(const RowBeside& row, Index i, double sense) const;
  void add_beside(Index h, const PointLocation& place, std::vector<RowBeside>& rows) const;
  ValueAt straight_from(std::span<const detail::LocatedSource> sources, const PointLocation& place) const;
  ValueAt between_points(const Front& front, const RowBeside& row) const;

  const WeightedMesh& mesh_;
  const PointLayout& layout_;
  Costs costs_;
  Travel travel_;
  std::span<const Face> faces_;
  std::span<const double> lengths_, double_areas_;
};

}  // namespace brushfire::steiner
