// Domains on a lattice, exact visibility, Dijkstra's algorithm on the visibility graph.
#include "oracle/planar_domain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace brushfire::oracle {
namespace {

LatticePoint operator-(LatticePoint a, LatticePoint b) { return {a.x - b.x, a.y - b.y}; }
std::int64_t cross(LatticePoint a, LatticePoint b) { return a.x * b.y - a.y * b.x; }
std::int64_t dot(LatticePoint a, LatticePoint b) { return a.x * b.x + a.y * b.y; }

int below(std::mt19937& random, int n) { return static_cast<int>(random() % static_cast<std::uint32_t>(n)); }

// Two faces that have an edge in common.
bool adjacent(const Face& a, const Face& b) {
  int common = 0;
  for (const Index v : a) common += v == b[0] || v == b[1] || v == b[2];
  return common == 2;
}

// The segment has points in the open triangle: no line along a side of the triangle and not the segment's own line has
// the two on different sides (separating axes of convex sets in the plane).
bool enters(LatticePoint p, LatticePoint q, const std::array<LatticePoint, 3>& t) {
  for (int k = 0; k < 3; ++k) {
    const LatticePoint a = t[k], side = t[(k + 1) % 3] - a;
    if (cross(side, p - a) <= 0 && cross(side, q - a) <= 0) return false;
  }
  int left = 0, right = 0;
  for (const LatticePoint c : t) {
    const std::int64_t s = cross(q - p, c - p);
    left += s > 0;
    right += s < 0;
  }
  return left > 0 && right > 0;
}

bool overlaps(LatticePoint p, LatticePoint q, LatticePoint a, LatticePoint b) {
  const LatticePoint d = q - p;
  if (cross(d, a - p) != 0 || cross(d, b - p) != 0) return false;
  const std::int64_t at_a = dot(d, a - p), at_b = dot(d, b - p);
  return std::min(at_a, at_b) < dot(d, d) && std::max(at_a, at_b) > 0;
}

long double length(LatticePoint d) { return std::hypot(static_cast<long double>(d.x), static_cast<long double>(d.y)); }

// Edges of removed faces that no face of the domain has.
std::set<std::pair<Index, Index>> closed_edges(const PlanarDomain& domain) {
  std::set<std::pair<Index, Index>> closed;
  for (const Face& t : domain.removed) {
    for (int k = 0; k < 3; ++k) closed.insert(std::minmax(t[k], t[(k + 1) % 3]));
  }
  for (const Face& t : domain.faces) {
    for (int k = 0; k < 3; ++k) closed.erase(std::minmax(t[k], t[(k + 1) % 3]));
  }
  return closed;
}

struct Walls {
  std::vector<std::array<LatticePoint, 3>> triangles;
  std::vector<std::array<LatticePoint, 2>> edges;

  explicit Walls(const PlanarDomain& domain) {
    for (const Face& t : domain.removed) {
      triangles.push_back({domain.points[t[0]], domain.points[t[1]], domain.points[t[2]]});
    }
    for (const auto& [a, b] : closed_edges(domain)) edges.push_back({domain.points[a], domain.points[b]});
  }

  Walls finer(std::int64_t scale) const {
    Walls scaled = *this;
    const auto grow = [&](LatticePoint& p) { p = {scale * p.x, scale * p.y}; };
    for (auto& t : scaled.triangles) std::for_each(t.begin(), t.end(), grow);
    for (auto& e : scaled.edges) std::for_each(e.begin(), e.end(), grow);
    return scaled;
  }

  bool block(LatticePoint p, LatticePoint q) const {
    return std::any_of(triangles.begin(), triangles.end(), [&](const auto& t) { return enters(p, q, t); }) ||
           std::any_of(edges.begin(), edges.end(), [&](const auto& e) { return overlaps(p, q, e[0], e[1]); });
  }
};

}  // namespace

Mesh PlanarDomain::mesh() const {
  std::vector<Vec3> positions;
  for (const LatticePoint p : points) positions.push_back({static_cast<double>(p.x), static_cast<double>(p.y), 0});
  return Mesh(positions, faces);
}

