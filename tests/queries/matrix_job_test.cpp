// Matrices on disk as jobs: shards, helpers, Zarr, symmetry, sparse blocks.
#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/matrix_job.h>
#include <brushfire/solvers/weighted/weighting.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>

#include "io/io_support.h"

namespace brushfire::test {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class MatrixJobs : public testing::Test {
 protected:
  MatrixJobs() { options_.distance.method = Method::CarriedSource, options_.threads = 1; }
  fs::path path(const char* name) const { return folder_ / name; }
  void write(const char* name, const MatrixFileOptions& file = {}) const {
    MatrixJob(path(name), mesh_, {}, {}, ValueType::Float32, options_, file).run();
  }

  // What follows the header of a .npy file.
  template <class T>
  std::vector<T> values_of(const char* name, std::size_t count) const {
    const std::string bytes = bytes_of(path(name));
    std::vector<T> v(count);
    if (bytes.size() < count * sizeof(T)) throw std::runtime_error(std::string(name) + " is too short");
    std::memcpy(v.data(), bytes.data() + bytes.size() - sizeof(T) * v.size(), sizeof(T) * v.size());
    return v;
  }
  // The job's error once `share` of it is there.
  template <class Run>
  void stop_at(double share, const Run& run) {
    CancelToken token;
    MatrixOptions options = options_;
    options.distance.cancel = &token;
    options.distance.progress = [&](double done) {
      if (done >= share) token.cancel();
    };
    try {
      run(options);
      FAIL() << "was not stopped";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::Cancelled) << e.what();
    }
  }

  TemporaryDirectory folder_;
  Mesh mesh_ = shapes::icosphere(2).mesh();
  MatrixOptions options_;
};

TEST_F(MatrixJobs, MergedShardsAreTheMatrixByteForByteAndMissingOnesAreNamed) {
  write("whole.npy");
  std::vector<fs::path> shards;
  for (std::uint64_t k = 1; k <= 3; ++k) {
    MatrixJob job(path("d.npy"), mesh_, {}, {}, ValueType::Float32, options_, {.shard = k, .shards = 3});
    job.run();
    shards.push_back(job.output());
  }
  merge_shards(shards, path("merged.npy"));
  EXPECT_EQ(bytes_of(path("merged.npy")), bytes_of(path("whole.npy")));
  shards.erase(shards.begin() + 1);
  try {
    merge_shards(shards, path("hole.npy"));
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("missing: 2"), std::string::npos) << e.what();
  }
}

TEST_F(MatrixJobs, TwoAtATimeWriteTheSameStoreAsOne) {
  write("one.zarr", {.chunk_rows = 40});
  std::thread other([&] { write("two.zarr", {.chunk_rows = 40}); });
  write("two.zarr", {.chunk_rows = 40});
  other.join();
  for (int k = 0; k * 40 < static_cast<int>(mesh_.vertex_count()); ++k) {
    const std::string chunk = "distance/c/" + std::to_string(k) + "/0";
    EXPECT_EQ(bytes_of(path("one.zarr") / chunk), bytes_of(path("two.zarr") / chunk));
    EXPECT_FALSE(bytes_of(path("one.zarr") / chunk).empty());
  }
  EXPECT_FALSE(fs::exists(path("two.zarr.part.rows")));
  fs::create_directory(path("foreign.zarr"));
  std::ofstream(path("foreign.zarr") / "precious") << "x";
  EXPECT_THROW(write("foreign.zarr"), Error);
  EXPECT_EQ(bytes_of(path("foreign.zarr") / "precious"), "x");
}

TEST_F(MatrixJobs, SparseRowsOnDiskAreThoseInMemory) {
  write_distances_within(path("job.npz"), mesh_, 0.5, {}, ValueType::Float32, options_);
  write_sparse_matrix(path("memory.npz").string(), distances_within<float>(mesh_, 0.5, {}, options_));
  EXPECT_EQ(bytes_of(path("job.npz")), bytes_of(path("memory.npz")));
  EXPECT_FALSE(fs::exists(path("job.npz.part")));
}

TEST_F(MatrixJobs, SymmetricIsTheMeanOfBothDirections) {
  write("plain.npy");
  write("mean.npy", {.symmetry = Symmetry::Mean});
  const std::size_t n = mesh_.vertex_count();
  const std::vector<float> plain = values_of<float>("plain.npy", n * n), mean = values_of<float>("mean.npy", n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      ASSERT_EQ(mean[i * n + j], plain[i * n + j] / 2 + plain[j * n + i] / 2) << i << ' ' << j;
    }
  }
}

TEST_F(MatrixJobs, ShardsOfOtherWeightsAreNotMerged) {
  const std::vector<Place> rows{Index{0}, Index{9}};
  std::vector<fs::path> shards;
  for (std::uint64_t k = 1; k <= 2; ++k) {
    Weights weights;
    weights.face.assign(mesh_.face_count(), 2);
    weights.face[0] = 2 + static_cast<double>(k);
    options_.distance.weighting = std::make_shared<const Weighting>(mesh_, weights);
    MatrixJob job(path("d.npy"), mesh_, Places(rows), {}, ValueType::Float32, options_, {.shard = k, .shards = 2});
    job.run();
    shards.push_back(job.output());
  }
  EXPECT_THROW(merge_shards(shards, path("merged.npy")), Error);
}

