// Vertices at which hundreds of faces meet, as wheels that light crosses from spoke to spoke, many faces at once.
#pragma once

#include <brushfire/solvers/windows/algebra/window.h>
#include <brushfire/solvers/windows/propagation/face.h>

#include <span>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// The faces at a hub are its wheel, the edges between them spokes, the edges opposite of the hub the rim. Light that
// has come over the rim crosses up to all of the wheel before it comes to the rim again: n windows through n faces
// each. But all that happens meanwhile is that a plane is turned about the hub, and turns are products that can be had
// for any two spokes. So a window is carried to the last spoke before its first ray leaves the wheel, and is what it
// would be had it gone from face to face; it stays the same window with the same rays, and no lemma of
// docs/tolerance.md is touched. The faces between are no part of its trail: faces of a branch that it has entered
// differ all the same (L11).
class Wheels {
 public:
  // The wheel of a vertex, by the halfedge that leaves it in one of its faces. Nothing, where the faces around it are
  // not one fan that is oriented alike.
  void add(std::span<const WindowFace> faces, Index halfedge);
  bool empty() const { return sweeps_.empty(); }

  // Faces that are not to be passed over, of a run.
  void stop_at(std::span<const Index> faces);

  // Carries w, which is about to enter a face over spoke h, to a later spoke, whose halfedge is returned; or h. In
  // O(log faces) on a rim that is anything like round.
  Index carry(Index h, Window& w) const;

 private:
  // The faces in the order in which light sweeps over them one way round: face i lies between spokes i and i + 1. Where
  // they close up, the spoke behind the last face is the first one again.
  struct Sweep {
    std::vector<Index> entrance;  // [faces] the halfedge over which face i is entered, on spoke i
    std::vector<Vec2> turn;       // [faces + 1] from spoke 0 to spoke i: cosine and sine
    std::vector<double> angle;    // [faces + 1] likewise
    std::vector<Real> length;     // [faces + 1] of spoke i
    // nearest[m][i]: the length of the shortest of the spokes behind i 2^m, up to (i + 1) 2^m.
    std::vector<std::vector<double>> nearest;
    std::vector<Index> stops;  // ascending
    bool from_hub;             // the entrances lead away from the hub
    bool closed;
  };
  // Where a ray can be followed to, and the turn that it takes.
  struct Reach {
    Index face;
    Vec2 turn;
    Index passed;  // faces
  };
  struct Place {
    Index sweep = kNoIndex, face = 0;
  };

  void add_sweep(std::span<const WindowFace> faces, std::vector<Index> entrance, bool from_hub, bool closed);
  static Reach last_before_rim(const Sweep& sweep, Index first, Vec2 source, Real from);

  std::vector<Sweep> sweeps_;
  std::vector<Place> place_;  // [halfedges], of entrances
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
