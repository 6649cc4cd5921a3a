// Fronts that start at points inside faces and on edges, and that are read there.
#pragma once

#include <brushfire/solvers/carried_source/detail/march.h>
#include <brushfire/solvers/carried_source/detail/sight.h>
#include <brushfire/solvers/detail/start.h>

#include <array>
#include <memory>
#include <unordered_map>
#include <vector>

namespace brushfire::carried_source {

// Made once for a mesh; the fans around points that are no vertices are laid out, and kept, as they are asked for.
class Points {
 public:
  explicit Points(const Mesh& mesh) : mesh_(mesh), builder_(mesh) {}

  // A source's distance at a vertex of one of its faces, and the way to it.
  struct Near {
    Index vertex = kNoIndex;
    double distance = 0;
    Vec2 to_source;    // in the vertex's frame; of length `distance`
    bool seen = true;  // false: the direction has no meaning, the vertex becomes a source of its own
    Index sector = 0;
  };
  // The corners of its faces; of a point that is no vertex also those that it sees across up to `crossings` edges, not
  // farther than `limit`: an obtuse corner is offered nothing over its own edge, behind which the point may lie. Lasts
  // until the next call.
  std::span<const Near> around(const PointLocation& named, int crossings, double limit);

  // The vertices at the corners of all faces that hold the point, and how far they are.
  std::span<const detail::Seed> corners(const PointLocation& at) { return seeds_.in_own_faces(mesh_, at); }

  // The values of two ends of an edge, and of their sources.
  struct Known {
    double value = kInfinity, sigma = kInfinity;
    Vec2 to_source;
    Index sector = 0;
  };
  // What the front of the two ends of halfedge h has at a point in the frame of h, above it.
  double through_edge(Index h, Vec2 at, const Known& from, const Known& to);
  // Where the ends belong to different sources: of each one by itself.
  std::array<double, 2> from_either_end(Index h, Vec2 at, const Known& from, const Known& to);

 private:
  struct Lights {
    SourceAt<double> from, to;  // both from the first end on
  };
  Lights below_edge(Index h, const Known& from, const Known& to);
  const Fans& fans(Index v);
  const FanCorner& corner(Index h) { return fans(mesh_.from(h)).corner(h); }
  PointLocation by_lowest_halfedge(const PointLocation& at) const;
  void add_face(Index f, const std::array<double, 3>& weights);
  SourceAt<double> see(Index v, const Known& known, const Direction& side, Hand hand, double length);

  const Mesh& mesh_;
  FanBuilder builder_;
  std::unordered_map<Index, Fans> fans_;
  detail::SeedSearch seeds_;
  std::vector<Near> near_;
};

}  // namespace brushfire::carried_source
