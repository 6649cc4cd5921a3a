// Strings faces together around vertices, and adds up their angles.
#include <brushfire/solvers/carried_source/detail/fans.h>

#include <brushfire/core/cancel.h>

#include <algorithm>
#include <cmath>

namespace brushfire::carried_source {
namespace {

constexpr double kNotYet = -1;  // of a corner that is in no fan

double angle_at(const Mesh& mesh, Index h) {
  const double a = mesh.length(h), b = mesh.length(Mesh::previous(h)), c = mesh.length(Mesh::next(h));
  const double shorter = std::min(a, b), longer = std::max(a, b);
  const double dot = 0.5 * (shorter * shorter + (longer - c) * (longer + c));  // keeps digits in needles
  return std::atan2(mesh.double_area(Mesh::face_of(h)), dot);
}

}  // namespace

Fans::Fans(const Mesh& mesh) : mesh_(mesh), opposite_(mesh.opposite()) {
  static_cast<void>(mesh.lengths());  // of all: angles are asked for one by one
  static_cast<void>(mesh.double_areas());
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
  all_.clear(), fan_end_.clear(), around_.clear();
  Index sides = 0;
  for (const Index h : mesh_.corners(v)) {
    if (corners_[h].high != kNotYet || !mesh_.is_face_usable(Mesh::face_of(h))) continue;
    const bool closed = string_together({h, false});
    lay_out(closed, static_cast<Index>(around_.size()), sides);
    sides += static_cast<Index>(fan_.size()) + (closed ? 0 : 1);
    around_.push_back(closed ? corners_[fan_.back().corner].high : kInfinity);
    all_.insert(all_.end(), fan_.begin(), fan_.end());
    fan_end_.push_back(static_cast<Index>(all_.size()));
    // An end that is no boundary.
    const auto meets_more = [&](Index h1) { return opposite_[h1] != h1; };
    const Loose first = fan_.front(), last = fan_.back();
    if (!closed && (meets_more(first.mirrored ? Mesh::previous(first.corner) : first.corner) ||
                    meets_more(last.mirrored ? last.corner : Mesh::previous(last.corner)))) {
      odd_[v] = true;
    }
  }
  side_count_[v] = sides;
  if (around_.size() > 1) odd_[v] = true;
  share_sectors(v, static_cast<Index>(around_.size()));
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

void Fans::lay_out(bool closed, Index fan, Index first_side) {
  double angle = 0;
  Index side = first_side;
  for (const Loose& at : fan_) {
    FanCorner& c = corners_[at.corner];
    c.mirrored = at.mirrored;
    c.fan = fan;
    c.first_side = side++;
    c.last_side = side;
    c.low = angle;
    angle += angle_at(mesh_, at.corner);
    c.high = angle;
  }
  if (closed) corners_[fan_.back().corner].last_side = first_side;
}

// One fan may have all sectors; several have equal numbers of them, without the shared one.
void Fans::share_sectors(Index v, Index fans) {
  const Index each = fans <= 1 ? kSectors : std::max<Index>(1, kSharedSector / fans);
  const std::size_t first = sectors_.size();
  for (Index fan = 0, begin = 0; fan < fans; ++fan) {
    const Index count = fan_end_[fan] - begin, used = std::min(each, count);
    for (Index k = 0; k < count; ++k) {
      FanCorner& c = corners_[all_[begin + k].corner];
      if (fans > 1 && sectors_.size() - first >= kSharedSector && k == 0) {  // beyond
        for (Index j = begin; j < fan_end_[fans - 1]; ++j) corners_[all_[j].corner].sector = kSharedSector;
        return;
      }
      if (k == 0 || (std::uint64_t{k} * used) / count != (std::uint64_t{k - 1} * used) / count) {
        sectors_.push_back({c.low, c.low, around_[fan], fan});
      }
      sectors_.back().high = c.high;
      c.sector = static_cast<std::uint8_t>(sectors_.size() - 1 - first);
    }
    begin = fan_end_[fan];
  }
  static_cast<void>(v);
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

void Fans::name_edges() {
  edge_.assign(mesh_.halfedge_count(), kNoIndex);
  for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
    for (Index g = h; edge_[g] == kNoIndex; g = opposite_[g]) edge_[g] = h;
  }
}

}  // namespace brushfire::carried_source
