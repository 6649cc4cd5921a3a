// _core.Mesh: construction from arrays, copies of its arrays, its report; files.
#include "bind.h"
#include "interrupt.h"
#include "options.h"

#include <brushfire/core/error.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/weld.h>

#include <nanobind/stl/vector.h>

#include <array>
#include <cstddef>
#include <limits>
#include <span>

namespace brushfire::python {
namespace {

std::span<const Face> faces_of(const Triples<std::uint32_t>& f) {
  static_assert(sizeof(Face) == 3 * sizeof(std::uint32_t));
  return {reinterpret_cast<const Face*>(f.data()), f.shape(0)};
}

// numpy sees vertex numbers as int32.
void check_vertex_count(std::size_t count) {
  if (count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw Error(ErrorCode::TooLarge, std::to_string(count) + " vertices do not fit into int32");
  }
}

Mesh make_mesh(const Triples<double>& v, const Triples<std::uint32_t>& f) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  check_vertex_count(v.shape(0));
  return listening(f.shape(0) < kBriefFaces,
                   [&] { return Mesh({reinterpret_cast<const Vec3*>(v.data()), v.shape(0)}, faces_of(f)); });
}

Mesh make_from_lengths(std::size_t vertex_count, const Triples<std::uint32_t>& f, const Triples<double>& l) {
  check_vertex_count(vertex_count);
  return listening(f.shape(0) < kBriefFaces, [&] {
    return Mesh::from_lengths(static_cast<Index>(vertex_count), faces_of(f),
                              {reinterpret_cast<const std::array<double, 3>*>(l.data()), l.shape(0)});
  });
}

// A numpy array that may be read only, of a copy: others ignore that flag (docs/decisions/python-arrays.md), and no
// mesh may change under its solvers.
template <class T, class Row>
nb::ndarray<nb::numpy, const T> copied(std::span<const Row> rows) {
  static_assert(sizeof(Row) == 3 * sizeof(T));
  auto* owned = new std::vector<Row>(rows.begin(), rows.end());
  const nb::capsule owner(owned, [](void* p) noexcept { delete static_cast<std::vector<Row>*>(p); });
  return {reinterpret_cast<const T*>(owned->data()), {owned->size(), 3}, owner};
}

nb::ndarray<nb::numpy, const double> vertices_of(const Mesh& mesh) { return copied<double>(mesh.positions()); }
nb::ndarray<nb::numpy, const std::int32_t> numbers_of(const Mesh& mesh) { return copied<std::int32_t>(mesh.faces()); }

// The diagonal of the box around all vertices; 0 where there are none.
double size_of(const Mesh& mesh) {
  const auto [low, high] = mesh.bounds();
  return mesh.positions().empty() ? 0 : norm(high - low);
}

// In the units of the input.
Result<double> lengths_of(const Mesh& mesh) {
  std::vector<double> lengths(mesh.lengths().begin(), mesh.lengths().end());
  for (double& l : lengths) l *= mesh.unit();
  return to_numpy(std::move(lengths), {mesh.face_count(), 3});
}

nb::dict report_of(const Mesh& mesh) {
  const MeshReport& r = *listening(mesh.face_count() < kBriefFaces, [&] { return &mesh.report(); });
  nb::dict d;
  d["vertices"] = r.vertices;
  d["faces"] = r.faces;
  d["edges"] = r.edges;
  d["components"] = r.components;
  d["boundary_edges"] = r.boundary_edges;
  d["nonmanifold_edges"] = r.nonmanifold_edges;
  d["misoriented_edges"] = r.misoriented_edges;
  d["nonmanifold_vertices"] = r.nonmanifold_vertices;
  d["isolated_vertices"] = r.isolated_vertices;
  d["repeated_index_faces"] = r.repeated_index_faces;
  d["zero_area_faces"] = r.zero_area_faces;
  d["zero_length_edges"] = r.zero_length_edges;
  d["duplicate_faces"] = r.duplicate_faces;
  d["duplicate_positions"] = r.duplicate_positions;
  d["looks_like_soup"] = r.looks_like_soup;
  d["min_edge_length"] = r.min_edge_length;
  d["mean_edge_length"] = r.mean_edge_length;
  d["max_edge_length"] = r.max_edge_length;
  d["area"] = r.area;
  d["euler_characteristic"] = r.euler_characteristic;
  d["length_precision"] = r.length_precision;
  d["remarks"] = nb::tuple(nb::cast(r.remarks()));
  return d;
}

Result<double> positions_of(const Mesh& mesh, const Vector<std::int64_t>& index,
                            const std::optional<Triples<double>>& weights) {
  std::vector<double> xyz;
  const std::vector<Place> places = places_from({index, weights});
  xyz.reserve(3 * places.size());
  for (const Place& place : places) {
    const Index* vertex = std::get_if<Index>(&place);
    const Vec3 p = position(mesh, vertex ? vertex_point(mesh, *vertex) : std::get<SurfacePoint>(place));
    xyz.insert(xyz.end(), {p.x, p.y, p.z});
  }
  return to_numpy(std::move(xyz), {places.size(), 3});
}

nb::tuple to_tuple(LoadedMesh&& loaded) {
  check_vertex_count(loaded.mesh.vertex_count());
  return nb::make_tuple(loaded.mesh, loaded.format, nb::tuple(nb::cast(loaded.remarks)),
                        to_numpy_signed(std::move(loaded.face_origin)), to_numpy_signed(std::move(loaded.vertex_map)));
}

nb::tuple read(const std::string& path) {
  return to_tuple(listening(false, [&] { return read_mesh(path); }));
}

// `name` stands in messages; its extension decides where the content does not.
nb::tuple read_bytes(const nb::bytes& content, const std::string& name) {
  const std::span bytes(static_cast<const std::byte*>(content.data()), content.size());
  return to_tuple(listening(false, [&] { return read_mesh(bytes, name); }));
}

// (mesh, vertex map, joined).
nb::tuple welded(const Mesh& mesh, double tolerance) {
  Welded w = listening(false, [&] { return weld(mesh, tolerance); });
  return nb::make_tuple(std::move(w.mesh), to_numpy_signed(std::move(w.vertex_map)), w.joined);
}

}  // namespace

void bind_mesh(nb::module_& m) {
  nb::class_<Mesh>(m, "Mesh", nb::is_weak_referenceable())
      .def_prop_ro("vertex_count", &Mesh::vertex_count)
      .def_prop_ro("face_count", &Mesh::face_count)
      .def_prop_ro("has_positions", &Mesh::has_positions)
      .def_prop_ro("vertices", vertices_of, nb::rv_policy::reference)
      .def_prop_ro("faces", numbers_of, nb::rv_policy::reference)
      .def_prop_ro("size", size_of)
      .def("lengths", lengths_of)
      .def("report", report_of)
      .def("positions", positions_of, nb::arg("index").noconvert(), nb::arg("weights").noconvert().none());
  m.def("make_mesh", make_mesh, nb::arg("vertices").noconvert(), nb::arg("faces").noconvert());
  m.def("make_from_lengths", make_from_lengths, nb::arg("vertex_count"), nb::arg("faces").noconvert(),
        nb::arg("lengths").noconvert());
  m.def("weld", welded, nb::arg("mesh"), nb::arg("tolerance"));
  m.def("read", read, nb::arg("path"));
  m.def("read_bytes", read_bytes, nb::arg("content"), nb::arg("name"));
}

}  // namespace brushfire::python
