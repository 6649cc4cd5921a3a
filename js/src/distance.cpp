// Distance fields, and what is asked of one that was kept.
#include "surface.h"

#include <brushfire/core/error.h>
#include <brushfire/solvers/window_field.h>

namespace brushfire::js {

using Windows = std::shared_ptr<const WindowField>;

// [method; max_error_bound, reached, beyond_radius, unreachable, updates, field; distance, source, error bound; target
// distance, target source]. keep: 0 nothing, 1 paths to vertices and targets, 2 everything.
BRUSHFIRE_EXPORT(distance_run)
Reply* distance_run(Surface* surface, const double* index, std::size_t count, const double* weights,
                    std::size_t weight_count, const double* offsets, std::size_t offset_count, const double* sizes,
                    std::size_t size_count, const double* target_index, std::size_t target_count,
                    const double* target_weights, std::size_t target_weight_count, const char* method,
                    std::size_t method_size, const char* bound, std::size_t bound_size, const char* precision,
                    std::size_t precision_size, const double* numbers, std::size_t number_count, int keep) {
  return answer([&](Reply& reply) {
    const Mesh& mesh = surface->mesh();
    Computation computation;
    DistanceOptions options = computation.options({method, method_size}, {bound, bound_size},
                                                  {precision, precision_size}, {numbers, number_count});
    options.keep_paths = keep == 1;
    options.keep_windows = keep == 2;
    options.targets = targets_from(mesh, {{target_index, target_count}, {target_weights, target_weight_count}});
    const std::vector<Source> sources =
        sources_from(mesh, {{index, count}, {weights, weight_count}}, {{offsets, offset_count}, {sizes, size_count}});
    DistanceField field = surface->solver().distance(sources, options);
    if (keep != 0 && !field.windows) {
      throw Error(ErrorCode::InvalidArgument, "fields are kept of the methods exact and windows only");
    }
    const double kept = field.windows ? handle_of(new Windows(std::move(field.windows))) : 0;
    reply.add(std::string(name_of(field.method)));
    reply.add_numbers({field.max_error_bound, double(field.reached), double(field.beyond_radius),
                       double(field.unreachable), double(field.updates), kept});
    reply.add(std::move(field.distance));
    reply.add_signed(field.source);
    reply.add(std::move(field.error_bound));
    reply.add(std::move(field.target_distance));
    reply.add_signed(field.target_source);
  });
}

BRUSHFIRE_EXPORT(distance_set_up)
Reply* distance_set_up(Surface* surface, const char* method, std::size_t method_size, const char* bound,
                       std::size_t bound_size, const char* precision, std::size_t precision_size, const double* numbers,
                       std::size_t number_count) {
  return answer([&](Reply&) {
    Computation computation;
    surface->solver().set_up(computation.options({method, method_size}, {bound, bound_size},
                                                 {precision, precision_size}, {numbers, number_count}));
  });
}

BRUSHFIRE_EXPORT(field_free) void field_free(Windows* field) { delete field; }

// [distance, source] at places
BRUSHFIRE_EXPORT(field_values)
Reply* field_values(const Windows* field, const double* index, std::size_t count, const double* weights,
                    std::size_t weight_count) {
  return answer([&](Reply& reply) {
    const Computation listening;
    std::vector<double> distance;
    std::vector<Index> source;
    Poll poll;
    const Mesh& mesh = (*field)->mesh();
    for (const SurfacePoint& p : targets_from(mesh, {{index, count}, {weights, weight_count}})) {
      poll();
      const WindowField::Value value = p.is_nowhere() ? WindowField::Value{} : (*field)->value(p);
      distance.push_back(value.distance);
      source.push_back(value.source);
    }
    reply.add(std::move(distance));
    reply.add_signed(source);
  });
}

}  // namespace brushfire::js
