// Level sets of the piecewise linear field, traced from face to face.
#include <brushfire/queries/isolines.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/memory.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace brushfire {
namespace {

// Stands for the rank of a value of +inf.
constexpr Index kUnreached = kNoIndex;

void check(const Mesh& mesh, std::span<const double> values, std::span<const double> levels) {
  if (values.size() != mesh.vertex_count()) {
    throw Error(ErrorCode::InvalidArgument,
                std::to_string(values.size()) + " values for " + std::to_string(mesh.vertex_count()) + " vertices");
  }
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (std::isnan(values[v]) || values[v] == -kInfinity) {
      throw Error(ErrorCode::InvalidArgument, "vertex " + std::to_string(v) + " reads " + number_as_text(values[v]) +
                                                  ": a value is finite or +inf");
    }
  }
  for (const double level : levels) {
    if (!std::isfinite(level)) {
      throw Error(ErrorCode::InvalidArgument, "level " + number_as_text(level) + " is not finite");
    }
  }
}

// A point of a curve: where it crosses an edge, and at which vertex, where it is one.
struct Node {
  SurfacePoint point;
  Index vertex = kNoIndex;
};

bool same_vertex(const Node& a, const Node& b) { return a.vertex != kNoIndex && a.vertex == b.vertex; }

// a, b, a with b at a vertex: there and back along an edge.
bool is_spike(const Node& a, const Node& b, const Node& c) { return same_vertex(a, c) && b.vertex != kNoIndex; }

// Removes repeated points and spikes; what is left may be empty.
void clean(std::vector<Node>& nodes, bool closed) {
  std::vector<Node> kept;
  const auto append = [&kept](const Node& node) {
    // The later of two names of a vertex: it is in the face of the piece that follows.
    if (!kept.empty() && same_vertex(kept.back(), node)) {
      kept.back() = node;
    } else if (kept.size() >= 2 && is_spike(kept[kept.size() - 2], kept.back(), node)) {
      kept.pop_back();
      kept.back() = node;
    } else {
      kept.push_back(node);
    }
  };
  for (const Node& node : nodes) append(node);
  std::size_t first = 0;
  while (closed && kept.size() - first >= 2) {
    const std::size_t last = kept.size() - 1;
    if (same_vertex(kept[first], kept[last]) || is_spike(kept[last - 1], kept[last], kept[first])) {
      kept.pop_back();
    } else if (is_spike(kept[last], kept[first], kept[first + 1])) {
      ++first;
    } else {
      break;
    }
  }
  nodes.assign(kept.begin() + static_cast<std::ptrdiff_t>(first), kept.end());
}

class Tracer {
 public:
  Tracer(const Mesh& mesh, std::span<const double> values, std::span<const Index> rank)
      : mesh_(mesh), values_(values), rank_(rank), opposite_(mesh.opposite()), seen_in_(mesh.face_count(), kNoIndex) {}

  // Traces the curves through these faces, each of which the level crosses. Vertices of a rank above `rank` are above
  // it; `run` is different in every call.
  void trace(double level, Index rank, Index run, std::span<const Index> faces, const auto& emit) {
    level_ = level;
    level_rank_ = rank;
    run_ = run;
    for (const Index f : faces) {
      poll_();
      if (seen_in_[f] == run_) continue;
      seen_in_[f] = run_;
      std::vector<Node> nodes;
      const bool closed = trace_from(f, nodes);
      clean(nodes, closed);
      if (nodes.size() >= 2) emit(nodes, closed);
    }
  }

 private:
  bool above(Index v) const { return rank_[v] > level_rank_; }
  bool crosses(Index h) const { return above(mesh_.from(h)) != above(mesh_.to(h)); }

  // The face over edge h, as the halfedge there, where a curve runs on through it; h itself where it ends.
  Index across(Index h) const {
    const Index g = opposite_[h];
    if (opposite_[g] != h) return h;
    for (const Index v : mesh_.faces()[Mesh::face_of(g)]) {
      if (rank_[v] == kUnreached) return h;
    }
    return g;
  }

