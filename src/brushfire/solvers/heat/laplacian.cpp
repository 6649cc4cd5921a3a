// The Laplacian in the caller's terms.
#include <brushfire/solvers/laplacian.h>

#include <brushfire/solvers/heat/operators.h>
#include <brushfire/solvers/heat/scales.h>
#include <brushfire/solvers/heat/triangulation.h>

#include <utility>

namespace brushfire {

Laplacian laplacian_of(const Domain& domain, bool delaunay) {
  const Mesh& mesh = domain.open();
  heat::Triangulation t = heat::triangulation_of(mesh, heat::Cover::AsItIs);
  heat::mollify(t, detail::components_of(mesh));
  if (delaunay) heat::flip_to_delaunay(t);
  heat::Operators o = heat::operators_of(t);
  Laplacian l;
  l.mass = std::move(o.mass);
  for (double& m : l.mass) m = m * mesh.unit() * mesh.unit();
  const heat::Pattern& p = o.pattern;
  std::vector<std::vector<std::pair<Index, double>>> columns(l.mass.size());
  for (int c = 0; c < p.columns(); ++c) {
    for (int e = p.start[c]; e < p.start[c + 1]; ++e) {
      columns[c].emplace_back(static_cast<Index>(p.row[e]), o.laplacian[e]);
      if (p.row[e] != c) columns[p.row[e]].emplace_back(static_cast<Index>(c), o.laplacian[e]);
    }
  }
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (const auto& [row, value] : columns[c]) {
      l.row.push_back(row);
      l.column.push_back(static_cast<Index>(c));
      l.value.push_back(value);
    }
  }
  return l;
}

}  // namespace brushfire
