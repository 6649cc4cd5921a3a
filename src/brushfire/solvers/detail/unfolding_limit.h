// How far obtuse corners are unfolded.
#pragma once

#include <brushfire/core/types.h>

#include <cstddef>

namespace brushfire::detail {

// Behind an obtuse corner faces are unfolded until a vertex splits its angle into acute ones, no more than
// kMostUnfolded. In some meshes every corner takes all of them (a wavy fan of a million needles, whose rim curves
// slowly), and what is made of them would fill any memory: 20 kB a face. So where many have been made, the corners that
// follow are unfolded over few faces only. No scan or machine part has come near: they make 2 triangles a face at most.
class UnfoldingLimit {
 public:
  static constexpr int kMostUnfolded = 64;

  explicit UnfoldingLimit(Index faces) : left_(kAnyway + kEachFace * faces) {}

  // For the next corner.
  int faces() const { return left_ > 0 ? kMostUnfolded : kFew; }
  // What the last one became.
  void add(std::size_t triangles) { left_ -= triangles < left_ ? triangles : left_; }

 private:
  static constexpr int kFew = 4;
  static constexpr std::size_t kAnyway = 100'000, kEachFace = 4;

  std::size_t left_;
};

}  // namespace brushfire::detail
