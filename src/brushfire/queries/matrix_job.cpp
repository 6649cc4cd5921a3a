// A job: rows that are claimed in the ledger, computed, put into the store and marked.
#include <brushfire/queries/matrix_job.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/memory.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/temporary_file.h>
#include <brushfire/io/detail/zarr.h>
#include <brushfire/queries/detail/fingerprint.h>
#include <brushfire/queries/detail/little_endian.h>
#include <brushfire/queries/detail/matrix_store.h>
#include <brushfire/queries/detail/matrix_unit.h>
#include <brushfire/queries/detail/nearest_store.h>
#include <brushfire/queries/detail/row_ledger.h>
#include <brushfire/queries/detail/rows.h>
#include <brushfire/queries/detail/shards.h>
#include <brushfire/queries/detail/symmetrize.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <numeric>
#include <system_error>
#include <thread>
#include <utility>

namespace brushfire {

namespace fs = std::filesystem;

namespace {

// For those who read the ledger of an unfinished matrix.
std::string in_words(const detail::Rows& all, ValueType type, const DistanceOptions& options) {
  std::string words = std::to_string(all.count()) + " x " + std::to_string(all.columns()) +
                      (type == ValueType::Float32 ? " float32, method " : " float64, method ") +
                      std::string(name_of(options.method));
  if (options.method == Method::Windows) words += ", tolerance " + detail::readable_number(options.tolerance);
  if (options.max_distance != kInfinity) words += ", radius " + detail::readable_number(options.max_distance);
  return words;
}

// All rows or columns as vertices; empty where one is none.
std::vector<std::int64_t> vertices_of(const Mesh& mesh, const Places& places) {
  std::vector<std::int64_t> vertices;
  if (!places) {
    vertices.resize(mesh.vertex_count());
    std::iota(vertices.begin(), vertices.end(), std::int64_t{0});
    return vertices;
  }
  for (const Place& p : *places) {
    const SurfacePoint* point = std::get_if<SurfacePoint>(&p);
    const std::optional<PointLocation> at = point ? std::optional(locate(mesh, *point)) : std::nullopt;
    if (at && at->on != PointLocation::On::Vertex) return {};
    vertices.push_back(at ? at->vertex : std::get<Index>(p));
  }
  return vertices;
}

void check(const fs::path& path, const Places& rows, const Places& columns, const MatrixFileOptions& options) {
  const auto refuse = [](const std::string& why) { throw Error(ErrorCode::InvalidArgument, why); };
  if (options.zarr_format != 2 && options.zarr_format != 3) {
    refuse("Zarr has the formats 2 and 3, not " + std::to_string(options.zarr_format));
  }
  if (options.shard < 1 || options.shard > options.shards) {
    refuse("shard " + std::to_string(options.shard) + " of " + std::to_string(options.shards) +
           ": shards are numbered from 1 on");
  }
  detail::require_unit(options.unit);
  if (options.nearest > 0 && path.extension() != ".npy") refuse("the nearest of every row are written as .npy");
  if (options.nearest > 0 && options.shards > 1) {
    refuse("a shard holds whole rows: choose the nearest when the shards are merged");
  }
  if (!options.symmetry) return;
  if (options.nearest > 0) refuse("the nearest of every row are no symmetric matrix");
  if (options.shards > 1 && path.extension() == ".npy") {
    refuse("a shard holds one direction of a pair only: make the merged matrix symmetric");
  }
  detail::Fingerprint of_rows, of_columns;
  of_rows.add(rows), of_columns.add(columns);
  if (of_rows.value() != of_columns.value())
    refuse("a symmetric matrix needs rows and columns that are the same places");
}

}  // namespace

struct MatrixJob::State {
  State(const fs::path& path, const Domain& domain, Places row_places, Places columns, ValueType value_type,
        const MatrixOptions& given, const MatrixFileOptions& file_options)
      : file(file_options),
        type(value_type),
        options(given),
        all(domain, row_places, columns, given),
        output(detail::followed(path.string())) {
    check(path, row_places, columns, file);
    detail::require_columns(file.nearest, all.columns());
    radii = {given.distance.max_distance};
    if (file.nearest > 0 && !columns) {
      radii = detail::radii_for_nearest(domain.mesh(), file.nearest, given.distance.max_distance);
    }
    choose_rows();
    if (own_file) output = detail::shard_path(output, file.shard, file.shards);
    describe(domain, row_places, columns);
    store = detail::open_store(output, stored, file);
    ledger_path = output.string() + ".part.rows";
    complete = is_complete();
    if (!complete) join();
  }

