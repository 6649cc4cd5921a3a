// From either end of an edge the points lie as an exponential function of their number, up to where the halves meet.
#include <brushfire/solvers/steiner/detail/point_layout.h>

#include <brushfire/core/detail/memory.h>
#include <brushfire/core/error.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace brushfire::steiner {
namespace {

// What the faces beside an edge say: the least sines of the angles at its ends, and its length.
struct EdgeShape {
  double length = 0;
  double sine[2] = {1, 1};
};

// One half of an edge: from its vertex as far as `length`.
struct Half {
  double length = 0;
  double slope = 0, least = 0;  // the interval at t is slope * t + least long
  Index count = 0;              // of intervals

  Half(double l, double s, double r, Index most) : length(l), slope(s), least(r) {
    const double wanted = l > 0 ? std::ceil(number(l)) : 0;
    count = static_cast<Index>(std::clamp(wanted, 0.0, static_cast<double>(most)));
  }
  // How many intervals from the vertex to t.
  double number(double t) const { return slope > 0 ? std::log1p(slope * t / least) / slope : t / least; }
  double place(Index i) const {
    const double n = number(length) * i / count;
    return slope > 0 ? least / slope * std::expm1(slope * n) : least * n;
  }
};

struct Shapes {
  std::vector<EdgeShape> edges;
  std::vector<double> height;  // [vertices] the least distance from the vertex to the edge across in one of its faces
};

Shapes shapes_of(const WeightedMesh& weighted) {
  const Mesh& mesh = weighted.mesh();
  const EdgeTable& edges = weighted.edges();
  const Stretches& stretches = weighted.stretches();
  Shapes shapes{std::vector<EdgeShape>(edges.count()), std::vector<double>(mesh.vertex_count(), kInfinity)};
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const Index e = edges.edge(h), f = Mesh::face_of(h);
    EdgeShape& shape = shapes.edges[e];
    shape.length = mesh.lengths()[h];
    if (!mesh.is_face_usable(f) || weighted.face_weight(f) == kInfinity) continue;
    const bool same_way = mesh.from(h) == mesh.from(edges.halfedge(e));
    // With a grain: as the face is laid out, where lengths are costs, but for the edge, which keeps its own.
    const auto length = [&](Index g) { return mesh.lengths()[g] * (stretches.along(g) / stretches.along(h)); };
    const double area = mesh.double_areas()[f] * (stretches.area(f) / (stretches.along(h) * stretches.along(h)));
    const double next = length(Mesh::next(h)), previous = length(Mesh::previous(h)),
                 squares = shape.length * shape.length;
    // Beyond a right angle the vertex itself is what is nearest of the other edge.
    const auto sine = [&](double beside, double across) {
      if (squares + beside * beside <= across * across) return 1.0;
      const double product = shape.length * beside;
      return product > 0 ? std::min(1.0, area / product) : 0.0;
    };
    double& first = shape.sine[same_way ? 0 : 1];
    double& last = shape.sine[same_way ? 1 : 0];
    first = std::min(first, sine(previous, next));
    last = std::min(last, sine(next, previous));
    double& height = shapes.height[mesh.from(h)];
    height = std::min({height, shape.length, previous, next > 0 ? std::max(area / next, 0.0) : 0.0});
  }
  return shapes;
}

void level_fences(const WeightedMesh& weighted, std::vector<EdgeShape>& shapes) {
  for (const Bridge& b : weighted.all_bridges()) {
    for (const int k : {0, 1}) {
      double& mine = shapes[b.from].sine[k];
      double& theirs = shapes[b.to].sine[b.mirrored ? 1 - k : k];
      mine = theirs = std::min(mine, theirs);
    }
  }
}

}  // namespace

PointLayout::PointLayout(const WeightedMesh& weighted, const Density& density) {
  const Mesh& mesh = weighted.mesh();
  const EdgeTable& edges = weighted.edges();
  Shapes shapes = shapes_of(weighted);
  // Twice: what one fence has told another over a third side must come back.
  for (int i = 0; i < 2; ++i) level_fences(weighted, shapes.edges);
  // The vertices of a fence are one or several on each side; the least altitude of all copies counts.
  std::vector<double> height(weighted.domain().mesh().vertex_count(), kInfinity);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    double& h = height[weighted.vertex(v)];
    h = std::min(h, shapes.height[v]);
  }
  std::vector<Half> halves;
  halves.reserve(2 * std::size_t{edges.count()});
  std::uint64_t size = 0;
  for (Index e = 0; e < edges.count(); ++e) {
    const EdgeShape& shape = shapes.edges[e];
    const double sum = shape.sine[0] + shape.sine[1];
    const double split = sum > 0 ? shape.length * (shape.sine[1] / sum) : 0.5 * shape.length;
    for (const int k : {0, 1}) {
      const Index v = k == 0 ? mesh.from(edges.halfedge(e)) : mesh.to(edges.halfedge(e));
      // An altitude that has vanished in rounding says nothing, and no interval needs to be shorter than this.
      const double least =
          density.least * std::max(std::min(height[weighted.vertex(v)], shape.length), shape.length * 0x1p-20);
      halves.emplace_back(k == 0 ? split : shape.length - split, density.growth * shape.sine[k], least,
                          std::max<Index>(1, density.most / 2));
    }
    const Index count = std::max<Index>(1, halves[2 * e].count + halves[2 * e + 1].count) + 1;
    size += (count + kLanes - 1) / kLanes * kLanes;
    counts_.push_back(count);
    longest_ = std::max(longest_, (count + kLanes - 1) / kLanes * kLanes);
  }
  // A place, and for each of two searches a value and where it comes from.
  constexpr std::uint64_t kBytes = 8 + 2 * (8 + 4);
  require_memory(size * kBytes, 0, "a search over " + std::to_string(size) + " points on edges",
                 "a larger tolerance needs fewer");
  if (size >= std::uint64_t{1} << 31) {
    throw Error(ErrorCode::TooLarge, std::to_string(size) +
                                         " points on edges are more than 2^31: a larger tolerance "
                                         "needs fewer");
  }
  rows_.push_back(0);
  at_.reserve(static_cast<std::size_t>(size));
  for (Index e = 0; e < edges.count(); ++e) {
    const double length = shapes.edges[e].length;
    const Half &first = halves[2 * e], &last = halves[2 * e + 1];
    at_.push_back(0);
    for (Index i = 1; i <= first.count; ++i) at_.push_back(first.place(i));
    for (Index i = last.count; i > 0; --i) at_.push_back(length - last.place(i - 1));
    while (at_.size() < rows_.back() + counts_[e]) at_.push_back(length);  // an edge of length 0
    // Rounding must not put points out of order.
    for (std::size_t i = rows_.back() + 1; i < at_.size(); ++i) at_[i] = std::clamp(at_[i], at_[i - 1], length);
    while (at_.size() % kLanes != 0) at_.push_back(length);
    rows_.push_back(static_cast<Index>(at_.size()));
  }
}

Index PointLayout::edge_of(Index point) const {
  return static_cast<Index>(std::upper_bound(rows_.begin(), rows_.end(), point) - rows_.begin() - 1);
}

}  // namespace brushfire::steiner
