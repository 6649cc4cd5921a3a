// Names of points and sizes of offsets that said something else than they meant.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/path.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/window_field.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

namespace brushfire {
namespace {

constexpr double kRounding = 1e-12;

DistanceField field_of(const Mesh& mesh, const std::vector<Source>& sources, Method method,
                       std::vector<SurfacePoint> targets = {}) {
  DistanceOptions options;
  options.method = method;
  options.tolerance = 0;
  options.precision = Precision::Double;
  options.targets = std::move(targets);
  return distance(mesh, sources, options);
}

void expect_same_values(const std::vector<double>& a, const std::vector<double>& b, const std::string& where) {
  ASSERT_EQ(a.size(), b.size()) << where;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;
    EXPECT_NEAR(a[i], b[i], kRounding * std::abs(b[i])) << where << ", " << i;
  }
}

// ---- names of points

// `mesh` with a face over every tenth edge that names one of its ends twice.
Mesh with_degenerate_faces(const Shape& shape) {
  std::vector<Face> faces = shape.faces;
  for (std::size_t f = 0; f < shape.faces.size(); f += 10) {
    const auto [a, b, c] = shape.faces[f];
    faces.push_back(f % 20 == 0 ? Face{b, a, b} : Face{c, b, b});
  }
  return Mesh(shape.positions, faces);
}

// Every way to say where a point of the edge of halfedge h is, with faces that name a vertex twice.
std::vector<SurfacePoint> names_of(const Mesh& mesh, Index h, double t) {
  std::vector<SurfacePoint> names;
  const Index v = mesh.from(h), w = mesh.to(h);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Face& face = mesh.faces()[f];
    SurfacePoint p{f, {0, 0, 0}};
    bool has_v = false, has_w = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool first_v = face[k] == v && !has_v, first_w = face[k] == w && !has_w;
      p.weights[k] = first_v ? 1 - t : first_w ? t : 0;
      has_v |= first_v;
      has_w |= first_w;
    }
    if (has_v && has_w) names.push_back(p);
  }
  return names;
}

TEST(NumberCases, APointOfAnEdgeReadsTheSameInWhicheverFaceItIsNamed) {
  const std::vector<Vec3> p{{2, 3, 0}, {0, 3, 0}, {4, 2, 0}};
  const Mesh mesh(p, std::vector<Face>{{0, 1, 2}, {1, 0, 1}});
  const Source in_degenerate{{1, {0.5188047703543305, 0.4811952296456695, 0}}};
  const Vec3 x = position(mesh, in_degenerate.point);
  EXPECT_NEAR(field_of(mesh, {in_degenerate}, Method::Exact).distance[2], norm(x - p[2]), kRounding);
  EXPECT_NEAR(norm(x - p[2]), 3.198, 1e-3);
}

TEST(NumberCases, AllNamesOfAPointOfAnEdgeReadTheSameAsSourceAndAsTargetByEveryMethod) {
  const Mesh mesh = with_degenerate_faces(shapes::saddle(6));
  for (const Method method : all_methods()) {
    if (method == Method::NovotniKlein2002) continue;  // as printed, it makes much of the last bit of a weight
    for (Index h = 0; h < mesh.halfedge_count(); h += 7) {
      if (mesh.from(h) == mesh.to(h)) continue;
      const std::vector<SurfacePoint> names = names_of(mesh, h, 0.3);
      ASSERT_FALSE(names.empty());
      const DistanceField reference = field_of(mesh, {{names[0]}}, method, {names[0]});
      for (const SurfacePoint& name : names) {
        const std::string where = std::string(name_of(method)) + ", face " + std::to_string(name.face);
        expect_same_values(field_of(mesh, {{name}}, method).distance, field_of(mesh, {{names[0]}}, method).distance,
                           where);
        const Source corner{vertex_point(mesh, 0)};
        expect_same_values(field_of(mesh, {corner}, method, {name}).target_distance,
                           field_of(mesh, {corner}, method, {names[0]}).target_distance, where);
      }
    }
  }
}

