// Meshes: from arrays and generators, their arrays, their report; barriers; nearest points; memory.
#include "surface.h"

#include <brushfire/core/error.h>
#include <brushfire/mesh/cut.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/mesh/subdivide.h>
#include <brushfire/mesh/weld.h>
#include <brushfire/version.h>

#include <malloc.h>

#include <cmath>
#include <cstdlib>

namespace brushfire::js {
namespace {

// Triples in a flat array: Error(InvalidArgument) where one is not whole.
template <class Row, class T>
std::span<const Row> rows_of(const T* data, std::size_t size, const char* what) {
  static_assert(sizeof(Row) == 3 * sizeof(T));
  if (size % 3 == 0) return {reinterpret_cast<const Row*>(data), size / 3};
  throw Error(ErrorCode::InvalidArgument,
              std::string(what) + ": " + std::to_string(size) + " numbers are not three for each");
}

// What a generator is told: whole numbers first, then lengths.
class Sizes {
 public:
  explicit Sizes(std::span<const double> given) : given_(given) {}
  Index count(std::size_t k) const {
    if (k >= given_.size()) throw Error(ErrorCode::InvalidArgument, "this shape needs more numbers");
    const double n = given_[k];
    if (n >= 0 && n < kNoIndex && n == std::floor(n)) return static_cast<Index>(n);
    throw Error(ErrorCode::InvalidArgument, std::to_string(n) + " is no number of cells");
  }
  double length(std::size_t k, double otherwise) const { return k < given_.size() ? given_[k] : otherwise; }

