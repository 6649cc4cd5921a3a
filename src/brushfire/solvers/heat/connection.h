// Tangent spaces at the vertices of a triangulation, and the Laplacian of vectors in them.
//
// Based on: Knoppel, Crane, Pinkall, Schroder, "Globally optimal direction fields", 2013.
#pragma once

#include <brushfire/mesh/detail/components.h>
#include <brushfire/solvers/heat/operators.h>
#include <brushfire/solvers/heat/scales.h>
#include <brushfire/solvers/heat/triangulation.h>

#include <complex>
#include <optional>
#include <utility>
#include <vector>

namespace brushfire::heat {

using Complex = std::complex<double>;

// Angles at vertices: bearings count them from the first edge on, as they are; directions stretch the sum of the angles
// to a full turn, on a border to half of one. Flips change neither.
struct TangentSpaces {
  std::vector<double> total;    // [vertex_count] the sum of the angles
  std::vector<double> stretch;  // [vertex_count] direction = stretch * bearing
};

// Fills t.bearing. The first edge is that of the lowest halfedge; on a border that one of the two after which the
// surface comes. At a vertex of several fans the angles of one follow those of another.
TangentSpaces lay_out_tangents(Triangulation& t);

// The direction of halfedge h at its tail; and at its head the one back along it.
Complex direction(const Triangulation& t, const TangentSpaces& spaces, Index h);
Complex direction_back(const Triangulation& t, const TangentSpaces& spaces, Index h);

// The direction of halfedge k of a triangle laid flat.
Complex direction_in(const FlatTriangle& flat, int k);

// A matrix M + t L, below the diagonal, and its factors.
template <class Scalar>
struct HeatEquation {
  HeatEquation(const Pattern& pattern, std::vector<Scalar> entries)
      : matrix(std::move(entries)), factors(pattern, {&matrix, 1}) {}

  std::vector<Scalar> matrix;
  Factors<Scalar> factors;
};

// A surface with its tangent spaces, and both heat equations on it, each factored when it is first asked for.
class VectorSystem {
 public:
  // Throws Error(InvalidArgument) for what is no oriented manifold. `time_factor` and `time` as in HeatOptions.
  VectorSystem(const Mesh& mesh, bool delaunay, double time_factor, double time);

  const Triangulation& triangulation() const { return triangulation_; }
  const TangentSpaces& spaces() const { return spaces_; }
  const Operators& operators() const { return operators_; }
  const detail::Components& components() const { return components_; }
  double time() const { return times_.all; }  // in mesh.unit() squared
  // 1 at a vertex in no face.
  double time_at(Index v) const {
    return components_.of_vertex[v] == kNoIndex ? 1 : times_.of[components_.of_vertex[v]];
  }
  // Whether all of a component lies at one place.
  bool is_point(Index component) const { return is_point_[component]; }
  // The bearings of the mesh's own halfedges, which are those before any flip.
  const std::vector<double>& mesh_bearings() const { return mesh_bearings_; }
  // [halfedges] of each edge its own triangle's share, as the heat equations have it: half a cotangent; but 0 where an
  // edge, on a border opposite of an obtuse angle, would have less. With no negative weight heat is positive, and the
  // equation of vectors, whose frames need not agree around a triangle, is positive definite.
  const std::vector<double>& weights() const { return weights_; }
  // The entries of the connection Laplacian below the diagonal, of cotangents as they are: entry (i, j) takes a vector
  // from the frame of j to that of i along the edge, times minus its weight.
  std::vector<Complex> connection_laplacian() const;

  const HeatEquation<double>& scalar_heat();
  const HeatEquation<Complex>& vector_heat();

 private:
  Triangulation triangulation_;
  TangentSpaces spaces_;
  std::vector<double> mesh_bearings_;
  Operators operators_;
  detail::Components components_;
  std::vector<double> weights_;
  Times times_;
  std::vector<bool> is_point_;  // [components]
  std::optional<HeatEquation<double>> scalar_;
  std::optional<HeatEquation<Complex>> vector_;
};

}  // namespace brushfire::heat
