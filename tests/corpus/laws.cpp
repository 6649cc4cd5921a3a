// The laws.
#include "corpus/laws.h"

#include "corpus/check.h"
#include "corpus/dice.h"
#include "corpus/promises.h"
#include "oracle/deviation.h"

#include <brushfire/core/error.h>
#include <brushfire/queries/distance_matrix.h>
#include <brushfire/queries/path.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <numeric>

namespace brushfire::corpus {
namespace {

constexpr double kMakingSeconds = 120;  // reading or building a mesh is not what is judged
constexpr std::size_t kPoints = 6;
constexpr int kPathsPerMesh = 30;

double bound_at(const DistanceField& field, Index v) { return field.error_bound.empty() ? 0 : field.error_bound[v]; }

// `exact`: both should be the same, and not only near each other.
void hold(double got, double expected, double room, const std::string& where, Outcome& out, bool exact = true) {
  ++out.compared;
  if (got == expected) return;
  const double error = std::abs(got - expected);
  const bool reach = (got == kInfinity) == (expected == kInfinity);
  if (exact) out.worst = std::max(out.worst, reach && expected != 0 ? error / std::abs(expected) : kInfinity);
  if (reach && error <= room) return;
  ++out.beyond;
  char text[160];
  std::snprintf(text, sizeof text, "%s: %.17g instead of %.17g", where.c_str(), got, expected);
  out.complain(text);
}

// `a` and `b` are both exact: each is within the promise, or its bound.
double exact_room(double value, double bounds) { return std::max(2 * kExactPromise * std::abs(value), bounds); }

std::string vertex_text(Index v) { return "vertex " + std::to_string(v); }

DistanceOptions exact() {
  DistanceOptions options;
  options.method = Method::Exact;
  return options;
}

std::vector<Index> shuffled(Index count, Dice& dice) {
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), Index{0});
  for (Index i = count; i > 1; --i) std::swap(order[i - 1], order[dice.below(i)]);
  return order;
}

std::vector<Index> inverse(const std::vector<Index>& order) {
  std::vector<Index> rank(order.size());
  for (Index i = 0; i < order.size(); ++i) rank[order[i]] = i;
  return rank;
}

}  // namespace

std::string name_of_law(Law law) {
  constexpr const char* kNames[kLaws] = {"exact",
                                         "symmetry",
                                         "scaling",
                                         "renumbering",
                                         "radius",
                                         "targets",
                                         "rows",
                                         "threads",
                                         "windows 0.01",
                                         "windows 0.001",
                                         "windows 1e-05",
                                         "lower",
                                         "upper",
                                         "paths",
                                         "carried-source",
                                         "novotni-klein",
                                         "novotni-klein-2002",
                                         "kimmel-sethian",
                                         "dijkstra"};
  return kNames[static_cast<std::size_t>(law)];
}

Outcome Trial::run(std::size_t subject, Law law) {
  turn_to(subject);
  if (law != Law::Exact) {
    field();
    limit_processor_time(seconds_);
  }
  const std::clock_t begin = std::clock();
  Outcome outcome = [&] {
    switch (law) {
      case Law::Exact:
        field();
        return Outcome{};
      case Law::Symmetry:
        return symmetry();
      case Law::Scaling:
        return scaling();
      case Law::Renumbering:
        return renumbering();
      case Law::Radius:
        return radius();
      case Law::Targets:
        return targets();
      case Law::Rows:
        return rows();
      case Law::Threads:
        return threads();
      case Law::Windows2:
      case Law::Windows3:
      case Law::Windows5:
      case Law::Lower:
      case Law::Upper:
        return windows(law);
      case Law::Paths:
        return paths();
      case Law::CarriedSource:
        return other(Method::CarriedSource);
      case Law::NovotniKlein:
        return other(Method::NovotniKlein);
      case Law::NovotniKlein2002:
        return other(Method::NovotniKlein2002);
      case Law::KimmelSethian:
        return other(Method::KimmelSethian);
      case Law::Dijkstra:
        break;
    }
    return other(Method::Dijkstra);
  }();
  outcome.seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  return outcome;
}

