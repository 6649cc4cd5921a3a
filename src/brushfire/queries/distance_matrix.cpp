// Rows by solver runs; dense rows are scattered into the caller's memory, sparse rows collected block by block.
#include <brushfire/queries/distance_matrix.h>

#include <brushfire/core/error.h>
#include <brushfire/core/memory.h>
#include <brushfire/queries/detail/rows.h>

#include <algorithm>
#include <atomic>
#include <cmath>
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

Rows::Rows(const Mesh& mesh, Places rows, Places columns, const MatrixOptions& options)
    : mesh_(mesh),
      rows_(rows),
      row_count_(size_of(mesh, rows)),
      column_count_(size_of(mesh, columns)),
      all_columns_(!columns),
      options_(options.distance),
      team_(static_cast<unsigned>(std::clamp<std::size_t>(row_count_, 1, thread_count(options.threads)))),
      solvers_(team_.size()) {
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
}

std::optional<SurfacePoint> Rows::place(std::size_t i) const {
  return point_of(mesh_, rows_ ? (*rows_)[i] : Place(static_cast<Index>(i)));
}

SparseField Rows::row(unsigned worker, std::size_t i) {
  SparseField field;
  const std::optional<SurfacePoint> p = place(i);
  if (!p || (!all_columns_ && options_.targets.empty())) {
    field.target_distance.assign(options_.targets.size(), kInfinity);
    return field;
  }
  if (!solvers_[worker]) solvers_[worker] = std::make_unique<DistanceSolver>(mesh_);
  const Source source{*p, 0};
  return solvers_[worker]->distance_sparse(std::span(&source, 1), options_);
}

void Rows::run_sparse(std::span<const std::size_t> numbers, const Progress& progress, const TakeSparse& take) {
  std::atomic<std::size_t> done{0};
  const auto body = [&](unsigned worker, std::size_t k) {
    take(worker, numbers[k], row(worker, numbers[k]));
    const std::size_t finished = done.fetch_add(1, std::memory_order_relaxed) + 1;
    if (worker == 0 && progress) progress(static_cast<double>(finished) / static_cast<double>(numbers.size()));
  };
  team_.run(numbers.size(), body, options_.cancel);
}

void Rows::fill(const SparseField& field, std::span<double> values) const {
  std::fill(values.begin(), values.end(), kInfinity);
  if (all_columns_) {
    for (std::size_t k = 0; k < field.vertex.size(); ++k) values[field.vertex[k]] = field.distance[k];
  } else {
    for (std::size_t t = 0; t < target_column_.size(); ++t) values[target_column_[t]] = field.target_distance[t];
  }
}

void Rows::run_dense(std::span<const std::size_t> numbers, const Progress& progress, const TakeDense& take) {
  std::vector<std::vector<double>> values(team_.size());
  run_sparse(numbers, progress, [&](unsigned worker, std::size_t i, const SparseField& field) {
    values[worker].resize(column_count_);
    fill(field, values[worker]);
    take(worker, i, values[worker]);
  });
}

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
  rows.run_dense(
      detail::numbers_below(rows.count()), progress, [&](unsigned, std::size_t i, std::span<const double> values) {
        std::transform(values.begin(), values.end(), result.begin() + static_cast<std::ptrdiff_t>(i * columns),
                       [](double d) { return static_cast<T>(d); });
      });
}

}  // namespace

void require_dense_memory(std::size_t rows, std::size_t columns, ValueType type, std::uint64_t limit) {
  const bool is_float = type == ValueType::Float32;
  const double bytes = static_cast<double>(rows) * static_cast<double>(columns) * (is_float ? 4 : 8);
  // Beyond what 64 bits count it is too large all the same.
  const std::uint64_t counted = bytes < 0x1p63 ? static_cast<std::uint64_t>(bytes) : ~std::uint64_t{0};
  require_memory(counted, limit, size_text(rows, columns, type),
                 std::string("ask for fewer rows or columns, ") + (is_float ? "" : "for float32, ") +
                     "for distances within a radius (sparse), or have it written to a .npy file");
}

template <class T>
void distance_matrix(const Mesh& mesh, Places rows, Places columns, std::span<T> result, const MatrixOptions& options) {
  detail::Rows all(mesh, rows, columns, options);
  if (result.size() != all.count() * all.columns()) {
    throw Error(ErrorCode::InvalidArgument, "memory for " + std::to_string(result.size()) + " values was given for " +
                                                size_text(all.count(), all.columns(), kValueType<T>));
  }
  compute(all, result, options.distance.progress);
}

template <class T>
std::vector<T> distance_matrix(const Mesh& mesh, Places rows, Places columns, const MatrixOptions& options) {
  detail::Rows all(mesh, rows, columns, options);
  require_dense_memory(all.count(), all.columns(), kValueType<T>, options.memory_limit);
  std::vector<T> result(all.count() * all.columns());
  compute(all, std::span<T>(result), options.distance.progress);
  return result;
}

