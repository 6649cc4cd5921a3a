// Writes the record of one vertex after the other: the sides of its fans, those over unrolled faces, and what is
// offered over them.
#include <brushfire/solvers/carried_source/detail/records.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/prefault.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/solvers/carried_source/detail/optics.h>
#include <brushfire/solvers/carried_source/detail/unrolled.h>
#include <brushfire/solvers/detail/unfolding_limit.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>

namespace brushfire::carried_source {
namespace {

constexpr double kTurnRounding = 1e-9;  // of angles, by far
constexpr Index kMostSupports = Index{1} << (32 - Update::kSupportShift);

struct DraftSide {
  Index end = kNoIndex;
  double length = 0;
  Optic here, there;  // all 0 along the edge of a face that names a vertex twice: it has no direction
};

struct DraftUpdate {
  Index support = 0, target = 0;
  double length = 0;  // of the edge
  Hand hand = Hand::Left, hand_there = Hand::Right;
  bool same_turn = true, seam = false;
  Index sector = 0;
  double need = 0, bulge = 0;
};

Hand hand_if(bool left) { return left ? Hand::Left : Hand::Right; }

// How much later than v, at least, the front reaches the target: it lies on the line from b to the target, or farther
// from v. Let that line have the distance h from v, and v's foot the distance m from the target: a source at distance r
// from v, r >= |vb|, beyond the edge, reaches the target from at least m + sqrt(r^2 - h^2) away; and
// r - sqrt(r^2 - h^2) <= h^2 / (2 (r - h)).
void set_need(double along, double from_other, DraftUpdate& u) {
  double foot = 0;
  if (from_other > 0) {
    const double shorter = std::min(along, from_other), longer = std::max(along, from_other);
    const double product = 0.5 * (shorter * shorter + (longer - u.length) * (longer + u.length));
    foot = std::clamp(product / from_other, -along, along);
  }
  u.need = foot;
  u.bulge = 0.5 * (foot > 0 ? (along - foot) * (along + foot) : along * along);
}

template <class T>
class RecordBuilder {
 public:
  explicit RecordBuilder(const Mesh& mesh)
      : mesh_(mesh), fans_(mesh), lengths_(mesh.lengths()), optics_(mesh, fans_), unroller_(mesh, fans_) {}

  Records<T> build() {
    out_.vertex_count = mesh_.vertex_count();
    unroll_all();
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      poll_();
      write(v);
    }
    out_.offset.push_back(out_.data.size());
    out_.lenses = optics_.take_lenses();
    if (mesh_.halfedge_count() > 0 && sum_of_lengths_ > 0) {
      out_.mean_edge = sum_of_lengths_ / static_cast<double>(mesh_.halfedge_count());
    }
    // To where it lies aligned, with room behind for what is asked for ahead of time.
    UninitializedArray<std::byte> loose(out_.data.size() + 2 * Records<T>::kAlignment);
    loose.swap(out_.data);
    copy_in_large_pages(loose, out_.data.data() + (out_.base() - out_.data.data()));
    return std::move(out_);
  }

 private:
  // A march reads records in no order that a TLB could hold.
  static void copy_in_large_pages(const UninitializedArray<std::byte>& from, std::byte* to) {
    constexpr std::size_t kPiece = std::size_t{1} << 18;
    PagesAhead pages(to, from.size());
    for (std::size_t at = 0; at < from.size(); at += kPiece) {
      const std::size_t bytes = std::min(kPiece, from.size() - at);
      pages.reach(to + at + bytes - 1);  // before any of it is written
      std::memcpy(to + at, from.data() + at, bytes);
    }
  }

