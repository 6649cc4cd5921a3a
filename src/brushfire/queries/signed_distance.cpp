// Distances get the signs of the sides on which their paths arrive.
#include <brushfire/queries/curve_sides.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/queries/detail/lengths_only.h>

#include <algorithm>
#include <string>

namespace brushfire {
namespace {

// Throws Error(InvalidArgument) for what has no sides or no distance of its own.
void check_have_sides(std::span<const Source> curves) {
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Source& s = curves[i];
    if (!s.curve) {
      throw Error(ErrorCode::InvalidArgument, "source " + std::to_string(i) + " is a point, which has no sides");
    }
    const auto is_zero = [](double offset) { return offset == 0; };
    if (s.offset != 0 || !std::all_of(s.curve->offsets.begin(), s.curve->offsets.end(), is_zero)) {
      throw Error(ErrorCode::InvalidArgument, "source " + std::to_string(i) + " has offsets: a sign needs distances");
    }
  }
}

}  // namespace

std::vector<double> signed_distance(const Domain& domain, const DistanceField& field, std::span<const Source> curves) {
  check_have_sides(curves);
  std::vector<double> values = field.distance;
  const std::vector<CurveArrival> sides = arrivals(domain, field, curves);
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (values[v] < kInfinity && sides[v].side == CurveSide::Left) values[v] = -values[v];
  }
  return values;
}

std::vector<double> signed_distance(const Domain& domain, std::span<const Source> curves, const DistanceOptions& how) {
  check_have_sides(curves);
  detail::check_lengths_only(how, "signs");
  DistanceOptions exact;
  exact.method = Method::Exact;
  exact.keep_paths = true;
  exact.max_distance = how.max_distance;
  exact.threads = how.threads;
  exact.progress = how.progress;
  exact.cancel = how.cancel;
  const CancelScope listen(how.cancel);
  return signed_distance(domain, distance(domain, curves, exact), curves);
}

}  // namespace brushfire
