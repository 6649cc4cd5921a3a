// Wedges that a search has looked into already.
#pragma once

#include <brushfire/solvers/windows/paths/wedge.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <vector>

namespace brushfire::windows {

// Two wedges over one edge are one where their places and limits agree to this share of the value.
inline constexpr double kSamePlace = 1e-15;
// Wedges that are one come soon after each other: only so many are looked at.
inline constexpr std::ptrdiff_t kRecent = 32;

// Over edges of many faces one place is reached on many ways, twice as many at each such edge.
class SeenWedges {
 public:
  void clear() { seen_.clear(); }

  // False where the wedge, of whose edge `part` is visible, is one that came before, to `room`. Remembers it.
  bool is_new(const Mesh& mesh, const Wedge& w, const VisiblePart& part, double room) {
    Index first = w.halfedge;
    for (Index g = mesh.opposite()[first]; g != w.halfedge; g = mesh.opposite()[g]) first = std::min(first, g);
    const WideVec2 edge = w.left - w.right;
    const DoubleDouble length = norm(edge), along = -dot(edge, w.right) / length,
                       across = cross(edge, w.right) / length;
    const bool forward = w.right_vertex < w.left_vertex;
    const DoubleDouble from = part.first * length, to = part.last * length;
    const Seen now{{forward ? along : length - along, across.high < 0 ? -across : across},
                   forward ? from : length - to,
                   forward ? to : length - from};
    std::vector<Seen>& others = seen_[first];
    const auto recent = others.end() - std::min<std::ptrdiff_t>(std::ssize(others), kRecent);
    const auto is_at_most = [&](DoubleDouble a, DoubleDouble b) { return (a - b).high <= room; };
    const bool seen = std::any_of(recent, others.end(), [&](const Seen& s) {
      return std::abs((s.place.x - now.place.x).high) <= room && std::abs((s.place.y - now.place.y).high) <= room &&
             is_at_most(s.first, now.first) && is_at_most(now.last, s.last);
    });
    if (!seen) others.push_back(now);
    return !seen;
  }

 private:
  struct Seen {
    WideVec2 place;            // of the point, in the frame of the edge
    DoubleDouble first, last;  // of what is visible, as lengths from the lower vertex
  };

  std::unordered_map<Index, std::vector<Seen>> seen_;  // by the lowest halfedge of the edge
};

}  // namespace brushfire::windows
