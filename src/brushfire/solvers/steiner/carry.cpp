// Rows are copied, what hung on a dearer step is forgotten with all that hangs on it, and the rim is sent again.
#include <brushfire/solvers/steiner/detail/carry.h>

#include <brushfire/solvers/steiner/detail/match.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <tuple>
#include <utility>

namespace brushfire::steiner {
namespace {

enum : std::uint8_t { kDearer = 1, kCheaper = 2 };

class Carrying {
 public:
  Carrying(Run& before, const Run& after)
      : before_(before),
        after_(after),
        match_(before, after),
        mesh_(*after.mesh),
        layout_(*after.layout),
        opposite_(mesh_.mesh().opposite()) {}

  Carried operator()() {
    find_changes();
    match_sources();
    if (match_.is_identity) {
      front_ = std::move(before_.front);
    } else {
      copy_front();
    }
    doubt();
    forget_descendants();
    Carried result;
    result.rows = rim();
    result.kept = match_.is_identity ? kept_share() : known_share();
    result.front = std::move(front_);
    return result;
  }

 private:
  Index layout_edges() const { return mesh_.edges().count(); }
  void find_changes();
  bool has_same_grain(Index old, Index f) const;
  void find_changed_bridges();
  void match_sources();
  void copy_front();
  std::vector<Index> rows_of_points_before() const;
  void rename_sources();
  void doubt();
  bool is_doubtful(Index point) const;
  void lose_point(Index point);
  void lose(Index e, Index i);
  void lose_vertex(Index v);
  void push(Index e);
  void forget_descendants();
  std::vector<Index> rim() const;
  double known_share() const;
  double kept_share() const;
  template <class Use>
  void for_each_neighbour(Index e, Use use) const;