  void unroll_all() {
    split_.resize(mesh_.halfedge_count());
    std::vector<Index> count(mesh_.vertex_count() + std::size_t{1}, 0);
    detail::UnfoldingLimit limit(mesh_.face_count());
    for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
      poll_();
      sum_of_lengths_ += lengths_[h];
      if (!mesh_.is_face_usable(Mesh::face_of(h)) || !unroller_.is_obtuse(h)) continue;
      int crossed = 0;
      const std::size_t before = triangles_.size();
      split_[h] = unroller_.unroll(h, limit.faces(), triangles_, crossed);
      limit.add(triangles_.size() - before);
      out_.most_unrolled = std::max(out_.most_unrolled, crossed);
    }
    for (const UnrolledTriangle& t : triangles_) ++count[t.right.vertex], ++count[t.left.vertex];
    begin_.assign(1, 0);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) begin_.push_back(begin_.back() + count[v]);
    std::vector<std::size_t> at(begin_.begin(), begin_.end() - 1);
    by_vertex_.resize(begin_.back());
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      by_vertex_[at[triangles_[i].right.vertex]++] = {i, true};
      by_vertex_[at[triangles_[i].left.vertex]++] = {i, false};
    }
  }

  // The sides and updates of v inside one of its faces.
  void add_face(Index v, Index h) {
    const Index next = Mesh::next(h), previous = Mesh::previous(h);
    const Index own = fans_.side(h, true), other = fans_.side(h, false);
    const double l = lengths_[h], k = lengths_[previous], across = lengths_[next];
    const Index p = mesh_.to(h), q = mesh_.from(previous);
    const auto set = [&](Index number, Index end, double length, Index number_there) {
      DraftSide& side = sides_[number];
      if (side.end == kNoIndex) side = {end, length, optics_.side(v, number), optics_.side(end, number_there)};
    };
    set(own, p, l, fans_.side(next, false));
    set(other, q, k, fans_.side(previous, true));
    const bool mirrored = fans_.corner(h).mirrored;
    const FanCorner &at_p = fans_.corner(next), &at_q = fans_.corner(previous);
    if (l > 0 && k > 0 && !split_[previous]) {
      DraftUpdate u{own, other, l, hand_if(!mirrored), hand_if(at_p.mirrored), !at_q.mirrored};
      set_target(q, fans_.direction(previous, true), k, across, u);
    }
    if (l > 0 && k > 0 && !split_[next]) {
      DraftUpdate u{other, own, k, hand_if(mirrored), hand_if(!at_q.mirrored), at_p.mirrored};
      set_target(p, fans_.direction(next, false), l, across, u);
    }
  }

  // `back`: of the target, to v.
  void set_target(Index target, const Direction& back, double along, double from_other, DraftUpdate& u) {
    u.seam = optics_.is_seam(target, back);
    u.sector = back.sector;
    set_need(along, from_other, u);
    updates_.push_back(u);
  }

  // What v, the right or the left one of an unrolled triangle, offers to its corner.
  void add_unrolled(const UnrolledTriangle& t, bool is_right) {
    const UnrolledEnd &own = is_right ? t.right : t.left, &other = is_right ? t.left : t.right;
    const Index corner = mesh_.from(t.corner);
    const double length = norm(other.at - own.at), along = norm(own.at);
    if (!(length > 0) || !(along > 0)) return;
    DraftUpdate u;
    u.support = side(own.side_to_other, other.vertex, length, own.to_other, other.to_other);
    u.target = side(own.side_to_corner, corner, along, own.to_corner, own.from_corner);
    u.length = length;
    u.hand = hand_if(own.same_turn == is_right);
    u.hand_there = hand_if(other.same_turn != is_right);
    u.same_turn = t.corner_same_turn == is_right;
    set_target(corner, own.from_corner, along, norm(other.at), u);
  }

  // The number of a side, of a fan or of its own; those of one unrolling follow each other.
  Index side(Index of_fan, Index end, double length, const Direction& here, const Direction& there) {
    if (of_fan != kNoIndex) return of_fan;
    constexpr std::size_t kRecent = 4;
    const std::size_t own = sides_.size() - fans_.side_count(at_);
    for (std::size_t i = 0; i < std::min(own, kRecent); ++i) {
      const DraftSide& s = sides_[sides_.size() - 1 - i];
      if (s.end == end && s.length == length && s.here.angle == here.angle) {
        return static_cast<Index>(sides_.size() - 1 - i);
      }
    }
    sides_.push_back({end, length, optics_.of(at_, here), optics_.of(end, there)});
    return static_cast<Index>(sides_.size() - 1);
  }

  void add_conduits(Index v, Index h) {
    for (const Index g : {h, Mesh::previous(h)}) {
      const Index end = mesh_.from(g) == v ? mesh_.to(g) : mesh_.from(g);
      if (end != v) sides_.push_back({end, lengths_[g], {}, {}});
    }
  }

  void write(Index v) {
    at_ = v;
    sides_.assign(fans_.side_count(v), {});
    updates_.clear();
    for (const Index h : mesh_.corners(v)) {
      if (mesh_.is_face_usable(Mesh::face_of(h))) add_face(v, h);
    }
    for (std::size_t i = begin_[v]; i < begin_[v + 1]; ++i)
      add_unrolled(triangles_[by_vertex_[i].triangle], by_vertex_[i].is_right);
    for (const Index h : mesh_.corners(v)) {
      if (!mesh_.is_face_usable(Mesh::face_of(h))) add_conduits(v, h);
    }
    const auto order = [](const DraftUpdate& u) { return std::tie(u.target, u.support, u.sector, u.length); };
    detail::sort(updates_.begin(), updates_.end(),
                 [&](const DraftUpdate& a, const DraftUpdate& b) { return order(a) < order(b); });
    const auto beyond = [](const DraftUpdate& u) { return u.support >= kMostSupports; };
    updates_.erase(std::remove_if(updates_.begin(), updates_.end(), beyond), updates_.end());
    put_record(v);
  }

  void put_record(Index v) {
    align();
    out_.offset.push_back(out_.data.size());
    const std::span<const Sector> sectors = fans_.sectors(v);
    const double around = sectors.empty() || fans_.is_odd(v) ? kInfinity : sectors.front().around;
    out_.around.push_back(around < kInfinity
                              ? Around<T>{static_cast<T>(std::cos(around)), static_cast<T>(std::sin(around))}
                              : Around<T>{});
    head_ = {};
    head_.sides = static_cast<Index>(sides_.size());
    head_.bends = fans_.bends_light(v) ? 1 : 0;
    for (const DraftUpdate& u : updates_) head_.reach = std::max(head_.reach, static_cast<T>(u.length));
    out_.most_sides = std::max(out_.most_sides, head_.sides);
    out_.most_updates = std::max(out_.most_updates, static_cast<Index>(updates_.size()));
    set_optics();
    put(&head_, 1);
    put_ends();
    put_updates();
    align();
    put(full_sides_.data(), full_sides_.size());
    if (head_.has_dark) put(dark_.data(), dark_.size());
    if (head_.has_lenses) put(lens_numbers_.data(), lens_numbers_.size());
  }

  void put_updates() {
    for (const DraftUpdate& u : updates_) {
      Update packed{u.support << Update::kSupportShift};
      packed.bits |= u.sector << Update::kSectorShift;
      packed.bits |= u.hand == Hand::Right ? Update::kHere : 0;
      packed.bits |= u.hand_there == Hand::Right ? Update::kThere : 0;
      packed.bits |= u.same_turn ? Update::kSameTurn : 0;
      packed.bits |= u.seam ? Update::kSeam : 0;
      // The target is less than half a turn away: if it seems to lie on the other hand, the angles began anew.
      const double turn = sides_[u.target].here.angle - sides_[u.support].here.angle;
      packed.bits |= (u.hand == Hand::Left ? turn < -kTurnRounding : turn > kTurnRounding) ? Update::kAcross : 0;
      put(&packed, 1);
    }
  }

  void put_ends() {
    constexpr T kAnywhere = std::numeric_limits<T>::max();
    std::size_t u = 0;
    for (Index k = 0; k < sides_.size(); ++k) {
      SideEnd<T> e{sides_[k].end, static_cast<T>(sides_[k].length), 0, static_cast<Index>(u)};
      for (; u < updates_.size() && updates_[u].target == k; ++u) {
        e.need = std::min(e.need, static_cast<T>(updates_[u].need));
        e.bulge = std::max(e.bulge, static_cast<T>(updates_[u].bulge));
      }
      put(&e, 1);
    }
    const SideEnd<T> last{0, kAnywhere, 0, static_cast<Index>(u)};
    put(&last, 1);
  }

  void set_optics() {
    full_sides_.assign(sides_.size(), {});
    dark_.assign(sides_.size(), {});
    lens_numbers_.assign(sides_.size(), {{kNoIndex, kNoIndex}, {kNoIndex, kNoIndex}});
    for (std::size_t k = 0; k < sides_.size(); ++k) {
      const DraftSide& d = sides_[k];
      Side<T>& s = full_sides_[k];
      s.length = static_cast<T>(d.length);
      s.c = static_cast<T>(d.here.c), s.s = static_cast<T>(d.here.s);
      s.end_c = static_cast<T>(d.there.c), s.end_s = static_cast<T>(d.there.s);
      s.sector = static_cast<std::uint8_t>(d.there.sector);
      s.end_bends = fans_.bends_light(d.end) ? 1 : 0;
      for (int i = 0; i < 2; ++i) {
        s.turned[i] = d.here.sets.turned[i], s.end_turned[i] = d.there.sets.turned[i];
        dark_[k].here[i] = d.here.sets.dark[i], dark_[k].end[i] = d.there.sets.dark[i];
        lens_numbers_[k].here[i] = d.here.lenses[i], lens_numbers_[k].end[i] = d.there.lenses[i];
        head_.has_dark |= (d.here.sets.dark[i] | d.there.sets.dark[i]) != 0;
        head_.has_lenses |= d.here.lenses[i] != kNoIndex || d.there.lenses[i] != kNoIndex;
      }
    }
  }

  template <class U>
  void put(const U* from, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<U>);
    const std::size_t size = out_.data.size();
    out_.data.resize(size + count * sizeof(U));
    if (count > 0) std::memcpy(out_.data.data() + size, from, count * sizeof(U));
  }
  void align() {
    while (out_.data.size() % alignof(Side<T>) != 0) out_.data.push_back(std::byte{0});
  }

  const Mesh& mesh_;
  Fans fans_;
  std::span<const double> lengths_;  // by halfedge
  Optics optics_;
  Unroller unroller_;
  Poll poll_;
  Records<T> out_;
  double sum_of_lengths_ = 0;
  std::vector<bool> split_;  // by corner: obtuse, and unrolled into acute ones
  std::vector<UnrolledTriangle> triangles_;
  struct Share {
    std::size_t triangle = 0;
    bool is_right = true;
  };
  std::vector<std::size_t> begin_;
  std::vector<Share> by_vertex_;
  // Of the vertex at hand.
  Index at_ = 0;
  std::vector<DraftSide> sides_;
  std::vector<DraftUpdate> updates_;
  RecordHead<T> head_;
  std::vector<Side<T>> full_sides_;
  std::vector<DarkSets> dark_;
  std::vector<LensNumbers> lens_numbers_;
};

}  // namespace

template <class T>
Records<T> build_records(const Mesh& mesh) {
  return RecordBuilder<T>(mesh).build();
}

template Records<float> build_records<float>(const Mesh& mesh);
template Records<double> build_records<double>(const Mesh& mesh);

}  // namespace brushfire::carried_source
