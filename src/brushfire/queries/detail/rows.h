// The loop under all distance matrices: checked places, a solver per thread, one row after the other.
#pragma once

#include <brushfire/core/parallel.h>
#include <brushfire/queries/distance_matrix.h>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace brushfire::carried_source {
class GroupedRows;
class GroupRunner;
}  // namespace brushfire::carried_source

namespace brushfire::detail {

// Entries of a sparse row, or of several one after the other.
template <class T>
struct SparseEntries {
  std::vector<Index> column;
  std::vector<T> value;
};

class Rows {
 public:
  // Checks all places and options. Throws as distance_matrix() does.
  Rows(const Domain& domain, Places rows, Places columns, const MatrixOptions& options);
  ~Rows();

  std::size_t count() const noexcept { return row_count_; }
  std::size_t columns() const noexcept { return column_count_; }

  // Computes the rows with the given numbers, `block` of them at a time on one thread, and hands each to `take`, on the
  // thread that computed it, with its position in `numbers`; valid during the call. `worker` numbers that thread;
  // `progress` may be empty and is called from the calling thread.
  using TakeSparse = std::function<void(unsigned worker, std::size_t position, const SparseField& field)>;
  void run_sparse(std::span<const std::size_t> numbers, std::size_t block, const Progress& progress,
                  const TakeSparse& take);

  // All rows in blocks that a thread computes one after the other: of rows near each other, or of vertices that are
  // sources together.
  struct Blocks {
    std::vector<std::size_t> numbers, begin;  // begin: [blocks + 1] in numbers
    std::vector<Index> vertex;                // of each number in a group
    std::size_t groups = 0;                   // the first blocks are theirs
  };
  Blocks blocks_by_place(std::size_t block);
  // The same as run_sparse(), for the blocks from `first` to before `last`; i: the row's number. The rows of a block
  // come on one thread, in any order.
  using TakeOfBlock = std::function<void(std::size_t block, std::size_t i, const SparseField& field)>;
  void run_blocks(const Blocks& blocks, std::size_t first, std::size_t last, const Progress& progress,
                  const TakeOfBlock& take);

  // The same as a row of columns() values, +inf where nothing was reached; i: the row's number. T is float or double;
  // floats are rounded doubles.
  template <class T>
  using TakeDense = std::function<void(unsigned worker, std::size_t i, std::span<const T> values)>;
  // `claim`, where there is one, is asked for each row before it is computed, from any thread: false leaves it out.
  using Claim = std::function<bool(std::size_t i)>;
  template <class T>
  void run_dense(std::span<const std::size_t> numbers, const Progress& progress, const TakeDense<T>& take,
                 const Claim& claim = nullptr);

  // What is farther reads +inf from the next run on: the options' max_distance.
  void set_radius(double radius) { options_.max_distance = radius; }

  // The numbers of all rows so that those that are computed together are together, unit after unit; `unit_start`: the
  // position of each unit's first row, and at the end count().
  struct ByUnits {
    std::vector<std::size_t> numbers, unit_start;
  };
  ByUnits by_units();

  // The numbers of all rows: those near each other on the surface one after the other where there are many, so that
  // short rows find in the cache what they need.
  std::vector<std::size_t> numbers_by_place() const;

 private:
  // What a thread keeps; no two share a cache line.
  struct alignas(128) Worker {
    Worker();
    Worker(Worker&&) noexcept;
    ~Worker();
    std::unique_ptr<DistanceSolver> solver;               // made for its first row
    std::unique_ptr<carried_source::GroupRunner> groups;  // made for its first group
    SparseField field;
    std::vector<double> doubles;
    std::vector<float> floats;
    // A row of them.
    template <class T>
    std::vector<T>& values();
  };

  std::optional<SurfacePoint> place(std::size_t i) const;
  void compute_row(Worker& worker, std::size_t i);
  template <class T>
  void compute_dense_row(unsigned worker, std::size_t i, const TakeDense<T>& take);
  // Whether rows of neighbouring vertices are to be run together: for methods that can, where all columns are vertices.
  bool can_group() const;
  void run_group_within(Worker& worker, const Blocks& blocks, std::size_t b, const TakeOfBlock& take);
  struct Asked;
  Asked asked_of(std::span<const std::size_t> numbers);
  template <class T>
  std::size_t run_group(unsigned worker, std::size_t number, const Asked& asked, const TakeDense<T>& take,
                        const Claim& claim);
  template <class T>
  void run_grouped(std::span<const std::size_t> numbers, const Progress& progress, const TakeDense<T>& take,
                   const Claim& claim);
  // Of all rows' vertices; made when first asked for.
  const carried_source::GroupedRows& groups();
  Index vertex_of_row(std::size_t i) const;  // kNoIndex: none

  Domain domain_;
  Mesh mesh_;  // the whole
  Places rows_;
  std::size_t row_count_ = 0, column_count_ = 0;
  bool all_columns_ = true;
  std::vector<std::size_t> target_column_;  // which column each target is; columns in no face are not among them
  DistanceOptions options_;                 // of one row
  ThreadTeam team_;
  std::shared_ptr<const carried_source::GroupedRows> groups_;
  std::vector<Worker> workers_;  // whose runners refer to groups_
};

// Throws Error(TooLarge) where the rows within the radius of `all` are expected to take more than `limit` bytes (0:
// what is available), from an evenly spread sample of them.
void require_sparse_memory(Rows& all, ValueType type, std::uint64_t limit);

// How many entries all rows together are expected to have, from such a sample.
double expected_entries(Rows& all);

// 0, 1, ..., count - 1.
std::vector<std::size_t> numbers_below(std::size_t count);

}  // namespace brushfire::detail