namespace {

// The sample of rows from which the size of a sparse result is expected.
constexpr std::size_t kSampleRows = 32;

template <class T>
struct SparseRow {
  std::vector<Index> column;
  std::vector<T> value;
};

// What a sparse matrix takes while its rows are put together: every entry is there twice for a moment.
template <class T>
class SparseBudget {
 public:
  SparseBudget(std::size_t rows, std::uint64_t limit) : rows_(rows), limit_(limit == 0 ? available_memory() : limit) {}

  void require(double entries) const {
    const double bytes = 2 * entries * (sizeof(Index) + sizeof(T)) + static_cast<double>(rows_) * 64;
    require_memory(static_cast<std::uint64_t>(std::min(bytes, 0x1p63)), limit_,
                   "a sparse matrix of " + std::to_string(rows_) + " rows with " +
                       std::to_string(static_cast<std::uint64_t>(entries / static_cast<double>(rows_))) +
                       " entries each",
                   "take a smaller radius, or fewer rows at a time");
  }
  bool fits(double entries) const {
    try {
      require(entries);
      return true;
    } catch (const Error&) {
      return false;
    }
  }

 private:
  std::size_t rows_;
  std::uint64_t limit_;
};

template <class T>
void check_expected_size(detail::Rows& all, const SparseBudget<T>& budget) {
  const double rows = static_cast<double>(all.count());
  if (budget.fits(rows * static_cast<double>(all.columns()))) return;  // even if every row reaches everything
  std::vector<std::size_t> sample;
  const std::size_t stride = std::max<std::size_t>(1, all.count() / kSampleRows);
  for (std::size_t i = 0; i < all.count(); i += stride) sample.push_back(i);
  std::atomic<std::uint64_t> entries{0};
  all.run_sparse(sample, nullptr, [&](unsigned, std::size_t, const SparseField& f) { entries += f.vertex.size(); });
  budget.require(static_cast<double>(entries) / static_cast<double>(sample.size()) * rows);
}

template <class T>
SparseMatrix<T> join(std::vector<SparseRow<T>>& rows, std::size_t columns) {
  SparseMatrix<T> m;
  m.columns = static_cast<Index>(columns);
  m.row_start.reserve(rows.size() + 1);
  m.row_start.push_back(0);
  for (const SparseRow<T>& r : rows) m.row_start.push_back(m.row_start.back() + r.column.size());
  m.column.reserve(m.row_start.back());
  m.value.reserve(m.row_start.back());
  for (SparseRow<T>& r : rows) {
    m.column.insert(m.column.end(), r.column.begin(), r.column.end());
    m.value.insert(m.value.end(), r.value.begin(), r.value.end());
    r = {};
  }
  return m;
}

}  // namespace

template <class T>
SparseMatrix<T> distances_within(const Mesh& mesh, double radius, Places rows, const MatrixOptions& options) {
  if (!std::isfinite(radius) || radius < 0) {
    throw Error(ErrorCode::InvalidArgument, "radius " + std::to_string(radius) + " is not a finite number >= 0");
  }
  MatrixOptions limited = options;
  limited.distance.max_distance = std::min(radius, options.distance.max_distance);
  detail::Rows all(mesh, rows, std::nullopt, limited);
  const SparseBudget<T> budget(all.count(), options.memory_limit);
  check_expected_size(all, budget);

  std::vector<SparseRow<T>> collected(all.count());
  std::atomic<std::uint64_t> entries{0};
  all.run_sparse(detail::numbers_below(all.count()), options.distance.progress,
                 [&](unsigned, std::size_t i, const SparseField& f) {
                   budget.require(static_cast<double>(entries += f.vertex.size()));
                   collected[i].column.assign(f.vertex.begin(), f.vertex.end());
                   collected[i].value.reserve(f.distance.size());
                   for (const double d : f.distance) collected[i].value.push_back(static_cast<T>(d));
                 });
  return join(collected, all.columns());
}

template void distance_matrix(const Mesh&, Places, Places, std::span<float>, const MatrixOptions&);
template void distance_matrix(const Mesh&, Places, Places, std::span<double>, const MatrixOptions&);
template std::vector<float> distance_matrix(const Mesh&, Places, Places, const MatrixOptions&);
template std::vector<double> distance_matrix(const Mesh&, Places, Places, const MatrixOptions&);
template SparseMatrix<float> distances_within(const Mesh&, double, Places, const MatrixOptions&);
template SparseMatrix<double> distances_within(const Mesh&, double, Places, const MatrixOptions&);

}  // namespace brushfire