  // Which rows this process may compute.
  void choose_rows() {
    const bool shards = file.shards > 1;
    own_file = shards && output.extension() == ".npy";
    if (!shards) {
      numbers = detail::numbers_below(all.count());
      return;
    }
    numbers = detail::block_of(units(), file.shard - 1, file.shards);
    std::sort(numbers.begin(), numbers.end());
  }

  void describe(const Domain& domain, const Places& row_places, const Places& columns) {
    stored.rows = own_file ? numbers.size() : all.count();
    stored.columns = all.columns();
    stored.type = type;
    head.matrix = detail::fingerprint_of(domain, row_places, columns, type, options.distance, file.unit);
    head.rows = all.count();
    head.columns = all.columns();
    head.value_bytes = stored.value_bytes();
    if (own_file) head.shard = file.shard, head.shards = file.shards;
    head.all_vertices = (row_places ? 0u : 1u) | (columns ? 0u : 2u);
    head.entries = stored.rows;
    head.words = in_words(all, type, options.distance);
    if (file.nearest > 0) head.words += ", the nearest " + std::to_string(file.nearest);
    if (file.unit != 1) head.words += ", in units of " + detail::readable_number(file.unit);
    head.layout = detail::layout_of(output, stored, file);
    stored.row_vertices = vertices_of(domain.mesh(), row_places);
    stored.column_vertices = vertices_of(domain.mesh(), columns);
    stored.attributes = detail::attributes_of(head);
  }

  // Of a .npy file that is no shard nothing tells what it holds.
  bool is_complete() const {
    if (fs::exists(ledger_path)) return false;
    if (output.extension() == ".zarr") return store->is_there();
    if (!own_file || !store->is_there()) return false;
    const auto there = detail::RowLedger::read(output.string() + ".rows");
    return there && there->head.matrix == head.matrix && there->head.shard == head.shard &&
           there->head.shards == head.shards && there->done == there->head.entries;
  }

  void join() {
    const std::vector<std::uint64_t> listed =
        own_file ? std::vector<std::uint64_t>(numbers.begin(), numbers.end()) : std::vector<std::uint64_t>{};
    ledger.emplace(
        ledger_path, head, listed, [&] { return store->is_there(); },
        [&] {
          std::remove(journal().c_str());
          store->begin();
        });
  }

  const detail::Rows::ByUnits& units() {
    if (!by_units) by_units = all.by_units();
    return *by_units;
  }

  // Where row i of the matrix is in the store.
  std::size_t entry(std::size_t i) const {
    if (!own_file) return i;
    return static_cast<std::size_t>(std::lower_bound(numbers.begin(), numbers.end(), i) - numbers.begin());
  }

  std::vector<std::size_t> missing(std::span<const std::size_t> of) const {
    const std::vector<std::size_t> entries = ledger->missing(0, ledger->entries());
    std::vector<std::size_t> left;
    for (const std::size_t i : of) {
      if (std::binary_search(entries.begin(), entries.end(), entry(i))) left.push_back(i);
    }
    return left;
  }

  // Rows that have not found enough within one radius try the next.
  template <class T>
  std::size_t compute(std::vector<std::size_t> rows) {
    std::atomic<std::size_t> computed{0};
    const std::size_t before = ledger->entries() - rows.size();
    Progress part;
    if (options.distance.progress) {
      part = [&](double) {
        options.distance.progress(static_cast<double>(before + computed) / static_cast<double>(ledger->entries()));
      };
    }
    for (const double radius : radii) {
      all.set_radius(radius);
      const std::size_t enough = radius < radii.back() ? static_cast<std::size_t>(file.nearest) : 0;
      std::mutex mutex;
      std::vector<std::size_t> again;
      all.run_dense<T>(
          rows, part,
          [&](unsigned, std::size_t i, std::span<const T> values) {
            if (detail::has_finite(values, enough)) {
              const std::vector<T> scaled = detail::in_unit(values, file.unit);
              put(entry(i), std::span<const char>(detail::as_little_endian(std::span<const T>(scaled))));
              ++computed;
            } else {
              ledger->release(entry(i));
              const std::lock_guard lock(mutex);
              again.push_back(i);
            }
          },
          [&](std::size_t i) { return ledger->claim(entry(i)); });
      rows = std::move(again);
      if (rows.empty()) break;
      std::sort(rows.begin(), rows.end());
    }
    return computed;
  }
  std::size_t compute_rows(const std::vector<std::size_t>& rows) {
    return type == ValueType::Float32 ? compute<float>(rows) : compute<double>(rows);
  }

