// Answers of the solvers beside those of the oracle.
#include "corpus/check.h"

#include "corpus/curves.h"
#include "corpus/promises.h"

#include <brushfire/core/error.h>
#include <brushfire/queries/path.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace brushfire::corpus {
namespace {

using oracle::Arithmetic;
using oracle::kFar;
using oracle::Real;

// Quad was right where 237 bits say the same to this share.
constexpr Real kSure = 1e-15L;
// With 237 bits a window takes a tenth of a millisecond and more: beyond so many the quad's word is taken.
constexpr std::uint64_t kMostWindowsOfOctuple = 200'000;
// Of so many cases one is asked about with 237 bits whether or not anything seems wrong, where that is quickly done.
constexpr std::uint64_t kOctupleEvery = 16, kFewWindowsOfOctuple = 2'000;

constexpr double kSolveSeconds = 2, kTruthSeconds = 5, kOctupleSeconds = 120;

std::string vertex_text(Index v) { return "vertex " + std::to_string(v); }
std::string target_text(const SurfacePoint& p) { return "target " + place_text(p); }

DistanceOptions options_of(const Task& task) {
  DistanceOptions options;
  options.method = task.method;
  options.tolerance = task.tolerance;
  if (task.kind == Task::Kind::Lower) options.bound = Bound::Lower;
  if (task.kind == Task::Kind::Upper) options.bound = Bound::Upper;
  return options;
}

double bound_of(const DistanceField& field, Index v) {
  return field.error_bound.empty() ? kInfinity : field.error_bound[v];
}

// Of points that are no vertices: the largest of the field. (That of a vertex next to a source may know of no frames.)
double largest_bound(const DistanceField& field) {
  double bound = 0;
  for (const double b : field.error_bound) {
    if (b < kInfinity) bound = std::max(bound, b);
  }
  return bound;
}

}  // namespace

std::string Task::name() const {
  char text[40];
  switch (kind) {
    case Kind::Truth:
      return "oracle";
    case Kind::Paths:
      return "paths";
    case Kind::Targets:
      return "targets";
    case Kind::Radius:
      return "radius";
    case Kind::Windows:
    case Kind::Lower:
    case Kind::Upper:
      std::snprintf(text, sizeof text, "%s %g",
                    kind == Kind::Windows ? "windows"
                    : kind == Kind::Lower ? "lower"
                                          : "upper",
                    tolerance);
      return text;
    case Kind::Exact:
    case Kind::Other:
      break;
  }
  return std::string(name_of(method));
}

double seconds_for(const Task& task) { return task.kind == Task::Kind::Truth ? kTruthSeconds : kSolveSeconds; }

std::vector<Task> tasks_of(const std::vector<std::string>& methods, const std::vector<double>& tolerances) {
  using Kind = Task::Kind;
  std::vector<Task> all{{Kind::Truth, 0, Method::Exact},
                        {Kind::Exact, 0, Method::Exact},
                        {Kind::Paths, 0, Method::Exact},
                        {Kind::Targets, 0, Method::Exact},
                        {Kind::Radius, 0, Method::Exact}};
  for (const Kind kind : {Kind::Windows, Kind::Lower, Kind::Upper}) {
    for (const double t : tolerances) all.push_back({kind, t, Method::Windows});
  }
  for (const Method m : all_methods()) {
    if (m != Method::Exact && m != Method::Windows) all.push_back({Kind::Other, 0, m});
  }
  if (methods.empty()) return all;
  const auto is_called = [](const Task& task, const std::string& word) {
    return task.name().substr(0, task.name().find(' ')) == word;
  };
  std::vector<Task> chosen{all.front()};
  for (const std::string& word : methods) {
    const std::size_t before = chosen.size();
    for (const Task& task : all) {
      if (task.kind != Kind::Truth && is_called(task, word)) chosen.push_back(task);
    }
    if (chosen.size() == before) {
      throw Error(ErrorCode::InvalidArgument,
                  "'" + word + "' is no method, and not paths, targets, radius, lower, upper");
    }
  }
  return chosen;
}

