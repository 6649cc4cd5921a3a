// Cells and centres, parcels, smoothing, boundaries.
#include "options.h"

#include <brushfire/core/error.h>
#include <brushfire/mesh/boundaries.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/queries/centroidal.h>
#include <brushfire/queries/extent.h>
#include <brushfire/queries/karcher_mean.h>
#include <brushfire/queries/nearest_sources.h>
#include <brushfire/queries/parcels.h>
#include <brushfire/queries/smoothing.h>
#include <brushfire/queries/surface_curves.h>
#include <brushfire/queries/vertex_measures.h>

#include <span>
#include <utility>

namespace brushfire::python {
namespace {

using OptionalWeights = std::optional<Triples<double>>;

std::span<const double> span_of(const Vector<double>& values) { return {values.data(), values.shape(0)}; }

MatrixOptions matrix_options(const nb::dict& given, unsigned threads, Computation& computation) {
  MatrixOptions options;
  options.distance = options_from(given, computation);
  options.threads = threads;
  return options;
}

std::int64_t signed_index(Index v) { return v == kNoIndex ? -1 : std::int64_t{v}; }

// (distance, source), [vertices, k] each.
nb::tuple nearest(const Domain& domain, const Sources& sources, Index count, const nb::dict& given,
                  nb::object progress) {
  Computation computation(std::move(progress));
  const DistanceOptions options = options_from(given, computation);
  NearestSources found = computation.run(false, [&] { return nearest_sources(domain, sources.list, count, options); });
  const std::size_t rows = domain.mesh().vertex_count(), columns = found.count;
  std::vector<std::int32_t> source(found.source.begin(), found.source.end());
  return nb::make_tuple(to_numpy(std::move(found.distance), {rows, columns}),
                        to_numpy(std::move(source), {rows, columns}));
}

nb::dict measure_extent(const Domain& domain, double tolerance, Index most, unsigned threads, nb::object progress) {
  Computation computation(std::move(progress));
  ExtentOptions options;
  options.tolerance = tolerance;
  options.max_runs = most;
  options.threads = threads;
  options.progress = computation.progress();
  options.cancel = computation.cancel();
  const Extent e = computation.run(false, [&] { return extent(domain, options); });
  nb::dict d;
  d["diameter_lower"] = e.diameter_lower;
  d["diameter_upper"] = e.diameter_upper;
  d["pair"] = nb::make_tuple(signed_index(e.pair[0]), signed_index(e.pair[1]));
  d["radius_lower"] = e.radius_lower;
  d["radius_upper"] = e.radius_upper;
  d["centre"] = signed_index(e.centre);
  d["runs"] = e.runs;
  return d;
}

using PlacesGiven = std::optional<Vector<std::int64_t>>;

// All vertices where no index is given.
template <class Compute>
auto over_places(const PlacesGiven& index, const OptionalWeights& weights, const Compute& compute) {
  if (!index) return compute(Places(std::nullopt));
  const std::vector<Place> places = places_from({*index, weights});
  return compute(Places(std::span<const Place>(places)));
}

template <std::vector<double> (*kMeasure)(const Domain&, Places, const MatrixOptions&)>
Result<double> per_place(const Domain& domain, const PlacesGiven& index, const OptionalWeights& weights,
                         const nb::dict& given, unsigned threads, nb::object progress) {
  Computation computation(std::move(progress));
  const MatrixOptions options = matrix_options(given, threads, computation);
  return to_numpy(computation.run(false, [&] {
    return over_places(index, weights, [&](Places places) { return kMeasure(domain, places, options); });
  }));
}

nb::tuple discs(const Domain& domain, double share, const PlacesGiven& index, const OptionalWeights& weights,
                const nb::dict& given, unsigned threads, nb::object progress) {
  Computation computation(std::move(progress));
  const MatrixOptions options = matrix_options(given, threads, computation);
  Discs d = computation.run(false, [&] {
    return over_places(index, weights, [&](Places places) { return discs_of_share(domain, share, places, options); });
  });
  return nb::make_tuple(to_numpy(std::move(d.radius)), to_numpy(std::move(d.perimeter)), to_numpy(std::move(d.area)));
}

// (face, weights, deviation, converged).
nb::tuple mean(const Domain& domain, const Vector<std::int64_t>& index, const OptionalWeights& place_weights,
               const Vector<double>& weights, double tolerance) {
  Computation computation{nb::none()};
  const std::vector<SurfacePoint> points = points_from(domain.mesh(), {index, place_weights});
  KarcherMeanOptions options;
  options.tolerance = tolerance;
  options.cancel = computation.cancel();
  const KarcherMean m = computation.run(false, [&] { return karcher_mean(domain, points, span_of(weights), options); });
  const nb::tuple arrays = points_to_numpy(std::span(&m.point, 1));
  return nb::make_tuple(arrays[0], arrays[1], m.deviation, m.converged);
}

// (face, weights, distance, nearest, energy); `count` sites where no first ones are given.
nb::tuple centroidal(const Domain& domain, Index count, const PlacesGiven& index, const OptionalWeights& weights,
                     const Vector<double>& density, Index rounds, double tolerance, unsigned threads,
                     nb::object progress) {
  Computation computation(std::move(progress));
  CentroidalOptions options;
  options.max_rounds = rounds;
  options.tolerance = tolerance;
  options.density = span_of(density);
  options.threads = threads;
  options.progress = computation.progress();
  options.cancel = computation.cancel();
  CentroidalVoronoi c = computation.run(false, [&] {
    return index ? centroidal_voronoi(domain, points_from(domain.mesh(), {*index, weights}), options)
                 : centroidal_voronoi(domain, count, options);
  });
  const nb::tuple sites = points_to_numpy(c.sites);
  return nb::make_tuple(sites[0], sites[1], to_numpy(std::move(c.distance)), to_numpy_signed(std::move(c.nearest)),
                        to_numpy(std::move(c.energy)));
}

// (places, nearest, cost).
nb::tuple medoids(const Vector<double>& distances, Index count, const Vector<double>& weights) {
  Medoids m = listening(false, [&] { return k_medoids(span_of(distances), count, span_of(weights)); });
  return nb::make_tuple(to_numpy_signed(std::move(m.places)), to_numpy_signed(std::move(m.nearest)), m.cost);
}

// (label, distance, vertices, centroid).
nb::tuple parcels(const Domain& domain, const Vector<std::int64_t>& label, const std::string& kind,
                  std::int64_t least_label, const nb::dict& given, unsigned threads, nb::object progress) {
  Computation computation(std::move(progress));
  const MatrixOptions options = matrix_options(given, threads, computation);
  ParcelMatrix m = computation.run(false, [&] {
    return parcel_distances(domain, {label.data(), label.shape(0)}, parcel_distance_named(kind), least_label, options);
  });
  const std::size_t n = m.label.size();
  return nb::make_tuple(to_numpy(std::move(m.label)), to_numpy(std::move(m.distance), {n, n}),
                        to_numpy_signed(std::move(m.vertices)), to_numpy_signed(std::move(m.centroid)));
}

// (value, column, row starts).
nb::tuple kernel(const Domain& domain, double sigma, const nb::dict& given, unsigned threads, nb::object progress) {
  Computation computation(std::move(progress));
  const MatrixOptions options = matrix_options(given, threads, computation);
  SparseMatrix<double> k = computation.run(false, [&] { return smoothing_kernel(domain, sigma, options); });
  std::vector<std::int64_t> starts(k.row_start.begin(), k.row_start.end());
  return nb::make_tuple(to_numpy(std::move(k.value)), to_numpy_signed(std::move(k.column)),
                        to_numpy(std::move(starts)));
}

// [(vertices, length, closed)].
nb::list boundary_curves(const Mesh& mesh) {
  nb::list list;
  for (Boundary& b : listening(false, [&] { return boundaries(mesh); })) {
    list.append(nb::make_tuple(to_numpy_signed(std::move(b.vertices)), b.length, b.closed));
  }
  return list;
}

nb::tuple chain(const Mesh& mesh, const Vector<std::int64_t>& vertices, bool closed) {
  std::vector<Index> numbers;
  for (std::size_t i = 0; i < vertices.shape(0); ++i) {
    const std::int64_t v = vertices.data()[i];
    numbers.push_back(v >= 0 && v < std::int64_t{mesh.vertex_count()} ? static_cast<Index>(v) : kNoIndex);
  }
  return path_to_numpy(curve_along(mesh, numbers, closed));
}

// (path, largest gap, where).
nb::tuple project(const Domain& domain, const Triples<double>& xyz, bool closed) {
  Computation computation{nb::none()};
  const ProjectedCurve c = computation.run(false, [&] {
    return project_curve(domain, {reinterpret_cast<const Vec3*>(xyz.data()), xyz.shape(0)}, closed,
                         computation.cancel());
  });
  return nb::make_tuple(path_to_numpy(c.path), c.largest_gap,
                        nb::make_tuple(c.gap_position.x, c.gap_position.y, c.gap_position.z));
}

template <std::vector<double> (*kMeasure)(const Domain&, Places, const MatrixOptions&)>
void bind_measure(nb::module_& m, const char* name) {
  m.def(name, per_place<kMeasure>, nb::arg("domain"), nb::arg("index").none(), nb::arg("weights").none(),
        nb::arg("options"), nb::arg("threads"), nb::arg("progress").none());
}

}  // namespace

void bind_cells(nb::module_& m) {
  m.def("nearest_sources", nearest, nb::arg("domain"), nb::arg("sources"), nb::arg("count"), nb::arg("options"),
        nb::arg("progress").none());
  m.def("extent", measure_extent, nb::arg("domain"), nb::arg("tolerance"), nb::arg("most"), nb::arg("threads"),
        nb::arg("progress").none());
  bind_measure<eccentricities>(m, "eccentricities");
  bind_measure<average_distances>(m, "average_distances");
  m.def("discs", discs, nb::arg("domain"), nb::arg("share"), nb::arg("index").none(), nb::arg("weights").none(),
        nb::arg("options"), nb::arg("threads"), nb::arg("progress").none());
  m.def("karcher_mean", mean, nb::arg("domain"), nb::arg("index").noconvert(),
        nb::arg("place_weights").noconvert().none(), nb::arg("weights").noconvert(), nb::arg("tolerance"));
  m.def("centroidal_voronoi", centroidal, nb::arg("domain"), nb::arg("count"), nb::arg("index").none(),
        nb::arg("weights").none(), nb::arg("density").noconvert(), nb::arg("rounds"), nb::arg("tolerance"),
        nb::arg("threads"), nb::arg("progress").none());
  m.def("k_medoids", medoids, nb::arg("distances").noconvert(), nb::arg("count"), nb::arg("weights").noconvert());
  m.def("parcels", parcels, nb::arg("domain"), nb::arg("label").noconvert(), nb::arg("kind"), nb::arg("least_label"),
        nb::arg("options"), nb::arg("threads"), nb::arg("progress").none());
  m.def("smoothing_kernel", kernel, nb::arg("domain"), nb::arg("sigma"), nb::arg("options"), nb::arg("threads"),
        nb::arg("progress").none());
  m.def("curve_along", chain, nb::arg("mesh"), nb::arg("vertices").noconvert(), nb::arg("closed"));
  m.def("project_curve", project, nb::arg("domain"), nb::arg("xyz").noconvert(), nb::arg("closed"));
  m.def("boundaries", boundary_curves, nb::arg("mesh"));
}

}  // namespace brushfire::python