TEST_F(MatrixJobs, AStoppedOneIsGoneOnWithAndRowsOfAnotherMatrixLeaveItAlone) {
  write("whole.npy");
  for (const char* name : {"d.npy", "d.zarr"}) {
    stop_at(0.3, [&](const MatrixOptions& options) {
      MatrixJob(path(name), mesh_, {}, {}, ValueType::Float32, options, {.chunk_rows = 40}).run();
    });
    const std::string before = bytes_of(path(name).string() + ".part.rows");
    const std::vector<Place> some{Index{0}, Index{5}};
    try {
      MatrixJob(path(name), mesh_, some, {}, ValueType::Float32, options_, {.chunk_rows = 40});
      FAIL() << name;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("another matrix was begun here"), std::string::npos) << e.what();
    }
    EXPECT_EQ(bytes_of(path(name).string() + ".part.rows"), before);
    MatrixJob job(path(name), mesh_, {}, {}, ValueType::Float32, options_, {.chunk_rows = 40});
    EXPECT_GE(job.found(), job.rows() * 3 / 10);
    EXPECT_LT(job.found(), job.rows());
    job.run();
    EXPECT_EQ(job.done(), job.rows());
    EXPECT_FALSE(fs::exists(path(name).string() + ".part.rows"));
  }
  EXPECT_EQ(bytes_of(path("d.npy")), bytes_of(path("whole.npy")));
  write("whole.zarr", {.chunk_rows = 40});
  EXPECT_EQ(bytes_of(path("d.zarr/distance/c/3/0")), bytes_of(path("whole.zarr/distance/c/3/0")));
}

TEST_F(MatrixJobs, StoppedSparseRowsAreGoneOnWithBlockByBlock) {
  mesh_ = shapes::icosphere(4).mesh();  // 2562 rows in two blocks
  const auto write_within = [&](const MatrixOptions& options, std::size_t* found) {
    write_distances_within(path("job.npz"), mesh_, 0.1, {}, ValueType::Float32, options, {}, found);
  };
  stop_at(0.9, [&](const MatrixOptions& options) { write_within(options, nullptr); });
  EXPECT_THROW(write_distances_within(path("job.npz"), mesh_, 0.2, {}, ValueType::Float32, options_), Error);
  std::size_t found = 0;
  write_within(options_, &found);
  EXPECT_GE(found, 2048u);
  EXPECT_LT(found, mesh_.vertex_count());
  write_sparse_matrix(path("memory.npz").string(), distances_within<float>(mesh_, 0.1, {}, options_));
  EXPECT_EQ(bytes_of(path("job.npz")), bytes_of(path("memory.npz")));
}

TEST_F(MatrixJobs, ShardsOfOneStoreFillItTogetherAndWhoeverIsLastCompletesIt) {
  write("whole.zarr", {.chunk_rows = 25});
  for (const std::uint64_t k : {2, 3, 1}) {
    MatrixJob job(path("d.zarr"), mesh_, {}, {}, ValueType::Float32, options_,
                  {.chunk_rows = 25, .shard = k, .shards = 3});
    job.run();
    EXPECT_EQ(job.is_complete(), k == 1);
  }
  for (int k = 0; k * 25 < static_cast<int>(mesh_.vertex_count()); ++k) {
    const std::string chunk = "distance/c/" + std::to_string(k) + "/0";
    EXPECT_EQ(bytes_of(path("d.zarr") / chunk), bytes_of(path("whole.zarr") / chunk)) << chunk;
  }
}

TEST_F(MatrixJobs, TheNearestOfEveryRowAreTheFirstOfItsSortedColumns) {
  options_.distance.method = Method::Windows;  // whose values do not depend on the radius
  mesh_ = shapes::icosphere(3).mesh();
  const std::size_t n = mesh_.vertex_count();
  write("dense.npy");
  const std::vector<float> dense = values_of<float>("dense.npy", n * n);
  for (const std::size_t count : {n, std::size_t{20}, std::size_t{1}}) {
    write("d.npy", {.nearest = count});
    const std::vector<float> values = values_of<float>("d.npy", n * count);
    const std::vector<std::int32_t> columns = values_of<std::int32_t>("d.index.npy", n * count);
    std::vector<std::int32_t> order(n);
    for (std::size_t i = 0; i < n; ++i) {
      const float* const row = dense.data() + i * n;
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) { return row[a] < row[b]; });
      for (std::size_t k = 0; k < count; ++k) {
        ASSERT_EQ(columns[i * count + k], order[k]) << i << ' ' << k;
        ASSERT_EQ(values[i * count + k], row[order[k]]) << i << ' ' << k;
      }
    }
  }
  EXPECT_THROW(write("e.npy", {.nearest = n + 1}), Error);
  EXPECT_THROW(write("e.zarr", {.nearest = 5}), Error);
  EXPECT_THROW(write("e.npy", {.symmetry = Symmetry::Mean, .nearest = 5}), Error);
}

TEST_F(MatrixJobs, WhatIsNotReachedIsTheFarthest) {
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  const std::vector<Face> faces{{0, 1, 2}, {3, 4, 5}};
  const Mesh two(positions, faces);
  MatrixJob(path("d.npy"), two, {}, {}, ValueType::Float32, options_, {.nearest = 5}).run();
  const std::vector<float> values = values_of<float>("d.npy", 30);
  const std::vector<std::int32_t> columns = values_of<std::int32_t>("d.index.npy", 30);
  EXPECT_EQ(std::vector(columns.begin() + 20, columns.begin() + 25), (std::vector<std::int32_t>{4, 3, 5, 0, 1}));
  EXPECT_TRUE(std::isinf(values[23]) && std::isinf(values[24]) && std::isfinite(values[22]));
}

}  // namespace
}  // namespace brushfire::test
