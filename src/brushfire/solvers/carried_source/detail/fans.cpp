// Strings the faces around a vertex together, and adds up their angles.
#include <brushfire/solvers/carried_source/detail/fans.h>

#include <algorithm>
#include <cmath>

namespace brushfire::carried_source {
namespace {

constexpr double kTurnRounding = 1e-9;  // of angles, by far

// At the corner between sides a and b, c opposite.
double angle_between(double a, double b, double c, double double_area) {
  const double shorter = std::min(a, b), longer = std::max(a, b);
  const double dot = 0.5 * (shorter * shorter + (longer - c) * (longer + c));  // keeps digits in needles
  return std::atan2(double_area, dot);
}

double angle_at(const Mesh& mesh, Index corner) {
  const Mesh::FaceGeometry face = mesh.face_geometry(Mesh::face_of(corner));
  const Index k = corner % 3;
  return angle_between(face.lengths[k], face.lengths[(k + 2) % 3], face.lengths[(k + 1) % 3], face.double_area);
}

}  // namespace

Direction within(std::span<const Sector> sectors, Index fan, double angle) {
  Direction at{angle, fan, kSharedSector};
  for (Index k = 0; k < sectors.size(); ++k) {
    const Sector& s = sectors[k];
    if (s.fan != fan) continue;
    if (s.around < kInfinity && at.sector == kSharedSector) {
      at.angle = std::max(0.0, angle - s.around * std::floor(angle / s.around));
    }
    if (at.sector == kSharedSector || s.low <= at.angle) at.sector = k;
  }
  return at;
}

std::size_t Fans::place(Index halfedge) const {
  const auto at = std::lower_bound(halfedges_.begin(), halfedges_.end(), halfedge);
  return static_cast<std::size_t>(at - halfedges_.begin());
}

bool Fans::is_seam(const Direction& at) const {
  if (at.sector >= sectors_.size() || odd_) return false;
  return at.angle > sectors_[at.sector].around - kTurnRounding;
}

bool Fans::bends_light() const {
  if (sectors_.empty() || odd_) return false;
  const bool closed = sectors_.back().around < kInfinity;
  return sectors_.back().high > (closed ? 2 * kPi : kPi) + kTurnRounding;
}

Fans FanBuilder::at(Index v) {
  Fans fans;
  fans.halfedges_ = mesh_.corners(v);
  fans.corners_.resize(fans.halfedges_.size());
  vertex_ = v;
  done_.assign(fans.halfedges_.size(), false);
  all_.clear(), ranges_.clear(), around_.clear();
  for (std::size_t i = 0; i < fans.halfedges_.size(); ++i) {
    const Index h = fans.halfedges_[i];
    if (done_[i] || !mesh_.is_face_usable(Mesh::face_of(h))) continue;
    const bool closed = string_together({h, false});
    ranges_.push_back({static_cast<Index>(all_.size()), static_cast<Index>(all_.size() + fan_.size()), closed});
    all_.insert(all_.end(), fan_.begin(), fan_.end());
    for (const Loose& at : fan_) done_[fans.place(at.corner)] = true;
    fans.odd_ |= !closed && ends_with_more();
  }
  fans.odd_ |= ranges_.size() > 1;
  for (const Range& range : ranges_) {
    const auto fan = static_cast<Index>(around_.size());
    fans.side_count_ = lay_out(range, fan, fans.side_count_, range.closed && !fans.odd_, fans);
    around_.push_back(range.closed ? fans.corner(all_[range.end - 1].corner).high : kInfinity);
  }
  share_sectors(fans);
  return fans;
}

// Whether more than two faces meet at one of the ends of an open fan.
bool FanBuilder::ends_with_more() const {
  const Loose first = fan_.front(), last = fan_.back();
  const auto meets_more = [&](Index side) { return mesh_.opposite(side) != side; };
  return meets_more(first.mirrored ? Mesh::previous(first.corner) : first.corner) ||
         meets_more(last.mirrored ? last.corner : Mesh::previous(last.corner));
}

// The corner beyond one side of a corner; none where the edge has not exactly two faces.
FanBuilder::Loose FanBuilder::beside(Loose at, bool forward) const {
  const Index side = forward == at.mirrored ? at.corner : Mesh::previous(at.corner);
  const Index other = mesh_.neighbour(side);
  if (other == side) return {};
  const bool own = mesh_.from(other) == vertex_;
  return {own ? other : Mesh::next(other), forward ? !own : own};
}

// Into fan_: all from its beginning on. Whether it is closed.
bool FanBuilder::string_together(Loose from) {
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
Index FanBuilder::lay_out(const Range& range, Index fan, Index side, bool ends_meet, Fans& fans) const {
  const Index first_side = side;
  double angle = 0;
  for (Index k = range.begin; k < range.end; ++k) {
    FanCorner& c = fans.corners_[fans.place(all_[k].corner)];
    c.mirrored = all_[k].mirrored;
    c.fan = fan;
    c.first_side = side++;
    c.last_side = side;
    c.low = angle;
    angle += angle_at(mesh_, all_[k].corner);
    c.high = angle;
  }
  if (ends_meet) fans.corners_[fans.place(all_[range.end - 1].corner)].last_side = first_side;
  return ends_meet ? side : side + 1;
}

// One fan may have all sectors; several have equal numbers of them, without the shared one.
void FanBuilder::share_sectors(Fans& fans) const {
  const auto count_of_fans = static_cast<Index>(ranges_.size());
  const Index each = count_of_fans <= 1 ? kSectors : std::max<Index>(1, kSharedSector / count_of_fans);
  for (Index fan = 0; fan < count_of_fans; ++fan) {
    const Range& range = ranges_[fan];
    const Index count = range.end - range.begin, used = std::min(each, count);
    const bool is_beyond = count_of_fans > 1 && fan >= kSharedSector;
    for (Index k = 0; k < count; ++k) {
      FanCorner& c = fans.corners_[fans.place(all_[range.begin + k].corner)];
      c.sector = kSharedSector;
      if (is_beyond) continue;
      const auto part = [&](Index i) { return std::uint64_t{i} * used / count; };
      if (k == 0 || part(k) != part(k - 1)) fans.sectors_.push_back({c.low, c.low, around_[fan], fan});
      fans.sectors_.back().high = c.high;
      c.sector = static_cast<std::uint8_t>(fans.sectors_.size() - 1);
    }
  }
}

}  // namespace brushfire::carried_source