 private:
  std::span<const double> given_;
};

Shape shape_named(std::string_view name, const Sizes& s) {
  using namespace shapes;
  if (name == "plane") return plane(s.count(0), s.count(1), s.length(2, 1), s.length(3, 1));
  if (name == "saddle") return saddle(s.count(0), s.length(1, 1));
  if (name == "noise-terrain") return noise_terrain(s.count(0), s.count(1), s.length(2, 0.2));
  if (name == "cube") return cube(s.count(0));
  if (name == "icosphere") return icosphere(s.count(0), s.length(1, 1));
  if (name == "latlong-sphere") return latlong_sphere(s.count(0), s.count(1), s.length(2, 1));
  if (name == "cone") return cone(s.count(0), s.count(1), s.length(2, 1), s.length(3, 1));
  if (name == "cylinder") return cylinder(s.count(0), s.count(1), s.length(2, 1), s.length(3, 1));
  if (name == "torus") return torus(s.count(0), s.count(1), s.length(2, 1), s.length(3, 0.4));
  if (name == "folded-sphere") return folded_sphere(s.count(0), s.length(1, 6), s.length(2, 0.2));
  if (name == "book") return book(s.count(0), s.count(1), s.count(2));
  if (name == "bow-tie") return bow_tie(s.count(0), s.count(1));
  throw Error(ErrorCode::InvalidArgument, "unknown shape '" + std::string(name) +
                                              "': it is plane, saddle, noise-terrain, cube, icosphere, latlong-sphere, "
                                              "cone, cylinder, torus, folded-sphere, book or bow-tie");
}

}  // namespace

BRUSHFIRE_EXPORT(allocate) void* allocate(std::size_t bytes) { return std::malloc(bytes == 0 ? 1 : bytes); }
BRUSHFIRE_EXPORT(release) void release(void* memory) { std::free(memory); }
BRUSHFIRE_EXPORT(reply_free) void reply_free(Reply* reply) { delete reply; }
// Bytes that are allocated now.
BRUSHFIRE_EXPORT(memory_in_use) std::size_t memory_in_use() { return mallinfo().uordblks; }

BRUSHFIRE_EXPORT(about) Reply* about() {
  return answer([](Reply& reply) {
    reply.add(std::string(kVersion));
    for (const Method m : all_methods()) reply.add(std::string(name_of(m)));
  });
}

BRUSHFIRE_EXPORT(mesh_new)
Reply* mesh_new(const double* positions, std::size_t position_count, const std::uint32_t* faces,
                std::size_t face_count) {
  return answer([&](Reply& reply) {
    const Computation listening;
    const auto v = rows_of<Vec3>(positions, position_count, "vertices");
    const auto f = rows_of<Face>(faces, face_count, "faces");
    reply.add_numbers({handle_of(new Surface(Mesh(v, f)))});
  });
}

BRUSHFIRE_EXPORT(mesh_from_lengths)
Reply* mesh_from_lengths(double vertex_count, const std::uint32_t* faces, std::size_t face_count, const double* lengths,
                         std::size_t length_count) {
  return answer([&](Reply& reply) {
    const Computation listening;
    if (!(vertex_count >= 0 && vertex_count < kNoIndex && vertex_count == std::floor(vertex_count))) {
      throw Error(ErrorCode::InvalidArgument, std::to_string(vertex_count) + " is no number of vertices");
    }
    const auto f = rows_of<Face>(faces, face_count, "faces");
    const auto l = rows_of<std::array<double, 3>>(lengths, length_count, "lengths");
    reply.add_numbers({handle_of(new Surface(Mesh::from_lengths(static_cast<Index>(vertex_count), f, l)))});
  });
}

BRUSHFIRE_EXPORT(mesh_shape)
Reply* mesh_shape(const char* name, std::size_t name_size, const double* sizes, std::size_t size_count) {
  return answer([&](Reply& reply) {
    const Computation listening;
    const Shape shape = shape_named({name, name_size}, Sizes({sizes, size_count}));
    reply.add_numbers({handle_of(new Surface(shape.mesh()))});
  });
}

BRUSHFIRE_EXPORT(mesh_free) void mesh_free(Surface* surface) { delete surface; }

BRUSHFIRE_EXPORT(mesh_counts)
Reply* mesh_counts(const Surface* surface) {
  return answer([&](Reply& reply) {
    const Mesh& m = surface->mesh();
    const auto& [low, high] = m.bounds();
    reply.add_numbers({double(m.vertex_count()), double(m.face_count()), double(m.has_positions()), low.x, low.y, low.z,
                       high.x, high.y, high.z});
  });
}

BRUSHFIRE_EXPORT(mesh_arrays)
Reply* mesh_arrays(const Surface* surface) {
  return answer([&](Reply& reply) {
    const auto positions = surface->mesh().positions();
    const auto faces = surface->mesh().faces();
    const auto* const numbers = reinterpret_cast<const double*>(positions.data());
    const auto* const corners = reinterpret_cast<const std::uint32_t*>(faces.data());
    reply.add(std::vector<double>(numbers, numbers + 3 * positions.size()));
    reply.add(std::vector<std::uint32_t>(corners, corners + 3 * faces.size()));
  });
}

BRUSHFIRE_EXPORT(mesh_report)
Reply* mesh_report(const Surface* surface) {
  return answer([&](Reply& reply) {
    const Computation listening;
    const MeshReport& r = surface->mesh().report();
    reply.add_numbers({double(r.vertices),
                       double(r.faces),
                       double(r.edges),
                       double(r.components),
                       double(r.boundary_edges),
                       double(r.nonmanifold_edges),
                       double(r.misoriented_edges),
                       double(r.nonmanifold_vertices),
                       double(r.isolated_vertices),
                       double(r.repeated_index_faces),
                       double(r.zero_area_faces),
                       double(r.zero_length_edges),
                       double(r.duplicate_faces),
                       double(r.duplicate_positions),
                       double(r.near_positions),
                       r.near_tolerance,
                       double(r.looks_like_soup),
                       r.min_edge_length,
                       r.mean_edge_length,
                       r.max_edge_length,
                       r.area,
                       double(r.euler_characteristic),
                       r.length_precision});
    for (std::string& remark : r.remarks()) reply.add(std::move(remark));
  });
}

BRUSHFIRE_EXPORT(mesh_position)
Reply* mesh_position(const Surface* surface, const double* index, std::size_t count, const double* weights,
                     std::size_t weight_count) {
  return answer([&](Reply& reply) {
    std::vector<double> xyz;
    for (const SurfacePoint& p : points_from(surface->mesh(), {{index, count}, {weights, weight_count}})) {
      const Vec3 at = position(surface->mesh(), p);
      xyz.insert(xyz.end(), {at.x, at.y, at.z});
    }
    reply.add(std::move(xyz));
  });
}

// [faces, weights, distances]
BRUSHFIRE_EXPORT(mesh_nearest)
Reply* mesh_nearest(Surface* surface, const double* xyz, std::size_t count) {
  return answer([&](Reply& reply) {
    const Computation listening;
    std::vector<SurfacePoint> points;
    std::vector<double> distances;
    for (const NearestPoint& n : surface->finder()(rows_of<Vec3>(xyz, count, "positions"))) {
      points.push_back(n.point);
      distances.push_back(n.distance);
    }
    add_points(reply, points);
    reply.add(std::move(distances));
  });
}

// [mesh, vertex map, joined]
BRUSHFIRE_EXPORT(mesh_weld)
Reply* mesh_weld(const Surface* surface, double tolerance) {
  return answer([&](Reply& reply) {
    const Computation listening;
    Welded welded = weld(surface->mesh(), tolerance);
    reply.add_numbers({handle_of(new Surface(std::move(welded.mesh))), double(welded.joined)});
    reply.add(std::move(welded.vertex_map));
  });
}

BRUSHFIRE_EXPORT(mesh_subdivided)
Reply* mesh_subdivided(const Surface* surface, int rounds) {
  return answer([&](Reply& reply) {
    const Computation listening;
    const SubdivisionOptions options{rounds != 0 ? SubdivisionRule::LoopOdd : SubdivisionRule::Midpoint};
    reply.add_numbers({handle_of(new Surface(subdivided(surface->mesh(), options).mesh()))});
  });
}

BRUSHFIRE_EXPORT(cut_new)
Reply* cut_new(const Surface* surface, const double* vertices, std::size_t vertex_count, const double* faces,
               std::size_t face_count, const double* ends, std::size_t end_count) {
  return answer([&](Reply& reply) {
    const Computation listening;
    const Mesh& mesh = surface->mesh();
    Barriers barriers;
    barriers.vertices = numbers_from({vertices, vertex_count}, "vertex", mesh.vertex_count());
    barriers.faces = numbers_from({faces, face_count}, "face", mesh.face_count());
    const std::vector<Index> e = numbers_from({ends, end_count}, "vertex", mesh.vertex_count());
    if (e.size() % 2 != 0) throw Error(ErrorCode::InvalidArgument, "edges are pairs of vertices");
    for (std::size_t k = 0; k < e.size(); k += 2) barriers.edges.push_back({e[k], e[k + 1]});
    auto result = std::make_unique<CutMesh>(cut(mesh, barriers));
    reply.add(result->original_vertex);
    reply.add(result->original_face);
    reply.add_signed(result->cut_face);
    auto cut_surface = std::make_unique<Surface>(result->mesh);
    reply.add_numbers({handle_of(cut_surface.release()), handle_of(result.release())});
  });
}

BRUSHFIRE_EXPORT(cut_free) void cut_free(CutMesh* cut) { delete cut; }

// [distances, sources], each of the nearest copy
BRUSHFIRE_EXPORT(cut_values_to_original)
Reply* cut_values_to_original(const CutMesh* cut, const double* values, std::size_t count, const std::int32_t* sources,
                              std::size_t source_count) {
  return answer([&](Reply& reply) {
    const std::span given(values, count);
    if (source_count == 0) return reply.add(cut->to_original(given));
    std::vector<double> distance;
    std::vector<Index> source;
    cut->to_original(given, {reinterpret_cast<const Index*>(sources), source_count}, distance, source);
    reply.add(std::move(distance));
    reply.add_signed(source);
  });
}

// [faces, weights]
BRUSHFIRE_EXPORT(cut_points_to_original)
Reply* cut_points_to_original(const CutMesh* cut, const double* index, std::size_t count, const double* weights,
                              std::size_t weight_count) {
  return answer([&](Reply& reply) {
    std::vector<SurfacePoint> points = points_from(cut->mesh, {{index, count}, {weights, weight_count}});
    for (SurfacePoint& p : points) p = cut->to_original(p);
    add_points(reply, points);
  });
}

// [faces, weights, which of the given points each one is]
BRUSHFIRE_EXPORT(cut_points_from_original)
Reply* cut_points_from_original(const CutMesh* cut, const Surface* original, const double* index, std::size_t count,
                                const double* weights, std::size_t weight_count) {
  return answer([&](Reply& reply) {
    std::vector<SurfacePoint> points;
    std::vector<std::uint32_t> origin;
    std::uint32_t number = 0;
    for (const SurfacePoint& p : points_from(original->mesh(), {{index, count}, {weights, weight_count}})) {
      for (const SurfacePoint& side : cut->from_original(original->mesh(), p)) {
        points.push_back(side);
        origin.push_back(number);
      }
      ++number;
    }
    add_points(reply, points);
    reply.add(std::move(origin));
  });
}

}  // namespace brushfire::js
