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

// One half of an edge: from its vertex as far as `length`. The interval at t is slope * t + least long, so that places
// are a geometric series: each is `ratio` times the one before and the first one.
struct Half {
  double first = 0, ratio = 1;
  Index count = 0;  // of intervals

  Half(double length, double slope, double least, Index most) {
    if (!(length > 0 && least > 0)) {
      count = length > 0 ? 1 : 0;
      return;
    }
    // How many intervals lie from the vertex to the end.
    const double wanted = slope > 0 ? std::log1p(slope * length / least) / slope : length / least;
    count = static_cast<Index>(std::clamp(std::ceil(wanted), 1.0, static_cast<double>(most)));
    const double step = wanted / count, growth = slope > 0 ? std::expm1(slope * step) : 0;
    first = slope > 0 ? least / slope * growth : least * step;
    ratio = 1 + growth;
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
  const std::span<const double> lengths = mesh.lengths(), double_areas = mesh.double_areas();
  const std::span<const Face> faces = mesh.faces();
  Shapes shapes{std::vector<EdgeShape>(edges.count()), std::vector<double>(mesh.vertex_count(), kInfinity)};
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const Index e = edges.edge(h), f = Mesh::face_of(h);
    EdgeShape& shape = shapes.edges[e];
    shape.length = lengths[h];
    if (!mesh.is_face_usable(f)) continue;  // but a wall counts: points stay where they are when it goes
    const Index from = faces[f][h % 3];
    const bool same_way = from == edges.end(e, false);
    // With a grain: as the face is laid out, where lengths are costs, but for the edge, which keeps its own.
    const auto length = [&](Index g) { return lengths[g] * (stretches.along(g) / stretches.along(h)); };
    const double area = double_areas[f] * (stretches.area(f) / (stretches.along(h) * stretches.along(h)));
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
    double& height = shapes.height[from];
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
  counts_.reserve(edges.count());
  rows_.reserve(edges.count() + std::size_t{1});
  std::uint64_t size = 0;
  for (Index e = 0; e < edges.count(); ++e) {
    const EdgeShape& shape = shapes.edges[e];
    const double sum = shape.sine[0] + shape.sine[1];
    const double split = sum > 0 ? shape.length * (shape.sine[1] / sum) : 0.5 * shape.length;
    for (const int k : {0, 1}) {
      const Index v = edges.end(e, k != 0);
      // An altitude that has vanished in rounding says nothing, and no interval needs to be shorter than this.
      const double least =
          density.least * std::max(std::min(height[weighted.vertex(v)], shape.length), shape.length * 0x1p-20);
      halves.emplace_back(k == 0 ? split : shape.length - split, density.growth * shape.sine[k], least,
                          std::max<Index>(1, density.most / 2));
    }
    const Index count = std::max<Index>(1, halves[2 * e].count + halves[2 * e + 1].count) + 1;
    const Index room = (count + kLanes - 1) / kLanes * kLanes;
    counts_.push_back(count);
    rows_.push_back(static_cast<Index>(size));
    size += room;
    longest_ = std::max(longest_, room);
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
  rows_.push_back(static_cast<Index>(size));
  at_.assign(static_cast<std::size_t>(size), 0);
  for (Index e = 0; e < edges.count(); ++e) {
    const double length = shapes.edges[e].length;
    const Half &first = halves[2 * e], &last = halves[2 * e + 1];
    double* const row = at_.data() + rows_[e];
    double place = 0;
    for (Index i = 1; i <= first.count; ++i) row[i] = place = first.first + first.ratio * place;
    place = 0;
    for (Index i = counts_[e] - 2; i > first.count; --i) row[i] = length - (place = last.first + last.ratio * place);
    // Rounding must not put points out of order.
    for (Index i = 1; i + 1 < counts_[e]; ++i) row[i] = std::clamp(row[i], row[i - 1], length);
    std::fill(row + counts_[e] - 1, row + (rows_[e + 1] - rows_[e]), length);
  }
}

Index PointLayout::edge_of(Index point) const {
  return static_cast<Index>(std::upper_bound(rows_.begin(), rows_.end(), point) - rows_.begin() - 1);
}

}  // namespace brushfire::steiner
