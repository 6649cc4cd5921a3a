// What marches of one source and of several have in common.
#pragma once

#include <brushfire/solvers/carried_source/detail/update.h>

namespace brushfire::carried_source {

// In mean edges. Order inside the front does not matter much: half an edge measured best for the other methods, too.
inline constexpr double kBucketWidth = 0.5;
// Fronts are not quite as round as their carried sources say.
inline constexpr double kSlack = 0.02;
// Of two sources that give the same value the one that is farther by this foretells more vertices rightly: a ray that
// passes a vertex closely ties, in rounding, with the way through that vertex.
inline constexpr double kFarther = 0.1;
// How far the front is ahead of values that no longer change. Near sources, and where edges are long, a vertex may be
// reached over an edge one end of which is farther than itself, and so late. Flat meshes stay exact with this.
inline constexpr double kSettling = 2;

// In a group, in the greatest difference of its lanes: how much later a vertex has its turn while no lane but one has
// come to it. Near the sources turns wait for the others so, instead of being repeated.
inline constexpr float kLater = 0.25f;

template <class T>
inline constexpr T kNews = 1 - 4 * kEpsilon<T>;

// For 1 / 0, where a vertex is nearer to its source than fronts are known to be round.
template <class T>
inline constexpr T kAnywhere = T(0x1p100);

}  // namespace brushfire::carried_source
