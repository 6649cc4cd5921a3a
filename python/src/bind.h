// What the binding files share: array types, places and sources from arrays, results that own their memory.
#pragma once

#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_path.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/queries/distance_matrix.h>
#include <brushfire/solvers/distance.h>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace brushfire::python {

namespace nb = nanobind;

void bind_errors(nb::module_& m);
void bind_mesh(nb::module_& m);
void bind_sources(nb::module_& m);
void bind_distance(nb::module_& m);
void bind_matrix(nb::module_& m);
void bind_curves(nb::module_& m);
void bind_fields(nb::module_& m);
void bind_certify(nb::module_& m);
void bind_cells(nb::module_& m);
void bind_weighted(nb::module_& m);
void bind_replanner(nb::module_& m);
void bind_regions(nb::module_& m);
void bind_heat(nb::module_& m);
void bind_figure(nb::module_& m);
void bind_files(nb::module_& m);
void bind_derivatives(nb::module_& m);
void bind_flatten(nb::module_& m);

// Arrays as the Python files hand them over: converted already, C order, exactly these types.
template <class T>
using Vector = nb::ndarray<const T, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
template <class T>
using Triples = nb::ndarray<const T, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

template <class T>
using Result = nb::ndarray<nb::numpy, T>;

// A numpy array that owns the values, without copying them.
template <class T>
Result<T> to_numpy(std::vector<T>&& values, std::initializer_list<std::size_t> shape) {
  auto* owned = new std::vector<T>(std::move(values));
  const nb::capsule owner(owned, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return Result<T>(owned->data(), shape, owner);
}
template <class T>
Result<T> to_numpy(std::vector<T>&& values) {
  const std::size_t size = values.size();
  return to_numpy(std::move(values), {size});
}
// Vertex and source numbers: int32, where "none" reads -1.
Result<std::int32_t> to_numpy_signed(std::vector<Index>&& values);

// Places on the mesh: index[k] is a vertex where the weights of k are all 0 (or there are none), else a face.
struct PlaceArrays {
  Vector<std::int64_t> index;
  std::optional<Triples<double>> weights;
};
std::vector<Place> places_from(const PlaceArrays& arrays);
std::vector<SurfacePoint> points_from(const Mesh& mesh, const PlaceArrays& arrays);
// The same for what is only arrived at: a vertex in no face is nowhere, and nothing reaches it.
std::vector<SurfacePoint> targets_from(const Mesh& mesh, const PlaceArrays& arrays);
// Throws Error(InvalidArgument) unless there is exactly one.
SurfacePoint single_point_from(const Mesh& mesh, const PlaceArrays& arrays);
// Throws Error(InvalidArgument) unless there is one offset per source.
std::vector<Source> sources_from(const Mesh& mesh, const PlaceArrays& places, const Vector<double>& offsets);
// _core.Sources: the points and curves of one mesh that distances start from.
struct Sources {
  std::vector<Source> list;
};

// _core.Weighting: what going costs, as options take it.
struct SharedWeighting {
  std::shared_ptr<const Weighting> value;
};

// (face, weights): int32 [points], float64 [points, 3].
nb::tuple points_to_numpy(std::span<const SurfacePoint> points);
// (face, weights, length, closed).
nb::tuple path_to_numpy(const SurfacePath& path);
// Of paths to several targets: at which source each begins, and what `arrays_of` makes of each.
template <class Path, class ArraysOf>
nb::tuple paths_to_numpy(const std::vector<Path>& paths, ArraysOf&& arrays_of) {
  nb::list list;
  std::vector<Index> nearest;
  for (const Path& path : paths) {
    list.append(arrays_of(path));
    nearest.push_back(path.source);
  }
  return nb::make_tuple(to_numpy_signed(std::move(nearest)), list);
}

}  // namespace brushfire::python
