// Bounds into values, inner numbers into the mesh's own, and what is known of a vertex in several parts into one.
#include <brushfire/solvers/windows/paths/results.h>

#include <brushfire/core/detail/double_double.h>
#include <brushfire/core/detail/sort.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <queue>
#include <utility>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

Results::Results(RunState& run, std::span<Part> parts, DistanceField& field) : run_(run), parts_(parts), field_(field) {
  for (const detail::LocatedSource& s : run_.problem->sources) {
    if (!s.curve) continue;
    for (const CurvePlace& p : s.curve->places) {
      if (p.at.on == PointLocation::On::Vertex && p.offset == 0) places_.emplace_back(s.label, p.at.vertex);
    }
  }
  detail::sort(places_.begin(), places_.end());
}

void Results::write(std::vector<Index>& scratch, ThreadTeam* team) {
  finish_targets();
  finish_labels(scratch);
  write_vertices(team);
  write_targets();
  if (run_.keeps_rays()) keep();
}

Index Results::label_of(Index pseudo_source) const {
  const Index n = run_.structure.vertex_count();
  return pseudo_source >= n ? pseudo_source - n : run_.several ? run_.provenance[pseudo_source].label : 0;
}

void Results::offer_target(Index target, Real value, Real slack, Real lift, const Ray& ray, bool straight) {
  TargetState& t = run_.targets[target];
  t.upper = std::min(t.upper, value + slack);
  if (!straight) return;
  if (value > t.lower || (value == t.lower && label_of(ray.pseudo_source) >= label_of(t.ray.pseudo_source))) return;
  t.lower = value;
  t.estimate = value + lift;
  t.ray = ray;
}

// Around the corners of a target's face.
void Results::finish_targets() {
  for (const TargetInFace& t : run_.targets.in_faces()) {
    const std::array<Real, 3> d = corner_distances_of(run_.structure, {t.face, t.weights});
    for (Index k = 0; k < 3; ++k) {
      const Index v = run_.structure.faces[t.face].vertex[k];
      const VertexValues& at = run_.values[v];
      if (at.upper == kInfinity) continue;
      const Real slack = std::max(Real{0}, at.upper - at.lower);
      offer_target(t.target, at.lower + d[k], slack, std::clamp(at.estimate - at.lower, Real{0}, slack),
                   {{}, kNoIndex, v, WindowKind::Circular});
    }
  }
}

// A vertex belongs to the source to which its chain of pseudo-sources leads; with ties, pseudo-sources may have changed
// hands since.
void Results::finish_labels(std::vector<Index>& chain) {
  if (!run_.several) return;
  const Index n = run_.structure.vertex_count();
  std::vector<Provenance>& provenance = run_.provenance;
  for (const Part& part : parts_) {
    part.vertices().for_each_touched([&](Index v) {
      chain.clear();
      while (v < n && provenance[v].pseudo_source < n && chain.size() <= n) {
        chain.push_back(v);
        v = provenance[v].pseudo_source;
      }
      if (v >= n) return;
      for (const Index u : chain) provenance[u].label = provenance[v].label;
    });
  }
}

// What is known of a vertex in any part.
VertexValues Results::with_ghosts(Index v) const {
  VertexValues all = run_.values[v];
  for (Index c = all.next_ghost; c != v && c != kNoIndex; c = run_.values[c].next_ghost) {
    all.upper = std::min(all.upper, run_.values[c].upper);
    const VertexValues& ghost = run_.values[c];
    if (ghost.lower <= all.lower) all.direct = ghost.direct || (all.direct && ghost.lower == all.lower);
    all.lower = std::min(all.lower, ghost.lower);
    all.estimate = std::min(all.estimate, run_.values[c].estimate);
  }
  return all;
}

bool Results::is_owner(Index v) const {
  return !run_.values[v].has_ghosts() || run_.structure.inner_vertex(run_.structure.outer_vertex(v)) == v;
}

void Results::write_vertices(ThreadTeam* team) {
  if (!run_.problem->touched) field_.error_bound.assign(run_.structure.mesh.vertex_count(), kInfinity);
  field_.max_error_bound = 0;
  std::vector<Index> unseen;
  Index seen = 0;
  const auto count = [&](const Tally& tally) {
    field_.beyond_radius += tally.beyond_radius;
    field_.max_error_bound = std::max(field_.max_error_bound, tally.largest_bound);
    unseen.insert(unseen.end(), tally.unseen.begin(), tally.unseen.end());
    seen += tally.seen;
  };
  if (!team || run_.problem->touched) {
    for (const Part& part : parts_) count(write_vertices(part));
  } else {
    std::vector<Tally> tallies(parts_.size());
    team->run(parts_.size(), [&](unsigned, std::size_t p) { tallies[p] = write_vertices(parts_[p]); });
    for (const Tally& tally : tallies) count(tally);
  }
  write_unseen(std::move(unseen), seen);
}

