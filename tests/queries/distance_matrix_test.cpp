// Distance matrices against single runs: same bits, whatever the threads, the selection and the way they are stored.
#include <brushfire/core/error.h>
#include <brushfire/queries/distance_matrix.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <string>

namespace brushfire {
namespace {

namespace fs = std::filesystem;

// A bumpy n x n grid, a separate triangle, and a vertex in no face.
Mesh bumpy(Index n) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> height(0, 0.5);
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      positions.push_back({static_cast<double>(x), static_cast<double>(y), height(random)});
      if (x + 1 == n || y + 1 == n) continue;
      const Index v = y * n + x;
      faces.push_back({v, v + 1, v + n});
      faces.push_back({v + 1, v + n + 1, v + n});
    }
  }
  const Index first = n * n;
  for (const Vec3 p : {Vec3{-3, 0, 0}, Vec3{-2, 0, 0}, Vec3{-3, 1, 0}, Vec3{-9, -9, 0}}) positions.push_back(p);
  faces.push_back({first, first + 1, first + 2});
  return Mesh(positions, faces);
}

class Matrix : public testing::TestWithParam<Method> {
 protected:
  MatrixOptions options(unsigned threads = 1) const {
    MatrixOptions o;
    o.distance.method = GetParam();
    o.threads = threads;
    return o;
  }
  std::vector<double> single(const Mesh& mesh, const SurfacePoint& from, double radius = kInfinity) const {
    DistanceOptions o;
    o.method = GetParam();
    o.max_distance = radius;
    const Source source{from, 0};
    return distance(mesh, std::span(&source, 1), o).distance;
  }
};

// (Those of carried-source, that are computed sixteen at a time, equal them but for some of its error.)
TEST_P(Matrix, RowsEqualSingleRunsToTheBitForAnyNumberOfThreads) {
  const double room = GetParam() == Method::CarriedSource ? 0.05 : 0;
  const Mesh mesh = bumpy(9);
  const Index n = mesh.vertex_count();
  const std::vector<double> one = distance_matrix<double>(mesh, {}, {}, options(1));
  ASSERT_EQ(one.size(), std::size_t{n} * n);
  for (Index v = 0; v + 1 < n; ++v) {
    const std::vector<double> row = single(mesh, vertex_point(mesh, v));
    for (Index u = 0; u < n; ++u) {
      const double value = one[v * n + u];
      ASSERT_TRUE(value == row[u] || std::abs(value - row[u]) <= room * row[u]) << v << " to " << u << ": " << value;
    }
  }
  for (const unsigned threads : {2u, 3u, 16u}) EXPECT_EQ(one, distance_matrix<double>(mesh, {}, {}, options(threads)));
}

TEST_P(Matrix, AVertexInNoFaceIsFarFromEverythingItselfIncluded) {
  const Mesh mesh = bumpy(3);
  const Index n = mesh.vertex_count();
  const std::vector<double> all = distance_matrix<double>(mesh, {}, {}, options());
  for (Index v = 0; v < n; ++v) {
    EXPECT_EQ(all[v * n + n - 1], kInfinity);
    EXPECT_EQ(all[(n - 1) * n + v], kInfinity);
  }
}

TEST_P(Matrix, SelectedRowsAndColumnsAreThoseOfTheFullMatrix) {
  const Mesh mesh = bumpy(9);
  const Index n = mesh.vertex_count();
  const std::vector<double> full = distance_matrix<double>(mesh, {}, {}, options());
  const std::vector<Place> rows{Index{5}, Index{5}, n - 1, Index{40}}, columns{n - 1, Index{80}, Index{0}, Index{5}};
  const std::vector<double> part = distance_matrix<double>(mesh, rows, columns, options(2));
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_EQ(part[4 * i + j], full[std::get<Index>(rows[i]) * n + std::get<Index>(columns[j])]) << i << ' ' << j;
    }
  }
  EXPECT_TRUE(distance_matrix<double>(mesh, rows, std::span<const Place>(), options()).empty());
  EXPECT_TRUE(distance_matrix<double>(mesh, std::span<const Place>(), {}, options()).empty());
}

TEST_P(Matrix, SurfacePointsMayBeRowsAndColumns) {
  const Mesh mesh = bumpy(9);
  const SurfacePoint inside{17, {0.2, 0.3, 0.5}};
  const std::vector<Place> places{inside, Index{60}};
  const std::vector<double> d = distance_matrix<double>(mesh, places, places, options());
  EXPECT_EQ(d[1], single(mesh, inside)[60]);
  EXPECT_NEAR(d[1], d[2], 0.3 * d[1]);  // the approximate methods are not symmetric
  EXPECT_GT(d[1], 1);
}

