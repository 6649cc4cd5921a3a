// A mesh as JavaScript holds it, and how places, sources and options come from there.
#pragma once

#include "reply.h"

#include <brushfire/core/cancel.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/nearest_point.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/distance.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace brushfire::js {

// With what calls on it build once. One call at a time.
class Surface {
 public:
  explicit Surface(Mesh mesh) : mesh_(std::move(mesh)) {}

  const Mesh& mesh() const { return mesh_; }
  DistanceSolver& solver();
  const NearestPointFinder& finder();

 private:
  Mesh mesh_;
  std::optional<DistanceSolver> solver_;
  std::optional<NearestPointFinder> finder_;
};

// An address that JavaScript keeps, as a number.
template <class T>
double handle_of(T* object) {
  return static_cast<double>(reinterpret_cast<std::uintptr_t>(object));
}

// Places as three numbers of weights and an index each: a vertex where all weights are 0 or `weights` is empty, else a
// face. Indices are doubles so that what is no number of a vertex is refused here, in words: Error(IndexOutOfRange).
struct Places {
  std::span<const double> index, weights;

  bool is_vertex(std::size_t k) const;
  Index number(std::size_t k) const;
};
std::vector<SurfacePoint> points_from(const Mesh& mesh, const Places& places);
// The same for what is only arrived at: a vertex in no face is nowhere.
std::vector<SurfacePoint> targets_from(const Mesh& mesh, const Places& places);
// Throws Error(InvalidArgument) unless there is exactly one.
SurfacePoint single_point_from(const Mesh& mesh, const Places& places);
// What sources are besides their places. `sizes`: how many of the places each of them has, 0 of a point and negative of
// a closed curve; empty where all are points.
struct SourceKinds {
  std::span<const double> offsets, sizes;
};
// Throws Error(InvalidArgument) unless there is one offset per source (or none at all), and places for all of them.
std::vector<Source> sources_from(const Mesh& mesh, const Places& places, const SourceKinds& kinds);
// Whole numbers of vertices, faces: Error(IndexOutOfRange) for others.
std::vector<Index> numbers_from(std::span<const double> numbers, const char* what, Index count);

// A run that JavaScript can watch and stop: while it lives, everything listens. Options: `numbers` are the tolerance,
// the greatest distance (NaN: as it is by default), and whether progress is asked for; empty texts are defaults.
class Computation {
 public:
  Computation() : scope_(&token_) {}
  Computation(const Computation&) = delete;
  Computation& operator=(const Computation&) = delete;

  Progress progress();
  DistanceOptions options(std::string_view method, std::string_view bound, std::string_view precision,
                          std::span<const double> numbers);

 private:
  CancelToken token_;
  CancelScope scope_;
};

// [faces, weights], flat.
void add_points(Reply& reply, std::span<const SurfacePoint> points);

}  // namespace brushfire::js