  void put(std::size_t at, std::span<const char> bytes) const {
    store->write(at, 0, bytes);
    ledger->mark(at);
    ledger->release(at);
    const std::size_t unit = static_cast<std::size_t>(store->rows_of_unit());
    if (unit == 0) return;
    const std::size_t begin = at / unit * unit, end = std::min(begin + unit, ledger->entries());
    if (ledger->are_done(begin, end)) store->complete(at);
  }

  // Until a row is there or nobody's that is missing.
  void wait_for(const std::vector<std::size_t>& rows) const {
    constexpr std::chrono::milliseconds kPause{50};
    const CancelScope listen(options.distance.cancel);
    while (std::none_of(rows.begin(), rows.end(), [&](std::size_t i) { return ledger->is_free(entry(i)); })) {
      stop_if_cancelled();
      std::this_thread::sleep_for(kPause);
    }
  }

  std::string journal() const { return output.string() + ".part.pair"; }

  void finish() const {
    const CancelScope listen(options.distance.cancel);
    ledger->finish([&] {
      if (file.symmetry && !store->is_finished()) {
        detail::symmetrize(*store, stored.rows, type, *file.symmetry, journal());
      }
      store->finish();
      std::remove(journal().c_str());
      own_file ? ledger->keep_as(output.string() + ".rows") : ledger->remove();
    });
  }

  MatrixFileOptions file;
  ValueType type;
  MatrixOptions options;
  detail::Rows all;
  fs::path output;
  std::string ledger_path;
  bool own_file = false;  // which holds the rows of this shard alone
  std::vector<std::size_t> numbers;
  std::vector<double> radii;  // ascending; to the last one all that is wanted is found
  std::optional<detail::Rows::ByUnits> by_units;
  detail::StoredMatrix stored;
  detail::LedgerHead head;
  std::unique_ptr<detail::MatrixStore> store;
  std::optional<detail::RowLedger> ledger;
  bool complete = false;
};

MatrixJob::MatrixJob(const fs::path& path, const Domain& domain, Places rows, Places columns, ValueType type,
                     const MatrixOptions& options, const MatrixFileOptions& file_options)
    : state_(std::make_unique<State>(path, domain, rows, columns, type, options, file_options)) {}

MatrixJob::~MatrixJob() = default;

std::size_t MatrixJob::rows() const { return state_->numbers.size(); }
std::size_t MatrixJob::columns() const { return state_->all.columns(); }
fs::path MatrixJob::output() const { return state_->output; }
bool MatrixJob::is_complete() const { return state_->complete; }

std::size_t MatrixJob::found() const {
  if (state_->complete) return rows();
  return state_->own_file || state_->file.shards == 1 ? state_->ledger->found() : done();
}

std::size_t MatrixJob::done() const {
  return state_->complete ? rows() : rows() - state_->missing(state_->numbers).size();
}

void MatrixJob::run() {
  if (state_->complete) return;
  for (;;) {
    const std::vector<std::size_t> missing = state_->missing(state_->numbers);
    if (missing.empty()) break;
    if (state_->compute_rows(missing) == 0) state_->wait_for(missing);
  }
  if (state_->ledger->done() < state_->ledger->entries()) return;  // the rest is other shards'
  state_->finish();
  state_->complete = true;
}

std::size_t MatrixJob::run_block(std::size_t block, std::size_t count) {
  if (state_->complete) return 0;
  std::vector<std::size_t> rows = detail::block_of(state_->units(), block, count);
  std::sort(rows.begin(), rows.end());
  return state_->compute_rows(state_->missing(rows));
}

void write_distance_matrix(const fs::path& path, const Domain& domain, Places rows, Places columns, ValueType type,
                           const MatrixOptions& options) {
  MatrixJob(path, domain, rows, columns, type, options).run();
}

}  // namespace brushfire