Results::Tally Results::write_vertices(const Part& part) {
  const bool narrowed = run_.radius < run_.problem->max_distance + run_.shift;
  Tally tally;
  part.vertices().for_each_touched([&](Index v) {
    if (!is_owner(v)) return;
    const Index outer = run_.structure.outer_vertex(v);
    if (run_.problem->touched) run_.problem->touched->push_back(outer);
    VertexValues s = with_ghosts(v);
    if (s.lower == kInfinity && s.upper < kInfinity && s.upper <= run_.radius) {
      tally.unseen.push_back(outer);
      return;
    }
    // Seen by no window yet, or not final when the run stopped.
    if (s.lower == kInfinity || (narrowed && s.lower > run_.radius)) {
      ++tally.beyond_radius;
      return;
    }
    const Index label = label_of(v);
    Rounding rounding = run_.rounding;
    if (const std::optional<Real> chord = chord_to(outer, s, label)) {
      rounding.absolute = 0;
      s.upper = s.estimate = s.lower = run_.start_of(label) + *chord;  // a window that comes to less is rounded
    }
    const CertifiedValue r = read(s.lower, s.upper, s.estimate, label, rounding, outer);
    field_.distance[outer] = to_double(r.value - run_.shift);
    field_.source[outer] = label;
    if (!run_.problem->touched) field_.error_bound[outer] = r.bound;
    if (r.value <= run_.radius && r.relative > tally.largest_bound) tally.largest_bound = r.relative;
    ++tally.seen;
  });
  return tally;
}

// Rounding may lose light that grazes a vertex, or even all that comes into a face. A path leads there all the same:
// along edges from vertices that are seen, shortest first. Its length is then what is known, and anything down to the
// least that a source begins with may be the distance. `unseen`: those that a path was found to; all vertices are
// looked at where the run had no limit. O(edges at unseen vertices, log).
void Results::write_unseen(std::vector<Index> unseen, Index seen) {
  const Mesh& mesh = run_.structure.mesh;
  if (!(run_.radius < kInfinity) && !run_.problem->touched && seen < mesh.vertex_count()) {
    unseen.clear();
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (field_.distance[v] == kInfinity && !mesh.corners(v).empty()) unseen.push_back(v);
    }
  }
  if (unseen.empty()) return;
  struct Step {
    Real length;
    Index to, from;
    bool operator<(const Step& o) const { return o.length < length; }
  };
  std::priority_queue<Step> steps;
  const auto is_unseen = [&](Index v) { return field_.distance[v] == kInfinity; };
  const auto offer = [&](Index from, Index to, Index h) {
    if (is_unseen(from) || !is_unseen(to)) return;
    const VertexValues at = with_ghosts(run_.structure.inner_vertex(from));
    steps.push({std::min(at.lower, at.upper) + mesh.length(h), to, from});
  };
  const auto look_around = [&](Index v, bool outwards) {
    for (const Index corner : mesh.corners(v)) {
      for (const Index h : {corner, Mesh::previous(corner)}) {
        const Index other = mesh.from(h) == v ? mesh.to(h) : mesh.from(h);
        outwards ? offer(v, other, h) : offer(other, v, h);
      }
    }
  };
  for (const Index v : unseen) look_around(v, false);
  while (!steps.empty()) {
    const Step next = steps.top();
    steps.pop();
    if (!is_unseen(next.to) || next.length > run_.radius) continue;
    write_unseen(next.to, next.from, next.length);
    look_around(next.to, true);
  }
}

// A vertex and the one before it on the way, by the mesh's numbers.
void Results::write_unseen(Index outer, Index before, Real along_edge) {
  const Index v = run_.structure.inner_vertex(outer), label = field_.source[before];
  Part& part = parts_[run_.structure.part_of_vertex(v)];
  part.vertices().reach(v, along_edge);
  // Of one source any path will do, and a shorter one may be known.
  const Real length = run_.several ? along_edge : with_ghosts(v).upper;
  const Real least = run_.several ? Real{0} : run_.start_of(0);
  const double rounded = run_.rounding.of(to_double(length - least));
  Real value = length;
  if (run_.problem->options->bound == Bound::Upper) value = length + rounded;
  if (run_.problem->options->bound == Bound::Lower) value = least;
  run_.values[v].lower = length;
  if (run_.several) run_.provenance[v] = {run_.structure.inner_vertex(before), label};
  if (run_.keeps_rays()) run_.rays[v] = {{}, kNoIndex, run_.structure.inner_vertex(before), WindowKind::Circular};
  field_.distance[outer] = to_double(value - run_.shift);
  field_.source[outer] = label;
  if (!run_.problem->touched) field_.error_bound[outer] = to_double(length - least) + 2 * rounded;
  field_.max_error_bound = std::max(field_.max_error_bound, 1.0);
}

