// How to stop a computation that takes long: its loops look at a token that was given to their thread.
#pragma once

#include <brushfire/core/progress.h>

#include <cstddef>

namespace brushfire {

// As long as it lives, everything of this library that this thread calls listens to the token, and throws
// Error(Cancelled) some milliseconds after it is set: also what takes no token of its own, reading and writing files,
// building what is derived from a mesh, queries, pictures. Scopes nest, the innermost counts; threads that work for the
// calling one listen to the same. (A single call into another library is not interrupted: the packing of the tree for
// nearest points, the compression of a PNG.)
class CancelScope {
 public:
  explicit CancelScope(const CancelToken* token) noexcept;  // null: the outer scope stays in force
  ~CancelScope();
  CancelScope(const CancelScope&) = delete;
  CancelScope& operator=(const CancelScope&) = delete;

 private:
  const CancelToken* outer_;
};

// What this thread listens to; null: nothing.
const CancelToken* current_cancel_token() noexcept;

// Throws Error(Cancelled) where what this thread listens to is set. Costs some nanoseconds.
void stop_if_cancelled();

// The same for the body of a loop of short steps: looks every `interval` calls only.
class Poll {
 public:
  explicit Poll(std::size_t interval = kDefaultInterval) : interval_(interval), left_(interval) {}
  void operator()() {
    if (--left_ == 0) look();
  }

 private:
  static constexpr std::size_t kDefaultInterval = 4096;  // steps of up to a microsecond
  void look();

  std::size_t interval_, left_;
};

// body(begin, end) for pieces of [0, count), one after the other, with a look before each: for loops that are too tight
// for a Poll.
template <class Body>
void in_pieces(std::size_t count, const Body& body) {
  constexpr std::size_t kPiece = std::size_t{1} << 17;
  for (std::size_t begin = 0; begin < count; begin += kPiece) {
    stop_if_cancelled();
    body(begin, begin + kPiece < count ? begin + kPiece : count);
  }
}

}  // namespace brushfire
