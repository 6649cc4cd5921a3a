// PointGrid: points by the cell of a grid that they lie in, to find those within a radius of a place.
#pragma once

#include <brushfire/core/types.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace brushfire::detail {

// Cells are as wide as the radius, so that what is near lies in one of 27. Cell numbers are doubles: where the radius
// is below the spacing of doubles they are as fine as these, and only equal points share a cell.
class PointGrid {
 public:
  // `positions` must outlive the grid; radius >= 0.
  PointGrid(std::span<const Vec3> positions, double radius) : positions_(positions), radius_(radius) {
    // Below this, and for radius 0, only equal points meet, and cells are the points themselves.
    constexpr double kSmallestRadius = 1e-290;
    if (radius < kSmallestRadius) radius_ = 0;
  }

  void add(Index v) {
    const auto [slot, is_new] = first_.try_emplace(cell_of(positions_[v]), static_cast<std::uint32_t>(entries_.size()));
    entries_.push_back({v, is_new ? kNoIndex : slot->second});
    slot->second = static_cast<std::uint32_t>(entries_.size() - 1);
  }

  // Calls use(v, distance) for every point that was added and lies within the radius of `place`, in no order.
  template <class Use>
  void for_each_near(const Vec3& place, Use use) const {
    const Cell centre = cell_of(place);
    const double reach = radius_ > 0 ? 1 : 0;
    for (double dx = -reach; dx <= reach; ++dx) {
      for (double dy = -reach; dy <= reach; ++dy) {
        for (double dz = -reach; dz <= reach; ++dz) {
          const Cell cell{centre[0] + dx, centre[1] + dy, centre[2] + dz};
          // Far out, one more or less is the same number: the cell is looked at once.
          if ((dx != 0 && cell[0] == centre[0]) || (dy != 0 && cell[1] == centre[1]) ||
              (dz != 0 && cell[2] == centre[2]))
            continue;
          const auto found = first_.find(cell);
          if (found == first_.end()) continue;
          for (Index k = found->second; k != kNoIndex; k = entries_[k].next) {
            const double d = norm(positions_[entries_[k].point] - place);
            if (d <= radius_) use(entries_[k].point, d);
          }
        }
      }
    }
  }

 private:
  using Cell = std::array<double, 3>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      std::uint64_t h = 0;
      for (const double c : cell) {
        h = (h ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15u;  // -0 is 0
        h ^= h >> 32;
      }
      return static_cast<std::size_t>(h);
    }
  };
  struct Entry {
    Index point;
    Index next;  // of the same cell
  };

  Cell cell_of(const Vec3& p) const {
    if (radius_ == 0) return {p.x + 0.0, p.y + 0.0, p.z + 0.0};
    return {std::floor(p.x / radius_), std::floor(p.y / radius_), std::floor(p.z / radius_)};
  }

  std::span<const Vec3> positions_;
  double radius_;
  std::unordered_map<Cell, Index, Hash> first_;
  std::vector<Entry> entries_;
};

}  // namespace brushfire::detail
