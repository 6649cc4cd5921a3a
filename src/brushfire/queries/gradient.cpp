// Gradients per face, steepest descent at points.
#include <brushfire/queries/gradient.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>

#include <cmath>
#include <string>

namespace brushfire {
namespace {

void check_count(const Mesh& mesh, std::span<const double> values) {
  if (values.size() != mesh.vertex_count()) {
    throw Error(ErrorCode::InvalidArgument,
                std::to_string(values.size()) + " values for " + std::to_string(mesh.vertex_count()) + " vertices");
  }
}

// The values at the corners of face f. False where one of them is +inf.
bool corner_values(const Mesh& mesh, std::span<const double> values, Index f, std::array<double, 3>& result) {
  bool finite = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Index v = mesh.faces()[f][k];
    result[k] = values[v];
    if (std::isnan(result[k]) || result[k] == -kInfinity) {
      throw Error(ErrorCode::InvalidArgument, "vertex " + std::to_string(v) + " reads " + std::to_string(result[k]) +
                                                  ": a value is finite or +inf");
    }
    finite = finite && result[k] != kInfinity;
  }
  return finite;
}

// One face laid flat, with the field in it.
class FlatField {
 public:
  FlatField(const Mesh& mesh, Index f, const std::array<double, 3>& values)
      : corner_(flat_corners(mesh, f)), e1_(corner_[1] - corner_[0]), e2_(corner_[2] - corner_[0]) {
    det_ = cross(e1_, e2_);
    if (!has_area()) return;
    const double d1 = values[1] - values[0], d2 = values[2] - values[0];
    gradient_ = {(d1 * e2_.y - d2 * e1_.y) / det_, (d2 * e1_.x - d1 * e2_.x) / det_};
  }

  bool has_area() const { return det_ > 0; }
  Vec2 gradient() const { return gradient_; }

  std::array<double, 3> rates(Vec2 u) const {
    const double r1 = cross(u, e2_) / det_, r2 = cross(e1_, u) / det_;
    return {-(r1 + r2), r1, r2};
  }

  // From the point with these weights to corner k.
  Vec2 to_corner(const std::array<double, 3>& weights, std::size_t k) const {
    std::array<double, 3> at_corner{0, 0, 0};
    at_corner[k] = 1;
    return flat_difference(corner_, weights, at_corner);
  }

 private:
  std::array<Vec2, 3> corner_;
  Vec2 e1_, e2_, gradient_;
  double det_ = 0;
};

// Offers what falls fastest within one face, from the point with these weights in it. Lengths are in mesh.unit().
void descend_in_face(const FlatField& field, const std::array<double, 3>& weights, SurfaceDirection& best, Index f) {
  const auto offer = [&](const std::array<double, 3>& rates, double slope) {
    if (slope < best.slope) best = {f, rates, slope};
  };
  const Vec2 g = field.gradient();
  const double steepest = norm(g);
  if (steepest == 0) return;
  const std::array<double, 3> rates = field.rates((-1 / steepest) * g);
  bool leads_inside = true;
  for (std::size_t k = 0; k < 3; ++k) leads_inside = leads_inside && (weights[k] > 0 || rates[k] >= 0);
  if (leads_inside) {
    offer(rates, -steepest);
    return;
  }
  // Else along the face's edges that the point lies on: towards their ends.
  for (std::size_t k = 0; k < 3; ++k) {
    const bool on_edge_to_k = weights[(k + 1) % 3] == 0 || weights[(k + 2) % 3] == 0;
    if (weights[k] == 1 || !on_edge_to_k) continue;
    const Vec2 way = field.to_corner(weights, k);
    const double length = norm(way);
    if (length == 0) continue;
    // Exact for an edge: what weight k gains, the others lose in proportion.
    std::array<double, 3> along{};
    for (std::size_t j = 0; j < 3; ++j) along[j] = ((j == k ? 1.0 : 0.0) - weights[j]) / length;
    offer(along, dot(g, way) / length);
  }
}

}  // namespace

