// Where the rows of a matrix on disk are put, any row at any time: one .npy file, or the chunks of a Zarr store.
#pragma once

#include <brushfire/queries/distance_matrix.h>
#include <brushfire/queries/matrix_job.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace brushfire::detail {

// What a store has to know about its matrix.
struct StoredMatrix {
  std::uint64_t rows = 0, columns = 0;  // of what is stored
  ValueType type = ValueType::Float32;
  bool whole_numbers = false;                               // int32 in place of values; in .npy files only
  std::vector<std::int64_t> row_vertices, column_vertices;  // where all are vertices; Zarr keeps them as coordinates
  std::string attributes;                                   // members of a JSON object, for Zarr

  std::uint64_t value_bytes() const { return whole_numbers || type == ValueType::Float32 ? 4 : 8; }
  std::uint64_t row_bytes() const { return columns * value_bytes(); }
};

// Rows are little-endian. All that fails is Error(FileNotWritable).
class MatrixStore {
 public:
  virtual ~MatrixStore() = default;

  // Makes the files, without values. Throws where the disk has no room for them, or what is there is not to be
  // replaced.
  virtual void begin() = 0;
  // Whether the files of begin() are there, or the complete matrix.
  virtual bool is_there() const = 0;
  // `from`: the first byte within the row. From any thread and process.
  virtual void write(std::uint64_t row, std::uint64_t from, std::span<const char> bytes) const = 0;
  virtual void read(std::uint64_t row, std::uint64_t from, std::span<char> bytes) const = 0;
  // Rows are complete in units of so many: 0, only all together. complete() puts the unit of `row` under its name.
  virtual std::uint64_t rows_of_unit() const { return 0; }
  virtual void complete(std::uint64_t /*row*/) const {}
  // Puts everything under its name; what already is, is no error.
  virtual void finish() const = 0;
  virtual bool is_finished() const = 0;
};

// By the path's extension: .npy or .zarr. Throws Error(UnknownFormat) for another one.
std::unique_ptr<MatrixStore> open_store(const std::filesystem::path& path, StoredMatrix matrix,
                                        const MatrixFileOptions& options);
// The number that tells layouts of one matrix apart.
std::uint64_t layout_of(const std::filesystem::path& path, const StoredMatrix& matrix,
                        const MatrixFileOptions& options);
// Whether a complete store with these attributes is there.
bool is_complete_store(const std::filesystem::path& path, const std::string& attributes);

// Throws where fewer bytes are free at the path than so many rows take; says how many would fit.
void require_disk(const std::filesystem::path& path, std::uint64_t rows, std::uint64_t row_bytes);

}  // namespace brushfire::detail
