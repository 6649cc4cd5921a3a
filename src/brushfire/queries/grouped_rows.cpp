// Rows of vertices that are sources together with their neighbours: Rows::run_dense() for the methods that can.
#include <brushfire/core/cancel.h>
#include <brushfire/queries/detail/rows.h>
#include <brushfire/solvers/carried_source/detail/grouped_rows.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace brushfire::detail {
namespace {

// Of a surface point that lies on a vertex; kNoIndex elsewhere.
Index vertex_at(const Mesh& mesh, const SurfacePoint& point) {
  if (point.is_nowhere()) return kNoIndex;
  const PointLocation at = locate(mesh, point);
  return at.on == PointLocation::On::Vertex ? at.vertex : kNoIndex;
}

// By whom a row is wanted: its vertex, its position in the list of numbers.
using Wish = std::pair<Index, std::size_t>;

// As distance() has it: in the mesh's units, nothing beyond the radius.
template <class T>
T in_units(float value, double unit, double max_distance) {
  const double d = static_cast<double>(value) * unit;
  return d > max_distance ? std::numeric_limits<T>::infinity() : static_cast<T>(d);
}
template <class T>
void in_units(std::span<const float> from, double unit, double max_distance, std::vector<T>& to) {
  const auto scale = static_cast<float>(unit);  // a power of two
  if (std::is_same_v<T, float> && std::isnormal(scale) && max_distance == kInfinity) {
    std::transform(from.begin(), from.end(), to.begin(), [=](float value) { return static_cast<T>(value * scale); });
  } else {
    std::transform(from.begin(), from.end(), to.begin(),
                   [=](float value) { return in_units<T>(value, unit, max_distance); });
  }
}

}  // namespace

Rows::Worker::Worker() = default;
Rows::Worker::Worker(Worker&&) noexcept = default;
Rows::Worker::~Worker() = default;
Rows::~Rows() = default;

bool Rows::can_group() const {
  if (!carried_source::GroupedRows::serve(domain_, options_)) return false;
  if (!all_columns_ && options_.targets.empty()) return false;  // nothing to compute
  return std::all_of(options_.targets.begin(), options_.targets.end(),
                     [&](const SurfacePoint& p) { return vertex_at(mesh_, p) != kNoIndex; });
}

template <class T>
void Rows::run_grouped(std::span<const std::size_t> numbers, const Progress& progress, const TakeDense<T>& take) {
  const CancelScope listen(options_.cancel);
  std::vector<Wish> wishes;
  std::vector<std::size_t> alone;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const std::optional<SurfacePoint> p = place(numbers[k]);
    const Index v = p ? vertex_at(mesh_, *p) : kNoIndex;
    if (v == kNoIndex) {
      alone.push_back(numbers[k]);
    } else {
      wishes.emplace_back(v, numbers[k]);
    }
  }
  std::sort(wishes.begin(), wishes.end());
  std::vector<Index> asked, columns;
  for (const auto& [v, i] : wishes) asked.push_back(v);
  for (const SurfacePoint& p : options_.targets) columns.push_back(vertex_at(mesh_, p));
  const carried_source::GroupedRows rows(domain_, asked);

  // The rows that are wanted of a vertex.
  const auto wanted = [&](Index v) {
    const auto begin = std::lower_bound(wishes.begin(), wishes.end(), Wish{v, 0});
    return std::span(begin, std::upper_bound(begin, wishes.end(), Wish{v, ~std::size_t{0}}));
  };
  std::vector<bool> in_a_group(mesh_.vertex_count(), false);
  for (const auto& g : rows.groups()) {
    for (const Index v : g.vertices) in_a_group[v] = true;
  }
  for (const auto& [v, i] : wishes) {
    if (!in_a_group[v]) alone.push_back(i);
  }

  std::atomic<std::size_t> done{0};
  const auto tell = [&](unsigned worker, std::size_t rows_done) {
    const std::size_t finished = done.fetch_add(rows_done, std::memory_order_relaxed) + rows_done;
    if (worker == 0 && progress) progress(static_cast<double>(finished) / static_cast<double>(numbers.size()));
  };
  const auto run_group = [&](unsigned worker, const carried_source::GroupedRows::Group& group) {
    Worker& w = workers_[worker];
    if (!w.groups) w.groups = std::make_unique<carried_source::GroupRunner>(rows);
    const auto of_lane = [&](int lane) { return wanted(group.vertices[static_cast<std::size_t>(lane)]); };
    const auto take_lane = [&](int lane, std::span<const float> distances) {
      if (of_lane(lane).empty()) return;
      std::vector<T>& values = w.values<T>();
      if (all_columns_) {
        values.resize(column_count_);
        in_units(distances, w.groups->unit(), options_.max_distance, values);
      } else {
        values.assign(column_count_, std::numeric_limits<T>::infinity());
        for (std::size_t t = 0; t < columns.size(); ++t) {
          values[target_column_[t]] = in_units<T>(distances[columns[t]], w.groups->unit(), options_.max_distance);
        }
      }
      for (const auto& [v, i] : of_lane(lane)) take(worker, i, values);
    };
    for (const int lane : w.groups->run(group, options_.max_distance, take_lane)) {
      for (const auto& [v, i] : of_lane(lane)) compute_dense_row<T>(worker, i, take);
    }
    std::size_t count = 0;
    for (const Index v : group.vertices) count += wanted(v).size();
    tell(worker, count);
  };
  const auto body = [&](unsigned worker, std::size_t index) {
    stop_if_cancelled();
    if (index < rows.groups().size()) return run_group(worker, rows.groups()[index]);
    compute_dense_row<T>(worker, alone[index - rows.groups().size()], take);
    tell(worker, 1);
  };
  team_.run(rows.groups().size() + alone.size(), body, current_cancel_token());
  for (Worker& w : workers_) w.groups.reset();
}

