// One run with bounds, and each value beside them.
#include <brushfire/queries/certify.h>

#include <brushfire/core/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace brushfire {
namespace {

// What is known of one vertex. `offset`: of its nearest source, from where lengths of paths count.
struct Known {
  double lower, upper, offset;
};

struct Judgement {
  Finding finding = Finding::Possible;
  double error = 0;   // Certificate::proven_error
  double within = 0;  // the least claim that would make the value possible
};

// A share of a length, rounded up: never in favour of a proof.
double share_of(double error, double length) {
  return length > 0 ? std::nextafter(error / length, kInfinity) : kInfinity;
}

Judgement judge(double value, const Known& known, const CertifyOptions& options) {
  if (std::isnan(value)) return {Finding::NotANumber, value, kInfinity};
  if (known.lower == kInfinity) {
    if (value == kInfinity) return {};
    return {Finding::NotReachable, -kInfinity, kInfinity};
  }
  if (value == kInfinity) {
    if (!(known.upper < options.max_distance)) return {};
    return {Finding::NotReached, kInfinity, kInfinity};
  }
  if (value >= known.lower && value <= known.upper) return {};
  const bool is_short = value < known.lower;
  const double error = is_short ? value - known.lower : value - known.upper;
  // d - within * (d - offset) grows with d, and so does d + within * (d - offset): of all distances that the bounds
  // leave, the nearest one excuses the value best.
  const double length = (is_short ? known.lower : known.upper) - known.offset;
  const double within = share_of(std::abs(error), length);
  if (within <= options.within) return {};
  return {is_short ? Finding::TooShort : Finding::TooLong, error, within};
}

void check(const Mesh& mesh, std::span<const double> field, const CertifyOptions& options) {
  if (field.size() != mesh.vertex_count()) {
    throw Error(ErrorCode::InvalidArgument, "the field has " + std::to_string(field.size()) + " values, the mesh " +
                                                std::to_string(mesh.vertex_count()) + " vertices");
  }
  if (!(options.within >= 0)) {
    throw Error(ErrorCode::InvalidArgument, "within is " + std::to_string(options.within) + ", and not >= 0");
  }
  if (!(options.max_distance >= 0)) {
    throw Error(ErrorCode::InvalidArgument, "the distance that may be left out is not >= 0");
  }
}

DistanceField run(const Domain& domain, std::span<const Source> sources, const CertifyOptions& options) {
  DistanceOptions how;
  how.method = options.tolerance == 0 ? Method::Exact : Method::Windows;
  how.tolerance = options.tolerance;
  how.threads = options.threads;
  how.progress = options.progress;
  how.cancel = options.cancel;
  return distance(domain, sources, how);
}

// The bounds of vertex v, rounded outwards; no distance is less than the least offset.
Known known_at(const DistanceField& run, Index v, std::span<const Source> sources, double least_offset) {
  const double d = run.distance[v];
  if (d == kInfinity) return {kInfinity, kInfinity, 0};
  const double bound = run.error_bound[v];
  const double offset = run.source[v] < sources.size() ? brushfire::least_offset(sources[run.source[v]]) : least_offset;
  if (bound == 0) return {d, d, offset};
  return {std::max(std::nextafter(d - bound, -kInfinity), least_offset), std::nextafter(d + bound, kInfinity), offset};
}

void count(Finding finding, Certificate& c) {
  switch (finding) {
    case Finding::Possible:
      ++c.possible;
      break;
    case Finding::TooShort:
      ++c.too_short;
      break;
    case Finding::TooLong:
      ++c.too_long;
      break;
    case Finding::NotReachable:
      ++c.not_reachable;
      break;
    case Finding::NotReached:
      ++c.not_reached;
      break;
    case Finding::NotANumber:
      ++c.not_a_number;
      break;
  }
}

}  // namespace

std::string_view name_of(Finding finding) {
  switch (finding) {
    case Finding::Possible:
      return "possible";
    case Finding::TooShort:
      return "too short";
    case Finding::TooLong:
      return "too long";
    case Finding::NotReachable:
      return "not reachable";
    case Finding::NotReached:
      return "not reached";
    case Finding::NotANumber:
      return "not a number";
  }
  return "";
}

Certificate certify(const Domain& domain, std::span<const double> field, std::span<const Source> sources,
                    const CertifyOptions& options) {
  check(domain.mesh(), field, options);
  const DistanceField truth = run(domain, sources, options);
  double least_offset = kInfinity;
  for (const Source& s : sources) least_offset = std::min(least_offset, brushfire::least_offset(s));
  Certificate c;
  c.lower.reserve(field.size());
  c.upper.reserve(field.size());
  c.finding.reserve(field.size());
  c.proven_error.reserve(field.size());
  for (Index v = 0; v < field.size(); ++v) {
    const Known known = known_at(truth, v, sources, least_offset);
    const Judgement judgement = judge(field[v], known, options);
    c.lower.push_back(known.lower);
    c.upper.push_back(known.upper);
    c.finding.push_back(judgement.finding);
    c.proven_error.push_back(judgement.error);
    count(judgement.finding, c);
    if (judgement.within > c.least_within) c.least_within = judgement.within, c.worst_vertex = v;
    const double length = truth.distance[v] - known.offset;
    if (length > 0 && length < kInfinity) c.max_gap = std::max(c.max_gap, (known.upper - known.lower) / length);
  }
  return c;
}

}  // namespace brushfire