  Run& before_;
  const Run& after_;
  Match match_;
  const WeightedMesh& mesh_;
  const PointLayout& layout_;
  std::span<const Index> opposite_;
  std::vector<std::uint8_t> change_;    // [edges] kDearer, kCheaper: of a step along it, in a face beside it, over it
  std::vector<Index> source_after_;     // [sources before] kNoIndex: there is none like it
  bool same_sources_ = true;            // each is what it was, under its number
  Front front_;                         // +inf where nothing is known
  std::vector<Index> lost_;             // rows whose neighbours have not heard of it
  std::vector<std::uint8_t> waits_;     // [edges] in lost_
  std::vector<std::uint8_t> has_lost_;  // [edges]
  std::uint64_t lost_points_ = 0;
};

std::uint8_t change_of(double before, double after) {
  if (after > before) return kDearer;
  return after < before ? kCheaper : 0;
}

void Carrying::find_changes() {
  constexpr std::uint8_t kBoth = kDearer | kCheaper;
  change_.assign(layout_edges(), 0);
  for (Index f = 0; f < mesh_.mesh().face_count(); ++f) {
    const Index old = match_.face(f);
    const std::uint8_t c = old == kNoIndex || !has_same_grain(old, f)
                               ? std::uint8_t{kBoth}
                               : change_of(before_.mesh->face_weight(old), mesh_.face_weight(f));
    if (c == 0) continue;
    for (Index k = 0; k < 3; ++k) change_[mesh_.edges().edge(3 * f + k)] |= c;
  }
  for (Index e = 0; e < layout_edges(); ++e) {
    if (match_.row(e) == kNoIndex) {
      change_[e] = kBoth;
    } else {
      change_[e] |= change_of(before_.mesh->edge_weight(match_.row(e)), mesh_.edge_weight(e));
    }
  }
  find_changed_bridges();
}

bool Carrying::has_same_grain(Index old, Index f) const {
  const Stretches &before = before_.mesh->stretches(), &after = mesh_.stretches();
  if (!before.any() && !after.any()) return true;
  bool same = before.area(old) == after.area(f);
  for (Index k = 0; k < 3; ++k) same = same && before.along(3 * old + k) == after.along(3 * f + k);
  return same;
}

void Carrying::find_changed_bridges() {
  using Key = std::tuple<Index, Index, bool>;
  std::map<Key, double> old;
  for (const Bridge& b : before_.mesh->all_bridges()) {
    const Index from = match_.row_after(b.from), to = match_.row_after(b.to);
    if (from != kNoIndex && to != kNoIndex) old[{from, to, b.mirrored}] = b.cost;
  }
  const auto mark = [&](const Key& key) { change_[std::get<0>(key)] = change_[std::get<1>(key)] = kDearer | kCheaper; };
  for (const Bridge& b : mesh_.all_bridges()) {
    const Key key{b.from, b.to, b.mirrored};
    const auto found = old.find(key);
    if (found == old.end() || found->second != b.cost) mark(key);
    if (found != old.end()) old.erase(found);
  }
  for (const auto& [key, cost] : old) mark(key);
}

void Carrying::match_sources() {
  using Key = std::tuple<PointLocation::On, Index, double, std::array<double, 3>, double>;
  const auto key_of = [](const detail::LocatedSource& s, auto vertex, auto face) -> Key {
    if (s.at.on == PointLocation::On::Vertex) return {s.at.on, vertex(s.at.vertex), 0, {}, s.offset};
    if (s.at.on == PointLocation::On::Edge) {
      const Index f = face(Mesh::face_of(s.at.halfedge));
      return {s.at.on, f == kNoIndex ? kNoIndex : 3 * f + s.at.halfedge % 3, s.at.t, {}, s.offset};
    }
    return {s.at.on, face(s.at.face), 0, s.at.weights, s.offset};
  };
  std::map<Key, Index> known;
  const auto itself = [](Index i) { return i; };
  for (std::size_t i = 0; i < after_.sources.size(); ++i) {
    known.try_emplace(key_of(after_.sources[i], itself, itself), static_cast<Index>(i));
  }
  for (const detail::LocatedSource& s : before_.sources) {
    const auto found = known.find(
        key_of(s, [&](Index v) { return match_.vertex_after(v); }, [&](Index f) { return match_.face_after(f); }));
    const Index now = found == known.end() ? kNoIndex : found->second;
    same_sources_ = same_sources_ && now == source_after_.size();
    source_after_.push_back(now);
  }
}

std::vector<Index> Carrying::rows_of_points_before() const {
  const PointLayout& layout = *before_.layout;
  std::vector<Index> rows(layout.size());
  for (Index e = 0; e < before_.mesh->edges().count(); ++e) {
    std::fill(rows.begin() + layout.row(e), rows.begin() + layout.row(e) + layout.room(e), e);
  }
  return rows;
}

// Parents that were not carried over leave their children without a value.
void Carrying::copy_front() {
  const std::vector<Index> row_of = rows_of_points_before();
  const auto parent_after = [&](Index p) {
    if (p >= kFromSource) return p;
    const Index row = row_of[p], e = match_.row_after(row);
    return e == kNoIndex ? kNoIndex : layout_.row(e) + (p - before_.layout->row(row));
  };
  front_ = unreached(mesh_, layout_);
  for (Index v = 0; v < mesh_.mesh().vertex_count(); ++v) {
    const Index old = match_.vertex(v);
    if (old == kNoIndex || before_.front.vertex_value[old] == kInfinity) continue;
    front_.vertex_value[v] = before_.front.vertex_value[old];
    front_.vertex_parent[v] = parent_after(before_.front.vertex_parent[old]);
  }
  for (Index e = 0; e < layout_edges(); ++e) {
    if (match_.row(e) == kNoIndex) continue;
    const Index from = before_.layout->row(match_.row(e)), to = layout_.row(e), count = layout_.count(e);
    for (Index i = 0; i < count; ++i) {
      if (before_.front.value[from + i] == kInfinity) continue;
      front_.value[to + i] = before_.front.value[from + i];
      front_.parent[to + i] = parent_after(before_.front.parent[from + i]);
    }
  }
}

// Whether a step that led there is dearer now, or may be.
bool Carrying::is_doubtful(Index point) const {
  const Index parent = front_.parent[point];
  return parent >= kFromSource || change_[layout_.edge_of(parent)] & kDearer;
}

void Carrying::rename_sources() {
  for (std::vector<Index>* parents : {&front_.parent, &front_.vertex_parent}) {
    for (Index& p : *parents) {
      if (p < kFromSource || p == kNoIndex) continue;
      const Index s = source_after_[p - kFromSource];
      p = s == kNoIndex ? kNoIndex : kFromSource + s;
    }
  }
}

// What is known by itself not to hold, before what hangs on it.
void Carrying::doubt() {
  const bool all_known = match_.is_identity && same_sources_;  // every value still has its parent
  waits_.assign(layout_edges(), 0);
  has_lost_.assign(layout_edges(), 0);
  if (!same_sources_) rename_sources();
  for (Index v = 0; v < mesh_.mesh().vertex_count() && !all_known; ++v) {
    if (match_.vertex(v) == kNoIndex || (front_.vertex_parent[v] == kNoIndex && front_.vertex_value[v] < kInfinity)) {
      lose_vertex(v);
    }
  }
  for (Index e = 0; e < layout_edges(); ++e) {
    if (all_known && !(change_[e] & kDearer)) continue;  // most rows: not to be looked at
    const Index row = layout_.row(e);
    for (Index i = 0; i < layout_.count(e); ++i) {
      if (front_.value[row + i] == kInfinity) continue;
      const bool dearer = change_[e] & kDearer;
      if (front_.parent[row + i] == kNoIndex || (dearer && is_doubtful(row + i))) lose(e, i);
    }
    if (match_.row(e) == kNoIndex) has_lost_[e] = 1;
  }
}

void Carrying::push(Index e) {
  has_lost_[e] = 1;
  if (waits_[e]) return;
  waits_[e] = 1;
  lost_.push_back(e);
}

void Carrying::lose_point(Index point) {
  lost_points_ += front_.value[point] < kInfinity;
  front_.value[point] = kInfinity;
  front_.parent[point] = kNoIndex;
}

void Carrying::lose(Index e, Index i) {
  const Index h = mesh_.edges().halfedge(e);
  if (i == 0) return lose_vertex(mesh_.mesh().from(h));
  if (i + 1 == layout_.count(e)) return lose_vertex(mesh_.mesh().to(h));
  lose_point(layout_.row(e) + i);
  push(e);
}

void Carrying::lose_vertex(Index v) {
  front_.vertex_value[v] = kInfinity;
  front_.vertex_parent[v] = kNoIndex;
  for (const Index e : mesh_.edges().at(v)) {
    const Index h = mesh_.edges().halfedge(e);
    for (const bool last : {false, true}) {
      if ((last ? mesh_.mesh().to(h) : mesh_.mesh().from(h)) != v) continue;
      const Index point = layout_.row(e) + (last ? layout_.count(e) - 1 : 0);
      lose_point(point);
    }
    push(e);
  }
}

// The row itself, those of its faces, and over fences.
template <class Use>
void Carrying::for_each_neighbour(Index e, Use use) const {
  const Index begin = mesh_.edges().halfedge(e);
  use(e);
  Index h = begin;
  do {
    for (const Index g : {Mesh::next(h), Mesh::previous(h)}) use(mesh_.edges().edge(g));
    h = opposite_[h];
  } while (h != begin);
  for (const Bridge& b : mesh_.bridges(e)) use(b.to);
}

void Carrying::forget_descendants() {
  // First in, first out: a row has lost most of what it will before its neighbours hear of it.
  std::size_t next = 0;
  while (next < lost_.size()) {
    const Index e = lost_[next++], first = layout_.row(e), count = layout_.count(e);
    waits_[e] = 0;
    for_each_neighbour(e, [&](Index r) {
      const Index* parents = front_.parent.data() + layout_.row(r);
      for (Index i = 0; i < layout_.count(r); ++i) {
        if (parents[i] - first < count && front_.value[parents[i]] == kInfinity) lose(r, i);
      }
    });
  }
}

// Rows with something to say to a row that has lost something, and those beside which a step is cheaper.
std::vector<Index> Carrying::rim() const {
  std::vector<std::uint8_t> is_asked(layout_edges(), 0);
  for (Index e = 0; e < layout_edges(); ++e) {
    if (has_lost_[e]) {
      for_each_neighbour(e, [&](Index r) { is_asked[r] = 1; });
    } else if (change_[e] & kCheaper) {
      is_asked[e] = 1;
    }
  }
  std::vector<Index> rows;
  for (Index e = 0; e < layout_edges(); ++e) {
    if (!is_asked[e]) continue;
    const double* values = front_.value.data() + layout_.row(e);
    const auto is_known = [](double v) { return v < kInfinity; };
    if (std::any_of(values, values + layout_.count(e), is_known)) rows.push_back(e);
  }
  return rows;
}

double Carrying::known_share() const {
  std::uint64_t known = 0, all = 0;
  for (Index e = 0; e < layout_edges(); ++e) {
    const double* values = front_.value.data() + layout_.row(e);
    all += layout_.count(e);
    for (Index i = 0; i < layout_.count(e); ++i) known += values[i] < kInfinity;
  }
  return all > 0 ? static_cast<double>(known) / static_cast<double>(all) : 0;
}

// Where no row was laid out anew.
double Carrying::kept_share() const {
  return layout_.size() > 0 ? 1 - static_cast<double>(lost_points_) / static_cast<double>(layout_.size()) : 0;
}

}  // namespace

Carried carry(Run& before, const Run& after) {
  if (before.mesh->mesh().unit() != after.mesh->mesh().unit() || before.base != after.base) {
    return {unreached(*after.mesh, *after.layout), {}, 0};
  }
  return Carrying(before, after)();
}

}  // namespace brushfire::steiner
