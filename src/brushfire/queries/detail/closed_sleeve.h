// Closed curves that no vertex holds: the shortest one through a ring of faces.
#pragma once

#include <brushfire/queries/detail/sleeve.h>

#include <vector>

namespace brushfire::detail {

// The halfedge of face f over the same edge as h; kNoIndex where that face has none.
Index halfedge_in(const Mesh& mesh, Index h, Index f);

// Two sleeves that meet, joined by the steps between them.
Sleeve joined(const Sleeve& a, const std::vector<Step>& between, const Sleeve& b);

// The shortest closed curve through the faces of `ring`, each of whose steps leads to the next and the last to the
// first, as straight pieces in order. Where it passes a vertex it begins at one, else somewhere on the ring's first
// edge in one piece; nothing where the ring is empty once steps over an edge and back are taken away: it pulls
// together.
//
// Its length is a convex function of where it crosses one edge, with a slope that is read off the two ends: some ten
// times the cost of shortest_in_sleeve.
std::vector<StraightPiece> shortest_in_ring(const Mesh& mesh, std::vector<Step> ring, FrameCache& frames);

// Pieces of a closed curve that begins and ends anywhere, of the same kind: the shortest through their faces.
std::vector<StraightPiece> without_free_end(const Mesh& mesh, std::vector<StraightPiece> pieces, FrameCache& frames);

}  // namespace brushfire::detail