template void Rows::run_grouped<float>(std::span<const std::size_t>, const Progress&, const TakeDense<float>&);
template void Rows::run_grouped<double>(std::span<const std::size_t>, const Progress&, const TakeDense<double>&);

Rows::Blocks Rows::blocks_by_place(std::size_t block) {
  Blocks blocks;
  blocks.begin.push_back(0);
  std::vector<bool> in_a_group(row_count_, false);
  if (can_group()) {
    const CancelScope listen(options_.cancel);
    std::vector<Wish> wishes;
    std::vector<Index> asked;
    for (std::size_t i = 0; i < row_count_; ++i) {
      const std::optional<SurfacePoint> p = place(i);
      const Index v = p ? vertex_at(mesh_, *p) : kNoIndex;
      if (v != kNoIndex) wishes.emplace_back(v, i), asked.push_back(v);
    }
    std::sort(wishes.begin(), wishes.end());
    grouped_ = std::make_unique<carried_source::GroupedRows>(domain_, asked);
    for (const auto& g : grouped_->groups()) {
      for (const Index v : g.vertices) {
        const auto first = std::lower_bound(wishes.begin(), wishes.end(), Wish{v, 0});
        for (auto w = first; w != wishes.end() && w->first == v; ++w) {
          blocks.numbers.push_back(w->second), blocks.vertex.push_back(v);
          in_a_group[w->second] = true;
        }
      }
      blocks.begin.push_back(blocks.numbers.size());
    }
    blocks.groups = grouped_->groups().size();
  }
  for (const std::size_t i : numbers_by_place()) {
    if (in_a_group[i]) continue;
    blocks.numbers.push_back(i);
    if (blocks.numbers.size() - blocks.begin.back() == block) blocks.begin.push_back(blocks.numbers.size());
  }
  if (blocks.begin.back() < blocks.numbers.size()) blocks.begin.push_back(blocks.numbers.size());
  return blocks;
}

void Rows::run_group_within(Worker& w, const Blocks& blocks, std::size_t b, const TakeOfBlock& take) {
  if (!w.groups) w.groups = std::make_unique<carried_source::GroupRunner>(*grouped_);
  const carried_source::GroupedRows::Group& group = grouped_->groups()[b];
  const auto for_rows_of = [&](int lane, const auto& body) {
    for (std::size_t k = blocks.begin[b]; k < blocks.begin[b + 1]; ++k) {
      if (blocks.vertex[k] == group.vertices[static_cast<std::size_t>(lane)]) body(blocks.numbers[k]);
    }
  };
  const auto take_lane = [&](int lane, std::span<const Index> vertices, std::span<const float> distances) {
    w.field.vertex.assign(vertices.begin(), vertices.end());
    w.field.distance.resize(distances.size());
    const double unit = w.groups->unit();
    std::transform(distances.begin(), distances.end(), w.field.distance.begin(),
                   [=](float d) { return static_cast<double>(d) * unit; });
    for_rows_of(lane, [&](std::size_t i) { take(b, i, w.field); });
  };
  for (const int lane : w.groups->run_within(group, options_.max_distance, take_lane)) {
    for_rows_of(lane, [&](std::size_t i) {
      compute_row(w, i);
      take(b, i, w.field);
    });
  }
}

void Rows::run_blocks(const Blocks& blocks, const Progress& progress, const TakeOfBlock& take) {
  const CancelScope listen(options_.cancel);
  std::atomic<std::size_t> done{0};
  const auto body = [&](unsigned worker, std::size_t b) {
    Worker& w = workers_[worker];
    const std::size_t begin = blocks.begin[b], end = blocks.begin[b + 1];
    stop_if_cancelled();
    if (b < blocks.groups) {
      run_group_within(w, blocks, b, take);
    } else {
      for (std::size_t k = begin; k < end; ++k) {
        stop_if_cancelled();
        compute_row(w, blocks.numbers[k]);
        take(b, blocks.numbers[k], w.field);
      }
    }
    const std::size_t finished = done.fetch_add(end - begin, std::memory_order_relaxed) + end - begin;
    if (worker == 0 && progress) progress(static_cast<double>(finished) / static_cast<double>(row_count_));
  };
  team_.run(blocks.begin.size() - 1, body, current_cancel_token());
  for (Worker& w : workers_) w.groups.reset();
}

}  // namespace brushfire::detail
