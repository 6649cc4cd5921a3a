// What brought points their values: what paths are made from. Of runs in doubles; others hand over what they know as
// doubles (PlainRun).
#pragma once

#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/detail/sheets.h>
#include <brushfire/solvers/windows/algebra/rays.h>
#include <brushfire/solvers/windows/paths/leg_search.h>
#include <brushfire/solvers/windows/paths/point_values.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

struct PointRecord {
  Real value = kInfinity;  // mesh.unit(), offsets included
  Index label = kNoIndex;
  Ray ray;
};

// The records of a mesh's vertices: of every one, or, after a run that costs what it reaches, of those alone.
class VertexRecords {
 public:
  // One for each of `count` vertices, `unknown` until it is set.
  void resize(Index count, const PointRecord& unknown);
  // Room for up to `expected` vertices of `count`; the others read `unknown`.
  void resize_few(Index count, std::size_t expected, const PointRecord& unknown);

  void set(Index v, const PointRecord& record);
  const PointRecord& operator[](Index v) const { return slots_.empty() ? records_[v] : few_[slots_[find(v)]].record; }
  Index size() const noexcept { return count_; }

 private:
  struct Numbered {
    Index vertex;
    PointRecord record;
  };
  std::size_t find(Index v) const;

  Index count_ = 0;
  std::vector<PointRecord> records_;  // [vertex_count], or none
  // Open addressing: a slot holds a position in few_; 0 is that of the unknown one, and means that the slot is free.
  std::vector<std::uint32_t> slots_;  // a power of two, or none
  std::vector<Numbered> few_;
};

// A ray that a run in any numbers left behind.
inline Ray ray_of(const PlainRay& ray) {
  return {ray.source, ray.halfedge, ray.pseudo_source, ray.parallel ? WindowKind::Linear : WindowKind::Circular};
}

struct WindowFieldData {
  Mesh mesh;
  std::vector<detail::LocatedSource> sources;
  CurveIndex curves;                   // of these
  std::vector<Real> bases;             // what is to be added to values, by source, in the mesh's units; empty: 0
  Real shift = 0;                      // what was added to every value so that none is negative
  bool exact = true;                   // no merging: rays lead back to pseudo-sources
  VertexRecords vertices;              // [vertex_count]; value NaN: farther than the run went
  std::vector<PointLocation> targets;  // where not all_points
  std::vector<PointRecord> target;     // [targets]
  std::shared_ptr<const PointValues> all_points;  // where all windows were kept
  std::shared_ptr<const detail::SheetView> view;  // where `mesh` is a single mesh (sheets.h): of the caller's
  double relative = 0, absolute = 0;              // what rounding may do to values: see Rounding

  // What a leg and the value where it starts may miss the value at its end by: a share of the whole path, and what
  // values are rounded by, which offsets make larger.
  Real room_for(const PointRecord& record) const { return room_for(record.value, length_of(record)); }
  // The same where the whole path is known to be so long. (Where offsets change along a curve, a value does not tell.)
  static Real room_for(Real value, Real length) {
    constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();
    return kAgreement * length + kRounding * value;
  }
  // By how much more a leg and the value where it starts may come to at most, if the values at both of its ends are as
  // far off as they may be.
  Real most_room_for(const PointRecord& record) const {
    return room_for(record) + 2 * (relative * length_of(record) + absolute);
  }

 private:
  Real length_of(const PointRecord& record) const {
    return record.value - (record.label < sources.size() ? sources[record.label].offset + shift : 0);
  }
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