void Trial::turn_to(std::size_t subject) {
  if (subject == at_) return;
  limit_processor_time(kMakingSeconds);
  at_ = subject;
  field_.reset();
  mesh_ = subjects_[subject].make();
  Dice dice(subjects_[subject].name, seed_, 0);
  points_.clear();
  for (std::size_t k = 0; k < kPoints; ++k) {
    points_.push_back(k % 3 == 0   ? oracle::random_vertex(mesh_, dice.small())
                      : k % 3 == 1 ? oracle::random_edge_point(mesh_, dice.small())
                                   : oracle::random_face_point(mesh_, dice.small()));
  }
  source_ = {points_[dice.below(kPoints)], 0};
  limit_processor_time(seconds_);
}

DistanceField Trial::solve(const Mesh& mesh, const DistanceOptions& options) const {
  return distance(mesh, std::span(&source_, 1), options);
}

const DistanceField& Trial::field() {
  if (!field_) field_ = solve(mesh_, exact());
  return *field_;
}

Outcome Trial::symmetry() {
  Outcome out;
  DistanceSolver solver(mesh_);
  DistanceOptions options = exact();
  options.targets = points_;
  std::vector<std::vector<double>> d;
  for (const SurfacePoint& p : points_) {
    const Source source{p, 0};
    d.push_back(solver.distance(std::span(&source, 1), options).target_distance);
  }
  for (std::size_t a = 0; a < kPoints; ++a) {
    for (std::size_t b = 0; b < kPoints; ++b) {
      const std::string pair = place_text(points_[a]) + " to " + place_text(points_[b]);
      if (b < a) hold(d[a][b], d[b][a], exact_room(d[a][b], 0), pair + " and back", out);
      for (std::size_t c = 0; c < kPoints; ++c) {
        const double detour = d[a][c] + d[c][b];
        if (d[a][b] > detour) hold(d[a][b], detour, exact_room(detour, 0), pair + ", by way of another", out);
      }
    }
  }
  return out;
}

Outcome Trial::scaling() {
  Outcome out;
  if (!mesh_.has_positions()) return out;
  std::vector<Vec3> larger(mesh_.positions().begin(), mesh_.positions().end());
  for (Vec3& p : larger) p = 8 * p;
  const DistanceField other = solve(Mesh(larger, mesh_.faces()), exact());
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    hold(other.distance[v], 8 * field().distance[v], 0, vertex_text(v) + ", eight times as large", out);
  }
  return out;
}

Outcome Trial::renumbering() {
  Outcome out;
  Dice dice(subjects_[at_].name + ", renumbering", seed_, 0);
  const std::vector<Index> vertices = shuffled(mesh_.vertex_count(), dice), rank = inverse(vertices);
  const std::vector<Index> face_rank = shuffled(mesh_.face_count(), dice);
  const Mesh mesh = mesh_.renumbered(vertices, rank, face_rank);
  Source source = source_;
  source.point.face = face_rank[source.point.face];
  const DistanceField other = distance(mesh, std::span(&source, 1), exact());
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    const double room = exact_room(field().distance[v], bound_at(field(), v) + bound_at(other, rank[v]));
    hold(other.distance[rank[v]], field().distance[v], room, vertex_text(v) + ", renumbered", out);
  }
  return out;
}

Outcome Trial::radius() {
  Outcome out;
  std::vector<double> reached;
  for (const double d : field().distance) {
    if (d < kInfinity) reached.push_back(d);
  }
  if (reached.empty()) return out;
  std::nth_element(reached.begin(), reached.begin() + static_cast<std::ptrdiff_t>(reached.size() / 2), reached.end());
  DistanceOptions options = exact();
  options.max_distance = reached[reached.size() / 2] * (1 + 1e-9);
  const DistanceField near = solve(mesh_, options);
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    const double d = field().distance[v];
    if (std::abs(d - options.max_distance) <= 1e-8 * options.max_distance) continue;
    hold(near.distance[v], d > options.max_distance ? kInfinity : d,
         exact_room(d, bound_at(field(), v) + bound_at(near, v)), vertex_text(v) + ", within a radius", out);
  }
  return out;
}

