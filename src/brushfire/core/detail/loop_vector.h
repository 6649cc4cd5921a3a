// What a compiler's own vectors are, in loops: for compilers that have none.
#pragma once

#include <brushfire/core/detail/inline.h>

#include <cstdint>
#include <type_traits>

namespace brushfire::lanes {

template <class T, int N>
struct LoopVector {
  using Bits = LoopVector<std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>, N>;
  T item[N];

  BRUSHFIRE_INLINE T operator[](int k) const { return item[k]; }
  BRUSHFIRE_INLINE T& operator[](int k) { return item[k]; }

  BRUSHFIRE_INLINE friend LoopVector operator+(LoopVector a, LoopVector b) {
    return each<LoopVector>(a, b, [](T x, T y) { return static_cast<T>(x + y); });
  }
  BRUSHFIRE_INLINE friend LoopVector operator-(LoopVector a, LoopVector b) {
    return each<LoopVector>(a, b, [](T x, T y) { return static_cast<T>(x - y); });
  }
  BRUSHFIRE_INLINE friend LoopVector operator*(LoopVector a, LoopVector b) {
    return each<LoopVector>(a, b, [](T x, T y) { return static_cast<T>(x * y); });
  }
  BRUSHFIRE_INLINE friend LoopVector operator/(LoopVector a, LoopVector b) {
    return each<LoopVector>(a, b, [](T x, T y) { return static_cast<T>(x / y); });
  }
  BRUSHFIRE_INLINE friend LoopVector operator&(LoopVector a, LoopVector b) {
    return each<LoopVector>(a, b, [](auto x, auto y) { return x & y; });
  }
  BRUSHFIRE_INLINE friend LoopVector operator|(LoopVector a, LoopVector b) {
    return each<LoopVector>(a, b, [](auto x, auto y) { return x | y; });
  }
  BRUSHFIRE_INLINE friend LoopVector operator^(LoopVector a, LoopVector b) {
    return each<LoopVector>(a, b, [](auto x, auto y) { return x ^ y; });
  }
  BRUSHFIRE_INLINE friend LoopVector operator<<(LoopVector a, int by) {
    return each<LoopVector>(a, a, [by](auto x, auto) { return x << by; });
  }
  BRUSHFIRE_INLINE friend LoopVector operator>>(LoopVector a, int by) {
    return each<LoopVector>(a, a, [by](auto x, auto) { return x >> by; });
  }
  BRUSHFIRE_INLINE friend LoopVector operator~(LoopVector a) {
    return each<LoopVector>(a, a, [](auto x, auto) { return ~x; });
  }
  BRUSHFIRE_INLINE friend LoopVector operator-(LoopVector a) {
    return each<LoopVector>(a, a, [](T x, T) { return static_cast<T>(-x); });
  }
  BRUSHFIRE_INLINE friend LoopVector operator-(T x, LoopVector a) {
    return each<LoopVector>(a, a, [x](T y, T) { return static_cast<T>(x - y); });
  }
  BRUSHFIRE_INLINE friend LoopVector operator/(LoopVector a, T by) {
    return each<LoopVector>(a, a, [by](T x, T) { return static_cast<T>(x / by); });
  }
  // All bits, or none.
  BRUSHFIRE_INLINE friend Bits operator<(LoopVector a, LoopVector b) {
    return each<Bits>(a, b, [](T x, T y) { return x < y ? -1 : 0; });
  }
  BRUSHFIRE_INLINE friend Bits operator>(LoopVector a, LoopVector b) { return b < a; }
  BRUSHFIRE_INLINE friend Bits operator<=(LoopVector a, LoopVector b) {
    return each<Bits>(a, b, [](T x, T y) { return x <= y ? -1 : 0; });
  }
  BRUSHFIRE_INLINE friend Bits operator==(LoopVector a, LoopVector b) {
    return each<Bits>(a, b, [](T x, T y) { return x == y ? -1 : 0; });
  }

 private:
  template <class Result, class Act>
  BRUSHFIRE_INLINE static Result each(LoopVector a, LoopVector b, const Act& act) {
    Result result{};
    for (int k = 0; k < N; ++k) result[k] = act(a.item[k], b.item[k]);
    return result;
  }
};

}  // namespace brushfire::lanes
