// Where light goes on from a vertex around which faces form several fans, or books.
#pragma once

#include <brushfire/solvers/windows/propagation/fan.h>

#include <span>
#include <utility>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// L6 around any vertex. Its link is a graph: a node for each edge at the vertex, and for each corner an arc as long as
// its angle between the nodes of both of its edges. A path bends at the vertex only if the way in the link from where
// it arrives to where it leaves is nowhere shorter than pi. Keeps its memory from call to call.
class LinkShadow {
 public:
  // `corners`: all of the vertex, by inner halfedges. What is returned lasts until the next call. O(corners
  // log corners).
  std::span<const Sector> operator()(const WindowStructure& mesh, std::span<const Index> corners,
                                     const CrossedAt& arrival);

 private:
  struct Arc {
    Index halfedge;  // of the corner
    Index from, to;  // nodes of the edge that leaves the corner, and of the one that enters it
    double angle;
  };
  void find_nodes(const WindowStructure& mesh, std::span<const Index> corners);
  void measure_from(const WindowStructure& mesh, const CrossedAt& arrival);

  std::vector<std::pair<Index, Index>> sides_;  // halfedges at the vertex, ascending, and their nodes
  std::vector<Arc> arcs_;
  std::vector<double> way_;                      // [nodes] from the arrival, no farther than pi
  std::vector<std::vector<Index>> arcs_at_;      // [nodes or more]
  std::vector<std::pair<double, Index>> queue_;  // a heap of nodes, the nearest first
  std::vector<Sector> sectors_;
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
