// CGAL Surface_mesh_shortest_path behind fork() and a pipe.
#include "third_opinion.h"

#ifdef BRUSHFIRE_HAS_CGAL

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <exception>
#include <utility>

namespace brushfire::benchmark {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Traits = CGAL::Surface_mesh_shortest_path_traits<Kernel, SurfaceMesh>;
using ShortestPath = CGAL::Surface_mesh_shortest_path<Traits>;

// Empty: refused.
std::vector<double> solve(const Mesh& mesh, const SurfacePoint& source) {
  SurfaceMesh surface;
  std::vector<SurfaceMesh::Vertex_index> vertex;
  for (const Vec3& p : mesh.positions()) vertex.push_back(surface.add_vertex({p.x, p.y, p.z}));
  for (const Face& t : mesh.faces()) {
    if (surface.add_face(vertex[t[0]], vertex[t[1]], vertex[t[2]]) == SurfaceMesh::null_face()) return {};
  }
  ShortestPath paths(surface);
  // Weights belong to the source vertices of the face's halfedges, in order; which corner is first is CGAL's choice.
  const SurfaceMesh::Face_index face(source.face);
  const Face& corners = mesh.faces()[source.face];
  std::array<double, 3> weights{};
  auto h = surface.halfedge(face);
  for (double& w : weights) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (vertex[corners[k]] == surface.source(h)) w = source.weights[k];
    }
    h = surface.next(h);
  }
  // A point of an edge is taken from its other end by CGAL 5.5: all distances are exactly those from the mirrored
  // point.
  if (weights[2] == 0 && weights[0] != 0 && weights[1] != 0) std::swap(weights[0], weights[1]);
  if (weights[0] == 0 && weights[1] != 0 && weights[2] != 0) std::swap(weights[1], weights[2]);
  if (weights[1] == 0 && weights[2] != 0 && weights[0] != 0) std::swap(weights[2], weights[0]);
  paths.add_source_point(face, {{weights[0], weights[1], weights[2]}});
  paths.build_sequence_tree();
  std::vector<double> distance;
  for (const auto v : vertex) {
    const double d = surface.is_isolated(v) ? -1 : paths.shortest_distance_to_source_points(v).first;
    distance.push_back(d < 0 ? kInfinity : d);
  }
  return distance;
}

[[noreturn]] void answer(int pipe_end, const Mesh& mesh, const SurfacePoint& source, unsigned seconds) {
  const rlimit time{seconds, seconds}, memory{rlim_t{3} << 30, rlim_t{3} << 30};
  setrlimit(RLIMIT_CPU, &time);
  setrlimit(RLIMIT_AS, &memory);
  std::vector<double> distance;
  try {
    distance = solve(mesh, source);
  } catch (const std::exception&) {
    _exit(2);
  }
  FILE* out = fdopen(pipe_end, "wb");
  std::fwrite(distance.data(), sizeof(double), distance.size(), out);
  std::fclose(out);
  _exit(distance.empty() ? 1 : 0);
}

}  // namespace

Opinion third_opinion(const Mesh& mesh, const SurfacePoint& source, unsigned seconds) {
  Opinion opinion;
  int ends[2];
  if (pipe(ends) != 0) return {"no pipe", {}};
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    answer(ends[1], mesh, source, seconds);
  }
  close(ends[1]);
  FILE* in = fdopen(ends[0], "rb");
  opinion.distance.resize(mesh.vertex_count());
  const std::size_t got = std::fread(opinion.distance.data(), sizeof(double), opinion.distance.size(), in);
  std::fclose(in);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) {
    opinion.verdict = WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL ? "too slow" : "crash";
  } else {
    opinion.verdict = WEXITSTATUS(status) == 0 ? "ok" : WEXITSTATUS(status) == 1 ? "refused" : "exception";
  }
  if (opinion.verdict != "ok" || got != opinion.distance.size()) opinion.distance.clear();
  return opinion;
}

}  // namespace brushfire::benchmark

#else

namespace brushfire::benchmark {
Opinion third_opinion(const Mesh&, const SurfacePoint&, unsigned) { return {"not installed", {}}; }
}  // namespace brushfire::benchmark

#endif
