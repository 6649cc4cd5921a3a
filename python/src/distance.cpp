// _core.Solver: one distance field after the other on one mesh.
#include "options.h"
#include "solver.h"

#include <brushfire/core/error.h>
#include <brushfire/queries/curve_sides.h>

#include <algorithm>
#include <string>

namespace brushfire::python {
namespace {

// (distance, source, error bound): of the targets where there are any, of all vertices otherwise. The bound is None for
// methods that have none.
nb::tuple solve(Solver& solver, const Sources& sources, const std::optional<Vector<std::int64_t>>& target_index,
                const std::optional<Triples<double>>& target_weights, const nb::dict& given, nb::object progress) {
  const Mesh& mesh = solver.mesh();
  Computation computation(std::move(progress));
  DistanceOptions options = options_from(given, computation);
  DistanceField field;
  field = computation.run(mesh.face_count() < kBriefFaces, [&] {
    if (target_index) options.targets = targets_from(mesh, {*target_index, target_weights});
    return solver.with([&](DistanceSolver& s) { return s.distance(sources.list, options); });
  });
  if (target_index) {
    return nb::make_tuple(to_numpy(std::move(field.target_distance)), to_numpy_signed(std::move(field.target_source)),
                          nb::none());
  }
  nb::object bound = nb::none();
  if (!field.error_bound.empty()) bound = nb::cast(to_numpy(std::move(field.error_bound)));
  return nb::make_tuple(to_numpy(std::move(field.distance)), to_numpy_signed(std::move(field.source)), bound);
}

// [vertex_count] negative on the left of curves.
Result<double> signed_field(const Domain& domain, const Sources& sources, const nb::dict& given, nb::object progress) {
  Computation computation(std::move(progress));
  const DistanceOptions options = options_from(given, computation);
  return to_numpy(computation.run(domain.mesh().face_count() < kBriefFaces,
                                  [&] { return signed_distance(domain, sources.list, options); }));
}

// Builds what the first run with these options would build.
void set_up(Solver& solver, const nb::dict& given) {
  Computation computation{nb::none()};
  const DistanceOptions options = options_from(given, computation);
  const nb::gil_scoped_release release;
  solver.with([&](DistanceSolver& s) { s.set_up(options); });
}

nb::tuple method_names() {
  nb::list names;
  for (const Method m : all_methods()) names.append(std::string(name_of(m)));
  return nb::tuple(names);
}

Bound bound_named(std::string_view name) {
  if (name == "estimate") return Bound::Estimate;
  if (name == "lower") return Bound::Lower;
  if (name == "upper") return Bound::Upper;
  throw Error(ErrorCode::InvalidArgument, "unknown bound '" + std::string(name) + "': it is estimate, lower or upper");
}

Precision precision_named(std::string_view name) {
  if (name == "float64") return Precision::Double;
  if (name == "float32") return Precision::Float;
  throw Error(ErrorCode::InvalidArgument, "unknown precision '" + std::string(name) + "': it is float32 or float64");
}

}  // namespace

Error unknown_key(std::string_view name) {
  return {ErrorCode::Internal, "the Python files pass an option '" + std::string(name) + "' that the module has not"};
}

void require_known(const nb::dict& given, std::initializer_list<std::string_view> known) {
  for (const auto [key, value] : given) {
    const auto name = nb::cast<std::string>(key);
    if (std::find(known.begin(), known.end(), name) == known.end()) throw unknown_key(name);
  }
}

DistanceOptions options_from(const nb::dict& given, Computation& computation) {
  DistanceOptions options;
  for (const auto [key, value] : given) {
    const auto name = nb::cast<std::string>(key);
    if (name == "method") {
      options.method = method_named(nb::cast<std::string>(value));
    } else if (name == "bound") {
      options.bound = bound_named(nb::cast<std::string>(value));
    } else if (name == "precision") {
      options.precision = precision_named(nb::cast<std::string>(value));
    } else if (name == "tolerance") {
      options.tolerance = nb::cast<double>(value);
    } else if (name == "threads") {
      options.threads = nb::cast<unsigned>(value);
    } else if (name == "weighting") {
      options.weighting = nb::cast<const SharedWeighting&>(value).value;
    } else if (name == "max_distance") {
      options.max_distance = nb::cast<double>(value);
    } else {
      throw unknown_key(name);
    }
  }
  options.cancel = computation.cancel();
  options.progress = computation.progress();
  return options;
}

void bind_distance(nb::module_& m) {
  m.def("signed_distance", signed_field, nb::arg("domain"), nb::arg("sources"), nb::arg("options"),
        nb::arg("progress").none());
  nb::class_<Solver>(m, "Solver")
      .def(nb::init<const Domain&>(), nb::arg("domain"))
      .def("set_up", set_up, nb::arg("options"))
      .def("solve", solve, nb::arg("sources"), nb::arg("target_index").noconvert().none(),
           nb::arg("target_weights").noconvert().none(), nb::arg("options"), nb::arg("progress").none());
  m.def("method_names", method_names);
  m.attr("default_method") = std::string(name_of(DistanceOptions{}.method));
}

}  // namespace brushfire::python
