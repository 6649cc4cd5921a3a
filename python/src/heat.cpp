// The heat method for many right-hand sides, the vector heat method, the signed one.
#include "bind.h"
#include "interrupt.h"

#include <brushfire/core/error.h>
#include <brushfire/solvers/heat.h>
#include <brushfire/solvers/laplacian.h>
#include <brushfire/solvers/signed_heat.h>
#include <brushfire/solvers/vector_heat.h>

#include <complex>
#include <mutex>
#include <span>

namespace brushfire::python {
namespace {

using Complex = std::complex<double>;
using OptionalWeights = std::optional<Triples<double>>;
using Pairs = nb::ndarray<const double, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;

// The Python files have checked the names.
HeatOptions heat_options(double time_factor, double time, const std::string& boundary, bool delaunay, double shift) {
  HeatOptions options{time_factor, time, HeatBoundary::Neumann, delaunay, shift};
  if (boundary == "dirichlet") options.boundary = HeatBoundary::Dirichlet;
  if (boundary == "averaged") options.boundary = HeatBoundary::Averaged;
  return options;
}

std::vector<Index> vertices_from(const Mesh& mesh, const Vector<std::int64_t>& index) {
  std::vector<Index> vertices;
  for (std::size_t i = 0; i < index.shape(0); ++i) {
    const std::int64_t v = index.data()[i];
    if (v < 0 || v >= mesh.vertex_count()) {
      throw Error(ErrorCode::IndexOutOfRange, "vertex " + std::to_string(v) + " does not exist: the mesh has " +
                                                  std::to_string(mesh.vertex_count()) + " vertices");
    }
    vertices.push_back(static_cast<Index>(v));
  }
  return vertices;
}

// What several threads may ask one after the other: the solvers build what they need on their way.
template <class Solver>
struct Shared {
  Mesh mesh;  // the whole
  Solver solver;
  std::mutex mutex;

  Shared(const Domain& given, const HeatOptions& options)
      : mesh(given.mesh()), solver(listening(false, [&] { return Solver(given, options); })) {}

