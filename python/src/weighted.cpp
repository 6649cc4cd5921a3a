// _core.WeightedSolver: costs and cheapest paths where not all places are equally easy to cross.
#include "weighted.h"

#include "interrupt.h"

#include <brushfire/core/error.h>
#include <brushfire/io/write_grid.h>
#include <brushfire/mesh/terrain.h>
#include <brushfire/queries/isochrones.h>

#include <array>
#include <new>

namespace brushfire::python {
namespace {

// A name, or slopes and the paces there; up to the steepest, in tacks.
std::optional<SlopePace> pace_from(const std::string& name, const std::optional<Vector<double>>& slopes,
                                   const std::optional<Vector<double>>& paces, double steepest, bool tacking) {
  std::optional<SlopePace> pace;
  if (slopes && paces) {
    pace = SlopePace::table({slopes->data(), slopes->shape(0)}, {paces->data(), paces->shape(0)});
  } else if (name == "tobler") {
    pace = SlopePace::tobler();
  } else if (name == "naismith") {
    pace = SlopePace::naismith();
  } else if (name == "energy") {
    pace = SlopePace::energy();
  } else if (!name.empty()) {
    throw Error(ErrorCode::InvalidArgument,
                "unknown slope '" + name + "': it is tobler, naismith, energy, or (slopes, paces)");
  }
  if (pace && steepest < kInfinity) pace = pace->up_to(steepest);
  if (pace && tacking) pace = pace->tacking();
  return pace;
}

Weights faces_and_edges(const Domain& domain, const std::optional<Vector<double>>& face,
                        const Vector<std::int64_t>& edge_vertices, const Vector<double>& along,
                        const Vector<double>& crossing) {
  Weights weights;
  if (face) weights.face.assign(face->data(), face->data() + face->shape(0));
  const std::int64_t count = domain.mesh().vertex_count();
  for (std::size_t k = 0; k < along.shape(0); ++k) {
    EdgeCost& edge = weights.edges.emplace_back();
    for (const std::size_t end : {0U, 1U}) {
      const std::int64_t v = edge_vertices.data()[2 * k + end];
      if (v < 0 || v >= count) {
        throw Error(ErrorCode::IndexOutOfRange, "edge_weights: vertex " + std::to_string(v) + " of edge " +
                                                    std::to_string(k) + " does not exist: the mesh has " +
                                                    std::to_string(count) + " vertices");
      }
      edge.vertices[end] = static_cast<Index>(v);
    }
    edge.along = along.data()[k];
    edge.crossing = crossing.data()[k];
  }
  return weights;
}

}  // namespace

Weights weights_from(const Domain& domain, const std::optional<Vector<double>>& face,
                     const Vector<std::int64_t>& edge_vertices, const Vector<double>& along,
                     const Vector<double>& crossing, const std::string& slope,
                     const std::optional<Vector<double>>& slopes, const std::optional<Vector<double>>& paces,
                     double steepest, bool tacking, const std::optional<Vector<double>>& grain) {
  Weights weights = faces_and_edges(domain, face, edge_vertices, along, crossing);
  weights.pace = pace_from(slope, slopes, paces, steepest, tacking);
  for (std::size_t i = 0; grain && i + 3 < grain->shape(0); i += 4) {
    const double* g = grain->data() + i;
    weights.grain.push_back({{g[0], g[1], g[2]}, g[3]});
  }
  return weights;
}

nb::tuple path_arrays(const WeightedPath& path) {
  std::vector<Index> face, along;
  std::vector<double> length, weight, toll;
  for (const WeightedLeg& leg : path.legs) {
    face.push_back(leg.face);
    along.insert(along.end(), leg.along.begin(), leg.along.end());
    length.push_back(leg.length);
    weight.push_back(leg.weight);
    toll.push_back(leg.toll);
  }
  return nb::make_tuple(path_to_numpy(path), path.cost, path.lower, to_numpy_signed(std::move(face)),
                        to_numpy(std::move(length)), to_numpy(std::move(weight)), to_numpy(std::move(toll)),
                        to_numpy_signed(std::move(along)));
}

namespace {

using OptionalWeights = std::optional<Triples<double>>;

std::optional<Method> marching_by(const std::string& method) {
  if (method.empty()) return std::nullopt;
  return method_named(method);
}

SharedWeighting weighting_of(Weighted& weighted, double tolerance, bool towards, const std::string& method) {
  const nb::gil_scoped_release release;
  return {weighted.weighting({tolerance, towards, marching_by(method)})};
}

// (refinements, points, time); refinements -1: none would do.
nb::tuple numbers_of(const WeightedNeeds& needed) {
  const std::int64_t refinements = needed.is_reachable ? std::int64_t{needed.refinements} : -1;
  return nb::make_tuple(refinements, needed.points, needed.time);
}

// (distance, source, lower bounds or None, greatest and mean relative error bound, engine, what is needed): of the
// targets where there are any.
nb::tuple solve(Weighted& weighted, const Sources& sources, const std::optional<Vector<std::int64_t>>& target_index,
                const OptionalWeights& target_weights, double tolerance, unsigned refinements, bool lower, bool towards,
                double max_distance, const std::string& method, nb::object progress) {
  Computation computation(std::move(progress));
  WeightedOptions options;
  options.tolerance = tolerance;
  options.refinements = refinements;
  options.lower = lower;
  options.towards = towards;
  options.max_distance = max_distance;
  options.marching = marching_by(method);
  options.cancel = computation.cancel();
  options.progress = computation.progress();
  WeightedField field = computation.run(false, [&] {
    if (target_index) options.targets = targets_from(weighted.mesh(), {*target_index, target_weights});
    return weighted.with([&](WeightedSolver& s) { return s.distance(sources.list, options); });
  });
  std::vector<double>& values = target_index ? field.target_distance : field.distance;
  std::vector<double>& below = target_index ? field.target_lower : field.lower;
  nb::object lower_bounds = nb::none();
  if (!below.empty()) lower_bounds = nb::cast(to_numpy(std::move(below)));
  return nb::make_tuple(to_numpy(std::move(values)),
                        to_numpy_signed(std::move(target_index ? field.target_source : field.source)), lower_bounds,
                        field.max_error_bound, field.mean_error_bound, name_of(field.engine), numbers_of(field.needed));
}

nb::tuple paths(Weighted& weighted, const Sources& sources, const Vector<std::int64_t>& target_index,
                const OptionalWeights& target_weights, double tolerance, bool towards, double max_distance) {
  Computation computation{nb::none()};
  const std::vector<WeightedPath> found = computation.run(false, [&] {
    WeightedOptions options;
    options.tolerance = tolerance;
    options.towards = towards;
    options.max_distance = max_distance;
    options.cancel = computation.cancel();
    const std::vector<SurfacePoint> targets = targets_from(weighted.mesh(), {target_index, target_weights});
    return weighted.with([&](WeightedSolver& s) { return weighted_paths(s, sources.list, targets, options); });
  });
  return paths_to_numpy(found, path_arrays);
}

// placement: origin, to the right, down; x and y each.
void make_terrain(Terrain* place, const Vector<double>& heights, Index columns, Index rows,
                  const Vector<double>& placement, double no_data) {
  const double* p = placement.data();
  new (place)
      Terrain({heights.data(), heights.shape(0)}, columns, rows, {{p[0], p[1]}, {p[2], p[3]}, {p[4], p[5]}}, no_data);
}

// (face, weights); face -1 where there is no ground. x and y alternate.
nb::tuple below(const Terrain& terrain, const Vector<double>& xy) {
  std::vector<SurfacePoint> points;
  for (std::size_t i = 0; i + 1 < xy.shape(0); i += 2) points.push_back(terrain.below(xy.data()[i], xy.data()[i + 1]));
  return points_to_numpy(points);
}

// origin, to the right, down.
std::array<double, 6> numbers_of(const GridPlacement& p) {
  return {p.origin[0], p.origin[1], p.right[0], p.right[1], p.down[0], p.down[1]};
}

// (heights, columns, rows, placement, reference).
nb::tuple grid_from_file(const std::string& path) {
  Grid grid = listening(false, [&] { return read_grid(path); });
  const std::array<double, 6> placed = numbers_of(grid.placement);
  return nb::make_tuple(to_numpy(std::move(grid.heights)), grid.columns, grid.rows,
                        to_numpy(std::vector<double>(placed.begin(), placed.end())), grid.reference);
}

void grid_to_file(const std::string& path, const Vector<double>& values, Index columns, Index rows,
                  const Vector<double>& placement, const std::string& reference) {
  const double* p = placement.data();
  const Grid grid{{values.data(), values.data() + values.shape(0)},
                  columns,
                  rows,
                  {{p[0], p[1]}, {p[2], p[3]}, {p[4], p[5]}},
                  reference};
  listening(false, [&] {
    write_grid(path, grid);
    return true;
  });
}

std::string isochrones(const Domain& domain, const Vector<double>& values, const Vector<double>& levels) {
  const nb::gil_scoped_release release;
  return isochrones_as_geojson(domain, {values.data(), values.shape(0)}, {levels.data(), levels.shape(0)});
}

}  // namespace

void bind_weighted(nb::module_& m) {
  nb::class_<SharedWeighting>(m, "Weighting").def_prop_ro("domain", [](const SharedWeighting& w) {
    return w.value->domain();
  });
  nb::class_<Weighted>(m, "WeightedSolver")
      .def(nb::init<const Domain&, const std::optional<Vector<double>>&, const Vector<std::int64_t>&,
                    const Vector<double>&, const Vector<double>&, const std::string&,
                    const std::optional<Vector<double>>&, const std::optional<Vector<double>>&, double, bool,
                    const std::optional<Vector<double>>&>(),
           nb::arg("domain"), nb::arg("face").noconvert().none(), nb::arg("edge_vertices").noconvert(),
           nb::arg("along").noconvert(), nb::arg("crossing").noconvert(), nb::arg("slope"),
           nb::arg("slopes").noconvert().none(), nb::arg("paces").noconvert().none(), nb::arg("steepest"),
           nb::arg("tacking"), nb::arg("grain").noconvert().none())
      .def("weighting", weighting_of, nb::arg("tolerance"), nb::arg("towards"), nb::arg("method"))
      .def("solve", solve, nb::arg("sources"), nb::arg("target_index").noconvert().none(),
           nb::arg("target_weights").noconvert().none(), nb::arg("tolerance"), nb::arg("refinements"), nb::arg("lower"),
           nb::arg("towards"), nb::arg("max_distance"), nb::arg("method"), nb::arg("progress").none())
      .def("paths", paths, nb::arg("sources"), nb::arg("target_index").noconvert(),
           nb::arg("target_weights").noconvert().none(), nb::arg("tolerance"), nb::arg("towards"),
           nb::arg("max_distance"));
  m.def("isochrones", isochrones, nb::arg("domain"), nb::arg("values").noconvert(), nb::arg("levels").noconvert());
  m.def("read_grid", grid_from_file, nb::arg("path"));
  m.def("write_grid", grid_to_file, nb::arg("path"), nb::arg("values").noconvert(), nb::arg("columns"), nb::arg("rows"),
        nb::arg("placement").noconvert(), nb::arg("reference"));
  nb::class_<Terrain>(m, "Terrain")
      .def("__init__", make_terrain, nb::arg("heights").noconvert(), nb::arg("columns"), nb::arg("rows"),
           nb::arg("placement").noconvert(), nb::arg("no_data"))
      .def_prop_ro("mesh", [](const Terrain& t) { return t.mesh(); })
      .def("below", below, nb::arg("xy").noconvert());
}

}  // namespace brushfire::python
