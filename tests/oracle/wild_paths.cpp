// Lengths and angles of paths from coordinates, relative to the nearest vertex, so that small things keep their digits.
#include "oracle/wild_paths.h"

#include "oracle/polyhedral.h"

#include <brushfire/core/error.h>
#include <brushfire/queries/path.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <vector>

namespace brushfire::oracle {
namespace {

// What a path's length may miss the field by, and the field the truth.
constexpr double kPathRoom = 1e-11, kFieldRoom = 1e-12;
// What an angle may miss pi by, besides what its points are rounded by.
constexpr Real kAngleRoom = 1e-6L;
constexpr Real kEpsilon = std::numeric_limits<double>::epsilon();

struct Arrow {
  Real x = 0, y = 0, z = 0;
};
Arrow operator+(Arrow a, Arrow b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Arrow operator*(Real s, Arrow a) { return {s * a.x, s * a.y, s * a.z}; }
Arrow arrow(Vec3 from, Vec3 to) { return {Real{to.x} - from.x, Real{to.y} - from.y, Real{to.z} - from.z}; }
Real dot(Arrow a, Arrow b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Real norm(Arrow a) { return std::sqrt(dot(a, a)); }
Arrow cross(Arrow a, Arrow b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Real angle_between(Arrow a, Arrow b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

// A point by the vertices that it lies between, shares summing to one.
using Shares = std::map<Index, Real>;
Shares shares_of(const Mesh& mesh, const SurfacePoint& p) {
  Shares s;
  Real sum = 0;
  for (const double w : p.weights) sum += w;
  for (std::size_t k = 0; k < 3; ++k) {
    if (p.weights[k] != 0) s[mesh.faces()[p.face][k]] += p.weights[k] / sum;
  }
  return s;
}

// From one point to another: shares sum to zero, so any vertex may be the origin; the heaviest loses least.
Arrow way(const Mesh& mesh, const Shares& a, const Shares& b) {
  Shares difference = b;
  for (const auto& [v, w] : a) difference[v] -= w;
  const auto heaviest =
      std::max_element(a.begin(), a.end(), [](const auto& i, const auto& j) { return i.second < j.second; })->first;
  Arrow sum;
  for (const auto& [v, w] : difference) sum = sum + w * arrow(mesh.positions()[heaviest], mesh.positions()[v]);
  return sum;
}

class Judge {
 public:
  Judge(const Mesh& mesh, const SurfacePath& path) : mesh_(mesh), path_(path) {
    for (const SurfacePoint& p : path.points) at_.push_back(shares_of(mesh, p));
  }

  std::string operator()() {
    if (std::string c = faces(); !c.empty()) return c;
    Real length = 0;
    for (std::size_t i = 0; i + 1 < at_.size(); ++i) length += norm(way(mesh_, at_[i], at_[i + 1]));
    if (!(std::abs(length - path_.length) <= kPathRoom * length + blur(0) + blur(at_.size() - 1))) {
      return say("length", "pieces sum to ", length, ", not to ", path_.length);
    }
    const Real chord = norm(straight());
    if (!(path_.length >= chord * (1 - 64 * kEpsilon) - blur(0) - blur(at_.size() - 1))) {
      return say("chord", path_.length, " < ", chord);
    }
    for (std::size_t i = 1; i + 1 < at_.size(); ++i) {
      if (std::string c = bend(i); !c.empty()) return c;
    }
    return "";
  }

  // By how much the ends can be elsewhere: what their weights are rounded by.
  Real blur(std::size_t i) const {
    Real longest = 0;
    if (at_[i].size() > 1) {
      const Face& t = mesh_.faces()[path_.points[i].face];
      for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, edge(t[k], t[(k + 1) % 3]));
      Real second = 1;  // a point beside a vertex is known to a share of how near it is
      for (const auto& [v, w] : at_[i]) second = std::min(second, 1 - w);
      longest *= second;
    }
    return 2 * kEpsilon * longest;
  }

 private:
  template <class... Parts>
  static std::string say(const char* word, const Parts&... parts) {
    std::ostringstream out;
    out.precision(17);
    out << word << ": ";
    (out << ... << parts);
    return out.str();
  }

  Real edge(Index a, Index b) const { return norm(arrow(mesh_.positions()[a], mesh_.positions()[b])); }

  Arrow straight() const {
    const auto heaviest = std::max_element(at_.front().begin(), at_.front().end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
    const Vec3 origin = mesh_.positions()[heaviest->first];
    Arrow sum;
    for (const auto& [v, w] : at_.back()) sum = sum + w * arrow(origin, mesh_.positions()[v]);
    for (const auto& [v, w] : at_.front()) sum = sum + (-w) * arrow(origin, mesh_.positions()[v]);
    return sum;
  }

  std::vector<Index> holding(const Shares& a, const Shares& b) const {
    std::vector<Index> out;
    for (const Index h : mesh_.corners(a.begin()->first)) {
      const Face& t = mesh_.faces()[h / 3];
      const auto in = [&](const Shares& s) {
        return std::all_of(s.begin(), s.end(),
                           [&](const auto& e) { return std::find(t.begin(), t.end(), e.first) != t.end(); });
      };
      if (in(a) && in(b)) out.push_back(h / 3);
    }
    return out;
  }

  std::string faces() const {
    for (std::size_t i = 0; i < at_.size(); ++i) {
      for (const double w : path_.points[i].weights) {
        if (!(w >= 0)) return say("face", "point ", i, " has weight ", w);
      }
      if (i + 1 == at_.size()) break;
      if (holding(at_[i], at_[i + 1]).empty()) return say("face", "points ", i, " and the next share no face");
      if (at_[i] == at_[i + 1]) return say("face", "point ", i, " is repeated");
    }
    return "";
  }

  // How far the direction from point i to a neighbour may be off.
  Real room(std::size_t i, std::size_t j) const {
    Real longest = 0;
    for (const Index f : holding(at_[i], at_[j])) {
      const Face& t = mesh_.faces()[f];
      for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, edge(t[k], t[(k + 1) % 3]));
    }
    Real second = 1;
    for (const auto& [v, w] : at_[j]) second = std::min(second, 1 - w);
    if (at_[i].size() > 1) second = 1;
    return at_[j].size() == 1 && at_[i].size() == 1
               ? 0
               : 8 * kEpsilon * longest * second / norm(way(mesh_, at_[i], at_[j]));
  }

  std::string bend(std::size_t i) const {
    const Arrow a = way(mesh_, at_[i], at_[i - 1]), b = way(mesh_, at_[i], at_[i + 1]);
    const Real allowed = kAngleRoom + room(i, i - 1) + room(i, i + 1);
    if (at_[i].size() == 3) return say("edge bend", "point ", i, " lies inside a face");
    if (at_[i].size() == 2) {
      const Arrow e = arrow(mesh_.positions()[at_[i].begin()->first], mesh_.positions()[at_[i].rbegin()->first]);
      const Real turn = angle_between(a, e) + angle_between(b, e) - kHalfTurn;
      return std::abs(turn) <= allowed ? "" : say("edge bend", turn, " at point ", i, " of ", at_.size());
    }
    const Index v = at_[i].begin()->first;
    for (const Index h : mesh_.corners(v)) {  // edges without length have no directions
      for (const Index w : mesh_.faces()[h / 3]) {
        if (w != v && edge(v, w) == 0) return "";
      }
    }
    const Real angle = angle_around(v, i, a, b);
    return angle >= kHalfTurn - allowed
               ? ""
               : say("bend", "angle pi - ", kHalfTurn - angle, " at vertex ", v, ", point ", i);
  }

  // The least angle around the vertex between two directions in its faces (Floyd and Warshall over its edges).
  Real angle_around(Index v, std::size_t i, Arrow a, Arrow b) const {
    std::map<Index, std::size_t> node;
    for (const Index h : mesh_.corners(v)) {
      for (const Index w : mesh_.faces()[h / 3]) {
        if (w != v) node.emplace(w, node.size() + 2);
      }
    }
    const std::size_t n = node.size() + 2;
    std::vector<Real> d(n * n, kFar);
    const auto join = [&](std::size_t p, std::size_t q, Real angle) {
      d[p * n + q] = d[q * n + p] = std::min(d[p * n + q], angle);
    };
    const auto to = [&](Index w) { return arrow(mesh_.positions()[v], mesh_.positions()[w]); };
    for (const Index h : mesh_.corners(v)) {
      if (!mesh_.is_face_usable(h / 3)) continue;
      const Face& t = mesh_.faces()[h / 3];
      const Index u = t[(h + 1) % 3], w = t[(h + 2) % 3];
      join(node[u], node[w], angle_between(to(u), to(w)));
    }
    const std::vector<Index> before = holding(at_[i], at_[i - 1]), after = holding(at_[i], at_[i + 1]);
    for (const Index f : before) {
      for (const Index w : mesh_.faces()[f]) {
        if (w != v) join(0, node[w], angle_between(a, to(w)));
      }
      if (std::find(after.begin(), after.end(), f) != after.end()) join(0, 1, angle_between(a, b));
    }
    for (const Index f : after) {
      for (const Index w : mesh_.faces()[f]) {
        if (w != v) join(1, node[w], angle_between(b, to(w)));
      }
    }
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t p = 0; p < n; ++p) {
        for (std::size_t q = 0; q < n; ++q) d[p * n + q] = std::min(d[p * n + q], d[p * n + k] + d[k * n + q]);
      }
    }
    return d[1];
  }

  const Mesh& mesh_;
  const SurfacePath& path_;
  std::vector<Shares> at_;
};

std::string judge(const Mesh& mesh, const SurfacePath& path, PathVerdict& v, double bound) {
  if (path.points.empty()) return v.reached ? "none" : "";
  if (!v.reached) return "none: the field is infinite, the path is not";
  Judge judge(mesh, path);
  if (std::string c = judge(); !c.empty()) return c;
  const Real blur = judge.blur(0) + judge.blur(path.points.size() - 1);
  if (std::abs(path.length - v.field) > std::max(kPathRoom * v.field, bound) + static_cast<double>(blur))
    return "field";
  return "";
}

}  // namespace

PathVerdict judge_path(const Mesh& mesh, const SurfacePoint& from, const SurfacePoint& to, bool ask_oracle, int* stage,
                       const CancelToken* cancel) {
  int ignored = 0;
  int& at = stage ? *stage : ignored;
  PathVerdict v;
  DistanceOptions options;
  options.method = Method::Exact;
  options.targets = {to};
  options.keep_paths = true;
  options.cancel = cancel;
  const Source source{from};
  at = 1;
  const DistanceField field = distance(mesh, std::span(&source, 1), options);
  v.field = field.target_distance[0];
  v.reached = v.field < kInfinity;
  const double bound = field.max_error_bound > 0 && v.reached ? field.max_error_bound * v.field : 0;
  at = 2;
  try {
    const SurfacePath path = path_to(*field.windows, to);
    v.length = path.length;
    v.complaint = judge(mesh, path, v, bound);
  } catch (const Error& e) {
    v.complaint = std::string("lost: ") + e.what();
  }
  v.field_true = true;
  if (!ask_oracle) return v;
  at = 3;
  v.truth = polyhedral_distance(mesh, std::span(&source, 1), kFar, options.targets).target[0];
  v.field_true = v.reached == (v.truth < kFar) &&
                 (!v.reached || std::abs(v.field - v.truth) <= std::max<Real>(kFieldRoom * v.truth, bound));
  return v;
}

}  // namespace brushfire::oracle
