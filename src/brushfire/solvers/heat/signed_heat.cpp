// Curves as normals in faces, spread as vectors, and the function whose gradient follows them.
#include <brushfire/solvers/signed_heat.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/solvers/heat/carrier.h>
#include <brushfire/solvers/heat/connection.h>
#include <brushfire/solvers/heat/level_sets.h>
#include <brushfire/solvers/heat/scales.h>
#include <brushfire/solvers/heat/sides.h>
#include <brushfire/solvers/heat/system.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <string>
#include <utility>

namespace brushfire {

using heat::Complex;

namespace {

HeatOptions checked(const HeatOptions& options) {
  heat::check(options);
  return options;
}

// A piece of a curve within one face, laid flat.
struct Segment {
  Index face;
  Complex along;                  // in the frame of the face's first edge
  std::array<double, 3> weights;  // of its middle
};

// What walls leave of a curve.
struct Drawn {
  std::vector<PointLocation> nodes;  // its points, on each side that it runs along
  std::vector<Segment> segments;
};

// Vectors at vertices, in the units of the heat that they came with.
struct Directions {
  heat::Heat heat;
  std::vector<Complex> vector;
};

std::vector<PointLocation> sides_of(const Domain& domain, const SurfacePoint& point) {
  std::vector<PointLocation> sides;
  for (const SurfacePoint& p : domain.on_open(point)) sides.push_back(locate(domain.open(), p));
  return sides;
}

Error behind_walls(const std::string& what) {
  return {ErrorCode::InvalidArgument, what + " lies behind a wall: nothing can be reached from there"};
}

}  // namespace

struct SignedHeatSolver::State {
  State(const Domain& given, const HeatOptions& how)
      : domain(given),
        mesh(given.open()),
        system(mesh, how.delaunay, how.time_factor, how.time),
        levels(system.operators(), system.components()) {
    flat = heat::triangulation_of(mesh, heat::Cover::Single);
    heat::mollify(flat, system.components());
    flat.bearing = system.mesh_bearings();
  }

  Domain domain;
  Mesh mesh;  // the open one
  heat::VectorSystem system;
  heat::LevelSets levels;
  heat::Triangulation flat;  // the mesh itself, where curves are

  Drawn drawn(const SignedCurve& curve, std::size_t which) const;
  Segment segment(Index face, const PointLocation& from, const PointLocation& to) const;
  void add(const Segment& s, std::vector<Complex>& x) const;
  void add_outward(const PointLocation& p, double weight, std::vector<Complex>& x) const;
  Directions carried(std::vector<Complex> x);
  std::vector<double> divergence(const Directions& x) const;
  void turn_along(std::span<const Segment> all, const Directions& x, std::vector<double>& b) const;
  Complex mean_in(const heat::Triangulation& t, std::size_t face, const Directions& x) const;
};

SignedHeatSolver::SignedHeatSolver(const Domain& domain, const HeatOptions& options)
    : state_(std::make_unique<State>(domain, checked(options))) {}
SignedHeatSolver::~SignedHeatSolver() = default;
SignedHeatSolver::SignedHeatSolver(SignedHeatSolver&&) noexcept = default;
SignedHeatSolver& SignedHeatSolver::operator=(SignedHeatSolver&&) noexcept = default;

// A piece along a wall is one on each side of it. A side that no piece of a signed curve comes to would not know which
// side of the curve it is, and is left out.
Drawn SignedHeatSolver::State::drawn(const SignedCurve& curve, std::size_t which) const {
  Drawn drawn;
  std::vector<std::vector<PointLocation>> sides;
  for (const SurfacePoint& p : curve.points) sides.push_back(sides_of(domain, p));
  std::vector<std::vector<bool>> used;
  for (const auto& of_point : sides) used.emplace_back(of_point.size(), curve.points.size() == 1 || !curve.is_signed);
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    if (common_face(domain.mesh(), locate(domain.mesh(), curve.points[i]),
                    locate(domain.mesh(), curve.points[i + 1])) == kNoIndex) {
      throw Error(ErrorCode::InvalidArgument,
                  "points " + std::to_string(i) + " and " + std::to_string(i + 1) + " of a curve share no face");
    }
    for (std::size_t j = 0; j < sides[i].size(); ++j) {
      for (std::size_t k = 0; k < sides[i + 1].size(); ++k) {
        const Index f = common_face(mesh, sides[i][j], sides[i + 1][k]);
        if (f == kNoIndex) continue;
        drawn.segments.push_back(segment(f, sides[i][j], sides[i + 1][k]));
        used[i][j] = used[i + 1][k] = true;
      }
    }
  }
  for (std::size_t i = 0; i < sides.size(); ++i) {
    for (std::size_t j = 0; j < sides[i].size(); ++j) {
      if (used[i][j]) drawn.nodes.push_back(sides[i][j]);
    }
  }
  if (drawn.nodes.empty() && !curve.points.empty()) throw behind_walls("curve " + std::to_string(which));
  return drawn;
}

Segment SignedHeatSolver::State::segment(Index face, const PointLocation& from, const PointLocation& to) const {
  const std::array<double, 3> a = *weights_in(mesh, from, face), b = *weights_in(mesh, to, face);
  const heat::FlatTriangle t = heat::lay_flat(flat, face);
  const auto place = [&](const std::array<double, 3>& w) {
    return Complex(w[1] * t.length + w[2] * t.apex.x, w[2] * t.apex.y);
  };
  Segment s{face, place(b) - place(a), {}};
  for (int k = 0; k < 3; ++k) s.weights[k] = 0.5 * (a[k] + b[k]);
  return s;
}

