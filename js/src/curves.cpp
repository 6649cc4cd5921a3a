// Paths, isolines, straightest geodesics, the logarithmic map.
#include "curves.h"

#include <brushfire/core/error.h>
#include <brushfire/queries/curved_isolines.h>
#include <brushfire/queries/isolines.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/shorten.h>
#include <brushfire/queries/straightest.h>

#include <cmath>

namespace brushfire::js {

void add_curves(Reply& reply, const Mesh& mesh, std::span<const SurfacePath> curves) {
  std::vector<std::uint32_t> starts{0};
  std::vector<double> lengths, positions;
  std::vector<std::uint8_t> closed;
  std::vector<SurfacePoint> points;
  for (const SurfacePath& c : curves) {
    points.insert(points.end(), c.points.begin(), c.points.end());
    starts.push_back(static_cast<std::uint32_t>(points.size()));
    lengths.push_back(c.length);
    closed.push_back(c.closed ? 1 : 0);
  }
  if (mesh.has_positions()) {
    positions.reserve(3 * points.size());
    for (const SurfacePoint& p : points) {
      const Vec3 at = position(mesh, p);
      positions.insert(positions.end(), {at.x, at.y, at.z});
    }
  }
  reply.add(std::move(starts));
  reply.add(std::move(lengths));
  reply.add(std::move(closed));
  add_points(reply, points);
  reply.add(std::move(positions));
}

std::vector<SurfacePoint> curve_from(std::span<const std::uint32_t> faces, std::span<const double> weights) {
  if (weights.size() != 3 * faces.size()) {
    throw Error(ErrorCode::InvalidArgument, "a curve has three weights for each of its faces");
  }
  std::vector<SurfacePoint> points;
  points.reserve(faces.size());
  for (std::size_t k = 0; k < faces.size(); ++k) {
    points.push_back({faces[k], {weights[3 * k], weights[3 * k + 1], weights[3 * k + 2]}});
  }
  return points;
}

namespace {

// The curves of isolines(), and for each its level and the place of that in the list.
void add_isolines(Reply& reply, const Mesh& mesh, std::vector<Isoline> lines) {
  std::vector<SurfacePath> curves;
  std::vector<double> levels;
  std::vector<std::uint32_t> numbers;
  for (Isoline& l : lines) {
    levels.push_back(l.level);
    numbers.push_back(l.level_index);
    curves.push_back(std::move(l.line));
  }
  reply.add(std::move(levels));
  reply.add(std::move(numbers));
  add_curves(reply, mesh, curves);
}

}  // namespace

BRUSHFIRE_EXPORT(path_through)
Reply* path_through(Surface* surface, const double* index, std::size_t count, const double* weights,
                    std::size_t weight_count, int closed, int tighten) {
  return answer([&](Reply& reply) {
    const Computation listening;
    const Mesh& mesh = surface->mesh();
    const std::vector<SurfacePoint> places = targets_from(mesh, {{index, count}, {weights, weight_count}});
    SurfacePath path = brushfire::path_through(surface->solver(), places, closed != 0);
    if (tighten != 0 && !path.points.empty()) path = shorten(mesh, path.points, closed != 0);
    add_curves(reply, mesh, std::span(&path, 1));
  });
}

// From the nearest source of a kept field.
BRUSHFIRE_EXPORT(field_paths)
Reply* field_paths(const std::shared_ptr<const WindowField>* field, const double* index, std::size_t count,
                   const double* weights, std::size_t weight_count) {
  return answer([&](Reply& reply) {
    const Computation listening;
    const Mesh& mesh = (*field)->mesh();
    std::vector<SurfacePath> paths;
    for (const SurfacePoint& p : targets_from(mesh, {{index, count}, {weights, weight_count}})) {
      stop_if_cancelled();
      paths.push_back(p.is_nowhere() ? SurfacePath{} : path_to(**field, p));
    }
    add_curves(reply, mesh, paths);
  });
}

BRUSHFIRE_EXPORT(field_isolines)
Reply* field_isolines(const std::shared_ptr<const WindowField>* field, const double* levels, std::size_t level_count,
                      double chord_error) {
  return answer([&](Reply& reply) {
    const Computation listening;
    add_isolines(reply, (*field)->mesh(), curved_isolines(**field, {levels, level_count}, chord_error));
  });
}

BRUSHFIRE_EXPORT(path_along_edges)
Reply* path_along_edges(Surface* surface, const double* index, std::size_t count, const double* weights,
                        std::size_t weight_count, const double* offsets, std::size_t offset_count, const double* sizes,
                        std::size_t size_count, double target) {
  return answer([&](Reply& reply) {
    Computation computation;
    const Mesh& mesh = surface->mesh();
    const std::vector<Index> to = numbers_from(std::span(&target, 1), "vertex", mesh.vertex_count());
    DistanceOptions options;
    options.method = Method::Dijkstra;
    const std::vector<Source> sources =
        sources_from(mesh, {{index, count}, {weights, weight_count}}, {{offsets, offset_count}, {sizes, size_count}});
    const DistanceField field = surface->solver().distance(sources, options);
    const SurfacePath path = edge_path_to(mesh, field, to.front());
    add_curves(reply, mesh, std::span(&path, 1));
  });
}

BRUSHFIRE_EXPORT(path_shortened)
Reply* path_shortened(const Surface* surface, const std::uint32_t* faces, std::size_t count, const double* weights,
                      std::size_t weight_count, int closed) {
  return answer([&](Reply& reply) {
    const Computation listening;
    const SurfacePath path = shorten(surface->mesh(), curve_from({faces, count}, {weights, weight_count}), closed != 0);
    add_curves(reply, surface->mesh(), std::span(&path, 1));
  });
}

BRUSHFIRE_EXPORT(path_length)
Reply* path_length(const Surface* surface, const std::uint32_t* faces, std::size_t count, const double* weights,
                   std::size_t weight_count, int closed) {
  return answer([&](Reply& reply) {
    reply.add_numbers({length_of(surface->mesh(), curve_from({faces, count}, {weights, weight_count}), closed != 0)});
  });
}

// [how it ended; curve]. The direction is an angle, or a vector where that is given.
BRUSHFIRE_EXPORT(trace_run)
Reply* trace_run(const Surface* surface, const double* index, std::size_t count, const double* weights,
                 std::size_t weight_count, double angle, const double* direction, std::size_t components,
                 double length) {
  return answer([&](Reply& reply) {
    const Computation listening;
    const Mesh& mesh = surface->mesh();
    const SurfacePoint from = single_point_from(mesh, {{index, count}, {weights, weight_count}});
    if (components != 0 && components != 3) {
      throw Error(ErrorCode::InvalidArgument, "a direction has three components");
    }
    if (components == 3) angle = angle_of(mesh, from, {direction[0], direction[1], direction[2]});
    const Trace trace = straightest(mesh, from, angle, length);
    const char* end = trace.end == TraceEnd::Length     ? "length"
                      : trace.end == TraceEnd::Boundary ? "boundary"
                                                        : "non-manifold";
    reply.add(std::string(end));
    add_curves(reply, mesh, std::span(&trace.path, 1));
  });
}

// [total angle; radius, angle]
BRUSHFIRE_EXPORT(log_map_run)
Reply* log_map_run(const Surface* surface, const double* index, std::size_t count, const double* weights,
                   std::size_t weight_count, double max_radius) {
  return answer([&](Reply& reply) {
    const Computation listening;
    const SurfacePoint source = single_point_from(surface->mesh(), {{index, count}, {weights, weight_count}});
    LogMap map = log_map(surface->mesh(), source, std::isnan(max_radius) ? kInfinity : max_radius);
    reply.add_numbers({map.total_angle});
    reply.add(std::move(map.radius));
    reply.add(std::move(map.angle));
  });
}

BRUSHFIRE_EXPORT(isolines_run)
Reply* isolines_run(const Surface* surface, const double* values, std::size_t count, const double* levels,
                    std::size_t level_count) {
  return answer([&](Reply& reply) {
    const Computation listening;
    add_isolines(reply, surface->mesh(), isolines(surface->mesh(), {values, count}, {levels, level_count}));
  });
}

BRUSHFIRE_EXPORT(levels_at_every)
Reply* levels_at_every(const double* values, std::size_t count, double step) {
  return answer([&](Reply& reply) { reply.add(levels_every({values, count}, step)); });
}

BRUSHFIRE_EXPORT(levels_in_between)
Reply* levels_in_between(const double* values, std::size_t count, double levels) {
  return answer([&](Reply& reply) {
    if (!(levels >= 0 && levels <= 1e6 && levels == std::floor(levels))) {
      throw Error(ErrorCode::InvalidArgument, std::to_string(levels) + " is no number of levels");
    }
    reply.add(levels_between({values, count}, static_cast<Index>(levels)));
  });
}

}  // namespace brushfire::js
