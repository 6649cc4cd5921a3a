// From which budget on merging is quicker than an exact run.
#pragma once

#include <algorithm>
#include <cmath>

namespace brushfire::windows {

// What tells before a run how soon merging pays: the numbers of vertices and sources, and how far the angles around a
// vertex typically are from 2 pi.
struct MergeOutlook {
  double vertices = 0, sources = 1, deficit = 0;
};

// Merging saves windows in proportion to the tolerance, exact runs take whole lists at a time: below some tolerance
// they are quicker, and a smaller tolerance must not make anyone wait longer than an exact run. A window that passes a
// vertex on one side and one that passes it on the other differ by the vertex' angle deficit; a merge may spend the
// tolerance times the distance, and in edges that is sqrt(vertices) from one source, sqrt(vertices / sources) from
// sources scattered all over, and in general something in between. So what counts is deficit / reach. The two constants
// were fitted: on 48 meshes of 400 to 1.6 million vertices merging is within 5 % of an exact run or quicker from here
// on, and hardly ever worth it below (docs/decisions/tolerance-speed.md). The least is what merging costs on planes and
// machine parts, where the typical deficit is 0, but not every one.
inline double least_tolerance(const MergeOutlook& outlook) {
  constexpr double kFactor = 0.3, kPower = 2.0 / 3, kOnPlanes = 2e-5;
  const double reach = std::sqrt(outlook.vertices / std::sqrt(outlook.sources));
  return std::max(kOnPlanes, kFactor * std::pow(outlook.deficit / std::max(reach, 1.0), kPower));
}

// As a share of the length (MergeBudget): an estimate of that tolerance may be off to either side.
inline double least_share(const MergeOutlook& outlook) { return 2 * least_tolerance(outlook); }

}  // namespace brushfire::windows
