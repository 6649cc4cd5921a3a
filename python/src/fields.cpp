// What is made of a field: isolines, gradients, the way down, comparison with another field.
#include "options.h"
#include "solver.h"

#include <brushfire/core/error.h>
#include <brushfire/queries/compare.h>
#include <brushfire/queries/curved_isolines.h>
#include <brushfire/queries/gradient.h>
#include <brushfire/queries/isolines.h>
#include <brushfire/queries/vertex_measures.h>

#include <span>

namespace brushfire::python {
namespace {

std::span<const double> span_of(const Vector<double>& values) { return {values.data(), values.shape(0)}; }

// (level, level index, path) of each.
nb::list to_list(std::span<const Isoline> lines) {
  nb::list list;
  for (const Isoline& l : lines) list.append(nb::make_tuple(l.level, l.level_index, path_to_numpy(l.line)));
  return list;
}

nb::list linear(const Domain& domain, const Vector<double>& values, const Vector<double>& levels) {
  // Copies: nobody may change them while they are looked at twice.
  const std::vector<double> field(values.data(), values.data() + values.shape(0));
  const std::vector<double> wanted(levels.data(), levels.data() + levels.shape(0));
  return to_list(listening(false, [&] { return isolines(domain, field, wanted); }));
}

// Levels that follow from the field, which is known only here: every `every` units, or `count` of them, or those given.
nb::list curved(Solver& solver, const Sources& sources, const nb::dict& given,
                const std::optional<Vector<double>>& levels, std::optional<double> every, Index count,
                double chord_error, nb::object progress) {
  Computation computation(std::move(progress));
  DistanceOptions options = options_from(given, computation);
  options.keep_windows = true;
  return to_list(computation.run(false, [&] {
    const DistanceField field = solver.with([&](DistanceSolver& s) { return s.distance(sources.list, options); });
    if (!field.windows) {
      throw Error(ErrorCode::InvalidArgument, "curved isolines need method exact or windows");
    }
    std::vector<double> chosen;
    if (levels) {
      chosen.assign(levels->data(), levels->data() + levels->shape(0));
    } else {
      chosen = every ? levels_every(field.distance, *every) : levels_between(field.distance, count);
    }
    std::vector<Isoline> lines = curved_isolines(*field.windows, chosen, chord_error);
    for (Isoline& l : lines) solver.domain().to_mesh(l.line.points);
    return lines;
  }));
}

Result<double> gradients(const Domain& domain, const Vector<double>& values, bool on_vertices) {
  const std::vector<Vec3> found = listening(false, [&] {
    return on_vertices ? vertex_gradients(domain, span_of(values)) : face_gradients(domain, span_of(values));
  });
  std::vector<double> flat;
  flat.reserve(3 * found.size());
  for (const Vec3& g : found) flat.insert(flat.end(), {g.x, g.y, g.z});
  return to_numpy(std::move(flat), {found.size(), 3});
}

// (face, weight rates, slope, vector), or None where nothing falls; the vector is None without positions.
nb::object descent(const Domain& domain, const Vector<double>& values, const Vector<std::int64_t>& index,
                   const std::optional<Triples<double>>& weights) {
  const Mesh& mesh = domain.mesh();
  const SurfaceDirection d = steepest_descent(domain, span_of(values), single_point_from(mesh, {index, weights}));
  if (d.face == kNoIndex) return nb::none();
  nb::object vector = nb::none();
  if (mesh.has_positions()) {
    const Vec3 v = in_space(mesh, d);
    vector = nb::cast(to_numpy(std::vector<double>{v.x, v.y, v.z}));
  }
  return nb::make_tuple(d.face, nb::make_tuple(d.weight_rates[0], d.weight_rates[1], d.weight_rates[2]), d.slope,
                        vector);
}

nb::dict to_dict(const ErrorMeasure& m) {
  nb::dict d;
  d["mean"] = m.mean;
  d["root_mean_square"] = m.root_mean_square;
  d["max"] = m.max;
  d["max_vertex"] = m.max_vertex == kNoIndex ? -1 : static_cast<std::int64_t>(m.max_vertex);
  return d;
}

nb::dict compare(const Vector<double>& field, const Vector<double>& reference,
                 const std::optional<Vector<double>>& weights) {
  const FieldComparison c =
      compare_fields(span_of(field), span_of(reference), weights ? span_of(*weights) : std::span<const double>{});
  nb::dict d;
  d["compared"] = c.compared;
  d["zero_reference"] = c.zero_reference;
  d["missing"] = c.missing;
  d["surplus"] = c.surplus;
  d["unreached_in_both"] = c.unreached_in_both;
  d["absolute"] = to_dict(c.absolute);
  d["relative"] = to_dict(c.relative);
  d["mean_signed_relative"] = c.mean_signed_relative;
  d["max_at_zero_reference"] = c.max_at_zero_reference;
  d["weighted_absolute"] = c.has_weights ? nb::object(to_dict(c.weighted_absolute)) : nb::object(nb::none());
  d["weighted_relative"] = c.has_weights ? nb::object(to_dict(c.weighted_relative)) : nb::object(nb::none());
  return d;
}

}  // namespace

void bind_fields(nb::module_& m) {
  m.def("isolines", linear, nb::arg("domain"), nb::arg("values").noconvert(), nb::arg("levels").noconvert());
  m.def("curved_isolines", curved, nb::arg("solver"), nb::arg("sources"), nb::arg("options"),
        nb::arg("levels").noconvert().none(), nb::arg("every").none(), nb::arg("count"), nb::arg("chord_error"),
        nb::arg("progress").none());
  m.def(
      "levels_every",
      [](const Vector<double>& values, double step) { return to_numpy(levels_every(span_of(values), step)); },
      nb::arg("values").noconvert(), nb::arg("step"));
  m.def(
      "levels_between",
      [](const Vector<double>& values, Index count) { return to_numpy(levels_between(span_of(values), count)); },
      nb::arg("values").noconvert(), nb::arg("count"));
  m.def("gradients", gradients, nb::arg("domain"), nb::arg("values").noconvert(), nb::arg("on_vertices"));
  m.def("steepest_descent", descent, nb::arg("domain"), nb::arg("values").noconvert(), nb::arg("index").noconvert(),
        nb::arg("weights").noconvert().none());
  m.def("compare_fields", compare, nb::arg("field").noconvert(), nb::arg("reference").noconvert(),
        nb::arg("weights").noconvert().none());
  m.def("vertex_areas", [](const Domain& domain) { return to_numpy(vertex_areas(domain)); }, nb::arg("domain"));
}

}  // namespace brushfire::python
