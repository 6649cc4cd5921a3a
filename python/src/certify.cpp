// _core.certify: what can be proven about a field.
#include "options.h"

#include <brushfire/queries/certify.h>

namespace brushfire::python {
namespace {

nb::dict certificate(const Domain& domain, const Vector<double>& field, const Sources& sources, double tolerance,
                     double within, double max_distance, unsigned threads, nb::object progress) {
  Computation computation(std::move(progress));
  CertifyOptions options;
  options.tolerance = tolerance;
  options.within = within;
  options.max_distance = max_distance;
  options.threads = threads;
  options.cancel = computation.cancel();
  options.progress = computation.progress();
  Certificate c = computation.run(domain.mesh().face_count() < kBriefFaces, [&] {
    return certify(domain, {field.data(), field.shape(0)}, sources.list, options);
  });
  nb::dict d;
  d["proven_wrong"] = c.proven_wrong();
  d["possible"] = c.possible;
  d["too_short"] = c.too_short;
  d["too_long"] = c.too_long;
  d["not_reachable"] = c.not_reachable;
  d["not_reached"] = c.not_reached;
  d["not_a_number"] = c.not_a_number;
  d["least_within"] = c.least_within;
  d["worst_vertex"] = c.worst_vertex == kNoIndex ? -1 : static_cast<std::int64_t>(c.worst_vertex);
  d["max_gap"] = c.max_gap;
  std::vector<std::int8_t> finding;
  for (const Finding f : c.finding) finding.push_back(static_cast<std::int8_t>(f));
  d["lower"] = to_numpy(std::move(c.lower));
  d["upper"] = to_numpy(std::move(c.upper));
  d["proven_error"] = to_numpy(std::move(c.proven_error));
  d["finding"] = to_numpy(std::move(finding));
  return d;
}

nb::tuple finding_names() {
  nb::list names;
  for (std::uint8_t f = 0; f <= static_cast<std::uint8_t>(Finding::NotANumber); ++f) {
    names.append(std::string(name_of(static_cast<Finding>(f))));
  }
  return nb::tuple(names);
}

}  // namespace

void bind_certify(nb::module_& m) {
  m.def("certify", certificate, nb::arg("domain"), nb::arg("field").noconvert(), nb::arg("sources"),
        nb::arg("tolerance"), nb::arg("within"), nb::arg("max_distance"), nb::arg("threads"),
        nb::arg("progress").none());
  m.def("finding_names", finding_names);
}

}  // namespace brushfire::python
