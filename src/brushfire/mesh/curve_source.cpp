// A curve's places, and the faces in which its segments lie.
#include <brushfire/mesh/curve_source.h>

#include <brushfire/core/detail/sort.h>
#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace brushfire {
namespace {

// Offsets that were computed may differ by this share more than the segment is long; they are then taken to differ by
// its length.
constexpr double kSlopeRounding = 1e-9;
// And they are known no better than to this share of themselves: beside a large offset a short segment counts for
// nothing.
constexpr double kOffsetRounding = 4 * std::numeric_limits<double>::epsilon();

std::string named(Index first, Index second) {
  return "places " + std::to_string(first) + " and " + std::to_string(second) + " of a curve ";
}

class Splitter {
 public:
  Splitter(const Mesh& mesh, const CurveSource& curve) : mesh_(mesh), curve_(curve) {}

  LocatedCurve operator()() {
    check_offsets();
    std::size_t i = 0;
    while (i < curve_.places.size()) {
      std::size_t end = i;
      while (end < curve_.places.size() && !curve_.places[end].is_nowhere()) ++end;
      if (end > i) add_piece(static_cast<Index>(i), static_cast<Index>(end));
      i = end + 1;
    }
    if (result_.places.empty()) {
      throw Error(ErrorCode::InvalidArgument, "a curve without places: it needs at least one to be a source");
    }
    const auto lower = [](const CurvePlace& a, const CurvePlace& b) { return a.offset < b.offset; };
    result_.least_offset = std::min_element(result_.places.begin(), result_.places.end(), lower)->offset;
    add_inside();
    return std::move(result_);
  }

 private:
  void check_offsets() const {
    if (curve_.offsets.empty()) return;
    if (curve_.offsets.size() != curve_.places.size()) {
      throw Error(ErrorCode::InvalidArgument, std::to_string(curve_.offsets.size()) + " offsets for a curve of " +
                                                  std::to_string(curve_.places.size()) + " places");
    }
    for (std::size_t i = 0; i < curve_.offsets.size(); ++i) {
      if (curve_.places[i].is_nowhere() || std::isfinite(curve_.offsets[i])) continue;
      throw Error(ErrorCode::InvalidArgument, "offset " + number_as_text(curve_.offsets[i]) + " of place " +
                                                  std::to_string(i) + " of a curve is not finite");
    }
  }

  void add_inside() {
    if (curve_.inside.empty()) return;
    for (const Index f : curve_.inside) {
      if (f < mesh_.face_count()) continue;
      throw Error(ErrorCode::IndexOutOfRange, "face " + std::to_string(f) + " inside of a curve does not exist: the " +
                                                  "mesh has " + std::to_string(mesh_.face_count()));
    }
    const auto changes = [&](const CurvePlace& p) { return p.offset != result_.least_offset; };
    if (std::any_of(result_.places.begin(), result_.places.end(), changes)) {
      throw Error(ErrorCode::InvalidArgument,
                  "a curve with faces inside has offsets that change: what would these be?");
    }
    result_.inside = curve_.inside;
    detail::sort(result_.inside.begin(), result_.inside.end());
    result_.inside.erase(std::unique(result_.inside.begin(), result_.inside.end()), result_.inside.end());
  }

  double offset(Index number) const { return curve_.offsets.empty() ? 0 : curve_.offsets[number]; }

  // Places [begin, end), all of them somewhere. No weight is too small to count, but places that were set by hand may
  // share a face only where it does not.
  void add_piece(Index begin, Index end) {
    std::vector<PointLocation> at;
    for (Index i = begin; i < end; ++i) at.push_back(locate(mesh_, curve_.places[i], 0));
    const std::size_t count = at.size(), steps = curve_.closed ? count : count - 1;
    for (std::size_t i = 0; i < steps; ++i) {
      const std::size_t j = (i + 1) % count;
      if (shared_face(at[i], at[j]) != kNoIndex) continue;
      at[i] = locate(mesh_, curve_.places[begin + i]);
      at[j] = locate(mesh_, curve_.places[begin + j]);
    }
    const auto first = static_cast<Index>(result_.places.size());
    result_.places.push_back({at[0], offset(begin), kNoIndex, kNoIndex, begin});
    for (std::size_t i = 1; i < count; ++i) step_to(at[i], begin + static_cast<Index>(i));
    if (curve_.closed && result_.places.size() > first + 1) close(first);
  }

