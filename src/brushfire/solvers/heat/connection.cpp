// Frames at vertices, how directions turn along edges, and the vector Laplacian that is made of them.
#include <brushfire/solvers/heat/connection.h>

#include <cmath>
#include <span>
#include <utility>

namespace brushfire::heat {
namespace {

double angle_at_tail(const Triangulation& t, Index h) {
  const FlatTriangle flat = lay_flat(t, h / 3);
  const Complex a = direction_in(flat, static_cast<int>(h % 3));
  const Complex b = -direction_in(flat, static_cast<int>(Mesh::previous(h) % 3));
  return std::abs(std::arg(b / a));
}

}  // namespace

Complex direction_in(const FlatTriangle& flat, int k) {
  const Complex corners[3] = {0, flat.length, {flat.apex.x, flat.apex.y}};
  const Complex edge = corners[(k + 1) % 3] - corners[k];
  return edge / std::abs(edge);
}

TangentSpaces lay_out_tangents(Triangulation& t) {
  TangentSpaces spaces{std::vector<double>(t.vertex_count, 0), std::vector<double>(t.vertex_count, 1)};
  t.bearing.assign(t.tail.size(), -1);
  std::vector<bool> on_border(t.vertex_count, false);
  // Counter-clockwise from h on, until the fan ends or closes.
  const auto go_around = [&](Index h) {
    double& total = spaces.total[t.tail[h]];
    while (h != kNoIndex && t.bearing[h] < 0) {
      t.bearing[h] = total;
      total += angle_at_tail(t, h);
      h = t.twin[Mesh::previous(h)];
    }
  };
  for (Index h = 0; h < t.tail.size(); ++h) {
    if (t.twin[h] != kNoIndex) continue;
    on_border[t.tail[h]] = true;
    go_around(h);
  }
  for (Index h = 0; h < t.tail.size(); ++h) go_around(h);
  for (Index v = 0; v < t.vertex_count; ++v) {
    if (spaces.total[v] > 0) spaces.stretch[v] = (on_border[v] ? kPi : 2 * kPi) / spaces.total[v];
  }
  return spaces;
}

Complex direction(const Triangulation& t, const TangentSpaces& spaces, Index h) {
  return std::polar(1.0, spaces.stretch[t.tail[h]] * t.bearing[h]);
}

Complex direction_back(const Triangulation& t, const TangentSpaces& spaces, Index h) {
  if (t.twin[h] != kNoIndex) return direction(t, spaces, t.twin[h]);
  // The last edge of the fan: after the halfedge before it, by the angle between them.
  const Index before = Mesh::next(h);
  const Index v = t.tail[before];
  return std::polar(1.0, spaces.stretch[v] * (t.bearing[before] + angle_at_tail(t, before)));
}

namespace {

// Entry (i, j) below the diagonal: minus the weight of the edge, times turn(h) or its inverse.
template <class Scalar, class Turn>
std::vector<Scalar> assembled(const Triangulation& t, const Operators& o, std::span<const double> weight,
                              const Turn& turn) {
  std::vector<Scalar> matrix(o.pattern.row.size());
  for (Index h = 0; h < t.tail.size(); ++h) {
    const Index a = t.tail[h], b = t.tail[Mesh::next(h)];
    const double w = weight[h] / t.sheets;
    const Scalar along = turn(h);
    matrix[o.pattern.start[a]] += w;
    matrix[o.pattern.start[b]] += w;
    matrix[o.edge_entry[h]] -= a == b ? w * (along + conjugate(along)) : w * (a > b ? along : conjugate(along));
  }
  return matrix;
}

std::vector<double> half_cotangents(const Triangulation& t) {
  std::vector<double> weight;
  for (Index h = 0; h < t.tail.size(); ++h) weight.push_back(half_cotangent(t, h));
  return weight;
}

// 0 for edges whose both halves together are less.
std::vector<double> without_negative(const Triangulation& t, std::vector<double> weight) {
  for (Index h = 0; h < t.tail.size(); ++h) {
    const Index twin = t.twin[h];
    if (twin != kNoIndex && twin < h) continue;
    if (weight[h] + (twin == kNoIndex ? 0 : weight[twin]) >= 0) continue;
    weight[h] = 0;
    if (twin != kNoIndex) weight[twin] = 0;
  }
  return weight;
}

// From the frame at the head of h to that at its tail: the edge runs against its own way back.
Complex turn_along(const Triangulation& t, const TangentSpaces& spaces, Index h) {
  return -direction(t, spaces, h) * std::conj(direction_back(t, spaces, h));
}

}  // namespace

VectorSystem::VectorSystem(const Mesh& mesh, bool delaunay, double time_factor, double time) {
  require_factorization();
  triangulation_ = triangulation_of(mesh, Cover::Single);
  components_ = detail::components_of(mesh);
  is_point_ = points_among(triangulation_, components_);
  mollify(triangulation_, components_);
  spaces_ = lay_out_tangents(triangulation_);
  mesh_bearings_ = triangulation_.bearing;
  if (delaunay) flip_to_delaunay(triangulation_);
  times_ = times_of(triangulation_, components_, time_factor, time / mesh.unit() / mesh.unit());
  operators_ = operators_of(triangulation_);
  weights_ = without_negative(triangulation_, half_cotangents(triangulation_));
}

namespace {

// From L to M + t L; 1 where there is nothing.
template <class Scalar>
std::vector<Scalar> spreading(const Operators& o, std::vector<Scalar> laplacian, const VectorSystem& system) {
  for (int v = 0; v < o.pattern.columns(); ++v) {
    const double time = system.time_at(static_cast<Index>(v));
    for (int e = o.pattern.start[v]; e < o.pattern.start[v + 1]; ++e) laplacian[e] *= time;
    laplacian[o.pattern.start[v]] += o.mass[v] > 0 ? o.mass[v] : 1;
  }
  return laplacian;
}

}  // namespace

std::vector<Complex> VectorSystem::connection_laplacian() const {
  return assembled<Complex>(triangulation_, operators_, half_cotangents(triangulation_),
                            [&](Index h) { return turn_along(triangulation_, spaces_, h); });
}

const HeatEquation<double>& VectorSystem::scalar_heat() {
  if (!scalar_) {
    const auto same = [](Index) { return 1.0; };
    std::vector<double> laplacian = assembled<double>(triangulation_, operators_, weights_, same);
    scalar_.emplace(operators_.pattern, spreading(operators_, std::move(laplacian), *this));
  }
  return *scalar_;
}

const HeatEquation<Complex>& VectorSystem::vector_heat() {
  if (!vector_) {
    const auto turn = [&](Index h) { return turn_along(triangulation_, spaces_, h); };
    std::vector<Complex> laplacian = assembled<Complex>(triangulation_, operators_, weights_, turn);
    vector_.emplace(operators_.pattern, spreading(operators_, std::move(laplacian), *this));
  }
  return *vector_;
}

}  // namespace brushfire::heat
