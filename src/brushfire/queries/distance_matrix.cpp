// Rows by solver runs; dense rows are scattered into the caller's memory, sparse rows collected block by block.
#include <brushfire/queries/distance_matrix.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/memory.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/locality_order.h>
#include <brushfire/queries/detail/rows.h>
#include <brushfire/solvers/carried_source/detail/grouped_rows.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>

namespace brushfire {
namespace detail {
namespace {

void check_vertex(const Mesh& mesh, Index v) {
  if (v < mesh.vertex_count()) return;
  throw Error(ErrorCode::IndexOutOfRange, "vertex " + std::to_string(v) + " does not exist: the mesh has " +
                                              std::to_string(mesh.vertex_count()) + " vertices");
}

// A surface point of the place; none for a vertex in no face.
std::optional<SurfacePoint> point_of(const Mesh& mesh, const Place& place) {
  if (const SurfacePoint* p = std::get_if<SurfacePoint>(&place)) {
    locate(mesh, *p);  // throws where it is no point of the mesh
    return *p;
  }
  const Index v = std::get<Index>(place);
  check_vertex(mesh, v);
  if (mesh.corners(v).empty()) return std::nullopt;
  return vertex_point(mesh, v);
}

std::size_t size_of(const Mesh& mesh, const Places& places) { return places ? places->size() : mesh.vertex_count(); }

}  // namespace

std::vector<std::size_t> numbers_below(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

Rows::Rows(const Domain& domain, Places rows, Places columns, const MatrixOptions& options)
    : domain_(domain),
      mesh_(domain.mesh()),
      rows_(rows),
      row_count_(size_of(mesh_, rows)),
      column_count_(size_of(mesh_, columns)),
      all_columns_(!columns),
      options_(options.distance),
      team_(static_cast<unsigned>(std::clamp<std::size_t>(row_count_, 1, thread_count(options.threads)))),
      workers_(team_.size()) {
  if (!options_.targets.empty()) {
    throw Error(ErrorCode::InvalidArgument, "the targets of a matrix are its columns: targets must be empty");
  }
  options_.progress = nullptr;
  if (rows_) {
    for (const Place& p : *rows_) point_of(mesh_, p);
  }
  for (std::size_t j = 0; columns && j < columns->size(); ++j) {
    const std::optional<SurfacePoint> p = point_of(mesh_, (*columns)[j]);
    if (!p) continue;
    options_.targets.push_back(*p);
    target_column_.push_back(j);
  }
  // So many rows ask about every face: the mesh's arrays once, instead of single answers again and again.
  constexpr std::size_t kAskedOften = 16;
  if (row_count_ >= mesh_.vertex_count() / kAskedOften && options_.method != Method::Dijkstra) {
    domain.open().lengths();
    domain.open().opposite();
  }
}

std::optional<SurfacePoint> Rows::place(std::size_t i) const {
  return point_of(mesh_, rows_ ? (*rows_)[i] : Place(static_cast<Index>(i)));
}

void Rows::compute_row(Worker& worker, std::size_t i) {
  const std::optional<SurfacePoint> p = place(i);
  if (!p || (!all_columns_ && options_.targets.empty()) || (domain_.has_walls() && domain_.on_open(*p).empty())) {
    worker.field = {};
    worker.field.target_distance.assign(options_.targets.size(), kInfinity);
    return;
  }
  if (!worker.solver) worker.solver = std::make_unique<DistanceSolver>(domain_);
  const Source source{*p, 0};
  worker.solver->distance_sparse(std::span(&source, 1), options_, worker.field);
}

void Rows::run_sparse(std::span<const std::size_t> numbers, std::size_t block, const Progress& progress,
                      const TakeSparse& take) {
  const CancelScope listen(options_.cancel);
  std::atomic<std::size_t> done{0};
  const auto body = [&](unsigned worker, std::size_t b) {
    Worker& w = workers_[worker];
    const std::size_t end = std::min(numbers.size(), (b + 1) * block);
    for (std::size_t k = b * block; k < end; ++k) {
      stop_if_cancelled();
      compute_row(w, numbers[k]);
      take(worker, k, w.field);
    }
    const std::size_t finished = done.fetch_add(end - b * block, std::memory_order_relaxed) + end - b * block;
    if (worker == 0 && progress) progress(static_cast<double>(finished) / static_cast<double>(numbers.size()));
  };
  team_.run((numbers.size() + block - 1) / block, body, current_cancel_token());
}

std::vector<std::size_t> Rows::numbers_by_place() const {
  constexpr std::size_t kMany = 1024;
  std::vector<std::size_t> numbers = numbers_below(row_count_);
  if (row_count_ < kMany) return numbers;
  const LocalityOrder order = locality_order(mesh_);
  if (!rows_) return {order.vertices.begin(), order.vertices.end()};
  const auto rank = [&](std::size_t i) {
    const SurfacePoint* p = std::get_if<SurfacePoint>(&(*rows_)[i]);
    return order.vertex_rank[p ? mesh_.faces()[p->face][0] : std::get<Index>((*rows_)[i])];
  };
  detail::stable_sort(numbers.begin(), numbers.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return numbers;
}

template <>
std::vector<double>& Rows::Worker::values() {
  return doubles;
}
template <>
std::vector<float>& Rows::Worker::values() {
  return floats;
}

template <class T>
void Rows::compute_dense_row(unsigned worker, std::size_t i, const TakeDense<T>& take) {
  Worker& w = workers_[worker];
  compute_row(w, i);
  std::vector<T>& values = w.values<T>();
  values.assign(column_count_, std::numeric_limits<T>::infinity());
  if (all_columns_) {
    for (std::size_t k = 0; k < w.field.vertex.size(); ++k) {
      values[w.field.vertex[k]] = static_cast<T>(w.field.distance[k]);
    }
  } else {
    for (std::size_t t = 0; t < target_column_.size(); ++t) {
      values[target_column_[t]] = static_cast<T>(w.field.target_distance[t]);
    }
  }
  take(worker, i, values);
}

template <class T>
void Rows::run_dense(std::span<const std::size_t> numbers, const Progress& progress, const TakeDense<T>& take,
                     const Claim& claim) {
  if (can_group()) return run_grouped<T>(numbers, progress, take, claim);
  const CancelScope listen(options_.cancel);
  std::atomic<std::size_t> done{0};
  const auto body = [&](unsigned worker, std::size_t k) {
    stop_if_cancelled();
    if (!claim || claim(numbers[k])) compute_dense_row<T>(worker, numbers[k], take);
    const std::size_t finished = done.fetch_add(1, std::memory_order_relaxed) + 1;
    if (worker == 0 && progress) progress(static_cast<double>(finished) / static_cast<double>(numbers.size()));
  };
  team_.run(numbers.size(), body, current_cancel_token());
}

template void Rows::run_dense<float>(std::span<const std::size_t>, const Progress&, const TakeDense<float>&,
                                     const Claim&);
template void Rows::run_dense<double>(std::span<const std::size_t>, const Progress&, const TakeDense<double>&,
                                      const Claim&);
template void Rows::compute_dense_row<float>(unsigned, std::size_t, const TakeDense<float>&);
template void Rows::compute_dense_row<double>(unsigned, std::size_t, const TakeDense<double>&);

}  // namespace detail

namespace {

template <class T>
constexpr ValueType kValueType = std::is_same_v<T, float> ? ValueType::Float32 : ValueType::Float64;

std::string size_text(std::size_t rows, std::size_t columns, ValueType type) {
  return "a " + std::to_string(rows) + " x " + std::to_string(columns) +
         (type == ValueType::Float32 ? " float32 matrix" : " float64 matrix");
}

template <class T>
void compute(detail::Rows& rows, std::span<T> result, const Progress& progress) {
  const std::size_t columns = rows.columns();
  rows.run_dense<T>(
      detail::numbers_below(rows.count()), progress, [&](unsigned, std::size_t i, std::span<const T> values) {
        std::copy(values.begin(), values.end(), result.begin() + static_cast<std::ptrdiff_t>(i * columns));
      });
}

}  // namespace

void require_dense_memory(std::size_t rows, std::size_t columns, ValueType type, std::uint64_t limit) {
  const bool is_float = type == ValueType::Float32;
  const double bytes = static_cast<double>(rows) * static_cast<double>(columns) * (is_float ? 4 : 8);
  // Beyond what 64 bits count it is too large all the same.
  const std::uint64_t counted = bytes < 0x1p63 ? static_cast<std::uint64_t>(bytes) : ~std::uint64_t{0};
  const std::uint64_t fit =
      (limit == 0 ? available_memory() : limit) / std::max<std::uint64_t>(1, columns) / (is_float ? 4 : 8);
  require_memory(counted, limit, size_text(rows, columns, type),
                 "ask for fewer rows or columns (" + std::to_string(fit) + " rows would fit), " +
                     (is_float ? "" : "for float32, ") +
                     "for distances within a radius (sparse), or have it written to a .npy file");
}

template <class T>
void distance_matrix(const Domain& domain, Places rows, Places columns, std::span<T> result,
                     const MatrixOptions& options) {
  detail::Rows all(domain, rows, columns, options);
  if (result.size() != std::uint64_t{all.count()} * all.columns()) {
    throw Error(ErrorCode::InvalidArgument, "memory for " + std::to_string(result.size()) + " values was given for " +
                                                size_text(all.count(), all.columns(), kValueType<T>));
  }
  compute(all, result, options.distance.progress);
}

template <class T>
std::vector<T> distance_matrix(const Domain& domain, Places rows, Places columns, const MatrixOptions& options) {
  detail::Rows all(domain, rows, columns, options);
  require_dense_memory(all.count(), all.columns(), kValueType<T>, options.memory_limit);
  std::vector<T> result(all.count() * all.columns());
  compute(all, std::span<T>(result), options.distance.progress);
  return result;
}

namespace {

// The sample of rows from which the size of a sparse result is expected.
constexpr std::size_t kSampleRows = 32;

// Short rows are computed and kept this many at a time.
constexpr std::size_t kBlockRows = 32;

// What a sparse matrix takes while its rows are put together: every entry is there twice for a moment.
template <class T>
class SparseBudget {
 public:
  SparseBudget(std::size_t rows, std::uint64_t limit) : rows_(rows), limit_(limit == 0 ? available_memory() : limit) {}

  bool fits(double entries) const { return bytes(entries) <= static_cast<double>(limit_); }
  void require(double entries) const {
    if (fits(entries)) return;
    require_memory(static_cast<std::uint64_t>(std::min(bytes(entries), 0x1p63)), limit_,
                   "a sparse matrix of " + std::to_string(rows_) + " rows with " +
                       std::to_string(static_cast<std::uint64_t>(entries / static_cast<double>(rows_))) +
                       " entries each",
                   "take a smaller radius, or fewer rows at a time: " + std::to_string(rows_that_fit(entries)) +
                       " of them would fit");
  }

 private:
  std::uint64_t rows_that_fit(double entries) const {
    return static_cast<std::uint64_t>(static_cast<double>(rows_) * static_cast<double>(limit_) / bytes(entries));
  }
  double bytes(double entries) const {
    return 2 * entries * (sizeof(Index) + sizeof(T)) + static_cast<double>(rows_) * 64;
  }

  std::size_t rows_;
  std::uint64_t limit_;
};

template <class T>
void check_expected_size(detail::Rows& all, const SparseBudget<T>& budget) {
  const double rows = static_cast<double>(all.count());
  if (budget.fits(rows * static_cast<double>(all.columns()))) return;  // even if every row reaches everything
  budget.require(detail::expected_entries(all));
}

// Where a row's entries begin in its block, and how many there are.
struct RowPlace {
  std::size_t begin = 0;
  Index size = 0;
};

template <class T>
SparseMatrix<T> join(std::vector<detail::SparseEntries<T>>& entries, const detail::Rows::Blocks& blocks,
                     std::span<const RowPlace> rows, std::size_t columns) {
  SparseMatrix<T> m;
  m.columns = static_cast<Index>(columns);
  m.row_start.reserve(rows.size() + 1);
  m.row_start.push_back(0);
  for (const RowPlace& row : rows) m.row_start.push_back(m.row_start.back() + row.size);
  const auto count = static_cast<std::size_t>(m.row_start.back());
  m.column.resize(count);
  m.value.resize(count);
  for (std::size_t b = 0; b < entries.size(); ++b) {
    for (std::size_t k = blocks.begin[b]; k < blocks.begin[b + 1]; ++k) {
      const RowPlace& row = rows[blocks.numbers[k]];
      const auto to = static_cast<std::ptrdiff_t>(m.row_start[blocks.numbers[k]]);
      const auto from = static_cast<std::ptrdiff_t>(row.begin);
      std::copy_n(entries[b].column.cbegin() + from, row.size, m.column.begin() + to);
      std::copy_n(entries[b].value.cbegin() + from, row.size, m.value.begin() + to);
    }
    entries[b] = {};
  }
  return m;
}

}  // namespace

double detail::expected_entries(Rows& all) {
  if (all.count() == 0) return 0;
  std::vector<std::size_t> sample;
  const std::size_t stride = std::max<std::size_t>(1, all.count() / kSampleRows);
  for (std::size_t i = 0; i < all.count(); i += stride) sample.push_back(i);
  std::atomic<std::uint64_t> entries{0};
  all.run_sparse(sample, 1, nullptr, [&](unsigned, std::size_t, const SparseField& f) { entries += f.vertex.size(); });
  return static_cast<double>(entries) / static_cast<double>(sample.size()) * static_cast<double>(all.count());
}

void detail::require_sparse_memory(Rows& all, ValueType type, std::uint64_t limit) {
  type == ValueType::Float32 ? check_expected_size(all, SparseBudget<float>(all.count(), limit))
                             : check_expected_size(all, SparseBudget<double>(all.count(), limit));
}

template <class T>
SparseMatrix<T> distances_within(const Domain& domain, double radius, Places rows, const MatrixOptions& options) {
  if (!std::isfinite(radius) || radius < 0) {
    throw Error(ErrorCode::InvalidArgument, "radius " + std::to_string(radius) + " is not a finite number >= 0");
  }
  MatrixOptions limited = options;
  limited.distance.max_distance = std::min(radius, options.distance.max_distance);
  detail::Rows all(domain, rows, std::nullopt, limited);
  const SparseBudget<T> budget(all.count(), options.memory_limit);
  check_expected_size(all, budget);

  const detail::Rows::Blocks blocks = all.blocks_by_place(kBlockRows);
  std::vector<detail::SparseEntries<T>> of_block(blocks.begin.size() - 1);
  std::vector<RowPlace> row_place(all.count());
  std::atomic<std::uint64_t> entries{0};
  const auto take = [&](std::size_t b, std::size_t i, const SparseField& f) {
    detail::SparseEntries<T>& block = of_block[b];
    row_place[i] = {block.column.size(), static_cast<Index>(f.vertex.size())};
    block.column.insert(block.column.end(), f.vertex.begin(), f.vertex.end());
    block.value.insert(block.value.end(), f.distance.begin(), f.distance.end());
    budget.require(static_cast<double>(entries += f.vertex.size()));
  };
  all.run_blocks(blocks, 0, of_block.size(), options.distance.progress, take);
  return join<T>(of_block, blocks, row_place, all.columns());
}

template void distance_matrix(const Domain&, Places, Places, std::span<float>, const MatrixOptions&);
template void distance_matrix(const Domain&, Places, Places, std::span<double>, const MatrixOptions&);
template std::vector<float> distance_matrix(const Domain&, Places, Places, const MatrixOptions&);
template std::vector<double> distance_matrix(const Domain&, Places, Places, const MatrixOptions&);
template SparseMatrix<float> distances_within(const Domain&, double, Places, const MatrixOptions&);
template SparseMatrix<double> distances_within(const Domain&, double, Places, const MatrixOptions&);

}  // namespace brushfire
