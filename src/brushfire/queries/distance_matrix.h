// Distances from many places to many places: dense, radius-limited sparse, or written to disk row by row.
//
// Every row is one run of a solver; rows are shared out to threads, each with a solver of its own, and a row depends on
// nothing but itself: the numbers are bit-identical for any number of threads and for any selection of rows and
// columns.
//
// With Method::CarriedSource (in single precision) sixteen neighbouring vertices march together in the lanes of vector
// registers, in groups that the mesh alone decides: seven to ten times as many rows a second as one by one.
// A group is always run as a whole, whichever of its rows are needed, so that a row has the same bits every time; it
// differs from distance()'s by some 0.01 to 0.02 % in the mean, which is less than its error. Single runs serve rows of
// places other than vertices, of vertices on walls or without close neighbours, a group that would not settle, and all
// rows where a column is no vertex. Rows of distances_within() depend on the radius, too: by as little.
// docs/decisions/matrices.md
//
// Example:
//     const brushfire::Mesh mesh = brushfire::read_mesh("scan.ply").mesh;
//     const std::vector<brushfire::Place> rows{brushfire::Index{0}, brushfire::Index{2}};
//     const std::vector<float> matrix = brushfire::distance_matrix<float>(mesh, rows, std::nullopt);
//     std::printf("from vertex 2 to vertex 1: %g\n", matrix[mesh.vertex_count() + 1]);
#pragma once

#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/distance.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace brushfire {

// What a row or a column stands for: a vertex by its number, or any point of the surface. A vertex in no face is a
// legal place: its row and its column are +inf throughout, its own entry included, as it is no point of the surface.
using Place = std::variant<Index, SurfacePoint>;

// The places of all rows or all columns; nullopt: every vertex, in order.
using Places = std::optional<std::span<const Place>>;

enum class ValueType : std::uint8_t { Float32, Float64 };

struct MatrixOptions {
  // How each row is computed. max_distance limits all rows, what is farther reads +inf; targets must be empty. progress
  // counts rows and is called from the calling thread; cancel stops everything.
  DistanceOptions distance;
  unsigned threads = 0;            // 0: one per processor
  std::uint64_t memory_limit = 0;  // bytes that the result may take; 0: what is available
};

// result[i * columns + j] = distance from rows[i] to columns[j], in the caller's memory of exactly rows x columns
// values of type float or double (floats are rounded doubles). Throws Error(InvalidArgument) for memory of another
// size, Error(IndexOutOfRange) for a place that does not exist, and what distance() throws.
template <class T>
void distance_matrix(const Domain& domain, Places rows, Places columns, std::span<T> result,
                     const MatrixOptions& options = {});

// The same in memory of its own. Throws Error(TooLarge), before anything is computed, where it does not fit.
template <class T>
std::vector<T> distance_matrix(const Domain& domain, Places rows, Places columns, const MatrixOptions& options = {});

// Throws Error(TooLarge) that says what to do, where a dense matrix takes more than `limit` bytes (0: what is
// available).
void require_dense_memory(std::size_t rows, std::size_t columns, ValueType type, std::uint64_t limit = 0);

// Compressed sparse rows: entries row_start[i] .. row_start[i+1] belong to row i; their columns ascend.
template <class T>
struct SparseMatrix {
  std::vector<std::uint64_t> row_start;  // [rows + 1]
  std::vector<Index> column;             // [entries] vertices
  std::vector<T> value;                  // [entries] finite; a place's distance to itself is an entry of value 0
  Index columns = 0;                     // vertex_count
};

// Everything within `radius` (finite, >= 0) of each row's place; columns are vertices. A row costs what it reaches.
// Throws Error(TooLarge) where the rows are expected not to fit (from an evenly spread sample of them, if it could be
// close), and during the run should the expectation have been too low.
template <class T>
SparseMatrix<T> distances_within(const Domain& domain, double radius, Places rows = {},
                                 const MatrixOptions& options = {});

// The matrix as .npz (what scipy.sparse.load_npz() reads: CSR, uncompressed) or .mtx (MatrixMarket), by extension. The
// file appears complete or not at all. Throws Error(UnknownFormat) for another extension, Error(FileNotWritable).
template <class T>
void write_sparse_matrix(const std::string& path, const SparseMatrix<T>& matrix);

// The dense matrix as a .npy file (little-endian, C order, version 1.0), a row at a time: memory for one row per
// thread. The rows go into PATH.part, and which are there into PATH.part.rows; when all are, PATH.part becomes PATH.
// Calling it again after an interruption goes on where it stopped; what was begun with another mesh, other places or
// other options is begun anew. Throws Error(FileNotWritable), and what distance_matrix() throws.
void write_distance_matrix(const std::filesystem::path& path, const Domain& domain, Places rows, Places columns,
                           ValueType type = ValueType::Float32, const MatrixOptions& options = {});

}  // namespace brushfire