  Index shared_face(const PointLocation& a, const PointLocation& b) const {
    if (weights_in(mesh_, b, a.face)) return a.face;
    return common_face(mesh_, a, b, b.face);
  }

  // From the last place to this one, which becomes the last unless it is the same. (Two places without a length between
  // them may be different: ends of an edge of length 0.)
  void step_to(const PointLocation& at, Index number) {
    const auto last = static_cast<Index>(result_.places.size() - 1);
    const std::optional<CurveSegment> segment = between(result_.places[last], at, number);
    if (!segment && are_one(result_.places[last].at, at)) return;
    result_.places.push_back({at, offset(number), kNoIndex, kNoIndex, number});
    if (segment) join(*segment, last, last + 1);
  }

  bool are_one(const PointLocation& a, const PointLocation& b) const {
    const auto weights = weights_in(mesh_, b, a.face);
    return weights && *weights == a.weights;
  }

  void close(Index first) {
    const auto last = static_cast<Index>(result_.places.size() - 1);
    const CurvePlace begin = result_.places[first];
    if (const std::optional<CurveSegment> segment = between(result_.places[last], begin.at, begin.number)) {
      join(*segment, last, first);
      return;
    }
    if (!are_one(result_.places[last].at, begin.at)) return;
    // The first place was repeated.
    const Index before = result_.places[last].before;
    result_.places.pop_back();
    result_.places[first].before = before;
    if (before != kNoIndex) result_.segments[before].to_place = first;
  }

  void join(CurveSegment segment, Index from, Index to) {
    segment.from_place = from;
    segment.to_place = to;
    const auto number = static_cast<Index>(result_.segments.size());
    result_.places[from].after = result_.places[to].before = number;
    result_.segments.push_back(segment);
  }

  // None where both places are one.
  std::optional<CurveSegment> between(const CurvePlace& from, const PointLocation& to, Index number) const {
    CurveSegment s;
    s.face = shared_face(from.at, to);
    if (s.face == kNoIndex) {
      throw Error(ErrorCode::InvalidArgument, named(from.number, number) +
                                                  "share no face: put a place on every edge between them, or project "
                                                  "the curve onto the mesh");
    }
    s.from = *weights_in(mesh_, from.at, s.face);
    s.to = *weights_in(mesh_, to, s.face);
    s.length = distance_within(mesh_, s.face, s.from, s.to) * mesh_.unit();
    s.from_offset = from.offset;
    s.to_offset = offset(number);
    for (std::size_t k = 0; k < 3; ++k) s.along_edge = s.along_edge || (s.from[k] == 0 && s.to[k] == 0);
    const double rounding =
        kSlopeRounding * s.length + kOffsetRounding * std::max(std::abs(s.from_offset), std::abs(s.to_offset));
    if (!(std::abs(s.to_offset - s.from_offset) <= s.length + rounding)) {
      throw Error(ErrorCode::InvalidArgument, named(from.number, number) + "are " + number_as_text(s.length) +
                                                  " apart, and their offsets " + number_as_text(s.from_offset) +
                                                  " and " + number_as_text(s.to_offset) + " differ by more");
    }
    if (!(s.length > 0)) return std::nullopt;
    return s;
  }

  const Mesh& mesh_;
  const CurveSource& curve_;
  LocatedCurve result_;
};

}  // namespace

bool LocatedCurve::holds(const Mesh& mesh, const PointLocation& point) const {
  if (inside.empty()) return false;
  const auto is_inside = [&](Index f) { return std::binary_search(inside.begin(), inside.end(), f); };
  if (point.on == PointLocation::On::Interior) return is_inside(point.face);
  const std::vector<Index> faces = faces_at(mesh, point);
  return std::any_of(faces.begin(), faces.end(), is_inside);
}

LocatedCurve locate(const Mesh& mesh, const CurveSource& curve) { return Splitter(mesh, curve)(); }

}  // namespace brushfire
