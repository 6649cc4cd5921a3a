// Parts of the surface: Voronoi cells, farthest-point samples, meshes with barriers cut out.
#include "options.h"

#include <brushfire/core/error.h>
#include <brushfire/mesh/cut.h>
#include <brushfire/queries/sampling.h>
#include <brushfire/queries/voronoi.h>

#include <algorithm>
#include <limits>
#include <span>

namespace brushfire::python {
namespace {

// Numbers of vertices or faces; those that no mesh has become kNoIndex, which the library then refuses by name.
std::vector<Index> indices_from(const Vector<std::int64_t>& numbers, const char* what, Index count) {
  std::vector<Index> indices;
  indices.reserve(numbers.shape(0));
  for (std::size_t k = 0; k < numbers.shape(0); ++k) {
    const std::int64_t i = numbers.data()[k];
    if (i < 0 || i >= std::int64_t{count}) {
      throw Error(ErrorCode::IndexOutOfRange, std::string(what) + " " + std::to_string(i) +
                                                  " does not exist: the mesh has " + std::to_string(count));
    }
    indices.push_back(static_cast<Index>(i));
  }
  return indices;
}

// (distance, source, area, [(source, source, path)], dual).
nb::tuple voronoi_cells(const Domain& domain, const Sources& sources, const nb::dict& given, nb::object progress) {
  Computation computation(std::move(progress));
  const DistanceOptions options = options_from(given, computation);
  VoronoiDiagram diagram = computation.run(false, [&] { return voronoi(domain, sources.list, options); });
  nb::list borders;
  for (const VoronoiBorder& b : diagram.borders) {
    borders.append(nb::make_tuple(b.sources[0], b.sources[1], path_to_numpy(b.line)));
  }
  std::vector<std::int32_t> dual;
  for (const Face& t : diagram.dual) dual.insert(dual.end(), t.begin(), t.end());
  return nb::make_tuple(to_numpy(std::move(diagram.distance)), to_numpy_signed(std::move(diagram.source)),
                        to_numpy(std::move(diagram.area)), borders,
                        to_numpy(std::move(dual), {diagram.dual.size(), 3}));
}

// (vertices, separation, distance, nearest, covering radius).
nb::tuple sample(const Domain& domain, Index count, const Vector<std::int64_t>& first, const nb::dict& given,
                 nb::object progress) {
  Computation computation(std::move(progress));
  const DistanceOptions options = options_from(given, computation);
  const std::vector<Index> start = indices_from(first, "vertex", domain.mesh().vertex_count());
  Samples s = computation.run(false, [&] { return farthest_points(domain, count, start, options); });
  return nb::make_tuple(to_numpy_signed(std::move(s.vertices)), to_numpy(std::move(s.separation)),
                        to_numpy(std::move(s.distance)), to_numpy_signed(std::move(s.nearest)), s.covering_radius);
}

Barriers barriers_from(const Mesh& mesh, const Vector<std::int64_t>& vertices, const Vector<std::int64_t>& faces,
                       const Vector<std::int64_t>& edge_ends) {
  Barriers barriers;
  barriers.vertices = indices_from(vertices, "vertex", mesh.vertex_count());
  barriers.faces = indices_from(faces, "face", mesh.face_count());
  const std::vector<Index> ends = indices_from(edge_ends, "vertex", mesh.vertex_count());
  for (std::size_t k = 0; k + 1 < ends.size(); k += 2) barriers.edges.push_back({ends[k], ends[k + 1]});
  return barriers;
}

CutMesh make_cut(const Mesh& mesh, const Vector<std::int64_t>& vertices, const Vector<std::int64_t>& faces,
                 const Vector<std::int64_t>& edge_ends) {
  const Barriers barriers = barriers_from(mesh, vertices, faces, edge_ends);
  return listening(mesh.face_count() < kBriefFaces, [&] { return cut(mesh, barriers); });
}

Domain make_domain(const Mesh& mesh, const Vector<std::int64_t>& vertices, const Vector<std::int64_t>& faces,
                   const Vector<std::int64_t>& edge_ends) {
  const Barriers barriers = barriers_from(mesh, vertices, faces, edge_ends);
  return listening(mesh.face_count() < kBriefFaces, [&] { return Domain(mesh, barriers); });
}

nb::dict part_of(const Domain& domain) {
  const OpenPart part = open_part(domain);
  nb::dict d;
  d["closed_faces"] = part.closed_faces;
  d["closed_vertices"] = part.closed_vertices;
  d["components"] = part.components;
  d["area"] = part.area;
  d["largest_area"] = part.largest_area;
  d["islanders"] = part.islanders;
  std::vector<std::uint8_t> open;
  for (Index v = 0; v < domain.mesh().vertex_count(); ++v) open.push_back(domain.is_open(v));
  d["open"] = to_numpy(std::move(open));
  return d;
}

Result<double> values_to_original(const CutMesh& cut_mesh, const Vector<double>& values) {
  return to_numpy(cut_mesh.to_original(std::span(values.data(), values.shape(0))));
}

nb::tuple points_to_original(const CutMesh& cut_mesh, const Vector<std::int64_t>& index,
                             const std::optional<Triples<double>>& weights) {
  std::vector<SurfacePoint> points = points_from(cut_mesh.mesh, {index, weights});
  for (SurfacePoint& p : points) p = cut_mesh.to_original(p);
  return points_to_numpy(points);
}

// Of all points, one after the other; (face, weights, which of the given points each one is).
nb::tuple points_from_original(const CutMesh& cut_mesh, const Mesh& original, const Vector<std::int64_t>& index,
                               const std::optional<Triples<double>>& weights) {
  std::vector<SurfacePoint> points;
  std::vector<Index> origin;
  Index number = 0;
  for (const SurfacePoint& p : points_from(original, {index, weights})) {
    for (const SurfacePoint& side : cut_mesh.from_original(original, p)) {
      points.push_back(side);
      origin.push_back(number);
    }
    ++number;
  }
  const nb::tuple arrays = points_to_numpy(points);
  return nb::make_tuple(arrays[0], arrays[1], to_numpy_signed(std::move(origin)));
}

template <std::vector<Index> CutMesh::* kMember>
Result<std::int32_t> numbers_of(const CutMesh& cut_mesh) {
  std::vector<Index> copy = cut_mesh.*kMember;
  return to_numpy_signed(std::move(copy));
}

}  // namespace

void bind_regions(nb::module_& m) {
  nb::class_<Domain>(m, "Domain").def(nb::init<const Mesh&>(), nb::arg("mesh")).def("open_part", part_of);
  nb::implicitly_convertible<Mesh, Domain>();
  m.def("make_domain", make_domain, nb::arg("mesh"), nb::arg("vertices").noconvert(), nb::arg("faces").noconvert(),
        nb::arg("edge_ends").noconvert());
  m.def("voronoi", voronoi_cells, nb::arg("domain"), nb::arg("sources"), nb::arg("options"),
        nb::arg("progress").none());
  m.def("farthest_points", sample, nb::arg("domain"), nb::arg("count"), nb::arg("first").noconvert(),
        nb::arg("options"), nb::arg("progress").none());
  nb::class_<CutMesh>(m, "CutMesh")
      .def_ro("mesh", &CutMesh::mesh)
      .def("original_vertex", numbers_of<&CutMesh::original_vertex>)
      .def("original_face", numbers_of<&CutMesh::original_face>)
      .def("cut_face", numbers_of<&CutMesh::cut_face>)
      .def("values_to_original", values_to_original, nb::arg("values").noconvert())
      .def("points_to_original", points_to_original, nb::arg("index").noconvert(),
           nb::arg("weights").noconvert().none())
      .def("points_from_original", points_from_original, nb::arg("original"), nb::arg("index").noconvert(),
           nb::arg("weights").noconvert().none());
  m.def("cut", make_cut, nb::arg("mesh"), nb::arg("vertices").noconvert(), nb::arg("faces").noconvert(),
        nb::arg("edge_ends").noconvert());
}

}  // namespace brushfire::python
