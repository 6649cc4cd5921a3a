// _core.Sources: where distances start from, points and curves.
#include "bind.h"

#include <brushfire/core/error.h>
#include <brushfire/queries/curve_sources.h>

#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <tuple>

namespace brushfire::python {
namespace {

using Indices = Vector<std::int64_t>;
using OptionalWeights = std::optional<Triples<double>>;
// A curve: its position in the list of sources; its places, and where in them its pieces begin; whether these are
// closed; an offset for each place, or None; faces inside.
using CurveArrays =
    std::tuple<std::size_t, Indices, OptionalWeights, Indices, bool, std::optional<Vector<double>>, Indices>;

std::vector<Index> face_numbers(const Indices& faces) {
  std::vector<Index> numbers;
  for (std::size_t i = 0; i < faces.shape(0); ++i) {
    const std::int64_t f = faces.data()[i];
    numbers.push_back(f >= 0 && f < std::int64_t{kNoIndex} ? static_cast<Index>(f) : kNoIndex);
  }
  return numbers;
}

CurveSource curve_from(const Mesh& mesh, const CurveArrays& arrays) {
  const auto& [position, index, weights, starts, closed, offsets, inside] = arrays;
  const std::vector<SurfacePoint> places = points_from(mesh, {index, weights});
  if (offsets && offsets->shape(0) != places.size()) {
    throw Error(ErrorCode::InvalidArgument, std::to_string(offsets->shape(0)) + " offsets for a curve of " +
                                                std::to_string(places.size()) + " places");
  }
  CurveSource curve;
  curve.closed = closed;
  for (std::size_t i = 0, piece = 0; i < places.size(); ++i) {
    if (piece < starts.shape(0) && starts.data()[piece] == static_cast<std::int64_t>(i)) {
      ++piece;
      if (i > 0) {
        curve.places.emplace_back();
        if (offsets) curve.offsets.push_back(0);
      }
    }
    curve.places.push_back(places[i]);
    if (offsets) curve.offsets.push_back(offsets->data()[i]);
  }
  curve.inside = face_numbers(inside);
  return curve;
}

// As bf.Curve keeps it: faces, weights, starts of pieces, faces inside.
nb::tuple curve_to_numpy(const CurveSource& curve) {
  std::vector<SurfacePoint> places;
  std::vector<std::int64_t> starts{0};
  for (const SurfacePoint& p : curve.places) {
    if (p.is_nowhere()) {
      starts.push_back(static_cast<std::int64_t>(places.size()));
    } else {
      places.push_back(p);
    }
  }
  const nb::tuple arrays = points_to_numpy(places);
  return nb::make_tuple(arrays[0], arrays[1], to_numpy(std::move(starts)),
                        to_numpy(std::vector<std::int64_t>(curve.inside.begin(), curve.inside.end())));
}

// The points, and between them the curves, each at its position in the list of all; an offset for each of all.
Sources sources(const Mesh& mesh, const Indices& index, const OptionalWeights& weights, const Vector<double>& offsets,
                const std::vector<CurveArrays>& curves) {
  Sources all;
  for (const SurfacePoint& p : points_from(mesh, {index, weights})) all.list.push_back({p, 0});
  for (const CurveArrays& arrays : curves) {
    const std::size_t position = std::min(std::get<0>(arrays), all.list.size());
    all.list.insert(all.list.begin() + static_cast<std::ptrdiff_t>(position), source_along(curve_from(mesh, arrays)));
  }
  if (offsets.shape(0) != all.list.size()) {
    throw Error(ErrorCode::InvalidArgument, std::to_string(all.list.size()) + " sources, but " +
                                                std::to_string(offsets.shape(0)) +
                                                " offsets: one per source is needed");
  }
  for (std::size_t k = 0; k < all.list.size(); ++k) all.list[k].offset = offsets.data()[k];
  return all;
}

nb::tuple region_of_vertex_mask(const Mesh& mesh, const Vector<std::uint8_t>& vertices) {
  return curve_to_numpy(region_of_vertices(mesh, {vertices.data(), vertices.shape(0)}));
}

nb::tuple region_of_face_numbers(const Mesh& mesh, const Indices& faces) {
  return curve_to_numpy(region_of_faces(mesh, face_numbers(faces)));
}

}  // namespace

void bind_sources(nb::module_& m) {
  nb::class_<Sources>(m, "Sources");
  m.def("make_sources", sources, nb::arg("mesh"), nb::arg("index").noconvert(), nb::arg("weights").noconvert().none(),
        nb::arg("offsets").noconvert(), nb::arg("curves"));
  m.def("region_of_vertices", region_of_vertex_mask, nb::arg("mesh"), nb::arg("vertices").noconvert());
  m.def("region_of_faces", region_of_face_numbers, nb::arg("mesh"), nb::arg("faces").noconvert());
}

}  // namespace brushfire::python
