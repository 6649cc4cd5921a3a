// Sparse rows on disk, block by block, and put together at the end.
#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/memory.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/output.h>
#include <brushfire/io/detail/temporary_file.h>
#include <brushfire/queries/detail/fingerprint.h>
#include <brushfire/queries/detail/little_endian.h>
#include <brushfire/queries/detail/matrix_store.h>
#include <brushfire/queries/detail/matrix_unit.h>
#include <brushfire/queries/detail/row_ledger.h>
#include <brushfire/queries/detail/rows.h>
#include <brushfire/queries/matrix_job.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <thread>
#include <type_traits>
#include <utility>

namespace brushfire {
namespace {

namespace fs = std::filesystem;

// Rows of a file, or some more: seconds of work, and files of some megabytes.
constexpr std::size_t kFileRows = 2048;
// Of these a thread takes so many at a time.
constexpr std::size_t kThreadRows = 32;

template <class T>
class SparseJob {
 public:
  SparseJob(const fs::path& path, const Domain& domain, double radius, Places rows, const MatrixOptions& options,
            const MatrixFileOptions& file_options)
      : file_(file_options),
        progress_(options.distance.progress),
        cancel_(options.distance.cancel),
        all_(domain, rows, std::nullopt, limited(options, radius)),
        path_(detail::followed(path.string())),
        folder_(path_.string() + ".part") {
    detail::require_sparse_memory(all_, kType, options.memory_limit);
    blocks_ = all_.blocks_by_place(kThreadRows);
    cut_into_files();
    detail::LedgerHead head;
    head.matrix =
        detail::fingerprint_of(domain, rows, std::nullopt, kType, limited(options, radius).distance, file_options.unit);
    detail::Fingerprint layout;
    layout.add(std::string_view("sparse"));
    layout.add(std::uint64_t{kFileRows});
    head.layout = layout.value();
    head.rows = all_.count();
    head.columns = all_.columns();
    head.value_bytes = sizeof(T);
    head.entries = files_.size() - 1;
    head.words = "sparse, " + std::to_string(all_.count()) + " rows, radius " + std::to_string(radius) + ", method " +
                 std::string(name_of(options.distance.method));
    ledger_.emplace(
        path_.string() + ".part.rows", head, std::vector<std::uint64_t>{}, [&] { return fs::is_directory(folder_); },
        [&] {
          std::error_code error;
          fs::remove_all(folder_, error);
          require_room();
          fs::create_directory(folder_, error);
          if (error) throw Error(ErrorCode::FileNotWritable, folder_.string() + ": " + error.message());
        });
    found_ = all_.count();
    for (const std::size_t file : ledger_->missing(0, ledger_->entries())) found_ -= numbers_of(file).size();
  }

  // Rows that were there when it was joined.
  std::size_t found() const { return found_; }

  std::uint64_t run() {
    const CancelScope listen(cancel_);
    for (std::vector<std::size_t> missing; !(missing = ledger_->missing(0, ledger_->entries())).empty();) {
      bool computed = false;
      for (const std::size_t block : missing) {
        if (!ledger_->claim(block)) continue;
        compute(block);
        computed = true;
      }
      if (!computed) wait_for(missing);
    }
    std::uint64_t entries = 0;
    ledger_->finish([&] {
      SparseMatrix<T> matrix = joined();
      if (file_.symmetry) matrix = symmetrized(matrix, *file_.symmetry);
      write_sparse_matrix(path_.string(), matrix);
      entries = matrix.value.size();
      std::error_code error;
      fs::remove_all(folder_, error);
      ledger_->remove();
    });
    return entries;
  }

 private:
  static constexpr ValueType kType = std::is_same_v<T, float> ? ValueType::Float32 : ValueType::Float64;

  static MatrixOptions limited(const MatrixOptions& options, double radius) {
    if (!std::isfinite(radius) || radius < 0) {
      throw Error(ErrorCode::InvalidArgument, "radius " + std::to_string(radius) + " is not a finite number >= 0");
    }
    MatrixOptions o = options;
    o.distance.max_distance = std::min(radius, o.distance.max_distance);
    return o;
  }