  Index other_crossing(Index h) const { return crosses(Mesh::next(h)) ? Mesh::next(h) : Mesh::previous(h); }

  // Both ways from face f; every node is named in the face of the piece that follows it. True: the curve is closed.
  bool trace_from(Index f, std::vector<Node>& nodes) {
    // Smaller values on the left: in over the edge that rises along the face's own direction, out over the other one.
    Index enter = 3 * f;
    while (!crosses(enter) || above(mesh_.from(enter))) ++enter;
    nodes.push_back(node(enter));
    for (Index h = other_crossing(enter);;) {
      poll_();
      const Index g = across(h);
      const Index next_face = Mesh::face_of(g);
      if (g != h && next_face == f) return true;
      nodes.push_back(node(g));
      if (g == h) break;
      seen_in_[next_face] = run_;
      h = other_crossing(g);
    }
    std::vector<Node> before;
    for (Index h = enter;;) {
      const Index g = across(h);
      if (g == h) break;
      seen_in_[Mesh::face_of(g)] = run_;
      h = other_crossing(g);
      before.push_back(node(h));
    }
    nodes.insert(nodes.begin(), before.rbegin(), before.rend());
    return false;
  }

  // Counted from the lower vertex, so that both faces of an edge get the same bits.
  Node node(Index h) const {
    const Index from = mesh_.from(h), to = mesh_.to(h);
    const Index low = std::min(from, to), high = std::max(from, to);
    const double a = values_[low], b = values_[high];
    double share = std::clamp((level_ - a) / (b - a), 0.0, 1.0);
    Node result;
    if (share <= kWeightSnap) {
      share = 0;
      result.vertex = low;
    } else if (1 - share <= kWeightSnap) {
      share = 1;
      result.vertex = high;
    }
    result.point.face = Mesh::face_of(h);
    result.point.weights[h % 3] = from == low ? 1 - share : share;
    result.point.weights[Mesh::next(h) % 3] = from == low ? share : 1 - share;
    return result;
  }

  const Mesh& mesh_;
  std::span<const double> values_;
  std::span<const Index> rank_;
  std::span<const Index> opposite_;
  std::vector<Index> seen_in_;  // [face_count] the last run that came through the face
  double level_ = 0;
  Index level_rank_ = 0, run_ = 0;
  Poll poll_;
};

// [vertex_count] how many of the levels are <= the value; kUnreached for +inf.
std::vector<Index> ranks(std::span<const double> values, std::span<const double> sorted_levels) {
  std::vector<Index> rank(values.size());
  Poll poll;
  for (std::size_t v = 0; v < values.size(); ++v) {
    poll();
    const auto above = std::upper_bound(sorted_levels.begin(), sorted_levels.end(), values[v]);
    rank[v] = values[v] == kInfinity ? kUnreached : static_cast<Index>(above - sorted_levels.begin());
  }
  return rank;
}

// The levels that cross a face: from `first` up to `end`.
struct CrossedLevels {
  Index first = 0, end = 0;
};
CrossedLevels crossed_levels(const Face& t, std::span<const Index> rank) {
  const auto [low, high] = std::minmax({rank[t[0]], rank[t[1]], rank[t[2]]});
  const bool usable = t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
  return low == high || high == kUnreached || !usable ? CrossedLevels{} : CrossedLevels{low, high};
}

// Refuses curves that will not fit into memory: every crossing of a face is a point of the result and a place in a
// list. They are counted where it could be that many.
void check_size(const Mesh& mesh, std::span<const Index> rank, std::size_t levels) {
  constexpr std::uint64_t kEach = sizeof(SurfacePoint) + sizeof(Index);
  const std::uint64_t memory = available_memory();
  if (mesh.face_count() * std::uint64_t{levels} < memory / kEach) return;
  std::uint64_t crossings = 0;
  Poll poll;
  for (const Face& t : mesh.faces()) {
    poll();
    const CrossedLevels crossed = crossed_levels(t, rank);
    crossings += crossed.end - crossed.first;
  }
  require_memory(
      crossings * kEach, memory,
      std::to_string(levels) + " levels cross faces " + std::to_string(crossings) + " times: to hold the curves",
      "ask for fewer levels");
}

