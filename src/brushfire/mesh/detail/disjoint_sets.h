// Which of n things hang together.
#pragma once

#include <brushfire/core/types.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace brushfire::detail {

// Union and find with halved paths; the representative of a set is its lowest member.
class DisjointSets {
 public:
  explicit DisjointSets(Index n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  Index find(Index a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void unite(Index a, Index b) {
    a = find(a);
    b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace brushfire::detail