  // Blocks and the file that they become are there together for a while.
  void require_room() {
    const double rows = static_cast<double>(all_.count()), bytes = 2 * (sizeof(Index) + sizeof(T));
    std::error_code error;
    const fs::path folder = path_.parent_path();
    const fs::space_info space = fs::space(folder.empty() ? "." : folder, error);
    if (error || rows * static_cast<double>(all_.columns()) * bytes <= static_cast<double>(space.available)) return;
    detail::require_disk(path_, all_.count(),
                         static_cast<std::uint64_t>(detail::expected_entries(all_) / std::max(1.0, rows) * bytes));
  }

  // Rows that are computed together are in one file.
  void cut_into_files() {
    files_.push_back(0);
    for (std::size_t b = 1; b < blocks_.begin.size(); ++b) {
      const std::size_t rows = blocks_.begin[b] - blocks_.begin[files_.back()];
      if (rows >= kFileRows || b + 1 == blocks_.begin.size()) files_.push_back(b);
    }
  }
  std::size_t first_of(std::size_t file) const { return blocks_.begin[files_[file]]; }
  std::span<const std::size_t> numbers_of(std::size_t file) const {
    return std::span(blocks_.numbers).subspan(first_of(file), first_of(file + 1) - first_of(file));
  }
  fs::path file_of(std::size_t file) const { return folder_ / std::to_string(file); }

  // Sizes of the rows, then their columns, then their values.
  void compute(std::size_t file) {
    const std::span<const std::size_t> numbers = numbers_of(file);
    std::vector<detail::SparseEntries<T>> rows(numbers.size());
    std::vector<std::pair<std::size_t, std::size_t>> place;  // of a row's number: where it is in the file
    for (std::size_t k = 0; k < numbers.size(); ++k) place.emplace_back(numbers[k], k);
    std::sort(place.begin(), place.end());
    const double before = static_cast<double>(ledger_->done()), blocks = static_cast<double>(ledger_->entries());
    Progress part;
    if (progress_) part = [&](double share) { progress_((before + share) / blocks); };
    all_.run_blocks(blocks_, files_[file], files_[file + 1], part, [&](std::size_t, std::size_t i, const auto& f) {
      detail::SparseEntries<T>& row =
          rows[std::lower_bound(place.begin(), place.end(), std::pair(i, std::size_t{0}))->second];
      row.column.assign(f.vertex.begin(), f.vertex.end());
      row.value.assign(f.distance.begin(), f.distance.end());
      if (file_.unit != 1) row.value = detail::in_unit(std::span<const T>(row.value), file_.unit);
    });
    detail::Output output(file_of(file).string());
    for (const detail::SparseEntries<T>& row : rows)
      output.value(static_cast<std::uint32_t>(row.column.size()), std::endian::little);
    for (const detail::SparseEntries<T>& row : rows)
      output.values(std::span<const Index>(row.column), std::endian::little);
    for (const detail::SparseEntries<T>& row : rows) output.values(std::span<const T>(row.value), std::endian::little);
    output.commit();
    ledger_->mark(file);
    ledger_->release(file);
  }

  void wait_for(const std::vector<std::size_t>& blocks) const {
    constexpr std::chrono::milliseconds kPause{50};
    while (std::none_of(blocks.begin(), blocks.end(), [&](std::size_t b) { return ledger_->is_free(b); })) {
      stop_if_cancelled();
      std::this_thread::sleep_for(kPause);
    }
  }

