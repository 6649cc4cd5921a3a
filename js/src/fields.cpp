// Cells, samples, matrices, gradients, comparison and certificates.
#include "curves.h"

#include <brushfire/core/error.h>
#include <brushfire/queries/certify.h>
#include <brushfire/queries/compare.h>
#include <brushfire/queries/curve_sides.h>
#include <brushfire/queries/distance_matrix.h>
#include <brushfire/queries/gradient.h>
#include <brushfire/queries/sampling.h>
#include <brushfire/queries/voronoi.h>

#include <cmath>

namespace brushfire::js {
namespace {

// Rows or columns: all vertices where `all`.
std::vector<Place> places_from(const Places& given) {
  if (!given.weights.empty() && given.weights.size() != 3 * given.index.size()) {
    throw Error(ErrorCode::InvalidArgument, "one triple of weights per place is needed");
  }
  std::vector<Place> places;
  for (std::size_t k = 0; k < given.index.size(); ++k) {
    if (given.is_vertex(k)) {
      places.emplace_back(given.number(k));
    } else {
      const double* const w = given.weights.data() + 3 * k;
      places.emplace_back(SurfacePoint{given.number(k), {w[0], w[1], w[2]}});
    }
  }
  return places;
}

template <class T>
void add_matrix(Reply& reply, const Mesh& mesh, brushfire::Places rows, brushfire::Places columns,
                const MatrixOptions& options) {
  reply.add(distance_matrix<T>(mesh, rows, columns, options));
}

std::vector<double> measure(const ErrorMeasure& m) {
  return {m.mean, m.root_mean_square, m.max, m.max_vertex == kNoIndex ? -1.0 : double(m.max_vertex)};
}

}  // namespace

// [distance, source, area; pairs of sources; curves]
BRUSHFIRE_EXPORT(voronoi_run)
Reply* voronoi_run(const Surface* surface, const double* index, std::size_t count, const double* weights,
                   std::size_t weight_count, const double* offsets, std::size_t offset_count, const double* sizes,
                   std::size_t size_count, const char* method, std::size_t method_size, const char* bound,
                   std::size_t bound_size, const char* precision, std::size_t precision_size, const double* numbers,
                   std::size_t number_count) {
  return answer([&](Reply& reply) {
    const Mesh& mesh = surface->mesh();
    Computation computation;
    const DistanceOptions options = computation.options({method, method_size}, {bound, bound_size},
                                                        {precision, precision_size}, {numbers, number_count});
    VoronoiDiagram d = voronoi(
        mesh,
        sources_from(mesh, {{index, count}, {weights, weight_count}}, {{offsets, offset_count}, {sizes, size_count}}),
        options);
    std::vector<std::uint32_t> pairs;
    std::vector<SurfacePath> borders;
    for (VoronoiBorder& b : d.borders) {
      pairs.insert(pairs.end(), b.sources.begin(), b.sources.end());
      borders.push_back(std::move(b.line));
    }
    reply.add(std::move(d.distance));
    reply.add_signed(d.source);
    reply.add(std::move(d.area));
    reply.add(std::move(pairs));
    add_curves(reply, mesh, borders);
  });
}

BRUSHFIRE_EXPORT(signed_distance_run)
Reply* signed_distance_run(const Surface* surface, const double* index, std::size_t count, const double* weights,
                           std::size_t weight_count, const double* offsets, std::size_t offset_count,
                           const double* sizes, std::size_t size_count, const char* method, std::size_t method_size,
                           const char* bound, std::size_t bound_size, const char* precision, std::size_t precision_size,
                           const double* numbers, std::size_t number_count) {
  return answer([&](Reply& reply) {
    const Mesh& mesh = surface->mesh();
    Computation computation;
    const DistanceOptions options = computation.options({method, method_size}, {bound, bound_size},
                                                        {precision, precision_size}, {numbers, number_count});
    const std::vector<Source> curves =
        sources_from(mesh, {{index, count}, {weights, weight_count}}, {{offsets, offset_count}, {sizes, size_count}});
    reply.add(signed_distance(mesh, curves, options));
  });
}

// [covering radius; vertices, separation; distance, nearest]
BRUSHFIRE_EXPORT(farthest_points_run)
Reply* farthest_points_run(const Surface* surface, double wanted, const double* first, std::size_t first_count,
                           const char* method, std::size_t method_size, const char* bound, std::size_t bound_size,
                           const char* precision, std::size_t precision_size, const double* numbers,
                           std::size_t number_count) {
  return answer([&](Reply& reply) {
    const Mesh& mesh = surface->mesh();
    Computation computation;
    const DistanceOptions options = computation.options({method, method_size}, {bound, bound_size},
                                                        {precision, precision_size}, {numbers, number_count});
    if (!(wanted >= 0 && wanted < kNoIndex && wanted == std::floor(wanted))) {
      throw Error(ErrorCode::InvalidArgument, std::to_string(wanted) + " is no number of samples");
    }
    Samples s = farthest_points(mesh, static_cast<Index>(wanted),
                                numbers_from({first, first_count}, "vertex", mesh.vertex_count()), options);
    reply.add_numbers({s.covering_radius});
    reply.add(std::move(s.vertices));
    reply.add(std::move(s.separation));
    reply.add(std::move(s.distance));
    reply.add_signed(s.nearest);
  });
}

BRUSHFIRE_EXPORT(matrix_run)
Reply* matrix_run(const Surface* surface, int all_rows, const double* rows, std::size_t row_count,
                  const double* row_weights, std::size_t row_weight_count, int all_columns, const double* columns,
                  std::size_t column_count, const double* column_weights, std::size_t column_weight_count, int floats,
                  const char* method, std::size_t method_size, const char* bound, std::size_t bound_size,
                  const char* precision, std::size_t precision_size, const double* numbers, std::size_t number_count) {
  return answer([&](Reply& reply) {
    Computation computation;
    MatrixOptions options;
    options.distance = computation.options({method, method_size}, {bound, bound_size}, {precision, precision_size},
                                           {numbers, number_count});
    const std::vector<Place> r = places_from({{rows, row_count}, {row_weights, row_weight_count}});
    const std::vector<Place> c = places_from({{columns, column_count}, {column_weights, column_weight_count}});
    const brushfire::Places from = all_rows != 0 ? std::nullopt : brushfire::Places(r);
    const brushfire::Places to = all_columns != 0 ? std::nullopt : brushfire::Places(c);
    if (floats != 0) {
      add_matrix<float>(reply, surface->mesh(), from, to, options);
    } else {
      add_matrix<double>(reply, surface->mesh(), from, to, options);
    }
  });
}

// [row starts, columns, values]
BRUSHFIRE_EXPORT(within_run)
Reply* within_run(const Surface* surface, double radius, int all_rows, const double* rows, std::size_t row_count,
                  const double* row_weights, std::size_t row_weight_count, const char* method, std::size_t method_size,
                  const char* bound, std::size_t bound_size, const char* precision, std::size_t precision_size,
                  const double* numbers, std::size_t number_count) {
  return answer([&](Reply& reply) {
    Computation computation;
    MatrixOptions options;
    options.distance = computation.options({method, method_size}, {bound, bound_size}, {precision, precision_size},
                                           {numbers, number_count});
    const std::vector<Place> r = places_from({{rows, row_count}, {row_weights, row_weight_count}});
    const brushfire::Places from = all_rows != 0 ? std::nullopt : brushfire::Places(r);
    SparseMatrix<double> m = distances_within<double>(surface->mesh(), radius, from, options);
    reply.add(std::vector<std::uint32_t>(m.row_start.begin(), m.row_start.end()));
    reply.add(std::move(m.column));
    reply.add(std::move(m.value));
  });
}

BRUSHFIRE_EXPORT(gradients_run)
Reply* gradients_run(const Surface* surface, const double* values, std::size_t count) {
  return answer([&](Reply& reply) {
    const Computation listening;
    std::vector<double> flat;
    for (const Vec3& g : face_gradients(surface->mesh(), {values, count})) flat.insert(flat.end(), {g.x, g.y, g.z});
    reply.add(std::move(flat));
  });
}

BRUSHFIRE_EXPORT(vertex_areas_run)
Reply* vertex_areas_run(const Surface* surface) {
  return answer([&](Reply& reply) { reply.add(vertex_areas(surface->mesh())); });
}

// [counts and single numbers; absolute, relative, weighted absolute, weighted relative]
BRUSHFIRE_EXPORT(compare_run)
Reply* compare_run(const double* field, std::size_t count, const double* reference, std::size_t reference_count,
                   const double* weights, std::size_t weight_count) {
  return answer([&](Reply& reply) {
    const FieldComparison c = compare_fields({field, count}, {reference, reference_count}, {weights, weight_count});
    reply.add_numbers({double(c.compared), double(c.zero_reference), double(c.missing), double(c.surplus),
                       double(c.unreached_in_both), c.mean_signed_relative, c.max_at_zero_reference,
                       double(c.has_weights)});
    for (const ErrorMeasure& m : {c.absolute, c.relative, c.weighted_absolute, c.weighted_relative}) {
      reply.add(measure(m));
    }
  });
}

// [counts and single numbers; lower, upper, proven error; finding]
BRUSHFIRE_EXPORT(certify_run)
Reply* certify_run(const Surface* surface, const double* field, std::size_t field_count, const double* index,
                   std::size_t count, const double* weights, std::size_t weight_count, const double* offsets,
                   std::size_t offset_count, const double* sizes, std::size_t size_count, double tolerance,
                   double within, double max_distance, int watched) {
  return answer([&](Reply& reply) {
    const Mesh& mesh = surface->mesh();
    Computation computation;
    CertifyOptions options;
    options.tolerance = tolerance;
    options.within = within;
    options.max_distance = max_distance;
    if (watched != 0) options.progress = computation.progress();
    Certificate c = certify(
        mesh, {field, field_count},
        sources_from(mesh, {{index, count}, {weights, weight_count}}, {{offsets, offset_count}, {sizes, size_count}}),
        options);
    reply.add_numbers({double(c.proven_wrong()), double(c.possible), double(c.too_short), double(c.too_long),
                       double(c.not_reachable), double(c.not_reached), double(c.not_a_number), c.least_within,
                       c.worst_vertex == kNoIndex ? -1.0 : double(c.worst_vertex), c.max_gap});
    std::vector<std::uint8_t> finding;
    for (const Finding f : c.finding) finding.push_back(static_cast<std::uint8_t>(f));
    reply.add(std::move(c.lower));
    reply.add(std::move(c.upper));
    reply.add(std::move(c.proven_error));
    reply.add(std::move(finding));
  });
}

}  // namespace brushfire::js
