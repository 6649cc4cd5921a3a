// Comparison with the truth, random points, union-find.
#include "oracle/deviation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace brushfire::oracle {

void Deviation::add(Real value, Real expected, Index where, Real floor) {
  if (value == expected) return;
  if (std::isnan(value) || (value == kFar) != (expected == kFar)) {
    if (wrong_reach++ == 0) at = where, got = value, truth = expected;
    return;
  }
  const auto error = static_cast<double>(std::abs(value - expected) / std::max(std::abs(expected), floor));
  if (error > relative) {
    relative = error;
    if (wrong_reach == 0) at = where, got = value, truth = expected;
  }
}

void Deviation::add(const Deviation& other) {
  if (other.wrong_reach > wrong_reach || other.relative > relative) at = other.at, got = other.got, truth = other.truth;
  relative = std::max(relative, other.relative);
  wrong_reach += other.wrong_reach;
}

std::string Deviation::text() const {
  std::ostringstream out;
  out.precision(19);
  out << "deviation " << relative << ", wrongly (un)reached " << wrong_reach << ", at " << at << ": " << got
      << " instead of " << truth;
  return out.str();
}

Deviation deviation(std::span<const double> got, std::span<const Real> truth, Real floor) {
  Deviation result;
  for (std::size_t v = 0; v < truth.size(); ++v) result.add(got[v], truth[v], static_cast<Index>(v), floor);
  return result;
}

DistanceOptions exact_options(double radius) {
  DistanceOptions options;
  options.method = Method::Exact;
  options.max_distance = radius;
  return options;
}

Deviation exact_against_oracle(const Mesh& mesh, std::span<const Source> sources, double radius,
                               std::span<const SurfacePoint> targets) {
  const Truth truth = polyhedral_distance(mesh, sources, radius, targets);
  Real floor = 0;
  for (const Source& s : sources) floor = std::max(floor, std::abs(Real{s.offset}));
  DistanceOptions options = exact_options(radius);
  Deviation result = deviation(distance(mesh, sources, options).distance, truth.distance, floor);
  if (!targets.empty()) {
    options.targets.assign(targets.begin(), targets.end());
    result.add(deviation(distance(mesh, sources, options).target_distance, truth.target, floor));
  }
  return result;
}

namespace {

double share(std::mt19937& random) { return (1 + static_cast<double>(random() % 1022)) / 1024; }

Index usable_face(const Mesh& mesh, std::mt19937& random) {
  for (int tries = 0; tries < 1000; ++tries) {
    const auto f = static_cast<Index>(random() % mesh.face_count());
    if (mesh.is_face_usable(f)) return f;
  }
  return 0;
}

}  // namespace

SurfacePoint random_vertex(const Mesh& mesh, std::mt19937& random) {
  const Face& t = mesh.faces()[usable_face(mesh, random)];
  return vertex_point(mesh, t[random() % 3]);
}

SurfacePoint random_edge_point(const Mesh& mesh, std::mt19937& random) {
  SurfacePoint p{usable_face(mesh, random), {0, 0, 0}};
  const auto k = static_cast<std::size_t>(random() % 3);
  const double t = share(random);
  p.weights[k] = 1 - t;
  p.weights[(k + 1) % 3] = t;
  return p;
}

SurfacePoint random_face_point(const Mesh& mesh, std::mt19937& random) {
  double a = share(random), b = share(random), c = share(random);
  const double sum = a + b + c;
  return {usable_face(mesh, random), {a / sum, b / sum, c / sum}};
}

std::vector<bool> reachable(const Mesh& mesh, std::span<const Source> sources) {
  std::vector<Index> parent(mesh.vertex_count());
  std::iota(parent.begin(), parent.end(), Index{0});
  const auto root = [&](Index v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Face& t : mesh.faces()) {
    parent[root(t[0])] = root(t[1]);
    parent[root(t[1])] = root(t[2]);
  }
  std::vector<bool> lit(mesh.vertex_count(), false), result(mesh.vertex_count());
  for (const Source& s : sources) lit[root(mesh.faces()[s.point.face][0])] = true;
  for (Index v = 0; v < mesh.vertex_count(); ++v) result[v] = lit[root(v)];
  return result;
}

}  // namespace brushfire::oracle
