// Rows of vertices that are sources together with their neighbours: Rows::run_dense() for the methods that can.
#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/sort.h>
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
  if (options_.weighting) return false;
  if (!carried_source::GroupedRows::serve(domain_, options_)) return false;
  if (!all_columns_ && options_.targets.empty()) return false;  // nothing to compute
  return std::all_of(options_.targets.begin(), options_.targets.end(),
                     [&](const SurfacePoint& p) { return vertex_at(mesh_, p) != kNoIndex; });
}

Index Rows::vertex_of_row(std::size_t i) const {
  const std::optional<SurfacePoint> p = place(i);
  return p ? vertex_at(mesh_, *p) : kNoIndex;
}

const carried_source::GroupedRows& Rows::groups() {
  if (!groups_) {
    std::vector<Index> asked;
    for (std::size_t i = 0; i < row_count_; ++i) {
      if (const Index v = vertex_of_row(i); v != kNoIndex) asked.push_back(v);
    }
    groups_ = std::make_shared<const carried_source::GroupedRows>(domain_, asked);
  }
  return *groups_;
}

Rows::ByUnits Rows::by_units() {
  ByUnits units;
  if (!can_group()) {
    units.numbers = units.unit_start = numbers_below(row_count_);
    units.unit_start.push_back(row_count_);
    return units;
  }
  std::vector<Wish> wishes;
  for (std::size_t i = 0; i < row_count_; ++i) wishes.emplace_back(vertex_of_row(i), i);
  detail::sort(wishes.begin(), wishes.end());
  std::vector<bool> in_a_unit(row_count_, false);
  for (const auto& group : groups().groups()) {
    units.unit_start.push_back(units.numbers.size());
    for (const Index v : group.vertices) {
      for (auto w = std::lower_bound(wishes.begin(), wishes.end(), Wish{v, 0}); w != wishes.end() && w->first == v;
           ++w) {
        units.numbers.push_back(w->second);
        in_a_unit[w->second] = true;
      }
    }
  }
  for (std::size_t i = 0; i < row_count_; ++i) {
    if (in_a_unit[i]) continue;
    units.unit_start.push_back(units.numbers.size());
    units.numbers.push_back(i);
  }
  units.unit_start.push_back(row_count_);
  return units;
}

// What is asked of a run of groups.
struct Rows::Asked {
  std::vector<Wish> wishes;        // of vertices in a group, ascending
  std::vector<std::size_t> alone;  // the rest
  std::vector<Index> columns;      // vertices, where not all are columns

  // The rows of a vertex among some.
  static std::span<const Wish> rows_of(std::span<const Wish> some, Index v) {
    const auto begin = std::lower_bound(some.begin(), some.end(), Wish{v, 0});
    return std::span(begin, std::upper_bound(begin, some.end(), Wish{v, ~std::size_t{0}}));
  }
};

Rows::Asked Rows::asked_of(std::span<const std::size_t> numbers) {
  std::vector<bool> in_a_group(mesh_.vertex_count(), false);
  for (const auto& g : groups().groups()) {
    for (const Index v : g.vertices) in_a_group[v] = true;
  }
  Asked asked;
  std::vector<Wish> single;
  for (const std::size_t i : numbers) {
    const Index v = vertex_of_row(i);
    if (v == kNoIndex) {
      asked.alone.push_back(i);
    } else {
      (in_a_group[v] ? asked.wishes : single).emplace_back(v, i);
    }
  }
  detail::sort(asked.wishes.begin(), asked.wishes.end());
  detail::sort(single.begin(), single.end());
  for (const auto& [v, i] : single) asked.alone.push_back(i);
  for (const SurfacePoint& p : options_.targets) asked.columns.push_back(vertex_at(mesh_, p));
  return asked;
}

