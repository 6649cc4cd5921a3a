// Rows of points wait in buckets; one that is taken offers what has changed to its faces, its own edge and over fences.
#include <brushfire/solvers/steiner/detail/search.h>

#include <brushfire/solvers/steiner/detail/lower_costs.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace brushfire::steiner {
namespace {

// As a share of the mean cost of an edge: narrow ones order rows better, wide ones gather more changes of a row.
constexpr double kBucketWidth = 0.5;

double mean_length(const WeightedMesh& weighted) {
  double sum = 0;
  for (const double l : weighted.mesh().lengths()) sum += l;
  return sum / std::max<Index>(1, weighted.mesh().halfedge_count());
}

void resize(LowerTerms& terms, Index room) {
  for (std::vector<double>* v : {&terms.height, &terms.reach, &terms.variance, &terms.quotient, &terms.ceiling})
    v->assign(room, 0);
}

}  // namespace

Front unreached(const WeightedMesh& mesh, const PointLayout& layout) {
  Front front;
  front.value.assign(layout.size(), kInfinity);
  front.parent.assign(layout.size(), kNoIndex);
  front.vertex_value.assign(mesh.mesh().vertex_count(), kInfinity);
  front.vertex_parent.assign(mesh.mesh().vertex_count(), kNoIndex);
  for (Index e = 0; e < mesh.edges().count(); ++e) {  // the room behind the points takes nothing
    const Index row = layout.row(e);
    std::fill(front.value.begin() + row + layout.count(e), front.value.begin() + row + layout.room(e), -kInfinity);
  }
  return front;
}

Search::Search(const WeightedMesh& mesh, const PointLayout& layout, Costs costs, bool towards)
    : mesh_(mesh),
      layout_(layout),
      costs_(costs),
      travel_{mesh.pace(), towards},
      places_(mesh, layout, costs, travel_),
      opposite_(mesh.mesh().opposite()) {
  const double width = kBucketWidth * mean_length(mesh) * mesh.mean_weight();
  width_ = width > 0 && width < kInfinity ? width : 1;
  offers_.value.resize(layout.longest_row());
  offers_.from.resize(layout.longest_row());
  resize(near_, layout.longest_row());
  resize(far_, layout.longest_row());
}

void Search::run(std::span<const detail::LocatedSource> sources, const SearchLimits& limits) {
  resume(unreached(mesh_, layout_), sources, {}, limits);
}

void Search::resume(Front front, std::span<const detail::LocatedSource> sources, std::span<const Index> rows,
                    const SearchLimits& limits) {
  sources_ = sources;
  const Index edges = mesh_.edges().count();
  front_ = std::move(front);
  front_.horizon = kInfinity;
  front_.rows_sent = 0;
  first_.assign(edges, kNoIndex);
  last_.assign(edges, 0);
  waiting_.assign(edges, BucketQueue::kNever);
  queue_.reset();
  for (const Index e : rows) {
    const double* values = front_.value.data() + layout_.row(e);
    mark(e, 0, *std::min_element(values, values + layout_.count(e)));
    last_[e] = layout_.count(e) - 1;
  }
  for (std::size_t i = 0; i < sources.size(); ++i) start(sources[i], static_cast<Index>(i));

  Poll poll(64);  // rows, of some microseconds each
  std::size_t done = 0;
  while (queue_.advance()) {
    const double from = static_cast<double>(queue_.cursor()) * width_;
    front_.horizon = from;
    if (from > limits.max_value || targets_are_final(limits.targets, done)) return;
    for (std::size_t i = 0; i < queue_.current().size(); ++i) {  // NOLINT(modernize-loop-convert): it grows
      const Index edge = queue_.current()[i];
      if (waiting_[edge] != queue_.cursor()) continue;  // sent since
      poll();
      send(edge);
      if (limits.progress && front_.rows_sent % 4096 == 0) {
        const double n = static_cast<double>(front_.rows_sent);
        limits.progress(n / (n + edges));  // most rows are sent once or twice: an estimate that never goes back
      }
    }
    queue_.clear_current();
  }
  front_.horizon = kInfinity;
}

