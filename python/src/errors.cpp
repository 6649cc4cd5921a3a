// brushfire::Error becomes brushfire.BrushfireError, with its code; places and
// sources from arrays, which is where most errors start, and points back into arrays.
#include "bind.h"

#include <brushfire/core/error.h>

#include <exception>
#include <typeinfo>

namespace brushfire::python {
namespace {

// The exception classes live in Python (brushfire._errors), where they can have two bases and be pickled.
void translate(const std::exception_ptr& pointer, void*) {
  try {
    std::rethrow_exception(pointer);
  } catch (const Error& e) {
    const std::string code(name_of(e.code()));
    const nb::object error = nb::module_::import_("brushfire._errors").attr("error_of")(code, e.what());
    PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr());
  } catch (const std::bad_cast&) {
    // The Python files check what they pass on; should one have slipped through, it is told as what it is.
    const nb::object type = nb::module_::import_("brushfire._errors").attr("BrushfireTypeError");
    PyErr_SetString(type.ptr(), "an option is of another type than the call takes");
  }
}

[[noreturn]] void throw_no_such(const char* what, std::int64_t index) {
  throw Error(ErrorCode::IndexOutOfRange, std::string(what) + " " + std::to_string(index) + " does not exist");
}

bool is_vertex(const PlaceArrays& arrays, std::size_t k) {
  if (!arrays.weights) return true;
  const double* w = arrays.weights->data() + 3 * k;
  return w[0] == 0 && w[1] == 0 && w[2] == 0;
}

Place place_from(const PlaceArrays& arrays, std::size_t k) {
  const std::int64_t index = arrays.index.data()[k];
  const bool vertex = is_vertex(arrays, k);
  if (index < 0 || index >= std::int64_t{kNoIndex}) throw_no_such(vertex ? "vertex" : "face", index);
  if (vertex) return static_cast<Index>(index);
  const double* w = arrays.weights->data() + 3 * k;
  return SurfacePoint{static_cast<Index>(index), {w[0], w[1], w[2]}};
}

}  // namespace

Result<std::int32_t> to_numpy_signed(std::vector<Index>&& values) {
  auto* owned = new std::vector<Index>(std::move(values));
  const nb::capsule owner(owned, [](void* p) noexcept { delete static_cast<std::vector<Index>*>(p); });
  return Result<std::int32_t>(owned->data(), {owned->size()}, owner);
}

std::vector<Place> places_from(const PlaceArrays& arrays) {
  if (arrays.weights && arrays.weights->shape(0) != arrays.index.shape(0)) {
    throw Error(ErrorCode::InvalidArgument, "one triple of weights per place is needed");
  }
  std::vector<Place> places;
  places.reserve(arrays.index.shape(0));
  for (std::size_t k = 0; k < arrays.index.shape(0); ++k) places.push_back(place_from(arrays, k));
  return places;
}

std::vector<SurfacePoint> points_from(const Mesh& mesh, const PlaceArrays& arrays) {
  std::vector<SurfacePoint> points;
  for (const Place& place : places_from(arrays)) {
    const SurfacePoint* p = std::get_if<SurfacePoint>(&place);
    points.push_back(p ? *p : vertex_point(mesh, std::get<Index>(place)));
  }
  return points;
}

std::vector<SurfacePoint> targets_from(const Mesh& mesh, const PlaceArrays& arrays) {
  std::vector<SurfacePoint> points;
  for (const Place& place : places_from(arrays)) {
    const SurfacePoint* p = std::get_if<SurfacePoint>(&place);
    points.push_back(p ? *p : target_point(mesh, std::get<Index>(place)));
  }
  return points;
}

SurfacePoint single_point_from(const Mesh& mesh, const PlaceArrays& arrays) {
  const std::vector<SurfacePoint> points = points_from(mesh, arrays);
  if (points.size() != 1) throw Error(ErrorCode::InvalidArgument, "a single point is needed");
  return points.front();
}

std::vector<Source> sources_from(const Mesh& mesh, const PlaceArrays& places, const Vector<double>& offsets) {
  std::vector<Source> sources;
  for (const SurfacePoint& p : points_from(mesh, places)) sources.push_back({p, 0});
  if (offsets.shape(0) != sources.size()) {
    throw Error(ErrorCode::InvalidArgument, std::to_string(sources.size()) + " sources, but " +
                                                std::to_string(offsets.shape(0)) +
                                                " offsets: one per source is needed");
  }
  for (std::size_t k = 0; k < sources.size(); ++k) sources[k].offset = offsets.data()[k];
  return sources;
}

nb::tuple points_to_numpy(std::span<const SurfacePoint> points) {
  std::vector<Index> faces;
  std::vector<double> weights;
  faces.reserve(points.size());
  weights.reserve(3 * points.size());
  for (const SurfacePoint& p : points) {
    faces.push_back(p.face);
    weights.insert(weights.end(), p.weights.begin(), p.weights.end());
  }
  return nb::make_tuple(to_numpy_signed(std::move(faces)), to_numpy(std::move(weights), {points.size(), 3}));
}

nb::tuple path_to_numpy(const SurfacePath& path) {
  const nb::tuple arrays = points_to_numpy(path.points);
  return nb::make_tuple(arrays[0], arrays[1], path.length, path.closed);
}

void bind_errors(nb::module_&) { nb::register_exception_translator(translate); }

}  // namespace brushfire::python