TEST(NumberCases, PointsOfAnEdgeThatOnlyDegenerateFacesHaveLieOnOneSegment) {
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}};
  const Mesh mesh(p, std::vector<Face>{{0, 1, 0}, {1, 0, 1}});
  for (const Method method : all_methods()) {
    const Source source{{0, {0.1, 0.2, 0.7}}};        // at 0.2
    const SurfacePoint target{1, {0.25, 0.5, 0.25}};  // at 0.5
    const DistanceField field = field_of(mesh, {source}, method, {target});
    EXPECT_NEAR(field.target_distance[0], 0.3, kRounding) << name_of(method);
  }
}

TEST(NumberCases, AllWeightOnOneVertexOfADegenerateFaceIsThatVertex) {
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Mesh mesh(p, std::vector<Face>{{0, 1, 2}, {2, 0, 2}, {1, 1, 1}});
  EXPECT_EQ(locate(mesh, {1, {0.25, 0, 0.75}}).vertex, 2u);
  EXPECT_EQ(locate(mesh, {1, {0.25, 0.5, 0.25}}).halfedge, 2u);  // of face 0, which has an inside
  EXPECT_EQ(locate(mesh, {2, {0.25, 0.5, 0.25}}).vertex, 1u);
}

// Its distance is a small difference of large lengths, of which the bound knows nothing: the source sees it.
TEST(NumberCases, AVertexBesideTheOppositeEdgeOfANeedleIsAsFarAsTheChord) {
  for (const double altitude : {1e-3, 1e-6, 1e-9}) {
    for (const double share : {0.3, 0.37, 0.61}) {
      const std::vector<Vec3> p{
          {0.1, 0.2, 0.3}, {0.7, 0.9, 0.4}, {0.1 + share * 0.6, 0.2 + share * 0.7, 0.3 + share * 0.1 + altitude}};
      const Mesh mesh(p, std::vector<Face>{{0, 1, 2}});
      for (const double beside : {0.0, 1e-2, 1.0, 1e2}) {
        const double w = share + beside * altitude;
        const Source source{{0, {1 - w, w, 0}}};
        DistanceOptions options;
        options.method = Method::Exact;
        const DistanceField field = distance(mesh, std::span(&source, 1), options);
        long double square = 0;
        const auto along = [&](double Vec3::* axis) {
          const long double a = 1 - w, b = w;
          const long double step = a * (static_cast<long double>(p[0].*axis) - p[2].*axis) +
                                   b * (static_cast<long double>(p[1].*axis) - p[2].*axis);
          square += step * step;
        };
        along(&Vec3::x), along(&Vec3::y), along(&Vec3::z);
        const auto chord = static_cast<double>(std::sqrt(square));
        EXPECT_LE(std::abs(field.distance[2] - chord), field.error_bound[2] + 1e-9 * kRounding * chord) << altitude;
        EXPECT_NEAR(field.distance[2], chord, 2e-12 * chord) << altitude << ", " << share << ", " << beside;
      }
    }
  }
}

// ---- targets in no face

TEST(NumberCases, ATargetInNoFaceReadsInfinityAndTheOthersWhatTheyReadWithoutIt) {
  Shape shape = shapes::saddle(5);
  shape.positions.push_back({7, 7, 7});
  const Mesh mesh = shape.mesh();
  const auto alone = static_cast<Index>(mesh.vertex_count() - 1);
  const Source source{vertex_point(mesh, 0)};
  const SurfacePoint nowhere = target_point(mesh, alone), there = target_point(mesh, 20);
  EXPECT_TRUE(nowhere.is_nowhere());
  for (const Method method : all_methods()) {
    const double expected = field_of(mesh, {source}, method, {there}).target_distance[0];
    const DistanceField field = field_of(mesh, {source}, method, {nowhere, there, nowhere, there});
    EXPECT_EQ(field.target_distance, (std::vector<double>{kInfinity, expected, kInfinity, expected}));
    EXPECT_EQ(field.target_source, (std::vector<Index>{kNoIndex, 0, kNoIndex, 0}));
    EXPECT_EQ(field_of(mesh, {source}, method, {nowhere}).target_distance, (std::vector<double>{kInfinity}));
  }
  EXPECT_TRUE(PathFinder(mesh).between(source.point, nowhere).points.empty());
  EXPECT_EQ(PathFinder(mesh).through(std::vector{nowhere, source.point}).length, kInfinity);
}