void Examination::turn_to(std::uint64_t index, std::size_t start) {
  if (index != index_) case_ = make_case(family_, seed_, index);
  if (index != index_ || start != start_) has_truth_ = false;
  index_ = index;
  start_ = start;
  offsets_.clear();
  curves_ = sloped_ = false;
  if (start >= case_.starts.size()) return;
  for (const Source& s : case_.starts[start]) {
    offsets_.push_back(least_offset(case_.mesh, s));
    curves_ = curves_ || s.curve != nullptr;
    sloped_ = sloped_ || (s.curve != nullptr && !s.curve->offsets.empty());
  }
}

const oracle::Truth& Examination::truth() {
  if (has_truth_) return truth_;
  limit_processor_time(kTruthSeconds);
  arithmetic_ = Arithmetic::Quad;
  truth_ = oracle::polyhedral_distance(case_.plain, case_.starts[start_], kFar, case_.targets, arithmetic_);
  has_truth_ = true;
  limit_processor_time(kSolveSeconds);
  return truth_;
}

// Gives the truth twice the digits, where that is to be had; whether it makes a difference.
bool Examination::more_digits_differ(std::uint64_t most_windows) {
  if (arithmetic_ == Arithmetic::Octuple || truth().windows > most_windows) return false;
  limit_processor_time(kOctupleSeconds);
  arithmetic_ = Arithmetic::Octuple;
  const std::vector<Real> before = truth_.distance;
  truth_ = oracle::polyhedral_distance(case_.plain, case_.starts[start_], kFar, case_.targets, arithmetic_);
  for (std::size_t v = 0; v < before.size(); ++v) {
    const Real after = truth_.distance[v];
    if (before[v] != after && !(std::abs(before[v] - after) <= kSure * std::abs(after))) return true;
  }
  return false;
}

// Heat starts at points, and marching methods where a curve has one value; tests/curves/ holds the words.
bool Examination::takes_sources(const Task& task) const {
  if (task.kind != Task::Kind::Other || task.method == Method::Dijkstra) return true;
  return task.method == Method::Heat ? !curves_ : !sloped_;
}

Outcome Examination::run(std::uint64_t index, std::size_t start, const Task& task) {
  turn_to(index, start);
  if (start >= case_.starts.size() || !takes_sources(task)) return {};
  truth();
  const auto once = [&] {
    switch (task.kind) {
      case Task::Kind::Truth:
        return Outcome{};
      case Task::Kind::Exact:
        return exact(options_of(task));
      case Task::Kind::Paths:
        return paths();
      case Task::Kind::Targets:
        return targets();
      case Task::Kind::Radius:
        return radius();
      case Task::Kind::Windows:
      case Task::Kind::Lower:
      case Task::Kind::Upper:
        return windows(task);
      case Task::Kind::Other:
        break;
    }
    return other(task);
  };
  Outcome outcome = once();
  if (task.kind == Task::Kind::Truth && index % kOctupleEvery == 0)
    outcome.unsure = more_digits_differ(kFewWindowsOfOctuple);
  const bool last_bits = task.kind == Task::Kind::Lower || task.kind == Task::Kind::Upper;
  if (outcome.good() || last_bits) return outcome;
  // Before a solver is blamed, the oracle is asked again with twice the digits.
  const bool changed = more_digits_differ(kMostWindowsOfOctuple);
  limit_processor_time(kSolveSeconds);
  outcome = once();
  outcome.unsure = changed;
  return outcome;
}

namespace {

// What the value at v is made of: the path's length is what remains without the offset of its source.
Value value_at(const DistanceField& field, std::span<const double> offsets, const std::vector<Real>& truth, Index v) {
  const double offset = field.source[v] < offsets.size() ? offsets[field.source[v]] : 0;
  return {field.distance[v], truth[v], std::abs(truth[v] - offset), bound_of(field, v)};
}

}  // namespace

Outcome Examination::exact(const DistanceOptions& options) {
  Outcome out;
  const std::vector<Source>& sources = case_.starts[start_];
  const DistanceField field = distance(case_.mesh, sources, options);
  for (Index v = 0; v < case_.mesh.vertex_count(); ++v) {
    hold_exact(value_at(field, offsets_, truth().distance, v), vertex_text(v), out);
  }
  return out;
}

