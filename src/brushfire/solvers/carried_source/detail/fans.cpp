// Strings faces together around vertices, and adds up their angles.
#include <brushfire/solvers/carried_source/detail/fans.h>

#include <brushfire/core/cancel.h>

#include <algorithm>
#include <cmath>

namespace brushfire::carried_source {
namespace {

constexpr double kNotYet = -1;          // of a corner that is in no fan
constexpr double kTurnRounding = 1e-9;  // of angles, by far

// At the corner between sides a and b, c opposite.
double angle_between(double a, double b, double c, double double_area) {
  const double shorter = std::min(a, b), longer = std::max(a, b);
  const double dot = 0.5 * (shorter * shorter + (longer - c) * (longer + c));  // keeps digits in needles
  return std::atan2(double_area, dot);
}

}  // namespace

Fans::Fans(const Mesh& mesh)
    : mesh_(mesh), opposite_(mesh.opposite()), lengths_(mesh.lengths()), areas_(mesh.double_areas()) {
  corners_.resize(mesh.halfedge_count());
  for (FanCorner& c : corners_) c.high = kNotYet;
  side_count_.resize(mesh.vertex_count());
  odd_.resize(mesh.vertex_count());
  sector_begin_.reserve(mesh.vertex_count() + std::size_t{1});
  sectors_.reserve(mesh.halfedge_count());
  Poll poll;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    poll();
    sector_begin_.push_back(static_cast<Index>(sectors_.size()));
    build(v);
  }
  sector_begin_.push_back(static_cast<Index>(sectors_.size()));
  if (std::find(odd_.begin(), odd_.end(), true) != odd_.end()) name_edges();
}

void Fans::build(Index v) {
  all_.clear(), ranges_.clear(), around_.clear();
  bool odd = false;
  for (const Index h : mesh_.corners(v)) {
    if (corners_[h].high != kNotYet || !mesh_.is_face_usable(Mesh::face_of(h))) continue;
    const bool closed = string_together({h, false});
    ranges_.push_back({static_cast<Index>(all_.size()), static_cast<Index>(all_.size() + fan_.size()), closed});
    all_.insert(all_.end(), fan_.begin(), fan_.end());
    for (const Loose& at : fan_) corners_[at.corner].high = 0;
    const Loose first = fan_.front(), last = fan_.back();
    const auto meets_more = [&](Index side) { return opposite_[side] != side; };
    odd |= !closed && (meets_more(first.mirrored ? Mesh::previous(first.corner) : first.corner) ||
                       meets_more(last.mirrored ? last.corner : Mesh::previous(last.corner)));
  }
  odd_[v] = odd || ranges_.size() > 1;
  Index sides = 0;
  for (const Range& range : ranges_) {
    sides = lay_out(range, static_cast<Index>(around_.size()), sides, range.closed && !odd_[v]);
    around_.push_back(range.closed ? corners_[all_[range.end - 1].corner].high : kInfinity);
  }
  side_count_[v] = sides;
  share_sectors();
}

// The corner beyond one side of a corner; none where the edge has not exactly two faces.
Fans::Loose Fans::beside(Loose at, bool forward) const {
  const Index v = mesh_.from(at.corner);
  const Index side = forward == at.mirrored ? at.corner : Mesh::previous(at.corner);
  const Index other = opposite_[side];
  if (other == side || opposite_[other] != side) return {};
  const bool own = mesh_.from(other) == v;
  return {own ? other : Mesh::next(other), forward ? !own : own};
}

// Into fan_: all from its beginning on. Whether it is closed.
bool Fans::string_together(Loose from) {
  Loose first = from;
  bool closed = false;
  for (Loose back = beside(first, false); back.corner != kNoIndex; back = beside(first, false)) {
    closed = back.corner == from.corner;
    if (closed) break;
    first = back;
  }
  if (closed) first = from;
  fan_.clear();
  for (Loose at = first; at.corner != kNoIndex; at = beside(at, true)) {
    if (!fan_.empty() && at.corner == first.corner) break;
    fan_.push_back(at);
  }
  return closed;
}

// Returns the number of the next side.
Index Fans::lay_out(const Range& range, Index fan, Index side, bool ends_meet) {
  const Index first_side = side;
  double angle = 0;
  for (Index k = range.begin; k < range.end; ++k) {
    FanCorner& c = corners_[all_[k].corner];
    c.mirrored = all_[k].mirrored;
    c.fan = fan;
    c.first_side = side++;
    c.last_side = side;
    c.low = angle;
    const Index h = all_[k].corner;
    angle += angle_between(lengths_[h], lengths_[Mesh::previous(h)], lengths_[Mesh::next(h)], areas_[Mesh::face_of(h)]);
    c.high = angle;
  }
  if (ends_meet) corners_[all_[range.end - 1].corner].last_side = first_side;
  return ends_meet ? side : side + 1;
}

// One fan may have all sectors; several have equal numbers of them, without the shared one.
void Fans::share_sectors() {
  const auto fans = static_cast<Index>(ranges_.size());
  const Index each = fans <= 1 ? kSectors : std::max<Index>(1, kSharedSector / fans);
  const std::size_t first = sectors_.size();
  for (Index fan = 0; fan < fans; ++fan) {
    const Range& range = ranges_[fan];
    const Index count = range.end - range.begin, used = std::min(each, count);
    const bool is_beyond = fans > 1 && fan >= kSharedSector;
    for (Index k = 0; k < count; ++k) {
      FanCorner& c = corners_[all_[range.begin + k].corner];
      c.sector = kSharedSector;
      if (is_beyond) continue;
      const auto part = [&](Index i) { return std::uint64_t{i} * used / count; };
      if (k == 0 || part(k) != part(k - 1)) sectors_.push_back({c.low, c.low, around_[fan], fan});
      sectors_.back().high = c.high;
      c.sector = static_cast<std::uint8_t>(sectors_.size() - 1 - first);
    }
  }
}

Direction Fans::within(Index v, Index fan, double angle) const {
  const std::span<const Sector> all = sectors(v);
  Direction at{angle, fan, kSharedSector};
  for (Index k = 0; k < all.size(); ++k) {
    if (all[k].fan != fan) continue;
    if (all[k].around < kInfinity && at.sector == kSharedSector) {
      at.angle = std::max(0.0, angle - all[k].around * std::floor(angle / all[k].around));
    }
    if (at.sector == kSharedSector || all[k].low <= at.angle) at.sector = k;
  }
  return at;
}

bool Fans::bends_light(Index v) const {
  const std::span<const Sector> all = sectors(v);
  if (all.empty() || is_odd(v)) return false;
  const bool closed = all.back().around < kInfinity;
  return all.back().high > (closed ? 2 * kPi : kPi) + kTurnRounding;
}

void Fans::name_edges() {
  edge_.assign(mesh_.halfedge_count(), kNoIndex);
  for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
    for (Index g = h; edge_[g] == kNoIndex; g = opposite_[g]) edge_[g] = h;
  }
}

}  // namespace brushfire::carried_source
