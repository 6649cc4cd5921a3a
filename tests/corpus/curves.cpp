// Curves at random: a walk from face to face.
#include "corpus/curves.h"

#include "corpus/families.h"

#include <brushfire/mesh/detail/flat_face.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace brushfire::corpus {
namespace {

// A place in face f: of a vertex, of an edge, inside, or a hair beside one of these.
SurfacePoint place_in(Index f, Dice& dice) {
  SurfacePoint p{f, {0, 0, 0}};
  const std::size_t k = dice.below(3);
  const double hair = dice.chance(0.2) ? dice.power(-16, -3) : 0, share = dice.unit();
  switch (dice.below(3)) {
    case 0:
      p.weights[k] = 1 - hair;
      p.weights[(k + 1) % 3] = hair * share;
      p.weights[(k + 2) % 3] = hair * (1 - share);
      break;
    case 1:
      p.weights[k] = hair;
      p.weights[(k + 1) % 3] = (1 - hair) * share;
      p.weights[(k + 2) % 3] = (1 - hair) * (1 - share);
      break;
    default:
      p.weights[k] = dice.unit();
      p.weights[(k + 1) % 3] = (1 - p.weights[k]) * share;
      p.weights[(k + 2) % 3] = (1 - p.weights[k]) * (1 - share);
  }
  return p;
}

Index any_face(const Mesh& mesh, Dice& dice) {
  Index f = dice.below(mesh.face_count());
  while (!mesh.is_face_usable(f)) f = dice.below(mesh.face_count());
  return f;
}

// The next place is in a face that holds this one by the names of both, whatever is snapped.
SurfacePoint step_from(const Mesh& mesh, const SurfacePoint& place, Dice& dice) {
  const std::vector<Index> faces = faces_at(mesh, locate(mesh, place, 0));
  Index f = faces[dice.below(faces.size())];
  if (!mesh.is_face_usable(f)) f = locate(mesh, place, 0).face;
  return place_in(f, dice);
}

// From place to place by up to the length of the segment between; the same where the curve stands still.
void give_offsets(const Mesh& mesh, CurveSource& curve, Dice& dice) {
  const LocatedCurve located = locate(mesh, curve);
  const bool steep = dice.chance(0.2);
  curve.offsets.assign(curve.places.size(), 0);
  double value = mesh.unit() * dice.sign_and_unit();
  std::size_t next = 0;
  for (const CurvePlace& place : located.places) {
    for (; next < place.number; ++next) curve.offsets[next] = value;
    if (place.before == kNoIndex) continue;
    const double slope = steep ? (dice.chance(0.5) ? 1 : -1) : dice.chance(0.2) ? 0 : dice.sign_and_unit();
    value += slope * located.segments[place.before].length;
  }
  for (; next < curve.places.size(); ++next) curve.offsets[next] = value;
}

}  // namespace

CurveSource random_curve(const Mesh& mesh, Dice& dice) {
  CurveSource curve;
  for (int pieces = dice.chance(0.2) ? 2 : 1; pieces > 0; --pieces) {
    if (!curve.places.empty()) curve.places.push_back({});
    curve.places.push_back(place_in(any_face(mesh, dice), dice));
    for (int steps = dice.chance(0.1) ? 0 : dice.between(1, 12); steps > 0; --steps) {
      const SurfacePoint last = curve.places.back();
      curve.places.push_back(dice.chance(0.1) ? last : step_from(mesh, last, dice));
    }
    if (!dice.chance(0.2)) continue;
    const auto begin = static_cast<std::size_t>(
        std::find_if(curve.places.rbegin(), curve.places.rend(), [](const SurfacePoint& p) { return p.is_nowhere(); })
            .base() -
        curve.places.begin());
    for (std::size_t i = curve.places.size(); i-- > begin;) curve.places.push_back(curve.places[i]);
    curve.closed = pieces == 1 && begin == 0;
  }
  if (!curve.closed && dice.chance(0.4)) give_offsets(mesh, curve, dice);
  return curve;
}

std::vector<Source> curves_and_points(const Mesh& mesh, Dice& dice) {
  std::vector<Source> sources{source_along(random_curve(mesh, dice))};
  if (dice.chance(0.5)) return sources;
  const auto offset = [&] { return dice.chance(0.4) ? 0 : mesh.unit() * dice.sign_and_unit(); };
  for (int more = dice.between(1, 3); more > 0; --more) {
    if (dice.chance(0.5)) {
      sources.push_back(source_along(random_curve(mesh, dice), offset()));
    } else {
      sources.push_back({place_in(any_face(mesh, dice), dice), offset()});
    }
  }
  return sources;
}

double least_offset(const Mesh& mesh, const Source& source) {
  return source.curve == nullptr ? source.offset : source.offset + locate(mesh, *source.curve).least_offset;
}

std::optional<double> offset_at(const Mesh& mesh, const Source& source, const SurfacePoint& place, double room,
                                double expected) {
  if (source.curve == nullptr) return source.offset;
  const LocatedCurve curve = locate(mesh, *source.curve);
  const PointLocation at = locate(mesh, place, 0);
  std::optional<double> best;
  const auto offer = [&](double value) {
    if (!best || std::abs(value - expected) < std::abs(*best - expected)) best = value;
  };
  // A segment along an edge is in all of the edge's faces.
  for (const Index f : faces_at(mesh, at)) {
    const std::array<double, 3> weights = *weights_in(mesh, at, f);
    for (const CurveSegment& s : curve.segments) {
      const auto begin = weights_in(mesh, curve.places[s.from_place].at, f);
      const auto end = weights_in(mesh, curve.places[s.to_place].at, f);
      if (!begin || !end || (f != s.face && !s.along_edge)) continue;
      const double from = mesh.unit() * distance_within(mesh, f, *begin, weights);
      const double to = mesh.unit() * distance_within(mesh, f, weights, *end);
      if (from + to - s.length > room) continue;
      const double t = s.length > 0 ? std::min(1.0, from / s.length) : 0;
      offer(source.offset + s.from_offset + t * (s.to_offset - s.from_offset));
    }
  }
  for (const CurvePlace& p : curve.places) {
    const Index f = common_face(mesh, p.at, at);
    if (f == kNoIndex || mesh.unit() * distance_within(mesh, f, p.at, at) > room) continue;
    offer(source.offset + p.offset);
  }
  return best;
}

std::string text_of(const CurveSource& curve) {
  std::string text = curve.closed ? "closed" : "open";
  for (std::size_t i = 0; i < curve.places.size(); ++i) {
    text += ' ' + (curve.places[i].is_nowhere() ? "-" : place_text(curve.places[i]));
    if (curve.offsets.empty()) continue;
    char offset[40];
    std::snprintf(offset, sizeof offset, "@%.17g", curve.offsets[i]);
    text += offset;
  }
  return text;
}

}  // namespace brushfire::corpus
