// What a march knows of the surface around a vertex, as one record: the sides that lead to other vertices, and what
// the vertex may offer over them.
#pragma once

#include <brushfire/core/detail/inline.h>
#include <brushfire/core/detail/uninitialized.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/carried_source/detail/sight.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace brushfire::carried_source {

// What is looked at in every turn of the vertex, before anything is offered.
template <class T>
struct SideEnd {
  Index end = 0;  // the vertex that the side leads to
  // Its value is not lowered by less than need - bulge / (r - the vertex's reach), r: the distance of the source. (The
  // front is plane but for the bulge.)
  T need = 0, bulge = 0;
  Index first_update = 0;  // those of this side up to those of the next have it as their target
};

// A way to another vertex, along an edge or straight over unrolled faces.
template <class T>
struct alignas(8 * sizeof(T)) Side {
  T length = 0;
  T c = 1, s = 0;                      // its direction at the vertex
  T end_c = 1, end_s = 0;              // the direction back, at the end; 0, 0: not known there
  SectorSet turned[2], end_turned[2];  // SightSets, by Hand
  std::uint8_t sector = 0;             // of the direction back
  std::uint8_t end_bends = 0;          // Fans::bends_light() of the end
};

// SightSets, too.
struct DarkSets {
  SectorSet here[2], end[2];
};
// What few sides need.
struct LensNumbers {
  Index here[2] = {kNoIndex, kNoIndex}, end[2] = {kNoIndex, kNoIndex};  // kNoIndex: the sets say it

  bool any() const { return (here[0] & here[1] & end[0] & end[1]) != kNoIndex; }
};

// Over the edge to the end of the side `support`, to the end of the side whose update it is.
struct Update {
  std::uint32_t bits = 0;

  static constexpr std::uint32_t kHere = 1, kThere = 2, kSameTurn = 4, kSeam = 8, kAcross = 16;
  static constexpr int kSectorShift = 5, kSupportShift = 9;
  Index support() const { return bits >> kSupportShift; }
  Index sector() const { return bits >> kSectorShift & 15u; }  // of the target, that the offer comes through
  Index hand() const { return bits & kHere; }                  // of the target, seen from the vertex
  Index hand_there() const { return bits >> 1 & 1u; }          // seen from the support's end
  // Whether the target's angles run the same way round as the frame of the edge in which the target is above.
  bool same_turn() const { return (bits & kSameTurn) != 0; }
  // Whether the way back to the vertex is the last side of the target's fan, at the sum of all angles.
  bool seam() const { return (bits & kSeam) != 0; }
  // Whether the first side of the vertex's own fan lies between support and target, or is one of them as the last.
  bool across() const { return (bits & kAcross) != 0; }
};

template <class T>
struct RecordHead {
  Index sides = 0;
  std::uint8_t has_lenses = 0;
  std::uint8_t bends = 0;  // Fans::bends_light()
  T reach = 0;             // the longest side that anything is offered over
};

// A direction turned by the sum of a vertex's angles is multiplied by this.
template <class T>
struct Around {
  T c = 1, s = 0;
};

template <class T>
class Record {
 public:
  explicit Record(const std::byte* at) : at_(at) {}
  BRUSHFIRE_INLINE const RecordHead<T>& head() const { return *reinterpret_cast<const RecordHead<T>*>(at_); }
  // One more than there are sides: where the last one's updates end.
  BRUSHFIRE_INLINE const SideEnd<T>* ends() const {
    return reinterpret_cast<const SideEnd<T>*>(at_ + sizeof(RecordHead<T>));
  }
  BRUSHFIRE_INLINE const Update* updates() const { return reinterpret_cast<const Update*>(ends() + head().sides + 1); }
  BRUSHFIRE_INLINE const Side<T>* sides() const {
    const auto at = reinterpret_cast<std::uintptr_t>(updates() + ends()[head().sides].first_update);
    return reinterpret_cast<const Side<T>*>((at + alignof(Side<T>) - 1) / alignof(Side<T>) * alignof(Side<T>));
  }
  BRUSHFIRE_INLINE const DarkSets* dark() const { return reinterpret_cast<const DarkSets*>(sides() + head().sides); }
  BRUSHFIRE_INLINE const LensNumbers* lenses() const {
    return reinterpret_cast<const LensNumbers*>(dark() + head().sides);
  }

 private:
  const std::byte* at_;
};

template <class T>
struct Records {
  Index vertex_count = 0;
  Index most_sides = 0, most_updates = 0;  // of a vertex
  int most_unrolled = 0;                   // faces behind one obtuse corner
  double mean_edge = 1;                    // in mesh.unit()
  std::vector<std::uint64_t> offset;       // [vertex_count + 1] in bytes
  UninitializedArray<std::byte> data;
  std::vector<Around<T>> around;  // [vertex_count]
  std::vector<Lenses> lenses;

  BRUSHFIRE_INLINE Record<T> operator[](Index v) const { return Record<T>(base() + offset[v]); }
  static constexpr std::size_t kAlignment = 64;
  // The first aligned byte of data.
  const std::byte* base() const {
    const auto at = reinterpret_cast<std::uintptr_t>(data.data());
    return data.data() + ((at + kAlignment - 1) / kAlignment * kAlignment - at);
  }
};

// O(vertices + faces), and what the unrolling of obtuse corners takes. The mesh should be in a local order.
template <class T>
Records<T> build_records(const Mesh& mesh);

extern template Records<float> build_records<float>(const Mesh& mesh);
extern template Records<double> build_records<double>(const Mesh& mesh);

}  // namespace brushfire::carried_source
