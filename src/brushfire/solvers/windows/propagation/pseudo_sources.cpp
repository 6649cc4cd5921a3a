// The first windows of a source or a pseudo-source, and what it sees along edges.
#include <brushfire/solvers/windows/propagation/pseudo_sources.h>

#include <brushfire/solvers/windows/propagation/arrivals.h>
#include <brushfire/solvers/windows/propagation/sink.h>

#include <algorithm>
#include <span>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// A source nearer to a vertex than this share of the longest edge of a face there makes the vertex send light in all
// directions: limit rays past the vertex are known to epsilon / share only, in the frames of that face.
constexpr double kNear = 1e-3 * kFiner;

Real longest_edge(const WindowFace& f) { return std::max({f.length[0], f.length[1], f.length[2]}); }

// Of a source in a face at v: every face there counts, since light that passes v goes on through them.
bool is_near(const PartState& part, Index v, Index face, Real distance) {
  const WindowStructure& structure = part.run->structure;
  const auto is_short = [&](Real edge) { return distance < kNear * edge; };
  if (is_short(longest_edge(structure.faces[face]))) return true;
  if (!is_short(structure.unevenness.longest())) return false;  // which is so nearly always
  const std::span<const Index> corners = structure.corners_of(v, part.bench->corners);
  return std::any_of(corners.begin(), corners.end(),
                     [&](Index h) { return is_short(longest_edge(structure.faces[h / 3])); });
}

// A path from v along an edge to w.
void reach_along(PartState& part, Index v, Index w, Real length, const Ray& ray) {
  const Real value = part.vertices[v].lower + length;
  part.vertices.reach(w, value + part.vertices.slack(v));
  part.vertices.expect(w, value, part.vertices.lift(v));
  see_vertex(part, w, value, ray, false);
}

// Along the edge from v to corner j of a face that contains both.
void propagate_along(PartState& part, Index v, Index face, Index j, Real length) {
  const WindowFace& f = part.run->structure.faces[face];
  const Index opposite = next3(j);  // the halfedge opposite of corner j; v is one of its ends
  const Real x = f.vertex[opposite] == v ? 0 : f.length[opposite];
  const bool framed = f.length[opposite] > 0;
  reach_along(part, v, f.vertex[j], length, {{x, 0}, framed ? 3 * face + opposite : kNoIndex, v, WindowKind::Circular});
}

// Along the sector's edges to their ends, and through its face.
void propagate_into(PartState& part, Index v, Sector sector) {
  const WindowFace& f = part.run->structure.faces[sector.face];
  const Index i = sector.corner, near = next3(i), far = previous3(i);
  // Where the corner lies on the opposite edge, an interval there cannot tell directions: light goes in all of them.
  if (f.double_area <= kOnEdge * f.length[near] * f.length[near]) sector = whole_sector(f, sector.face, i);
  if (sector.from_edge()) propagate_along(part, v, sector.face, near, f.length[i]);
  if (sector.to_edge()) propagate_along(part, v, sector.face, far, f.length[far]);
  if (!(f.length[near] > 0)) return;
  Window w = window_of(f, sector, part.vertices[v].lower);
  w.slack = part.vertices.slack(v);
  w.lift = static_cast<float>(part.vertices.lift(v));
  w.pseudo_source = v;
  if (is_visible(w)) leave_face(part, 3 * sector.face + near, w, Origin::Apex);
}

// Through the whole of the face of a corner at v.
void propagate_through(PartState& part, Index v, Index corner) {
  const Index face = corner / 3, i = corner % 3;
  const WindowFace& f = part.run->structure.faces[face];
  if (f.usable) return propagate_into(part, v, whole_sector(f, face, i));
  for (const Index j : {next3(i), previous3(i)}) {
    if (f.vertex[j] == v) continue;
    reach_along(part, v, f.vertex[j], f.length[j == next3(i) ? i : j], {{}, kNoIndex, v, WindowKind::Circular});
  }
}

