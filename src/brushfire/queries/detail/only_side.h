// A point of a domain as one of the domain's open mesh, for what is measured by angles around it.
#pragma once

#include <brushfire/mesh/domain.h>

namespace brushfire::detail {

// The one point of domain.open() that lies at `point`. Throws Error(InvalidArgument) where there is none, behind a
// wall, or more than one, on a wall that parts the surface there: directions on its two sides have no common angles.
SurfacePoint only_side(const Domain& domain, const SurfacePoint& point);

}  // namespace brushfire::detail