TEST(NumberCases, AVertexInNoFaceIsStillNoSource) {
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 3, 3}};
  const Mesh mesh(p, std::vector<Face>{{0, 1, 2}});
  EXPECT_THROW(vertex_point(mesh, 3), Error);
  EXPECT_THROW(target_point(mesh, 4), Error);
}

// ---- offsets

TEST(NumberCases, AFiniteOffsetOfAnySizeIsAddedByEveryMethod) {
  for (const double size : {1e-300, 0.01, 1.0, 1e297, 1e298}) {
    const std::vector<Vec3> p{{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
    const Mesh mesh(p, std::vector<Face>{{0, 1, 2}});
    for (const double offset : {1e308, -1e308, 1.7e308, 1e40, -1e40, 1e9, 3.0}) {
      for (const Method method : all_methods()) {
        for (const Precision precision : {Precision::Float, Precision::Double}) {
          DistanceOptions options;
          options.method = method;
          options.precision = precision;
          const Source source{vertex_point(mesh, 0), offset};
          const DistanceField field = distance(mesh, std::span(&source, 1), options);
          EXPECT_EQ(field.distance[0], offset) << name_of(method) << " " << size;
          const double error = method == Method::Heat ? 0.4 : 1e-6;  // on one face it approximates nothing
          EXPECT_NEAR(field.distance[1], offset + size, error * size + kRounding * std::abs(offset))
              << name_of(method) << ", size " << size << ", offset " << offset;
          EXPECT_EQ(field.reached, 3u);
        }
      }
    }
  }
}

// However small beside the lengths: it is not to be lost in a difference with them.
TEST(NumberCases, EverySourceReadsItsOffsetToTheLastBit) {
  const Shape shape = shapes::saddle(5);
  for (const double size : {1e-300, 1.0, 1e290}) {
    std::vector<Vec3> positions = shape.positions;
    for (Vec3& p : positions) p = size * p;
    const Mesh mesh(positions, shape.faces);
    for (const double share : {1e-290, 1e-30, 1e-17, 1e-9, 0.01}) {
      for (const double offset : {size * share, -size * share}) {
        if (std::abs(offset) < std::numeric_limits<double>::min()) continue;
        for (const Method method : all_methods()) {
          DistanceOptions options;
          options.method = method;
          options.precision = Precision::Double;
          const std::vector<Source> sources{{vertex_point(mesh, 0), offset}, {vertex_point(mesh, 17), 1.1 * offset}};
          const DistanceField field = distance(mesh, sources, options);
          EXPECT_EQ(field.distance[0], offset) << name_of(method) << " " << size;
          EXPECT_EQ(field.distance[17], 1.1 * offset) << name_of(method) << " " << size;
        }
      }
    }
  }
}

// Two saddles that do not touch, of different size.
Mesh two_pieces(double size) {
  Shape shape = shapes::saddle(4);
  const auto vertices = static_cast<Index>(shape.positions.size());
  for (Index v = 0; v < vertices; ++v) shape.positions.push_back(3 * shape.positions[v] + Vec3{100, 0, 0});
  const std::size_t faces = shape.faces.size();
  for (std::size_t f = 0; f < faces; ++f) {
    const auto [a, b, c] = shape.faces[f];
    shape.faces.push_back({a + vertices, b + vertices, c + vertices});
  }
  for (Vec3& p : shape.positions) p = size * p;
  return shape.mesh();
}

TEST(NumberCases, OffsetsOfBothSignsAndAnySizesReadTheLeastSumInEveryComponent) {
  for (const double size : {1e-3, 1.0, 1e6}) {
    const Mesh mesh = two_pieces(size);
    const Index half = mesh.vertex_count() / 2;
    for (const auto& [low, high] : std::vector<std::pair<double, double>>{
             {-1.6e308, 1.6e308}, {0, 1e308}, {-1e308, 0}, {-1e40, 1e40}, {1e308, 1e308}, {0, 1e40}, {1e10, 0}}) {
      for (const Method method : all_methods()) {
        for (const Precision precision : {Precision::Float, Precision::Double}) {
          DistanceOptions options;
          options.method = method;
          options.tolerance = 0;
          options.precision = precision;
          // In the first piece `low` and one that it dominates, in the second `high` alone.
          const std::vector<Source> sources{{vertex_point(mesh, 0), low},
                                            {vertex_point(mesh, 12), high > low ? high : low + 100 * size},
                                            {vertex_point(mesh, half), high}};
          const DistanceField field = distance(mesh, sources, options);
          const std::string where = std::string(name_of(method)) + ", " + std::to_string(size) + ", " +
                                    std::to_string(low) + ", " + std::to_string(high);
          for (const Index piece : {Index{0}, half}) {
            const Source one{vertex_point(mesh, piece)};
            const DistanceField plain = distance(mesh, std::span(&one, 1), options);
            const double offset = piece == 0 ? low : high;
            for (Index v = piece; v < piece + half; ++v) {
              if (field.source[v] == 1) continue;  // low + 100 * size is low
              EXPECT_NEAR(field.distance[v], offset + plain.distance[v],
                          1e-6 * plain.distance[v] + kRounding * std::abs(offset))
                  << where << ", vertex " << v;
            }
          }
          EXPECT_EQ(field.reached, mesh.vertex_count()) << where;
        }
      }
    }
  }
}

// All vertices at one place: there is no length beside which an offset could be large.
TEST(NumberCases, OffsetsOnAMeshWithoutSizeAreNoTies) {
  Shape shape = shapes::plane(3, 3, 1, 1);
  for (Vec3& p : shape.positions) p = {3, 0, 0};
  const Mesh mesh = shape.mesh();
  const std::vector<Source> sources{
      {{9, {0, 0.25, 0.75}}, -38512.5}, {{15, {0.25, 0.5, 0.25}}, -330313.75}, {vertex_point(mesh, 2), 129603}};
  for (const Method method : all_methods()) {
    const DistanceField field = field_of(mesh, sources, method);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      EXPECT_EQ(field.distance[v], -330313.75) << name_of(method);
      EXPECT_EQ(field.source[v], 1u) << name_of(method);
    }
  }
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_windows = true;
  const DistanceField field = distance(mesh, sources, options);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_EQ(path_to(*field.windows, vertex_point(mesh, v)).length, 0) << v;
    WindowField::Leg leg = field.windows->last_leg(v);
    while (leg.vertex != kNoIndex) leg = field.windows->last_leg(leg.vertex);
    EXPECT_EQ(leg.source, 1u) << v;
  }
}

