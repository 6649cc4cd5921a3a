// Cutting a matrix into shards, and putting it together again.
#include <brushfire/queries/detail/shards.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/zarr.h>
#include <brushfire/queries/detail/matrix_store.h>
#include <brushfire/queries/detail/nearest_store.h>
#include <brushfire/queries/detail/symmetrize.h>
#include <brushfire/queries/matrix_job.h>
#include <brushfire/version.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <utility>

namespace brushfire {
namespace detail {

std::vector<std::size_t> block_of(const Rows::ByUnits& units, std::uint64_t block, std::uint64_t count) {
  const std::uint64_t rows = units.numbers.size();
  // The first unit that begins at or behind the place where the block would begin.
  const auto cut = [&](std::uint64_t k) {
    const std::uint64_t at = rows / count * k + rows % count * k / count;
    return *std::lower_bound(units.unit_start.begin(), units.unit_start.end(), static_cast<std::size_t>(at));
  };
  const auto begin = units.numbers.begin();
  return {begin + static_cast<std::ptrdiff_t>(cut(block)), begin + static_cast<std::ptrdiff_t>(cut(block + 1))};
}

std::filesystem::path shard_path(const std::filesystem::path& path, std::uint64_t shard, std::uint64_t shards) {
  const std::string last = std::to_string(shards);
  std::string number = std::to_string(shard);
  number.insert(0, last.size() - number.size(), '0');
  std::filesystem::path name = path;
  return name.replace_extension("." + number + "-of-" + last + path.extension().string());
}

std::string attributes_of(const LedgerHead& head) {
  char job[17];
  std::snprintf(job, sizeof job, "%016llx", static_cast<unsigned long long>(head.matrix));
  return std::string("\"brushfire\": ") + json_string(kVersion) + ", \"matrix\": \"" + job +
         "\", \"layout\": " + std::to_string(head.layout >> 32) + ", \"what\": " + json_string(head.words);
}

std::string readable_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

}  // namespace detail

namespace {

namespace fs = std::filesystem;

struct ShardFile {
  fs::path path;
  detail::RowLedger::Content content;
  std::unique_ptr<detail::MatrixStore> store;
};

ValueType type_of(const detail::LedgerHead& head) {
  return head.value_bytes == 4 ? ValueType::Float32 : ValueType::Float64;
}

ShardFile open_shard(const fs::path& path) {
  std::optional<detail::RowLedger::Content> content = detail::RowLedger::read(path.string() + ".rows");
  if (!content && fs::exists(path.string() + ".part.rows")) {
    throw Error(ErrorCode::InvalidArgument, path.string() + ": this shard is not complete yet");
  }
  if (!content || content->numbers.size() != content->head.entries) {
    throw Error(fs::exists(path) ? ErrorCode::FileMalformed : ErrorCode::FileNotReadable,
                path.string() + ": is no shard of a matrix (" + path.string() + ".rows is missing or of another kind)");
  }
  detail::StoredMatrix stored;
  stored.rows = content->head.entries;
  stored.columns = content->head.columns;
  stored.type = type_of(content->head);
  auto store = detail::open_store(path, stored, {});
  if (!store->is_there()) {
    throw Error(ErrorCode::FileMalformed, path.string() + ": is not the file that " + path.string() + ".rows is of");
  }
  return {path, std::move(*content), std::move(store)};
}

std::vector<ShardFile> open_shards(std::span<const fs::path> paths) {
  if (paths.empty()) throw Error(ErrorCode::InvalidArgument, "no shards to merge");
  std::vector<ShardFile> shards;
  for (const fs::path& path : paths) {
    shards.push_back(open_shard(path));
    const detail::LedgerHead &a = shards.front().content.head, &b = shards.back().content.head;
    if (a.matrix == b.matrix && a.shards == b.shards) continue;
    throw Error(ErrorCode::InvalidArgument, path.string() + " (shard " + std::to_string(b.shard) + " of " +
                                                std::to_string(b.shards) + "; " + b.words +
                                                ") is of another matrix than " + paths.front().string() + " (shard " +
                                                std::to_string(a.shard) + " of " + std::to_string(a.shards) + "; " +
                                                a.words + "): mesh, places, options or version differ");
  }
  return shards;
}

// Throws where rows are in no shard.
void require_all(const std::vector<ShardFile>& shards) {
  const detail::LedgerHead& head = shards.front().content.head;
  std::vector<bool> is_there(static_cast<std::size_t>(head.rows), false),
      has(static_cast<std::size_t>(head.shards), false);
  for (const ShardFile& s : shards) {
    has[static_cast<std::size_t>(s.content.head.shard - 1)] = true;
    for (const std::uint64_t i : s.content.numbers) is_there[static_cast<std::size_t>(i)] = true;
  }
  const auto rows = std::count(is_there.begin(), is_there.end(), false);
  if (rows == 0) return;
  std::string which;
  for (std::size_t k = 0; k < has.size(); ++k) {
    if (!has[k]) which += (which.empty() ? "" : ", ") + std::to_string(k + 1);
  }
  throw Error(ErrorCode::InvalidArgument, std::to_string(rows) + " of " + std::to_string(head.rows) +
                                              " rows are in none of these files: of " + std::to_string(head.shards) +
                                              " shards these are missing: " + which);
}

}  // namespace

void merge_shards(std::span<const fs::path> shards, const fs::path& path, const MatrixFileOptions& options,
                  const Progress& progress) {
  const std::vector<ShardFile> files = open_shards(shards);
  require_all(files);
  detail::LedgerHead head = files.front().content.head;
  detail::StoredMatrix stored;
  stored.rows = head.rows;
  stored.columns = head.columns;
  stored.type = type_of(head);
  if (options.symmetry && head.rows != head.columns) {
    throw Error(ErrorCode::InvalidArgument, "a symmetric matrix needs as many rows as columns");
  }
  if (options.nearest > 0 && (options.symmetry || path.extension() != ".npy")) {
    throw Error(ErrorCode::InvalidArgument, "the nearest of every row are written as .npy, and not symmetric");
  }
  detail::require_columns(options.nearest, head.columns);
  const auto numbers_to = [](std::uint64_t count) {
    std::vector<std::int64_t> numbers(static_cast<std::size_t>(count));
    std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
    return numbers;
  };
  if ((head.all_vertices & 1) != 0) stored.row_vertices = numbers_to(head.rows);
  if ((head.all_vertices & 2) != 0) stored.column_vertices = numbers_to(head.columns);
  head.shard = head.shards = 1;
  head.entries = head.rows;
  head.layout = detail::layout_of(path, stored, options);
  stored.attributes = detail::attributes_of(head);
  const auto store = detail::open_store(path, stored, options);
  const std::string journal = path.string() + ".part.pair";
  const detail::RowLedger ledger(
      path.string() + ".part.rows", head, {}, [&] { return store->is_there(); },
      [&] {
        std::remove(journal.c_str());
        store->begin();
      });
  std::string bytes(static_cast<std::size_t>(stored.row_bytes()), '\0');
  std::uint64_t done = 0;
  for (const ShardFile& shard : files) {
    for (std::size_t k = 0; k < shard.content.numbers.size(); ++k) {
      stop_if_cancelled();
      const auto row = static_cast<std::size_t>(shard.content.numbers[k]);
      if (progress && ++done % 64 == 0) progress(static_cast<double>(done) / static_cast<double>(head.rows));
      if (!ledger.claim(row)) continue;
      shard.store->read(k, 0, bytes);
      store->write(row, 0, bytes);
      ledger.mark(row);
      ledger.release(row);
    }
  }
  if (ledger.done() < head.rows) {
    throw Error(ErrorCode::FileNotWritable, path.string() + ": another process is merging into it");
  }
  ledger.finish([&] {
    if (options.symmetry && !store->is_finished()) {
      detail::symmetrize(*store, head.rows, stored.type, *options.symmetry, journal);
    }
    store->finish();
    std::remove(journal.c_str());
    ledger.remove();
  });
}

}  // namespace brushfire
