// Distances that can be written down: cones, cylinders, the cube.
#pragma once

#include "oracle/complex.h"

namespace brushfire::oracle {

// On a cone of total angle `total` around its apex: from radius `a` to radius `b`, `turn` <= total / 2 apart.
Real cone_distance(Real a, Real b, Real turn, Real total);

// On a cylinder of circumference `around`: `turn` <= around / 2 along the circle, `rise` along the axis.
Real cylinder_distance(Real turn, Real rise);

// Between two points of the surface of [0,1]^3: the cube is rolled over its edges, no face touching the floor twice,
// and every print of `b` on the floor is a candidate (the least unfolding is the distance on a convex body).
Real cube_distance(const Vec3& a, const Vec3& b);

}  // namespace brushfire::oracle
