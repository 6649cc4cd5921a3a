// Records by vertex.
#include <brushfire/solvers/windows/paths/record.h>

#include <bit>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

void VertexRecords::resize(Index count, const PointRecord& unknown) {
  count_ = count;
  slots_.clear();
  few_.clear();
  records_.assign(count, unknown);
}

void VertexRecords::resize_few(Index count, std::size_t expected, const PointRecord& unknown) {
  count_ = count;
  records_.clear();
  slots_.assign(std::bit_ceil(2 * expected + 2), 0);  // half of them stay free
  few_.clear();
  few_.reserve(expected + 1);
  few_.push_back({kNoIndex, unknown});
}

// The slot of a vertex, or the free one where it belongs. Neighbours on a grid differ in a few bits anywhere in their
// numbers: the product brings all of them to the top (Knuth, The Art of Computer Programming 3, 6.4).
std::size_t VertexRecords::find(Index v) const {
  constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15;
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = static_cast<std::size_t>((v * kGolden) >> 32) & mask;
  while (slots_[slot] != 0 && few_[slots_[slot]].vertex != v) slot = (slot + 1) & mask;
  return slot;
}

void VertexRecords::set(Index v, const PointRecord& record) {
  if (slots_.empty()) {
    records_[v] = record;
    return;
  }
  std::uint32_t& slot = slots_[find(v)];
  if (slot == 0) {
    slot = static_cast<std::uint32_t>(few_.size());
    few_.push_back({v, record});
  } else {
    few_[slot].record = record;
  }
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