// Those of a group's rows that are wanted; returns how many they are, others' among them.
template <class T>
std::size_t Rows::run_group(unsigned worker, std::size_t number, const Asked& asked, const TakeDense<T>& take,
                            const Claim& claim) {
  const carried_source::GroupedRows::Group& group = groups().groups()[number];
  std::size_t count = 0;
  std::vector<Wish> mine;
  for (const Index v : group.vertices) {
    for (const Wish& w : Asked::rows_of(asked.wishes, v)) {
      ++count;
      if (!claim || claim(w.second)) mine.push_back(w);
    }
  }
  if (mine.empty()) return count;
  detail::sort(mine.begin(), mine.end());
  Worker& w = workers_[worker];
  if (!w.groups) w.groups = std::make_unique<carried_source::GroupRunner>(groups());
  const auto of_lane = [&](int lane) { return Asked::rows_of(mine, group.vertices[static_cast<std::size_t>(lane)]); };
  const auto take_lane = [&](int lane, std::span<const float> distances) {
    if (of_lane(lane).empty()) return;
    std::vector<T>& values = w.values<T>();
    if (all_columns_) {
      values.resize(column_count_);
      in_units(distances, w.groups->unit(), options_.max_distance, values);
    } else {
      values.assign(column_count_, std::numeric_limits<T>::infinity());
      for (std::size_t t = 0; t < asked.columns.size(); ++t) {
        values[target_column_[t]] = in_units<T>(distances[asked.columns[t]], w.groups->unit(), options_.max_distance);
      }
    }
    for (const auto& [v, i] : of_lane(lane)) take(worker, i, values);
  };
  for (const int lane : w.groups->run(group, options_.max_distance, take_lane)) {
    for (const auto& [v, i] : of_lane(lane)) compute_dense_row<T>(worker, i, take);
  }
  return count;
}

template <class T>
void Rows::run_grouped(std::span<const std::size_t> numbers, const Progress& progress, const TakeDense<T>& take,
                       const Claim& claim) {
  const CancelScope listen(options_.cancel);
  const carried_source::GroupedRows& rows = groups();
  const Asked asked = asked_of(numbers);
  std::atomic<std::size_t> done{0};
  const auto tell = [&](unsigned worker, std::size_t rows_done) {
    const std::size_t finished = done.fetch_add(rows_done, std::memory_order_relaxed) + rows_done;
    if (worker == 0 && progress) progress(static_cast<double>(finished) / static_cast<double>(numbers.size()));
  };
  const auto body = [&](unsigned worker, std::size_t index) {
    stop_if_cancelled();
    if (index < rows.groups().size()) {
      const std::size_t count = run_group(worker, index, asked, take, claim);
      if (count != 0) tell(worker, count);
      return;
    }
    const std::size_t i = asked.alone[index - rows.groups().size()];
    if (!claim || claim(i)) compute_dense_row<T>(worker, i, take);
    tell(worker, 1);
  };
  team_.run(rows.groups().size() + asked.alone.size(), body, current_cancel_token());
}

template void Rows::run_grouped<float>(std::span<const std::size_t>, const Progress&, const TakeDense<float>&,
                                       const Claim&);
template void Rows::run_grouped<double>(std::span<const std::size_t>, const Progress&, const TakeDense<double>&,
                                        const Claim&);

Rows::Blocks Rows::blocks_by_place(std::size_t block) {
  Blocks blocks;
  blocks.begin.push_back(0);
  std::vector<bool> in_a_group(row_count_, false);
  if (can_group()) {
    const CancelScope listen(options_.cancel);
    std::vector<Wish> wishes;
    for (std::size_t i = 0; i < row_count_; ++i) wishes.emplace_back(vertex_of_row(i), i);
    detail::sort(wishes.begin(), wishes.end());
    for (const auto& g : groups().groups()) {
      for (const Index v : g.vertices) {
        const auto first = std::lower_bound(wishes.begin(), wishes.end(), Wish{v, 0});
        for (auto w = first; w != wishes.end() && w->first == v; ++w) {
          blocks.numbers.push_back(w->second), blocks.vertex.push_back(v);
          in_a_group[w->second] = true;
        }
      }
      blocks.begin.push_back(blocks.numbers.size());
    }
    blocks.groups = groups().groups().size();
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
  if (!w.groups) w.groups = std::make_unique<carried_source::GroupRunner>(groups());
  const carried_source::GroupedRows::Group& group = groups().groups()[b];
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

void Rows::run_blocks(const Blocks& blocks, std::size_t first, std::size_t last, const Progress& progress,
                      const TakeOfBlock& take) {
  const CancelScope listen(options_.cancel);
  std::atomic<std::size_t> done{0};
  const std::size_t rows = blocks.begin[last] - blocks.begin[first];
  const auto body = [&](unsigned worker, std::size_t index) {
    Worker& w = workers_[worker];
    const std::size_t b = first + index, begin = blocks.begin[b], end = blocks.begin[b + 1];
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
    if (worker == 0 && progress) progress(static_cast<double>(finished) / static_cast<double>(rows));
  };
  team_.run(last - first, body, current_cancel_token());
}

}  // namespace brushfire::detail