TEST_P(Matrix, DistancesWithinHoldsExactlyTheEntriesUpToTheRadius) {
  const Mesh mesh = bumpy(12);
  const Index n = mesh.vertex_count();
  const SparseMatrix<double> m = distances_within<double>(mesh, 3.5, {}, options(2));
  ASSERT_EQ(m.row_start.size(), n + 1u);
  EXPECT_EQ(m.columns, n);
  for (Index v = 0; v < n; ++v) {
    const std::vector<double> row =
        v + 1 == n ? std::vector<double>(n, kInfinity) : single(mesh, vertex_point(mesh, v), 3.5);
    std::size_t k = m.row_start[v];
    if (GetParam() == Method::CarriedSource) {  // in groups: as near to single rows as they are to the truth
      std::size_t certain = 0, found = 0;
      for (Index u = 0; u < n; ++u) certain += row[u] < 3.4 ? 1 : 0;
      for (; k < m.row_start[v + 1]; ++k) {
        found += row[m.column[k]] < 3.4 ? 1 : 0;
        if (row[m.column[k]] == kInfinity) continue;
        ASSERT_NEAR(m.value[k], row[m.column[k]], 0.02 * m.value[k]);
      }
      ASSERT_EQ(found, certain);
    }
    for (Index u = 0; u < n && GetParam() != Method::CarriedSource; ++u) {
      if (row[u] == kInfinity) continue;
      ASSERT_LT(k, m.row_start[v + 1]);
      ASSERT_EQ(m.column[k], u);
      ASSERT_EQ(m.value[k], row[u]);
      ++k;
    }
    ASSERT_EQ(k, m.row_start[v + 1]);
  }
  const SparseMatrix<float> other = distances_within<float>(mesh, 3.5, {}, options(5));
  EXPECT_EQ(other.column, m.column);
  for (std::size_t k = 0; k < m.value.size(); ++k) ASSERT_EQ(other.value[k], static_cast<float>(m.value[k]));
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_P(Matrix, WrittenRowByRowItIsTheNpyFileOfTheMatrixAlsoAfterInterruptions) {
  const Mesh mesh = bumpy(9);
  const Index n = mesh.vertex_count();
  const fs::path path = fs::path(testing::TempDir()) / ("matrix-" + std::string(name_of(GetParam())) + ".npy");
  int interruptions = 0;
  for (bool finished = false; !finished; ++interruptions) {
    MatrixOptions o = options(1);
    CancelToken cancel;
    std::atomic<int> calls{0};
    o.distance.cancel = &cancel;
    const int most = GetParam() == Method::CarriedSource ? 2 : 12;  // told of sixteen rows at a time
    o.distance.progress = [&](double) { ++calls > most ? cancel.cancel() : void(); };
    try {
      write_distance_matrix(path, mesh, {}, {}, ValueType::Float64, o);
      finished = true;
    } catch (const Error& e) {
      ASSERT_EQ(e.code(), ErrorCode::Cancelled);
      ASSERT_FALSE(fs::exists(path)) << "no unfinished file under the final name";
    }
    ASSERT_LT(interruptions, 100);
  }
  EXPECT_GT(interruptions, 2);
  const std::vector<double> values = distance_matrix<double>(mesh, {}, {}, options());
  const std::string bytes = bytes_of(path);
  ASSERT_EQ(bytes.size() % 64, (values.size() * 8) % 64);
  ASSERT_GT(bytes.size(), values.size() * 8);
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_NE(bytes.find("'shape': (" + std::to_string(n) + ", " + std::to_string(n) + ")"), std::string::npos);
  EXPECT_EQ(std::memcmp(bytes.data() + bytes.size() - values.size() * 8, values.data(), values.size() * 8), 0);
  EXPECT_FALSE(fs::exists(path.string() + ".part"));
  EXPECT_FALSE(fs::exists(path.string() + ".part.rows"));
  fs::remove(path);
}

INSTANTIATE_TEST_SUITE_P(Methods, Matrix, testing::ValuesIn(all_methods().begin(), all_methods().end()),
                         [](const auto& method) {
                           std::string name(name_of(method.param));
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(MatrixFile, RowsOfAnotherMeshAreNeitherTakenOverNorDiscarded) {
  const Mesh mesh = bumpy(6), other = bumpy(7);
  const fs::path path = fs::path(testing::TempDir()) / "matrix-other.npy";
  MatrixOptions o;
  o.threads = 1;  // progress comes from the calling thread: it must be the one that computes
  o.distance.method = Method::Dijkstra;
  CancelToken cancel;
  o.distance.cancel = &cancel;
  o.distance.progress = [&](double) { cancel.cancel(); };
  EXPECT_THROW(write_distance_matrix(path, other, {}, {}, ValueType::Float64, o), Error);
  o.distance.cancel = nullptr;
  o.distance.progress = nullptr;
  const std::string begun = bytes_of(path.string() + ".part");
  EXPECT_THROW(write_distance_matrix(path, mesh, {}, {}, ValueType::Float64, o), Error);
  EXPECT_EQ(bytes_of(path.string() + ".part"), begun) << "nor discarded";
  write_distance_matrix(path, other, {}, {}, ValueType::Float64, o);
  const std::vector<double> values = distance_matrix<double>(other, {}, {}, o);
  const std::string bytes = bytes_of(path);
  EXPECT_EQ(std::memcmp(bytes.data() + bytes.size() - values.size() * 8, values.data(), values.size() * 8), 0);
  fs::remove(path);
}

ErrorCode code_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& e) {
    return e.code();
  }
  ADD_FAILURE() << "nothing was thrown";
  return ErrorCode::InvalidArgument;
}

TEST(MatrixErrors, AreTypedAndComeBeforeAnyWork) {
  const Mesh mesh = bumpy(40);
  MatrixOptions o;
  o.distance.method = Method::Dijkstra;
  const std::vector<Place> bad{mesh.vertex_count()}, good{Index{0}};
  EXPECT_EQ(code_of([&] { distance_matrix<float>(mesh, bad, {}, o); }), ErrorCode::IndexOutOfRange);
  EXPECT_EQ(code_of([&] { distance_matrix<float>(mesh, good, bad, o); }), ErrorCode::IndexOutOfRange);
  EXPECT_EQ(code_of([&] { distances_within<float>(mesh, -1, {}, o); }), ErrorCode::InvalidArgument);
  EXPECT_EQ(code_of([&] { distances_within<float>(mesh, kInfinity, {}, o); }), ErrorCode::InvalidArgument);
  std::vector<float> small(7);
  EXPECT_EQ(code_of([&] { distance_matrix<float>(mesh, good, {}, std::span(small), o); }), ErrorCode::InvalidArgument);
  EXPECT_EQ(code_of([&] { write_distance_matrix("/no/such/folder/d.npy", mesh, good, {}, ValueType::Float32, o); }),
            ErrorCode::FileNotWritable);
  o.memory_limit = 1'000'000;
  EXPECT_EQ(code_of([&] { distance_matrix<float>(mesh, {}, {}, o); }), ErrorCode::TooLarge);
  EXPECT_EQ(code_of([&] { distances_within<float>(mesh, 1000, {}, o); }), ErrorCode::TooLarge);
  EXPECT_NO_THROW(distances_within<float>(mesh, 1, {}, o));
}

TEST(MatrixErrors, AMatrixForWhichNoMachineHasTheMemoryIsRefused) {
  try {
    require_dense_memory(3'000'000'000, 4'000'000'000, ValueType::Float64);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::TooLarge);
    EXPECT_NE(std::string(e.what()).find("a 3000000000 x 4000000000 float64 matrix needs"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find(".npy"), std::string::npos);
  }
}

// The claim is a ratio of counts of work, not of times: the same rows on a mesh 16 times as large must not take 16
// times as long. Generous, because machines are busy; a loop over all vertices per row would show as a factor of 16.
TEST(MatrixCost, ARowCostsWhatItReachesNotWhatTheMeshHas) {
  const auto seconds = [](Index n) {
    const Mesh mesh = bumpy(n);
    std::vector<Place> rows;
    for (Index k = 0; k < 400; ++k) rows.push_back((k % 20) * n + k / 20);
    MatrixOptions o;
    o.distance.method = Method::Dijkstra;
    o.threads = 1;
    distances_within<float>(mesh, 1, std::span(rows).first(1), o);  // connectivity and lengths
    double best = kInfinity;
    for (int repeat = 0; repeat < 5; ++repeat) {
      const auto start = std::chrono::steady_clock::now();
      for (int k = 0; k < 20; ++k) distances_within<float>(mesh, 4, rows, o);
      best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return best;
  };
  EXPECT_LT(seconds(400), 6 * seconds(100));
}

}  // namespace
}  // namespace brushfire