// Directions of shorter segments (as a share of the longest edge) are known to some epsilons of this share; then ends
// of segments send light everywhere, too: no way is longer by more than the square of that.
constexpr double kShortSegment = 1e-6 * kSqrtFiner;

// What an end of segments in the face has to send through an edge beside their parallel light: what lies between the
// last rays of both sides, beyond the end. Not cut where that is more than half of all directions. False where nothing
// is left of the window, which is seen from beyond the edge.
bool leave_to_segments(const Frame& frame, Index k, std::span<const SegmentEnd> ends, Window& w) {
  Interval x{0, frame.length};
  const Real longest = std::max({frame.length, frame.left, frame.right});
  for (const SegmentEnd& e : ends) {
    const LineSource line = line_source_in(frame, k, e.segment);
    const bool is_wide = e.is_first ? line.slope > 0 : line.slope < 0;
    if (is_wide || line.length < kShortSegment * longest) continue;
    const Vec2 p = e.is_first ? line.begin : line.end();
    // So near to the edge all directions leave through one point of it, to rounding: see is_on_edge().
    if (p.y <= kOnEdge * frame.length) continue;
    x.keep_beside(p, line.light(e.is_first ? 1 : -1), 1);
    x.keep_beside(p, line.light(e.is_first ? -1 : 1), -1);
  }
  if (x.empty()) return false;
  if (x.high < frame.length) w.b0 = frame.length - x.high, w.d0 = value_at(w, w.b0);
  if (x.low > 0) w.b1 = frame.length - x.low, w.d1 = value_at(w, w.b1);
  return w.b0 < w.b1;
}

// The targets in the face of a segment.
void reach_targets(PartState& part, const SegmentInFace& s, Index pseudo_source) {
  const WindowFace& f = part.run->structure.faces[s.face];
  const auto k = static_cast<Index>(std::max_element(std::begin(f.length), std::end(f.length)) - std::begin(f.length));
  if (!(f.length[k] > 0)) return;
  const Frame frame = frame_of(f, k);
  const LineSource line = line_source_in(frame, k, s);
  part.run->targets.for_each_in(s.face, [&](const TargetInFace& t) {
    const LineSource::Sight sight = line.sight_of(in_frame(frame, k, t.weights));
    reach_target(part, t.target, sight.value, 0, 0, {sight.source, 3 * s.face + k, pseudo_source, sight.kind});
  });
}

// The targets in the face of a source.
void reach_targets(PartState& part, const FaceWeights& at, Real sigma, Index pseudo_source) {
  const WindowFace& f = part.run->structure.faces[at.face];
  part.run->targets.for_each_in(at.face, [&](const TargetInFace& t) {
    const Index k = f.length[0] > 0 ? 0 : 1;
    if (!(f.length[k] > 0)) return;
    const std::array<Real, 3> step = step_between(at.weights, t.weights);
    const Vec2 d = in_frame(frame_of(f, k), k, step);
    const Vec2 source = in_frame(frame_of(f, k), k, at.weights);
    reach_target(part, t.target, sigma + length_of(d.x, d.y), 0, 0,
                 {source, 3 * at.face + k, pseudo_source, WindowKind::Circular});
  });
}

}  // namespace

void propagate_from_vertex(PartState& part, Index v) {
  const WindowStructure& structure = part.run->structure;
  PseudoSource& pseudo_source = part.vertices.pseudo_source(v);
  pseudo_source.waiting = false;
  if (part.vertices[v].lower > part.run->radius) return;
  if (pseudo_source.all_around || structure.vertex_type[v] == VertexType::Full || pseudo_source.halfedge == kNoIndex) {
    for (const Index h : structure.corners_of(v, part.number, part.bench->corners)) propagate_through(part, v, h);
    return;
  }
  const auto into = [&](const Sector& sector) {
    if (part.is_here(sector.face)) propagate_into(part, v, sector);
  };
  if (structure.vertex_type[v] == VertexType::Fans) {
    const std::span<const Index> corners = structure.corners_of(v, part.bench->corners);
    for (const Sector& sector : part.bench->link(structure, corners, pseudo_source.from())) into(sector);
    return;
  }
  for_each_shadow(structure, v, pseudo_source.from(), into);
}