Outcome Examination::targets() {
  Outcome out;
  DistanceOptions options;
  options.method = Method::Exact;
  options.targets = case_.targets;
  const std::vector<Source>& sources = case_.starts[start_];
  const DistanceField field = distance(case_.mesh, sources, options);
  for (std::size_t i = 0; i < case_.targets.size(); ++i) {
    const Index source = field.target_source[i];
    const double offset = source < offsets_.size() ? offsets_[source] : 0;
    const Real truth = truth_.target[i];
    // Where the run ended before any vertex off the curve was reached, no vertex has a bound to go by.
    const Real beside = curves_ ? 32 * lever_rounding(case_.mesh) : 0;
    const Real room =
        std::max(Real{largest_bound(field)}, beside) + rounding_of(case_.mesh, case_.targets[i]) + kLeastStep;
    const Real length = std::abs(truth - offset);
    const bool wrong =
        same_reach({field.target_distance[i], truth, length, kInfinity}, target_text(case_.targets[i]), out) &&
        std::abs(field.target_distance[i] - truth) > room + Real{kExactPromise} * length;
    if (wrong) hold_exact({field.target_distance[i], truth, length, kInfinity}, target_text(case_.targets[i]), out);
  }
  return out;
}

// Half of the vertices are within the radius, which lies between two values.
Outcome Examination::radius() {
  Outcome out;
  std::vector<Real> values;
  for (const Real d : truth().distance) {
    if (d < kFar && d >= 0) values.push_back(d);
  }
  if (values.empty()) return out;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  const Real middle = values[values.size() / 2];
  DistanceOptions options;
  options.method = Method::Exact;
  options.max_distance = static_cast<double>(middle) * (1 + 1e-9);
  const std::vector<Source>& sources = case_.starts[start_];
  const DistanceField field = distance(case_.mesh, sources, options);
  for (Index v = 0; v < case_.mesh.vertex_count(); ++v) {
    Value value = value_at(field, offsets_, truth().distance, v);
    // What is at the radius itself may fall on either side.
    const Real room = std::max(Real{1e-8} * std::abs(middle), Real{1e-12} * value.length) + 2 * kLeastStep;
    if (std::abs(value.truth - options.max_distance) <= room) continue;
    if (value.truth > options.max_distance) value.truth = kFar;
    hold_exact(value, vertex_text(v), out);
  }
  return out;
}

Outcome Examination::windows(const Task& task) {
  Outcome out;
  const std::vector<Source>& sources = case_.starts[start_];
  double offsets = 0;
  for (const double o : offsets_) offsets = std::max(offsets, std::abs(o));
  const DistanceField field = distance(case_.mesh, sources, options_of(task));
  for (Index v = 0; v < case_.mesh.vertex_count(); ++v) {
    const Value value = value_at(field, offsets_, truth().distance, v);
    if (task.kind == Task::Kind::Windows) {
      // From lengths alone nothing is known of what lies next to a source but through frames: see error_bound.
      const bool blind = !case_.mesh.has_positions() && value.length < 1e-6 * case_.mesh.unit();
      // Nearer to a curve than the shortest edge is long, where the reserve of the tolerance does not cover it, a
      // vertex is known no better than what rounding may do.
      const bool is_beside = curves_ && value.length < shortest_edge(case_.mesh);
      const Real beside = is_beside ? (1 + task.tolerance) * 32 * lever_rounding(case_.mesh) : 0;
      // Nor is any in wide numbers where lengths differ by 1e20: "Rounding" of docs/tolerance.md.
      const Real wide = wide_rounding(case_.mesh, value.length);
      hold_bound(value, blind ? kInfinity : task.tolerance, offsets, beside + wide, vertex_text(v), out);
    } else {
      hold_side(value, task.kind == Task::Kind::Lower, vertex_text(v), out);
    }
  }
  return out;
}

