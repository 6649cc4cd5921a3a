// Curves at random as sources, and what is known of them without a solver.
#pragma once

#include "corpus/dice.h"

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/distance.h>

#include <optional>
#include <string>
#include <vector>

namespace brushfire::corpus {

// From place to place through faces that hold both: along edges, through vertices and a hair beside them, across
// itself, along boundaries, there and back, closed or in pieces, of a single place, with offsets of any slope up to 1
// or none.
CurveSource random_curve(const Mesh& mesh, Dice& dice);

// A curve, or up to three of them with points between, and offsets.
std::vector<Source> curves_and_points(const Mesh& mesh, Dice& dice);

// What lengths of paths are counted from: the source's offset, and the least of its curve.
double least_offset(const Mesh& mesh, const Source& source);

// The value at a place that a path begins at; of several (where the curve passes more than once) the one nearest to
// `expected`. None where the place is farther from the curve than `room` (in the mesh's units).
std::optional<double> offset_at(const Mesh& mesh, const Source& source, const SurfacePoint& place, double room,
                                double expected);

// A curve's places, for people.
std::string text_of(const CurveSource& curve);

}  // namespace brushfire::corpus