PlanarDomain random_domain(std::mt19937& random, int cells, int holes, bool regular) {
  constexpr int kSpacing = 600;
  constexpr int kJitter = 20;  // times six; a fifth of the spacing: every square stays convex
  PlanarDomain domain;
  for (int y = 0; y <= cells; ++y) {
    for (int x = 0; x <= cells; ++x) {
      const bool fixed_x = regular || x == 0 || x == cells, fixed_y = regular || y == 0 || y == cells;
      const int dx = fixed_x ? 0 : 6 * (below(random, 2 * kJitter + 1) - kJitter);
      const int dy = fixed_y ? 0 : 6 * (below(random, 2 * kJitter + 1) - kJitter);
      domain.points.push_back({x * kSpacing + dx, y * kSpacing + dy});
    }
  }
  std::vector<Face> all;
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      const auto a = static_cast<Index>(y * (cells + 1) + x), b = a + 1, d = a + static_cast<Index>(cells) + 1,
                 c = d + 1;
      if (below(random, 2) == 0) {
        all.insert(all.end(), {{a, b, c}, {a, c, d}});
      } else {
        all.insert(all.end(), {{a, b, d}, {b, c, d}});
      }
    }
  }
  std::vector<bool> gone(all.size(), false);
  for (int hole = 1 + below(random, holes); hole > 0; --hole) {
    std::size_t at = random() % all.size();
    for (int size = 1 + below(random, 9); size > 0; --size) {
      gone[at] = true;
      std::vector<std::size_t> next;
      for (std::size_t f = 0; f < all.size(); ++f) {
        if (adjacent(all[f], all[at])) next.push_back(f);
      }
      at = next[random() % next.size()];
    }
  }
  if (std::find(gone.begin(), gone.end(), false) == gone.end()) gone[0] = false;
  for (std::size_t f = 0; f < all.size(); ++f) (gone[f] ? domain.removed : domain.faces).push_back(all[f]);
  return domain;
}

DomainPoint random_point(const PlanarDomain& domain, std::mt19937& random) {
  return random_point(domain, static_cast<Index>(random() % domain.faces.size()), random);
}

DomainPoint random_point(const PlanarDomain& domain, Index f, std::mt19937& random) {
  const Face& t = domain.faces[f];
  const LatticePoint a = domain.points[t[0]], b = domain.points[t[1]], c = domain.points[t[2]];
  switch (below(random, 3)) {
    case 0:
      return {a, {f, {1, 0, 0}}};
    case 1:
      return {{(b.x + c.x) / 2, (b.y + c.y) / 2}, {f, {0, 0.5, 0.5}}};
    default:
      return {{(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3}, {f, {1.0 / 3, 1.0 / 3, 1.0 / 3}}};
  }
}

bool visible(const PlanarDomain& domain, LatticePoint p, LatticePoint q) { return !Walls(domain).block(p, q); }

std::vector<long double> visibility_distances(const PlanarDomain& domain, LatticePoint source) {
  return visibility_distances(domain, std::span(&source, 1));
}

std::vector<long double> visibility_distances(const PlanarDomain& domain, std::span<const LatticePoint> curve) {
  constexpr long double kNever = std::numeric_limits<long double>::infinity();
  const Walls walls(domain);
  const std::size_t count = domain.points.size();
  std::vector<bool> used(count, false), done(count, false);
  for (const Face& t : domain.faces) {
    for (const Index v : t) used[v] = true;
  }
  std::vector<long double> distance(count, kNever);
  const auto relax_from = [&](LatticePoint p, long double d) {
    for (std::size_t v = 0; v < count; ++v) {
      if (!used[v] || done[v]) continue;
      const long double through = d + length(domain.points[v] - p);
      if (through < distance[v] && !walls.block(p, domain.points[v])) distance[v] = through;
    }
  };
  for (const LatticePoint p : curve) relax_from(p, 0);
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    for (std::size_t v = 0; v < count; ++v) {
      if (!used[v]) continue;
      const LatticePoint p = domain.points[v], step = curve[i + 1] - curve[i];
      const std::int64_t ahead = dot(p - curve[i], step), all = dot(step, step);
      if (ahead <= 0 || ahead >= all) continue;
      // The foot is a place of a lattice that is finer by the share's denominator.
      const std::int64_t common = std::gcd(ahead, all), share = ahead / common, finer = all / common;
      const LatticePoint foot{finer * curve[i].x + share * step.x, finer * curve[i].y + share * step.y};
      const long double way = std::abs(static_cast<long double>(cross(step, p - curve[i]))) / length(step);
      if (way < distance[v] && !walls.finer(finer).block(foot, {finer * p.x, finer * p.y})) distance[v] = way;
    }
  }
  while (true) {
    std::size_t nearest = count;
    for (std::size_t v = 0; v < count; ++v) {
      if (!done[v] && distance[v] < kNever && (nearest == count || distance[v] < distance[nearest])) nearest = v;
    }
    if (nearest == count) return distance;
    done[nearest] = true;
    relax_from(domain.points[nearest], distance[nearest]);
  }
}

}  // namespace brushfire::oracle
