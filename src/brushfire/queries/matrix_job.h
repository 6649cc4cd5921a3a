// Distance matrices on disk as jobs: they survive being killed, other processes can help with them, and they can be cut
// into shards for machines that share nothing.
//
// A row is written in its place and then marked in PATH.part.rows; a marked row is never computed again, and a process
// that is killed leaves nothing locked. Every process that is given the same job takes rows that no other is computing,
// and returns when all are there. The bytes are the same whichever process computed which row. docs/cluster.md
//
// Example:
//     const brushfire::Mesh mesh = brushfire::read_mesh("scan.ply").mesh;
//     brushfire::MatrixJob job("distances.zarr", mesh, {}, {});
//     if (job.found() > 0) std::printf("resuming at row %zu of %zu\n", job.found(), job.rows());
//     job.run();
#pragma once

#include <brushfire/core/progress.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/queries/distance_matrix.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

namespace brushfire {

// What rounding and approximate methods leave between d(i, j) and d(j, i) is taken out: both become their mean or
// their minimum; of a number and none, the number.
enum class Symmetry : std::uint8_t { Mean, Minimum };

struct MatrixFileOptions {
  std::uint64_t chunk_rows = 0;  // rows of a Zarr chunk; 0: as many as take 16 MB
  int zarr_format = 3;           // or 2
  // Which of how many shards, from 1 on. A shard is a run of rows near each other on the surface. In a .npy file it is
  // a matrix of its own rows alone, for merge_shards(); the shards of a Zarr store write into it together.
  std::uint64_t shard = 1, shards = 1;
  std::optional<Symmetry> symmetry{};  // needs rows and columns that are the same places, and no shards in .npy files
  // Not 0: of every row only so many columns, the nearest ones, from near to far, and in a second .npy file of int32
  // (d.index.npy) which they are; what is not reached comes last, by number. Where the columns are all vertices a row
  // costs what it has to reach. In .npy files that are no shards, and not symmetric.
  std::uint64_t nearest = 0;
  // Distances are written in this unit, > 0: root_of_area() (pair_distances.h) where meshes of different sizes are
  // compared. Radii stay in the mesh's units.
  double unit = 1;
};

// One process's part in a matrix that is written to disk: PATH ends in .npy (little-endian, C order, version 1.0) or in
// .zarr (a group with the array "distance", uncompressed, in chunks of whole rows; what is not there yet reads NaN).
class MatrixJob {
 public:
  // Begins the job, or joins it, also where the process that began it has ended. Throws Error(FileNotWritable)
  // where another job was begun at this path, where something that is no such store stands there, or where the disk
  // has too little room (and says how many rows would fit); Error(UnknownFormat) for another extension;
  // Error(InvalidArgument) for options that contradict each other; what distance_matrix() throws.
  MatrixJob(const std::filesystem::path& path, const Domain& domain, Places rows, Places columns,
            ValueType type = ValueType::Float32, const MatrixOptions& options = {},
            const MatrixFileOptions& file_options = {});
  ~MatrixJob();
  MatrixJob(const MatrixJob&) = delete;
  MatrixJob& operator=(const MatrixJob&) = delete;

  std::size_t rows() const;  // of this shard
  std::size_t columns() const;
  std::size_t found() const;             // rows that were there when it was joined
  std::size_t done() const;              // rows that are there now
  std::filesystem::path output() const;  // PATH; of a shard in a .npy file its own: d.3-of-16.npy

  // Computes the rows that are missing and that no other process is computing, waits for those that one is (and takes
  // them over if it dies), and completes the files. With shards of a Zarr store: those of its own shard, and the
  // process that finds all rows there completes it. MatrixOptions' progress counts all rows.
  void run();

  // Of `count` blocks of rows that are computed together, block number `block` alone: rows that another process is
  // computing are left to it. Returns how many rows it computed. run() completes the files afterwards.
  std::size_t run_block(std::size_t block, std::size_t count);

  // Whether the matrix stands complete under its name.
  bool is_complete() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The whole matrix of shards, which are .npy files with their .npy.rows beside them: to a .npy or .zarr file, which has
// the bytes of one that was never cut. Memory for a row; interrupted, it goes on when called again. Throws
// Error(FileMalformed) where something is not a shard, Error(InvalidArgument) where two are of different matrices, or
// rows are missing: it says which shards.
void merge_shards(std::span<const std::filesystem::path> shards, const std::filesystem::path& path,
                  const MatrixFileOptions& options = {}, const Progress& progress = nullptr);

// distances_within() as a file that write_sparse_matrix() writes, block after block: blocks that are complete wait in
// the folder PATH.part, and calling it again goes on behind them; of the file's options symmetry counts: the union of
// what is stored in either direction is stored in both. `found`, if given, receives the number of rows that were there.
// Returns the number of entries, 0 where another process put the file together. The entries have to fit into memory at
// the end: throws as distances_within() and MatrixJob() do, before the first row where that can be told.
std::uint64_t write_distances_within(const std::filesystem::path& path, const Domain& domain, double radius,
                                     Places rows, ValueType type = ValueType::Float32,
                                     const MatrixOptions& options = {}, const MatrixFileOptions& file_options = {},
                                     std::size_t* found = nullptr);

// The same entries in both directions, of a square matrix: their mean or minimum; where one is missing, the other.
template <class T>
SparseMatrix<T> symmetrized(const SparseMatrix<T>& matrix, Symmetry symmetry);

}  // namespace brushfire
