// The value of any point of a mesh, from all windows of a run.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/windows/algebra/curve_index.h>
#include <brushfire/solvers/windows/algebra/rays.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace brushfire::windows {

// See Ray; as doubles, in types that every number's room can name.
struct PlainRay {
  brushfire::Vec2 source;
  Index halfedge = kNoIndex, pseudo_source = kNoIndex;
  bool parallel = false;  // of linear windows
};

// The least that the run knows of a point: its name in the face over which that came, the value with all offsets, in
// mesh.unit(), rounded to a double, and the ray. Infinity where the run did not come.
struct PointValue {
  Index face = kNoIndex;
  std::array<double, 3> weights{0, 0, 0};
  double value = kInfinity;
  Index label = kNoIndex;
  PlainRay ray;
};

// The light of one virtual source in a face, in the plane of flat_corners(), mesh.unit(): it comes to the points within
// all borders, and only there may it be what decides their value.
struct FaceFront {
  struct Border {
    brushfire::Vec2 point, inward;  // lit: dot(p - point, inward) >= 0; `inward` of length 1
  };

  bool parallel = false;
  brushfire::Vec2 source;  // the point; parallel: the unit vector back to where the light comes from
  double sigma = 0;        // the value there; parallel: at the plane's origin
  Index label = kNoIndex;
  std::array<Border, 3> borders;
  int border_count = 0;

  double value(brushfire::Vec2 p) const { return parallel ? sigma - dot(p, source) : sigma + norm(p - source); }
  // Which way the value grows at p; not of length 1.
  brushfire::Vec2 way(brushfire::Vec2 p) const { return parallel ? -1 * source : p - source; }
};

class PointValues {
 public:
  virtual ~PointValues() = default;
  // O(windows of the faces that hold the point).
  virtual PointValue at(const PointLocation& point) const = 0;
  // The value of every point of a usable face is the least of these that come to it. O(windows of the face).
  virtual std::vector<FaceFront> fronts_in(Index face) const = 0;
};

}  // namespace brushfire::windows

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// In the numbers of the run: a window that is rounded is as wrong as one of a run in narrower numbers.
class KeptWindows final : public PointValues {
 public:
  struct Vertex {
    Real value = kInfinity;  // NaN: not known
    Index label = kNoIndex;
  };
  // What the run began with and found, by the mesh's numbers; the windows in any order. `shift`: what was added to all
  // values.
  KeptWindows(const Mesh& mesh, std::span<const detail::LocatedSource> sources, Real shift,
              std::vector<Vertex> vertices, std::span<const KeptWindow> windows);

  PointValue at(const PointLocation& point) const override;
  std::vector<FaceFront> fronts_in(Index face) const override;

 private:
  class Least;
  class Fronts;
  void offer_corners(const FaceWeights& at, Least& least) const;
  void offer_sources(const FaceWeights& at, Least& least) const;
  void offer_curves(const FaceWeights& at, Index k, Least& least) const;
  void offer_windows(const FaceWeights& at, Least& least) const;

  // A source that is a point, by a face that holds it, unless it is a vertex.
  struct PointSource {
    FaceWeights at;
    Index source;
  };
  std::span<const PointSource> point_sources_in(Index face) const;

  Mesh mesh_;
  std::vector<detail::LocatedSource> sources_;
  std::vector<PointSource> point_sources_;  // by face, then by source
  CurveIndex curves_;
  Real shift_;
  std::vector<Vertex> vertices_;
  std::vector<std::size_t> first_;  // [halfedge_count + 1]
  std::vector<Window> windows_;     // by halfedge
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
