// From groups to rows.
#include <brushfire/solvers/carried_source/detail/grouped_rows.h>

#include <brushfire/core/detail/prefetch.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/solvers/carried_source/detail/update.h>
#include <brushfire/solvers/detail/float_range.h>
#include <brushfire/solvers/detail/sheets.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace brushfire::carried_source {
namespace {

// A group costs as much as two single runs, about.
constexpr std::size_t kFewest = 3;

Mesh on_one_sheet(const Mesh& mesh) {
  const std::shared_ptr<const detail::Sheets> sheets = detail::Sheets::where_likely(mesh);
  return sheets ? sheets->single() : mesh;
}

}  // namespace

bool GroupedRows::serve(const Domain& domain, const DistanceOptions& options) {
  return options.method == Method::CarriedSource && options.precision == Precision::Float &&
         detail::fits_float(domain.open());
}

GroupedRows::GroupedRows(const Domain& domain, std::span<const Index> asked)
    : unit_(domain.open().unit()), local_(on_one_sheet(domain.open())), records_(build_records<float>(local_.mesh())) {
  const Index vertices = domain.mesh().vertex_count(), copies = local_.mesh().vertex_count();
  std::vector<bool> on_wall(copies, false), is_asked(copies, false);
  place_.resize(vertices), vertex_.resize(copies);
  for (Index place = 0; place < copies; ++place) {
    const Index copy = local_.vertex(place), v = domain.vertex(copy);
    vertex_[place] = v;
    if (copy == v) {  // the first one
      place_[v] = place;
    } else {
      copies_.emplace_back(v, place);
    }
  }
  for (const auto& [v, place] : copies_) on_wall[place] = on_wall[place_[v]] = true;
  for (const Index v : asked) is_asked[place_[v]] = !on_wall[place_[v]];
  for (const SourceGroup& g : SourceGrouping(local_.mesh(), std::move(on_wall)).of(is_asked)) {
    if (g.vertices.size() < kFewest) continue;
    groups_.push_back({{}, g.spread});
    for (const Index place : g.vertices) groups_.back().vertices.push_back(local_.vertex(place));
  }
}

GroupRunner::GroupRunner(const GroupedRows& rows, Variant variant, int most_turns)
    : rows_(rows), march_(rows.records_, variant, most_turns) {}

template <class Finish>
std::vector<int> GroupRunner::run_parts(const GroupedRows::Group& group, double max_distance, Beyond beyond,
                                        const Finish& finish) {
  std::vector<int> alone;
  std::vector<std::pair<int, int>> open{{0, static_cast<int>(group.vertices.size())}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    if (end - begin == 1) {
      alone.push_back(begin);
    } else if (!run_lanes(group, begin, end, max_distance, beyond)) {
      const int middle = begin + (end - begin) / 2;
      open.emplace_back(begin, middle), open.emplace_back(middle, end);
    } else {
      finish(begin, end);
    }
  }
  return alone;
}

std::vector<int> GroupRunner::run(const GroupedRows::Group& group, double max_distance, const Take& take) {
  return run_parts(group, max_distance, Beyond::Marched, [&](int begin, int end) {
    transpose();
    for (int lane = begin; lane < end; ++lane) {
      const std::size_t n = rows_.place_.size();
      take(lane, std::span(values_).subspan(static_cast<std::size_t>(lane) * n, n));
    }
  });
}

std::vector<int> GroupRunner::run_within(const GroupedRows::Group& group, double max_distance,
                                         const TakeReached& take) {
  return run_parts(group, max_distance, Beyond::Ignored, [&](int begin, int end) {
    list_reached();
    for (int lane = begin; lane < end; ++lane) {
      columns_.resize(reached_.size()), values_.resize(reached_.size());
      std::size_t count = 0;
      for (const auto& [vertex, place] : reached_) {
        const float value = march_.values(place)[lane];
        // Copies of a vertex on a wall are one.
        if (count > 0 && columns_[count - 1] == vertex) {
          values_[count - 1] = std::min(values_[count - 1], value);
          continue;
        }
        columns_[count] = vertex, values_[count] = value;
        count += static_cast<double>(value) * rows_.unit_ <= max_distance ? 1u : 0u;
      }
      take(lane, std::span(columns_).first(count), std::span(values_).first(count));
    }
  });
}

void GroupRunner::list_reached() {
  reached_.clear();
  for (const Index place : march_.touched()) reached_.emplace_back(rows_.vertex_[place], place);
  detail::sort(reached_.begin(), reached_.end());
}

bool GroupRunner::run_lanes(const GroupedRows::Group& group, int begin, int end, double max_distance, Beyond beyond) {
  march_.reset();
  for (int lane = begin; lane < end; ++lane) {
    march_.begin_at(lane, rows_.place_[group.vertices[static_cast<std::size_t>(lane)]]);
  }
  // Rounded up.
  const double last = max_distance / rows_.unit_ * (1 + 2 * static_cast<double>(kEpsilon<float>));
  return march_.run(static_cast<float>(group.spread), static_cast<float>(last), beyond);
}

// From the lanes of each vertex to the vertices of each lane.
void GroupRunner::transpose() {
  constexpr std::size_t kTile = 16, kAhead = 16;
  const std::size_t n = rows_.place_.size();
  values_.resize(kGroupLanes * n);
  float tile[kTile][kGroupLanes];
  for (std::size_t begin = 0; begin < n; begin += kTile) {
    const std::size_t count = std::min(kTile, n - begin);
    for (std::size_t i = 0; i < count; ++i) {
      if (begin + i + kAhead < n) prefetch(march_.values(rows_.place_[begin + i + kAhead]));
      std::copy_n(march_.values(rows_.place_[begin + i]), kGroupLanes, tile[i]);
    }
    for (std::size_t lane = 0; lane < kGroupLanes; ++lane) {
      float* const to = values_.data() + lane * n + begin;
      for (std::size_t i = 0; i < count; ++i) to[i] = tile[i][lane];
    }
  }
  for (const auto& [v, place] : rows_.copies_) {
    for (std::size_t lane = 0; lane < kGroupLanes; ++lane) {
      float& value = values_[lane * n + v];
      value = std::min(value, march_.values(place)[lane]);
    }
  }
}

}  // namespace brushfire::carried_source