Outcome Examination::other(const Task& task) {
  Outcome out;
  const std::vector<Source>& sources = case_.starts[start_];
  const DistanceField field = distance(case_.mesh, sources, options_of(task));
  // Dijkstra begins with what a source sees across an edge, in frames of two faces.
  const Real frames = 4 * lever_rounding(case_.mesh);
  for (Index v = 0; v < case_.mesh.vertex_count(); ++v) {
    const Value value = value_at(field, offsets_, truth().distance, v);
    if (!same_reach(value, vertex_text(v), out)) continue;
    const bool too_short = task.method == Method::Dijkstra && value.got < value.truth - kExactPromise * value.length -
                                                                              2 * kEpsilon * std::abs(value.truth) -
                                                                              frames -
                                                                              kLeastStep * case_.mesh.vertex_count();
    if (!too_short) continue;
    ++out.beyond;
    out.complain(off(value, vertex_text(v)));
  }
  return out;
}

// To vertices and targets: there, whole, and as long as both the field and the truth say, to kPathPromise or to what
// the field itself says that it may be off by.
Outcome Examination::paths() {
  Outcome out;
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_windows = true;
  const std::vector<Source>& sources = case_.starts[start_];
  const DistanceField field = distance(case_.mesh, sources, options);
  for (Index v = 0; v < case_.mesh.vertex_count(); ++v) {
    if (case_.mesh.first_corner(v) == kNoIndex) continue;
    hold_path(*field.windows, vertex_point(case_.mesh, v), truth().distance[v], bound_of(field, v), out);
  }
  for (std::size_t i = 0; i < case_.targets.size(); ++i) {
    const SurfacePoint& to = case_.targets[i];
    hold_path(*field.windows, to, truth().target[i], largest_bound(field), out);
  }
  return out;
}

void Examination::hold_path(const WindowField& field, const SurfacePoint& to, Real truth, double bound, Outcome& out) {
  const std::string where = "to " + place_text(to);
  const WindowField::Value value = field.value(to);
  if (!same_reach({value.distance, truth, 0, bound}, where, out)) return;
  SurfacePath path;
  try {
    path = path_to(field, to);
    length_of(case_.mesh, path.points);
  } catch (const Error& e) {
    ++out.lost;
    return out.complain(where + ": " + e.what());
  }
  if ((path.length == kInfinity) != (value.distance == kInfinity) ||
      path.points.empty() != (path.length == kInfinity)) {
    ++out.lost;
    return out.complain(where + ": no way, and the field says " + std::to_string(value.distance));
  }
  if (path.length == kInfinity) return;
  const Real length = path.length;
  Real room = std::max(Real{kPathPromise} * length, Real{bound}) + rounding_of(case_.mesh, path);
  // At the source that the field names, or at one that ties with it to rounding.
  const auto begins_at = [&](const Source& from) {
    return offset_at(case_.mesh, from, path.points.front(), static_cast<double>(room), value.distance - path.length);
  };
  const std::vector<Source>& sources = case_.starts[start_];
  std::optional<double> begin = begins_at(sources[value.source]);
  // A point at no distance from its curve may lie in other faces, glued to the curve's by faces without area: then
  // there is no more to say of it than its value.
  if (!begin && length == 0) begin = static_cast<double>(truth);
  for (std::size_t s = 0; s < sources.size() && !begin; ++s) begin = begins_at(sources[s]);
  if (!begin) {
    ++out.lost;
    return out.complain(where + ": begins beside the curve, at " + place_text(path.points.front()));
  }
  const Real offset = *begin;
  // Of adding the offset. Where it changes along the curve, a leg may miss the value by 8 epsilons of what both count
  // from the least of them (WindowFieldData::room_for()), which is no more than twice these numbers together.
  const Real same = sloped_ ? 16 : 2;
  room += same * kEpsilon * (std::abs(truth) + std::abs(offset)) + kLeastStep * static_cast<double>(path.points.size());
  const Real off_field = std::abs(length + offset - value.distance), off_truth = std::abs(length + offset - truth);
  if (length > 0) out.worst = std::max(out.worst, static_cast<double>(off_field / length));
  if (off_field <= room && off_truth <= room) return;
  ++out.beyond;
  char text[240];
  std::snprintf(text, sizeof text, "%s: %.17g long, off the field by %.2Lg, off the truth by %.2Lg, bound %.2g",
                where.c_str(), path.length, off_field, off_truth, bound);
  out.complain(text);
}

}  // namespace brushfire::corpus
