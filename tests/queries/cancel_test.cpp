// Everything that takes long listens to the token of its thread.
#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/core/parallel.h>
#include <brushfire/figure/render.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/delaunay.h>
#include <brushfire/mesh/nearest_point.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/mesh/subdivide.h>
#include <brushfire/queries/curved_isolines.h>
#include <brushfire/queries/distance_matrix.h>
#include <brushfire/queries/gradient.h>
#include <brushfire/queries/isolines.h>
#include <brushfire/queries/sampling.h>
#include <brushfire/queries/straightest.h>
#include <brushfire/queries/voronoi.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <string>

namespace brushfire {
namespace {

bool stops(const std::function<void()>& run) {
  CancelToken token;
  token.cancel();
  const CancelScope listen(&token);
  try {
    run();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::Cancelled);
    return true;
  }
  return false;
}

std::string obj_of(const Shape& shape) {
  std::string text;
  for (const Vec3& p : shape.positions) {
    text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  }
  for (const Face& t : shape.faces) {
    text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
  }
  return text;
}

TEST(Cancel, ScopesNestAndTheInnermostCounts) {
  EXPECT_EQ(current_cancel_token(), nullptr);
  CancelToken outer, inner;
  const CancelScope first(&outer);
  {
    const CancelScope second(&inner);
    EXPECT_EQ(current_cancel_token(), &inner);
    const CancelScope third(nullptr);
    EXPECT_EQ(current_cancel_token(), &inner);
  }
  EXPECT_EQ(current_cancel_token(), &outer);
  outer.cancel();
  EXPECT_THROW(stop_if_cancelled(), Error);
}

TEST(Cancel, ThreadsThatHelpListenToWhatTheirCallerListensTo) {
  CancelToken token;
  const CancelScope listen(&token);
  std::atomic<int> listening{0};
  parallel_for(64, 3, [&](unsigned, std::size_t) { listening += current_cancel_token() == &token; });
  EXPECT_EQ(listening, 64);
}

TEST(Cancel, ShapesListen) {
  EXPECT_TRUE(stops([] { shapes::plane(100, 100); }));
  EXPECT_TRUE(stops([] { shapes::cube(60); }));
  EXPECT_TRUE(stops([] { shapes::icosphere(6); }));
  EXPECT_TRUE(stops([] { shapes::latlong_sphere(100, 100); }));
  EXPECT_TRUE(stops([] { shapes::cone(100, 100); }));
  EXPECT_TRUE(stops([] { shapes::cylinder(100, 100); }));
  EXPECT_TRUE(stops([] { shapes::torus(100, 100); }));
  EXPECT_TRUE(stops([] { shapes::folded_sphere(6); }));
  EXPECT_TRUE(stops([] { shapes::book(100, 10, 10); }));
  EXPECT_TRUE(stops([] { shapes::bow_tie(100, 100); }));
  EXPECT_TRUE(stops([] { shapes::delaunay_square(20, 5000); }));
}

TEST(Cancel, WhatIsDerivedOfAMeshListensAndIsBuiltTheNextTime) {
  const Shape shape = shapes::saddle(100);
  const Mesh mesh = shape.mesh();
  EXPECT_TRUE(stops([&] { shape.mesh(); }));
  EXPECT_TRUE(stops([&] { mesh.lengths(); }));
  EXPECT_TRUE(stops([&] { mesh.opposite(); }));
  EXPECT_TRUE(stops([&] { mesh.report(); }));
  EXPECT_TRUE(stops([&] { NearestPointFinder{mesh}; }));
  EXPECT_TRUE(stops([&] { subdivided(mesh, {}); }));
  EXPECT_EQ(mesh.report().components, 1u);
}

TEST(Cancel, ReadingTextListens) {
  const std::string text = obj_of(shapes::saddle(100));
  EXPECT_TRUE(stops([&] { read_mesh(std::as_bytes(std::span(text)), "a.obj"); }));
}

TEST(Cancel, SetUpAndSolvingListenAndTheSolverIsGoodAfterwards) {
  const Mesh mesh = shapes::saddle(100).mesh();
  const Source source{vertex_point(mesh, 0)};
  for (const Method method : all_methods()) {
    DistanceOptions options;
    options.method = method;
    DistanceSolver solver(mesh);
    EXPECT_TRUE(stops([&] { solver.set_up(options); }) || method == Method::Dijkstra) << name_of(method);
    EXPECT_TRUE(stops([&] { solver.distance(std::span(&source, 1), options); })) << name_of(method);
    solver.set_up(options);
    EXPECT_TRUE(stops([&] { solver.distance(std::span(&source, 1), options); })) << name_of(method);
    CancelToken token;
    token.cancel();
    options.cancel = &token;
    EXPECT_THROW(solver.distance(std::span(&source, 1), options), Error) << name_of(method);
    options.cancel = nullptr;
    EXPECT_EQ(solver.distance(std::span(&source, 1), options).distance,
              distance(mesh, std::span(&source, 1), options).distance)
        << name_of(method);
  }
}

TEST(Cancel, QueriesListen) {
  const Mesh mesh = shapes::saddle(100).mesh();
  const Source source{vertex_point(mesh, 0)};
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_windows = true;
  const DistanceField field = distance(mesh, std::span(&source, 1), options);
  const std::vector<double> levels = levels_between(field.distance, 50);
  EXPECT_TRUE(stops([&] { isolines(mesh, field.distance, levels); }));
  EXPECT_TRUE(stops([&] { curved_isolines(*field.windows, levels, 1e-3); }));
  EXPECT_TRUE(stops([&] { face_gradients(mesh, field.distance); }));
  EXPECT_TRUE(stops([&] { farthest_points(mesh, 100, {}, {}); }));
  EXPECT_TRUE(stops([&] { log_map(mesh, source.point, kInfinity); }));
  EXPECT_TRUE(stops([&] { voronoi(mesh, std::span(&source, 1), {}); }));
  EXPECT_TRUE(stops([&] { distances_within<float>(mesh, 0.5, std::nullopt, {}); }));
}

TEST(Cancel, PicturesListen) {
  Panel panel;
  panel.mesh = shapes::saddle(20).mesh();
  const std::vector<Panel> panels{panel};
  EXPECT_TRUE(stops([&] { render(panels, {}); }));
  EXPECT_TRUE(stops([&] { encode_png(Image(2000, 2000)); }));
}

// ---- guards

std::string refusal(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::TooLarge) << e.what();
    return e.what();
  }
  return "";
}

TEST(Guards, SayTheSizeThatTheyRefuse) {
  const std::string shape = refusal([] { shapes::plane(40000, 15000); });
  const Mesh mesh = shapes::saddle(10).mesh();
  const std::vector<double> values(mesh.vertex_count(), 0);
  std::vector<double> rising(mesh.vertex_count());
  for (std::size_t v = 0; v < rising.size(); ++v) rising[v] = static_cast<double>(v);
  EXPECT_EQ(refusal([&] { levels_every(rising, 1e-9); }),
            "a step of 1e-09 between 0 and 120 gives 1.2e+11 levels: a million is the most");
  if (!shape.empty()) {  // a machine that has 58 GB left makes it
    EXPECT_NE(shape.find("a shape of 600055001 vertices and 1200000000 faces needs 57.6 GB, but"), std::string::npos)
        << shape;
  }
}

}  // namespace
}  // namespace brushfire
