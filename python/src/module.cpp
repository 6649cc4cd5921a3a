// brushfire._core: what of the C++ library needs compiled code; the package's Python files turn it into the public API.
#include "bind.h"

#include <brushfire/version.h>

NB_MODULE(_core, m) {
  m.attr("version") = brushfire::kVersion;
  brushfire::python::bind_errors(m);
  brushfire::python::bind_mesh(m);
  brushfire::python::bind_sources(m);
  brushfire::python::bind_distance(m);
  brushfire::python::bind_matrix(m);
  brushfire::python::bind_curves(m);
  brushfire::python::bind_fields(m);
  brushfire::python::bind_certify(m);
  brushfire::python::bind_regions(m);
  brushfire::python::bind_cells(m);
  brushfire::python::bind_weighted(m);
  brushfire::python::bind_replanner(m);
  brushfire::python::bind_heat(m);
  brushfire::python::bind_figure(m);
  brushfire::python::bind_files(m);
  brushfire::python::bind_derivatives(m);
  brushfire::python::bind_flatten(m);
}