  std::string content_of(std::size_t block) const {
    std::ifstream file(file_of(block), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  [[noreturn]] void throw_short(std::size_t block) const {
    throw Error(ErrorCode::FileNotWritable,
                file_of(block).string() + ": was cut short: remove " + path_.string() + ".part.rows to begin anew");
  }

  // The rows in their order: once for the sizes, once for what is in them.
  SparseMatrix<T> joined() const {
    SparseMatrix<T> m;
    m.columns = static_cast<Index>(all_.columns());
    m.row_start.assign(all_.count() + 1, 0);
    const std::size_t blocks = ledger_->entries();
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::span<const std::size_t> numbers = numbers_of(b);
      std::ifstream file(file_of(b), std::ios::binary);
      std::string sizes(4 * numbers.size(), '\0');
      if (!file.read(sizes.data(), static_cast<std::streamsize>(sizes.size()))) throw_short(b);
      for (std::size_t k = 0; k < numbers.size(); ++k) {
        m.row_start[numbers[k] + 1] = detail::load<std::uint32_t>(sizes.data() + 4 * k, std::endian::little);
      }
    }
    for (std::size_t i = 0; i < all_.count(); ++i) m.row_start[i + 1] += m.row_start[i];
    const std::uint64_t entries = m.row_start.back();
    require_memory(entries * (sizeof(Index) + sizeof(T)), 0,
                   "a sparse matrix of " + std::to_string(entries) + " entries",
                   "its blocks stay: put it together where there is more memory, or take a smaller radius");
    m.column.resize(static_cast<std::size_t>(entries));
    m.value.resize(static_cast<std::size_t>(entries));
    for (std::size_t b = 0; b < blocks; ++b) take_block(b, m);
    return m;
  }

  void take_block(std::size_t block, SparseMatrix<T>& m) const {
    stop_if_cancelled();
    const std::string bytes = content_of(block);
    const std::span<const std::size_t> numbers = numbers_of(block);
    std::size_t entries = 0;
    for (const std::size_t i : numbers) entries += static_cast<std::size_t>(m.row_start[i + 1] - m.row_start[i]);
    const std::size_t columns = 4 * numbers.size(), values = columns + 4 * entries;
    if (bytes.size() != values + sizeof(T) * entries) throw_short(block);
    std::size_t k = 0;
    for (const std::size_t i : numbers) {
      for (auto to = static_cast<std::size_t>(m.row_start[i]); to < m.row_start[i + 1]; ++to, ++k) {
        m.column[to] = detail::load<Index>(bytes.data() + columns + 4 * k, std::endian::little);
        m.value[to] = detail::load<T>(bytes.data() + values + sizeof(T) * k, std::endian::little);
      }
    }
  }

  MatrixFileOptions file_;
  Progress progress_;
  const CancelToken* cancel_;
  detail::Rows all_;
  fs::path path_, folder_;
  detail::Rows::Blocks blocks_;
  std::vector<std::size_t> files_;  // which block each file begins with, and at the end all blocks
  std::optional<detail::RowLedger> ledger_;
  std::size_t found_ = 0;
};

template <class T>
std::uint64_t write_as(const fs::path& path, const Domain& domain, double radius, Places rows,
                       const MatrixOptions& options, const MatrixFileOptions& file_options, std::size_t* found) {
  if (path.extension() != ".npz" && path.extension() != ".mtx") {
    throw Error(ErrorCode::UnknownFormat, path.string() + ": a sparse matrix is written as .npz or .mtx");
  }
  if (file_options.shards != 1) {
    throw Error(ErrorCode::InvalidArgument, "sparse rows have no shards: ask for ranges of rows");
  }
  detail::require_unit(file_options.unit);
  if (file_options.symmetry && rows) {
    throw Error(ErrorCode::InvalidArgument, "a symmetric matrix needs rows and columns that are the same places");
  }
  SparseJob<T> job(path, domain, radius, rows, options, file_options);
  if (found != nullptr) *found = job.found();
  return job.run();
}

}  // namespace

std::uint64_t write_distances_within(const fs::path& path, const Domain& domain, double radius, Places rows,
                                     ValueType type, const MatrixOptions& options,
                                     const MatrixFileOptions& file_options, std::size_t* found) {
  return type == ValueType::Float32 ? write_as<float>(path, domain, radius, rows, options, file_options, found)
                                    : write_as<double>(path, domain, radius, rows, options, file_options, found);
}

}  // namespace brushfire