std::vector<Vec3> face_gradients(const Mesh& mesh, std::span<const double> values) {
  if (!mesh.has_positions()) {
    throw Error(ErrorCode::InvalidArgument, "a mesh from lengths has no gradients in space");
  }
  check_count(mesh, values);
  const double scale = 1 / mesh.unit();
  std::vector<Vec3> gradients(mesh.face_count());
  Poll poll;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    poll();
    std::array<double, 3> value;
    if (!corner_values(mesh, values, f, value) || !mesh.is_face_usable(f)) continue;
    const auto [a, b, c] = mesh.faces()[f];
    const Vec3 p = mesh.positions()[a];
    const Vec3 e1 = scale * (mesh.positions()[b] - p), e2 = scale * (mesh.positions()[c] - p);
    const Vec3 normal = cross(e1, e2);
    const double nn = dot(normal, normal);
    if (!(nn > 0)) continue;
    const double d1 = value[1] - value[0], d2 = value[2] - value[0];
    gradients[f] = (scale / nn) * (d1 * cross(e2, normal) + d2 * cross(normal, e1));
  }
  return gradients;
}

std::vector<Vec3> vertex_gradients(const Mesh& mesh, std::span<const double> values) {
  const std::vector<Vec3> of_faces = face_gradients(mesh, values);
  std::vector<Vec3> sums(mesh.vertex_count());
  std::vector<double> areas(mesh.vertex_count());
  Poll poll;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    poll();
    const Face& face = mesh.faces()[f];
    const double area = mesh.double_area(f);
    const bool is_finite = values[face[0]] < kInfinity && values[face[1]] < kInfinity && values[face[2]] < kInfinity;
    if (!is_finite || !(area > 0) || !mesh.is_face_usable(f)) continue;
    for (const Index v : face) {
      sums[v] = sums[v] + area * of_faces[f];
      areas[v] += area;
    }
  }
  for (Index v = 0; v < sums.size(); ++v) {
    if (areas[v] > 0) sums[v] = (1 / areas[v]) * sums[v];
  }
  return sums;
}

SurfaceDirection steepest_descent(const Mesh& mesh, std::span<const double> values, const SurfacePoint& point) {
  check_count(mesh, values);
  const PointLocation at = locate(mesh, point);
  SurfaceDirection best;
  for (const Index f : faces_at(mesh, at)) {
    std::array<double, 3> value;
    if (!corner_values(mesh, values, f, value) || !mesh.is_face_usable(f)) continue;
    const FlatField field(mesh, f, value);
    if (field.has_area()) descend_in_face(field, *weights_in(mesh, at, f), best, f);
  }
  for (double& rate : best.weight_rates) rate /= mesh.unit();
  best.slope /= mesh.unit();
  return best;
}

std::vector<Vec3> face_gradients(const Domain& domain, std::span<const double> values) {
  const std::vector<Vec3> on_open = face_gradients(domain.open(), domain.spread(values));
  std::vector<Vec3> gradients(domain.mesh().face_count());
  for (Index f = 0; f < on_open.size(); ++f) gradients[domain.face(f)] = on_open[f];
  return gradients;
}

std::vector<Vec3> vertex_gradients(const Domain& domain, std::span<const double> values) {
  const std::vector<double> field = domain.spread(values);
  const std::vector<Vec3> on_open = vertex_gradients(domain.open(), field);
  std::vector<Vec3> gradients(domain.mesh().vertex_count());
  std::vector<double> least(domain.mesh().vertex_count(), kInfinity);
  for (Index v = 0; v < on_open.size(); ++v) {
    const Index original = domain.vertex(v);
    if (!(field[v] < least[original])) continue;
    least[original] = field[v];
    gradients[original] = on_open[v];
  }
  return gradients;
}

SurfaceDirection steepest_descent(const Domain& domain, std::span<const double> values, const SurfacePoint& point) {
  const std::vector<double> on_open = domain.spread(values);
  const Mesh& open = domain.open();
  double least = kInfinity;
  SurfaceDirection steepest;
  for (const SurfacePoint& side : domain.on_open(point)) {
    double value = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (side.weights[k] > 0) value += side.weights[k] * on_open[open.faces()[side.face][k]];
    }
    if (value >= least) continue;
    least = value;
    steepest = steepest_descent(open, on_open, side);
  }
  if (steepest.face != kNoIndex) steepest.face = domain.face(steepest.face);
  return steepest;
}

Vec3 in_space(const Mesh& mesh, const SurfaceDirection& direction) {
  if (!mesh.has_positions() || direction.face >= mesh.face_count()) {
    throw Error(ErrorCode::InvalidArgument,
                mesh.has_positions() ? "there is no direction" : "a mesh from lengths has no directions in space");
  }
  const auto [a, b, c] = mesh.faces()[direction.face];
  const Vec3 p = mesh.positions()[a];
  return direction.weight_rates[1] * (mesh.positions()[b] - p) + direction.weight_rates[2] * (mesh.positions()[c] - p);
}

}  // namespace brushfire
