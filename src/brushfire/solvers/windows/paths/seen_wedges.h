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

  // False where the wedge, of whose edge `span` is visible, is one that came before, to `room`. Remembers it.
  bool is_new(const Mesh& mesh, const Wedge& w, Vec2 span, double room) {
    Index first = w.halfedge;
    for (Index g = mesh.opposite()[first]; g != w.halfedge; g = mesh.opposite()[g]) first = std::min(first, g);
    const double length = mesh.length(w.halfedge);
    const Vec2 edge = (1 / length) * rounded(w.left - w.right), right = rounded(w.right);
    const double along = -dot(edge, right), across = std::abs(cross(edge, right));
    const bool forward = w.right_vertex < w.left_vertex;
    const Seen now{
        {forward ? along : length - along, across}, forward ? span.x : 1 - span.y, forward ? span.y : 1 - span.x};
    std::vector<Seen>& others = seen_[first];
    const auto recent = others.end() - std::min<std::ptrdiff_t>(std::ssize(others), kRecent);
    const bool seen = std::any_of(recent, others.end(), [&](const Seen& s) {
      return std::abs(s.place.x - now.place.x) <= room && std::abs(s.place.y - now.place.y) <= room &&
             (s.first - now.first) * length <= room && (now.last - s.last) * length <= room;
    });
    if (!seen) others.push_back(now);
    return !seen;
  }

 private:
  struct Seen {
    Vec2 place;  // of the point, in the frame of the edge
    double first, last;
  };

  std::unordered_map<Index, std::vector<Seen>> seen_;  // by the lowest halfedge of the edge
};

}  // namespace brushfire::windows