void Results::write_targets() {
  for (Index i = 0; i < run_.targets.size(); ++i) {
    const PointLocation& at = run_.problem->targets[i];
    if (at.on == PointLocation::On::Vertex) continue;  // read off the field
    const TargetState& t = run_.targets[i];
    if (t.upper == kInfinity) continue;
    field_.target_source[i] = label_of(t.ray.pseudo_source);
    field_.target_distance[i] =
        to_double(read(t.lower, t.upper, t.estimate, field_.target_source[i], run_.rounding).value - run_.shift);
  }
}

namespace {

// To some thirty digits: of those of coordinates nothing may be left beside the opposite edge of a needle.
Real chord_between(const Mesh& mesh, const PointLocation& at, Index v) {
  using detail::DoubleDouble;
  const double scale = 1 / mesh.unit();  // a power of two; first, as squares of coordinates may have no number
  const auto p = mesh.positions();
  const Face& t = mesh.faces()[at.face];
  BasicVec3<DoubleDouble> chord;
  DoubleDouble sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const DoubleDouble weight = at.weights[k];
    const auto along = [&](double to, double from) { return weight * (DoubleDouble(scale * to) - scale * from); };
    chord =
        chord + BasicVec3<DoubleDouble>{along(p[t[k]].x, p[v].x), along(p[t[k]].y, p[v].y), along(p[t[k]].z, p[v].z)};
    sum += weight;
  }
  return static_cast<Real>(norm(chord) / sum);
}

}  // namespace

// A vertex that a source sees within its own face is as far as that straight line is long, which is the chord in space:
// no frame had a part in it, however near the source is. Nothing where that is not so.
std::optional<Real> Results::chord_to(Index outer, const VertexValues& values, Index label) const {
  constexpr std::size_t kFewSources = 64;  // each of the others is looked at
  const std::span<const detail::LocatedSource> sources = run_.problem->sources;
  const Mesh& mesh = run_.structure.mesh;
  if (!values.direct || !mesh.has_positions() || sources.size() > kFewSources || detail::any_curve(sources))
    return std::nullopt;
  // None is nearer, or not surely farther: then windows decided.
  const bool another = sources.size() > 1 && std::any_of(sources.begin(), sources.end(), [&](const auto& s) {
                         return run_.start_of(s.label) + chord_between(mesh, s.at, outer) < values.lower * (1 - 1e-12);
                       });
  if (another) return std::nullopt;
  return chord_between(mesh, sources[label].at, outer);
}

bool Results::is_place(Index outer, Index label) const {
  return outer != kNoIndex && std::binary_search(places_.begin(), places_.end(), std::pair{label, outer});
}

// Of a vertex of the mesh, or of some point. A curve's parallel light may come to nothing where it is merely near.
CertifiedValue Results::read(Real lower, Real upper, Real estimate, Index label, const Rounding& rounding,
                             Index outer) const {
  const Real start = run_.start_of(label);
  const bool is_beside =
      !(std::min(lower, upper) > start) && run_.problem->sources[label].curve && !is_place(outer, label);
  return certified_value(lower, upper, estimate, start, run_.shift, run_.budget.share, rounding,
                         run_.problem->options->bound, is_beside);
}

// With the mesh's own numbers. Sources come behind the vertices: here behind the mesh's, in the run behind the ghosts,
// too.
Index Results::outer_pseudo_source(Index pseudo_source) const {
  const Index n = run_.structure.vertex_count();
  return pseudo_source < n ? run_.structure.outer_vertex(pseudo_source)
                           : pseudo_source - n + run_.structure.mesh.vertex_count();
}
Ray Results::outer(Ray ray) const {
  if (ray.halfedge != kNoIndex) ray.halfedge = run_.structure.outer_halfedge(ray.halfedge);
  if (ray.pseudo_source != kNoIndex) ray.pseudo_source = outer_pseudo_source(ray.pseudo_source);
  return ray;
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
