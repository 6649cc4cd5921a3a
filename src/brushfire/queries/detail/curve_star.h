// The directions in which a curve leaves one of its places, and the sides between them.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/curve_source.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/queries/curve_sides.h>
#include <brushfire/queries/detail/leaving_angles.h>

#include <span>
#include <vector>

namespace brushfire::detail {

// Segments that are shorter than this share of their face's longest edge are rounding of their ends, and so is their
// direction: that of what comes behind counts.
constexpr double kNoDirection = 1e-12;

double longest_edge(const Mesh& mesh, Index face);  // mesh.unit()
SurfacePoint point_of(const CurvePlace& place);

class CurveStar {
 public:
  // `places`: the numbers that one place of the curve has, several where it comes there again. Segments that are
  // `retraced`, [segments], count for nothing. `face`: where the faces at a vertex form neither a circle nor an arc,
  // one of the fan that is looked at; segments elsewhere are not seen.
  CurveStar(const Mesh& mesh, const LocatedCurve& curve, std::span<const Index> places,
            const std::vector<bool>& retraced, Index face = kNoIndex);

  // Nothing leaves: it is no place of the curve that parts anything.
  bool is_empty() const { return arms_.empty(); }
  // Around a vertex of several fans: the ends of the edges where the fan begins and ends.
  std::vector<Index> borders() const { return angles_.borders(); }
  // Of a path that comes from a point in a face at the place, by the rule of arrivals(). None where nothing leaves.
  CurveSide side_of(const SurfacePoint& from) const;

 private:
  struct Arm {
    double angle;
    bool goes_out;
  };

  void add(const Mesh& mesh, const LocatedCurve& curve, Index place, bool goes_out, const std::vector<bool>& retraced);
  bool is_in_first_half(double from_arm) const;
  template <class FromArm>
  CurveSide side_between_borders(const FromArm& from_arm) const;

  LeavingAngles angles_;
  bool is_fan_;  // one of several
  bool is_arc_;
  double turn_;
  bool grows_left_;
  std::vector<Arm> arms_;
};

}  // namespace brushfire::detail
