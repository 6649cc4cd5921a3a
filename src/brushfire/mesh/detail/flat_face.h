// One face laid flat, and points that several faces share.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <array>
#include <optional>
#include <vector>

namespace brushfire {

// The corners of face f in the plane, counter-clockwise, in mesh.unit(); the longest edge lies on the x axis, so that
// needles and caps keep their digits. All zero where the corners coincide.
std::array<Vec2, 3> flat_corners(const Mesh& mesh, Index f);

// Position of the third corner of the face of halfedge g over edge h of the same ring, in the frame of h: from(h) at
// (0,0), to(h) on the x axis, the corner above; mesh.unit(). The edge must not have length 0. Looks up two faces only.
Vec2 apex_over(const Mesh& mesh, Index h, Index g);

// A point of the face of halfedge h, by its weights there, in the frame of h; mesh.unit(). Sums of positive terms: a
// tiny weight keeps its digits. The edge must not have length 0.
Vec2 point_over(const Mesh& mesh, Index h, const std::array<double, 3>& weights);

// By how much the weights of one point of a face differ from those of another. They sum to zero, and the two that are
// not the heaviest keep their digits.
std::array<double, 3> weight_difference(const std::array<double, 3>& from, const std::array<double, 3>& to);

// The vector from one point of face f to another, in the plane of flat_corners.
Vec2 flat_difference(const std::array<Vec2, 3>& corners, const std::array<double, 3>& from,
                     const std::array<double, 3>& to);

// The faces that hold the point: its own; all around its edge; all around its vertex. Ascending.
std::vector<Index> faces_at(const Mesh& mesh, const PointLocation& point);

// The point's weights in face f, where f holds it: a point inside a face lies in that one only, and not in another one
// over the same vertices.
std::optional<std::array<double, 3>> weights_in(const Mesh& mesh, const PointLocation& point, Index f);

// The same point of an edge, as one of the face of another halfedge of that edge.
PointLocation on_other_halfedge(const Mesh& mesh, const PointLocation& point, Index halfedge);

// A face that holds both points: `preferred` where it does, else the lowest; kNoIndex where there is none.
Index common_face(const Mesh& mesh, const PointLocation& a, const PointLocation& b, Index preferred = kNoIndex);

// The straight distance of two points within face f, which holds both; mesh.unit(). From coordinates where the mesh has
// them: right to rounding also for points that are far closer to each other than the face is long.
double distance_within(const Mesh& mesh, Index f, const PointLocation& a, const PointLocation& b);
// The same by the points' weights in f.
double distance_within(const Mesh& mesh, Index f, const std::array<double, 3>& a, const std::array<double, 3>& b);

}  // namespace brushfire