  template <class Use>
  auto with(Use&& use) {
    return listening(false, [&] {
      const std::lock_guard lock(mutex);
      return use(solver);
    });
  }
};

using Heat = Shared<HeatSolver>;
using VectorHeat = Shared<VectorHeatSolver>;
using SignedHeat = Shared<SignedHeatSolver>;

template <class T>
void construct(T* self, const Domain& domain, double time_factor, double time, const std::string& boundary,
               bool delaunay, double shift) {
  new (self) T(domain, heat_options(time_factor, time, boundary, delaunay, shift));
}

// Set k is sources[starts[k]] .. sources[starts[k + 1] - 1]: (sets, vertices).
Result<double> distances(Heat& heat, const Vector<std::int64_t>& index, const OptionalWeights& weights,
                         const Vector<double>& offsets, const Vector<std::int64_t>& starts) {
  std::vector<std::vector<Source>> sets;
  std::vector<double> rows = heat.with([&](const HeatSolver& solver) {
    const std::vector<Source> all = sources_from(heat.mesh, {index, weights}, offsets);
    for (std::size_t k = 0; k + 1 < starts.shape(0); ++k) {
      sets.emplace_back(all.begin() + starts.data()[k], all.begin() + starts.data()[k + 1]);
    }
    return solver.distances(sets);
  });
  return to_numpy(std::move(rows), {sets.size(), heat.mesh.vertex_count()});
}

Result<double> to_pairs(const std::vector<Complex>& values) {
  std::vector<double> pairs;
  pairs.reserve(2 * values.size());
  for (const Complex& z : values) pairs.insert(pairs.end(), {z.real(), z.imag()});
  return to_numpy(std::move(pairs), {values.size(), 2});
}

Result<double> extend(VectorHeat& heat, const Vector<std::int64_t>& index, const Vector<double>& values) {
  const std::vector<Index> vertices = vertices_from(heat.mesh, index);
  return to_numpy(
      heat.with([&](VectorHeatSolver& s) { return s.extend(vertices, std::span(values.data(), values.shape(0))); }));
}

Result<double> transport(VectorHeat& heat, const Vector<std::int64_t>& index, const Pairs& vectors) {
  const std::vector<Index> vertices = vertices_from(heat.mesh, index);
  std::vector<Complex> numbers;
  for (std::size_t i = 0; i < vectors.shape(0); ++i) numbers.emplace_back(vectors(i, 0), vectors(i, 1));
  return to_pairs(heat.with([&](VectorHeatSolver& s) { return s.transport(vertices, numbers); }));
}

Result<double> log_map(VectorHeat& heat, const Vector<std::int64_t>& index, int strategy) {
  const Index source = vertices_from(heat.mesh, index).at(0);
  return to_pairs(heat.with([&](VectorHeatSolver& s) { return s.log_map(source, LogMapStrategy(strategy)); }));
}

nb::tuple tangent_frames(VectorHeat& heat) {
  const VectorHeatSolver::Frames frames = heat.with([](VectorHeatSolver& s) { return s.tangent_frames(); });
  const auto xyz = [](const std::vector<Vec3>& vectors) {
    std::vector<double> flat;
    flat.reserve(3 * vectors.size());
    for (const Vec3& a : vectors) flat.insert(flat.end(), {a.x, a.y, a.z});
    return to_numpy(std::move(flat), {vectors.size(), 3});
  };
  return nb::make_tuple(xyz(frames.x), xyz(frames.y), xyz(frames.normal));
}

// (row, column, real, imaginary).
nb::tuple connection_laplacian(VectorHeat& heat) {
  VectorHeatSolver::SparseComplex m = heat.with([](VectorHeatSolver& s) { return s.connection_laplacian(); });
  const nb::object parts = nb::cast(to_pairs(m.value));
  return nb::make_tuple(to_numpy_signed(std::move(m.row)), to_numpy_signed(std::move(m.column)), parts);
}

// Curve k is places[starts[k]] .. places[starts[k + 1] - 1].
Result<double> signed_distance(SignedHeat& heat, const Vector<std::int64_t>& index, const OptionalWeights& weights,
                               const Vector<std::int64_t>& starts, const Vector<std::int64_t>& is_signed,
                               const Vector<std::int64_t>& point_index, const OptionalWeights& point_weights,
                               int constraint, double soft_weight, bool preserve_normals) {
  return to_numpy(heat.with([&](SignedHeatSolver& s) {
    const std::vector<SurfacePoint> nodes = points_from(heat.mesh, {index, weights});
    std::vector<SignedCurve> curves;
    for (std::size_t k = 0; k + 1 < starts.shape(0); ++k) {
      curves.push_back(
          {{nodes.begin() + starts.data()[k], nodes.begin() + starts.data()[k + 1]}, is_signed.data()[k] != 0});
    }
    const std::vector<SurfacePoint> points = points_from(heat.mesh, {point_index, point_weights});
    return s.distance(curves, points, {LevelSetConstraint(constraint), soft_weight, preserve_normals});
  }));
}

// (row, column, value, mass).
nb::tuple laplacian(const Domain& domain, bool delaunay) {
  Laplacian l = listening(false, [&] { return laplacian_of(domain, delaunay); });
  return nb::make_tuple(to_numpy_signed(std::move(l.row)), to_numpy_signed(std::move(l.column)),
                        to_numpy(std::move(l.value)), to_numpy(std::move(l.mass)));
}

template <class T>
nb::class_<T> bind_solver(nb::module_& m, const char* name) {
  return nb::class_<T>(m, name).def("__init__", construct<T>, nb::arg("domain"), nb::arg("time_factor"),
                                    nb::arg("time"), nb::arg("boundary"), nb::arg("delaunay"),
                                    nb::arg("poisson_shift"));
}

}  // namespace

void bind_heat(nb::module_& m) {
  m.def("laplacian", laplacian, nb::arg("domain"), nb::arg("delaunay"));
  bind_solver<Heat>(m, "HeatSolver")
      .def("distances", distances, nb::arg("index").noconvert(), nb::arg("weights").noconvert().none(),
           nb::arg("offsets").noconvert(), nb::arg("starts").noconvert())
      .def_prop_ro("time", [](const Heat& heat) { return heat.solver.time(); })
      .def_prop_ro("mean_edge_length", [](const Heat& heat) { return heat.solver.mean_edge_length(); });
  bind_solver<VectorHeat>(m, "VectorHeatSolver")
      .def("extend", extend, nb::arg("index").noconvert(), nb::arg("values").noconvert())
      .def("transport", transport, nb::arg("index").noconvert(), nb::arg("vectors").noconvert())
      .def("log_map", log_map, nb::arg("index").noconvert(), nb::arg("strategy"))
      .def("tangent_frames", tangent_frames)
      .def("connection_laplacian", connection_laplacian)
      .def_prop_ro("time", [](const VectorHeat& heat) { return heat.solver.time(); });
  bind_solver<SignedHeat>(m, "SignedHeatSolver")
      .def("distance", signed_distance, nb::arg("index").noconvert(), nb::arg("weights").noconvert().none(),
           nb::arg("starts").noconvert(), nb::arg("is_signed").noconvert(), nb::arg("point_index").noconvert(),
           nb::arg("point_weights").noconvert().none(), nb::arg("constraint"), nb::arg("soft_weight"),
           nb::arg("preserve_normals"));
}

}  // namespace brushfire::python
