// Fields that keep their paths, and derivatives of them.
#include "bind.h"
#include "interrupt.h"
#include "options.h"
#include "solver.h"

#include <brushfire/queries/distance_gradient.h>

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

}  // namespace

void bind_derivatives(nb::module_& m) {
  nb::class_<TracedField>(m, "TracedField")
      .def("gradient", gradient, nb::arg("upstream").noconvert())
      .def("one_sided", one_sided, nb::arg("tie"));
  m.def("traced_field", traced_field, nb::arg("solver"), nb::arg("index").noconvert(),
        nb::arg("weights").noconvert().none(), nb::arg("offsets").noconvert(), nb::arg("options"),
        nb::arg("progress").none());
}

}  // namespace brushfire::python