bool Search::targets_are_final(std::span<const PointLocation> targets, std::size_t& done) const {
  if (targets.empty()) return false;
  while (done < targets.size() && at(targets[done]).value <= front_.horizon) ++done;
  return done == targets.size();
}

void Search::start(const detail::LocatedSource& source, Index number) {
  const Index parent = kFromSource + number;
  if (source.at.on == PointLocation::On::Vertex) {
    return reach(source.at.vertex, source.offset, parent, kNoIndex);
  }
  for (const RowBeside& row : places_.beside(source.at)) {
    if (row.weight == kInfinity) continue;
    for (Index i = 0; i < layout_.count(row.edge); ++i) {
      const double value = source.offset + row.weight * places_.cost_from(row, i);
      if (value < front_.value[layout_.row(row.edge) + i]) improve(row.edge, i, value, parent);
    }
  }
}

void Search::improve(Index edge, Index j, double value, Index parent) {
  if (j == 0 || j + 1 == layout_.count(edge)) return reach(end_of(edge, j > 0), value, parent, kNoIndex);
  front_.value[layout_.row(edge) + j] = value;
  front_.parent[layout_.row(edge) + j] = parent;
  mark(edge, j, value);
}

// All rows that end at the vertex hear of it, `except` without being sent again.
void Search::reach(Index v, double value, Index parent, Index except) {
  if (!(value < front_.vertex_value[v])) return;
  front_.vertex_value[v] = value;
  front_.vertex_parent[v] = parent;
  for (const Index e : mesh_.edges().at(v)) {
    const Index j = end_of(e, false) == v ? 0 : layout_.count(e) - 1;
    front_.value[layout_.row(e) + j] = value;
    front_.parent[layout_.row(e) + j] = parent;
    if (e != except) mark(e, j, value);
  }
}

void Search::mark(Index edge, Index j, double value) {
  first_[edge] = std::min(first_[edge], j);
  last_[edge] = std::max(last_[edge], j);
  constexpr double kLastBucket = 0x1p62;
  const auto bucket =
      std::max(static_cast<BucketQueue::Bucket>(std::min(value / width_, kLastBucket)), queue_.cursor());
  if (bucket >= waiting_[edge]) return;
  waiting_[edge] = bucket;
  queue_.push(edge, bucket);
}

void Search::send(Index edge) {
  Index first = first_[edge], last = last_[edge];
  first_[edge] = kNoIndex;
  last_[edge] = 0;
  waiting_[edge] = BucketQueue::kNever;
  ++front_.rows_sent;
  sweep(edge, first, last);
  const double* values = front_.value.data() + layout_.row(edge);
  const Offering from{layout_.at_row(edge), values, first, last, *std::min_element(values + first, values + last + 1)};
  const Index begin = mesh_.edges().halfedge(edge);
  Index h = begin;
  do {
    const Index f = Mesh::face_of(h);
    if (places_.is_usable(f) && mesh_.face_weight(f) < kInfinity) send_into_face(places_.over(h), from);
    h = opposite_[h];
  } while (h != begin);
  cross(edge, first, last);
}

// Along the edge, both ways, as far as that lowers anything.
void Search::sweep(Index edge, Index& first, Index& last) {
  const double weight = mesh_.edge_weight(edge);
  if (weight == kInfinity) return;
  const double* at = layout_.at_row(edge);
  const Index row = layout_.row(edge), end = layout_.count(edge) - 1, from = first, to = last;
  double* const values = front_.value.data() + row;
  Index* const parents = front_.parent.data() + row;
  const double gradient = places_.gradient_along(edge);
  const double up = weight * travel_.cost(1, gradient), down = weight * travel_.cost(1, -gradient);
  const auto step = [&](Index j, Index next, double cost) {
    const double value = values[j] + cost;
    if (!(value < values[next])) return;
    if (next == 0 || next == end) {
      reach(end_of(edge, next > 0), value, row + j, edge);
    } else {
      values[next] = value;
      parents[next] = row + j;
    }
    first = std::min(first, next);
    last = std::max(last, next);
  };
  for (Index j = from; j < end && j <= last; ++j) step(j, j + 1, up * (at[j + 1] - at[j]));
  for (Index j = std::max(to, last); j > 0 && j >= first; --j) step(j, j - 1, down * (at[j] - at[j - 1]));
}

