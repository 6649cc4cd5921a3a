// Fields that keep their paths, and derivatives of them.
#include "bind.h"
#include "interrupt.h"
#include "options.h"
#include "solver.h"

#include <brushfire/queries/distance_gradient.h>
#include <brushfire/queries/path_length.h>

namespace brushfire::python {
namespace {

struct TracedField {
  Domain domain;
  std::vector<Source> sources;
  DistanceField field;
};

std::vector<double> flat(const std::vector<Vec3>& vectors) {
  std::vector<double> numbers;
  numbers.reserve(3 * vectors.size());
  for (const Vec3& v : vectors) numbers.insert(numbers.end(), {v.x, v.y, v.z});
  return numbers;
}

// (distance, source, what gradients are taken of).
nb::tuple traced_field(Solver& solver, const Vector<std::int64_t>& index, const std::optional<Triples<double>>& weights,
                       const Vector<double>& offsets, const nb::dict& given, nb::object progress) {
  Computation computation(std::move(progress));
  DistanceOptions options = options_from(given, computation);
  options.method = Method::Exact;
  options.keep_paths = true;
  TracedField traced = computation.run(false, [&] {
    TracedField result{solver.domain(), sources_from(solver.mesh(), {index, weights}, offsets), {}};
    solver.with([&](DistanceSolver& s) { s.distance(result.sources, options, result.field); });
    return result;
  });
  std::vector<double> distance = traced.field.distance;
  std::vector<Index> source = traced.field.source;
  return nb::make_tuple(to_numpy(std::move(distance)), to_numpy_signed(std::move(source)), nb::cast(std::move(traced)));
}

// (vertices, places, offsets).
nb::tuple gradient(const TracedField& traced, const Vector<double>& upstream) {
  DistanceGradient found = listening(false, [&] {
    return distance_gradient_wrt_vertices(traced.domain, traced.sources, traced.field,
                                          std::span(upstream.data(), upstream.shape(0)));
  });
  return nb::make_tuple(to_numpy(flat(found.vertices), {found.vertices.size(), 3}),
                        to_numpy(flat(found.places), {found.places.size(), 3}), to_numpy(std::move(found.offsets)));
}

Result<std::uint8_t> one_sided(const TracedField& traced, double tie) {
  return to_numpy(listening(false, [&] { return one_sided_vertices(traced.domain, traced.field, tie); }));
}

Index vertex_of(const TracedField& traced, std::int64_t number) {
  const Index count = traced.domain.mesh().vertex_count();
  if (number < 0 || number >= static_cast<std::int64_t>(count)) {
    throw Error(ErrorCode::IndexOutOfRange,
                "target " + std::to_string(number) + ": the mesh has " + std::to_string(count) + " vertices");
  }
  return static_cast<Index>(number);
}

PathLength length_to(const TracedField& traced, std::int64_t target) {
  return path_length(traced.domain, traced.field, vertex_of(traced, target));
}

Result<double> hessian_times(const PathLength& length, const Triples<double>& moves) {
  std::vector<Vec3> given(moves.shape(0));
  for (std::size_t i = 0; i < given.size(); ++i) given[i] = {moves(i, 0), moves(i, 1), moves(i, 2)};
  return to_numpy(flat(length.hessian_times(given)), {given.size(), 3});
}

Result<double> hessian(const PathLength& length) {
  const std::size_t size = 3 * length.vertices().size();
  return to_numpy(listening(false, [&] { return length.hessian(); }), {size, size});
}

Result<std::int32_t> vertices_of(const PathLength& length) {
  return to_numpy_signed({length.vertices().begin(), length.vertices().end()});
}

Result<double> gradient_of(const PathLength& length) {
  return to_numpy(flat({length.gradient().begin(), length.gradient().end()}), {length.gradient().size(), 3});
}

}  // namespace

void bind_derivatives(nb::module_& m) {
  nb::class_<TracedField>(m, "TracedField")
      .def("gradient", gradient, nb::arg("upstream").noconvert())
      .def("one_sided", one_sided, nb::arg("tie"))
      .def("path_length", length_to, nb::arg("target"));
  nb::class_<PathLength>(m, "PathLength")
      .def("length", &PathLength::length)
      .def("vertices", vertices_of)
      .def("gradient", gradient_of)
      .def("is_one_sided", &PathLength::is_one_sided)
      .def("hessian_times", hessian_times, nb::arg("moves").noconvert())
      .def("hessian", hessian);
  m.def("traced_field", traced_field, nb::arg("solver"), nb::arg("index").noconvert(),
        nb::arg("weights").noconvert().none(), nb::arg("offsets").noconvert(), nb::arg("options"),
        nb::arg("progress").none());
}

}  // namespace brushfire::python