Outcome Trial::targets() {
  Outcome out;
  Dice dice(subjects_[at_].name + ", targets", seed_, 0);
  DistanceOptions options = exact();
  std::vector<Index> vertices;
  for (std::size_t k = 0; k < kPoints; ++k) {
    const SurfacePoint p = oracle::random_vertex(mesh_, dice.small());
    options.targets.push_back(p);
    vertices.push_back(locate(mesh_, p).vertex);
  }
  const DistanceField other = solve(mesh_, options);
  for (std::size_t k = 0; k < kPoints; ++k) {
    const double d = field().distance[vertices[k]];
    hold(other.target_distance[k], d, exact_room(d, 2 * bound_at(field(), vertices[k])),
         vertex_text(vertices[k]) + ", as a target", out);
  }
  return out;
}

Outcome Trial::rows() {
  Outcome out;
  const std::vector<Place> from{source_.point};
  MatrixOptions options;
  options.distance = exact();
  const std::vector<double> row = distance_matrix<double>(mesh_, std::span<const Place>(from), {}, options);
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    hold(row[v], field().distance[v], exact_room(row[v], 2 * bound_at(field(), v)), vertex_text(v) + ", in a row", out);
  }
  return out;
}

Outcome Trial::threads() {
  Outcome out;
  DistanceOptions options = exact();
  options.threads = 3;
  const DistanceField exact_of_three = solve(mesh_, options);
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    hold(exact_of_three.distance[v], field().distance[v], 0, vertex_text(v) + ", three threads", out);
  }
  return out;
}

Outcome Trial::windows(Law law) {
  Outcome out;
  DistanceOptions options;
  options.tolerance = law == Law::Windows2 ? 1e-2 : law == Law::Windows5 ? 1e-5 : 1e-3;
  options.bound = law == Law::Lower ? Bound::Lower : law == Law::Upper ? Bound::Upper : Bound::Estimate;
  const DistanceField other = solve(mesh_, options);
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    const double d = field().distance[v], got = other.distance[v], doubt = exact_room(d, bound_at(field(), v));
    const bool on_its_side = (law == Law::Lower && got <= d) || (law == Law::Upper && got >= d);
    const bool one_sided = law == Law::Lower || law == Law::Upper;
    if (one_sided && on_its_side && got < kInfinity) {
      ++out.compared;
    } else {
      hold(got, d, one_sided ? doubt : doubt + bound_at(other, v), vertex_text(v), out, false);
    }
    if (bound_at(other, v) > options.tolerance * d + 2 * kEpsilon * d) {
      ++out.beyond;
      out.complain(vertex_text(v) + ": the bound is beyond the tolerance");
    }
  }
  return out;
}

Outcome Trial::paths() {
  Outcome out;
  DistanceOptions options = exact();
  options.keep_paths = true;
  const DistanceField kept = solve(mesh_, options);
  Dice dice(subjects_[at_].name + ", paths", seed_, 0);
  for (int k = 0; k < kPathsPerMesh; ++k) {
    const SurfacePoint to = oracle::random_vertex(mesh_, dice.small());
    const Index v = locate(mesh_, to).vertex;
    const SurfacePath path = path_to(*kept.windows, to);
    hold(path.length, kept.distance[v], kPathPromise * kept.distance[v], "path to " + vertex_text(v), out);
    if (!path.points.empty()) length_of(mesh_, path.points);  // throws where consecutive points share no face
  }
  return out;
}

Outcome Trial::other(Method method) {
  Outcome out;
  DistanceOptions options;
  options.method = method;
  const DistanceField other = solve(mesh_, options);
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    const double d = field().distance[v], got = other.distance[v];
    ++out.compared;
    const bool too_short = method == Method::Dijkstra && got < d - exact_room(d, bound_at(field(), v));
    if (!std::isnan(got) && (got == kInfinity) == (d == kInfinity) && !too_short) continue;
    ++out.beyond;
    out.complain(vertex_text(v) + " reads " + std::to_string(got) + ", exact " + std::to_string(d));
  }
  return out;
}

}  // namespace brushfire::corpus
