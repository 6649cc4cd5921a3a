// From groups to rows.
#include <brushfire/solvers/carried_source/detail/grouped_rows.h>

#include <brushfire/core/detail/prefetch.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/solvers/carried_source/detail/update.h>
#include <brushfire/solvers/detail/float_range.h>
#include <brushfire/solvers/detail/sheets.h>

#include <algorithm>
#include <cmath>
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

// The greatest number that is not above `last` in units.
float last_in(double unit, double last) {
  auto value = static_cast<float>(last / unit);
  while (static_cast<double>(value) * unit > last) value = std::nextafter(value, 0.0f);
  for (;;) {
    const float next = std::nextafter(value, std::numeric_limits<float>::infinity());
    if (value == next || !(static_cast<double>(next) * unit <= last)) return value;
    value = next;
  }
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
  place_.resize(vertices), rank_.resize(copies), by_vertex_.reserve(copies);
  for (Index place = 0; place < copies; ++place) {
    const Index copy = local_.vertex(place), v = domain.vertex(copy);
    if (copy == v) {  // the first one
      place_[v] = place;
    } else {
      copies_.emplace_back(v, place);
    }
  }
  detail::sort(copies_.begin(), copies_.end());
  auto copy = copies_.begin();
  for (Index v = 0; v < vertices; ++v) {
    by_vertex_.emplace_back(v, place_[v]);
    for (; copy != copies_.end() && copy->first == v; ++copy) by_vertex_.push_back(*copy);
  }
  for (Index rank = 0; rank < copies; ++rank) rank_[by_vertex_[rank].second] = rank;
  for (const auto& [v, place] : copies_) on_wall[place] = on_wall[place_[v]] = true;
  for (const Index v : asked) is_asked[place_[v]] = !on_wall[place_[v]];
  for (const SourceGroup& g : SourceGrouping(local_.mesh(), std::move(on_wall)).of(is_asked)) {
    if (g.vertices.size() < kFewest) continue;
    groups_.push_back({{}, g.spread});
    for (const Index place : g.vertices) groups_.back().vertices.push_back(local_.vertex(place));
  }
}

GroupRunner::GroupRunner(const GroupedRows& rows, Variant variant, int most_turns)
    : rows_(rows), march_(rows.records_, variant, most_turns), marks_(rows.rank_.size()) {}

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
  const std::size_t count = rows_.place_.size();
  return run_parts(group, max_distance, Beyond::Marched, [&](int begin, int end) {
    transpose(count, [this](std::size_t v) { return rows_.place_[v]; });
    for (const auto& [v, place] : rows_.copies_) {
      for (std::size_t lane = 0; lane < kGroupLanes; ++lane) {
        float& value = values_[lane * count + v];
        value = std::min(value, march_.values(place)[lane]);
      }
    }
    for (int lane = begin; lane < end; ++lane) take(lane, of_lane(lane, count));
  });
}

std::vector<int> GroupRunner::run_within(const GroupedRows::Group& group, double max_distance,
                                         const TakeReached& take) {
  const float last = last_in(rows_.unit_, max_distance);
  return run_parts(group, max_distance, Beyond::Ignored, [&](int begin, int end) {
    list_reached();
    transpose(reached_.size(), [this](std::size_t i) { return reached_[i].second; });
    for (int lane = begin; lane < end; ++lane) {
      const std::size_t count = keep(of_lane(lane, reached_.size()), last);
      take(lane, std::span(columns_).first(count), std::span(kept_).first(count));
    }
  });
}

void GroupRunner::list_reached() {
  for (const Index place : march_.touched()) marks_.mark(rows_.rank_[place]);
  reached_.clear();
  marks_.take([this](std::size_t rank) { reached_.push_back(rows_.by_vertex_[rank]); });
}

// Of what was reached by any lane that which is near enough in this one; returns how many.
std::size_t GroupRunner::keep(std::span<const float> values, float last) {
  columns_.resize(reached_.size() + 1), kept_.resize(reached_.size() + 1);
  std::size_t count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Index vertex = reached_[i].first;
    // Copies of a vertex on a wall are one.
    if (count > 0 && columns_[count - 1] == vertex) {
      kept_[count - 1] = std::min(kept_[count - 1], values[i]);
      continue;
    }
    columns_[count] = vertex, kept_[count] = values[i];
    count += values[i] <= last ? 1u : 0u;
  }
  return count;
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

// From the lanes of each of some places to the places of each lane.
template <class PlaceOf>
void GroupRunner::transpose(std::size_t count, const PlaceOf& place_of) {
  constexpr std::size_t kTile = 16, kAhead = 16;
  values_.resize(kGroupLanes * count);
  float tile[kTile][kGroupLanes];
  for (std::size_t begin = 0; begin < count; begin += kTile) {
    const std::size_t size = std::min(kTile, count - begin);
    for (std::size_t i = 0; i < size; ++i) {
      if (begin + i + kAhead < count) prefetch(march_.values(place_of(begin + i + kAhead)));
      std::copy_n(march_.values(place_of(begin + i)), kGroupLanes, tile[i]);
    }
    for (std::size_t lane = 0; lane < kGroupLanes; ++lane) {
      float* const to = values_.data() + lane * count + begin;
      for (std::size_t i = 0; i < size; ++i) to[i] = tile[i][lane];
    }
  }
}

}  // namespace brushfire::carried_source
