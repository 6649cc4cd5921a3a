// Inputs from a seeded generator that gives the same numbers on every platform.
#include "kernels.h"

#include <brushfire/core/detail/bucket_queue.h>
#include <brushfire/core/detail/random.h>
#include <brushfire/mesh/detail/locality_order.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/nearest_point.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/isolines.h>
#include <brushfire/solvers/carried_source/detail/grouped_rows.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/fast_marching/detail/fronts.h>
#include <brushfire/solvers/windows/algebra/envelope.h>
#include <brushfire/solvers/windows/algebra/merge.h>
#include <brushfire/solvers/windows/algebra/propagate.h>

#include <memory>
#include <numeric>

namespace brushfire::benchmark {
namespace {

using windows::Window;

constexpr Index kLevels = 5;  // of the folded sphere: 10242 vertices, 20480 faces
constexpr std::size_t kVertices = 10242, kFaces = 20480;
constexpr std::size_t kLookUps = 4096, kWindows = 4096, kTriangles = 8192, kPushes = 40960, kList = 64;

Mesh scan() { return shapes::folded_sphere(kLevels).mesh(); }

DistanceField solved(DistanceSolver& solver, const DistanceOptions& options) {
  const Source source{vertex_point(solver.mesh(), 0)};
  return solver.distance({&source, 1}, options);
}

double sum_of(std::span<const double> values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// A whole field, without its set-up.
Run solve(DistanceOptions options) {
  const auto solver = std::make_shared<DistanceSolver>(scan());
  solver->set_up(options);
  return [=] { return sum_of(solved(*solver, options).distance); };
}

Run solve(Method method, Precision precision = Precision::Double) {
  DistanceOptions options;
  options.method = method;
  options.precision = precision;
  return solve(options);
}

// Sixteen rows of a matrix, without their set-up. (AVX2: callgrind knows no AVX-512.)
Run group_of_rows() {
  struct Prepared {
    Prepared() : rows(scan(), std::vector<Index>{kVertices / 2}), runner(rows) {}
    carried_source::GroupedRows rows;
    carried_source::GroupRunner runner;
  };
  const auto prepared = std::make_shared<Prepared>();
  return [=] {
    double sum = 0;
    prepared->runner.run(prepared->rows.groups().at(0), kInfinity, [&](int, std::span<const float> row) {
      for (const float d : row) sum += static_cast<double>(d);
    });
    return sum;
  };
}

// One at which windows are merged on a mesh as small as this.
Run solve_with_tolerance() {
  DistanceOptions options;
  options.method = Method::Windows;
  options.tolerance = 1e-2;
  return solve(options);
}

// Connectivity, lengths and areas, out of the arrays.
Run connectivity() {
  const auto shape = std::make_shared<Shape>(shapes::folded_sphere(kLevels));
  return [=] {
    const Mesh mesh(shape->positions, shape->faces);
    return mesh.opposite().back() + mesh.corners(0).front() + sum_of(mesh.lengths()) + sum_of(mesh.double_areas());
  };
}

Run order() {
  return [mesh = scan()] { return static_cast<double>(vertex_locality_order(mesh).vertices.back()); };
}

// Rings, or whatever else the method builds before its first field.
Run set_up(Method method, Precision precision) {
  DistanceOptions options;
  options.method = method;
  options.precision = precision;
  const Mesh mesh = scan();
  mesh.opposite();
  mesh.double_areas();
  return [=] {
    DistanceSolver solver(mesh);
    solver.set_up(options);
    return static_cast<double>(solver.mesh().vertex_count());
  };
}

// The circular front's update of separate triangles, one by one.
template <class T>
Run circular_updates() {
  using Front = fast_marching::portable::FrontOverEdge<fast_marching::CircularFront, T>;
  struct Input {
    T length, inverse, x, y, side;
    bool any_order;
    T t1, t2;
  };
  const auto inputs = std::make_shared<std::vector<Input>>();
  Random random(1);
  for (std::size_t i = 0; i < kTriangles; ++i) {
    const double length = random.uniform(0.5, 1.5), x = random.uniform(-0.5, 1.5), y = random.uniform(0.2, 1.2);
    const Vec2 start{random.uniform(-5, 5), -random.uniform(0.1, 20)};
    inputs->push_back({static_cast<T>(length), static_cast<T>(1 / length), static_cast<T>(x), static_cast<T>(y),
                       static_cast<T>(norm(Vec2{x, y})), i % 8 == 0, static_cast<T>(norm(start)),
                       static_cast<T>(norm(start - Vec2{length, 0}))});
  }
  return [=] {
    T sum = 0;
    for (const Input& in : *inputs) {
      const auto front = Front::of(in.length, in.inverse, in.t1, in.t2);
      bool through = false;
      const T value = front.update(in.x, in.y, in.side, in.any_order, through);
      sum += through ? value : in.t1 + in.side;
    }
    return static_cast<double>(sum);
  };
}

windows::Frame frame(Random& random) {
  const double length = random.uniform(0.5, 1.5);
  const Vec2 apex{random.uniform(-0.5, 1.5), random.uniform(0.2, 1.2)};
  return {length, norm(apex), norm(apex - Vec2{length, 0}), apex};
}

Window window(Random& random, double b0, double b1, Index pseudo_source) {
  Window w;
  w.sigma = random.uniform(0, 0.5);
  w.source = {random.uniform(-1, 2), -random.uniform(2, 4)};
  w.b0 = b0;
  w.b1 = b1;
  w.d0 = windows::value_at(w, b0);
  w.d1 = windows::value_at(w, b1);
  w.pseudo_source = pseudo_source;
  return w;
}

// On its own, so that the compiler's choices for the rest of this file do not show in its count.
[[gnu::noinline]] double ends_of_children(const Window& w, const windows::Frame& frame) {
  double sum = 0;
  windows::propagate(
      w, frame, [&](const Window& left) { sum += windows::is_sliver(left) ? 0 : left.d0; },
      [&](const Window& right) { sum += windows::is_sliver(right) ? 0 : right.d1; });
  return sum;
}

// A window enters a triangle and leaves through one or both of the other sides.
Run propagation() {
  struct Input {
    windows::Frame frame;
    Window window;
  };
  const auto inputs = std::make_shared<std::vector<Input>>();
  Random random(2);
  for (std::size_t i = 0; i < kWindows; ++i) {
    const windows::Frame f = frame(random);
    const double b0 = random.uniform(0, 0.6 * f.length);
    inputs->push_back({f, window(random, b0, random.uniform(b0 + 0.1 * f.length, f.length), 0)});
  }
  return [=] {
    double sum = 0;
    for (const auto& [f, w] : *inputs) sum += ends_of_children(w, f);
    return sum;
  };
}

// The lower envelope of lists of overlapping windows on one edge.
Run envelopes() {
  const auto lists = std::make_shared<std::vector<std::vector<Window>>>(kWindows / kList);
  Random random(3);
  for (std::vector<Window>& list : *lists) {
    for (Index i = 0; i < kList; ++i) {
      const double b0 = random.uniform(0, 0.8);
      list.push_back(window(random, b0, random.uniform(b0 + 0.05, 1), i));
    }
  }
  return [=, envelope = std::make_shared<windows::Envelope>()] {
    double sum = 0;
    for (const std::vector<Window>& list : *lists) {
      for (const Window& w : (*envelope)(list)) sum += w.d0;
    }
    return sum;
  };
}

// Two neighbours with nearly the same source become one, or do not.
Run merges() {
  const auto pairs = std::make_shared<std::vector<std::pair<Window, Window>>>();
  Random random(4);
  for (std::size_t i = 0; i < kWindows; ++i) {
    const double joint = random.uniform(0.3, 0.7);
    Window a = window(random, 0, joint, 0);
    Window b = a;
    b.source = a.source + Vec2{random.uniform(0, 1e-3), random.uniform(-1e-3, 1e-3)};
    b.b0 = joint;
    b.b1 = 1;
    b.d1 = windows::value_at(b, b.b1);
    b.sigma += a.d1 - windows::value_at(b, b.b0);
    b.d0 = a.d1;
    b.d1 = windows::value_at(b, b.b1);
    pairs->emplace_back(a, b);
  }
  return [=] {
    windows::MergeBudget budget;
    budget.share = 1e-3;
    double sum = 0;
    for (const auto& [a, b] : *pairs) {
      Window merged = b;
      sum += windows::merge_into(a, merged, 0, budget) ? merged.d0 : 1;
    }
    return sum;
  };
}

// A front: what is taken out pushes two items a little farther back, until all have been pushed.
Run queue() {
  const auto steps = std::make_shared<std::vector<BucketQueue::Bucket>>();
  Random random(5);
  for (std::size_t i = 0; i < kPushes; ++i) {
    steps->push_back(i % 1024 == 0 ? 5000
                                   : static_cast<BucketQueue::Bucket>(random.below(20)));  // a far one now and then
  }
  return [=, queue = std::make_shared<BucketQueue>()] {
    queue->reset();
    queue->push(0, 0);
    double sum = 0;
    Index pushed = 1;
    while (queue->advance()) {
      for (std::size_t i = 0; i < queue->current().size(); ++i) {
        sum += queue->current()[i];
        for (int k = 0; k < 2 && pushed < kPushes; ++k, ++pushed) {
          queue->push(pushed, queue->cursor() + (*steps)[pushed]);
        }
      }
      queue->clear_current();
    }
    return sum;
  };
}

// Of positions near the surface, as landmarks are.
Run nearest_points() {
  const Mesh mesh = scan();
  const auto finder = std::make_shared<NearestPointFinder>(mesh);
  const auto positions = std::make_shared<std::vector<Vec3>>();
  Random random(6);
  for (std::size_t i = 0; i < kLookUps; ++i) {
    const Vec3 p = mesh.positions()[random.below(mesh.vertex_count())];
    positions->push_back(p +
                         Vec3{random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02)});
  }
  return [=] {
    double sum = 0;
    for (const NearestPoint& p : (*finder)(*positions)) sum += p.distance;
    return sum;
  };
}

Run lines() {
  const Mesh mesh = scan();
  DistanceOptions options;
  options.method = Method::Dijkstra;
  DistanceSolver solver(mesh);
  const std::vector<double> field = solved(solver, options).distance;
  const std::vector<double> levels = levels_between(field, 20);
  mesh.opposite();
  return [=] {
    double sum = 0;
    for (const Isoline& line : isolines(mesh, field, levels)) sum += static_cast<double>(line.line.points.size());
    return sum;
  };
}

}  // namespace

std::vector<Kernel> kernels() {
  return {{"circular-update-float", kTriangles, circular_updates<float>},
          {"circular-update-double", kTriangles, circular_updates<double>},
          {"march-float", kVertices, [] { return solve(Method::NovotniKlein, Precision::Float); }},
          {"march-double", kVertices, [] { return solve(Method::NovotniKlein); }},
          {"carried-float", kVertices, [] { return solve(Method::CarriedSource, Precision::Float); }},
          {"carried-group", 16 * kVertices, [] { return group_of_rows(); }},
          {"carried-double", kVertices, [] { return solve(Method::CarriedSource); }},
          {"windows-exact", kVertices, [] { return solve(Method::Exact); }},
          {"windows-1e-2", kVertices, solve_with_tolerance},
          {"window-propagation", kWindows, propagation},
          {"window-envelope", kWindows, envelopes},
          {"window-merge", kWindows, merges},
          {"bucket-queue", kPushes, queue},
          {"nearest-point", kLookUps, nearest_points},
          {"mesh-connectivity", kFaces, connectivity},
          {"locality-order", kVertices, order},
          {"set-up-rings", kVertices, [] { return set_up(Method::NovotniKlein, Precision::Float); }},
          {"set-up-records", kVertices, [] { return set_up(Method::CarriedSource, Precision::Float); }},
          {"isolines", kFaces, lines}};
}

}  // namespace brushfire::benchmark