void start_at_vertex(PartState& part, Index v, Real sigma, Index pseudo_source) {
  part.vertices.reach(v, sigma);
  part.vertices.expect(v, sigma, 0);
  see_vertex(part, v, sigma, {{}, kNoIndex, pseudo_source, WindowKind::Circular}, true);
}

// Straight to the corners, and through the edges that the source does not lie on.
void start_in_face(PartState& part, const FaceWeights& at, Real sigma, Index pseudo_source,
                   std::span<const SegmentEnd> ends) {
  const WindowFace& f = part.run->structure.faces[at.face];
  const std::array<Real, 3> distance = corner_distances_of(part.run->structure, at);
  for (Index k = 0; k < 3; ++k) {
    const Index h = 3 * at.face + next3(k);  // opposite of corner k
    Ray ray{{}, kNoIndex, pseudo_source, WindowKind::Circular};
    if (f.usable && f.length[next3(k)] > 0) {
      ray.halfedge = h;
      ray.source = in_frame(frame_of(f, next3(k)), next3(k), at.weights);
    }
    const Real value = sigma + distance[k];
    part.vertices.reach(f.vertex[k], value);
    part.vertices.expect(f.vertex[k], value, 0);
    see_vertex(part, f.vertex[k], value, ray,
               ray.halfedge == kNoIndex || is_near(part, f.vertex[k], at.face, distance[k]));
    if (part.vertices[f.vertex[k]].lower == value) part.vertices.mark_direct(f.vertex[k]);
    if (ray.halfedge == kNoIndex) continue;
    Window w;
    w.b1 = f.length[next3(k)];
    w.source = from_beyond(frame_of(f, next3(k)), next3(k), at.weights);
    w.sigma = sigma;
    w.d0 = sigma + distance[previous3(k)];
    w.d1 = sigma + distance[next3(k)];
    w.pseudo_source = pseudo_source;
    if (!ends.empty() && !leave_to_segments(frame_of(f, next3(k)), next3(k), ends, w)) continue;
    // A source on the edge of a face with an area lights nothing through that edge: the faces beyond start it, too.
    if (is_visible(w) && (w.source.y < 0 || f.double_area == 0)) leave_face_once(part, h, w);
  }
  if (f.has_target) reach_targets(part, at, sigma, pseudo_source);
}

// Straight to the corners, and through the edges that the segment does not lie on. (In a face with a repeated vertex
// there is nothing between the ends, which are sources of their own.)
void start_along(PartState& part, const SegmentInFace& s, Index pseudo_source) {
  const WindowFace& f = part.run->structure.faces[s.face];
  if (!f.usable) return;
  for (Index k = 0; k < 3; ++k) {
    const Index edge = next3(k), h = 3 * s.face + edge;  // opposite of corner k
    if (!(f.length[edge] > 0)) continue;
    const Frame frame = frame_of(f, edge);
    const LineSource line = line_source_in(frame, edge, s);
    if (!(line.length > 0)) return;
    const LineSource::Sight sight = line.sight_of(frame.apex);
    const Vec2 way = line.at(sight.t) - frame.apex;
    part.vertices.reach(f.vertex[k], sight.value);
    part.vertices.expect(f.vertex[k], sight.value, 0);
    see_vertex(part, f.vertex[k], sight.value, {sight.source, h, pseudo_source, sight.kind},
               is_near(part, f.vertex[k], s.face, length_of(way.x, way.y)));
    // A segment on the edge of a face with an area lights nothing through that edge: the faces beyond start it, too.
    if (s.from[k] == 0 && s.to[k] == 0 && f.double_area > 0) continue;
    for (const int side : {1, -1}) {
      Window w = parallel_light(line, side, frame.length);
      w.pseudo_source = pseudo_source;
      if (is_visible(w)) leave_face_once(part, h, w);
    }
  }
  if (f.has_target) reach_targets(part, s, pseudo_source);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
