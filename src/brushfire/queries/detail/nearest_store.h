// The nearest columns of every row, and how far they are: two .npy files in place of the row.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/queries/detail/matrix_store.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace brushfire::detail {

// A store that takes whole rows and keeps of each the `count` smallest values, ascending, in `values`, and in `indices`
// (int32, .npy) which columns they are of; columns with equal values ascend. Time: count log(count) + columns per row.
// Its rows cannot be written in parts. `path`: of the values, whose disk must have room for both.
std::unique_ptr<MatrixStore> nearest_store(std::unique_ptr<MatrixStore> values, std::unique_ptr<MatrixStore> indices,
                                           std::filesystem::path path, const StoredMatrix& whole, std::uint64_t count);

// Throws Error(InvalidArgument) where more are wanted than there are.
void require_columns(std::uint64_t nearest, std::uint64_t columns);

// Whether at least so many values are finite.
template <class T>
bool has_finite(std::span<const T> values, std::size_t count);

// "d.npy" to "d.index.npy".
std::filesystem::path index_path(const std::filesystem::path& path);

// Growing radii to look within for the nearest `count` vertices: most rows find them within the first one, and rows
// that do not try the next. The last one is `limit`.
std::vector<double> radii_for_nearest(const Mesh& mesh, std::uint64_t count, double limit);

}  // namespace brushfire::detail