void Search::send_into_face(const FaceOver& over, const Offering& from) {
  for (Index k = 0; k < 3; ++k) {
    const Index target = mesh_.edges().edge(3 * over.face + k);
    if (target != over.edge) send_to_row(over, target, from);
  }
}

void Search::send_to_row(const FaceOver& over, Index target, const Offering& from) {
  const auto place = [&](Index v) {
    return v == over.start ? Vec2{} : v == over.end ? Vec2{over.length, 0} : over.apex;
  };
  Receiving to{layout_.at_row(target),
               front_.value.data() + layout_.row(target),
               place(end_of(target, false)),
               {},
               layout_.room(target)};
  const double length = to.at[layout_.count(target) - 1];
  if (length > 0) to.direction = (1 / length) * (place(end_of(target, true)) - to.start);
  const double weight = mesh_.face_weight(over.face) * over.stretch;
  bool lower;
  if (travel_.pace != nullptr) {
    lower = relax_sloped_rows(from, to, weight, over.gradient, travel_, offers_);
  } else if (costs_ == Costs::Real) {
    lower = BRUSHFIRE_ON_TARGET(Variant::Best, relax_rows(from, to, weight, offers_));
  } else {
    find_lower_terms(over, target, to);
    const double rounding = kPlaceRounding * std::max({over.length, norm(over.apex), length});
    lower = BRUSHFIRE_ON_TARGET(Variant::Best, relax_rows_below(from, to, weight, near_, far_, rounding, offers_));
  }
  if (lower) take_offers(layout_.row(over.edge), target);
}

// What lies between the ends waits as one change.
void Search::take_offers(Index offering_row, Index target) {
  const Index row = layout_.row(target), end = layout_.count(target) - 1;
  const auto parent = [&](Index j) { return offering_row + static_cast<Index>(offers_.from[j]); };
  Index first = kNoIndex, last = 0;
  double least = kInfinity;
  for (Index j = 1; j < end; ++j) {
    if (offers_.from[j] < 0) continue;
    front_.value[row + j] = offers_.value[j];
    front_.parent[row + j] = parent(j);
    first = std::min(first, j), last = j;
    least = std::min(least, offers_.value[j]);
  }
  if (first < end) {
    mark(target, first, least);
    last_[target] = std::max(last_[target], last);
  }
  for (const Index j : {Index{0}, end}) {
    if (offers_.from[j] >= 0) reach(end_of(target, j > 0), offers_.value[j], parent(j), kNoIndex);
  }
}

void Search::find_lower_terms(const FaceOver& over, Index target, const Receiving& to) {
  const Index target_start = end_of(target, false);
  const MeetingRow mine{layout_.at_row(over.edge), layout_.count(over.edge),
                        over.end == target_start || over.end == end_of(target, true)};
  const MeetingRow theirs{to.at, layout_.count(target), target_start != over.start && target_start != over.end};
  const double length = to.at[theirs.count - 1], product = over.length * length;
  const double along = (mine.at_last ? -1 : 1) * (theirs.at_last ? -1 : 1) * to.direction.x;
  const double sine = product > 0 ? std::min(1.0, mesh_.mesh().double_areas()[over.face] / product) : 0;
  lower_terms(mine, theirs, sine, std::clamp(along, -1.0, 1.0), near_, far_);
}

void Search::cross(Index edge, Index first, Index last) {
  for (const Bridge& bridge : mesh_.bridges(edge)) {
    const Index row = layout_.row(edge), other = layout_.row(bridge.to), count = layout_.count(edge);
    for (Index i = first; i <= last; ++i) {
      const Index j = bridge.mirrored ? count - 1 - i : i;
      const double value = front_.value[row + i] + bridge.cost;
      if (value < front_.value[other + j]) improve(bridge.to, j, value, row + i);
    }
  }
}

}  // namespace brushfire::steiner
