// Corner lists, opposite rings and vertex links.
#include <brushfire/mesh/detail/connectivity.h>

#include <algorithm>
#include <utility>

namespace brushfire::detail {
namespace {

bool usable(const Face& t) { return t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; }

// Links the halfedges of one edge, given in ascending order, in a ring.
void link_ring(std::span<const std::pair<Index, Index>> same_edge, std::vector<Index>& opposite) {
  for (std::size_t i = 0; i < same_edge.size(); ++i) {
    opposite[same_edge[i].second] = same_edge[(i + 1) % same_edge.size()].second;
  }
}

// Small lists (a vertex of ordinary valence) are sorted by insertion: std::sort costs three times as much there.
void sort_pairs(std::vector<std::pair<Index, Index>>& list) {
  constexpr std::size_t kInsertionLimit = 24;
  if (list.size() > kInsertionLimit) {
    std::sort(list.begin(), list.end());
    return;
  }
  for (std::size_t i = 1; i < list.size(); ++i) {
    const auto item = list[i];
    std::size_t j = i;
    for (; j > 0 && item < list[j - 1]; --j) list[j] = list[j - 1];
    list[j] = item;
  }
}

// The halfedge that leaves v over the other edge of the corner's face: v is between `corner` and this one's edge.
Index incoming(Index corner) { return Mesh::previous(corner); }

}  // namespace

VertexCorners build_corners(Index vertex_count, std::span<const Face> faces) {
  VertexCorners result;
  result.offset.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
  for (const Face& t : faces) {
    for (const Index v : t) ++result.offset[v + 1];
  }
  for (Index v = 0; v < vertex_count; ++v) result.offset[v + 1] += result.offset[v];
  result.corner.resize(3 * faces.size());
  std::vector<Index> fill(result.offset.begin(), result.offset.end() - 1);
  for (Index h = 0; h < result.corner.size(); ++h) result.corner[fill[faces[h / 3][h % 3]]++] = h;
  return result;
}

std::vector<Index> build_opposite(std::span<const Face> faces, const VertexCorners& corners) {
  std::vector<Index> opposite(3 * faces.size());
  for (Index h = 0; h < opposite.size(); ++h) opposite[h] = h;
  std::vector<std::pair<Index, Index>> upward;  // (other end, halfedge) of the edges from v to a higher vertex
  const Index vertex_count = static_cast<Index>(corners.offset.size() - 1);
  for (Index v = 0; v < vertex_count; ++v) {
    upward.clear();
    for (Index i = corners.offset[v]; i < corners.offset[v + 1]; ++i) {
      const Index h = corners.corner[i];
      const Face& t = faces[h / 3];
      if (!usable(t)) continue;
      const Index ahead = t[(h + 1) % 3];
      const Index back = t[(h + 2) % 3];
      if (ahead > v) upward.emplace_back(ahead, h);
      if (back > v) upward.emplace_back(back, incoming(h));
    }
    sort_pairs(upward);
    for (std::size_t begin = 0; begin < upward.size();) {
      std::size_t end = begin + 1;
      while (end < upward.size() && upward[end].first == upward[begin].first) ++end;
      if (end - begin > 1) link_ring(std::span(upward).subspan(begin, end - begin), opposite);
      begin = end;
    }
  }
  return opposite;
}

void open_ring(Index h, std::vector<Index>& opposite) {
  while (opposite[h] != h) h = std::exchange(opposite[h], h);
}

std::vector<Link> build_links(std::span<const Face> faces, const VertexCorners& corners,
                              std::span<const Index> opposite) {
  const Index vertex_count = static_cast<Index>(corners.offset.size() - 1);
  std::vector<Link> links(vertex_count, Link::Empty);
  // The faces around v, walked over the edges that contain v. Around a manifold vertex every edge has one or two
  // faces, so a walk that counts all faces before it closes or ends has seen one circle or one arc.
  for (Index v = 0; v < vertex_count; ++v) {
    Index count = 0, boundary = 0, first = kNoIndex, open_end = kNoIndex;
    bool manifold = true;
    for (Index i = corners.offset[v]; i < corners.offset[v + 1]; ++i) {
      const Index h = corners.corner[i];
      if (!usable(faces[h / 3])) continue;
      ++count;
      if (first == kNoIndex) first = h;
      for (const Index edge : {h, incoming(h)}) {
        const Index other = opposite[edge];
        if (other == edge) {
          ++boundary;
          open_end = edge;
        } else if (opposite[other] != edge) {
          manifold = false;
        }
      }
    }
    if (count == 0) continue;
    if (!manifold || boundary > 2) {
      links[v] = Link::Other;
      continue;
    }
    // Enter the first face over one of v's edges in it, leave over the other one, and so on.
    Index entry = boundary > 0 ? open_end : first, seen = 0;
    const Index start = entry;
    while (true) {
      ++seen;
      const Index exit = faces[entry / 3][entry % 3] == v ? incoming(entry) : Mesh::next(entry);
      const Index other = opposite[exit];
      if (other == exit || other == start || seen > count) break;
      entry = other;
    }
    links[v] = seen != count ? Link::Other : boundary > 0 ? Link::Arc : Link::Circle;
  }
  return links;
}

}  // namespace brushfire::detail
