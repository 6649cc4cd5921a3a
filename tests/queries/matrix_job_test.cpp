// Matrices on disk as jobs: shards, helpers, Zarr, symmetry, sparse blocks.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/matrix_job.h>

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
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
  const auto values = [&](const char* name) {
    const std::string bytes = bytes_of(path(name));
    std::vector<float> v(n * n);
    std::memcpy(v.data(), bytes.data() + bytes.size() - 4 * v.size(), 4 * v.size());
    return v;
  };
  const std::vector<float> plain = values("plain.npy"), mean = values("mean.npy");
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      ASSERT_EQ(mean[i * n + j], plain[i * n + j] / 2 + plain[j * n + i] / 2) << i << ' ' << j;
    }
  }
}

}  // namespace
}  // namespace brushfire::test
