// An array that was copied, or taken over from a caller.
#pragma once

#include <brushfire/core/detail/uninitialized.h>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace brushfire::detail {

template <class T>
class KeptArray {
 public:
  KeptArray() = default;
  explicit KeptArray(UninitializedArray<T>&& own) : own_(std::move(own)) {}
  explicit KeptArray(std::vector<T>&& given) : given_(std::move(given)) {}

  operator std::span<const T>() const {  // NOLINT(google-explicit-constructor): it is one
    return given_.empty() ? std::span<const T>(own_) : std::span<const T>(given_);
  }
  std::span<const T> all() const { return *this; }
  std::size_t size() const { return all().size(); }
  const T& operator[](std::size_t i) const { return all()[i]; }

 private:
  UninitializedArray<T> own_;
  std::vector<T> given_;  // one of the two is empty
};

}  // namespace brushfire::detail
