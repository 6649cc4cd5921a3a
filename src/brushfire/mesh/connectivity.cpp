// Corner lists, opposite rings and vertex links.
#include <brushfire/core/detail/sort.h>
#include <brushfire/mesh/detail/connectivity.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/prefault.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace brushfire::detail {
namespace {

bool usable(const Face& t) { return t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; }

// A halfedge and the other end of its edge, as one number that sorts by that end.
using EndAndHalfedge = std::uint64_t;

EndAndHalfedge pack(Index end, Index h) { return EndAndHalfedge{end} << 32 | h; }
Index end_of(EndAndHalfedge e) { return static_cast<Index>(e >> 32); }
Index halfedge_of(EndAndHalfedge e) { return static_cast<Index>(e); }

// Links the halfedges of one edge, given in ascending order, in a ring.
void link_ring(std::span<const EndAndHalfedge> same_edge, UninitializedArray<Index>& opposite) {
  for (std::size_t i = 0; i < same_edge.size(); ++i) {
    opposite[halfedge_of(same_edge[i])] = halfedge_of(same_edge[(i + 1) % same_edge.size()]);
  }
}

// Small lists (a vertex of ordinary valence) are sorted by counting what is less: no branch that cannot be foreseen.
void sort_edges(std::span<EndAndHalfedge> list) {
  constexpr std::size_t kSmall = 16;
  if (list.size() > kSmall) {
    detail::sort(list.begin(), list.end());
    return;
  }
  std::array<EndAndHalfedge, kSmall> sorted;
  for (const EndAndHalfedge item : list) {
    std::size_t place = 0;
    for (const EndAndHalfedge other : list) place += other < item;
    sorted[place] = item;
  }
  std::copy_n(sorted.begin(), list.size(), list.begin());
}

// The halfedge that leaves v over the other edge of the corner's face: v is between `corner` and this one's edge.
Index incoming(Index corner) { return Mesh::previous(corner); }

}  // namespace

VertexCorners build_corners(Index vertex_count, std::span<const Face> faces) {
  VertexCorners result;
  UninitializedArray<Index>& offset = result.offset;
  offset.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
  for (const Face& t : faces) {
    for (const Index v : t) ++offset[v];
  }
  Index sum = 0;
  for (Index& o : offset) o = sum += o;  // where the corners of v end
  result.corner.resize(3 * faces.size());
  prefault(result.corner);
  for (Index h = sum; h > 0; h -= 3) {  // backwards, so that every list ascends and ends with its offset in place
    const Face& t = faces[h / 3 - 1];
    for (Index k = 3; k-- > 0;) result.corner[--offset[t[k]]] = h - 3 + k;
  }
  return result;
}

UninitializedArray<Index> build_opposite(std::span<const Face> faces, const VertexCorners& corners) {
  UninitializedArray<Index> opposite(3 * faces.size());
  for (Index h = 0; h < opposite.size(); ++h) opposite[h] = h;
  UninitializedArray<EndAndHalfedge> upward;  // the edges from v to higher vertices
  const Index vertex_count = static_cast<Index>(corners.offset.size() - 1);
  Poll poll;
  for (Index v = 0; v < vertex_count; ++v) {
    poll();
    // Written always, kept where wanted: there is no telling which end is the higher one.
    upward.resize(2 * static_cast<std::size_t>(corners.offset[v + 1] - corners.offset[v]));
    std::size_t count = 0;
    for (Index i = corners.offset[v]; i < corners.offset[v + 1]; ++i) {
      const Index h = corners.corner[i];
      const Face& t = faces[h / 3];
      if (!usable(t)) continue;
      const Index ahead = t[Mesh::next(h) % 3], back = t[Mesh::previous(h) % 3];
      upward[count] = pack(ahead, h);
      count += ahead > v;
      upward[count] = pack(back, incoming(h));
      count += back > v;
    }
    upward.resize(count);
    sort_edges(upward);
    for (std::size_t begin = 0; begin < count;) {
      std::size_t end = begin + 1;
      while (end < count && end_of(upward[end]) == end_of(upward[begin])) ++end;
      if (end - begin > 1) link_ring(std::span(upward).subspan(begin, end - begin), opposite);
      begin = end;
    }
  }
  return opposite;
}

void open_ring(Index h, UninitializedArray<Index>& opposite) {
  while (opposite[h] != h) h = std::exchange(opposite[h], h);
}

std::vector<Link> build_links(std::span<const Face> faces, const VertexCorners& corners,
                              std::span<const Index> opposite) {
  const Index vertex_count = static_cast<Index>(corners.offset.size() - 1);
  std::vector<Link> links(vertex_count, Link::Empty);
  // The faces around v, walked over the edges that contain v. Around a manifold vertex every edge has one or two
  // faces, so a walk that counts all faces before it closes or ends has seen one circle or one arc.
  Poll poll;
  for (Index v = 0; v < vertex_count; ++v) {
    poll();
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
