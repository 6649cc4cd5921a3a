// Places, sources and options out of arrays.
#include "surface.h"

#include <brushfire/core/error.h>

#include <array>
#include <cmath>
#include <cstdio>

namespace brushfire::js {

// Shares done, in [0, 1]; what it returns says whether to go on (0) or to stop.
extern "C" __attribute__((import_module("brushfire"), import_name("progress"))) int brushfire_progress(double share);

namespace {

[[noreturn]] void throw_no_such(const char* what, double number, const std::string& rest) {
  std::array<char, 40> text;
  std::snprintf(text.data(), text.size(), "%.17g", number);
  throw Error(ErrorCode::IndexOutOfRange, std::string(what) + " " + text.data() + " does not exist" + rest);
}

bool is_number_below(double number, double count) {
  return number >= 0 && number < count && number == std::floor(number);
}

void check_weights(const Places& places) {
  if (places.weights.empty() || places.weights.size() == 3 * places.index.size()) return;
  throw Error(ErrorCode::InvalidArgument, "one triple of weights per place is needed: there are " +
                                              std::to_string(places.weights.size()) + " weights for " +
                                              std::to_string(places.index.size()) + " places");
}

template <class OfVertex>
std::vector<SurfacePoint> points_by(const Places& places, const OfVertex& of_vertex) {
  check_weights(places);
  std::vector<SurfacePoint> points;
  points.reserve(places.index.size());
  for (std::size_t k = 0; k < places.index.size(); ++k) {
    if (places.is_vertex(k)) {
      points.push_back(of_vertex(places.number(k)));
    } else {
      const double* const w = places.weights.data() + 3 * k;
      points.push_back({places.number(k), {w[0], w[1], w[2]}});
    }
  }
  return points;
}

}  // namespace

DistanceSolver& Surface::solver() {
  if (!solver_) solver_.emplace(mesh_);
  return *solver_;
}

const NearestPointFinder& Surface::finder() {
  if (!finder_) finder_.emplace(mesh_);
  return *finder_;
}

bool Places::is_vertex(std::size_t k) const {
  return weights.empty() || (weights[3 * k] == 0 && weights[3 * k + 1] == 0 && weights[3 * k + 2] == 0);
}

Index Places::number(std::size_t k) const {
  if (!is_number_below(index[k], kNoIndex)) throw_no_such(is_vertex(k) ? "vertex" : "face", index[k], "");
  return static_cast<Index>(index[k]);
}

std::vector<SurfacePoint> points_from(const Mesh& mesh, const Places& places) {
  return points_by(places, [&](Index v) { return vertex_point(mesh, v); });
}

std::vector<SurfacePoint> targets_from(const Mesh& mesh, const Places& places) {
  return points_by(places, [&](Index v) { return target_point(mesh, v); });
}

SurfacePoint single_point_from(const Mesh& mesh, const Places& places) {
  if (places.index.size() == 1) return points_from(mesh, places).front();
  throw Error(ErrorCode::InvalidArgument, "one place is needed, not " + std::to_string(places.index.size()));
}

std::vector<Source> sources_from(const Mesh& mesh, const Places& places, const SourceKinds& kinds) {
  const std::vector<SurfacePoint> points = points_from(mesh, places);
  const std::size_t count = kinds.sizes.empty() ? points.size() : kinds.sizes.size();
  if (!kinds.offsets.empty() && kinds.offsets.size() != count) {
    throw Error(ErrorCode::InvalidArgument,
                std::to_string(kinds.offsets.size()) + " offsets for " + std::to_string(count) + " sources");
  }
  std::vector<Source> sources;
  sources.reserve(count);
  std::span<const SurfacePoint> left = points;
  for (std::size_t k = 0; k < count; ++k) {
    const double size = kinds.sizes.empty() ? 0 : kinds.sizes[k];
    const std::size_t taken = size == 0 ? 1 : static_cast<std::size_t>(std::abs(size));
    if (taken > left.size())
      throw Error(ErrorCode::InvalidArgument, "sources: there are fewer places than the curves have");
    const double offset = kinds.offsets.empty() ? 0 : kinds.offsets[k];
    if (size == 0) {
      sources.push_back({left.front(), offset});
    } else {
      sources.push_back(
          source_along({{left.begin(), left.begin() + static_cast<std::ptrdiff_t>(taken)}, size < 0}, offset));
    }
    left = left.subspan(taken);
  }
  return sources;
}

std::vector<Index> numbers_from(std::span<const double> numbers, const char* what, Index count) {
  std::vector<Index> result;
  result.reserve(numbers.size());
  for (const double n : numbers) {
    if (!is_number_below(n, count)) throw_no_such(what, n, ": the mesh has " + std::to_string(count));
    result.push_back(static_cast<Index>(n));
  }
  return result;
}

Progress Computation::progress() {
  return [this](double share) {
    if (brushfire_progress(share) != 0) token_.cancel();
  };
}

DistanceOptions Computation::options(std::string_view method, std::string_view bound, std::string_view precision,
                                     std::span<const double> numbers) {
  DistanceOptions o;
  if (!method.empty()) o.method = method_named(method);
  if (bound == "lower") {
    o.bound = Bound::Lower;
  } else if (bound == "upper") {
    o.bound = Bound::Upper;
  } else if (!bound.empty() && bound != "estimate") {
    throw Error(ErrorCode::InvalidArgument,
                "unknown bound '" + std::string(bound) + "': it is estimate, lower or upper");
  }
  if (precision == "float64") {
    o.precision = Precision::Double;
  } else if (!precision.empty() && precision != "float32") {
    throw Error(ErrorCode::InvalidArgument,
                "unknown precision '" + std::string(precision) + "': it is float32 or float64");
  }
  if (!std::isnan(numbers[0])) o.tolerance = numbers[0];
  if (!std::isnan(numbers[1])) o.max_distance = numbers[1];
  if (numbers[2] != 0) o.progress = progress();
  o.cancel = &token_;
  return o;
}

void add_points(Reply& reply, std::span<const SurfacePoint> points) {
  std::vector<std::uint32_t> faces;
  std::vector<double> weights;
  faces.reserve(points.size());
  weights.reserve(3 * points.size());
  for (const SurfacePoint& p : points) {
    faces.push_back(p.face);
    weights.insert(weights.end(), p.weights.begin(), p.weights.end());
  }
  reply.add(std::move(faces));
  reply.add(std::move(weights));
}

}  // namespace brushfire::js
