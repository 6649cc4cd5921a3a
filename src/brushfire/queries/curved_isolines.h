// Curved isolines: the level sets of the exact distance itself, not of its values at the vertices.
#pragma once

#include <brushfire/queries/isolines.h>
#include <brushfire/solvers/window_field.h>

#include <span>
#include <vector>

namespace brushfire {

// The curves on which the exact distance equals the levels: arcs of circles around the sources and around the vertices
// that shortest paths bend at, with corners where two fronts meet. `field`: of a run with
// DistanceOptions::keep_windows, values in the mesh's units; merged windows (a tolerance) give the curves of the merged
// field.
//
// Every node lies on its level to rounding. Arcs are followed by straight pieces that stay within `chord_error` (> 0,
// the mesh's units) of them, and corners are cut by less than that. How curves run does not hang on how large faces are
// or where vertices lie: parts of a level set, and gaps between them, of at least the chord error are found wherever
// they lie (an eighth of the face's longest edge, where that is less). Order, orientation, closedness and ends are
// those of isolines(). A corner that is farther than the run went (DistanceOptions::max_distance) lies above all
// levels.
//
// Throws as isolines() does, Error(InvalidArgument) for a chord error that is not > 0 and for a field without windows.
// Some tens of evaluations of the field for every face that a level crosses, more where fronts meet, and 10 for every
// node.
//
// Based on: Surazhsky et al., "Fast exact and approximate geodesics on meshes", 2005 (what windows say inside faces).
std::vector<Isoline> curved_isolines(const WindowField& field, std::span<const double> levels, double chord_error);

}  // namespace brushfire
