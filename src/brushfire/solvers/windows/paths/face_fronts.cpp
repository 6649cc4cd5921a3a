// Of the face that stands for the caller's, moved onto that one; then neighbours joined.
#include <brushfire/solvers/windows/paths/face_fronts.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/solvers/detail/sheets.h>
#include <brushfire/solvers/windows/paths/departures.h>
#include <brushfire/solvers/windows/paths/record.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// A motion of the plane, or a reflection, that brings one triangle upon another.
class Motion {
 public:
  Motion(const std::array<Vec2, 3>& from, const std::array<Vec2, 3>& to) : from_(from[0]), to_(to[0]) {
    const Vec2 a = (1 / norm(from[1] - from_)) * (from[1] - from_), b = (1 / norm(to[1] - to_)) * (to[1] - to_);
    const bool turned = cross(from[1] - from_, from[2] - from_) * cross(to[1] - to_, to[2] - to_) < 0;
    const double sense = turned ? -1 : 1;
    x_ = {b.x * a.x + sense * b.y * a.y, b.y * a.x - sense * b.x * a.y};
    y_ = {b.x * a.y - sense * b.y * a.x, b.y * a.y + sense * b.x * a.x};
  }

  Vec2 turned(Vec2 v) const { return v.x * x_ + v.y * y_; }
  Vec2 moved(Vec2 p) const { return to_ + turned(p - from_); }
  FaceFront moved(FaceFront front) const {
    // Of parallel light the value at the origin: what it is at a place that moves along.
    const double at_from = front.value(from_);
    front.source = front.parallel ? turned(front.source) : moved(front.source);
    if (front.parallel) front.sigma = at_from + dot(to_, front.source);
    for (FaceFront::Border& b : front.borders) b = {moved(b.point), turned(b.inward)};
    return front;
  }

 private:
  Vec2 from_, to_, x_, y_;
};

// Numbers of the two fronts agree to the rounding of a chain of windows; coordinates are near one, or as large as the
// virtual source is far.
constexpr double kSame = 1e-11;

bool is_same_source(const FaceFront& a, const FaceFront& b) {
  const double room = kSame * (1 + norm(a.source) + std::abs(a.sigma));
  return a.parallel == b.parallel && a.label == b.label && norm(a.source - b.source) <= room &&
         std::abs(a.sigma - b.sigma) <= room;
}

// Whether the last border of one is the first of the other, which lies beyond it.
bool continues(const FaceFront& a, const FaceFront& b) {
  if (a.border_count != 2 || b.border_count != 2 || !is_same_source(a, b)) return false;
  const FaceFront::Border &end = a.borders[1], &start = b.borders[0];
  return norm(end.inward + start.inward) <= kSame && std::abs(dot(start.point - end.point, end.inward)) <= kSame;
}

void join_neighbours(std::vector<FaceFront>& fronts) {
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    for (std::size_t j = 0; j < fronts.size();) {
      if (i == j || !continues(fronts[i], fronts[j])) {
        ++j;
        continue;
      }
      fronts[i].borders[1] = fronts[j].borders[1];
      fronts[j] = fronts.back();
      fronts.pop_back();
      if (i == fronts.size()) i = j;
      j = 0;
    }
  }
}

}  // namespace

std::vector<FaceFront> face_fronts(const WindowField& field, Index face) {
  const WindowFieldData& data = Departures::data_of(field);
  if (!data.all_points) {
    throw Error(ErrorCode::InvalidArgument, "what the field is inside of face " + std::to_string(face) +
                                                " was not kept: set keep_windows for the run");
  }
  std::vector<FaceFront> fronts;
  if (data.view) {
    const detail::Sheets& sheets = *data.view->sheets;
    // Which corner of the face that stands for it is which of its own.
    std::array<Vec2, 3> own = flat_corners(sheets.mesh(), face), single{};
    Index number = kNoIndex;
    for (std::size_t k = 0; k < 3; ++k) {
      SurfacePoint corner{face, {0.25, 0.25, 0.25}};
      corner.weights[k] = 0.5;
      const PointLocation at = sheets.to_single(locate(sheets.mesh(), corner));
      number = at.face;
      const auto heaviest = std::max_element(at.weights.begin(), at.weights.end()) - at.weights.begin();
      single[k] = flat_corners(data.mesh, number)[static_cast<std::size_t>(heaviest)];
    }
    const Motion motion(single, own);
    for (const FaceFront& front : data.all_points->fronts_in(number)) fronts.push_back(motion.moved(front));
  } else {
    fronts = data.all_points->fronts_in(face);
  }
  for (FaceFront& front : fronts) {
    front.sigma -= data.shift;
    if (!data.bases.empty()) front.sigma += data.bases[front.label] / data.mesh.unit();
  }
  join_neighbours(fronts);
  return fronts;
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