// To its right, as strong as it is long.
void SignedHeatSolver::State::add(const Segment& s, std::vector<Complex>& x) const {
  const heat::FlatTriangle t = heat::lay_flat(flat, s.face);
  for (int k = 0; k < 3; ++k) {
    const Index h = 3 * s.face + k;
    x[flat.tail[h]] +=
        s.weights[k] * Complex(0, -1) * s.along * heat::direction(flat, system.spaces(), h) / heat::direction_in(t, k);
  }
}

// Away from a point without a direction: at the neighbours of the vertices around it, with the weights of the
// Laplacian, so that on a flat place they sum to 0.
void SignedHeatSolver::State::add_outward(const PointLocation& p, double weight, std::vector<Complex>& x) const {
  for (int k = 0; k < 3; ++k) {
    if (!(p.weights[k] > 0)) continue;
    const Index v = mesh.faces()[p.face][k];
    for (const Index corner : mesh.corners(v)) {
      for (const Index h : {corner, Mesh::previous(corner)}) {  // out along an edge, and in: each face's half
        const bool out = flat.tail[h] == v;
        const Index other = out ? flat.tail[Mesh::next(h)] : flat.tail[h];
        const Complex back =
            out ? heat::direction_back(flat, system.spaces(), h) : heat::direction(flat, system.spaces(), h);
        x[other] -= weight * p.weights[k] * heat::half_cotangent(flat, h) * flat.length[h] * back;
      }
    }
  }
}

// The vectors of a triangle's corners in its own frame, together.
Complex SignedHeatSolver::State::mean_in(const heat::Triangulation& t, std::size_t face, const Directions& x) const {
  const heat::FlatTriangle flat_face = heat::lay_flat(t, face);
  const Index* const corners = &t.tail[3 * face];
  const std::uint32_t base = std::min({x.heat.level[corners[0]], x.heat.level[corners[1]], x.heat.level[corners[2]]});
  std::array<Complex, 3> at;
  double largest = 0;
  for (int k = 0; k < 3; ++k) {
    at[k] = x.vector[corners[k]] * x.heat.unit(corners[k], base);
    largest = std::max(largest, std::abs(at[k]));
  }
  Complex sum;
  for (int k = 0; k < 3 && largest > 0; ++k) {
    const Index h = static_cast<Index>(3 * face + k);
    sum += at[k] / largest * heat::direction_in(flat_face, k) / heat::direction(t, system.spaces(), h);
  }
  const double length = std::abs(sum);
  return length > 0 ? sum / length : Complex();
}

Directions SignedHeatSolver::State::carried(std::vector<Complex> x) {
  std::vector<Index> from;
  for (Index v = 0; v < x.size(); ++v) {
    if (x[v] != Complex()) from.push_back(v);
  }
  const heat::Carrier carrier(system, from);
  carrier.carry(x);
  return {carrier.heat(), std::move(x)};
}

namespace {

void add_flux(const heat::Triangulation& t, std::size_t face, Complex x, std::vector<double>& b) {
  const heat::FlatTriangle flat = heat::lay_flat(t, face);
  const double to_1 = 0.5 * (x.real() * flat.apex.y - x.imag() * flat.apex.x);
  const double to_2 = 0.5 * x.imag() * flat.length;
  b[t.tail[3 * face]] -= to_1 + to_2;
  b[t.tail[3 * face + 1]] += to_1;
  b[t.tail[3 * face + 2]] += to_2;
}

}  // namespace

std::vector<double> SignedHeatSolver::State::divergence(const Directions& x) const {
  const heat::Triangulation& t = system.triangulation();
  std::vector<double> b(mesh.vertex_count(), 0.0);
  for (std::size_t f = 0; f < t.face_count(); ++f) add_flux(t, f, mean_in(t, f, x), b);
  return b;
}

// In the faces that curves run through, the direction at right angles to them in place of what heat says.
void SignedHeatSolver::State::turn_along(std::span<const Segment> all, const Directions& x,
                                         std::vector<double>& b) const {
  std::map<Index, Complex> across;
  for (const Segment& s : all) across[s.face] += Complex(0, -1) * s.along;
  for (const auto& [face, normal] : across) {
    if (!(std::abs(normal) > 0)) continue;
    add_flux(flat, face, normal / std::abs(normal) - mean_in(flat, face, x), b);
  }
}

std::vector<double> SignedHeatSolver::distance(std::span<const SignedCurve> curves,
                                               std::span<const SurfacePoint> points, const SignedHeatOptions& options) {
  State& s = *state_;
  if (curves.empty() && points.empty()) throw Error(ErrorCode::InvalidArgument, "no curve and no point given");
  std::vector<Complex> x(s.mesh.vertex_count());
  std::vector<Segment> directed;
  std::vector<std::vector<PointLocation>> groups;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Drawn drawn = s.drawn(curves[i], i);
    if (curves[i].is_signed) {
      for (const Segment& segment : drawn.segments) s.add(segment, x);
      directed.insert(directed.end(), drawn.segments.begin(), drawn.segments.end());
    } else {
      for (const PointLocation& p : drawn.nodes) s.add_outward(p, 1, x);
    }
    groups.push_back(drawn.nodes);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::vector<PointLocation>& sides = groups.emplace_back(sides_of(s.domain, points[i]));
    if (sides.empty()) throw behind_walls("point " + std::to_string(i));
    for (const PointLocation& p : sides) s.add_outward(p, 1, x);
  }
  const Directions away = s.carried(std::move(x));
  std::vector<double> b = s.divergence(away);
  if (options.preserve_normals) s.turn_along(directed, away, b);
  std::vector<double> d = s.levels.integrate(s.mesh, std::move(b), groups, options);
  const std::vector<double> of_side = d;
  return heat::of_nearest_sides(s.domain, std::move(d),
                                [&](Index a, Index c) { return std::abs(of_side[a]) < std::abs(of_side[c]); });
}

}  // namespace brushfire
