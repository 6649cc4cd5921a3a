// What the verbs that write matrices have in common: how a matrix lies on disk.
#pragma once

#include "command_line.h"

#include <brushfire/queries/matrix_job.h>

#include <cstdint>
#include <optional>
#include <string>

namespace brushfire::tool {

struct MatrixFileArguments {
  std::string shard;  // "3/16"
  std::string symmetric;
  std::optional<int> chunk_rows, zarr_format, nearest;
};

// Binds --symmetric, --nearest, --chunk-rows and --zarr-format.
void add_matrix_files(Verb& verb, MatrixFileArguments& arguments);
// What they mean. Throws Error(InvalidArgument).
MatrixFileOptions file_options(const MatrixFileArguments& arguments);
// Refuses options that a file of this name has no use for.
void check(const MatrixFileArguments& arguments, const std::string& output);

bool is_dense(const std::string& path);

// "d.npy: resuming at row 120 of 3000".
std::string resuming(const std::string& output, std::uint64_t found, std::uint64_t rows);

}  // namespace brushfire::tool
