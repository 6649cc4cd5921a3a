// How far a solver is from the truth, and what can be reached at all: shared by the tests and the exactness benchmark.
#pragma once

#include "oracle/polyhedral.h"

#include <random>
#include <span>
#include <string>
#include <vector>

namespace brushfire::oracle {

struct Deviation {
  double relative = 0;      // largest |got - truth| / max(|truth|, floor)
  Index at = kNoIndex;      // where
  Index wrong_reach = 0;    // finite where the truth is infinite, or the other way round
  Real got = 0, truth = 0;  // there

  void add(Real value, Real expected, Index where, Real floor = 0);
  void add(const Deviation& other);
  bool within(double tolerance) const { return wrong_reach == 0 && relative <= tolerance; }
  std::string text() const;
};

// `floor`: distances below it are compared absolutely; what offsets of opposite sign cancel is lost to every solver.
Deviation deviation(std::span<const double> got, std::span<const Real> truth, Real floor = 0);

// Options for the exact method.
DistanceOptions exact_options(double radius = kInfinity);

// Method::Exact against the oracle, at all vertices and targets.
Deviation exact_against_oracle(const Mesh& mesh, std::span<const Source> sources, double radius = kInfinity,
                               std::span<const SurfacePoint> targets = {});

// A random vertex that is in some face; a random point of the edges; a random point inside a face.
SurfacePoint random_vertex(const Mesh& mesh, std::mt19937& random);
SurfacePoint random_edge_point(const Mesh& mesh, std::mt19937& random);
SurfacePoint random_face_point(const Mesh& mesh, std::mt19937& random);

// Which vertices hang together with the sources through faces, by union-find over the faces' corners.
std::vector<bool> reachable(const Mesh& mesh, std::span<const Source> sources);

}  // namespace brushfire::oracle
