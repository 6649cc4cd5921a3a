// Values beside the truth.
#include "corpus/promises.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace brushfire::corpus {

using oracle::kFar;
using oracle::Real;

namespace {

// Of an exact value's bound.
constexpr double kWarning = 0.5;

}  // namespace

std::string off(const Value& v, const std::string& where) {
  char text[200];
  const Real error = std::abs(v.got - v.truth);
  std::snprintf(text, sizeof text, "%s reads %.17g, is %.19Lg, off by %.2Lg (%.2Lg of it), bound %.2g", where.c_str(),
                v.got, v.truth, error, v.length > 0 ? error / v.length : 0, v.bound);
  return text;
}

bool same_reach(const Value& v, const std::string& where, Outcome& out) {
  ++out.compared;
  if (!std::isnan(v.got) && (v.got == kInfinity) == (v.truth == kFar)) return v.truth < kFar;
  ++out.beyond;
  out.worst = kInfinity;
  out.complain(off(v, where));
  return false;
}

void hold_exact(const Value& v, const std::string& where, Outcome& out) {
  if (!same_reach(v, where, out)) return;
  const Real error = std::abs(v.got - v.truth);
  const Real room = std::max({Real{kExactPromise} * v.length, Real{2 * kEpsilon} * std::abs(v.truth),
                              v.bound < kInfinity ? Real{v.bound} : Real{0}});
  if (v.length > 0) out.worst = std::max(out.worst, static_cast<double>(error / v.length));
  if (error > room) ++out.beyond;
  // The factor of the bound's law is measured: half of it is an early warning (docs/tolerance.md, "The factor").
  const bool nearly_broken = error > kWarning * v.bound + kTruthRounding * std::abs(v.truth) + kLeastStep;
  if (nearly_broken) ++out.unbound;
  if (error > room || nearly_broken) out.complain(off(v, where));
}

void hold_bound(const Value& v, double tolerance, double offsets, Real more, const std::string& where, Outcome& out) {
  if (!same_reach(v, where, out)) return;
  const Real error = std::abs(v.got - v.truth);
  if (v.length > 0) out.worst = std::max(out.worst, static_cast<double>(error / v.length));
  const bool too_wide =
      v.bound > tolerance * v.length + 16 * kEpsilon * (std::abs(v.got) + offsets) + more + 2 * kLeastStep;
  if (error > v.bound + kTruthRounding * std::abs(v.truth)) {
    ++out.unbound;
    out.complain(off(v, where));
  } else if (too_wide) {
    ++out.beyond;
    out.complain("bound beyond the tolerance: " + off(v, where));
  }
}

void hold_side(const Value& v, bool below, const std::string& where, Outcome& out) {
  if (!same_reach(v, where, out)) return;
  const Real rounding = kTruthRounding * std::abs(v.truth);
  const bool wrong = below ? v.got > v.truth + rounding : v.got < v.truth - rounding;
  if (v.length > 0) out.worst = std::max(out.worst, static_cast<double>(std::abs(v.got - v.truth) / v.length));
  if (!wrong) return;
  ++out.beyond;
  out.complain(off(v, where));
}

Real rounding_of(const Mesh& mesh, const SurfacePoint& p) {
  const auto longest_of = [&](Index face) {
    return std::max({mesh.length(3 * face), mesh.length(3 * face + 1), mesh.length(3 * face + 2)});
  };
  double longest = longest_of(p.face);
  for (std::size_t k = 0; k < 3; ++k) {
    if (p.weights[k] != 1) continue;
    for (const Index h : mesh.corners(mesh.faces()[p.face][k])) longest = std::max(longest, longest_of(h / 3));
  }
  return 2 * kEpsilon * mesh.unit() * longest;
}

Real rounding_of(const Mesh& mesh, const SurfacePath& path) {
  Real sum = 0;
  for (const SurfacePoint& p : path.points) sum += rounding_of(mesh, p);
  return sum;
}

Real lever_rounding(const Mesh& mesh) {
  Real lever = 0;
  for (Index h = 0; h < mesh.halfedge_count(); h += 3) {
    const std::array<double, 3> l{mesh.length(h), mesh.length(h + 1), mesh.length(h + 2)};
    const Real longest = *std::max_element(l.begin(), l.end()), shortest = *std::min_element(l.begin(), l.end());
    lever = std::max(lever, shortest > 0 ? longest * longest / shortest : longest);
  }
  return kEpsilon * lever * mesh.unit();
}

Real ratio_of(const Mesh& mesh) {
  Real ratio = 1;
  for (Index h = 0; h < mesh.halfedge_count(); h += 3) {
    const auto l = mesh.lengths().subspan(h, 3);
    const auto [shortest, longest] = std::minmax_element(l.begin(), l.end());
    if (*shortest > 0) ratio = std::max(ratio, Real{*longest} / *shortest);
  }
  return ratio;
}

Real wide_rounding(const Mesh& mesh, Real length) {
  const double longest = *std::max_element(mesh.lengths().begin(), mesh.lengths().end());
  return 32 * 0x1p-103L * (Real{mesh.unit()} * longest + ratio_of(mesh) * length);
}

Real shortest_edge(const Mesh& mesh) {
  double shortest = kInfinity;
  for (const double l : mesh.lengths()) {
    if (l > 0) shortest = std::min(shortest, l);
  }
  return mesh.unit() * shortest;
}

}  // namespace brushfire::corpus
