// Comparison of two fields.
#include <brushfire/queries/compare.h>

#include <brushfire/core/error.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace brushfire {
namespace {

// Collects errors with their weights; scaled by the largest so far, so that squares neither overflow nor vanish.
class Accumulator {
 public:
  void add(Index vertex, double error, double weight) {
    if (error > measure_.max || measure_.max_vertex == kNoIndex) {
      if (measure_.max > 0) squares_ *= (measure_.max / error) * (measure_.max / error);
      measure_.max = error;
      measure_.max_vertex = vertex;
    }
    if (error > 0) {
      const double share = error == measure_.max ? 1 : error / measure_.max;
      squares_ += weight * share * share;
    }
    sum_ += weight * error;
    weights_ += weight;
  }

  ErrorMeasure result() const {
    ErrorMeasure m = measure_;
    if (weights_ > 0) {
      m.mean = sum_ / weights_;
      m.root_mean_square = m.max * std::sqrt(squares_ / weights_);
    }
    return m;
  }

 private:
  ErrorMeasure measure_;
  double sum_ = 0, squares_ = 0, weights_ = 0;
};

void check_value(double value, std::size_t vertex, const char* which) {
  if (std::isnan(value) || value == -kInfinity) {
    throw Error(ErrorCode::InvalidArgument, "vertex " + std::to_string(vertex) + " reads " + std::to_string(value) +
                                                " in the " + which + ": a distance is finite or +inf");
  }
}

void check(std::span<const double> field, std::span<const double> reference, std::span<const double> weights) {
  if (field.size() != reference.size()) {
    throw Error(ErrorCode::InvalidArgument, "the field has " + std::to_string(field.size()) +
                                                " values, the reference " + std::to_string(reference.size()));
  }
  if (!weights.empty() && weights.size() != field.size()) {
    throw Error(ErrorCode::InvalidArgument,
                std::to_string(weights.size()) + " weights for " + std::to_string(field.size()) + " values");
  }
  for (std::size_t v = 0; v < field.size(); ++v) {
    check_value(field[v], v, "field");
    check_value(reference[v], v, "reference");
    if (!weights.empty() && !(weights[v] >= 0 && std::isfinite(weights[v]))) {
      throw Error(ErrorCode::InvalidArgument, "the weight of vertex " + std::to_string(v) + " is not finite and >= 0");
    }
  }
}

}  // namespace

FieldComparison compare_fields(std::span<const double> field, std::span<const double> reference,
                               std::span<const double> vertex_weights) {
  check(field, reference, vertex_weights);
  FieldComparison result;
  result.has_weights = !vertex_weights.empty();
  Accumulator absolute, relative, weighted_absolute, weighted_relative;
  double signed_sum = 0;
  for (Index v = 0; v < field.size(); ++v) {
    const double a = field[v], b = reference[v];
    if (b == kInfinity) {
      ++(a == kInfinity ? result.unreached_in_both : result.surplus);
    } else if (a == kInfinity) {
      ++result.missing;
    } else if (b == 0) {
      ++result.zero_reference;
      result.max_at_zero_reference = std::max(result.max_at_zero_reference, std::abs(a));
    } else {
      ++result.compared;
      const double error = std::abs(a - b), share = error / std::abs(b);
      absolute.add(v, error, 1);
      relative.add(v, share, 1);
      signed_sum += a < b ? -share : share;
      if (result.has_weights) {
        weighted_absolute.add(v, error, vertex_weights[v]);
        weighted_relative.add(v, share, vertex_weights[v]);
      }
    }
  }
  result.absolute = absolute.result();
  result.relative = relative.result();
  result.weighted_absolute = weighted_absolute.result();
  result.weighted_relative = weighted_relative.result();
  if (result.compared > 0) result.mean_signed_relative = signed_sum / result.compared;
  return result;
}

std::vector<double> vertex_areas(const Mesh& mesh) {
  std::vector<double> areas(mesh.vertex_count(), 0);
  const double unit = mesh.unit();
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (!mesh.is_face_usable(f)) continue;
    const double third = mesh.double_areas()[f] / 6 * unit * unit;
    for (const Index v : mesh.faces()[f]) areas[v] += third;
  }
  return areas;
}

}  // namespace brushfire