TEST(NumberCases, ARadiusCountsWithLargeOffsetsToo) {
  const Mesh mesh = two_pieces(1);
  const Index half = mesh.vertex_count() / 2;
  for (const Method method : all_methods()) {
    DistanceOptions options;
    options.method = method;
    options.max_distance = 1e12 + 1;
    const std::vector<Source> sources{{vertex_point(mesh, 0), 1e12}, {vertex_point(mesh, half), -1e300}};
    const DistanceField field = distance(mesh, sources, options);
    EXPECT_EQ(field.distance[0], 1e12);
    EXPECT_EQ(field.distance[half - 1], kInfinity) << name_of(method);  // the other corner, 2.8 away
    EXPECT_EQ(field.source[half - 1], kNoIndex);
    for (Index v = half; v < 2 * half; ++v) EXPECT_EQ(field.distance[v], -1e300) << name_of(method);
  }
}

TEST(NumberCases, BoundsAndWindowsKnowLargeOffsets) {
  const Mesh mesh = two_pieces(1);
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_windows = true;
  const double offset = 1e15;
  const std::vector<Source> sources{{vertex_point(mesh, 0), offset}};
  const DistanceField field = distance(mesh, sources, options);
  const Source plain{vertex_point(mesh, 0)};
  const DistanceField truth = distance(mesh, std::span(&plain, 1), options);
  for (Index v = 0; v < mesh.vertex_count() / 2; ++v) {
    EXPECT_LE(std::abs(field.distance[v] - offset - truth.distance[v]), field.error_bound[v]);
    EXPECT_EQ(field.windows->value(vertex_point(mesh, v)).distance, field.distance[v]);
  }
  const SparseField sparse = DistanceSolver(mesh).distance_sparse(sources, options);
  for (std::size_t i = 0; i < sparse.vertex.size(); ++i) {
    EXPECT_EQ(sparse.distance[i], field.distance[sparse.vertex[i]]);
  }
}

}  // namespace
}  // namespace brushfire
