// What it costs to get to a vertex from beside it, in closed form.
//
// The faces around a vertex v make a cone, in which costs grow in proportion to the distance from v: at distance r in
// direction t it is r g(t). What a front may do turns that into g^2 + g'^2 = w^2 within a face of weight w: either
// g = w, straight to v; or parallel light, which meets a spoke (an edge at v) at the critical angle and goes along it,
// g = g_s cos(a) + sqrt(w^2 - g_s^2) sin(a) at an angle a from a spoke of g_s, as long as cos(a) > g_s / w. Spokes cost
// what going along them does, or less where such light comes from the next one. That is no less than where it comes
// from, so that spokes are final in the order of their costs.
#pragma once

#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/steiner/detail/weighted_mesh.h>

#include <array>
#include <span>
#include <vector>

namespace brushfire::steiner {

class ApexCosts {
 public:
  // The mesh must be isotropic. O(n log n) for n faces around v. `weighted` must outlive it.
  ApexCosts(const WeightedMesh& weighted, Index v);

  // From a place in the face of halfedge h, which leaves v, by its weights there, to v, as if the cone went on for
  // ever. In mesh.unit() times weight, to a relative `rounding()`.
  struct Way {
    double cost;
    bool is_real;  // it is no farther from v than where the cone ends, so that there is such a path
  };
  Way to_apex(Index h, const std::array<double, 3>& weights) const;
  // Paths to v from where the cone ends, or over a fence that ends at v, cost no less.
  double beyond() const { return beyond_; }
  double rounding() const { return rounding_; }
  // False where rounding leaves nothing of the angles: the rest means nothing then.
  bool is_known() const { return rounding_ < 1e-3; }

 private:
  struct Spoke {
    Index edge;
    double cost;
  };
  std::size_t place_of(Index edge) const;
  void spread();

  const WeightedMesh& weighted_;
  Index vertex_;
  std::vector<Spoke> spokes_;  // by edge
  double reach_ = kInfinity;   // of the cone
  double beyond_ = 0, rounding_ = kInfinity;
};

// The vertices that sources are nearest to, and what it costs to get there: to a share of itself, however near they
// are.
struct NearVertex {
  Index vertex = kNoIndex;              // kNoIndex: none
  double lower = 0, upper = kInfinity;  // in mesh.unit() times weight
  double beyond = 0;                    // no path from outside of its cone costs less

  void add(double offset, const ApexCosts::Way& way, double rounding);
};

// Nothing is near a source at a vertex, along a curve, or where angles are lost to rounding. `weighted` must be
// isotropic. O(n log n) for n sources and the faces around their vertices.
struct NearVertices {
  NearVertices(const WeightedMesh& weighted, std::span<const detail::LocatedSource> sources);

  const NearVertex* at(Index v) const;  // null: no source is nearest to it

  std::vector<NearVertex> of_source;  // [sources] from it alone, without its offset
  std::vector<NearVertex> bounds;     // ascending: of each such vertex, from all sources
};

}  // namespace brushfire::steiner