// Per level the faces that it crosses, ascending.
std::vector<std::vector<Index>> crossed_faces(const Mesh& mesh, std::span<const Index> rank, std::size_t levels) {
  std::vector<std::vector<Index>> crossed(levels);
  Poll poll;
  const std::span<const Face> faces = mesh.faces();
  for (Index f = 0; f < faces.size(); ++f) {
    poll();
    const auto [first, end] = crossed_levels(faces[f], rank);
    for (Index level = first; level < end; ++level) crossed[level].push_back(f);
  }
  return crossed;
}

std::pair<double, double> finite_range(std::span<const double> values) {
  double low = kInfinity, high = -kInfinity;
  for (const double x : values) {
    if (!std::isfinite(x)) continue;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  return {low, high};
}

}  // namespace

std::vector<Isoline> isolines(const Mesh& mesh, std::span<const double> values, std::span<const double> levels) {
  check(mesh, values, levels);
  std::vector<double> sorted(levels.begin(), levels.end());
  detail::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  const std::vector<Index> rank = ranks(values, sorted);
  check_size(mesh, rank, levels.size());
  const std::vector<std::vector<Index>> crossed = crossed_faces(mesh, rank, sorted.size());
  Tracer tracer(mesh, values, rank);
  std::vector<Isoline> result;
  for (Index i = 0; i < levels.size(); ++i) {
    const auto place = std::lower_bound(sorted.begin(), sorted.end(), levels[i]) - sorted.begin();
    tracer.trace(levels[i], static_cast<Index>(place), i, crossed[static_cast<std::size_t>(place)],
                 [&](const std::vector<Node>& nodes, bool closed) {
                   Isoline line{levels[i], i, {}};
                   line.line.points.reserve(nodes.size());
                   for (const Node& n : nodes) line.line.points.push_back(n.point);
                   line.line.closed = closed;
                   line.line.length = length_of(mesh, line.line.points, closed);
                   result.push_back(std::move(line));
                 });
  }
  return result;
}

std::vector<Isoline> isolines(const Domain& domain, std::span<const double> values, std::span<const double> levels) {
  std::vector<Isoline> lines = isolines(domain.open(), domain.spread(values), levels);
  for (Isoline& line : lines) domain.to_mesh(line.line.points);
  return lines;
}

std::vector<double> levels_every(std::span<const double> values, double step) {
  if (!(step > 0) || !std::isfinite(step)) {
    throw Error(ErrorCode::InvalidArgument, "step " + number_as_text(step) + " between levels is not a number > 0");
  }
  const auto [low, high] = finite_range(values);
  std::vector<double> levels;
  if (!(low < high)) return levels;
  constexpr double kMostLevels = 1e6;
  const double first = std::floor(low / step) + 1, last = std::floor(high / step);
  if (!(last - first < kMostLevels)) {
    throw Error(ErrorCode::TooLarge, "a step of " + number_as_text(step) + " between " + number_as_text(low) + " and " +
                                         number_as_text(high) + " gives " + number_as_text(last - first) +
                                         " levels: a million is the most");
  }
  for (double k = first; k <= last; ++k) levels.push_back(k * step);
  return levels;
}

std::vector<double> levels_between(std::span<const double> values, Index count) {
  const auto [low, high] = finite_range(values);
  std::vector<double> levels;
  if (!(low < high)) return levels;
  for (Index i = 1; i <= count; ++i) {
    const double share = i / (count + 1.0);
    levels.push_back((1 - share) * low + share * high);
  }
  return levels;
}

}  // namespace brushfire
