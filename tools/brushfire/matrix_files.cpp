// From options to the layout of files.
#include "matrix_files.h"

#include <charconv>
#include <string_view>

namespace brushfire::tool {
namespace {

std::optional<std::uint64_t> whole(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool is_zarr(const std::string& path) { return path.ends_with(".zarr"); }

}  // namespace

void add_matrix_files(Verb& verb, MatrixFileArguments& a) {
  verb.choice("--symmetric", a.symmetric, {"mean", "min"}, "Make both directions of each pair the same");
  verb.option("--nearest", a.nearest, "N", whole_from(1, 1e9),
              "Of each row the N nearest, sorted; which they are in .index.npy");
  verb.option("--chunk-rows", a.chunk_rows, "N", whole_from(1, 1e9),
              "Rows of a chunk of .zarr (as many as take 16 MB)");
  verb.option("--zarr-format", a.zarr_format, "N", whole_from(2, 3), "Format of .zarr, 2 or 3 (3)");
}

MatrixFileOptions file_options(const MatrixFileArguments& a) {
  constexpr std::uint64_t kMostShards = 1'000'000;
  MatrixFileOptions options;
  if (a.chunk_rows) options.chunk_rows = static_cast<std::uint64_t>(*a.chunk_rows);
  if (a.nearest) options.nearest = static_cast<std::uint64_t>(*a.nearest);
  if (a.zarr_format) options.zarr_format = *a.zarr_format;
  if (!a.symmetric.empty()) options.symmetry = a.symmetric == "mean" ? Symmetry::Mean : Symmetry::Minimum;
  if (a.shard.empty()) return options;
  const std::size_t slash = a.shard.find('/');
  const auto shard = whole(std::string_view(a.shard).substr(0, slash));
  const auto shards = slash == std::string::npos ? std::nullopt : whole(std::string_view(a.shard).substr(slash + 1));
  if (!shard || !shards || *shard < 1 || *shard > *shards || *shards > kMostShards) {
    refuse("--shard takes I/N with I from 1 to N (--shard 3/16), not " + in_quotes(a.shard));
  }
  options.shard = *shard;
  options.shards = *shards;
  return options;
}

void check(const MatrixFileArguments& a, const std::string& output) {
  file_options(a);
  if (!is_zarr(output) && (a.chunk_rows || a.zarr_format)) {
    refuse(output + ": --chunk-rows and --zarr-format are for .zarr");
  }
  if (a.nearest && !output.ends_with(".npy")) refuse(output + ": --nearest is for .npy");
  if (a.nearest && !a.shard.empty()) refuse("a shard holds whole rows: give --nearest to brushfire merge");
  if (a.nearest && !a.symmetric.empty()) refuse("--nearest takes each row for itself: no --symmetric");
  if (!is_dense(output) && !a.shard.empty()) {
    refuse(output + ": sparse rows have no --shard: give ranges, --rows 0:10000");
  }
  if (output.ends_with(".npy") && !a.shard.empty() && !a.symmetric.empty()) {
    refuse("--symmetric needs both directions: give it to brushfire merge");
  }
}

bool is_dense(const std::string& path) { return path.ends_with(".npy") || is_zarr(path); }

std::string resuming(const std::string& output, std::uint64_t found, std::uint64_t rows) {
  return output + ": resuming at row " + std::to_string(found) + " of " + std::to_string(rows);
}

}  // namespace brushfire::tool
